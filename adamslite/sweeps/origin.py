"""What the runs of a sweep were made from, as texts that its file carries along."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.errors import FormatError, UsageError
from adamslite.results.results import Results
from adamslite.results.run_texts import attributes, restored
from adamslite.results.source import RunSource, source_of
from adamslite.results.untrusted import from_json
from adamslite.sweeps.record import Sweep

SOURCE, OPTIONS = "source", "options"
#: Of the texts of a run those that say what it was made from.
KEPT = ("deck", "deck_name", "commands", "commands_name", "user", "tables")
#: Options of a run that a file may give.
KNOWN = {
    "end": float, "steps": int, "integrator": str, "formulation": str, "error": float,
    "hmax": float,
}  # fmt: skip


def origin_texts(
    deck: Deck, commands: Sequence[Command], options: Mapping[str, Any]
) -> dict[str, str]:
    """Texts for the file of a sweep; none where commands of Python have no text."""
    if commands and not getattr(commands, "source", None):
        return {}
    empty = np.empty(0)
    made = Results(
        time=empty, names=(), values=empty[:, None][:, :0], source=source_of(deck, commands)
    )
    found = attributes(made)
    plain = {name: KNOWN[name](each) for name, each in options.items() if name in KNOWN}
    return {
        SOURCE: json.dumps({name: found[name] for name in KEPT if name in found}),
        OPTIONS: json.dumps(plain),
    }


def origin_of(sweep: Sweep) -> tuple[RunSource, dict[str, Any]]:
    """Deck and commands of the runs, and the options they were simulated with.

    Raises
    ------
    UsageError
        When the sweep does not carry them.
    FormatError
        When they are not those of this program.
    """
    try:
        texts = from_json(sweep.meta.get(SOURCE, "{}"))
        given = from_json(sweep.meta.get(OPTIONS, "{}"))
        source = restored({str(name): str(text) for name, text in texts.items()})["source"]
        options = {name: KNOWN[name](each) for name, each in given.items() if name in KNOWN}
    except (ValueError, TypeError, AttributeError):
        raise FormatError("the sweep does not say what its runs were made from") from None
    if source is None:
        raise UsageError("the sweep does not carry its deck: an older program has written it")
    return source, options

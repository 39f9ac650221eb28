"""What a file says of its run, as texts by name::

    title               first line of the deck
    program             adamslite and its version
    deck, deck_name     text of the deck, its file name
    deck_sha256         hash of the text
    commands            text of the command file
    commands_name       its file name
    user                numbers that were bound to routines of the user (JSON, a list)
    tables              texts of the tables that the deck names (JSON, by name)
    units               of force, mass, length and time
    integrator          method, formulation, ERROR
    outcome, message    how the run ended, and why it ended early
    summary             counters of the run (JSON); no CPU: the same run gives the same bytes
    comments            the comment lines of a .csv (JSON)
    linear              what LINEAR commands found (JSON, arrays in base64)

What is not known is left out.
"""

from __future__ import annotations

import json
import re
import zlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

import adamslite
from adamslite.errors import FormatError
from adamslite.results.outcomes import Outcome
from adamslite.results.source import NO_FILE, RunSource
from adamslite.results.untrusted import from_json

if TYPE_CHECKING:
    from adamslite.results.results import Results

#: What of the summary differs from run to run.
CLOCKED = ("setup_cpu_s", "solve_cpu_s")
#: A binding of numbers. One of a function is not taken from a file, which may come from others: it
#: would have a module loaded.
NUMBERS = re.compile(r"[^=]+=[-+0-9.,eEdD\s]+")


def attributes(results: Results) -> dict[str, str]:
    """Texts by name; what is not known is left out."""
    source, meta = results.source, results.meta
    found = {
        "title": meta.get("deck", ""),
        "program": f"adamslite {adamslite.__version__}",
        "deck": source.deck if source else "",
        "deck_name": source.name if source else "",
        "deck_sha256": meta.get("deck hash", ""),
        "commands": source.commands if source else "",
        "commands_name": source.commands_name if source else "",
        "user": json.dumps(source.user) if source and source.user else "",
        "tables": _tables(source),
        "units": meta.get("units", ""),
        "integrator": meta.get("integrator", ""),
        "outcome": results.outcome.name,
        "message": results.message,
        "summary": _summary(results),
        "comments": json.dumps(dict(meta)) if meta else "",
        "linear": _linear(results),
    }
    return {name: text for name, text in found.items() if text}


def _summary(results: Results) -> str:
    counters = {name: each for name, each in results.summary.items() if name not in CLOCKED}
    return json.dumps(counters, default=_plain) if counters else ""


def _tables(source: RunSource | None) -> str:
    found = source.table_texts() if source else {}
    return json.dumps(found) if found else ""


def _linear(results: Results) -> str:
    if not results.linearizations:
        return ""
    from adamslite.results.linear_texts import to_text

    return to_text(results.linearizations)


def _plain(value: Any) -> Any:
    """A number of numpy as one of Python; anything else as text."""
    return value.item() if isinstance(value, np.generic) else str(value)


def restored(found: Mapping[str, str]) -> dict[str, Any]:
    """Arguments of :class:`Results` from the texts that :func:`attributes` gives.

    Raises
    ------
    FormatError
        When they are not of this program.
    """
    from adamslite.results.linear_texts import from_text

    try:
        outcome = Outcome[found.get("outcome", "DONE")]
        meta = {str(key): str(text) for key, text in from_json(found.get("comments", "{}")).items()}
        summary = dict(from_json(found.get("summary", "{}")))
        user = tuple(filter(NUMBERS.fullmatch, map(str, from_json(found.get("user", "[]")))))
        tables = from_json(found.get("tables", "{}"))
        kept = tuple((str(name), str(text)) for name, text in tables.items())
        linear = from_text(found.get("linear", "[]"))
    except (ValueError, KeyError, TypeError, AttributeError, zlib.error):
        raise FormatError("its attributes are not those of adamslite") from None
    source = None
    if found.get("deck"):
        source = RunSource(
            deck=found["deck"], name=_plain_name(found.get("deck_name", "")), user=user,
            commands=found.get("commands", ""), commands_name=found.get("commands_name", ""),
            tables=kept,
        )  # fmt: skip
    return {
        "meta": meta, "summary": summary, "outcome": outcome, "source": source,
        "message": found.get("message", ""), "linearizations": linear,
    }  # fmt: skip


def _plain_name(name: str) -> str:
    """The name of a deck without a folder, which would be one of this machine."""
    last = name.replace("\\", "/").rpartition("/")[2]
    return last if last.strip(". ") else NO_FILE


def need_rows(results: Results) -> None:
    """Raise ValueError unless there is a row of values for each time."""
    if results.shape != (results.count, len(results.names)):
        raise ValueError(
            f"{results.count} times and {len(results.names)} names do not belong to values of "
            f"shape {results.shape}"
        )


def printable(text: str) -> str:
    """A text without control characters, which XML and lines of a table do not take."""
    return "".join(each if each.isprintable() else " " for each in text)

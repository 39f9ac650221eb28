"""Rules about SAVE and RELOAD."""

from __future__ import annotations

from collections.abc import Iterator

from adamslite.checks.rule import Rule
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.reload import Reload
from adamslite.elements.save import Save
from adamslite.language.diagnostics import Diagnostic


def places_of_states(deck: Deck) -> Iterator[Diagnostic]:
    """STATES have a BUFFER, a SYSTEM has a FILE."""
    for each in deck.statements:
        if not isinstance(each, Save | Reload):
            continue
        needed, other = ("buffer", "file") if each.kind == "STATES" else ("file", "buffer")
        if not getattr(each, needed) and not _only_automatic(each):
            hint = f"{each.keyword}/STATES, BUFFER=name or {each.keyword}/SYSTEM, FILE=name"
            yield diagnose(each, "missing-argument", word=needed.upper(), hint=hint)
        if each.given(other):
            reason = f"{each.kind} goes to a {needed.upper()}"
            yield diagnose(each, "no-effect", other, word=other.upper(), reason=reason)


def _only_automatic(command: Save | Reload) -> bool:
    """Whether it is about AUTOSAVE alone, and keeps nothing at this time."""
    return isinstance(command, Save) and command.given("autosave")


def buffers_that_are_filled(deck: Deck) -> Iterator[Diagnostic]:
    filled: set[str] = set()
    for each in deck.statements:
        if isinstance(each, Save) and each.kind == "STATES" and each.buffer:
            filled.add(each.buffer)
        elif isinstance(each, Reload) and each.kind == "STATES" and each.buffer:
            if each.buffer not in filled:
                known = f"there is {', '.join(sorted(filled))}" if filled else ""
                yield diagnose(each, "nothing-saved", "buffer", known, word=each.buffer)


SAVE_RULES: list[Rule] = [places_of_states, buffers_that_are_filled]

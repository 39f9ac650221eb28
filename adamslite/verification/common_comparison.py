"""Results against a reference that may be a file of ADAMS: terms, units and channels in common."""

from __future__ import annotations

from collections.abc import Callable
from glob import escape

from adamslite.deck.deck import Deck
from adamslite.notation import shown
from adamslite.results.common_terms import in_common_terms
from adamslite.results.comparison import (
    USUAL,
    Comparison,
    Mismatch,
    Tolerance,
    need_content,
    of_different_decks,
    sampler,
)
from adamslite.results.results import Results
from adamslite.results.unit_factors import unit_ratio
from adamslite.verification.reference_file import Reference


def compared(
    results: Results,
    reference: Reference,
    deck: Deck | None = None,
    allowed: Callable[[str], Tolerance] | None = None,
) -> tuple[Comparison, list[str]]:
    """The comparison, and sentences about what could not be compared as it is.

    Parameters
    ----------
    results : Results
    reference : Reference
        Its table is brought into the terms and units that the two have in common.
    deck : Deck, optional
        Where the centres of mass are, where neither carries a deck.
    allowed : function, optional
        The tolerance of a channel by its name, instead of those of the reference.

    Raises
    ------
    Mismatch
        When the results lack a channel or a time of the reference, or the reference is empty.
    """
    different = of_different_decks(results, reference.table)
    try:
        comparison, notes = _compared(results, reference, deck, allowed)
    except Mismatch as fault:
        raise Mismatch(f"{fault} ({different})" if different else str(fault)) from None
    return comparison, [*([different] if different else []), *map(shown, notes)]


def _compared(
    results: Results,
    reference: Reference,
    deck: Deck | None,
    allowed: Callable[[str], Tolerance] | None,
) -> tuple[Comparison, list[str]]:
    if not reference.measures:
        need_content(reference.table)
    common = in_common_terms(results, reference.table, deck)
    reference.table = common.reference
    if allowed is not None:
        reference.tolerances = [(escape(name), allowed(name)) for name in common.reference.names]
    found = reference.judge(common.results, usual=USUAL)
    return found, [*common.notes, *_in_other_units(found, common.results, reference)]


def _in_other_units(found: Comparison, results: Results, reference: Reference) -> list[str]:
    """Sentences on channels that are off as by a unit."""
    table, notes = reference.table, []
    try:
        sample = sampler(results, table.time, reference.interpolate)
    except Mismatch:  # of times that files have rounded
        return []
    for name in (each.name for each in found.outside if each.name in table.names):
        ratio = unit_ratio(sample(results[name]), table[name])
        if ratio is not None:
            notes.append(
                f"{name}: {ratio:.6g} times the reference throughout: is one of them in another "
                f"unit?"
            )
    return notes

"""Two results in the same terms, so that they can be compared: one may be of ADAMS.

Of files of ADAMS parts are taken to their centres of mass, single-component forces to their values
along the line (:mod:`adamslite.results.adams_terms`), and only channels that both have are
compared. Numbers in other units than those of the reference are converted.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.language.diagnostics import DeckError
from adamslite.results.adams_terms import BCS, from_adams, with_split_angles
from adamslite.results.channels import describe, unit_symbols
from adamslite.results.comparison import Mismatch
from adamslite.results.unit_factors import in_symbols, unit_factor

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.results.results import Results

#: What readers of files of other programs note in the comments.
WRITTEN_BY = "written by"
MOST_NAMED = 4


class Common(NamedTuple):
    """Results and reference in one set of terms, and sentences on what was done to them."""

    results: Results
    reference: Results
    notes: list[str]


def in_common_terms(results: Results, reference: Results, deck: Deck | None = None) -> Common:
    """Bring results and reference together.

    Parameters
    ----------
    deck : Deck, optional
        Where the centres of mass of parts are; by default that of either side.

    Raises
    ------
    Mismatch
        When nothing is left to compare, or a channel has different quantities.
    """
    notes: list[str] = []
    if _is_foreign(results) or _is_foreign(reference):
        known = deck or deck_of(results) or deck_of(reference)
        results, reference = (_as_ours(each, known, notes) for each in (results, reference))
        reference = _shared(results, reference, notes)
    return Common(_in_units(results, reference, notes, deck), reference, notes)


def of_deck(results: Results, deck: Deck | None) -> tuple[Results, list[str]]:
    """Results of a file of ADAMS in the terms and units of their deck, and what there is to say
    about it; other results as they are.
    """
    notes: list[str] = []
    if _is_foreign(results):
        results = _as_ours(results, deck, notes)
    return results, notes


def _is_foreign(results: Results) -> bool:
    return WRITTEN_BY in results.meta


def deck_of(results: Results) -> Deck | None:
    """The deck that results come from, where it is known."""
    try:
        return results.source.read()[0] if results.source else None
    except DeckError:
        return None


def _as_ours(results: Results, deck: Deck | None, notes: list[str]) -> Results:
    """Results of ADAMS in the terms of this program, as far as the deck is known."""
    if _is_foreign(results) and deck is not None:
        results = from_adams(_in_units_of(deck, results, notes), deck)
    of_origin = [name for name in results.names if f".{BCS}" in name]
    if of_origin:
        lacks = "the deck has no such part, or the file lacks what it takes"
        why = lacks if deck else "give the deck by --deck"
        notes.append(
            f"{_listed(of_origin)}: of the origin of a part and not of its centre of mass, left "
            f"out: {why}"
        )
        results = _only(results, [name for name in results.names if f".{BCS}" not in name])
    return with_split_angles(results)


def _in_units_of(deck: Deck, results: Results, notes: list[str]) -> Results:
    """Results of a file in the units of a deck, whose lengths are added to them."""
    names = deck.single("UNITS").names
    if names is None:
        return results
    text = " ".join(names)
    symbols = unit_symbols(text)
    values, changed = results.values.copy(), {}
    for column, name in enumerate(results.names):
        unit = results.channel(name).unit
        own, factor = in_symbols(unit, symbols)
        values[:, column] *= factor
        if own != unit:
            changed[unit] = own
    time, factor = in_symbols(results.channel("time").unit, symbols)
    if changed:
        words = ", ".join(f"{have} to {want}" for have, want in changed.items())
        notes.append(f"numbers of a file of ADAMS were converted to the units of the deck: {words}")
    meta = {**results.meta, "units": text}
    return replace(results, time=results.time * factor, values=values, meta=meta, channels={})


def _shared(results: Results, reference: Results, notes: list[str]) -> Results:
    """The reference with the channels that the results have, too."""
    missing = [name for name in reference.names if name not in results]
    shared = [name for name in reference.names if name in results]
    if not shared:
        raise Mismatch("results and reference have no channel in common")
    if missing:
        notes.append(f"{_listed(missing)}: in the reference alone, not compared")
    return _only(reference, shared)


def _only(results: Results, names: list[str]) -> Results:
    values = [results[name] for name in names]
    table = np.column_stack(values) if values else np.zeros((len(results.time), 0))
    return replace(results, names=tuple(names), values=table)


def _in_units(results: Results, reference: Results, notes: list[str], deck: Deck | None) -> Results:
    """The results in the units of the reference, where those of both are known."""
    values = results.values.copy()
    changed: dict[str, str] = {}
    unknown, named = [], {}
    column = {name.casefold(): k for k, name in enumerate(results.names)}
    other_system = _differ(results.unit_symbols, reference.unit_symbols)
    for name in reference.names:
        if name.casefold() not in column:
            continue
        have, want = (_unit(each, name, deck) for each in (results, reference))
        if have and want and have != want:
            factor = unit_factor(have, want)
            if factor is None:
                raise Mismatch(f"'{name}' is in {have}, in the reference in {want}")
            values[:, column[name.casefold()]] *= factor
            changed[have] = want
        elif other_system and have == want == "":
            unknown.append(name)
        elif have != want and _is_marked(results, name) != _is_marked(reference, name):
            named[name] = have or want
    time = _time(results, reference, changed)
    if changed:
        words = ", ".join(f"{have} to {want}" for have, want in changed.items())
        notes.append(f"results were converted to the units of the reference: {words}")
    if unknown and changed:
        notes.append(f"{_listed(unknown)}: of unknown unit, compared as they are")
    if named:
        units = ", ".join(dict.fromkeys(named.values()))
        told = "" if deck else ", unless --deck DECK tells the unit"
        notes.append(
            f"{_listed([*named])}: one file alone names {units}; compared as they are{told}"
        )
    return replace(results, time=time, values=values) if changed else results


def _unit(results: Results, name: str, deck: Deck | None) -> str:
    """The unit of a column; with a deck, also of what an expression of it measures."""
    own = results.channel(name).unit
    return own or (describe(name, results.unit_symbols, deck).unit if deck else "")


def _is_marked(results: Results, name: str) -> bool:
    """Whether the file names the unit of a column by itself."""
    return name in results and bool(results.channels.get(results.channel(name).name))


def _differ(units: dict[str, str], others: dict[str, str]) -> bool:
    return any(others.get(kind, symbol) != symbol for kind, symbol in units.items())


def _time(results: Results, reference: Results, changed: dict[str, str]) -> np.ndarray:
    have, want = results.channel("time").unit, reference.channel("time").unit
    if not have or not want or have == want:
        return results.time
    factor = unit_factor(have, want)
    if factor is None:
        raise Mismatch(f"the time is in {have}, in the reference in {want}")
    changed[have] = want
    return results.time * factor


def _listed(names: list[str]) -> str:
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return ", ".join(names[:MOST_NAMED]) + more

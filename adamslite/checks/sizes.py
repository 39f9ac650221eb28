"""The rule about expressions that are too large once the VARIABLEs in them are written out."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import TypeAlias

from adamslite.deck.deck import Deck
from adamslite.kernels.columns import LARGEST, MOST_IN_ALL
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Node, Ref, walk
from adamslite.language.statement import expressions
from adamslite.model.cycles import behind_others

COPIES = 2
"""How often a VARIABLE is written out in a statement: for its value, and for rates of it."""
Own: TypeAlias = tuple[str, object]
"""Keyword and id of a statement."""
Counts: TypeAlias = dict[Own, tuple[int, list[Own]]]


def expressions_too_large(deck: Deck) -> Iterator[Diagnostic]:
    """Statements of more operations than kernels are made of, and decks of more than that.

    What statements are at most, from sums along what they take, decides whether they are bound to
    be counted; a text of fewer characters than operations is not looked at.
    """
    if COPIES * len(deck.source.text) <= LARGEST:
        return
    counts = _counts(deck)
    if not _may_be_too_large(_sizes(counts)):
        return
    from adamslite.kernels.collecting import refused
    from adamslite.model.model import Model

    model = Model(deck)
    signals = {("VARIABLE", each.key) for each in model.signals}
    if not signals or _may_be_too_large(_sizes(counts, signals)):
        found = refused(model)
        if found is not None and found.code in ("expression-too-large", "deck-too-large"):
            yield found


def _may_be_too_large(sizes: Collection[int]) -> bool:
    return COPIES * max(sizes, default=0) > LARGEST or COPIES * sum(sizes) > MOST_IN_ALL


def _counts(deck: Deck) -> Counts:
    """Operations of each statement by itself, and what is written out in it."""
    found: Counts = {}
    for statement in deck.statements:
        nodes = [node for each in expressions(statement) for node in walk(each)]
        if nodes:
            found[statement.keyword, statement.key] = len(nodes), _measured(nodes)
    return found


def _sizes(counts: Counts, signals: Collection[Own] = ()) -> Collection[int]:
    """Operations of each statement with all that is written out in it, or more; each of these
    counts as often as it is taken.  Of ``signals`` the value alone is taken.
    """
    sizes: dict[Own, int] = {}
    for key in behind_others(counts, lambda each: [k for k in counts[each][1] if k in counts]):
        own, taken = counts[key]
        others = sum(1 if each in signals else sizes.get(each, 0) for each in taken)
        sizes[key] = min(own + others, LARGEST + 1)
    return sizes.values()


def _measured(nodes: list[Node]) -> list[Own]:
    """What is written out for expressions: VARIABLEs, and elements that are measured."""
    return [(each.kind, each.id) for each in nodes if type(each) is Ref and each.kind != "MARKER"]

"""The rule about expressions that are too large once the VARIABLEs in them are written out."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from adamslite.deck.deck import Deck
from adamslite.kernels.columns import LARGEST, MOST_IN_ALL
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Node, Ref, walk
from adamslite.language.statement import expressions
from adamslite.model.cycles import behind_others

COPIES = 2
"""How often a VARIABLE is written out in a statement: for its value, and for rates of it."""
Own = tuple[str, object]
"""Keyword and id of a statement."""


def expressions_too_large(deck: Deck) -> Iterator[Diagnostic]:
    """Statements of more operations than kernels are made of, and decks of more than that.

    What statements are at most, from sums along what they take, decides whether they are bound to
    be counted; a text of fewer characters than operations is not looked at.
    """
    if COPIES * len(deck.source.text) <= LARGEST:
        return
    if not _may_be_too_large(_sizes(deck)):
        return
    from adamslite.kernels.collecting import refused
    from adamslite.model.model import Model

    model = Model(deck)
    signals = {("VARIABLE", each.key) for each in model.signals}
    if not signals or _may_be_too_large(_sizes(deck, signals)):
        found = refused(model)
        if found is not None and found.code in ("expression-too-large", "deck-too-large"):
            yield found


def _may_be_too_large(sizes: Collection[int]) -> bool:
    return COPIES * max(sizes, default=0) > LARGEST or COPIES * sum(sizes) > MOST_IN_ALL


def _sizes(deck: Deck, signals: Collection[Own] = ()) -> Collection[int]:
    """Operations of each statement with all that is written out in it, or more; each of these
    counts as often as it is taken.  Of ``signals`` the value alone is taken.
    """
    own: dict[Own, int] = {}
    taken: dict[Own, list[Own]] = {}
    for statement in deck.statements:
        found = [node for each in expressions(statement) for node in walk(each)]
        if found:
            key: Own = (statement.keyword, statement.key)
            own[key] = len(found)
            taken[key] = _measured(found)
    sizes: dict[Own, int] = {}
    for key in behind_others(own, lambda each: [k for k in taken[each] if k in own]):
        others = sum(1 if each in signals else sizes.get(each, 0) for each in taken[key])
        sizes[key] = min(own[key] + others, LARGEST + 1)
    return sizes.values()


def _measured(nodes: list[Node]) -> list[Own]:
    """What is written out for expressions: VARIABLEs, and elements that are measured."""
    return [(each.kind, each.id) for each in nodes if type(each) is Ref and each.kind != "MARKER"]

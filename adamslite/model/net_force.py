"""The net force of all elements at a marker: the functions FM, FX ... TZ.

    FX(i, j, k) = sum of  NAME(id, 0 or 1, 2, k)  over the elements NAME/id between i and j

Without j every force and constraint that acts at i counts.  An element counts when its own I or J
marker (its JFLOAT, the markers of the joint a MOTION drives) *is* marker i.
Source: Adams/Solver C++ functions FX, TX; the value is the force on marker i, along the axes of k.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from adamslite.elements.gcon import Gcon
from adamslite.elements.joint import Joint
from adamslite.language.expression import GROUND_FRAME, Call, Num, Op, Ref, measure
from adamslite.language.interfaces import DrawnModel

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Statement


class WithDeck(DrawnModel, Protocol):
    """The model and the deck it is made from."""

    @property
    def deck(self) -> Deck: ...


def written_out(call: Call, model: WithDeck) -> Node | None:
    """One of the functions of the net force as a sum of the elements' own; None of others."""
    from adamslite.functions.forces import NET

    if call.name not in NET:
        return None
    if call.name == "NFORCE":
        return _of_nforce(call, model)

    i, j, k = (*(ref.id for ref in call.args if isinstance(ref, Ref)), 0)[:3]
    return component_of(NET[call.name], lambda n: _sum_of(model, i, j, n, k))


def component_of(number: int, along: Callable[[int], Node]) -> Node:
    """One of three components, or (numbers 1 and 5) the size of what they are of."""
    if number not in (1, 5):
        return along(number)
    parts = [along(number + n) for n in (1, 2, 3)]
    return Call("SQRT", (total([Op("*", (c, c)) for c in parts]),))


def _of_nforce(call: Call, model: WithDeck) -> Node:
    """The load on one marker of an NFORCE, of all the FIELDs it is made of."""
    own, at, component, axes = call.args
    assert isinstance(own, Ref) and isinstance(at, Ref) and isinstance(axes, Ref)
    assert isinstance(component, Num)
    fields = model.deck.parts(model.element(own.kind, own.id))

    def along(number: int) -> Node:
        return total(
            [
                measure("FIELD", Ref("FIELD", each.key), number, axes, jflag)
                for each in fields
                for jflag, end in enumerate(ends(model.deck, each))
                if end == at.id
            ]
        )

    return component_of(int(component.value), along)


def _sum_of(model: WithDeck, i: Key, j: Key, component: int, k: Key) -> Node:
    from adamslite.functions.forces import MEASURES

    axes = Ref("MARKER", k) if k else GROUND_FRAME
    return total(
        [
            measure(MEASURES[s.keyword], Ref(s.keyword, s.key), component, axes, jflag)
            for s in model.deck.statements
            if s.keyword in MEASURES
            for jflag in _flags(model, s, i, j)
        ]
    )


def ends(deck: Deck, element: Statement) -> tuple[Key | None, Key | None]:
    """The I and J markers of an element, or of the joint it drives."""
    joint = getattr(element, "joint", None)
    if joint is not None:
        return ends(deck, deck.get(Joint, joint))
    floating = getattr(element, "ifloat", None), getattr(element, "jfloat", None)
    fixed = getattr(element, "i", None), getattr(element, "j", None)
    i, j = (f if f is not None else m for f, m in zip(floating, fixed, strict=True))
    return i, j


def _flags(model: WithDeck, element: Statement, i: Key, j: Key) -> list[int]:
    if isinstance(element, Gcon):
        return element.flags(model, i, j)
    found = ends(model.deck, element)
    return [n for n in (0, 1) if found[n] == i and (j == 0 or found[1 - n] == j)]


def total(terms: list[Node]) -> Node:
    """The sum of terms, 0 of none."""
    result = terms[0] if terms else Num(0.0)
    for term in terms[1:]:
        result = Op("+", (result, term))
    return result

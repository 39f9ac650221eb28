"""VARIABLEs that are made of many others, and those of them that are solved for.

    v_1 = f_1(q)     v_2 = f_2(v_1)     ...     v_n = f_n(v_(n-1))

A statement is evaluated with all VARIABLEs that are written out in it.  Where n forces each take
another link, that is n^2 / 2 functions, and their derivatives by as many unknowns.  With each link
an unknown of its own, v_k - f_k(v_(k-1)) = 0, there are n functions, and a matrix that is as sparse
as the chain.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterator
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from adamslite.language.expression import Ref, walk
from adamslite.language.statement import Statement, expressions
from adamslite.model.cycles import behind_others

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import Key

SHORT = 8
"""VARIABLEs that a statement may be made of and have a kernel of its own, which it shares with all
statements of that shape.
"""
MOST_WRITTEN = 60_000
"""Operations that statements which take links of the same chains may write out all together, each
with its derivatives by what the statement measures; compiling these takes some seconds.
"""


class WithVariables(Protocol):
    """What is asked of :class:`adamslite.model.model.Model`."""

    deck: Deck

    @property
    def uses(self) -> dict[Key, set[Key]]: ...
    def used_in(self, node: Node) -> Iterator[Key]: ...
    def constant_variable(self, variable_id: Key) -> float | None: ...
    def variable(self, variable_id: Key) -> Any: ...


def long_chains(uses: dict[Key, set[Key]], others: Container[Key]) -> set[Key]:
    """VARIABLEs with more than a few others in them; ``others`` are not written out."""
    inline = behind_others(uses, uses.__getitem__, others)
    found: set[Key] = set()
    below: dict[Key, set[Key]] = {}
    """Of those that are not long all that is written out in them, themselves too."""
    for key in inline if len(inline) > SHORT else ():
        used = {each for each in uses[key] if each not in others}
        below[key] = {key}.union(*(below[each] for each in used - found))
        if len(below[key]) > SHORT or not found.isdisjoint(used):
            found.add(key)
    return found


class Joined:
    """Sets of keys that are joined where they meet."""

    def __init__(self) -> None:
        self._above: dict[Key, Key] = {}

    def name(self, key: Key) -> Key:
        """One of the set of a key, the same for all of them."""
        above = self._above
        while (up := above.setdefault(key, key)) != key:
            above[key] = key = above[up]
        return key

    def join(self, first: Key, *others: Key) -> None:
        """Make one set of the sets of some keys."""
        for each in others:
            self._above[self.name(each)] = self.name(first)


def crowded(model: WithVariables, loops: set[Key], signals: set[Key]) -> set[Key]:
    """Links of long chains that several statements or VARIABLEs take, of chains of which all
    statements together would write out too much, beside what is solved for (``loops``) and what
    depends on time only (``signals``).

    What is left of a chain between two of them is written out in one place.  Statements count
    whether or not they are switched on: a command does not change what is solved for.
    """
    fixed = {key for key in model.uses if model.constant_variable(key) is not None}
    others = loops | signals | fixed
    long = long_chains(model.uses, others)
    if not long:
        return set()
    joined = Joined()
    for key in long:
        joined.join(key, *(long & model.uses[key]))
    together = [*_taken_together(model, long, loops)]
    for taken in together:
        joined.join(*taken)
    of_chain: dict[Key, list[tuple[Key, ...]]] = {}
    for taken in together:
        of_chain.setdefault(joined.name(taken[0]), []).append(taken)
    full = {name for name, found in of_chain.items() if _is_too_much(model, found, others)}
    takers = Counter(chain(*together, *(long & direct for direct in model.uses.values())))
    return {key for key in long if takers[key] > 1 and joined.name(key) in full}


def _taken_together(
    model: WithVariables, long: set[Key], loops: set[Key]
) -> Iterator[tuple[Key, ...]]:
    """The long chains that each statement which acts on the motion takes the values of."""
    for statement in model.deck.statements:
        if _is_evaluated(statement, loops):
            nodes = expressions(statement)
            taken = dict.fromkeys(key for node in nodes for key in model.used_in(node))
            if found := tuple([key for key in taken if key in long]):
                yield found


def _is_evaluated(statement: Statement, loops: set[Key]) -> bool:
    """Whether it has a kernel of values and their derivatives in which VARIABLEs are written out;
    constraints write out those that are solved for, too.
    """
    if statement.keyword == "VARIABLE":
        return statement.key in loops
    return any(hasattr(statement, face) for face in ("loads", "equation", "relation"))


def _is_too_much(model: WithVariables, found: list[tuple[Key, ...]], others: set[Key]) -> bool:
    """Whether statements that take these VARIABLEs write out more operations than they may.

    An operation counts for itself and for each marker or element that the statement measures.
    Statements of equal size are of one shape, and counted once, or few; the largest of all is
    written out in any case.
    """
    sizes: set[tuple[int, int]] = set()
    own: dict[Key, _Own] = {}
    total = largest = 0
    for taken in dict.fromkeys(found):
        links = behind_others(taken, model.uses.__getitem__, others)
        for key in links:
            if key not in own:
                own[key] = _own(model, key)
        measured = set[Ref]().union(*(own[key].measured for key in links))
        size = sum(own[key].operations for key in links), 1 + len(measured)
        if size not in sizes:
            total += size[0] * size[1]
            largest = max(largest, size[0] * size[1])
        sizes.add(size)
        if total - largest > MOST_WRITTEN:
            return True
    return False


class _Own(NamedTuple):
    """Of a VARIABLE by itself: numbers, operations and calls; markers and elements it measures."""

    operations: int
    measured: set[Ref]


def _own(model: WithVariables, key: Key) -> _Own:
    nodes = [*walk(model.variable(key).function)]
    refs = {each for each in nodes if isinstance(each, Ref)}
    count = sum(not isinstance(each, Ref) for each in nodes)
    return _Own(count, {each for each in refs if each.kind != "VARIABLE"})

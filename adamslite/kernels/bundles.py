"""Results that are made of the same long chains of VARIABLEs: one kernel writes all of them.

    v_1 = f_1(q)     v_2 = f_2(v_1)     ...     v_n = f_n(v_(n-1))

A statement is evaluated with all VARIABLEs that are written out in it.  A kernel for each result
would evaluate v_1 in each of them, n^2 / 2 functions; a kernel of all evaluates n.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from adamslite.kernels.groups import Bundle
from adamslite.model.cycles import behind_others

if TYPE_CHECKING:
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Statement
    from adamslite.model.model import Model

SHORT = 8
"""VARIABLEs that a result may be made of and have a kernel of its own, which it shares with all
results of that shape.
"""


def bundles(model: Model, writing: Iterable[Statement]) -> list[Bundle]:
    """Those of the statements that share a VARIABLE that is made of more than a few others."""
    long = _long(model)
    if not long:
        return []
    joined = _Joined()
    for key in long:
        joined.join(key, *(long & model.uses[key]))
    of_chains: dict[Key, list[Statement]] = {}
    for statement in writing:
        found = [key for key in _taken(model, statement) if key in long]
        if found:
            joined.join(*found)
            of_chains.setdefault(found[0], []).append(statement)
    together: dict[Key, list[Statement]] = {}
    for key, statements in of_chains.items():
        together.setdefault(joined.name(key), []).extend(statements)
    return [Bundle(tuple(each)) for each in together.values() if len(each) > 1]


def _taken(model: Model, statement: Statement) -> Iterator[Key]:
    """The VARIABLEs that the results of a statement take the values of."""
    if model.acts(statement):
        for node in model.outputs_of(statement):
            yield from model.used_in(node)


def _long(model: Model) -> set[Key]:
    """VARIABLEs that are written out where they are used, with more than a few others in them."""
    others = {key for key in model.uses if model.variable_kind(key) != "inline"}
    inline = behind_others(model.uses, model.uses.__getitem__, others)
    found: set[Key] = set()
    below: dict[Key, set[Key]] = {}
    """Of those that are not long all that is written out in them, themselves too."""
    for key in inline if len(inline) > SHORT else ():
        used = model.uses[key] - others
        below[key] = {key}.union(*(below[each] for each in used - found))
        if len(below[key]) > SHORT or not found.isdisjoint(used):
            found.add(key)
    return found


class _Joined:
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

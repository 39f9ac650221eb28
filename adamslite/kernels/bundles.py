"""Results that are made of the same long chains of VARIABLEs: one kernel writes all of them.

    v_1 = f_1(q)     v_2 = f_2(v_1)     ...     v_n = f_n(v_(n-1))

A statement is evaluated with all VARIABLEs that are written out in it.  A kernel for each result
would evaluate v_1 in each of them, n^2 / 2 functions; a kernel of all evaluates n.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from adamslite.kernels.groups import Bundle
from adamslite.model.chains import Joined, long_chains

if TYPE_CHECKING:
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Statement
    from adamslite.model.model import Model


def bundles(model: Model, writing: Iterable[Statement]) -> list[Bundle]:
    """Those of the statements that share a VARIABLE that is made of more than a few others."""
    others = {key for key in model.uses if model.variable_kind(key) != "inline"}
    long = long_chains(model.uses, others)
    if not long:
        return []
    joined = Joined()
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

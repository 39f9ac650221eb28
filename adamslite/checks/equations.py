"""Rules about equations that cannot be formed: rates that do not exist, forces of themselves."""

from __future__ import annotations

from collections.abc import Iterator

from adamslite.deck.deck import Deck
from adamslite.elements.variable import Variable
from adamslite.functions.forces import MEASURES, NET
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Call, Mode, Node, Ref, calls, walk
from adamslite.language.interfaces import Key
from adamslite.language.statement import Statement, expressions
from adamslite.model.cycles import behind_others

# Functions without a rate, or with one that depends on what they measure.
RATELESS = (
    "VARVAL", "DIF", "DIF1", "ACCM", "ACCX", "ACCY", "ACCZ", "WDTM", "WDTX", "WDTY", "WDTZ",
)  # fmt: skip
PLACES = ("DM", "DX", "DY", "DZ", "AX", "AY", "AZ")
# What they name is solved for.
PORTS = ("PINPUT", "POUTPUT")
# What statements may call without being formed: with and without constraint rows, with and without
# loads.
SUSPICIOUS = {
    (rows, loads): ("DDT", *RATELESS * rows, *(*MEASURES.values(), *NET) * loads)
    for rows in (False, True)
    for loads in (False, True)
}


def unformed_equations(deck: Deck) -> Iterator[Diagnostic]:
    """Forces that depend on themselves, rates of what has none."""
    known: dict[Key, bool] = {}
    suspects = [each for each in deck.statements if _is_suspect(deck, each, known)]
    if suspects:
        from adamslite.kernels.compile import unformed
        from adamslite.model.model import Model

        yield from unformed(Model(deck), suspects)


def _is_suspect(deck: Deck, statement: Statement, known: dict[Key, bool]) -> bool:
    """Whether it takes rates of more than places and TIME, or measures forces with forces."""
    loads = hasattr(statement, "loads") or statement.keyword == "GCON"
    names = SUSPICIOUS[hasattr(statement, "constraints"), loads]
    if statement.called.isdisjoint(names):
        return False
    found = (call for node in expressions(statement) for call in calls(node, *names))
    return not all(call.name == "VARVAL" and _has_rates(deck, call, known) for call in found)


def _has_rates(deck: Deck, node: Node, known: dict[Key, bool]) -> bool:
    """Whether it depends on places and TIME alone, directly or by VARIABLEs that are not solved
    for; ``known``: which of these do.
    """
    return not any(
        isinstance(each, Mode)
        or (isinstance(each, Ref) and each.kind not in ("MARKER", "VARIABLE"))
        or (isinstance(each, Ref) and each.kind == "VARIABLE" and not _is_plain(deck, each, known))
        or (isinstance(each, Call) and each.name not in PLACES and _asks_markers(each))
        for each in walk(node)
    )


def _asks_markers(call: Call) -> bool:
    return any(isinstance(each, Ref) and each.kind == "MARKER" for each in call.args)


def _is_plain(deck: Deck, ref: Ref, known: dict[Key, bool]) -> bool:
    """Whether a VARIABLE is put in where it is used, and has rates."""
    if ref.id not in known:  # each behind those it is made of: no recursion of the depth of a chain
        found = behind_others([ref.id], lambda key: _taken(deck, key), known)
        known.update(dict.fromkeys(found, False))  # what comes back to it depends on itself
        for key in found:
            variable = deck.find(Variable, key)
            solved = any(key in port.variables for w in PORTS for port in deck.of(w))
            if variable is not None and not solved:
                known[key] = _has_rates(deck, variable.function, known)
    return known[ref.id]


def _taken(deck: Deck, key: Key) -> list[Key]:
    """The VARIABLEs in the FUNCTION of one."""
    variable = deck.find(Variable, key)
    found = walk(variable.function) if variable is not None else ()
    return [each.id for each in found if isinstance(each, Ref) and each.kind == "VARIABLE"]

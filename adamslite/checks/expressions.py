"""Rules about expressions: what cannot be formed, sizes, D between a number and a sign."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from typing import TypeAlias

from adamslite.deck.deck import Deck
from adamslite.deck.names import to_number
from adamslite.deck.statement_diagnostics import diagnose_within
from adamslite.elements.variable import Variable
from adamslite.functions.forces import MEASURES, NET
from adamslite.kernels.columns import LARGEST, MOST_IN_ALL
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Call, Mode, Node, Ref, calls, walk
from adamslite.language.interfaces import Key
from adamslite.language.statement import Statement, expressions
from adamslite.model.cycles import behind_others
from adamslite.syntax.tokens import scan

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


# The letter comes first: few texts have many of them, and all have digits.
SIGNED = re.compile(r"[Dd][+-](?<=[\d.][Dd][+-])\d")


def exponents_or_degrees(deck: Deck) -> Iterator[Diagnostic]:
    """Powers of ten with D in expressions, where 90D+2 may be meant as degrees and a sum."""
    sources = {id(each.spans.source): each.spans.source for each in deck.statements}
    if not any(source and SIGNED.search(source.text) for source in sources.values()):
        return
    for each in deck.own:  # what a statement brings along has its places
        for field in each.spans:
            if each.arguments[field].kind == "expression":
                yield from _inside(each, field)


def _inside(statement: Statement, field: str) -> Iterator[Diagnostic]:
    text = statement.spans.home(field).text(field)
    if not SIGNED.search(text):
        return
    for kind, word, at in (token for stretch in scan(text) for token in stretch):
        if kind == "NUMBER" and SIGNED.search(word):
            power = word.upper().replace("D", "E")
            words = {"text": word, "value": to_number(word), "power": power}
            place = at, at + len(word)
            yield diagnose_within(statement, field, place, "exponent-or-degrees", **words)
            return

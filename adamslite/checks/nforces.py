"""Rules about NFORCE and the function that measures it."""

from __future__ import annotations

from collections.abc import Iterator

from adamslite.checks.rule import Rule
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.matrix import Matrix
from adamslite.elements.nforce import WIDTH, Nforce
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Call, Ref, calls
from adamslite.language.statement import Statement


def connected_markers(deck: Deck) -> Iterator[Diagnostic]:
    """Markers of an NFORCE, J among them, that are given twice."""
    for each in deck.of(Nforce):
        markers = [*each.imarkers, each.j]
        twice = next((m for n, m in enumerate(markers) if m in markers[:n]), None)
        if twice is not None:
            yield diagnose(each, "marker-twice", "imarkers", key=twice)


def sizes(deck: Deck) -> Iterator[Diagnostic]:
    """Whether the matrices have six rows, or columns, for each marker."""
    for each in deck.of(Nforce):
        n = WIDTH * len(each.imarkers)
        needed = {"kmatrix": (n, n), "cmatrix": (n, n), "length": (n, 1), "force": (n, 1)}
        for field, (rows, columns) in needed.items():
            key = getattr(each, field)
            matrix = None if key is None else deck.find(Matrix, key)
            if matrix and matrix.complete and (matrix.rows, matrix.columns) != (rows, columns):
                yield diagnose(
                    each, "nforce-matrix", field, word=field.upper(), matrix=matrix.label,
                    size=f"{matrix.rows} x {matrix.columns}", needed=f"{rows} x {columns}",
                )  # fmt: skip
        if each.given("cmatrix") and each.cratio is not None:
            reason = "CRATIO gives the damping"
            yield diagnose(each, "no-effect", "cmatrix", word="CMATRIX", reason=reason)


def measured_markers(deck: Deck) -> Iterator[Diagnostic]:
    """Whether NFORCE(id, marker, ...) measures at one of its markers."""
    for statement in deck.statements if deck.of(Nforce) else ():
        for field, argument in statement.arguments.items():
            node = getattr(statement, field) if argument.kind == "expression" else None
            for call in calls(node, "NFORCE") if node is not None else ():
                yield from _foreign(deck, statement, field, call)


def _foreign(deck: Deck, statement: Statement, field: str, call: Call) -> Iterator[Diagnostic]:
    own, at, *_ = call.args
    assert isinstance(own, Ref) and isinstance(at, Ref)
    nforce = deck.find(Nforce, own.id)
    if nforce and at.id not in (*nforce.imarkers, nforce.j):
        listed = ", ".join(map(str, (*nforce.imarkers, nforce.j)))
        words = {"nforce": nforce.label, "key": str(at.id), "listed": listed}
        yield diagnose(statement, "nforce-marker", field, **words)


NFORCE_RULES: list[Rule] = [connected_markers, sizes, measured_markers]

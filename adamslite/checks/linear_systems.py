"""Rules about LSE, TFSISO and GSE, and the ARRAYs and MATRIXes that they name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import Any

from adamslite.checks.rule import Rule, needs
from adamslite.deck.brought import MOST
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Redefinition
from adamslite.deck.statement_diagnostics import diagnose, diagnose_inside
from adamslite.elements.array import Array
from adamslite.elements.bases.linear_system import LinearSystem
from adamslite.elements.bases.system_element import SystemElement, value_name
from adamslite.elements.gse import Gse
from adamslite.elements.lse import Lse
from adamslite.elements.matrix import Matrix
from adamslite.elements.simulate import Simulate
from adamslite.elements.tfsiso import Tfsiso, degree
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Num, Ref, walk
from adamslite.language.interfaces import Key
from adamslite.language.routines import is_user_call
from adamslite.language.statement import Statement, expressions

# Singular values of a scaled matrix below this are round-off.
RANK = 1e-12
OWNED = ("X", "Y")
PARTNERS = {
    "b": (("u",), "B takes the inputs u"),
    "c": (("y",), "C makes the outputs y"),
    "d": (("u", "y"), "D leads from the inputs u to the outputs y"),
}


def linear_systems(deck: Deck) -> Iterator[LinearSystem]:
    """The linear systems of a deck."""
    yield from deck.of(Lse)
    yield from deck.of(Tfsiso)


def systems(deck: Deck) -> Iterator[SystemElement]:
    """All elements with ARRAYs of states and outputs."""
    yield from linear_systems(deck)
    yield from deck.of(Gse)


def _array(deck: Deck, system: SystemElement, field: str) -> Array | None:
    key = getattr(system, field)
    return None if key is None else deck.find(Array, key)


def arrays_of_systems(deck: Deck) -> Iterator[Diagnostic]:
    """Whether arrays are of the kinds that they are used as, and belong to one system only."""
    owners: dict[Key, str] = {}
    for system in systems(deck):
        for field, kind in system.kinds.items():
            array = _array(deck, system, field)
            if array is None:
                continue
            label = array.label
            if array.kind != kind:
                words = {"word": field.upper(), "array": label, "needed": kind, "kind": array.kind}
                yield diagnose(system, "array-kind", field, "", **words)
            elif kind in OWNED and array.key in owners:
                first = owners[array.key]
                yield diagnose(system, "array-owners", field, array=label, first=first)
            else:
                owners[array.key] = system.label


def partners(deck: Deck) -> Iterator[Diagnostic]:
    """Matrices without the arrays that they work on, and arrays that no matrix works on."""
    for system in deck.of(Lse):
        used: set[str] = set()
        for field in sorted(system.named.keys() & PARTNERS.keys()):
            arrays, reason = PARTNERS[field]
            used.update(arrays)
            for other in arrays:
                if getattr(system, other) is None:
                    yield _part(system, field, other.upper(), reason)
        for field, other in (("u", "B or D"), ("y", "C or D")):
            if getattr(system, field) is not None and field not in used:
                yield _part(system, field, other, "give it, or leave the ARRAY out")


def _part(system: SystemElement, field: str, other: str, hint: str) -> Diagnostic:
    return diagnose(system, "system-part", field, hint, word=field.upper(), other=other)


def sizes_of_matrices(deck: Deck) -> Iterator[Diagnostic]:
    """A (n, n), B (n, m), C (p, n), D (p, m) and the ARRAYs of n states, m inputs, p outputs."""
    for system in deck.of(Lse):
        known = {field: deck.find(Matrix, key) for field, key in system.named.items()}
        found = {field: each for field, each in known.items() if each and each.complete}
        if "a" in found and len(found) == len(known):
            yield from _shapes(deck, system, found)


def _shapes(deck: Deck, system: Lse, found: dict[str, Matrix]) -> Iterator[Diagnostic]:
    n = found["a"].rows
    inputs, making = _array(deck, system, "u"), found.get("c") or found.get("d")
    m = len(inputs.variables) if inputs is not None else None
    p = making.rows if making is not None else None
    shapes = {"a": (n, n), "b": (n, m), "c": (p, n), "d": (p, m)}
    for field, matrix in found.items():
        rows, columns = shapes[field]
        needed = rows or matrix.rows, columns or matrix.columns
        if (matrix.rows, matrix.columns) != needed:
            yield diagnose(
                system, "system-matrix", field, word=field.upper(), matrix=matrix.label,
                size=_product(matrix.rows, matrix.columns), needed=_product(*needed),
            )  # fmt: skip
    yield from _array_sizes(deck, system, n, p)


def _product(rows: int, columns: int) -> str:
    return f"{rows} x {columns}"


def sizes_of_filters(deck: Deck) -> Iterator[Diagnostic]:
    """One input, one output, a state for each power."""
    for system in deck.of(Tfsiso):
        inputs = _array(deck, system, "u")
        if inputs is not None and len(inputs.variables) > 1:
            yield _length(system, inputs, "u", len(inputs.variables), "VARIABLES", 1)
        if system.denominator:  # else it is reported as missing
            yield from _array_sizes(deck, system, len(system.denominator) - 1, 1)


def _array_sizes(
    deck: Deck, system: SystemElement, states: int, outputs: int | None, more: int = 0
) -> Iterator[Diagnostic]:
    counts = {"x": states, "y": outputs, "xd": more}
    for field, kind in system.kinds.items():
        array, count = _array(deck, system, field), counts.get(field)
        if array is None or array.size is None or count is None or kind not in OWNED:
            continue
        if array.size != count:
            yield _length(system, array, field, array.size, "values", count)
    for field, start in system.starts.items():
        array, count = _array(deck, system, start), counts[field]
        if array is not None and array.kind == "IC" and len(array.numbers) not in (0, count):
            yield _length(system, array, start, len(array.numbers), "NUMBERS", count or 0)


def _length(
    system: SystemElement, array: Array, field: str, count: int, what: str, needed: int
) -> Diagnostic:
    return diagnose(
        system, "system-array", field, array=array.label, count=count, what=what, needed=needed
    )


def polynomials(deck: Deck) -> Iterator[Diagnostic]:
    for system in deck.of(Tfsiso):
        if not (system.numerator and system.denominator):
            continue  # reported as missing
        below, above = len(system.denominator) - 1, degree(system.numerator)
        if system.denominator[-1] == 0.0:
            yield diagnose(system, "no-leading-coefficient", "denominator")
        elif below == 0:
            yield diagnose(system, "no-states", "denominator")
        elif above > below:
            yield diagnose(system, "improper-fraction", "numerator", above=above, below=below)


GSE_PARTS = {"ns": ("x",), "no": ("y",), "nd": ("xd",)}


def routine_systems(deck: Deck) -> Iterator[Diagnostic]:
    """Whether a GSE has the ARRAYs of its states and outputs, and a routine."""
    for system in deck.of(Gse):
        for field, others in GSE_PARTS.items():
            count = getattr(system, field)
            if count < 0:
                yield diagnose(system, "negative", field, word=field.upper())
            for other in others:
                there = getattr(system, other) is not None
                if count > 0 and not there:
                    yield _part(system, field, other.upper(), f"{other.upper()} is missing")
                elif not count and there:
                    yield _part(system, other, field.upper(), f"{field.upper()} is missing")
        yield from _array_sizes(deck, system, system.ns, system.no, system.nd)
        if not is_user_call(system.function):
            yield diagnose(system, "no-routine", "function")


@needs("ARRAY", "GSE", "LSE", "MATRIX", "TFSISO")
def values_of_systems(deck: Deck) -> Iterator[Diagnostic]:
    """Whether states and outputs that expressions take from an ARRAY exist.

    Where SIZE is right the reader has seen to it.
    """
    counts = {array.key: 0 for array in deck.of(Array) if array.kind in OWNED}
    for system in systems(deck):
        found = system.counts(deck)
        if found is None:
            return  # another rule reports why
        arrays = {field: getattr(system, field) for field in found}
        counts |= {arrays[f]: n for f, n in found.items() if arrays[f] is not None}
    unsure = [array for array in deck.of(Array) if array.size != counts.get(array.key, array.size)]
    for statement in deck.statements if unsure else ():
        for field, array, number in _missing_values(deck, statement, unsure):
            words = {"array": array.label, "number": number, "count": str(counts[array.key])}
            yield diagnose_inside(statement, array.key, "system-value", field, **words)


def _missing_values(
    deck: Deck, statement: Statement, arrays: list[Array]
) -> Iterator[tuple[str, Array, str]]:
    """Field, array and number of each value that an expression takes and no system has."""
    for field, argument in statement.arguments.items():
        node = getattr(statement, field) if argument.kind == "expression" else None
        for each in walk(node) if node is not None else ():
            if not (isinstance(each, Ref) and isinstance(each.id, str)):
                continue
            if each.kind not in ("DIFF", "VARIABLE") or deck.find(each.kind, each.id) is not None:
                continue
            for array in arrays:
                number = each.id.removeprefix(value_name(array.key, 0)[:-1])
                if number.isdigit():
                    yield field, array, number


def determined_at_rest(deck: Deck, commands: Iterable[Statement] = ()) -> Iterator[Diagnostic]:
    """Systems of which statics cannot find the states from A x + B u = 0."""
    runs = chain(deck.of(Simulate), commands)
    if not any(isinstance(run, Simulate) and run.kind == "STATICS" for run in runs):
        return
    for system in linear_systems(deck):
        looked_at = not system.static_hold and system not in deck.overfull
        found = system.matrices(deck) if looked_at else None
        if found is None or not found.a:  # of a matrix that is not read
            continue
        n = len(found.a)
        if any(len(row) != n for row in found.a) or len(found.b) not in (0, n):
            continue
        of_inputs = found.b or [()] * n
        both = [(*row, *of_u) for row, of_u in zip(found.a, of_inputs, strict=True)]
        field = "a" if isinstance(system, Lse) else "denominator"
        if _rank(both) < n:
            yield diagnose(system, "no-rest", field)
        elif _rank(found.a) < n:
            yield diagnose(system, "rest-by-input", field)


def _rank(rows: Sequence[Sequence[float]]) -> int:
    """Rank of a matrix after its rows and then its columns are scaled to a largest element of 1."""
    import numpy as np

    table = np.array(rows, dtype=float)
    for axis in (1, 0):
        largest = np.abs(table).max(axis=axis, keepdims=True)
        table = table / np.where(largest > 0.0, largest, 1.0)
    values = np.linalg.svd(table, compute_uv=False)
    return int((values > RANK).sum())


def late_start_numbers(deck: Deck, command: Redefinition[Any]) -> Iterator[Diagnostic]:
    """Start values of a system that has already moved, in an ARRAY that nothing else uses."""
    if command.of is not Array or "numbers" not in command.changes:
        return
    for system in systems(deck):
        starts = {getattr(system, field) for field in system.starts.values()}
        if command.key in starts and not _takes(deck, f"ARYVAL({command.key},"):
            reason = f"{system.label} continues from the state that it has reached"
            yield diagnose(command, "no-effect", "numbers", word="NUMBERS", reason=reason)


def _takes(deck: Deck, beginning: str) -> bool:
    """Whether an expression has a number with a name that begins so."""
    return any(
        isinstance(each, Num) and each.name.startswith(beginning)
        for statement in deck.statements
        for node in expressions(statement)
        for each in walk(node)
    )


def too_much(deck: Deck) -> Iterator[Diagnostic]:
    """Statements that would bring more others than there is room for."""
    for each in deck.overfull:
        yield diagnose(each, "brings-too-much", most=MOST)


SYSTEM_RULES: list[Rule] = [
    too_much,
    arrays_of_systems,
    partners,
    sizes_of_matrices,
    sizes_of_filters,
    polynomials,
    routine_systems,
    values_of_systems,
    determined_at_rest,
]

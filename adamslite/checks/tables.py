"""Rules about SPLINEs, ARRAYs, MATRIXes and the functions that use them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from math import dist, isfinite

from adamslite.checks.rule import Rule, positive
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose, diagnose_inside
from adamslite.elements.array import Array
from adamslite.elements.bases.data_file import UnusableFile, columns
from adamslite.elements.curve import Curve
from adamslite.elements.matrix import MOST, Matrix
from adamslite.elements.spline import LEAST, Spline
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Call, Num, Ref, calls, fold, walk
from adamslite.language.statement import Statement, expressions

# Chords of the same length but for round-off and few digits.
EVEN = 1.01
FITS = ("AKISPL", "CUBSPL")
TAKEN = re.compile(r"ARYVAL\((.*),(\d+)\)")
"""The name of a constant of an ARRAY in an expression that has taken it."""


def spline_points(deck: Deck) -> Iterator[Diagnostic]:
    for spline in deck.of(Spline):
        if spline.file is not None:
            yield from _points_in_file(deck, spline)
        elif spline.x is None or not spline.y:
            word = "X" if spline.x is None else "Y"
            yield diagnose(spline, "missing-argument", word=word, hint="give X and Y, or FILE")
        else:
            yield from _points_given(spline, spline.x)


def _points_in_file(deck: Deck, spline: Spline) -> Iterator[Diagnostic]:
    if spline.x is not None or spline.y:
        yield diagnose(spline, "spline-sources", "file")
        return
    try:
        x, curves, _ = spline.points(deck.folder)
    except UnusableFile as fault:
        yield diagnose(spline, "data-file", "file", file=spline.file, reason=fault)
        return
    reason = "" if len(x) >= LEAST else f"it has {len(x)} rows, and {LEAST} are needed"
    if not all(map(isfinite, (*x, *curves[0]))):
        reason = "a value is not a number"
    if reason:
        yield diagnose(spline, "data-file", "file", file=spline.file, reason=reason)
    else:
        yield from _ascending(spline, "file", x)


def _points_given(spline: Spline, x: Sequence[float]) -> Iterator[Diagnostic]:
    for field in ("channel", "block"):
        if spline.given(field):
            reason = "it chooses among the columns of a FILE"
            yield diagnose(spline, "no-effect", field, word=field.upper(), reason=reason)
    yield from _ascending(spline, "x", x)
    expected = len(x) + spline.family
    wrong = [len(row) for row in spline.y if len(row) != expected]
    if wrong:
        yield diagnose(spline, "spline-length", "y", count=wrong[0], expected=expected)
    elif spline.family:
        yield from _ascending(spline, "y", [row[0] for row in spline.y])


def _ascending(spline: Spline, field: str, values: Sequence[float]) -> Iterator[Diagnostic]:
    """The first value that is not above the one before it."""
    word = {"x": "X", "y": "z", "file": "the first column"}[field]
    for low, high in zip(values, values[1:], strict=False):
        if not low < high:
            words = {"word": word, "low": f"{low:.10g}", "high": f"{high:.10g}"}
            yield diagnose(spline, "not-ascending", field, **words)
            return


def spline_calls(deck: Deck) -> Iterator[Diagnostic]:
    for statement in deck.statements if deck.of(Spline) else ():
        for field, argument in statement.arguments.items():
            node = getattr(statement, field) if argument.kind == "expression" else None
            for call in calls(node, *FITS, "INTERP") if node is not None else ():
                yield from _misfit(deck, statement, field, call)


def _misfit(deck: Deck, statement: Statement, field: str, call: Call) -> Iterator[Diagnostic]:
    """A family without its z, a single curve with one."""
    _, second, ref, order = call.args
    spline = deck.find(Spline, ref.id) if isinstance(ref, Ref) else None
    if spline is None:
        return
    words = {"word": call.name, "spline": spline.label}
    if spline.family and call.name == "INTERP":
        yield diagnose_inside(statement, call.name, "spline-family", field, **words)
    elif spline.family and isinstance(order, Num) and order.value:
        yield diagnose_inside(statement, call.name, "family-derivative", field, **words)
    elif not spline.family and call.name in FITS and fold(second) != 0.0:
        yield diagnose_inside(statement, call.name, "spline-curve", field, **words)


def curve_calls(deck: Deck) -> Iterator[Diagnostic]:
    """Where alpha runs over points that are not equally far apart, of which ADAMS says nothing."""
    for statement in deck.statements if deck.of(Curve) else ():
        for field, argument in statement.arguments.items():
            node = getattr(statement, field) if argument.kind == "expression" else None
            for call in calls(node, "CURVE") if node is not None else ():
                curve = deck.find(Curve, next(a.id for a in call.args if isinstance(a, Ref)))
                if curve is not None and _uneven(deck, curve):
                    words = {"curve": curve.label}
                    yield diagnose_inside(statement, call.name, "curve-uneven", field, **words)


def _uneven(deck: Deck, curve: Curve) -> bool:
    """Whether the chords of a curve through points differ in length."""
    matrix = None if curve.matrix is None else deck.find(Matrix, curve.matrix)
    if curve.points == "CONTROL_POINTS":
        return False
    if matrix is None or not matrix.complete or matrix.columns != 3:
        return False
    points = matrix.table
    chords = [dist(a, b) for a, b in zip(points, points[1:], strict=False)]
    return bool(chords) and max(chords) > EVEN * min(chords)


def arrays(deck: Deck) -> Iterator[Diagnostic]:
    for array in deck.of(Array):
        filled = {"IC": "numbers", "U": "variables"}.get(array.kind, "")
        for field in ("numbers", "variables"):
            word, count = field.upper(), len(getattr(array, field))
            if field == filled and not count:
                yield diagnose(array, "missing-argument", word=word)
            elif field != filled and count:
                reason = f"an ARRAY {array.kind} has none"
                yield diagnose(array, "no-effect", field, word=word, reason=reason)
            elif count and array.size not in (None, count):
                yield diagnose(array, "array-size", "size", size=array.size, count=count, word=word)


def values_of_arrays(deck: Deck) -> Iterator[Diagnostic]:
    """Whether what expressions have taken from an ARRAY is still there."""
    known = {f"{array.key}": len(array.numbers) for array in deck.of(Array) if array.numbers}
    for statement in deck.statements if known else ():
        for node in expressions(statement):
            for each in walk(node):
                taken = TAKEN.fullmatch(each.name) if isinstance(each, Num) else None
                if taken and int(taken[2]) > known.get(taken[1], 0):
                    yield diagnose(statement, "value-lost", word=taken[0])


def matrices(deck: Deck) -> Iterator[Diagnostic]:
    for matrix in deck.of(Matrix):
        wrong = list(positive(matrix, *filter(matrix.given, ("rows", "columns"))))
        yield from wrong or _elements(deck, matrix)


def _elements(deck: Deck, matrix: Matrix) -> Iterator[Diagnostic]:
    """Whether a matrix has all its elements, from one source, and its file can be read."""
    count, expected = len(matrix.values), matrix.expected
    missing = [field for field in ("rows", "columns", "values") if not matrix.given(field)]
    if matrix.file is not None:
        if matrix.given("values") or matrix.sparse:
            yield diagnose(matrix, "matrix-sources", "file", word="FILE")
            return
        try:
            columns(deck.folder, matrix.file)
        except UnusableFile as fault:
            yield diagnose(matrix, "data-file", "file", file=matrix.file, reason=fault)
            return
    elif matrix.sparse and matrix.given("full"):
        yield diagnose(matrix, "matrix-sources", "sparse", word="SPARSE")
    elif missing:
        yield diagnose(matrix, "missing-argument", word=missing[0].upper(), hint="")
    if count != expected and (count or not missing):
        yield diagnose(matrix, "matrix-size", "values", count=count, expected=expected)
    elif matrix.too_large:
        elements = matrix.rows * matrix.columns
        yield diagnose(matrix, "matrix-too-large", "rows", elements=elements, most=MOST)
    elif matrix.misplaced:
        yield diagnose(matrix, "matrix-place", "values", place=matrix.misplaced)


TABLE_RULES: list[Rule] = [
    spline_points, spline_calls, curve_calls, arrays, values_of_arrays, matrices,
]  # fmt: skip

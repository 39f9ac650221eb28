"""Rules about SPLINEs, ARRAYs and the functions that use them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from adamslite.checks.rule import Rule
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.array import Array
from adamslite.elements.spline import Spline
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Call, Num, Ref, calls, fold, walk
from adamslite.language.statement import Statement, expressions

FITS = ("AKISPL", "CUBSPL")


def spline_points(deck: Deck) -> Iterator[Diagnostic]:
    for spline in deck.of(Spline):
        if not spline.y:
            yield diagnose(spline, "missing-argument", word="Y", hint="Y: values at X")
        yield from _ascending(spline, "x", spline.x)
        counts = [len(row) for row in spline.y]
        expected = len(spline.x) + spline.family
        wrong = next((count for count in counts if count != expected), None)
        if wrong is not None:
            yield diagnose(spline, "spline-length", "y", count=wrong, expected=expected)
        elif spline.family:
            yield from _ascending(spline, "y", spline.places)


def _ascending(spline: Spline, field: str, values: Sequence[float]) -> Iterator[Diagnostic]:
    """The first value that is not above the one before it; z for those of ``y``."""
    for low, high in zip(values, values[1:], strict=False):
        if not low < high:
            word = "z" if field == "y" else "X"
            yield diagnose(
                spline, "not-ascending", field, word=word, low=f"{low:g}", high=f"{high:g}"
            )
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
    if spline.family and call.name == "INTERP":
        yield diagnose(statement, "spline-family", field, word=call.name, spline=spline.label)
    elif spline.family and isinstance(order, Num) and order.value:
        yield diagnose(statement, "family-derivative", field, word=call.name, spline=spline.label)
    elif not spline.family and call.name in FITS and fold(second) != 0.0:
        yield diagnose(statement, "spline-curve", field, word=call.name, spline=spline.label)


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
    known = {name for array in deck.of(Array) for name in array.constants()}
    for statement in deck.statements if known else ():
        for node in expressions(statement):
            for each in walk(node):
                lost = isinstance(each, Num) and each.name.startswith("ARYVAL")
                if lost and each.name not in known:
                    yield diagnose(statement, "value-lost", word=each.name)


TABLE_RULES: list[Rule] = [spline_points, spline_calls, arrays, values_of_arrays]

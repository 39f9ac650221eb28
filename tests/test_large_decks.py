"""A deck of thousands of statements takes little memory for each.

::

    POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
    MARKER/2, POINT_MASS=2
    SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-41.5*(DM(2,1)-1)-0.125*VR(2,1)
    ...                                              three statements for each of MASSES masses
"""

import gc
import pickle
import tracemalloc

import pytest

import adamslite as al
from adamslite.deck.redefinition import MergedSpans
from adamslite.kernels.groups import compact
from adamslite.language.diagnostics import Source, Spans

MASSES = 1500
READ, READING, BOUND = 1250, 2250, 300
"""Bytes per statement at most: of a deck, while it is read, and of its kernels."""


def deck(n: int) -> str:
    lines = ["A row of masses", "PART/1, GROUND", "MARKER/1, PART=1"]
    for a in range(2, n + 2):
        lines += [
            f"POINT_MASS/{a}, MASS=1, CM={a}, QG={a - 1},0,0", f"MARKER/{a}, POINT_MASS={a}",
            f"SFORCE/{a - 1}, TRANSLATIONAL, I={a}, J={a - 1}"
            f", FUNCTION=-41.5*(DM({a},{a - 1})-1)-0.125*VR({a},{a - 1})",
        ]  # fmt: skip
    return "\n".join([*lines, "END\n"])


def measured(work):
    """What work has made, and bytes that it keeps and that it took at most: the less of two times,
    for threads that other tests have left may allocate, too.
    """
    (made, *one), (_, *other) = once(work), once(work)
    return made, *map(min, one, other)


def once(work):
    gc.collect()
    tracemalloc.start()
    try:
        made = work()
        gc.collect()
        return made, *tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()


@pytest.mark.slow
def test_memory_of_a_deck_and_of_its_kernels():
    al.compile_model(al.assemble(al.read(deck(20))))  # compiles, imports
    text = deck(MASSES)
    read, kept, most = measured(lambda: al.read(text))
    count = len(read.statements)
    assert kept / count < READ and most / count < READING
    model = al.assemble(read)
    _, kept, _ = measured(lambda: al.compile_model(model))
    assert kept / count < BOUND


@pytest.mark.parametrize(
    "values, kind",
    [([1, 2], "q"), ([1.5, 2.0], "d"), ([1, 2.5], ""), ([1, 10**30], ""), (["A"], "")],
)
def test_columns_are_arrays_where_they_can_be(values, kind):
    found = compact(values)
    assert list(found) == values and getattr(found, "typecode", "") == kind


def test_places_are_kept_as_they_are():
    """Those of a statement, and of one that a later statement has changed."""
    source = Source("PART/1, MASS=2, CM=3\nPART/1, MASS=4\n")
    first = Spans(source, (0, 20), {"mass": (8, 14), "cm": (16, 20)})
    both = MergedSpans(first, Spans(source, (21, 35), {"mass": (29, 35)}), ())
    for spans in (first, both, MergedSpans(first, both, ("cm",)), Spans()):
        again = pickle.loads(pickle.dumps(spans))
        assert {name: str(span) for name, span in again.items()} == {
            name: str(span) for name, span in spans.items()
        }
        assert again.whole == spans.whole and type(again) is type(spans)
    assert [both.home(each).text(each) for each in both] == ["MASS=4", "CM=3"]
    assert first.ranges == {"mass": (8, 14), "cm": (16, 20)}
    with pytest.raises(KeyError):
        first["ip"]

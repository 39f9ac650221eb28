"""Records in native functions and in plain Python: the same fields, the same memory, and what is
refused.
"""

from __future__ import annotations

import re

import numpy as np
import pytest
from scenes import native_call

from adamslite.native.translate import (
    Ints,
    Reals,
    Record,
    Rows,
    Untranslatable,
    array,
    copy,
    native,
)
from adamslite.native.translate.statements import Translator


class Corner(Record):
    x: float
    hit: bool
    often: int


class Box(Record):
    size: float
    count: int
    shut: bool
    low: Corner
    high: Corner
    ends: Reals = array(3)
    marks: Ints = array(2)
    path: Reals
    corners: Rows[Corner]


class Crate(Box):
    weight: float


class Shelf(Record):
    spare: float
    crate: Crate
    room: Reals
    kept: Corner


@native
def sample_corner(c: Corner, by: float) -> float:
    """A number of each kind, set and changed."""
    c.x, c.hit = c.x + by, not c.hit
    c.often += 2
    c.often -= 1
    c.x *= 0.5
    return c.x if c.hit else -1.0


@native
def sample_box(B: Box, corners: Rows[Corner]) -> float:
    """Everything that a record may hold."""
    B.size += 1.5
    B.count = B.count * 2 + B.path.size + B.ends.size + B.marks.size + B.corners.size
    B.shut = B.count > 3 and not B.low.hit
    total = sample_corner(B.low, B.size) + sample_corner(B.corners[1], 0.25)
    inside = B.ends[1:]
    inside[1] = 4.0 + B.ends[0]
    B.ends[0] -= float(B.count)
    B.marks[1], B.path[2] = B.marks[0] + B.count, B.ends[2]
    for k in range(B.corners.size):
        corners[k].often += k
        total += corners[k].x * corners[k].often
    B.high[:] = B.low
    B.low[:] = 0
    return total


@native
def sample_shelf(S: Shelf) -> float:
    """A record inside of a record, one in the place of another that it extends, one in a room."""
    C, seen = S.crate, Corner(S.room[1:])
    C.weight = sample_box(C, C.corners) + C.low.x
    S.kept[:] = C.high
    seen.x, seen.often = S.spare, 7
    S.spare = S.crate.size
    copy(S.crate.ends, S.crate.path[1:], 2)
    seen.hit = S.spare > 0.0
    return C.weight if S.kept.hit else 0.0


def shelf() -> Shelf:
    S = Shelf.zeros()
    S.spare, S.crate.size, S.crate.count, S.crate.weight = 0.75, -0.5, 3, 9.0
    S.crate.low.x, S.crate.low.hit, S.crate.low.often = 2.5, False, -4
    S.crate.ends, S.crate.marks = [0.5, 1.5, 2.5], [5, 6]
    S.crate.path, S.crate.corners, S.room = np.arange(4.0), Rows(Corner, 3), np.ones(5)
    for k, corner in enumerate(S.crate.corners):
        corner.x, corner.often = 0.1 * k, k
    return S


def test_records_mean_natively_what_they_mean_in_python():
    """Every kind of field; what lies next to one stays as it is."""
    here, there = shelf(), shelf()
    expected = sample_shelf(here)
    assert native_call(sample_shelf, [there]) == pytest.approx(expected, rel=1e-14)
    assert np.array_equal(here.room, there.room) and np.array_equal(here.crate.path, [0, 1, 4.5, 3])
    assert str(here.crate) == str(there.crate) and str(here.kept) == str(there.kept)
    # size, count and shut of the crate; its low corner has gone to its high one and to the shelf.
    assert (here.crate.size, here.crate.count, here.crate.shut) == (1.0, 6 + 4 + 3 + 2 + 3, True)
    assert here.crate.high.values() == here.kept.values() == {"x": 1.75, "hit": True, "often": -3}
    assert not any(here.crate.low.values().values())
    assert Corner(here.room[1:]).values() == {"x": 0.75, "hit": True, "often": 7}
    assert here.room[0] == here.room[4] == 1.0


def test_no_two_fields_share_a_slot():
    """The layout: one slot per number, two per reference, those of a record inside."""
    places = {name: (field.at, field.slots) for name, field in Shelf.fields.items()}
    box = 3 + 3 + 3 + 3 + 2 + 2 + 2
    assert places == {
        "spare": (0, 1), "crate": (1, box + 1), "room": (box + 2, 2), "kept": (box + 4, 3),
    }  # fmt: skip
    assert Shelf.slots == box + 7 and Crate.fields["weight"].at == Box.slots == box


def test_records_refuse_what_native_code_would_not_see():
    S = Shelf.zeros()
    for name, value in {"count": 1.5, "path": np.arange(3), "corners": np.zeros(9)}.items():
        with pytest.raises(TypeError):
            setattr(S.crate, name, value)
    with pytest.raises(AttributeError, match="Corner has no field y"):
        S.kept.y = 1.0
    with pytest.raises(ValueError, match="Corner takes 3 slots, not 2"):
        Corner(np.zeros(2))
    with pytest.raises(TypeError):
        S.crate[:] = 0
    with pytest.raises(TypeError, match="cannot be called slots"):
        type("Odd", (Record,), {"__annotations__": {"slots": int}, "__module__": __name__})
    with pytest.raises(TypeError, match="Odd.x: .* is no type"):
        type("Odd", (Record,), {"__annotations__": {"x": "complex"}, "__module__": __name__})


# ---- what is refused -----------------------------------------------------------------------------


def no_field(c: Corner) -> float:
    return c.y


def no_field_to_set(c: Corner) -> None:
    c.y = 1.0


def whole_field(b: Box, r: Reals) -> None:
    b.path = r


def part_of_rows(b: Box) -> None:
    rest = b.corners[1:]
    rest[0].x = 0.0


def other_record(b: Box) -> None:
    sample_box(b.low, b.corners)


def kind_of_a_field(c: Corner) -> None:
    c.often = c.x


def copies_addresses(b: Box) -> None:
    b[:] = b


def copies_another(b: Box, s: Shelf) -> None:
    b.low[:] = s


def of_no_record(a: float) -> float:
    return a.real


def of_no_type(a: complex) -> float:
    return 0.0


REFUSED = {
    no_field: "Corner has no field y", no_field_to_set: "Corner has no field y",
    part_of_rows: "rows are not shifted", whole_field: "only numbers in",
    other_record: "Corner where Box is needed",
    kind_of_a_field: "double where i64 is needed", copies_addresses: "Box is not set as a whole",
    copies_another: "Shelf where Corner is needed", of_no_record: "double is not a record",
    of_no_type: "a: complex is no type of an argument",
}  # fmt: skip


@pytest.mark.parametrize("function", REFUSED, ids=lambda f: f.__name__)
def test_what_a_record_is_not_is_refused_with_its_place(function):
    """The message names the function and, where there is one, the line and the reason."""
    with pytest.raises(Untranslatable, match=REFUSED[function]) as caught:
        Translator(function).translate()
    line = function.__code__.co_firstlineno
    place = rf"^test_records.py:({line}|{line + 1}|{line + 2}), {function.__name__}: "
    assert re.match(place, str(caught.value))

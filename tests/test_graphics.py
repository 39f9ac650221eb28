"""GRAPHICS: every kind of shape is read with its arguments, and moves nothing."""

from __future__ import annotations

import pytest
from decklets import codes, last, told

from adamslite.elements.graphics import Graphics
from adamslite.language.messages import START

FILE = r"C:\Users\a b\part-1.xmt_txt"
SHAPES = {
    "ARC": "ARC, CM=1, RADIUS=2, RANGLE=90D, SEG=20",
    "BOX": "BOX\n, CORNER = 0001\n, X = 4, Y = -0.2, Z = 0.2",
    "CIRCLE": "CIRCLE\n, CM = 1\n, RADIUS = 0.54175\n, SEG = 18",
    "CYLINDER": "CYLINDER, CM=1, LENGTH=-0.9, SIDES=18, RADIUS=0.3, SEG=18",
    "ELLIPSOID": "ELLIPSOID, CM=1, XS=0.2, YSCALE=0.2, ZS=0.2",
    "EXTERNAL": f"EXTERNAL, RM=1, FILE = {FILE}, ELEMENT = PSMAR1",
    "FORCE": "FORCE\n, ETYPE = SFORCE\n, EID = 1\n, EMARKER = 2",
    "FRUSTUM": "FRUSTUM, CM=1, LENGTH=2, BOTTOM=1, TOP=0",
    "FUNCTION": r"FUNCTION=USER(1,2,3)\ ",
    "OUTLINE": "OUTLINE = 1, 2, 1",
    "PLANE": "PLANE, RM=1, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1",
    "POINT": "POINT, RM=2",
    "SPRINGDAMPER": "SPDP, I=1, J=2, COILS=5, DA=0.1, DB=0.2, LC=0.1",
    "TORUS": "TORUS, CM=1, MAJOR=2, MINOR=0.1",
}


@pytest.mark.parametrize(("shape", "words"), SHAPES.items())
def test_a_shape_is_read(shape: str, words: str) -> None:
    hidden = shape in ("EXTERNAL", "FUNCTION")
    assert codes(f"GRAPHICS/7, {words}") == (["passed-over"] if hidden else [])
    found = last(f"GRAPHICS/7, {words}")
    assert isinstance(found, Graphics)
    assert found.shape == shape


def test_every_shape_but_a_curve_is_tried() -> None:
    assert set(SHAPES) == set(Graphics.needs) - {"CURVE"}


def test_arguments_are_kept() -> None:
    outside = last(f"GRAPHICS/7, {SHAPES['EXTERNAL']}")
    assert (outside.rm, outside.file, outside.element) == (1, FILE, "PSMAR1")
    box = last(f"GRAPHICS/7, {SHAPES['BOX']}")
    assert (box.marker, box.x, box.y, box.z) == (1, 4.0, -0.2, 0.2)
    assert last(f"GRAPHICS/7, {SHAPES['OUTLINE']}").outline == (1, 2, 1)


def test_what_another_shape_has_is_reported() -> None:
    (warning,) = told(f"{START}GRAPHICS/1, POINT, RM=2, RADIUS=3\n")
    assert warning.message == "RADIUS has no effect in GRAPHICS/1"
    assert warning.hint == "the shape is POINT"


def test_shapes_may_be_drawn_where_nothing_can_act() -> None:
    """On a flexible body, and at a floating marker."""
    flexible = "FLEX_BODY/9\nMARKER/4\nGRAPHICS/1, POINT, RM=4"
    assert codes(flexible) == ["passed-over"]
    floating = "MARKER/5, PART=1, FLOATING\nVFORCE/1, I=2, JFLOAT=5, FX=1"
    assert codes(f"{floating}\nGRAPHICS/1, FORCE, ETYPE=VFORCE, EID=1, EMARKER=5") == []


@pytest.mark.parametrize(
    "words", ["ELLIPSOID, CM=99, XS=1, YS=1, ZS=1", "BOX, CORNER=7, X=1, Y=1, Z=1"]
)
def test_a_marker_must_exist(words: str) -> None:
    assert "missing-reference" in codes(f"GRAPHICS/1, {words}")

"""The simple forms that shapes of GRAPHICS are made of where they meet."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from adamslite.language.interfaces import Key

EQUAL = 1e-9
"""Share by which the scales of a ball may differ."""


class Form(NamedTuple):
    """A simple shape: its kind, its marker and its sizes; see contact_geometry."""

    kind: str
    marker: Key
    sizes: tuple[float, ...]


class Shape(Protocol):
    """What is asked of a GRAPHICS that has everything it needs."""

    @property
    def shape(self) -> str | None: ...
    @property
    def marker(self) -> Key | None: ...
    @property
    def radius(self) -> float | None: ...
    def size(self, field: str) -> float:
        """A length that is given."""


Meeting = tuple[Form, Form, bool]
"""Forms on I and J, and whether I is on the side of JGEOM."""


def solid(shape: Shape) -> str:
    """What a shape is where it touches: BALL, PLANE, BOX, CYLINDER, FRUSTUM; else nothing."""
    kind = shape.shape or ""
    if kind == "ELLIPSOID":
        scales = [shape.size(field) for field in ("xscale", "yscale", "zscale")]
        return "BALL" if max(scales) - min(scales) <= EQUAL * max(scales) else ""
    if kind == "POINT":
        return "BALL"
    if kind == "CYLINDER":
        return kind if shape.radius is not None else ""
    return kind if kind in ("PLANE", "BOX", "FRUSTUM") else ""


def meetings(first: Shape, second: Shape) -> list[Meeting]:
    """Where two shapes may touch; nowhere when their contact is not known."""
    found = _meetings(first, second)
    if found:
        return [(i, j, False) for i, j in found]
    return [(i, j, True) for i, j in _meetings(second, first)]


def _meetings(first: Shape, second: Shape) -> list[tuple[Form, Form]]:
    kinds = solid(first), solid(second)
    if kinds[0] == "BALL" and kinds[1] in ("BALL", "PLANE", "BOX", "CYLINDER"):
        forms = _whole(first), _whole(second)
        sized = kinds[1] != "BALL" or forms[0].sizes[0] + forms[1].sizes[0] > 0.0
        return [forms] if sized else []
    if kinds[1] != "PLANE":
        return []
    return [(edge, _whole(second)) for edge in _edges(first, kinds[0])]


def _whole(shape: Shape) -> Form:
    """A shape as one form."""
    kind, sizes = solid(shape), tuple[float, ...]()
    if kind == "BALL":
        sizes = (shape.size("xscale") / 2 if shape.shape == "ELLIPSOID" else 0.0,)
    elif kind == "BOX":
        edges = [shape.size(field) for field in "xyz"]
        sizes = (*(edge / 2 for edge in edges), *(abs(edge) / 2 for edge in edges))
    elif kind == "CYLINDER":
        length = shape.size("length")
        sizes = (length / 2, abs(length) / 2, shape.size("radius"))
    return _form(kind, shape, sizes)


def _form(kind: str, shape: Shape, sizes: tuple[float, ...]) -> Form:
    assert shape.marker is not None  # it has everything it needs
    return Form(kind, shape.marker, sizes)


def _edges(shape: Shape, kind: str) -> list[Form]:
    """What of a shape may touch a plane: the corners of a BOX, the edges of a CYLINDER."""
    if kind == "BOX":
        half = [shape.size(field) / 2 for field in "xyz"]
        signs = product((-1.0, 1.0), repeat=3)
        places = [[s * a for s, a in zip(each, half, strict=True)] for each in signs]
        return [_form("CORNER", shape, (*half, *place)) for place in places]
    radii = {"CYLINDER": ("radius", "radius"), "FRUSTUM": ("bottom", "top")}.get(kind, ())
    middle = shape.size("length") / 2 if radii else 0.0
    ends = zip((-middle, middle), map(shape.size, radii), strict=False)
    return [_form("RIM", shape, (middle, *end)) for end in ends]

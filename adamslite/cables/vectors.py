"""Vectors of space as tuples, where numpy is not loaded."""

from math import sqrt

# A unit vector with a larger component is taken to be along that axis.
ALONG = 0.9
Vector = tuple[float, float, float]
ZERO: Vector = (0.0, 0.0, 0.0)
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def add(a: Vector, b: Vector, factor: float = 1.0) -> Vector:
    """a + factor b."""
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return 0.0 + a[0] * b[0] + a[1] * b[1] + a[2] * b[2]  # never -0


def cross(a: Vector, b: Vector) -> Vector:
    """Vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def norm(a: Vector) -> float:
    """|a|."""
    return sqrt(dot(a, a))


def unit(a: Vector) -> Vector:
    """a/|a|; a zero vector stays."""
    size = norm(a)
    return add(ZERO, a, 1 / size if size else 0.0)


def aside(axis: Vector) -> Vector:
    """A coordinate axis that is not along a unit vector."""
    return (1.0, 0.0, 0.0) if abs(axis[0]) < ALONG else (0.0, 1.0, 0.0)


def part_across(a: Vector, line: Vector) -> Vector:
    """The part of a across the unit vector of a line."""
    return add(a, line, -dot(a, line))

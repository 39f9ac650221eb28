"""Curves that a routine of the user gives: points of c(alpha) through which a spline is the curve.

The number of points is doubled until the spline through half of them meets the others to ``EXACT``
of its length.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from adamslite.elements.bases.spline_curve import through
from adamslite.language.expression import Call, Num

if TYPE_CHECKING:  # reading a deck does without numpy
    import numpy as np

    from adamslite.elements.bases.spline_curve import SplineCurve
    from adamslite.language.expression import Node

POINTS = "POINTS"
# Pieces at first, and doublings at most.
FIRST, DOUBLINGS = 32, 8
EXACT = 1e-9


def traced(curve: Callable[[float], Sequence[float]], low: float, high: float) -> Node:
    """The points of a curve from alpha = low to high, as what FUNCTION of a CURVE holds."""
    import numpy as np

    alpha = np.linspace(low, high, FIRST + 1)
    points = _at(curve, alpha)
    for _ in range(DOUBLINGS):
        between = _at(curve, 0.5 * (alpha[1:] + alpha[:-1]))
        spline = through(points, False)
        worst = max(_distance(spline, each) for each in between)
        alpha = np.linspace(low, high, 2 * len(alpha) - 1)
        joined = np.empty((len(alpha), 3))
        joined[::2], joined[1::2] = points, between
        points = joined
        if worst <= EXACT * spline.length:
            break
    return line(points.ravel().tolist())


def line(numbers: Sequence[float]) -> Node:
    """The polygon through points x1, y1, z1, x2, ... as what FUNCTION of a CURVE holds."""
    return Call(POINTS, tuple(Num(each) for each in numbers))


def traced_points(node: Node) -> np.ndarray:
    """The points (n, 3) again."""
    import numpy as np

    assert isinstance(node, Call)
    return np.array([each.value for each in node.args if isinstance(each, Num)]).reshape(-1, 3)


def _at(curve: Callable[[float], Sequence[float]], alpha: np.ndarray) -> np.ndarray:
    import numpy as np

    found = np.array([np.asarray(curve(each), dtype=float).ravel() for each in alpha.tolist()])
    if found.shape != (len(alpha), 3) or not np.isfinite(found).all():
        raise ValueError("a curve returns x, y and z")
    return found


def _distance(spline: SplineCurve, point: np.ndarray) -> float:
    import numpy as np

    return float(np.linalg.norm(spline.at(np.array([spline.nearest(point)]))[0] - point))

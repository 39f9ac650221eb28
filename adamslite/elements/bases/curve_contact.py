"""Where two plane curves touch, or would if one of them were moved along its normal.

Equation (P = place of curve i at s, Q of curve j at u, T and U their tangents, N = z x U)::

    (P - Q) . U = 0,      T . N = 0           of the solutions the one with the shortest |P - Q|
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # reading a deck does without numpy
    import numpy as np

    from adamslite.elements.bases.spline_curve import SplineCurve

    Pose = tuple[np.ndarray, np.ndarray]

# Samples of each curve, pairs that are polished, their steps, and what counts as a solution.
SAMPLES, CANDIDATES, STEPS, CLOSED = 301, 40, 30, 1e-10


def touching(
    curves: Sequence[SplineCurve], poses: Sequence[Pose], given: Sequence[np.ndarray | None]
) -> tuple[float, float]:
    """Parameters of both curves, in the given poses (origin, axes); ``given``: a place (3,) that
    the point of a curve is next to, or None.
    """
    fixed = [
        None if place is None else curve.nearest((place - origin) @ axes)
        for curve, (origin, axes), place in zip(curves, poses, given, strict=True)
    ]
    s, u = fixed
    return _closest(curves, poses, fixed) if s is None or u is None else (s, u)


def _closest(
    curves: Sequence[SplineCurve], poses: Sequence[Pose], fixed: Sequence[float | None]
) -> tuple[float, float]:
    import numpy as np

    grids = [np.linspace(0.0, 1.0, SAMPLES) if s is None else np.array([s]) for s in fixed]
    (p, t), (q, u) = (
        (_placed(curve, pose, s, 0), _placed(curve, pose, s, 1))
        for curve, pose, s in zip(curves, poses, grids, strict=True)
    )
    gap = np.linalg.norm(p[:, None] - q[None], axis=-1)
    best = np.unravel_index(int(np.argmin(gap)), gap.shape)
    if 1 in gap.shape:
        return float(grids[0][best[0]]), float(grids[1][best[1]])
    unit = u / np.linalg.norm(u, axis=1, keepdims=True)
    across = np.cross(poses[1][1][:, 2], unit)
    sine = (t / np.linalg.norm(t, axis=1, keepdims=True)) @ across.T
    along = np.einsum("ijk,jk->ij", p[:, None] - q[None], unit)
    crossed = map(tuple, np.argwhere(_crossing(along) & _crossing(sine)))
    places = sorted(crossed, key=lambda at: float(gap[at]))[:CANDIDATES]
    found = [_polished(curves, poses, grids[0][a], grids[1][b]) for a, b in (*places, best)]
    solved = [each for each in found if each is not None]
    if not solved:
        return float(grids[0][best[0]]), float(grids[1][best[1]])
    return min(solved, key=lambda each: each[0])[1]


def _placed(curve: SplineCurve, pose: Pose, s: np.ndarray, order: int) -> np.ndarray:
    """Points (n, 3) in ground, or derivatives by s."""
    origin, axes = pose
    found = curve.at(s, order) @ axes.T
    return found if order else found + origin


def _crossing(values: np.ndarray) -> np.ndarray:
    """Cells (n, m) of a grid at a corner of which the sign differs from that of the first."""
    import numpy as np

    sign = values > 0.0
    found = np.zeros(values.shape, dtype=bool)
    found[:-1, :-1] = (
        (sign[:-1, :-1] != sign[1:, :-1])
        | (sign[:-1, :-1] != sign[:-1, 1:])
        | (sign[:-1, :-1] != sign[1:, 1:])
    )
    return found


def _polished(
    curves: Sequence[SplineCurve], poses: Sequence[Pose], s: float, u: float
) -> tuple[float, tuple[float, float]] | None:
    """Distance and parameters of the solution next to a pair; None where Newton finds none."""
    import numpy as np

    z, size = poses[1][1][:, 2], curves[0].length * curves[1].length
    for _ in range(STEPS):
        (p, t, b), (q, w, k) = (
            [_placed(curve, pose, np.array([at]), n)[0] for n in range(3)]
            for curve, pose, at in zip(curves, poses, (s, u), strict=True)
        )
        away, across = p - q, np.cross(z, w)
        rest = np.array([away @ w, t @ across])
        if np.abs(rest).max() < CLOSED * size:
            return float(np.linalg.norm(away)), (float(s), float(u))
        slope = np.array([[t @ w, away @ k - w @ w], [b @ across, t @ np.cross(z, k)]])
        if abs(np.linalg.det(slope)) < CLOSED * np.abs(slope).max() ** 2:
            return None
        s, u = np.array([s, u]) - np.linalg.solve(slope, rest)
        if not all(c.closed or -0.5 < at < 1.5 for c, at in zip(curves, (s, u), strict=True)):
            return None
    return None

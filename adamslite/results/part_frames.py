"""Motion of parts in the two ways in which it is written.

Results of this program give the position and the axes of the centre-of-mass marker. Those of ADAMS
give the origin and the axes of the part itself (QG, REULER; BCS, the body coordinate system). With
the marker at ``r`` and with axes ``A`` (columns) in the part, and ``d = R r`` in ground axes::

    R_cm = R A            x_cm = x + d
    v_cm = v + w x d      a_cm = a + al x d + w x (w x d)

Angular velocity and acceleration, in ground axes, are the same for both.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.model.attitude_angles import angles_313, rotations_313

if TYPE_CHECKING:
    from adamslite.model.model import Model

PLACE, ANGLES = ("x", "y", "z"), ("psi", "theta", "phi")
SPEED, ACCELERATION = ("vx", "vy", "vz"), ("ax", "ay", "az")
OMEGA, ALPHA = ("wx", "wy", "wz"), ("alx", "aly", "alz")
#: What belongs to a point of the part, by which it is written; the rest belongs to all points.
OF_POINT = (*PLACE, *ANGLES, *SPEED, *ACCELERATION)
#: Sines of theta below which psi and phi are one angle: to write them, and to compare them. Of the
#: angles of a planar motion round-off decides how it is split between the two.
ALIGNED, ALIKE = 1e-10, 1e-6

Columns = Mapping[str, np.ndarray]
"""Histories (nt,) of one part by component: ``x``, ``psi``, ``vx``, ..."""


class MarkerInPart(NamedTuple):
    """Where the centre of mass is: ``offset`` (3,) and ``axes`` (3, 3) in the part."""

    offset: np.ndarray
    axes: np.ndarray

    @property
    def shifted(self) -> bool:
        return bool(self.offset.any())

    @property
    def turned(self) -> bool:
        return not np.array_equal(self.axes, np.eye(3))


def markers_in_parts(model: Model) -> dict[str, MarkerInPart]:
    """The centre of mass of every moving body, by its label."""
    found = {}
    for body in model.bodies:
        offset, axes = model.marker_in_body(body.statement.cm)
        if body.statement.keyword == "POINT_MASS":  # its axes stay as they are in the deck
            offset, axes = body.attitude @ offset, np.eye(3)
        found[body.statement.label] = MarkerInPart(offset, axes)
    return found


def of_origin(centre: Columns, marker: MarkerInPart) -> dict[str, np.ndarray]:
    """Columns of the origin of a part from those of its centre of mass.

    Raises
    ------
    KeyError
        Naming the component that is missing.
    """
    back = MarkerInPart(-marker.axes.T @ marker.offset, marker.axes.T)
    return of_centre(centre, back)


def of_centre(origin: Columns, marker: MarkerInPart) -> dict[str, np.ndarray]:
    """Columns of the centre of mass of a part from those of its origin."""
    if not marker.shifted and not marker.turned:
        return dict(origin)
    found = dict(origin)
    attitude = None
    if "psi" in origin:
        attitude = rotations_313(_vector(origin, ANGLES))
        if marker.turned:
            found |= _named(ANGLES, angles_313(attitude @ marker.axes, ALIGNED))
    if marker.shifted:
        d = marker.offset if attitude is None else attitude @ marker.offset
        found |= _moved(origin, d, turns=attitude is not None)
    return found


def _moved(columns: Columns, d: np.ndarray, turns: bool) -> dict[str, np.ndarray]:
    """The same of a point that is ``d`` (nt, 3) away, in ground axes."""
    found: dict[str, np.ndarray] = {}
    if "x" in columns:
        found |= _named(PLACE, _vector(columns, PLACE) + d)
    if not turns:
        return found
    w = _vector(columns, OMEGA) if "vx" in columns or "ax" in columns else d
    if "vx" in columns:
        found |= _named(SPEED, _vector(columns, SPEED) + np.cross(w, d))
    if "ax" in columns:
        turning = np.cross(_vector(columns, ALPHA), d) + np.cross(w, np.cross(w, d))
        found |= _named(ACCELERATION, _vector(columns, ACCELERATION) + turning)
    return found


def _vector(columns: Columns, names: tuple[str, ...]) -> np.ndarray:
    return np.column_stack([columns[name] for name in names])


def _named(names: tuple[str, ...], vectors: np.ndarray) -> dict[str, np.ndarray]:
    return dict(zip(names, vectors.T, strict=True))


def with_one_split(angles: np.ndarray) -> np.ndarray:
    """The same attitudes (nt, 3), with phi = 0 where it is one angle with psi."""
    return angles_313(rotations_313(angles), ALIKE)

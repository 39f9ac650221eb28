"""Geometry of bodies and markers: axes from angles or points, positions of markers.

Axes are (3, 3), in columns.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from adamslite.elements.marker import Marker

if TYPE_CHECKING:
    from adamslite.elements.part import Part
    from adamslite.elements.point_mass import PointMass

Point = tuple[float, ...]
IDENTITY = np.eye(3)
IDENTITY.flags.writeable = False
# Of the components of unit vectors, after a few products.
ROUND_OFF = 1e-15


def rotation_313(angles: Point) -> np.ndarray:
    """R = Rz(a) Rx(b) Rz(c), (3, 3): columns are the turned axes."""
    a, b, c = angles
    if a == b == c == 0.0:
        return IDENTITY
    return _about_z(a) @ _about_x(b) @ _about_z(c)


def _about_z(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _about_x(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def axes_from_points(
    origin: np.ndarray, z_point: Point | None, x_point: Point | None, x_exact: bool
) -> np.ndarray | None:
    """Axes through points: +z through one, +xz half-plane through the other (or x exact)."""
    along_z = None if z_point is None else np.asarray(z_point) - origin
    along_x = None if x_point is None else np.asarray(x_point) - origin
    if x_exact and along_x is not None:
        x = along_x / np.linalg.norm(along_x)
        y = np.cross(along_z if along_z is not None else _aside(x), x)
        y /= np.linalg.norm(y)
        return np.column_stack([x, y, np.cross(x, y)])
    if along_z is None:
        if along_x is None:
            return None
        along_z = _aside(along_x)
        along_z -= along_x * (along_z @ along_x) / (along_x @ along_x)
    z = along_z / np.linalg.norm(along_z)
    y = np.cross(z, along_x if along_x is not None else _aside(z))
    y /= np.linalg.norm(y)
    return np.column_stack([np.cross(y, z), y, z])


def _aside(v: np.ndarray) -> np.ndarray:
    """The coordinate axis furthest from ``v``."""
    return IDENTITY[int(np.argmin(np.abs(v)))].copy()


def frame_axes(statement: Part | PointMass | Marker, origin: np.ndarray) -> np.ndarray:
    """Axes of a body or marker statement from REULER or its points."""
    if isinstance(statement, Marker):
        axes = axes_from_points(origin, statement.zp, statement.xp, statement.usexp)
    else:
        axes = axes_from_points(origin, statement.zg, statement.xg, False)
    return axes if axes is not None else rotation_313(statement.reuler)


@dataclass(frozen=True)
class Place:
    """Where a marker sits: ``p`` from the mass centre or ground origin, ``axes`` in body axes
    without round-off of right angles.

    ``offset``, ``turned``: whether these differ from zero and from the axes of the body.
    """

    kind: str
    body: int
    p: np.ndarray
    axes: np.ndarray
    offset: bool = field(init=False)
    turned: bool = field(init=False)

    def __post_init__(self) -> None:
        axes = _without_round_off(self.axes)
        turned = axes is not IDENTITY and not np.array_equal(axes, IDENTITY)
        object.__setattr__(self, "axes", axes)
        object.__setattr__(self, "offset", bool(self.p.any()))
        object.__setattr__(self, "turned", turned)


def rotated(base: np.ndarray, array: np.ndarray) -> np.ndarray:
    """``base @ array``; nothing to do for axes like those of ground, the usual ones."""
    return array if base is IDENTITY else base @ array


def _without_round_off(axes: np.ndarray) -> np.ndarray:
    """Axes with round-off of right angles removed, so that aligned markers share a shape."""
    if axes is IDENTITY:
        return axes
    rounded = np.round(axes)
    return rounded if np.abs(axes - rounded).max() < ROUND_OFF else axes

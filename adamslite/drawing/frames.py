"""Markers in the axes of their bodies: the points and frames of everything that is drawn.

Body 0 is the ground, body k + 1 the k-th moving body of the model.  The frame of a moving body is
at its mass centre, with the axes of the PART statement; a point mass has those of ground.

Attitudes are unit quaternions x, y, z, w: from body axes to those they are given in.  Of a rotation
by the angle a about the unit vector e they are q = (v, s)::

    v = e sin(a/2),  s = cos(a/2)
    p q = (p_s q_v + q_s p_v + p_v x q_v,  p_s q_s - p_v . q_v)         first q, then p

Source: Shuster, A survey of attitude representations, J. Astronautical Sciences 41 (1993).
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from adamslite.elements.marker import Marker
from adamslite.language.interfaces import Key
from adamslite.model.geometry import IDENTITY, Place
from adamslite.model.model import Model

Numbers: TypeAlias = list[float]
"""``[body, x, y, z]``, or with ``qx, qy, qz, qw`` after it."""
RIGID = ("PART", "POINT_MASS")
ORIGIN = Place("ground", -1, np.zeros(3), IDENTITY)


class Frames:
    """Places of the markers of a model."""

    def __init__(self, model: Model) -> None:
        self.model = model

    def has(self, marker: Key) -> bool:
        """Whether a marker is on a body that can be drawn, which flexible ones cannot."""
        if marker == 0:
            return True
        owner = self.model.deck.get(Marker, marker).owner
        return owner is not None and owner[0] in RIGID

    def place(self, marker: Key) -> Place:
        """Body, origin and axes; marker 0 is the origin of ground."""
        return self.model.marker(marker) if marker != 0 else ORIGIN

    def body(self, marker: Key) -> int:
        """Number of the body a marker is on."""
        return self.place(marker).body + 1

    def point(self, marker: Key) -> Numbers:
        """The origin of a marker."""
        place = self.place(marker)
        return [place.body + 1, *place.p.tolist()]

    def frame(self, marker: Key) -> Numbers:
        """Origin and axes of a marker."""
        return [*self.point(marker), *from_axes(self.place(marker).axes).tolist()]


UPRIGHT = np.array([0.0, 0.0, 0.0, 1.0])


def from_313(angles: np.ndarray) -> np.ndarray:
    """(..., 4) of the rotations Rz(psi) Rx(theta) Rz(phi), `angles` (..., 3) [rad]."""
    psi, theta, phi = np.moveaxis(np.asarray(angles, dtype=float), -1, 0) / 2
    s, c = np.sin(theta), np.cos(theta)
    parts = (s * np.cos(psi - phi), s * np.sin(psi - phi), c * np.sin(psi + phi))
    return np.stack([*parts, c * np.cos(psi + phi)], axis=-1)


def from_axes(axes: np.ndarray) -> np.ndarray:
    """(4,) of a rotation matrix (3, 3) whose columns are the rotated axes."""
    r = np.asarray(axes, dtype=float)
    squares = np.array([
        1 + r[0, 0] - r[1, 1] - r[2, 2], 1 - r[0, 0] + r[1, 1] - r[2, 2],
        1 - r[0, 0] - r[1, 1] + r[2, 2], 1 + r[0, 0] + r[1, 1] + r[2, 2],
    ])  # fmt: skip
    largest = int(np.argmax(squares))  # of 4 x^2, ...: the others follow without loss of digits
    x, y, z = r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]
    xy, xz, yz = r[0, 1] + r[1, 0], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1]
    q = np.array(
        [
            [squares[0], xy, xz, x],
            [xy, squares[1], yz, y],
            [xz, yz, squares[2], z],
            [x, y, z, squares[3]],
        ][largest]
    )
    return q / np.linalg.norm(q)


def product(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """(..., 4) of the rotation q followed by p."""
    pv, ps, qv, qs = p[..., :3], p[..., 3:], q[..., :3], q[..., 3:]
    vector = ps * qv + qs * pv + np.cross(pv, qv)
    return np.concatenate([vector, ps * qs - (pv * qv).sum(axis=-1, keepdims=True)], axis=-1)


def inverse(q: np.ndarray) -> np.ndarray:
    """(..., 4) of the opposite rotation."""
    return q * np.array([-1.0, -1.0, -1.0, 1.0])


def rotated(q: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Vectors (..., 3) rotated by q (..., 4)."""
    v = np.broadcast_to(np.asarray(vectors, dtype=float), (*q.shape[:-1], 3))
    twice = 2 * np.cross(q[..., :3], v)
    return v + q[..., 3:] * twice + np.cross(q[..., :3], twice)


def continuous(q: np.ndarray) -> np.ndarray:
    """(nt, 4) with the sign of each, of the two that mean one attitude, nearest to the last."""
    flips = np.where((q[1:] * q[:-1]).sum(axis=1) < 0, -1.0, 1.0)
    return q * np.concatenate([[1.0], np.cumprod(flips)])[:, None]

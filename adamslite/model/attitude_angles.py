"""3-1-3 angles of many attitudes at once."""

from __future__ import annotations

import numpy as np


def rotations_313(angles: np.ndarray) -> np.ndarray:
    """R = Rz(psi) Rx(theta) Rz(phi), (nt, 3, 3), of angles (nt, 3) [rad]."""
    (ca, cb, cc), (sa, sb, sc) = np.cos(angles.T), np.sin(angles.T)
    rows = (
        (ca * cc - sa * cb * sc, -ca * sc - sa * cb * cc, sa * sb),
        (sa * cc + ca * cb * sc, -sa * sc + ca * cb * cc, -ca * sb),
        (sb * sc, sb * cc, cb),
    )
    return np.moveaxis(np.array(rows), -1, 0)


def angles_313(rotations: np.ndarray, aligned: float) -> np.ndarray:
    """psi, theta, phi (nt, 3) [rad] of rotations (nt, 3, 3).

    Where the sine of theta is below ``aligned``, psi and phi are one angle: phi is 0 there.
    """
    r = rotations
    sine = np.hypot(r[:, 0, 2], r[:, 1, 2])
    regular = sine > aligned
    psi = np.where(regular, np.arctan2(r[:, 0, 2], -r[:, 1, 2]), np.arctan2(r[:, 1, 0], r[:, 0, 0]))
    phi = np.where(regular, np.arctan2(r[:, 2, 0], r[:, 2, 1]), 0.0)
    return np.column_stack([psi, np.arctan2(sine, r[:, 2, 2]), phi])

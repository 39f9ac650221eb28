"""Constraints between two frames as equations, and postures in which they are met.

Each row is a :class:`newton_euler.Jet` of the axes of I and J, written from the definition of the
joint and not from the program.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi

import numpy as np
from newton_euler import Axes, Jet, angle, root

Array = np.ndarray


# ---------------------------------------------------------------------------------- rotations


def about(axis: int, turn: float) -> Array:
    """Rotation about x, y or z."""
    c, s = np.cos(turn), np.sin(turn)
    found = np.eye(3)
    a, b = (axis + 1) % 3, (axis + 2) % 3
    found[a, a], found[b, b], found[a, b], found[b, a] = c, c, -s, s
    return found


def euler_313(rotation: Array) -> tuple[float, float, float]:
    """Angles a, b, c of Rz(a) Rx(b) Rz(c)."""
    b = np.arctan2(np.hypot(rotation[0, 2], rotation[1, 2]), rotation[2, 2])
    a = np.arctan2(rotation[0, 2], -rotation[1, 2])
    rest = about(0, b).T @ about(2, a).T @ rotation
    return float(a), float(b), float(np.arctan2(rest[1, 0], rest[0, 0]))


def any_rotation(rng: np.random.Generator) -> Array:
    """A rotation without preferred direction."""
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return q * np.linalg.det(q)


# ---------------------------------------------------------------------------------- constraints


def separation(i: Axes, j: Axes) -> Jet:
    """From the origin of J to that of I."""
    return i.origin - j.origin


def _together(i: Axes, j: Axes, t: float) -> list[Jet]:
    d = separation(i, j)
    return [Jet(d.value[k], d.rate[k], d.second[k], d.gradient[k]) for k in range(3)]


def _on_line(i: Axes, j: Axes, t: float) -> list[Jet]:
    return [separation(i, j).dot(j.x), separation(i, j).dot(j.y)]


def _parallel(i: Axes, j: Axes, t: float) -> list[Jet]:
    return [i.z.dot(j.x), i.z.dot(j.y)]


def _in_plane(i: Axes, j: Axes, t: float) -> list[Jet]:
    return [separation(i, j).dot(j.z)]


def _same_turn(i: Axes, j: Axes, t: float) -> list[Jet]:
    return [i.x.dot(j.y)]


def _square(i: Axes, j: Axes, t: float) -> list[Jet]:
    return [i.z.dot(j.z)]


def _equal_speed(i: Axes, j: Axes, t: float) -> list[Jet]:
    return [i.x.dot(j.y) - i.y.dot(j.x)]


def all_of(*rows: Callable) -> Callable:
    """Several rows in one."""
    return lambda i, j, t: [jet for row in rows for jet in row(i, j, t)]


def turn(i: Axes, j: Axes) -> Jet:
    """The angle of I about z of J."""
    return angle(i.x.dot(j.y), i.x.dot(j.x))


def body_123(i: Axes, j: Axes, name: str) -> Jet:
    """An angle of Rx(B1) Ry(B2) Rz(B3) = axes of I in J."""
    if name == "B1":
        return angle(i.z.dot(j.y).times(-1.0), i.z.dot(j.z))
    if name == "B3":
        return angle(i.y.dot(j.x).times(-1.0), i.x.dot(j.x))
    a, b = i.z.dot(j.y), i.z.dot(j.z)
    return angle(i.z.dot(j.x), root(a * a + b * b))


#: name: (rows, which freedoms its posture may use: r all turns, z about z, s along z, p in the
#: xy plane, a anywhere, h a cross of HOOKE, u one of UNIVERSAL, c two shafts)
JOINTS = {
    "SPHERICAL": (_together, "r"),
    "REVOLUTE": (all_of(_together, _parallel), "z"),
    "FIXED": (all_of(_together, _parallel, _same_turn), ""),
    "TRANSLATIONAL": (all_of(_on_line, _parallel, _same_turn), "s"),
    "CYLINDRICAL": (all_of(_on_line, _parallel), "zs"),
    "PLANAR": (all_of(_in_plane, _parallel), "zp"),
    "HOOKE": (all_of(_together, _same_turn), "h"),
    "UNIVERSAL": (all_of(_together, _square), "u"),
    "CONVEL": (all_of(_together, _equal_speed), "c"),
}
PRIMITIVES = {
    "ATPOINT": (_together, "r"),
    "INLINE": (_on_line, "rs"),
    "INPLANE": (_in_plane, "rp"),
    "ORIENTATION": (all_of(_parallel, _same_turn), "a"),
    "PARALLEL_AXES": (_parallel, "za"),
    "PERPENDICULAR": (_square, "ua"),
}


def screw(i: Axes, j: Axes, pitch: float) -> Jet:
    """Travel of I along z of J less what its turn about it asks for."""
    return separation(i, j).dot(j.z) - turn(i, j).times(pitch / (2.0 * pi))


def rack(i: Axes, j: Axes, diameter: float) -> Jet:
    """Travel of the rack J along its own z less the turn of the pinion I seen from it."""
    seen = angle(i.y.dot(j.z).times(-1.0), i.x.dot(j.z))
    return separation(i, j).dot(j.z).times(-1.0) - seen.times(0.5 * diameter)


#: name: (row with a length, posture, argument)
GEARS = {"SCREW": (screw, "zs", "PITCH"), "RACKPIN": (rack, "ua", "PD")}


def displaced(rng: np.random.Generator, freedoms: str) -> tuple[Array, Array]:
    """Where I may be as seen from J: offset (3,) [m] and axes (3, 3)."""
    d, turned = np.zeros(3), np.eye(3)
    bend = rng.uniform(-0.9, 0.9)
    if "r" in freedoms:
        turned = any_rotation(rng)
    if "h" in freedoms:
        turned = about(1, bend) @ about(0, rng.uniform(-0.9, 0.9))
    if "u" in freedoms:
        turned = about(2, rng.uniform(-3, 3)) @ about(0, pi / 2) @ about(2, rng.uniform(-3, 3))
    if "c" in freedoms:
        way = about(2, rng.uniform(-3, 3))
        turned = way @ about(0, bend) @ way.T
    if "z" in freedoms:
        turned = about(2, rng.uniform(-2.5, 2.5))
    if "s" in freedoms:
        d[2] = rng.uniform(-0.5, 0.5)
    if "p" in freedoms:
        d[:2] = rng.uniform(-0.5, 0.5, 2)
    if "a" in freedoms:
        d = rng.uniform(-0.5, 0.5, 3)
    return d, turned

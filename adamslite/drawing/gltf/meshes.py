"""Triangles of solids.

A mesh is positions (n, 3), normals (n, 3) and triangles (m, 3), counterclockwise from outside.
"""

from __future__ import annotations

from math import pi
from typing import Any, TypeAlias

import numpy as np

Mesh: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray]
Profile: TypeAlias = list[tuple[float, float]]

AROUND = 32
"""Segments of a full turn."""
ALONG = 12
"""Segments from pole to pole."""
SPOKE = 1.02
"""Of a spoke over the width of its wheel."""


def lathe(profile: Profile, angle: float = 2 * pi, smooth: bool = False) -> Mesh:
    """The surface that a line of points (r, z) sweeps about z; a line that goes up has its outside
    away from the axis.  `smooth`: normals are means at its corners, else each piece has its own.
    """
    p = np.array(profile, dtype=float)
    along = np.diff(p, axis=0)
    flat = np.stack([along[:, 1], -along[:, 0]], axis=1)
    flat /= np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), 1e-300)
    first = last = flat
    if smooth:
        closed = np.allclose(p[0], p[-1])
        before, after = (flat[-1:], flat[:1]) if closed else (flat[:1], flat[-1:])
        first = np.concatenate([before, flat[:-1]]) + flat
        last = flat + np.concatenate([flat[1:], after])
    count = max(int(np.ceil(AROUND * abs(angle) / (2 * pi))), 1)
    turns = np.linspace(0.0, angle, count + 1)
    pieces = []
    for k in range(len(along)):
        rows = [(p[k], first[k]), (p[k + 1], last[k])]
        points = np.concatenate([_swept(point, turns) for point, _ in rows])
        normals = np.concatenate([_swept(_unit(normal), turns) for _, normal in rows])
        pieces.append((points, normals, _strip(count, p[k, 0] > 0, p[k + 1, 0] > 0)))
    return joined(pieces)


def _swept(rz: np.ndarray, turns: np.ndarray) -> np.ndarray:
    return np.stack([rz[0] * np.cos(turns), rz[0] * np.sin(turns), np.full(len(turns), rz[1])], 1)


def _unit(vector: np.ndarray) -> np.ndarray:
    return vector / max(float(np.linalg.norm(vector)), 1e-300)


def _strip(count: int, below: bool, above: bool) -> np.ndarray:
    """Triangles between two rows of count + 1 points, of which one may be a single place."""
    low = np.arange(count)
    high = low + count + 1
    triangles = [np.stack([low, low + 1, high + 1], 1)] if below else []
    triangles += [np.stack([low, high + 1, high], 1)] if above else []
    return np.concatenate([*triangles, np.zeros((0, 3), dtype=int)])


def joined(meshes: list[Mesh]) -> Mesh:
    """Meshes as one."""
    starts = np.cumsum([0, *(len(points) for points, _, _ in meshes)])
    triangles = [t + start for (_, _, t), start in zip(meshes, starts, strict=False)]
    return (
        np.concatenate([points for points, _, _ in meshes]),
        np.concatenate([normals for _, normals, _ in meshes]),
        np.concatenate(triangles),
    )


def box(low: tuple[float, ...], high: tuple[float, ...]) -> Mesh:
    """A box between two corners, in any order."""
    a, b = np.minimum(low, high), np.maximum(low, high)
    pieces = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end, sign in ((a, -1.0), (b, 1.0)):
            points = np.tile(end, (4, 1)).astype(float)
            points[:, u] = [a[u], b[u], b[u], a[u]]
            points[:, v] = [a[v], a[v], b[v], b[v]]
            normals = np.zeros((4, 3))
            normals[:, axis] = sign
            order = [[0, 1, 2], [0, 2, 3]] if sign > 0 else [[0, 2, 1], [0, 3, 2]]
            pieces.append((points, normals, np.array(order)))
    return joined(pieces)


def frustum(bottom: float, top: float, length: float, angle: float = 2 * pi) -> Mesh:
    """From z = 0 to z = length, which may be negative."""
    profile = [(0.0, 0.0), (bottom, 0.0), (top, length), (0.0, length)]
    mesh = lathe(profile if length > 0 else profile[::-1], angle)
    return joined([mesh, *_cuts(profile, angle)]) if angle < 2 * pi - 1e-6 else mesh


def _cuts(profile: Profile, angle: float) -> list[Mesh]:
    """The two plane faces of a sector, seen from both sides."""
    found = []
    for turn in (0.0, angle):
        points = np.concatenate([_swept(np.array(rz), np.array([turn])) for rz in profile])
        normal = np.array([[np.sin(turn), -np.cos(turn), 0.0]])
        for sign in (1.0, -1.0):
            order = [[0, 1, 2], [0, 2, 3]] if sign > 0 else [[0, 2, 1], [0, 3, 2]]
            found.append((points, np.repeat(sign * normal, 4, axis=0), np.array(order)))
    return found


def ball(x: float, y: float, z: float) -> Mesh:
    """An ellipsoid with these half axes."""
    turns = np.linspace(-pi / 2, pi / 2, ALONG + 1)
    around = np.cos(turns)
    around[[0, -1]] = 0.0  # exactly, at the poles
    points, normals, triangles = lathe(list(zip(around, np.sin(turns), strict=True)), smooth=True)
    half = np.array([x, y, z])
    normals = normals / half
    return points * half, normals / np.linalg.norm(normals, axis=1, keepdims=True), triangles


def torus(major: float, minor: float) -> Mesh:
    turns = np.linspace(0.0, 2 * pi, 2 * ALONG + 1)
    ring = [(major + minor * np.cos(a), minor * np.sin(a)) for a in turns]
    return lathe(ring, smooth=True)


def wheel(radius: float, width: float) -> Mesh:
    """A disc about z, with a spoke."""
    half, thick = width / 2, radius / 12
    points, normals, triangles = frustum(radius, radius, width)
    disc = (points - [0.0, 0.0, half], normals, triangles)
    reach = SPOKE * half
    return joined([disc, box((0.0, -thick, -reach), (0.9 * radius, thick, reach))])


def rectangle(shape: dict[str, Any]) -> Mesh:
    """A PLANE, seen from both sides."""
    x, y = (shape["xmin"], shape["xmax"]), (shape["ymin"], shape["ymax"])
    points = np.array([[x[a], y[b], 0.0] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
    up = np.tile([0.0, 0.0, 1.0], (4, 1))
    return joined([
        (points, up, np.array([[0, 1, 2], [0, 2, 3]])),
        (points, -up, np.array([[0, 2, 1], [0, 3, 2]])),
    ])  # fmt: skip


def mesh_of(shape: dict[str, Any], thin: float) -> Mesh | None:
    """The mesh of a shape of a scene in its frame, rods `thin`; None for lines and points."""
    kind = shape["kind"]
    if kind == "cylinder":
        return frustum(shape["radius"], shape["radius"], shape["length"], shape["angle"])
    if kind == "frustum":
        return frustum(shape["bottom"], shape["top"], shape["length"], shape["angle"])
    if kind == "box":
        return box((0.0, 0.0, 0.0), (shape["x"], shape["y"], shape["z"]))
    if kind == "inertia_box":
        half = (shape["x"] / 2, shape["y"] / 2, shape["z"] / 2)
        return box(tuple(-x for x in half), half)
    if kind == "plane":
        return rectangle(shape)
    return _round(shape, thin)


def _round(shape: dict[str, Any], thin: float) -> Mesh | None:
    kind = shape["kind"]
    if kind == "ellipsoid":
        return ball(shape["x"] / 2, shape["y"] / 2, shape["z"] / 2)
    if kind == "sphere":
        return ball(*[shape["radius"]] * 3)
    if kind == "torus":
        return torus(shape["major"], shape["minor"])
    if kind == "wheel":
        return wheel(shape["radius"], shape["width"])
    return None if kind != "rod" else _rod(np.array(shape["to"]), thin)


def _rod(to: np.ndarray, thin: float) -> Mesh:
    """A cylinder from the origin to a point."""
    length = float(np.linalg.norm(to))
    z = to / length
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(z)))], z)
    x /= np.linalg.norm(x)
    turn = np.stack([x, np.cross(z, x), z])
    points, normals, triangles = frustum(thin, thin, length)
    return points @ turn, normals @ turn, triangles

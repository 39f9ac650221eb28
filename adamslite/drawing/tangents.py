"""Where the straight spans of a cable touch its wheels.

Along the direction d of a span from wheel i to wheel j, with D = C_j - C_i, k = s_j R_j - s_i R_i
(s: sense of the line about the axis a) and d at the angle q to D in the plane across a::

    sin q = -k/|D|,      P = C + s R d x a

as in :mod:`adamslite.cables.layout.geometry`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from adamslite.drawing.drawing import Drawing


@dataclass(frozen=True)
class Stop:
    """A node of a cable at all frames: place (nt, 3), axis (nt, 3) and signed radius of a wheel."""

    place: np.ndarray
    axis: np.ndarray
    radius: float


def spans(drawing: Drawing, nodes: list[dict]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Both ends (nt, 3) of every straight span of a cable."""
    stops = [_stop(drawing, node) for node in nodes]
    return [_span(a, b) for a, b in zip(stops, stops[1:], strict=False)]


def _stop(drawing: Drawing, node: dict) -> Stop:
    motion = drawing.motion
    body, x, y, z, *turn = node.get("wheel") or node["point"]
    place = motion.of_point(int(body), np.array([x, y, z]))
    if not turn:
        return Stop(place, np.zeros((1, 3)), 0.0)
    axis = motion.of_vector(int(body), _axis(np.array(turn)))
    return Stop(place, axis, node["sense"] * node["radius"])


def _axis(q: np.ndarray) -> np.ndarray:
    x, y, z, w = q
    return np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])


def _span(a: Stop, b: Stop) -> tuple[np.ndarray, np.ndarray]:
    if not (a.radius or b.radius):
        return a.place, b.place
    axis = a.axis if a.radius else b.axis
    between = b.place - a.place
    flat = between - (between * axis).sum(axis=1, keepdims=True) * axis
    length = np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), 1e-300)
    ahead = flat / length
    sine = np.clip(-(b.radius - a.radius) / length, -1.0, 1.0)
    along = np.sqrt(1 - sine**2) * ahead + sine * np.cross(axis, ahead)
    start = a.place + a.radius * np.cross(along, a.axis)
    return start, b.place + b.radius * np.cross(along, b.axis)

"""A scene as an animated model: bodies with their solids, and lines as thin rods that stretch.

In the file lengths are metres, times seconds, and y is up, as glTF has them.  It has no place for
plots, arrows, and colours by tension.

Where the straight span of a cable from wheel i to wheel j touches them, with its direction d at the
angle q to D = C_j - C_i in the plane across the axis a, k = s_j R_j - s_i R_i (s: sense of the line
about a)::

    sin q = -k/|D|,      P = C + s R d x a

as in :mod:`adamslite.cables.layout.geometry`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

import adamslite
from adamslite.deck.deck import Deck
from adamslite.drawing.drawing import Drawing
from adamslite.drawing.gltf.container import Container
from adamslite.drawing.gltf.meshes import frustum, mesh_of
from adamslite.drawing.motion import FAR
from adamslite.drawing.scene import Contents, contents, up
from adamslite.elements.units import Units
from adamslite.language import units
from adamslite.results.results import Results

# Of Okabe and Ito, which colour-blind people distinguish.
COLOURS = (
    (0.0, 0.45, 0.70), (0.90, 0.62, 0.0), (0.0, 0.62, 0.45), (0.80, 0.47, 0.65),
    (0.34, 0.71, 0.91), (0.84, 0.37, 0.0), (0.94, 0.89, 0.26),
)  # fmt: skip
GREY, ROPE = (0.55, 0.55, 0.55), (0.15, 0.15, 0.15)
THIN, ROPE_THIN = 0.006, 0.003
"""Radii of rods and lines, as shares of the size of the scene."""
UPRIGHT = {
    "x": [0.0, 0.0, 0.5**0.5, 0.5**0.5], "y": [0.0, 0.0, 0.0, 1.0],
    "z": [-(0.5**0.5), 0.0, 0.0, 0.5**0.5],
}  # fmt: skip
"""Rotations that bring an axis up to y."""
RESTS = 1e-9
"""Travel that is round-off, as a share of the size of the scene."""


def model(deck: Deck, results: Results) -> bytes:
    """The file of a deck and its results."""
    drawing = Drawing(deck, results)
    found = contents(drawing)
    file = Container(f"adamslite {adamslite.__version__}")
    names = deck.single(Units).names
    metre, second = (units.LENGTH[names[2]], units.TIME[names[3]]) if names else (1.0, 1.0)
    root = file.node(name=deck.title, rotation=UPRIGHT[up(deck.gravity)], scale=[metre] * 3)
    times = file.array(second * _increasing(drawing.motion.time), bounds=True)
    _bodies(file, root, times, drawing, found)
    _lines(file, root, times, drawing, found)
    return file.content(root, deck.title)


def _increasing(time: np.ndarray) -> np.ndarray:
    """Times of 32 bits that grow, from zero on, as samplers need them; a moment that comes twice
    is followed by the next number.
    """
    found = (time - time[0]).astype(np.float32)
    for k in range(1, len(found)):
        if found[k] <= found[k - 1]:
            found[k] = np.nextafter(found[k - 1], np.float32(np.inf))
    return found


def _bodies(file: Container, root: int, times: int, drawing: Drawing, found: Contents) -> None:
    """A node for each body, which moves, with those of its shapes."""
    labels = ["ground", *(body.statement.label for body in drawing.model.bodies)]
    used = sorted({shape["body"] for shape in found.shapes} | set(range(1, len(labels))))
    for body in used:
        track = drawing.motion.tracks[body]
        node = file.node(root, name=labels[body], translation=_list(track.position[0]),
                         rotation=_list(track.attitude[0]))  # fmt: skip
        if np.ptp(track.position, axis=0).max() > RESTS * drawing.size:
            file.animate(node, "translation", times, track.position)
        if track.has_turned and np.ptp(track.attitude, axis=0).max() > RESTS:
            file.animate(node, "rotation", times, track.attitude)
        own = [shape for shape in found.shapes if shape["body"] == body]
        material = file.material(COLOURS[body % len(COLOURS)] if body else GREY) if own else 0
        for shape in own:
            _solid(file, node, shape, material, THIN * drawing.size)


def _solid(file: Container, node: int, shape: dict[str, Any], material: int, thin: float) -> None:
    with np.errstate(all="ignore"):
        mesh = mesh_of(shape, thin)
    if mesh is not None and len(mesh[2]) and (np.abs(mesh[0]) < FAR).all():
        number = file.mesh(*mesh, material)
        at, turn = shape["frame"][:3], shape["frame"][3:]
        file.node(node, mesh=number, translation=at, rotation=turn)


def _lines(file: Container, root: int, times: int, drawing: Drawing, found: Contents) -> None:
    """Cables, springs and links: one rod of length 1 for each span, moved and stretched."""
    ends = [pair for cable in found.cables.lines for pair in spans(drawing, cable["nodes"])]
    for line in (*found.springs, *found.links):
        ends += spans(drawing, [{"point": line["i"]}, {"point": line["j"]}])
    if not ends:
        return
    thin = ROPE_THIN * drawing.size
    rod = file.mesh(*frustum(thin, thin, 1.0), file.material(ROPE))
    for start, end in ends:
        node = file.node(root, mesh=rod)
        along = end - start
        length = np.linalg.norm(along, axis=1)
        scale = np.stack([np.ones_like(length), np.ones_like(length), length], axis=1)
        values = {"translation": start, "rotation": _turned(along, length), "scale": scale}
        for path, rows in values.items():
            file.nodes[node][path] = _list(rows[0])
            if np.ptp(rows, axis=0).max() > RESTS * drawing.size:
                file.animate(node, path, times, rows)


def _turned(along: np.ndarray, length: np.ndarray) -> np.ndarray:
    """Quaternions (nt, 4) of the shortest rotations that bring z along vectors (nt, 3)."""
    z = along / np.where(length > 0, length, 1.0)[:, None]
    q = np.stack([-z[:, 1], z[:, 0], np.zeros(len(z)), 1 + z[:, 2]], axis=1)
    size = np.linalg.norm(q, axis=1, keepdims=True)
    down = np.array([1.0, 0.0, 0.0, 0.0])  # half a turn about x, where z points down
    return np.where(size > 1e-9, q / np.maximum(size, 1e-9), down)


def _list(values: np.ndarray) -> list[float]:
    return [float(x) for x in values]


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

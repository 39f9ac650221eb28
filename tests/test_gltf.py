"""Animated models in glTF: what another program loads, and their motion."""

from __future__ import annotations

import io
import json
import struct
from math import pi, sin
from typing import Any

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

import adamslite as al
from adamslite.drawing.gltf.meshes import mesh_of
from adamslite.drawing.gltf.model import model
from adamslite.resources import find
from adamslite.results.results import Results

TURN = 2 * pi
#: Of a prism of 32 sides in a circle.
POLYGON = 32 / TURN * sin(TURN / 32)
CRANE = find("decks") / "cables" / "described" / "crane.adm"


class Gltf:
    """A file taken apart by the rules of the format."""

    def __init__(self, content: bytes) -> None:
        magic, version, length = struct.unpack_from("<4sII", content)
        assert (magic, version, length) == (b"glTF", 2, len(content))
        size, kind = struct.unpack_from("<I4s", content, 12)
        assert kind == b"JSON" and size % 4 == 0
        self.plain: dict[str, Any] = json.loads(content[20 : 20 + size])
        binary, kind = struct.unpack_from("<I4s", content, 20 + size)
        assert kind == b"BIN\0" and binary % 4 == 0
        self.block = content[28 + size :]
        assert len(self.block) == binary

    def array(self, accessor: int) -> np.ndarray:
        described = self.plain["accessors"][accessor]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[described["type"]]
        view = self.plain["bufferViews"][described["bufferView"]]
        kind = {5126: "<f4", 5125: "<u4"}[described["componentType"]]
        count = described["count"] * width
        return np.frombuffer(self.block, kind, count, view["byteOffset"]).reshape(-1, width)

    def animated(self, name: str, path: str) -> tuple[np.ndarray, np.ndarray]:
        """Times and values of one property of a node."""
        (motion,) = self.plain["animations"]
        (node,) = (k for k, each in enumerate(self.plain["nodes"]) if each.get("name") == name)
        (channel,) = (c for c in motion["channels"] if c["target"] == {"node": node, "path": path})
        sampler = motion["samplers"][channel["sampler"]]
        return self.array(sampler["input"])[:, 0], self.array(sampler["output"])


@pytest.mark.parametrize(
    ("shape", "volume"),
    [
        ({"kind": "cylinder", "length": 3, "radius": 2, "angle": TURN}, pi * 12 * POLYGON),
        ({"kind": "cylinder", "length": -3, "radius": 2, "angle": TURN}, pi * 12 * POLYGON),
        ({"kind": "cylinder", "length": 3, "radius": 2, "angle": pi}, None),
        (
            {"kind": "frustum", "length": 3, "bottom": 2, "top": 1, "angle": TURN},
            pi * (4 + 2 + 1) * POLYGON,
        ),
        ({"kind": "frustum", "length": -3, "bottom": 0, "top": 1, "angle": TURN}, pi * POLYGON),
        ({"kind": "box", "x": 1, "y": -2, "z": 3}, 6),
        ({"kind": "inertia_box", "x": 1, "y": 2, "z": 3}, 6),
        ({"kind": "ellipsoid", "x": 2, "y": 4, "z": 6}, 8 * pi * 0.96),
        ({"kind": "sphere", "radius": 1}, 4 / 3 * pi * 0.96),
        ({"kind": "torus", "major": 3, "minor": 1}, 6 * pi * pi * 0.98),
        ({"kind": "rod", "to": [0, 3, 4]}, pi * 5 * 0.01 * POLYGON),
        ({"kind": "plane", "xmin": -1, "xmax": 2, "ymin": 0, "ymax": 1}, None),
    ],
)
def test_solids_are_closed_and_outside_out(shape: dict, volume: float | None) -> None:
    """Their volume (positive when the triangles are seen counterclockwise from outside) is that of
    the polygons in the circles: 1 % and, for balls and rings of flat pieces, 2 % of the true one.
    Normals are units that point the same way as the triangles.
    """
    made = mesh_of(shape, 0.1)
    assert made is not None
    points, normals, triangles = made
    solid = trimesh.Trimesh(points, triangles)  # merges points that are one
    if volume is not None:
        assert solid.is_watertight
        assert solid.volume == pytest.approx(volume, rel=0.02)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    faces = np.cross(b - a, c - a)
    big = np.linalg.norm(faces, axis=1) > 1e-9
    facing = (faces[:, None] * normals[triangles]).sum(axis=2)[big]
    assert (facing > 0).all()
    used = np.unique(triangles[big])
    assert np.linalg.norm(normals[used], axis=1) == pytest.approx(1)


def test_a_cylinder_of_negative_length_lies_below_its_marker() -> None:
    below = mesh_of({"kind": "cylinder", "length": -3, "radius": 2, "angle": TURN}, 0.1)
    assert below is not None
    assert (below[0][:, 2].min(), below[0][:, 2].max()) == (-3, 0)


def test_another_program_loads_the_crane() -> None:
    """A wheel, a load and a rope: three meshes, and one node for each body; the load hangs 8 m
    below the origin, half of its ball of 0.787 m below that.
    """
    deck = al.read(CRANE)
    content = model(deck, al.simulate(deck))
    loaded = trimesh.load_scene(io.BytesIO(content), file_type="glb")
    names = set(loaded.graph.nodes)
    assert {"PART/12", "PART/10", "POINT_MASS/20"} <= names
    low, high = loaded.bounds
    assert low[1] == pytest.approx(-8 - 0.787 / 2, abs=1e-3) and high[1] < 0.5


def test_bodies_move_as_the_results_say() -> None:
    """To seven digits; the rope is a tangent to the rim: its length squared is the distance of the
    load from the axle squared, less R squared.
    """
    deck = al.read(CRANE)
    results = al.simulate(deck)
    file = Gltf(model(deck, results))
    time, position = file.animated("POINT_MASS/20", "translation")
    assert time == pytest.approx(results.time, abs=1e-6)
    expected = np.stack([results[f"POINT_MASS/20.{x}"] for x in "xyz"], axis=1)
    assert position == pytest.approx(expected, abs=1e-5)
    _, turned = file.animated("PART/10", "rotation")
    angle = 2 * np.unwrap(np.arctan2(turned[:, 2], turned[:, 3]))
    assert angle[-1] - angle[0] == pytest.approx(-4 / 0.3, abs=1e-3)
    (motion,) = file.plain["animations"]
    lengths = [c for c in motion["channels"] if c["target"]["path"] == "scale"]
    rope = file.array(motion["samplers"][lengths[0]["sampler"]]["output"])[:, 2]
    away = expected - np.stack([results[f"PART/10.{x}"] for x in "xyz"], axis=1)
    assert rope == pytest.approx(np.sqrt((away**2).sum(axis=1) - 0.3**2), abs=1e-5)


def test_metres_seconds_and_y_up() -> None:
    """A deck in millimetres and milliseconds with z up: its root turns z to y and scales."""
    text = """Falling
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=MILLISECONDS
ACCGRAV/KGRAV=-9.81E-3
PART/1, GROUND
POINT_MASS/2, MASS=1, QG=0,0,1000
MARKER/2, POINT_MASS=2
SIMULATE/DYNAMIC, END=100, STEPS=10
END
"""
    deck = al.read(text)
    file = Gltf(model(deck, al.simulate(deck)))
    root = file.plain["nodes"][file.plain["scenes"][0]["nodes"][0]]
    assert root["scale"] == [1e-3] * 3
    assert Rotation.from_quat(root["rotation"]).apply([0, 0, 1]) == pytest.approx([0, 1, 0])
    time, position = file.animated("POINT_MASS/2", "translation")
    assert time[-1] == pytest.approx(0.1)
    assert position[-1, 2] == pytest.approx(1000 - 9.81e-3 * 100**2 / 2, abs=0.02)


def test_times_that_come_twice_still_grow() -> None:
    """A static analysis before a dynamic one: two rows at t = 0."""
    deck = al.read("x\nPART/1, GROUND\nPOINT_MASS/2, MASS=1\nMARKER/2, POINT_MASS=2\nEND\n")
    names = ("POINT_MASS/2.x", "POINT_MASS/2.y", "POINT_MASS/2.z")
    values = np.arange(9.0).reshape(3, 3)
    results = Results(time=np.array([0.0, 0.0, 1.0]), names=names, values=values)
    time, _ = Gltf(model(deck, results)).animated("POINT_MASS/2", "translation")
    assert (np.diff(time) > 0).all() and time[1] < 1e-30


def test_nothing_that_moves_is_a_model_at_rest() -> None:
    deck = al.read("x\nPART/1, GROUND\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2, PART=2\nEND\n")
    none = Results(time=np.zeros(0), names=(), values=np.zeros((0, 0)))
    file = Gltf(model(deck, none))
    assert "animations" not in file.plain
    assert file.plain["nodes"][1]["rotation"] == [0, 0, 0, 1]

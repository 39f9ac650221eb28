"""The parts of a binary glTF file: a JSON text with nodes, and one block with their arrays.

Source: Khronos Group, glTF 2.0 specification (ISO/IEC 12113:2022).
"""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np

MAGIC, VERSION = b"glTF", 2
JSON_CHUNK, BINARY_CHUNK = b"JSON", b"BIN\0"
FLOAT, UNSIGNED = 5126, 5125
KINDS = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}


class Container:
    """Nodes, meshes, materials and animation channels that are being put together."""

    def __init__(self, generator: str) -> None:
        self.nodes: list[dict[str, Any]] = []
        self._meshes: list[dict[str, Any]] = []
        self._materials: list[dict[str, Any]] = []
        self._accessors: list[dict[str, Any]] = []
        self._views: list[dict[str, Any]] = []
        self._channels: list[dict[str, Any]] = []
        self._samplers: list[dict[str, Any]] = []
        self._pieces: list[bytes] = []
        self._size = 0
        self._generator = generator

    def node(self, parent: int | None = None, **properties: Any) -> int:
        """A node, among the children of another one; its number."""
        self.nodes.append(properties)
        number = len(self.nodes) - 1
        if parent is not None:
            self.nodes[parent].setdefault("children", []).append(number)
        return number

    def material(self, colour: tuple[float, float, float]) -> int:
        """An opaque, matt one."""
        look = {"baseColorFactor": [*colour, 1.0], "metallicFactor": 0.1, "roughnessFactor": 0.6}
        self._materials.append({"pbrMetallicRoughness": look})
        return len(self._materials) - 1

    def mesh(
        self, points: np.ndarray, normals: np.ndarray, triangles: np.ndarray, material: int
    ) -> int:
        """Triangles in one material."""
        attributes = {"POSITION": self.array(points, bounds=True), "NORMAL": self.array(normals)}
        indices = self.array(triangles.reshape(-1), kind=UNSIGNED)
        part = {"attributes": attributes, "indices": indices, "material": material}
        self._meshes.append({"primitives": [part]})
        return len(self._meshes) - 1

    def array(self, values: np.ndarray, bounds: bool = False, kind: int = FLOAT) -> int:
        """An accessor of numbers (n,) or (n, c)."""
        content = np.ascontiguousarray(values, dtype="<f4" if kind == FLOAT else "<u4")
        rows = content.reshape(len(content), -1)
        self._views.append({"buffer": 0, "byteOffset": self._size, "byteLength": content.nbytes})
        accessor: dict[str, Any] = {
            "bufferView": len(self._views) - 1, "componentType": kind, "count": len(rows),
            "type": KINDS[rows.shape[1]],
        }  # fmt: skip
        if bounds:
            accessor["min"] = rows.min(axis=0).tolist()
            accessor["max"] = rows.max(axis=0).tolist()
        self._accessors.append(accessor)
        self._pieces.append(content.tobytes())
        self._size += content.nbytes
        return len(self._accessors) - 1

    def animate(self, node: int, path: str, times: int, values: np.ndarray) -> None:
        """Values (nt, c) of translation, rotation or scale of a node at the times of an array."""
        sampler = {"input": times, "output": self.array(values), "interpolation": "LINEAR"}
        self._samplers.append(sampler)
        target = {"node": node, "path": path}
        self._channels.append({"sampler": len(self._samplers) - 1, "target": target})

    def content(self, root: int, name: str) -> bytes:
        """The file."""
        described: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": self._generator},
            "scene": 0,
            "scenes": [{"name": name, "nodes": [root]}],
            "nodes": self.nodes,
        }
        for key, found in (
            ("meshes", self._meshes), ("materials", self._materials),
            ("accessors", self._accessors), ("bufferViews", self._views),
        ):  # fmt: skip
            described |= {key: found} if found else {}
        if self._size:
            described["buffers"] = [{"byteLength": self._size}]
        if self._channels:
            motion = {"name": "motion", "channels": self._channels, "samplers": self._samplers}
            described["animations"] = [motion]
        text = json.dumps(described, separators=(",", ":"), allow_nan=False).encode()
        chunks = _chunk(JSON_CHUNK, text, b" ")
        chunks += _chunk(BINARY_CHUNK, b"".join(self._pieces), b"\0") if self._size else b""
        return MAGIC + struct.pack("<II", VERSION, 12 + len(chunks)) + chunks


def _chunk(kind: bytes, content: bytes, padding: bytes) -> bytes:
    padded = content + padding * (-len(content) % 4)
    return struct.pack("<I", len(padded)) + kind + padded

"""Scenes as a page gets them, and what a page makes of their arrays."""

from __future__ import annotations

import json
import re
import zlib
from base64 import b64decode
from typing import Any

import numpy as np

from adamslite.drawing.scene import Scene


def decoded(drawn: Scene, reference: Any) -> np.ndarray:
    """The values of a reference, as the page decodes them; a plain list as it is."""
    if not isinstance(reference, dict):
        return np.array(reference, dtype=float)
    block = zlib.decompress(b64decode(drawn.block))
    shape, at = reference["shape"], reference["at"]
    count = int(np.prod(shape))
    if reference["coding"] == "f32":
        return np.frombuffer(block, "<f4", count, at).reshape(shape).astype(float)
    low = np.frombuffer(block, np.uint8, count, at).astype(np.uint16)
    high = np.frombuffer(block, np.uint8, count, at + count).astype(np.uint16)
    differences = (low + 256 * high).reshape(shape)
    k = np.cumsum(differences, axis=0, dtype=np.uint16)
    return np.array(reference["low"]) + np.array(reference["step"]) * k


def plain_list(drawn: Scene, source: Any) -> list[dict[str, Any]]:
    """A list that may be kept among the arrays."""
    if isinstance(source, list):
        return source
    block = zlib.decompress(b64decode(drawn.block))
    found: list[dict[str, Any]] = json.loads(
        block[source["at"] : source["at"] + source["shape"][0]]
    )
    return found


def scene_of(page: str) -> Scene:
    """The scene inside the text of a page."""
    plain = re.search(r'<script type="application/json" id="scene">(.*?)</script>', page, re.S)
    block = re.search(r'<script type="text/plain" id="data">(.*?)</script>', page, re.S)
    assert plain and block
    return Scene(json.loads(plain[1]), block[1])


def named(entries: list[dict[str, Any]], name: str, key: str = "name") -> dict[str, Any]:
    """The only entry with a name."""
    (found,) = (each for each in entries if each[key] == name)
    return found

"""Arrays of a page: numbers in one compressed block, and references to them.

A reference is ``{"at": offset in bytes, "shape": [...], "coding": "f32" | "i16" | "json"}``.

    f32   float32, little-endian, row by row
    i16   [n] or [..., C]: value = low[c] + step[c] k, k from 0 to 65535; stored are the differences
          of k along the first axis modulo 65536 (the first row as it is), all low bytes, then all
          high bytes, which compresses better than the numbers
    json  text in UTF-8, of as many bytes as the shape: long lists of names compress well
"""

from __future__ import annotations

import json
import zlib
from base64 import b64encode
from typing import Any

import numpy as np

Reference = dict[str, Any]
LEVELS = 65535
"""Most steps from the least to the largest value of a component."""
DIGITS = 8
COMPRESSION = 6
# Below this, numbers of 32 bits lose digits.
LEAST = float(np.finfo(np.float32).tiny)
LARGEST = float(np.finfo(np.float32).max)


class Block:
    """Arrays one after the other, each from a multiple of four bytes on; equal ones once."""

    def __init__(self) -> None:
        self._pieces: dict[bytes, int] = {}
        self._size = 0

    def f32(self, values: np.ndarray) -> Reference:
        """Numbers with seven digits; what is no number stays none."""
        values = np.clip(np.asarray(values, dtype=float), -LARGEST, LARGEST)
        small = np.where(np.abs(values) < LEAST, 0.0, values)
        return self._reference(small.astype("<f4").tobytes(), values.shape, "f32")

    def i16(self, values: np.ndarray, levels: int = LEVELS) -> Reference:
        """Numbers in so many steps of the range of their component; all must be finite."""
        values = np.asarray(values, dtype=float)
        low, step, k = _steps(values.reshape(-1, values.shape[-1]), levels)
        made = self._reference(_planes(k), values.shape, "i16")
        return {**made, "low": low.tolist(), "step": step.tolist()}

    def columns(self, values: np.ndarray, levels: int = LEVELS) -> list[Reference]:
        """The same for each column (n,) of values (n, nc); one that is not finite in 32 bits."""
        finite = np.isfinite(values).all(axis=0)
        low, step, k = _steps(np.where(finite, values, 0.0), levels)
        found = []
        for c, (own, start, size) in enumerate(zip(k.T, low.tolist(), step.tolist(), strict=True)):
            if finite[c]:
                made = self._reference(_planes(own[:, None]), (len(values),), "i16")
                found.append({**made, "low": [start], "step": [size]})
            else:
                found.append(self.f32(values[:, c]))
        return found

    def json(self, plain: object) -> Reference:
        """Plain data."""
        text = json.dumps(plain, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
        content = text.encode()
        return self._reference(content, (len(content),), "json")

    def _reference(self, content: bytes, shape: tuple[int, ...], coding: str) -> Reference:
        padded = content + bytes(-len(content) % 4)
        at = self._pieces.setdefault(padded, self._size)
        if at == self._size:
            self._size += len(padded)
        return {"at": at, "shape": list(shape), "coding": coding}

    def text(self) -> str:
        """The block, compressed (RFC 1950), in base 64."""
        return b64encode(zlib.compress(b"".join(self._pieces), COMPRESSION)).decode("ascii")


def _steps(rows: np.ndarray, levels: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """low and step of each column of rows (n, c), and k (n, c)."""
    low = short(rows.min(axis=0, initial=np.inf if len(rows) else 0.0))
    step = short((rows.max(axis=0, initial=-np.inf if len(rows) else 0.0) - low) / levels)
    k = np.clip(np.rint((rows - low) / np.where(step > 0, step, 1.0)), 0, levels)
    return low, step, k.astype(np.uint16)


def _planes(k: np.ndarray) -> bytes:
    """Differences along the rows, low bytes before high ones."""
    stored = np.diff(k, axis=0, prepend=np.zeros_like(k[:1])).astype("<u2")
    return stored.reshape(-1).view(np.uint8).reshape(-1, 2).T.tobytes()


def short(values: np.ndarray) -> np.ndarray:
    """Numbers to the digits that 16 bits can show, which are fewer to write."""
    size = np.floor(np.log10(np.maximum(np.abs(values), LEAST)))
    power = 10.0 ** (DIGITS - size)
    found: np.ndarray = np.rint(values * power) / power
    return found

"""Tables of numbers as text, with the fewest digits that read back to the same bits.

The text of a number is that of Python (``1e-05``, ``0.1``, ``1e+16``). Where orjson is installed
(extra ``fast``) it finds the digits, five times faster, and the spelling of exponents is adapted.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from types import ModuleType

import numpy as np

# Below this number of values the import would take longer than it saves.
MANY = 20_000
# Numbers at a time, whatever the width of the table: a text of some hundred kilobytes. Larger ones
# are not written faster, and the copies that are made of them leave gaps in the heap.
BLOCK = 2**14
# What may be looked at behind the last number.
BEHIND = b"\0" * 8
# Numbers whose spelling differs between programs.
PROBES = np.array([[1e-05, -2.5e-05, 9.99e-05, 1e-4, 1e15, 1e16, -1.5e16, 1e21, 1e22, 1e100, 0.1,
                    -0.0, 5e-324, 1.7976931348623157e308, 1e-7, -1.25e-10, 123456.0]])  # fmt: skip


def lines(*tables: np.ndarray) -> Iterator[str]:
    """The rows of tables (n, m) beside each other as lines, numbers separated by commas."""
    count, width = len(tables[0]), sum(each.shape[1] for each in tables)
    fast = _orjson() if count * width >= MANY else None
    step = max(1, BLOCK // max(1, width))
    for start in range(0, count, step):
        block = np.concatenate([each[start : start + step] for each in tables], axis=1)
        if fast and np.isfinite(block).all():
            yield _by_orjson(fast, block)
        else:
            yield _by_python(block)


def _by_python(block: np.ndarray) -> str:
    return "".join(",".join(map(repr, row)) + "\n" for row in block.tolist())


def _by_orjson(orjson: ModuleType, block: np.ndarray) -> str:
    """The same from what orjson writes, ``[[1.5,1e-7],[..]]``."""
    plain = np.ascontiguousarray(block, dtype=np.float64)
    text = orjson.dumps(plain, option=orjson.OPT_SERIALIZE_NUMPY)
    text = b"\n" + text[2:-2].replace(b"],[", b"\n") + b"\n"
    return _respelled(text)[1:].decode("ascii")


def _respelled(text: bytes) -> bytes:
    """Numbers as Python writes them: ``1e-7`` becomes ``1e-07``, ``1e21`` becomes ``1e+21`` and
    ``0.000012`` becomes ``1.2e-05``.
    """
    found = np.frombuffer(text + BEHIND, dtype=np.uint8).copy()
    letters = np.flatnonzero(found == ord("e"))
    small = letters[found[letters + 1] == ord("-")]
    short = small[~_is_digit(found[small + 3])] + 2
    first, end = _tiny(found)
    many = first[end > first + 1] + 1
    inserted = [(letters[_is_digit(found[letters + 1])] + 1, b"+"), (short, b"0"), (many, b".")]
    inserted += [(end, b"e"), (end, b"-"), (end, b"0"), (end, b"5")]
    found[first[:, None] - np.arange(1, 7)] = 0
    at = np.concatenate([places for places, _ in inserted])
    what = np.concatenate([np.full(len(places), ord(word)) for places, word in inserted])
    return np.insert(found, at, what.astype(np.uint8)).tobytes().translate(None, b"\0")


def _is_digit(characters: np.ndarray) -> np.ndarray:
    return (characters >= ord("0")) & (characters <= ord("9"))


def _tiny(text: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where the digits of ``0.00001234`` begin and end, behind the four zeros."""
    dots = np.flatnonzero(text == ord("."))
    for step, word in ((1, b"0"), (2, b"0"), (3, b"0"), (4, b"0"), (-1, b"0")):
        dots = dots[text[dots + step] == ord(word)]
    dots = dots[~_is_digit(text[dots - 2]) & (text[dots + 5] != ord("0"))]
    dots = dots[_is_digit(text[dots + 5])]
    digits = _is_digit(text)
    end = dots + 6
    while (inside := digits[end]).any():
        end = end + inside
    return dots + 5, end


@cache
def _orjson() -> ModuleType | None:
    """orjson, if it is installed and spells numbers as this module expects."""
    try:
        import orjson
    except ImportError:
        return None
    return orjson if _by_orjson(orjson, PROBES) == _by_python(PROBES) else None

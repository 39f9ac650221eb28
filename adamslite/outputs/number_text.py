"""Tables of numbers as text, with the fewest digits that read back to the same bits.

The text of a number is that of Python (``1e-05``, ``0.1``, ``1e+16``). Where orjson is installed
(extra ``fast``) it finds the digits, five times faster, and the spelling of exponents is adapted.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from types import ModuleType

import numpy as np

# Below this number of values the import would take longer than it saves.
MANY = 20_000
# At a time: a text of some megabytes.
ROWS = 64
# Numbers whose spelling differs between programs.
PROBES = np.array([[1e-05, -2.5e-05, 9.99e-05, 1e-4, 1e15, 1e16, -1.5e16, 1e21, 1e22, 1e100, 0.1,
                    -0.0, 5e-324, 1.7976931348623157e308, 1e-7, -1.25e-10, 123456.0]])  # fmt: skip


def lines(table: np.ndarray) -> Iterator[str]:
    """The rows of a table (n, m) as lines, numbers separated by commas."""
    fast = _orjson() if table.size >= MANY else None
    for start in range(0, len(table), ROWS):
        block = table[start : start + ROWS]
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
    for pattern, spelling in _spellings():
        text = pattern.sub(spelling, text)
    return text[1:].decode("ascii")


@cache
def _spellings() -> list[tuple[re.Pattern[bytes], bytes]]:
    """What orjson writes and what Python does.  Each begins with fixed letters, which makes the
    search fast.
    """
    tiny = [(rb"%b0\.0000([1-9])(\d*)" % before, rb"%b\1.\2e-05" % before)
            for before in (b"\n", b",", b"-")]  # fmt: skip
    rest = [(rb"\.e-05", b"e-05"), (rb"e-(\d)\b", rb"e-0\1"), (rb"e(?=\d)", b"e+")]
    return [(re.compile(pattern), spelling) for pattern, spelling in (*tiny, *rest)]


@cache
def _orjson() -> ModuleType | None:
    """orjson, if it is installed and spells numbers as this module expects."""
    try:
        import orjson
    except ImportError:
        return None
    return orjson if _by_orjson(orjson, PROBES) == _by_python(PROBES) else None

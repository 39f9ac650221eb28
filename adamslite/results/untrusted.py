"""Files of results may come from others: how much is taken from them, and what is not shown.

A compressed text may be a thousand times as long as its file, JSON as deep as it is long.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from adamslite.errors import FormatError
from adamslite.notation import visible

if TYPE_CHECKING:
    from adamslite.results.results import Results

#: So much is a compressed text, or array, at most [bytes].
MOST = 1 << 27
#: So many times as large as its file are the numbers in it at most, where they are more than that.
TIMES = 100


def inflated(data: bytes | memoryview, most: int | None = None) -> bytes:
    """What zlib has compressed.

    Parameters
    ----------
    data : bytes
    most : int, optional
        How much it may be [bytes]; ``MOST`` unless given.

    Raises
    ------
    ValueError, zlib.error
        When it is more than that, is cut off, or is damaged.
    """
    stream, most = zlib.decompressobj(), MOST if most is None else most
    found = stream.decompress(data, most + 1)  # 0 would mean any size
    if len(found) > most:
        raise ValueError(f"what is compressed in it is larger than {most:.2g} bytes")
    if not stream.eof:
        raise ValueError("what is compressed in it ends early")
    return found


def plausible(file_size: int) -> int:
    """How large what a file of so many bytes holds may become [bytes]."""
    return max(MOST, TIMES * file_size)


def need_plausible(count: int, file_size: int) -> None:
    """Reject a file that would unpack to numbers out of all proportion.

    Parameters
    ----------
    count : int
        How many numbers of 8 bytes it says to hold.
    file_size : int
        Its own size [bytes].

    Raises
    ------
    FormatError
    """
    if 8 * count > plausible(file_size):
        raise FormatError(
            f"{file_size / 1e6:.1f} MB of file would become {8 * count / 1e6:.0f} MB of numbers: "
            "results are not that much alike"
        )


def from_json(text: str | bytes, made_of: Callable[[dict[str, Any]], Any] | None = None) -> Any:
    """A value of JSON; ``made_of``: what becomes of objects.

    Raises
    ------
    ValueError
        When it is none, or too deep.
    """
    try:
        return json.loads(text, object_hook=made_of)
    except RecursionError:
        raise ValueError("JSON in it is too deep") from None


def shown(results: Results) -> Results:
    """Results whose names and texts hold no control characters."""
    names = tuple(map(visible, results.names))
    meta = {visible(key): visible(text) for key, text in results.meta.items()}
    channels = {
        visible(name): type(each)(*map(visible, each)) for name, each in results.channels.items()
    }
    message = visible(results.message)
    return replace(results, names=names, meta=meta, message=message, channels=channels)

"""Random changes of files: bits, bytes, blocks and counts."""

from __future__ import annotations

import struct
from collections.abc import Callable
from random import Random

WORDS = (0, 1, 2, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFFFE, 0x10000, 0x7FFF, 255)
BLOCK = 64


def changed(random: Random, data: bytes, most: int = 4) -> bytes:
    """The file after one to ``most`` changes."""
    for _ in range(random.randint(1, most)):
        data = random.choice(CHANGES)(random, data)
    return data


def _place(random: Random, data: bytes) -> int:
    """A place, half of the time near the beginning, where counts and offsets are."""
    near = random.random() < 0.5
    return random.randrange(min(len(data), 400) + 1 if near else len(data) + 1)


def other_bit(random: Random, data: bytes) -> bytes:
    """With one bit inverted."""
    at = _place(random, data)
    return (
        data[:at]
        + bytes(each ^ 1 << random.randrange(8) for each in data[at : at + 1])
        + data[at + 1 :]
    )


def other_byte(random: Random, data: bytes) -> bytes:
    """With another byte."""
    at = _place(random, data)
    return data[:at] + bytes([random.randrange(256)]) + data[at + 1 :]


def other_count(random: Random, data: bytes) -> bytes:
    """With another whole number of four bytes."""
    at = _place(random, data) // 4 * 4
    order = random.choice("<>")
    return data[:at] + struct.pack(f"{order}I", random.choice(WORDS)) + data[at + 4 :]


def cut(random: Random, data: bytes) -> bytes:
    """Without some bytes."""
    at = _place(random, data)
    return data[:at] + data[at + random.randint(1, BLOCK) :]


def end_early(random: Random, data: bytes) -> bytes:
    """Without its end."""
    return data[: random.randrange(len(data) + 1)]


def double(random: Random, data: bytes) -> bytes:
    """With a block twice."""
    at = _place(random, data)
    return data[: at + random.randint(1, BLOCK)] + data[at:]


def swap(random: Random, data: bytes) -> bytes:
    """With two blocks exchanged."""
    one, other = sorted((_place(random, data), _place(random, data)))
    size = min(BLOCK, other - one)
    return (
        data[:one] + data[other : other + size] + data[one + size : other]
        + data[one : one + size] + data[other + size :]
    )  # fmt: skip


def noise(random: Random, data: bytes) -> bytes:
    """With random bytes somewhere."""
    at = _place(random, data)
    return data[:at] + random.randbytes(random.randint(1, BLOCK)) + data[at:]


CHANGES: tuple[Callable[[Random, bytes], bytes], ...] = (
    other_bit, other_byte, other_count, other_count, cut, end_early, double, swap, noise,
)  # fmt: skip

"""Smaller cases with the same fault, by delta debugging.

Zeller and Hildebrandt, Simplifying and Isolating Failure-Inducing Input, IEEE Trans. Softw. Eng.
28 (2002) 183-200: pieces of a file are left out, first halves, then quarters, ..., as long as the
fault remains.  Lines come first, then single bytes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from .cases import Case

Fails = Callable[[Case], bool]
#: Attempts in all.
MOST = 1000


def minimised(case: Case, fails: Fails, most: int = MOST) -> Case:
    """A case that is no larger, of which ``fails`` is still true."""
    left = [most]

    def tried(smaller: Case) -> bool:
        left[0] -= 1
        return left[0] >= 0 and fails(smaller)

    for cut in (bytes.splitlines, _bytes):
        for name in sorted(case.files):
            pieces = _pieces(case.files[name], cut)

            def without(kept: Sequence[bytes], name: str = name, base: Case = case) -> Case:
                return base.with_file(name, b"".join(kept))

            case = without(_reduced(pieces, lambda kept, make=without: tried(make(kept))))
    return case


def _bytes(data: bytes) -> list[bytes]:
    return [data[k : k + 1] for k in range(len(data))]


def _pieces(data: bytes, cut: Callable[..., list[bytes]]) -> list[bytes]:
    return data.splitlines(keepends=True) if cut is bytes.splitlines else cut(data)


def _reduced(pieces: list[bytes], fails: Callable[[list[bytes]], bool]) -> list[bytes]:
    """The pieces without as many as possible."""
    count = 2
    while len(pieces) >= 2:
        size = max(1, len(pieces) // count)
        for start in range(0, len(pieces), size):
            kept = pieces[:start] + pieces[start + size :]
            if fails(kept):
                pieces, count = kept, max(count - 1, 2)
                break
        else:
            if size == 1:
                break
            count = min(2 * count, len(pieces))
    if pieces and fails([]):
        return []
    return pieces

"""Comparison of what a generator writes with what stands in the tree."""

import re

import numpy as np

NUMBER = re.compile(r"-?\d+\.?\d*(?:[eE][-+]?\d+)?")


def assert_same_text(written: str, kept: str, rtol: float = 1e-9, atol: float = 1e-9) -> None:
    """Word for word; numbers within the tolerance, for another processor may round otherwise."""
    assert NUMBER.sub("#", written) == NUMBER.sub("#", kept)
    figures = [np.array(NUMBER.findall(text), dtype=float) for text in (written, kept)]
    np.testing.assert_allclose(*figures, rtol=rtol, atol=atol)


def assert_same_reference(written: str, kept: str) -> None:
    """Its lines of text as above; its columns to 1e-6 of their largest value.

    That is what the coarsest integration of a generator supports. A column that is round-off of the
    others has none of its own digits.
    """
    (told, found), (said, known) = (parted(text) for text in (written, kept))
    assert_same_text(told, said)
    assert found.shape == known.shape
    round_off = 10 * np.finfo(float).eps * np.abs(known).max(initial=0.0)
    for column, of in zip(found.T, known.T, strict=True):
        atol = 1e-6 * np.abs(of).max(initial=0.0) + round_off
        np.testing.assert_allclose(column, of, rtol=0, atol=atol)


def parted(text: str) -> tuple[str, np.ndarray]:
    """Instructions with the header, and the table: (nt, columns)."""
    lines = text.splitlines()
    first = next((k for k, line in enumerate(lines) if line[:1].isdigit()), len(lines))
    rows = [[float(word) for word in line.split(",")] for line in lines[first:]]
    return "\n".join(lines[:first]), np.array(rows).reshape(len(rows), -1 if rows else 0)

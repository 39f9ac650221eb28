"""The error of a run against a reference, as one number.

The largest, over all output times, of::

    |x - x_ref| / L             of every body, L the longest way any body goes in the reference
    angle between the attitudes of every part                                              [rad]
    |y - y_ref| / max |y_ref|   of every DIFF state

or, when channels are named, of ``|c - c_ref| / max |c_ref|``.
Its -log10 is the number of digits.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import inf, isfinite
from typing import TYPE_CHECKING

import numpy as np

from adamslite.results.comparison import fits

if TYPE_CHECKING:
    from adamslite.results.results import Results


def error_of(results: Results, truth: Results, channels: Sequence[str] = ()) -> float:
    """Largest error of a run against a reference; see the module."""
    if channels:
        names = [name for name in truth.names if any(fits(c, name) for c in channels)]
        return _largest(_relative(results[name], truth[name]) for name in names)
    bodies = [
        name[:-2] for name in truth.names if name.endswith(".x") and f"{name[:-2]}.az" in truth
    ]
    moved = {b: (_place(results, b), _place(truth, b)) for b in bodies}
    way = max((np.abs(there - there[:1]).max() for _, there in moved.values()), default=0.0)
    return _largest(
        [
            *(_far(here - there, way) for here, there in moved.values()),
            *(_turned(results, truth, b) for b in bodies if f"{b}.psi" in truth),
            *(_relative(results[n], truth[n]) for n in truth.names if n.startswith("DIFF/")),
        ]
    )


def _largest(errors: Iterable[float]) -> float:
    """The largest; not-a-number is infinitely wrong."""
    return max((e if isfinite(e) else inf for e in errors), default=inf)


def _relative(value: np.ndarray, truth: np.ndarray) -> float:
    return _far(value - truth, np.abs(truth).max())


def _far(difference: np.ndarray, size: float) -> float:
    return float(np.abs(difference).max() / (size or 1.0))


def _place(results: Results, body: str) -> np.ndarray:
    """Centre of mass (nt, 3) in ground axes."""
    return np.column_stack([results[f"{body}.{axis}"] for axis in "xyz"])


def _turned(results: Results, truth: Results, body: str) -> float:
    """Largest angle between the attitudes of a part in two runs [rad]."""
    apart = np.linalg.norm(attitude(results, body) - attitude(truth, body), axis=(1, 2))
    return float(2.0 * np.arcsin(np.minimum(apart / np.sqrt(8.0), 1.0)).max())


def attitude(results: Results, body: str) -> np.ndarray:
    """Rotation matrices (nt, 3, 3) of the 3-1-3 angles, body to ground."""
    (c1, s1), (c2, s2), (c3, s3) = (
        (np.cos(results[f"{body}.{a}"]), np.sin(results[f"{body}.{a}"]))
        for a in ("psi", "theta", "phi")
    )
    rows = [
        [c1 * c3 - s1 * c2 * s3, -c1 * s3 - s1 * c2 * c3, s1 * s2],
        [s1 * c3 + c1 * c2 * s3, -s1 * s3 + c1 * c2 * c3, -c1 * s2],
        [s2 * s3, s2 * c3, c2],
    ]
    return np.moveaxis(np.array(rows), 2, 0)

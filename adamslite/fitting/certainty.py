"""How sure fitted numbers are, and which of them the measurement does not determine.

Equations, with the Jacobian S (n, np) of the residuals by relative changes of the numbers::

    s^2   = sum of squared residuals / (n - singular values that count)
    cov   = s^2 (S^T S)^-1,    standard errors: roots of its diagonal
    S     = U diag(w) V^T      singular values of S, and of S with columns of length one

A combination V_k is not identifiable where the singular value of the normalised
Jacobian is no larger than what its derivatives are off by, and poorly determined where s / w_k is
larger than one: a change by its whole size would not be seen.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

#: Parts of a combination below this share of its largest are none.
PART = 0.05
#: A singular value counts where it is so many times larger than the error of the Jacobian.
CLEAR = 3.0
SILENT = "no measured channel changes with it by more than the runs are off"
#: Even exact derivatives are no better than this.
ROUND_OFF = 1e-9


@dataclass(frozen=True, eq=False)
class Combination:
    """Relative changes of numbers that together leave the measured curves as they are.

    ``parts``: by name, the largest is 1; ``error``: standard error of such a change, infinite
    where it is not identifiable.
    """

    parts: dict[str, float]
    error: float

    @property
    def is_silent(self) -> bool:
        """Whether the measurement says nothing about it."""
        return not np.isfinite(self.error)

    def __str__(self) -> str:
        names = [*self.parts]
        if len(names) == 1:
            how = SILENT if self.is_silent else f"its standard error is {100 * self.error:.3g} %"
            return f"the measurement does not determine {names[0]}: {how}"
        listed = f"{', '.join(names[:-1])} and {names[-1]}"
        changes = ", ".join(f"{share:+.2g} %" for share in self.parts.values())
        how = (
            "leave every measured channel as it is" if self.is_silent
            else f"have a standard error of {100.0 * self.error:.3g} times that"
        )  # fmt: skip
        return f"the measurement cannot separate {listed}: changes of {changes} together {how}"


@dataclass(frozen=True, eq=False)
class Certainty:
    """Covariance (np, np) of relative changes, not a number where something is not identifiable.

    ``correlation`` (np, np); ``unidentifiable``: combinations that the measurement does not
    determine; ``singular_values`` (np,) of the Jacobian with columns of length one, ``floor``: what
    errors of derivatives make of it.
    """

    covariance: np.ndarray
    correlation: np.ndarray
    unidentifiable: tuple[Combination, ...]
    singular_values: np.ndarray
    floor: float


def certainty(
    jacobian: np.ndarray,
    off: np.ndarray,
    residuals: np.ndarray,
    names: Sequence[str],
    free: np.ndarray,
) -> Certainty:
    """What the Jacobian says.

    Parameters
    ----------
    jacobian, off : (n, np) arrays
        By relative changes of the numbers, and how far it may be off.
    residuals : (n,) array
    names : sequence of str
    free : (np,) array of bool
        Numbers that are not at a bound; of the others nothing is said.
    """
    lengths, wrong = np.linalg.norm(jacobian, axis=0), np.linalg.norm(off, axis=0)
    silent = free & (lengths <= CLEAR * wrong)
    heard = np.flatnonzero(free & ~silent)
    lengths, own = lengths[heard], [names[k] for k in heard.tolist()]
    _, singular, rows = np.linalg.svd(jacobian[:, heard] / lengths, full_matrices=False)
    doubt = np.linalg.norm(off[:, heard] / lengths, 2) if own else 0.0
    floor = max(ROUND_OFF, CLEAR * float(doubt))
    determined = singular > floor
    blind = _simplest(rows[~determined] / lengths)
    inverse = rows[determined].T / singular[determined] / lengths[:, None]
    squared = residuals @ residuals / max(len(residuals) - int(determined.sum()), 1)
    shape = inverse @ inverse.T
    hidden = np.asarray(_parts(blind).any(axis=0))
    shape[hidden, :] = shape[:, hidden] = np.nan
    covariance, spans = squared * shape, np.sqrt(np.diag(shape))
    unidentifiable = [
        *(Combination({names[k]: 1.0}, np.inf) for k in np.flatnonzero(silent).tolist()),
        *(_combination(each, np.inf, own) for each in blind),
        *_weak(covariance, hidden, own),
    ]
    return Certainty(
        _whole(covariance, heard, len(names)),
        _whole(shape / np.outer(spans, spans), heard, len(names)),
        tuple(unidentifiable), singular, floor,
    )  # fmt: skip


def unknown(names: Sequence[str]) -> Certainty:
    """What is known where there are no derivatives."""
    nothing = np.full((len(names), len(names)), np.nan)
    return Certainty(nothing, nothing, (), np.zeros(0), 0.0)


def _whole(found: np.ndarray, places: np.ndarray, count: int) -> np.ndarray:
    """A matrix of some of the numbers as one of all (np, np)."""
    whole = np.full((count, count), np.nan)
    whole[np.ix_(places, places)] = found
    return whole


def _simplest(rows: np.ndarray) -> np.ndarray:
    """Combinations that span the same with fewer numbers in each, by elimination with pivots."""
    rows, width = rows.copy(), rows.shape[1]
    for k in range(len(rows)):
        at, column = divmod(int(np.argmax(np.abs(rows[k:]))), width)
        rows[[k, k + at]] = rows[[k + at, k]]
        rows[k] /= rows[k, column]
        for other in range(len(rows)):
            if other != k:
                rows[other] -= rows[other, column] * rows[k]
    return rows


def _parts(rows: np.ndarray) -> np.ndarray:
    """Which numbers are part of each combination (k, np)."""
    sizes = np.abs(rows)
    return np.asarray(sizes > PART * sizes.max(axis=1, keepdims=True, initial=0.0))


def _weak(covariance: np.ndarray, blind: np.ndarray, names: Sequence[str]) -> list[Combination]:
    """Combinations that are determined worse than by their whole size."""
    determined = np.flatnonzero(~blind).tolist()
    variances, axes = np.linalg.eigh(covariance[np.ix_(determined, determined)])
    own = [names[k] for k in determined]
    return [
        _combination(axes[:, k], float(np.sqrt(variances[k])), own)
        for k in range(len(determined))[::-1]
        if variances[k] > 1.0
    ]


def _combination(direction: np.ndarray, error: float, names: Sequence[str]) -> Combination:
    largest = direction[np.argmax(np.abs(direction))]
    parts = {
        name: float(each / largest)
        for name, each in zip(names, direction, strict=True)
        if abs(each) > PART * abs(largest)
    }
    return Combination(parts, error)

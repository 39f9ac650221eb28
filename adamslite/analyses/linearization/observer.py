"""The observer of small motions: on the ground, or on the body of a marker.

Small motions in ground axes are dx of mass centres and rotation vectors phi (dR = [phi] R).  An
observer on body b, whose axes E turn with it, sees of another body, at r = x - x_b from b,

    xi = E^T (dx - dx_b - phi_b x r),    sigma = E^T (phi - phi_b)

and of b itself, as the motion of the surroundings with its sign turned, E^T dx_b and E^T phi_b:

    dx = E xi + E xi_b + (E sigma_b) x r,    phi = E sigma + E sigma_b

or (dx, phi) = P (xi, sigma) for all bodies.  With w and al of b

    E' = [w] E,    E'' = ([al] + [w]^2) E.

On the ground E is constant, and no body is special.
"""

from __future__ import annotations

from math import comb
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.linearization.instant import skew
from adamslite.model.model import PART

if TYPE_CHECKING:
    from adamslite.analyses.linearization.instant import Instant
    from adamslite.equations.system import System
    from adamslite.language.interfaces import Key

Jet = tuple[np.ndarray, np.ndarray, np.ndarray]


class Observer:
    """On the body of ``marker``, with its axes; None stands on the ground, with ground axes."""

    def __init__(self, system: System, marker: Key | None = None) -> None:
        place = None if marker is None else system.model.marker(marker)
        self.body = None if place is None or place.kind == "ground" else place.body
        self.axes = np.eye(3) if place is None else place.axes
        self.starts = system.starts[: len(system.model.bodies)]
        self.turning = [body.width == PART for body in system.model.bodies]

    @property
    def own(self) -> slice:
        """Coordinates of the observer's own body."""
        if self.body is None:
            return slice(0, 0)
        i = self.starts[self.body]
        return slice(i, i + (6 if self.turning[self.body] else 3))

    def view(self, instant: Instant) -> Jet:
        """P, P' and P'' (n, n)."""
        axes = self._axes(instant)
        p0, p1, p2 = (self._derivative(instant, axes, k) for k in range(3))
        return p0, p1, p2

    def _axes(self, instant: Instant) -> Jet:
        """E, E' and E'' (3, 3)."""
        if self.body is None or not self.turning[self.body]:
            return self.axes, np.zeros((3, 3)), np.zeros((3, 3))
        i = self.starts[self.body] + 3
        axes = instant.attitude[self.body] @ self.axes
        spin, alpha = skew(instant.u[i : i + 3]), skew(instant.a[i : i + 3])
        return axes, spin @ axes, (alpha + spin @ spin) @ axes

    def _derivative(self, instant: Instant, axes: Jet, k: int) -> np.ndarray:
        """The k-th derivative of P by time."""
        whole = np.kron(np.eye(len(instant.u) // 3), axes[k])
        if self.body is None:
            return whole
        o = self.starts[self.body]
        states = (instant.q, instant.u, instant.a)
        for i, turning in zip(self.starts, self.turning, strict=True):
            whole[i : i + 3, o : o + 3] = axes[k]
            if self.turning[self.body]:
                arms = [skew(each[i : i + 3] - each[o : o + 3]) for each in states]
                moved = sum(comb(k, j) * arms[j] @ axes[k - j] for j in range(k + 1))
                whole[i : i + 3, o + 3 : o + 6] = -moved
                if turning:
                    whole[i + 3 : i + 6, o + 3 : o + 6] = axes[k]
        return whole

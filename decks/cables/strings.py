"""A load on a rope between two towers of equal height: elastic catenaries, and a taut string.

Independent of any element: Irvine's closed form for a load that hangs at rest, and the string under
a moving load by collocation in both of its parts.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from formulas import Cable, G
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve

# Polynomials on a part have this degree; with 12, the place of the load changes by 1e-7 m.
POINTS = 8
#: Of the load at rest and hauled, relative.
REST_ERROR, HAULED_ERROR = 1e-10, 1e-6


@dataclass(frozen=True)
class Loaded:
    """A rope of the free length `length` over `span` [m] with a load of `mass` [kg] on a pulley."""

    cable: Cable
    length: float
    span: float
    mass: float

    def part(self, across: float, down: float, length: float) -> np.ndarray:
        """Reach and depth, (2,), of a catenary whose tower is pulled by `across` and `down` [N].

        H. M. Irvine, Cable Structures, 1981, section 2.2, with w = rho g:

            x = H l/EA + H/w (asinh(V/H) - asinh((V - w l)/H))
            y = (V l - w l^2/2)/EA + (sqrt(H^2 + V^2) - sqrt(H^2 + (V - w l)^2))/w
        """
        w, stiffness = self.cable.density * G, self.cable.stiffness
        end = down - w * length
        reach = np.arcsinh(down / across) - np.arcsinh(end / across)
        return np.array(
            [
                across * length / stiffness + across / w * reach,
                (down * length - w * length**2 / 2) / stiffness
                + (np.hypot(across, down) - np.hypot(across, end)) / w,
            ]
        )

    def at_rest(self, x: float) -> np.ndarray:
        """Height of the load at x [m], tension beside it, horizontal force that holds it, (3,)."""
        w, weight = self.cable.density * G, self.mass * G
        share, h = x / self.span, self.cable.pretension + 2 * weight

        def ends(y):
            lengths = (y[4], self.length - y[4])
            return [(a, v - w * n) for (a, v), n in zip((y[:2], y[2:4]), lengths, strict=True)]

        def residual(y):
            left = self.part(y[0], y[1], y[4])
            right = self.part(y[2], y[3], self.length - y[4])
            (a, v), (b, u) = ends(y)
            balance = [np.hypot(a, v) - np.hypot(b, u), v + u - weight]
            return [left[0] - x, left[0] + right[0] - self.span, left[1] - right[1], *balance]

        half = w * self.length / 2
        guess = [h, weight * (1 - share) + half, h, weight * share + half, self.length * share]
        y = fsolve(residual, guess, xtol=1e-12)
        (a, v), (b, _) = ends(y)
        return np.array([-self.part(y[0], y[1], y[4])[1], np.hypot(a, v), a - b])


class Grid(NamedTuple):
    """Points xi on 0 .. 1, (n,), matrix of derivatives, (n, n), weights of the integral, (n,)."""

    xi: np.ndarray
    slope: np.ndarray
    weights: np.ndarray


def chebyshev() -> Grid:
    """Points that lie denser at the ends.

    L. N. Trefethen, Spectral Methods in MATLAB, 2000, chapters 6 and 12.
    """
    n = POINTS
    x = np.cos(np.pi * np.arange(n + 1) / n)
    c = np.hstack([2, np.ones(n - 1), 2]) * (-1) ** np.arange(n + 1)
    gaps = x[:, None] - x[None, :] + np.eye(n + 1)
    slopes = np.outer(c, 1 / c) / gaps
    slopes -= np.diag(slopes.sum(axis=1))
    powers = np.vander((1 - x) / 2, n + 1, increasing=True).T
    weights = np.linalg.solve(powers, 1 / np.arange(1, n + 2))
    return Grid((1 - x) / 2, -2 * slopes, weights)


class Part(NamedTuple):
    """One part of the string: length, rates of xi at points that stay, (n,), the load's index."""

    length: float
    xi_t: np.ndarray
    xi_tt: np.ndarray
    at_load: int


def halved(xi: np.ndarray, span: float, motion: np.ndarray) -> tuple[Part, Part]:
    """Both parts; on the left xi = x/X, the right one is its mirror image."""
    x, v, a = motion

    def part(d: float, from_tower: np.ndarray, sign: int, at_load: int) -> Part:
        bends = from_tower * (2 * sign * (v / d) ** 2 - a / d)
        return Part(d, -v / d * from_tower, bends, at_load)

    return part(x, xi, 1, -1), part(span - x, 1 - xi, -1, 0)


@dataclass(frozen=True)
class TautString:
    """A string with small slopes, its tension the same all along, and the load at X(t) on it:

        rho y_tt = T y_xx - rho g,   T = EA ((span + int y_x^2/2)/length - 1)
        m (y_c" + g) = (T - rho X'^2) [y_x]

    Each part, of the length d, is stretched on 0 .. 1, with y(x, t) = Y(xi, t):

        y_tt = Y_tt + 2 xi_t Y_t,xi + xi_t^2 Y_xi,xi + xi_tt Y_xi

    Heights are those of the left part's inner points, of the right part's, and of the load, (m,).
    """

    rope: Loaded
    grid: Grid = field(default_factory=chebyshev)

    def parts(self, heights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Heights at all points of the left and of the right part, (n,) each; towers are at 0."""
        inner = len(self.grid.xi) - 2
        left = np.hstack([0.0, heights[:inner], heights[-1]])
        right = np.hstack([heights[-1], heights[inner:-1], 0.0])
        return left, right

    def lengths(self, x: float) -> tuple[float, float]:
        """Of both parts with the load at x [m]."""
        return x, self.rope.span - x

    def tension(self, x: float, heights: np.ndarray) -> float:
        """T [N] from the arc of both parts."""
        rope, (_, slope, weights) = self.rope, self.grid
        sides = zip(self.parts(heights), self.lengths(x), strict=True)
        left, right = (weights @ (slope @ y) ** 2 / d for y, d in sides)
        return rope.cable.stiffness * ((rope.span + (left + right) / 2) / rope.length - 1)

    def parabolas(self, x: float, pull: float) -> np.ndarray:
        """Heights at rest under the tension `pull` [N] with the load at x."""
        rope, xi, d = self.rope, self.grid.xi, np.array(self.lengths(x))
        w = rope.cable.density * G / pull / 2
        low = -w * d.prod() - rope.mass * G / pull * d.prod() / rope.span
        left = low * xi - w * x**2 * xi * (1 - xi)
        right = low * (1 - xi) - w * d[1] ** 2 * xi * (1 - xi)
        return np.hstack([left[1:-1], right[1:-1], low])

    def at_rest(self, x: float) -> np.ndarray:
        """Heights under the tension that they themselves strain the string to."""
        cable = self.rope.cable
        pull = brentq(
            lambda p: self.tension(x, self.parabolas(x, p)) - p,
            0.01 * cable.pretension,
            cable.stiffness,
        )
        return self.parabolas(x, pull)

    def waves(
        self, pull: float, part: Part, y: np.ndarray, y_t: np.ndarray
    ) -> tuple[np.ndarray, float]:
        """Y_tt at the inner points of a part; y_x at the load."""
        slope = self.grid.slope
        first, second = slope @ y, slope @ (slope @ y)
        accelerations = (
            pull / self.rope.cable.density / part.length**2 * second
            - G
            - 2 * part.xi_t * (slope @ y_t)
            - part.xi_t**2 * second
            - part.xi_tt * first
        )
        return accelerations[1:-1], first[part.at_load] / part.length

    def rates(self, motion: np.ndarray, state: np.ndarray) -> np.ndarray:
        """Speeds and accelerations, (2 m,), from heights and speeds; `motion` is X, X', X"."""
        (x, v, _), half, rope = motion, len(state) // 2, self.rope
        heights, speeds = state[:half], state[half:]
        pull = self.tension(x, heights)
        halves = halved(self.grid.xi, rope.span, motion)
        sides = zip(halves, self.parts(heights), self.parts(speeds), strict=True)
        (left, before), (right, behind) = (self.waves(pull, *side) for side in sides)
        lift = (pull - rope.cable.density * v**2) * (behind - before)
        return np.hstack([speeds, left, right, lift / rope.mass - G])


def hauled(rope: Loaded, haul: Callable[[float], np.ndarray], t: np.ndarray) -> np.ndarray:
    """Height of a load that is hauled along a taut string, and its tension: (2, nt).

    `haul` gives X, X' and X" [m, s] of the load.
    """
    string = TautString(rope)
    heights = string.at_rest(haul(0.0)[0])
    run = solve_ivp(
        lambda time, state: string.rates(haul(time), state),
        (0, t[-1]),
        np.hstack([heights, 0 * heights]),
        "DOP853",
        t_eval=t,
        rtol=1e-7,
        atol=1e-7,
    )
    found = run.y[: len(heights)]
    tension = [string.tension(haul(s)[0], y) for s, y in zip(t, found.T, strict=True)]
    return np.array([found[-1], tension])

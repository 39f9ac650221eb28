"""A load on a rope between two towers of equal height: elastic catenaries, and a taut string.

Independent of any element: Irvine's closed form for a load that hangs at rest, and the string under
a moving load by collocation in both of its parts.
"""

from dataclasses import dataclass

import numpy as np
from formulas import Cable, G
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve

# Polynomials on a part have this degree; with 12, the place of the load changes by 1e-7 m.
POINTS = 8


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


def chebyshev() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points on 0 .. 1, (n,), matrix of derivatives, (n, n), weights of the integral, (n,).

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
    return (1 - x) / 2, -2 * slopes, weights


def hauled(rope: Loaded, haul, t: np.ndarray) -> np.ndarray:
    """Height of a load that is hauled along a taut string, and its tension: (2, nt).

    y(x, t) with small slopes, the tension the same all along, the load at X(t) = haul(t):

        rho y_tt = T y_xx - rho g,   T = EA ((span + int y_x^2/2)/length - 1)
        m (y_c" + g) = (T - rho X'^2) [y_x]

    Each part is stretched on 0 .. 1, with y(x, t) = Y(xi, t):

        y_tt = Y_tt + 2 xi_t Y_t,xi + xi_t^2 Y_xi,xi + xi_tt Y_xi
    """
    xi, slope, weights = chebyshev()
    n, cable = len(xi), rope.cable
    inner = slice(1, n - 1)

    def parts(x, heights):
        """Values on both parts; their lengths are x and span - x, towers at xi = 0 and 1."""
        left = np.hstack([0.0, heights[: n - 2], heights[-1]])
        right = np.hstack([heights[-1], heights[n - 2 : -1], 0.0])
        return left, right

    def strained(x, heights):
        left, right = parts(x, heights)
        arc = weights @ (slope @ left) ** 2 / x + weights @ (slope @ right) ** 2 / (rope.span - x)
        return cable.stiffness * ((rope.span + arc / 2) / rope.length - 1)

    def rates(time, state):
        (x, v, a), half = haul(time), len(state) // 2
        heights, speeds = state[:half], state[half:]
        pull, out = strained(x, heights), []
        sides = zip(parts(x, heights), parts(x, speeds), (x, rope.span - x), (1, -1), strict=True)
        kinks = []
        for y, dy, d, sign in sides:
            # Of the left part: xi = x/X; the right one is its mirror image.
            from_tower = xi if sign > 0 else 1 - xi
            moves = -v / d * from_tower
            bends = from_tower * (2 * sign * (v / d) ** 2 - a / d)
            first, second = slope @ y, slope @ (slope @ y)
            out.append(
                (
                    pull / cable.density / d**2 * second
                    - G
                    - 2 * moves * (slope @ dy)
                    - moves**2 * second
                    - bends * first
                )[inner]
            )
            kinks.append(first[-1 if sign > 0 else 0] / d)
        lift = (pull - cable.density * v**2) * (kinks[1] - kinks[0])
        return np.hstack([speeds, *out, lift / rope.mass - G])

    x = haul(0.0)[0]

    def hangs(pull):
        w, d = cable.density * G / pull / 2, np.array([x, rope.span - x])
        low = -w * d.prod() - rope.mass * G / pull * d.prod() / rope.span
        left = low * xi - w * x**2 * xi * (1 - xi)
        right = low * (1 - xi) - w * d[1] ** 2 * xi * (1 - xi)
        return np.hstack([left[inner], right[inner], low])

    pull = brentq(lambda p: strained(x, hangs(p)) - p, 0.01 * cable.pretension, cable.stiffness)
    start = hangs(pull)
    start = np.hstack([start, 0 * start])
    run = solve_ivp(rates, (0, t[-1]), start, "DOP853", t_eval=t, rtol=1e-7, atol=1e-7)
    tension = [strained(haul(s)[0], y[: len(y) // 2]) for s, y in zip(t, run.y.T, strict=True)]
    return np.array([run.y[2 * n - 4], tension])

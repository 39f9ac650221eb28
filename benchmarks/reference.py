"""What is right: the end state of every scene, from equations nobody else here solves.

Chains: the classical Runge-Kutta method with steps so small that doubling them changes about
1e-9 m (``python -m benchmarks.reference`` computes all anew and says by how much);
kept in references.npz, because N = 1000 takes long.

Mechanisms: their exact equation with one degree of freedom, DOP853 (Hairer, Norsett, Wanner,
Solving Ordinary Differential Equations I, section II.5) at 1e-13::

    S3   I(phi) phi" + I'(phi) phi'^2 / 2 = -(m_crank + m_rod) g r/2 cos(phi)
    S4   ((N+1) m L^2/3 + N m L^2) th" = -((N+1)/2 + N) m g L cos(th)
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.scenes import CHAINS, Array, chain, parameters, sizes

STORE = Path(__file__).parent / "references.npz"

#: How far the fastest oscillation turns in one step [rad]; S5 amplifies every error.
STEP = {"S1": 0.1, "S2": 0.1, "S5": 0.01}

#: S5 goes slack and folds, which amplifies even rounding: no step makes these surer [m].
DOUBT = {("S5", 50): 1e-3}
WITHOUT_REFERENCE = {("S5", 200)}


def reference(scene: str, n: int) -> Array | None:
    """Return what ``Solution.values`` should be, or None where no reference can be trusted."""
    if (scene, n) in WITHOUT_REFERENCE:
        return None
    if scene == "S3":
        return slider_crank()
    if scene == "S4":
        return four_bar(n)
    key = f"{scene}-{n}"
    if STORE.exists():
        with np.load(STORE) as known:
            if key in known:
                return known[key]
    return chain_end(scene, n)


def chain_end(scene: str, n: int, coarser: float = 1.0) -> Array:
    """Positions (n, 3) at the end of a chain scene [m], with steps ``coarser`` times as long."""
    c = chain(scene, n)
    radians = coarser * STEP[scene]
    right = np.full(3, np.nan) if c.right is None else c.right
    constants = np.array([c.k, c.d, c.l0, c.gravity, c.rate])
    steps = int(np.ceil(c.end * c.top_frequency / radians))
    return compiled_march()(
        c.mass, c.position, c.velocity, c.left, right, constants, c.n_segments, c.end, steps
    )


@cache
def compiled_march() -> Callable[..., Array]:
    """``march`` as native code."""
    from numba import njit

    accelerate_native = njit(accelerate, fastmath={"contract"})
    return njit(march_with(accelerate_native))


def accelerate(
    t: float, x: Array, v: Array, a: Array, mass: Array, left: Array, right: Array,
    constants: Array, n_segments: int,
) -> None:  # fmt: skip
    """Write the accelerations of a chain into a (n, 3); the equation of ``scenes``."""
    k, d, l0, gravity, rate = constants
    grown = 1.0 + rate * t
    n = len(mass)
    for i in range(n):
        a[i, 0], a[i, 1], a[i, 2] = 0.0, -gravity, 0.0
    for s in range(n_segments):
        near = x[s - 1] if s > 0 else left
        far = x[s] if s < n else right
        dx, dy, dz = far[0] - near[0], far[1] - near[1], far[2] - near[2]
        du = dv = dw = 0.0
        if s < n:
            du, dv, dw = v[s, 0], v[s, 1], v[s, 2]
        if s > 0:
            du, dv, dw = du - v[s - 1, 0], dv - v[s - 1, 1], dw - v[s - 1, 2]
        length = np.sqrt(dx * dx + dy * dy + dz * dz)
        tension = k * (length - l0 * grown) + d * (dx * du + dy * dv + dz * dw) / length
        pull = tension / (length * grown * grown)  # a mass has grown, a spring softened
        if s > 0:
            a[s - 1, 0] += pull * dx / mass[s - 1]
            a[s - 1, 1] += pull * dy / mass[s - 1]
            a[s - 1, 2] += pull * dz / mass[s - 1]
        if s < n:
            a[s, 0] -= pull * dx / mass[s]
            a[s, 1] -= pull * dy / mass[s]
            a[s, 2] -= pull * dz / mass[s]


def march_with(accelerate: Callable[..., None]) -> Callable[..., Array]:
    """RK4 with equal steps, for a right-hand side that is native code."""

    def march(mass, x, v, left, right, constants, n_segments, end, steps):
        h = end / steps
        x, v = x.copy(), v.copy()
        stages = np.empty((4, *x.shape))
        speeds = np.empty((4, *x.shape))
        shares = np.array([0.0, 0.5, 0.5, 1.0])
        for step in range(steps):
            for i in range(4):
                c = shares[i] * h
                before = max(i - 1, 0)
                speeds[i] = v + c * stages[before] if i else v
                place = x + c * speeds[before] if i else x
                accelerate(step * h + c, place, speeds[i], stages[i], mass, left, right,
                           constants, n_segments)  # fmt: skip
            x += h / 6 * (speeds[0] + 2 * (speeds[1] + speeds[2]) + speeds[3])
            v += h / 6 * (stages[0] + 2 * (stages[1] + stages[2]) + stages[3])
        return x

    return march


def slider_crank() -> Array:
    """Angle of the crank [rad] and place of the slider [m] at the end of S3."""
    p = parameters()["S3"]
    r, length, step = p["r"], p["l"], 1e-6

    def rod(phi: float) -> tuple[float, float, float]:
        """sin and cos of the rod's angle psi, and dpsi/dphi."""
        sine = r / length * np.sin(phi)
        cosine = np.sqrt(1 - sine * sine)
        return sine, cosine, r / length * np.cos(phi) / cosine

    def inertia(phi: float) -> float:
        sine, _, rate = rod(phi)
        slider = -r * np.sin(phi) - length * sine * rate
        middle = (-r * np.sin(phi) - length / 2 * sine * rate, r / 2 * np.cos(phi))
        return (
            p["J_crank"] + p["m_crank"] * r * r / 4 + p["J_rod"] * rate**2
            + p["m_rod"] * (middle[0] ** 2 + middle[1] ** 2) + p["m_slider"] * slider**2
        )  # fmt: skip

    def rhs(t: float, y: Array) -> list[float]:
        phi, w = y
        near, far = (inertia(phi + k * step) - inertia(phi - k * step) for k in (1, 2))
        slope = (8 * near - far) / (12 * step)
        drive = -(p["m_crank"] + p["m_rod"]) * p["g"] * r / 2 * np.cos(phi)
        return [w, (drive - 0.5 * slope * w * w) / inertia(phi)]

    run = solve_ivp(rhs, (0, p["T"]), [p["phi0"], p["omega0"]], "DOP853", rtol=1e-13, atol=1e-13)
    phi = run.y[0, -1]
    return np.array([phi, r * np.cos(phi) + length * rod(phi)[1]])


def four_bar(n: int) -> Array:
    """Angle of every upright [rad], from +x, and energy [J] at the end of S4."""
    p = parameters()["S4"]
    m, length = p["m"], p["L"]
    inertia = (n + 1) * m * length**2 / 3 + n * m * length**2
    weight = ((n + 1) / 2 + n) * m * p["g"] * length
    run = solve_ivp(
        lambda t, y: [y[1], -weight / inertia * np.cos(y[0])],
        (0, p["T"]), [np.pi / 2, -p["v0"] / length], method="DOP853", rtol=1e-13, atol=1e-13,
    )  # fmt: skip
    return np.array([run.y[0, -1], 0.5 * inertia * (p["v0"] / length) ** 2 + weight])


def store() -> None:
    """Compute every reference of a chain anew, keep it, and tell how sure it is."""
    wanted = [(s, n) for s in CHAINS for n in sizes(s) if (s, n) not in WITHOUT_REFERENCE]
    kept = {}
    for scene, n in wanted:
        kept[f"{scene}-{n}"] = fine = chain_end(scene, n)
        change = float(np.abs(fine - chain_end(scene, n, coarser=2.0)).max())
        print(f"{scene} N={n}: steps twice as long change {change:.1e} m")
    np.savez_compressed(STORE, **kept)


if __name__ == "__main__":
    store()

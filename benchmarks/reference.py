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

from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.scenes import CHAINS, Array, Chain, chain, parameters, sizes

STORE = Path(__file__).parent / "references.npz"

#: How far the fastest oscillation turns in one step [rad]; S5 amplifies every error.
STEP = {"S1": 0.1, "S2": 0.1, "S5": 0.01}

#: S5 is pushed along itself and folds, which amplifies rounding by 1e11: 64 bits carry it.
PRECISION = {"S5": np.longdouble}
#: What steps twice as long change [m], where that is more than a target asks.
DOUBT = {("S5", 50): 1e-8}
WITHOUT_REFERENCE = {("S5", 200)}


def reference(scene: str, n: int) -> Array | None:
    """End positions (n, 3) of a chain [m], or None where no reference can be trusted."""
    if (scene, n) in WITHOUT_REFERENCE or scene not in CHAINS:
        return None
    key = f"{scene}-{n}"
    if STORE.exists():
        with np.load(STORE) as known:
            if key in known:
                return known[key]
    return chain_end(scene, n)


def chain_end(scene: str, n: int, coarser: float = 1.0) -> Array:
    """Positions (n, 3) at the end of a chain scene [m], with steps ``coarser`` times as long."""
    return chain_at(scene, n, coarser, 1)[-1].astype(float)


def chain_at(scene: str, n: int, coarser: float, parts: int) -> Array:
    """Positions (parts + 1, n, 3) at equal distances of time [m]."""
    c = in_precision(chain(scene, n), PRECISION.get(scene, float))
    steps = int(np.ceil(float(c.end) * c.top_frequency / (coarser * STEP[scene] * parts)))
    h = c.end / (steps * parts)
    x, v = c.position.T.copy(), c.velocity.T.copy()
    found = [x.T.copy()]
    for k in range(steps * parts):
        t = k * h
        a1 = accelerations(c, t, x, v)
        v2 = v + h / 2 * a1
        a2 = accelerations(c, t + h / 2, x + h / 2 * v, v2)
        v3 = v + h / 2 * a2
        a3 = accelerations(c, t + h / 2, x + h / 2 * v2, v3)
        v4 = v + h * a3
        a4 = accelerations(c, t + h, x + h * v3, v4)
        x += h / 6 * (v + 2 * (v2 + v3) + v4)
        v += h / 6 * (a1 + 2 * (a2 + a3) + a4)
        if (k + 1) % steps == 0:
            found.append(x.T.copy())
    return np.array(found)


def in_precision(c: Chain, kind: type) -> Chain:
    """A chain whose numbers are of another type."""
    names = "mass position velocity left k d l0 gravity end rate".split()
    right = None if c.right is None else c.right.astype(kind)
    return replace(
        c, right=right, **{n: np.asarray(getattr(c, n), dtype=kind)[()] for n in names}
    )  # fmt: skip


def accelerations(c: Chain, t: float, x: Array, v: Array) -> Array:
    """Accelerations (3, n) of a chain at places and velocities (3, n).

    Not ``scenes.acceleration``: that one is measured, and must not be its own judge.
    """
    grown = 1.0 + c.rate * t
    shape = (3, c.n_segments + 1)
    places, speeds = np.zeros(shape, x.dtype), np.zeros(shape, x.dtype)
    places[:, 0] = c.left
    if c.right is not None:
        places[:, -1] = c.right
    places[:, 1 : c.n + 1], speeds[:, 1 : c.n + 1] = x, v
    d, w = places[:, 1:] - places[:, :-1], speeds[:, 1:] - speeds[:, :-1]
    length = np.sqrt((d * d).sum(axis=0))
    tension = c.k * (length - c.l0 * grown) + c.d * (d * w).sum(axis=0) / length
    pull = tension / (length * grown * grown) * d  # a mass has grown, a spring softened
    a = -pull[:, : c.n]
    a[:, : c.n_segments - 1] += pull[:, 1:]
    a /= c.mass
    a[1] -= c.gravity
    return a


def slider_crank() -> Array:
    """Angle of the crank [rad] and place of the slider [m] at the end of S3."""
    from scipy.integrate import solve_ivp

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
    from scipy.integrate import solve_ivp

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

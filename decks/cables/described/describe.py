"""Write the decks of the descriptions in this folder, and their references.

    python describe.py

The decks are what `adamslite cable` writes; the references are closed forms, or small systems of
equations of motion that solve_ivp integrates. README.md derives the tolerances.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

HERE = Path(__file__).resolve().parent
#: Of equations of motion, relative.
ERROR = 1e-8
sys.path[:0] = [str(HERE), str(HERE.parent)]

import arrest  # noqa: E402
from described_cases import write  # noqa: E402
from formulas import G, Winch, sliding_ratio  # noqa: E402
from impacts import deck_kink, deck_sheaves  # noqa: E402
from laws import Move  # noqa: E402
from leaning import mount, wander  # noqa: E402
from sliding import bead, ropeway  # noqa: E402
from spans import table  # noqa: E402
from wound import reels  # noqa: E402


def drum() -> str:
    """Way s (1 - 0.0542 (h/R)^2) - M s" L/EA of the weight, tension M (g - s")."""
    weight, stiffness, radius, h = 200.0, 5.0e6, 0.5, 2 / 100
    t = np.linspace(0, 3, 61)
    s, _, acceleration = Winch(1.0, 0.2, 5)(t)
    cable = 2 + s[-1] + np.pi * radius
    way = s * (1 - 0.0542 * (h / radius) ** 2) - weight * acceleration * cable / stiffness
    lines = [
        "Place of the weight and tension at it: README.md",
        "written by describe.py",
        "tolerance POINT_MASS/20.y: abs 4e-5",
        "tolerance REQUEST/1.F3: abs 4",
    ]
    columns = [t, -2 - way, weight * (G - acceleration)]
    return table(["time", "POINT_MASS/20.y", "REQUEST/1.F3"], lines, columns)


def belt() -> str:
    """Load F = tau1 + tau2 of the driven axle, pull P of its rim, for a belt that slides on it.

    tau1/tau2 = q of a lumped belt, which spans the angle d with a section;
    P = (tau1 - tau2) r sin(d/2)/(d/2)/R.
    """
    stiffness, radius, mu, pull = 2.0e4, 0.1, 0.4, 1300.0
    free = (4 * 0.13 + 2 * np.pi * radius) / 26 / (1 + 650 / stiffness)
    r = radius - (0.26 / 6) ** 2 / 80 / radius
    d = 2 * np.arcsin(free * (1 + pull / 2 / stiffness) / 2 / r)
    q = sliding_ratio(mu, np.pi, d)
    rim = pull * (q - 1) / (q + 1) * r * np.sin(d / 2) / (d / 2) / radius
    return (
        "# A belt that slides: README.md\n# written by describe.py\n"
        f"# measure: mean REQUEST/20.F6 from 0.1 = {rim:.6g} tol rel 4e-3\n"
        f"# measure: mean REQUEST/20.F4 from 0.1 = {pull:.6g} tol rel 1e-3\n"
    )


def slip() -> str:
    """T1/T2 = exp(mu pi), a = g (M1 - q M2)/(M1 + q M2) with the cable's weight on either side."""
    q, rho, g = np.exp(0.3 * np.pi), 0.02, G
    m1, m2, rim = 30.0, 8.0, 0.02 * 0.2 * np.pi

    def rates(_, y):
        a, b = m1 + rho * (3 + y[0]), m2 + rho * (3 - y[0])
        return [y[1], (g * (a - q * b)) / (a + q * b + rim * (1 + q) / 2)]

    t = np.linspace(0, 1, 51)
    way, speed = solve_ivp(rates, (0, 1), [0, 0], t_eval=t, rtol=1e-10, atol=1e-12).y
    lines = [
        "Way and speed of the cable, ratio of its tensions: README.md",
        "written by describe.py",
        "tolerance REQUEST/20.F2: abs 9e-3",
        "tolerance REQUEST/20.F3: abs 9e-3",
    ]
    return table(["time", "REQUEST/20.F2", "REQUEST/20.F3"], lines, [t, -way, -speed], ERROR)


def crane() -> str:
    """Trolley X(t), rope l(t): l q" + 2 l' q' + g sin q + X" cos q = 0, q the angle of the rope."""

    hoist, trolley = Move(1, 5, 4.0), Move(0, 4, 6.0)

    def rates(t, y):
        paid, speed, _ = hoist(t)
        a = trolley(t)[2]
        return [y[1], -(2 * speed * y[1] + G * np.sin(y[0]) + a * np.cos(y[0])) / (8 + paid)]

    t = np.linspace(0, 6, 61)
    q = solve_ivp(rates, (0, 6), [0, 0], t_eval=t, rtol=1e-10, atol=1e-12).y[0]
    rope = np.array([8 + hoist(time)[0] for time in t])
    place = np.array([trolley(time)[0] for time in t])
    lines = [
        "Place of the load: README.md",
        "written by describe.py",
        "tolerance POINT_MASS/20.*: abs 1e-4",
    ]
    columns = [t, place + rope * np.sin(q), -rope * np.cos(q)]
    return table(["time", "POINT_MASS/20.x", "POINT_MASS/20.y"], lines, columns, ERROR)


def arrestment() -> str:
    """The hook on straight elastic cables of the same mass: ../arrest.py."""
    t = np.linspace(0, 3, 76)
    _, y, _, speed = arrest.straight(arrest.REFERENCE, (arrest.RIGHT, arrest.LEFT), t)
    lines = [
        "Run-out and speed of the hook: README.md",
        "written by describe.py",
        "tolerance POINT_MASS/20.y: peak 6e-3",
        "tolerance POINT_MASS/20.vy: peak 6e-3",
    ]
    return table(
        ["time", "POINT_MASS/20.y", "POINT_MASS/20.vy"], lines, [t, y, speed], arrest.ERROR
    )


def ring() -> str:
    """A point of the ring that runs round, and its tension: T (1 + T/EA) = rho v^2."""
    stiffness, density, radius, speed = 6e7, 5.536, 0.5, 100.0
    pull = brentq(lambda x: x * (1 + x / stiffness) - density * speed**2, 0, 1e5, rtol=1e-14)
    t = np.linspace(0, 0.1, 101)
    angle = speed * t / radius
    lines = [
        "Place of a point, tension: README.md",
        "written by describe.py",
        "tolerance POINT_MASS/1000.*: abs 5e-5",
        "tolerance REQUEST/1.F2: rel 2e-5",
    ]
    columns = [t, radius * np.cos(angle), radius * np.sin(angle), pull + 0 * t]
    return table(["time", "POINT_MASS/1000.x", "POINT_MASS/1000.y", "REQUEST/1.F2"], lines, columns)


def folded() -> str:
    """Place and speed of the free end: masses on n links of the length h that do not stretch.

    Link k at the angle a_k from the downward vertical, s_k the mass below it:
        sum_k s_max(j,k) h (cos(a_j - a_k) a_k" + sin(a_j - a_k) a_k'^2) = -s_j g sin a_j
    At the start one link lies across the bend, one leans towards it on either side.
    """
    n, arm, radius, down, density = 51, 24, 0.01, 0.49, 1.0

    def fold(h):
        """Height of the lean links, and of the link across below the middle of the bend."""
        return np.sqrt(h**2 - (radius - h / 2) ** 2), np.sqrt(radius**2 - h**2 / 4)

    h = brentq(lambda h: arm * h + fold(h)[0] - fold(h)[1] - down, 1.5 * radius, 2 * radius)
    lean = np.arcsin((radius - h / 2) / h)
    start = [*np.zeros(arm), lean, np.pi / 2, np.pi - lean, *np.full(arm, np.pi), *np.zeros(n)]
    below = density * h * (np.arange(n)[::-1] + 0.5)
    shared = below[np.maximum.outer(np.arange(n), np.arange(n))]

    def rates(_, y):
        a, w = y[:n], y[n:]
        d = a[:, None] - a
        load = -below * G * np.sin(a) - (shared * np.sin(d)) @ w**2 * h
        return np.concatenate([w, np.linalg.solve(shared * np.cos(d) * h, load)])

    t = np.linspace(0, 0.38, 191)
    run = solve_ivp(rates, (0, t[-1]), start, "DOP853", t, rtol=1e-9, atol=1e-9)
    t, a, w = t[:181], run.y[:n, :181], run.y[n:, :181]
    lines = [
        "Place and speed of the free end: README.md",
        "written by describe.py",
        "tolerance POINT_MASS/30.y: abs 1e-4",
        "tolerance POINT_MASS/30.vy: abs 3e-2",
    ]
    columns = [t, -h * np.cos(a).sum(0), h * (np.sin(a) * w).sum(0)]
    return table(["time", "POINT_MASS/30.y", "POINT_MASS/30.vy"], lines, columns, ERROR)


def main() -> None:
    cases = (
        *(drum, belt, slip, crane, arrestment, deck_sheaves, deck_kink),
        *(reels, mount, wander, ring, folded, bead, ropeway),
    )
    write(HERE, {case.__name__.replace("_", "-"): case for case in cases})


if __name__ == "__main__":
    main()

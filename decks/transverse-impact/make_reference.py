"""Write transverse-impact.adm and its reference.csv: the plateau behind an impact on a taut cable.

With the strain e behind the axial front, e0 before it, c^2 = EA / rho and A = c sqrt(e (1 + e)):
u = c (e - e0) is the speed of the inflow, U = A - u the speed of the kink over the deck, and the
straight cable behind the kink gives A^2 = U^2 + V^2, hence

    V^2 / c^2 = 2 (e - e0) sqrt(e (1 + e)) - (e - e0)^2,   T1 = EA e
"""

from pathlib import Path

import numpy as np
from scipy.optimize import brentq

EA, RHO, PRETENSION, SPEED = 6.0e7, 5.536, 13345.0, 65.0
HALF_SPAN, N = 15.0, 120
DAMPING = 0.2
WAVE = np.sqrt(EA / RHO)
IMPEDANCE = RHO * WAVE
E0 = PRETENSION / EA
FREE_LENGTH = HALF_SPAN / N / (1 + E0)
DAMPER = 2 * DAMPING * IMPEDANCE
END, STEPS = 0.0726, 726

HEADER = """# Plateau behind a transverse impact at {speed:g} m/s, closed form: see README.md
# written by make_reference.py
# measure: mean SFORCE/{last}.f from {start:g} to {stop:g} = {force:.9g} tol rel 1e-3
# measure: mean SFORCE/1.f from {start:g} to {stop:g} = {force:.9g} tol rel 1e-3
# measure: mean POINT_MASS/{end}.vx from {start:g} to {stop:g} = {inflow:.7g} tol rel 2e-3
# measure: mean REQUEST/1.F2 from {start:g} to {stop:g} = {slope:.7g} tol rel 2e-3
# measure: mean POINT_MASS/{third}.vy from 0.05 to {stop:g} = {speed:g} tol rel 2e-3
# tolerance: abs 1e-6
time,POINT_MASS/1.x,POINT_MASS/1.y,POINT_MASS/1.vy,POINT_MASS/{end}.z"""

TOP = """Transverse impact on a taut cable: half of a symmetric deck span
! Written by make_reference.py. The hook (POINT_MASS/1) meets the cable at TIME = 0 and moves on
! at {speed:g} m/s. {n} sections of fixed free length on {span:g} m; node {end} is at the sheave.
! The cable behind the sheave is long: it pulls on node {end} with pretension - rho c VX, so that
! no wave comes back from there. The damper, 2 zeta sqrt(EA rho) with zeta = {damping:g}, only
! takes the ringing of single sections away.

UNITS/SYSTEM=MKS

VARIABLE/EA, FUNCTION=6.0E7
VARIABLE/rho, FUNCTION={rho:g}
VARIABLE/L_0, FUNCTION={free:.12g}
VARIABLE/damper, FUNCTION=2*{damping:g}*SQRT(EA*rho)

PART/1, GROUND
! The z axis of MARKER/1001 is the x axis of the ground: the direction of SFORCE/1000.
MARKER/1001, PART=1, REULER=90D,90D,0D
MARKER/1002, PART=1, QP={left:g},0,0

POINT_MASS/1, MASS=100, CM=1, QG={left:g},0,0, VY={speed:g}
MARKER/1, POINT_MASS=1
GCON/1, FUNCTION=DX(1,1002)
GCON/2, FUNCTION=DY(1,1002)-{speed:g}*TIME
"""

NODE = """POINT_MASS/{k}, MASS={mass:.12g}, CM={k}, QG={x:.12g},0,0
MARKER/{k}, POINT_MASS={k}
"""

SECTION = """SFORCE/{i}, I={i}, J={j}
, FUNCTION= -EA/L_0*[DM({i},{j})-L_0]-damper*VR({i},{j})
"""

BOTTOM = """
SFORCE/1000, TRANSLATIONAL, ACTIONONLY, I={end}, J=1001, FUNCTION={pull:g}-SQRT(EA*rho)*VX({end})

! Slope of the cable at the hook.
REQUEST/1, F2=DY(1,2)/DX(2,1)

INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-6
SIMULATE/DYNAMIC, END={stop:g}, STEPS={steps}
END
"""


def plateau():
    """Strain behind the axial front, inflow speed u and kink speed U [m/s]."""

    def balance(e):
        return 2 * (e - E0) * np.sqrt(e * (1 + e)) - (e - E0) ** 2 - (SPEED / WAVE) ** 2

    e = brentq(balance, E0, 0.1, xtol=1e-15, rtol=1e-14)
    inflow = WAVE * (e - E0)
    return e, inflow, WAVE * np.sqrt(e * (1 + e)) - inflow


def masses():
    """Mass of every node [kg]: whole sections inside, half a section at the sheave: (N + 1,)."""
    m = np.full(N + 1, RHO * FREE_LENGTH)
    m[-1] /= 2
    return m


def acceleration(x, v, m):
    """Accelerations of the nodes (N + 1, 2) and tensions of the sections (N,)."""
    d = np.diff(x, axis=0)
    length = np.hypot(*d.T)
    rate = np.einsum("ij,ij->i", d, np.diff(v, axis=0)) / length
    tension = EA * (length / FREE_LENGTH - 1) + DAMPER * rate
    pull = (tension / length)[:, None] * d
    force = np.zeros_like(x)
    force[:-1] += pull
    force[1:] -= pull
    force[-1, 0] += PRETENSION - IMPEDANCE * v[-1, 0]
    a = force / m[:, None]
    a[0] = 0
    return a, tension


def simulate():
    """The lumped cable by the classic Runge-Kutta method: times, tensions, v of all nodes."""
    m = masses()
    x = np.zeros((N + 1, 2))
    x[:, 0] = np.linspace(-HALF_SPAN, 0, N + 1)
    v = np.zeros_like(x)
    v[0, 1] = SPEED
    h = END / 4800
    record = []
    for i in range(4801):
        a1, tension = acceleration(x, v, m)
        record.append((i * h, tension, v, x))
        a2, _ = acceleration(x + h / 2 * v, v + h / 2 * a1, m)
        a3, _ = acceleration(x + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2, m)
        a4, _ = acceleration(x + h * v + h * h / 2 * a2, v + h * a3, m)
        x = x + h * v + h * h / 6 * (a1 + a2 + a3)
        v = v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
    return (np.array(part) for part in zip(*record, strict=True))


def check(e, inflow, kink, start, stop):
    """The closed form against the lumped cable, by the means the reference asks for."""
    t, tension, v, x = simulate()
    window = (t >= start) & (t <= stop)
    slope = (x[:, 0, 1] - x[:, 1, 1]) / (x[:, 1, 0] - x[:, 0, 0])
    measured = {
        "sheave": (tension[window, -1].mean(), EA * e, 5e-5),
        "hook": (tension[window, 0].mean(), EA * e, 5e-5),
        "inflow": (-v[window, -1, 0].mean(), inflow, 2e-4),
        "slope": (slope[window].mean(), SPEED / kink, 1e-3),
        "lateral speed": (v[(t >= 0.05) & (t <= stop), N // 3, 1].mean(), SPEED, 1e-3),
    }
    for name, (value, expected, band) in measured.items():
        assert abs(value / expected - 1) < band, (name, value, expected)


def deck():
    """The text of the deck."""
    words = {"n": N, "end": N + 1, "left": -HALF_SPAN, "span": HALF_SPAN, "speed": SPEED}
    words |= {"rho": RHO, "free": FREE_LENGTH, "damping": DAMPING, "pull": PRETENSION}
    text = TOP.format(**words)
    x = np.linspace(-HALF_SPAN, 0, N + 1)
    for k, m in enumerate(masses()[1:], start=2):
        text += NODE.format(k=k, mass=m, x=x[k - 1])
    text += "".join(SECTION.format(i=k, j=k + 1) for k in range(1, N + 1))
    return text + BOTTOM.format(stop=END, steps=STEPS, **words)


def main():
    here = Path(__file__).parent
    e, inflow, kink = plateau()
    assert abs(EA * e - 214301.6) < 0.1
    start, stop = (round(share * HALF_SPAN / kink, 4) for share in (0.3, 0.9))
    check(e, inflow, kink, start, stop)
    here.joinpath("transverse-impact.adm").write_text(deck())
    header = HEADER.format(
        speed=SPEED,
        last=N,
        end=N + 1,
        third=N // 3 + 1,
        start=start,
        stop=stop,
        force=-EA * e,
        inflow=-inflow,
        slope=SPEED / kink,
    )
    t = np.linspace(0, END, 67)
    table = np.column_stack([t, 0 * t - HALF_SPAN, SPEED * t, 0 * t + SPEED, 0 * t]) + 0.0
    path = here / "reference.csv"
    np.savetxt(path, table, fmt="%.12g", delimiter=",", header=header, comments="")


if __name__ == "__main__":
    main()

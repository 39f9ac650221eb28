"""The paper's Level 3 cable paid out over a pulley: its equations, its closed form, its deck.

Node k = 0 (sheave) .. N (tip). Every section has the free length h = (l0 + s) / N, every inner node
the mass rho h, and node k moves with (k / N) of the payout speed s'. With d'Alembert's sign

    (m0 + Dm) x_k" = T_(k+1) - T_k - Dm' x_k',   T_k = EA (x_k - x_(k-1) - h) / h

x_0 = 0, x_N = (1 + T0 / EA)(l0 + s), m0 = rho l0 / N, Dm = rho s / N. As the cable is stiff,
x_k = (k / N)(l0 + s) but for strains of 1e-4, and the sum over all inner nodes is

    T_tip - T_sheave = rho / 2 (l s" + s'^2) (N - 1) / N,   l = l0 + s

which is rho U^2 (N - 1) / (2 N) in steady payout.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

EA, RHO, L0, SPEED, PRETENSION = 6.0e7, 5.536, 20.0, 30.0, 13345.0
RISE, END = 0.1, 2.0
WINDOW = (1.6, 2.0)
HEADER = """# {n} sections: T_tip - T_sheave = rho/2 (l s" + s'^2) (N - 1)/N: see README.md
# written by make_reference.py
# measure: mean REQUEST/1.F2 from {start:g} to {stop:g} = {steady:.8g} tol rel 5e-3
# tolerance REQUEST/1.F2: peak 5e-3
# tolerance REQUEST/2.*: abs 1e-5
# tolerance REQUEST/2.F3: abs 1e-4
# tolerance POINT_MASS/{tip}.y: abs 1e-9
time,REQUEST/1.F2,REQUEST/2.F2,REQUEST/2.F3,REQUEST/2.F4,POINT_MASS/{tip}.y"""

TOP = """The paper's Level 3 cable: {n} sections paid out over a pulley
! Written by make_reference.py. The pulley (PART/{pulley}) feeds cable along +x, the tip follows.
! The winch runs up smoothly to 30 m/s, which it has reached to 0.3 % after 1 s; with x = TIME/0.1
! the payout is 30 (TIME - 0.1 (3 - (3 + 2 x + x**2/2) exp(-x))).
! Section k joins MARKER k and k+1; its free length L_0 + DeltaL and the mass Dm grow.
! SFORCE and VFORCE are the paper's, except that every VFORCE component is negated (d'Alembert).

UNITS/SYSTEM=MKS

! Axial stiffness [N]; free length of a section at the start, and what the pulley has added [m];
! mass it has added to a node [kg].
VARIABLE/EA, FUNCTION=6.0E7
VARIABLE/L_0, FUNCTION={section:g}
VARIABLE/DeltaL, FUNCTION=0.5*AZ({pulley},{bearing})/{n}
VARIABLE/Dm, FUNCTION=5.536*VARVAL(DeltaL)

PART/1, GROUND
MARKER/1, PART=1                ! the cable leaves the pulley here
MARKER/{bearing}, PART=1, QP=0,0.5,0

PART/{pulley}, MASS=100, CM={pulley}, IP=7,7,12.5, QG=0,0.5,0
MARKER/{pulley}, PART={pulley}
JOINT/1, REVOLUTE, I={pulley}, J={bearing}
GCON/1, FUNCTION=0.5*AZ({pulley},{bearing})
, -30*(TIME-0.1*(3-(3+20*TIME+50*TIME**2)*EXP(-10*TIME)))
"""

NODE = """
! ---- node {k:02d} ----
POINT_MASS/{k}, MASS={mass:g}, CM=cm{k:02d}, QG={x:.12g},0,0
MARKER/cm{k:02d}, POINT_MASS={k}
MARKER/{k}, POINT_MASS={k}
VFORCE/{k:02d}, I_marker=(cm{k:02d}), J_part=(ground)
, FX= -VARVAL(Dm) /Gc * (ACCX(cm{k:02d},0,0)-IGRAV)
,      - VARVAL(d(Dm)/dt) /Gc * VX(cm{k:02d},0,0) \\
, FY= -VARVAL(Dm) /Gc * (ACCY(cm{k:02d},0,0)-JGRAV)
,      - VARVAL(d(Dm)/dt) /Gc * VY(cm{k:02d},0,0) \\
, FZ= -VARVAL(Dm)/Gc * (ACCZ(cm{k:02d},0,0)-KGRAV)
,      - VARVAL(d(Dm)/dt) /Gc * VZ(cm{k:02d},0,0)
"""

SECTION = """SFORCE/{i:02d}{j:02d}, I={i}, J={j}
, FUNCTION= -EA/(L_0+\\Delta L)*[DM({i},{j})-(L_0+\\Delta L)]
"""

TIP = """
! ---- the tip, a hook of 50 kg, keeps the pretension of 13345 N in the cable ----
POINT_MASS/{tip}, MASS=50, CM={tip}, QG={x:.12g},0,0
MARKER/{tip}, POINT_MASS={tip}
GCON/2, FUNCTION=DX({tip},1)-(1+13345/6.0E7)*(20+0.5*AZ({pulley},{bearing}))

! ---- the sections ----
"""

BOTTOM = """
! F2: the pull at the tip less that at the pulley.
REQUEST/1, F2=SFORCE({last},0,2,0)-SFORCE(0102,0,2,0)
! Payout, payout speed, place of the tip.
REQUEST/2, F2=0.5*AZ({pulley},{bearing}) \\
, F3=0.5*WZ({pulley},{bearing}) \\
, F4=DX({tip},1)

INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-7
SIMULATE/DYNAMIC, END=2, STEPS=400
END
"""


def payout(t):
    """Payout s, its speed s' and its acceleration s" (each shaped like t)."""
    x = t / RISE
    fade = np.exp(-x)
    s = SPEED * (t - RISE * (3 - (3 + 2 * x + x * x / 2) * fade))
    return s, SPEED * (1 - (1 + x + x * x / 2) * fade), SPEED / RISE * x * x / 2 * fade


def difference(t, n):
    """Closed form of T_tip - T_sheave [N] for n sections (shaped like t)."""
    s, rate, acceleration = payout(t)
    return RHO / 2 * ((L0 + s) * acceleration + rate**2) * (n - 1) / n


def steady(n):
    """The same for steady payout [N]."""
    return RHO * SPEED**2 * (n - 1) / (2 * n)


def tensions(t, inner, n):
    """Tension of every section [N] from the places of the inner nodes: (n,)."""
    length = L0 + payout(t)[0]
    x = np.concatenate([[0], inner, [length * (1 + PRETENSION / EA)]])
    return EA * (np.diff(x) * n / length - 1)


def check(n):
    """The closed form against the element's equations, integrated with every axial wave."""

    def rhs(t, y):
        s, rate, _ = payout(t)
        pull = np.diff(tensions(t, y[: n - 1], n))
        v = y[n - 1 :]
        return np.concatenate([v, (pull - RHO * rate / n * v) * n / (RHO * (L0 + s))])

    x = L0 * (1 + PRETENSION / EA) * np.arange(1, n) / n
    times = np.linspace(0, END, 1001)
    run = solve_ivp(
        rhs,
        (0, END),
        np.concatenate([x, 0 * x]),
        method="DOP853",
        t_eval=times,
        rtol=1e-9,
        atol=1e-11,
    )
    pull = np.array([tensions(t, y[: n - 1], n) for t, y in zip(times, run.y.T, strict=True)])
    measured = pull[:, -1] - pull[:, 0]
    expected = difference(times, n)
    assert np.abs(measured - expected).max() < 3e-3 * expected.max()
    window = (times >= WINDOW[0]) & (times <= WINDOW[1])
    assert abs(measured[window].mean() - steady(n)) < 1e-3 * steady(n)
    assert pull.min() > 0.8 * PRETENSION


def deck(n):
    """The text of the deck with n sections."""
    ids = {"n": n, "tip": n + 1, "pulley": 10 * n + 1, "bearing": 10 * n + 2}
    stretched = L0 / n * (1 + PRETENSION / EA)
    text = TOP.format(section=L0 / n, **ids)
    for k in range(2, n + 1):
        text += NODE.format(k=k, x=(k - 1) * stretched, mass=RHO * L0 / n)
    text += TIP.format(x=n * stretched, **ids)
    text += "".join(SECTION.format(i=k, j=k + 1) for k in range(1, n + 1))
    return text + BOTTOM.format(last=f"{n:02d}{n + 1:02d}", **ids)


def write(folder, n):
    """Check the closed form, then write <folder>/<folder>.adm and <folder>/reference.csv."""
    check(n)
    Path(folder, folder.name + ".adm").write_text(deck(n))
    t = np.linspace(0, END, 101)
    s, rate, _ = payout(t)
    tip = (1 + PRETENSION / EA) * (L0 + s)
    header = HEADER.format(n=n, tip=n + 1, start=WINDOW[0], stop=WINDOW[1], steady=steady(n))
    table = np.column_stack([t, difference(t, n), s, rate, tip, 0 * t]) + 0.0
    path = Path(folder, "reference.csv")
    np.savetxt(path, table, fmt="%.12g", delimiter=",", header=header, comments="")

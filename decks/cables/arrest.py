"""An aircraft hook in a purchase cable that two deck sheaves pay out against engines.

The hook starts at (x0, 0) and runs along y; the sheaves are at x = -a and a. Cables are of the ale
form. Energy of one side, with the section strain e and the cable's own velocity in node k,
V_k = v_k + W_k (x_(k+1) - x_(k-1))/(2 H):

    E = sum rho H/2 V_k^2 (half at both ends) + sum EA e^2 H/2 + m_p S'^2/2
    E' = -F S' - EA e_1^2 S'/2 + rho S' ((1 + e_1) S')^2/2 + what the hook does

F is the engine's force; the last two terms are what leaves with the strain, and enters with the
speed, of the cable over the sheave. Their integral is a DIFF.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from formulas import Cable
from pulleys import RADIUS, damped_variables, payout_variables, pulley
from ropes import nodes, stored, tensions
from scipy.integrate import solve_ivp
from spans import table

from adamslite.cables.statements.forms import Side, head, number, point, tail

HOOK = 5000
#: Of the hook on straight cables, relative.
ERROR = 1e-7
RIGHT, LEFT = Side("R", 1, 9001), Side("L", 2001, 9011)


@dataclass(frozen=True)
class Arrest:
    """Data of a scene: hook [kg, m/s], span [m], engine [N, m, m/s, kg] and sections per side."""

    cable: Cable
    mass: float
    speed: float
    half_span: float
    engine: float
    stroke: float
    creep: float
    crosshead: float
    sections: int
    end: float
    damping: float = 0.2
    offset: float = 0.0

    def length(self, side: Side) -> float:
        """Free length of a side at the start [m]."""
        return abs(self.sheave(side) - self.offset) / (1 + self.cable.strain)

    def sheave(self, side: Side) -> float:
        """Its x [m]."""
        return self.half_span if side.name == "R" else -self.half_span

    def tension(self, strain: float, rate: float, free: float) -> float:
        """Of a cable of this free length, with the dampers of its sections [N]."""
        damping = 2 * self.damping * self.cable.impedance * free / self.sections
        return max(self.cable.stiffness * strain + damping * rate, 0.0)

    def pull(self, paid: float, feed: float) -> float:
        """Of the engine [N]."""
        part = min(max(paid / self.stroke, 0.0), 1.0)
        full = self.engine * part**2 * (3 - 2 * part)
        return self.cable.pretension + full * feed / np.hypot(feed, self.creep)

    def energy(self, sides: int) -> float:
        """At the start, in as many sides [J]: hook and pretension."""
        free = 2 * self.half_span / (1 + self.cable.strain)
        strained = self.cable.stiffness * self.cable.strain**2 / 2 * free
        return (self.mass * self.speed**2 / 2 + strained) * sides / 2


def named(side: Side, sections: int) -> Side:
    """With the hook as its last node."""
    return Side(side.name, side.first, side.pulley, (sections, HOOK))


def half(a: Arrest, side: Side) -> str:
    """Sheave, engine, nodes and sections of one side."""
    n, s, x0 = a.sections, side.name, a.sheave(side)
    length, turned = a.length(side), side.pulley
    text = payout_variables(a.cable, n, length, side)
    text += tensions(side, n, slack=True)
    text += (
        "! Force of the engine.\n"
        f"VARIABLE/F{s}, FUNCTION={number(a.cable.pretension)}"
        f"+{number(a.engine)}*STEP(S{s},0,0,{a.stroke:g},1)\n"
        f",  *SD{s}/SQRT(SD{s}**2+{a.creep:g}**2)\n"
    )
    text += pulley(a.crosshead, 0.0, x0, side)
    text += (
        f"SFORCE/{turned}, ROTATIONAL, ACTIONONLY, I={turned}, J={turned + 1}"
        f", FUNCTION={RADIUS:g}*(T{s}1-F{s})\n"
    )
    places = [(x0 + (a.offset - x0) * k / n, 0.0) for k in range(1, n)]
    return text + nodes("ale", side, a.cable.density * length / n, places)


def balance(a: Arrest, side: Side) -> str:
    """Energy of a side, and what has left it."""
    s, first = side.name, side.first
    stores, names = stored(side, a.sections)
    out = f"DM({first},{side.node(1)})/H{s}"
    return (
        "\n! Energy of the nodes, strain energy of the sections, heat of the dampers;\n"
        "! the energy of this side and what has left it over the sheave.\n"
        f"{stores}VARIABLE/E{s}, FUNCTION=" + "\n,  +".join(names) + "\n"
        f",  +{number(a.crosshead / 2)}*SD{s}**2+rho*H{s}/4*((SD{s}*{out})**2"
        f"+VX({HOOK})**2+VY({HOOK})**2)\n"
        f"DIFF/Q{s}, IC=0, FUNCTION=SD{s}*(F{s}+T{s}1*({out}-1)-EA/2*MAX(0,{out}-1)**2\n"
        f",  -rho/2*(SD{s}*{out})**2)\n"
    )


def deck(a: Arrest, sides: tuple[Side, ...]) -> str:
    """One side (half the hook, on its line) or both."""
    sides = tuple(named(side, a.sections) for side in sides)
    both, share = len(sides) == 2, len(sides) / 2
    where = f"{a.offset:g} m off the middle" if a.offset else "in the middle"
    text = head(
        f"Arrestment of {a.mass:g} kg at {a.speed:g} m/s, {where}",
        f"""The hook (MARKER/{HOOK}) {"" if both else "with half the mass "}takes the cable
        {where} of two deck sheaves {2 * a.half_span:g} m apart{
            "" if both else ", of which one is there, and stays on its line"
        }. Pulleys of {a.crosshead:g} kg (J/R**2) feed cable
        against the engines: pretension and {a.engine / 1e3:g} kN, that rise over the first
        {a.stroke:g} m of payout and fade below {a.creep:g} m/s.""",
        "",
        "PART/1, GROUND",
        *(f"MARKER/{side.first}, PART=1, QP={number(a.sheave(side))},0,0" for side in sides),
        f"MARKER/{HOOK + 1}, PART=1, QP={number(a.offset)},0,0",
    )
    text += damped_variables(a.cable, a.damping)
    # Half a section of every side goes with the hook.
    hooked = a.mass * share + sum(
        a.cable.density * a.length(side) / a.sections / 2 for side in sides
    )
    text += "\n! The hook.\n" + point(HOOK, hooked, [a.offset, 0.0], [0.0, a.speed])
    text += "" if both else f"GCON/1, FUNCTION=DX({HOOK},{HOOK + 1})\n"
    text += "".join(half(a, side) + balance(a, side) for side in sides)
    names = [side.name for side in sides]
    total = "".join(f"+E{s}+DIF(Q{s})" for s in names)
    text += (
        "\n! Run-out, speed, sideways; energy of the hook and of everything.\n"
        f"REQUEST/1, F2=DY({HOOK},{HOOK + 1})\\ F3=VY({HOOK})\\ F4=DX({HOOK},{HOOK + 1})\n"
        f"VARIABLE/EH, FUNCTION={number(a.mass * share / 2)}*(VX({HOOK})**2+VY({HOOK})**2)\n"
        f"REQUEST/2, F2=EH\\ F3=EH{total}\n"
    )
    for r, side in enumerate(sides, start=3):
        n, s = a.sections, side.name
        text += (
            "! Tension at the sheave and at the hook, payout, force of the engine.\n"
            f"REQUEST/{r}, F2=T{s}1\\ F3=T{s}{n}\\ F4=S{s}\\ F6=F{s}\n"
        )
    return text + tail("HHT, ERROR=1.0E-5", a.end, round(a.end / 0.002))


def straight(a: Arrest, sides: tuple[Side, ...], t: np.ndarray) -> np.ndarray:
    """The hook on straight cables of one strain each, with their mass: x, y, v_x, v_y, (4, nt).

    With e along a cable of length d, n across it, w = v.n/d its rate of turning, the free length
    L = L0 + S and m = rho L, the cable's acceleration along e goes from S" to a.e:

        tension T       EA (d/L - 1) + 2 zeta sqrt(EA rho) H d(d/L)/dt, pulls only
        hook, along     T + m (a.e/3 + S"/6),     across  m (a.n/3 + w d'/3)
        sheave          m_p S" = T - F - m (a.e/6 + S"/3)
    """
    count = len(sides)

    def rates(_, y):
        v, paid, feed = y[2:4], y[4 : 4 + count], y[4 + count :]
        mass = np.diag([a.mass * count / 2] * 2 + [a.crosshead] * count)
        force = np.zeros(2 + count)
        for i, side in enumerate(sides):
            sheave = np.array([a.sheave(side), 0.0])
            d = np.hypot(*(y[:2] - sheave))
            e = (y[:2] - sheave) / d
            n = np.array([-e[1], e[0]])
            free, out = a.length(side) + paid[i], v @ e
            tension = a.tension(d / free - 1, (out - feed[i] * d / free) / free, free)
            m, ends = a.cable.density * free, np.array([*e, 1.0])
            at = np.ix_([0, 1, 2 + i], [0, 1, 2 + i])
            mass[at] += m / 6 * (np.outer(ends, ends) + np.diag([0, 0, 1]))
            mass[:2, :2] += m / 6 * np.outer(e, e) + m / 3 * np.outer(n, n)
            force[:2] -= tension * e + m * out * (v @ n) / d / 3 * n
            force[2 + i] += tension - a.pull(paid[i], feed[i])
        moved = np.arange(count == 1, 2 + count)  # with one side it stays on its line
        change = np.zeros(2 + count)
        change[moved] = np.linalg.solve(mass[np.ix_(moved, moved)], force[moved])
        return [*v, *change[:2], *feed, *change[2:]]

    start = [a.offset, 0.0, 0.0, a.speed, *np.zeros(2 * count)]
    run = solve_ivp(rates, (0, t[-1]), start, "DOP853", t, rtol=1e-8, atol=1e-7)
    return run.y[:4]


REFERENCE = Arrest(
    cable=Cable(6.0e7, 5.536, 13345.0),
    mass=22680.0,
    speed=66.9,
    half_span=15.0,
    engine=3.9e5,
    stroke=55.0,
    creep=4.0,
    crosshead=100.0,
    sections=20,
    end=3.0,
)
SECOND = Arrest(
    cable=Cable(4.5e7, 4.6, 20000.0),
    mass=12000.0,
    speed=60.0,
    half_span=12.0,
    engine=2.1e5,
    stroke=40.0,
    creep=4.0,
    crosshead=80.0,
    sections=20,
    end=2.8,
)


def arrestment() -> Iterator[tuple[str, str, str]]:
    """One side, both, and both with the hook 6 m off the middle."""
    for name, data in {"": REFERENCE, "-second": SECOND}.items():
        for scene, offset, sides in (
            ("one-side", 0.0, (RIGHT,)),
            ("both-sides", 0.0, (RIGHT, LEFT)),
            ("off-centre", 6.0, (RIGHT, LEFT)),
        ):
            a = replace(data, offset=offset)
            total = a.energy(len(sides))
            t = np.linspace(0, a.end, round(a.end / 0.04) + 1)
            x, y, _, vy = straight(a, sides, t)
            lines = [
                "Energy, and the hook on straight elastic cables: README.md",
                "written by generate.py",
                f"measure: max REQUEST/2.F3 = {number(total)} tol rel 1e-3",
                f"measure: min REQUEST/2.F3 = {number(total)} tol rel 1e-3",
                "tolerance REQUEST/1.F2: peak 6e-3",
                "tolerance REQUEST/1.F3: peak 6e-3",
                f"tolerance REQUEST/1.F4: abs {0.002 * y.max():.3g}",
            ]
            header = ["time", "REQUEST/1.F2", "REQUEST/1.F3", "REQUEST/1.F4"]
            reference = table(header, lines, [t, y, vy, x - offset], ERROR)
            yield f"{scene}{name}", deck(a, sides), reference


CASES = {"arrestment": arrestment}

"""A rope between a winch and a load: its statements, its energy, a straight rope to compare with.

Node 0 is where the rope leaves the winch, a place that may move; the last node is the load.
"""

from dataclasses import dataclass

import numpy as np
from formulas import Cable, G
from laws import Law
from pulleys import RADIUS
from scipy.optimize import brentq

from adamslite.cables.statements.forms import Side, grown, grown_tip, number, point


def wheel(side: Side, mount: int, place: tuple[float, float], inertia: float) -> str:
    """A pulley of J/R^2 = `inertia` [kg] that turns on PART/`mount`, at `place` at the start."""
    i, axial, (x, y) = side.pulley, number(inertia * RADIUS**2), place
    return (
        f"\nMARKER/{i + 1}, PART={mount}, QP={number(x)},{number(y)},0\n"
        f"PART/{i}, MASS={number(inertia)}, CM={i}, IP={axial},{axial},{axial}"
        f", QG={number(x)},{number(y)},0\n"
        f"MARKER/{i}, PART={i}\n"
        f"JOINT/{i}, REVOLUTE, I={i}, J={i + 1}\n"
    )


def drum(side: Side, mount: int, place: tuple[float, float], payout: Law, inertia: float) -> str:
    """The same, driven; its MOTION has its number."""
    i = side.pulley
    return (
        wheel(side, mount, place, inertia)
        + f"MOTION/{i}, JOINT={i}, FUNCTION={payout.text(RADIUS)}\n"
    )


def tensions(side: Side, sections: int, slack: bool = False) -> str:
    """VARIABLEs T1, T2, ... of the sections; with `slack` none of them pushes."""
    n = side.name
    opens, closes = ("MAX(0,", ")") if slack else ("", "")
    text = "! Tension of a section" + (": a cable does not push.\n" if slack else ".\n")
    for k in range(1, sections + 1):
        pair = f"{side.node(k - 1)},{side.node(k)}"
        text += (
            f"VARIABLE/T{n}{k}, FUNCTION={opens}EA*(DM({pair})/H{n}-1)"
            f"+damper*(VR({pair})-SD{n}*DM({pair})/LT{n}){closes}\n"
        )
    return text


def nodes(
    form: str, side: Side, mass: float, places: np.ndarray, axes: str = "XY", held: bool = False
) -> str:
    """Inner nodes at `places` (N - 1, 2 or 3), what the payout does to them, the sections.

    A tip that is not `held` has half a section's mass.
    """
    sections, first = len(places) + 1, side.first
    text = "\n"
    for k, place in enumerate(places, start=1):
        text += point(first + k, mass, place) + grown(form, k, sections, axes, side)
    text += "\n" if held else grown_tip(form, first + sections, sections, axes, side) + "\n"
    for k in range(1, sections + 1):
        i, j = side.node(k - 1), side.node(k)
        text += f"SFORCE/{first + k}, I={i}, J={j}, FUNCTION=-T{side.name}{k}\n"
    return text


def hanging(cable: Cable, length: float, sections: int, start, end_pull) -> np.ndarray:
    """Nodes 1 .. N of a rope at rest, (N, 2), from `start` on, whose end is pulled so (2,) [N].

    The pull in section k is that in section k + 1 and the weight of node k.
    """
    free, node = length / sections, cable.density * length / sections
    weights = np.outer(np.arange(sections - 1, -1, -1), [0.0, -node * G])
    pulls = np.asarray(end_pull) + weights
    tension = np.linalg.norm(pulls, axis=1)[:, None]
    return np.asarray(start) + np.cumsum(free * (1 / tension + 1 / cable.stiffness) * pulls, axis=0)


def sums(name: str, factor: str, terms: list[str]) -> tuple[str, str]:
    """VARIABLEs of five terms each, and the sum of their names."""
    groups = [terms[i : i + 5] for i in range(0, len(terms), 5)]
    text = "".join(
        f"VARIABLE/{name}{g}, FUNCTION={factor}*(" + "\n,  +".join(group) + ")\n"
        for g, group in enumerate(groups, start=1)
    )
    return text, "+".join(f"{name}{g}" for g in range(1, len(groups) + 1))


def stored(side: Side, sections: int) -> tuple[str, list[str]]:
    """VARIABLEs and DIFFs of an ale rope, and sums of them:

    energy of the inner nodes (own velocity of the rope V_k = v_k + W_k dx_k), strain energy of the
    sections, heat of the dampers.
    """
    n, s = sections, side.name
    kinetic, strain, lost = [], [], ""
    for k in range(1, n + 1):
        i, j, h = side.node(k), side.node(k + 1), side.node(k - 1)
        stretch = f"MAX(0,DM({h},{i})/H{s}-1)"
        strain.append(f"{stretch}**2")
        lost += (
            f"DIFF/Q{s}{k}, IC=0, FUNCTION=(T{s}{k}-EA*{stretch})"
            f"*(VR({h},{i})-SD{s}*DM({h},{i})/LT{s})\n"
        )
        if k < n:
            w = f"{number((1 - k / n) / 2)}*SD{s}/H{s}"
            kinetic.append(f"(VX({i})+{w}*DX({j},{h}))**2+(VY({i})+{w}*DY({j},{h}))**2")
    moving, all_moving = sums(f"K{s}", f"rho*H{s}/2", kinetic)
    strained, all_strained = sums(f"U{s}", f"EA*H{s}/2", strain)
    heat, all_heat = sums(f"D{s}", "1", [f"DIF(Q{s}{k})" for k in range(1, n + 1)])
    return f"{moving}{strained}{lost}{heat}", [all_moving, all_strained, all_heat]


def balance(side: Side, sections: int) -> str:
    """VARIABLE E, energy of an ale rope without its load; DIFF W, what the winch has done to it.

    Heights count from the winch: the rope that comes brings its strain and its motion only.
    """
    s, n, first = side.name, sections, side.first
    stores, names = stored(side, n)
    one, tip = side.node(1), side.node(n)
    out = f"DM({one},{first})/H{s}"
    own = "+".join(f"(V{a}({first})+SD{s}*D{a}({one},{first})/H{s})**2" for a in "XY")
    heights = "\n,  +".join(f"DY({side.node(k)},{first})" for k in range(1, n))
    along = "+".join(f"V{a}({first})*D{a}({first},{one})" for a in "XY")
    return (
        "\n! Energy of the rope: nodes, strain, heat of the dampers, height; work of the winch.\n"
        f"{stores}"
        f"VARIABLE/V{s}, FUNCTION=rho*{G:g}*H{s}*({heights}\n,  +DY({tip},{first})/2)\n"
        f"VARIABLE/E{s}, FUNCTION={'+'.join(names)}+V{s}\n"
        f",  +rho*H{s}/4*(VM({tip})**2+{own})\n"
        f"DIFF/W{s}, IC=0, FUNCTION=-SD{s}*(T{s}1*{out}-EA/2*({out}-1)**2\n"
        f",  -rho/2*({own}))\n"
        f",  +T{s}1*({along})/DM({first},{one})\n"
    )


@dataclass(frozen=True)
class Pull:
    """What a straight rope does to the load: the force `constant` - `mass` a, (3,) [N, kg]."""

    constant: np.ndarray
    mass: float
    top: float
    along: np.ndarray

    def first(self, acceleration: np.ndarray) -> float:
        """Tension in the middle of the section at the winch [N]."""
        return self.top - self.mass / 2 * float(self.along @ acceleration)


@dataclass(frozen=True)
class Straight:
    """An elastic rope that stays straight but for the sag of its own weight, (3,) vectors.

    d is the distance of its ends, e the direction from the winch to the load, L = length + s the
    free length. The mean tension follows from the length of a flat parabola,

        d + d^3 w^2/(24 T^2) = L (1 + T/EA),   w = rho |g across e|

    (H. M. Irvine, Cable Structures, 1981, section 2.3). Weight less inertia is f0 + x f1 at the
    share x of the rope, counted from the winch, whose place is p0 and whose speed is v0:

        rope (ale)  f = rho L (g - p0" - (s" + (d" - s") x) e - 2 s' e' - x d e")
        paper       f = rho L g - d/dt (rho L (v0 + x (v - v0)))

    Its moment about the winch and its sum give the tensions at both ends.
    """

    form: str
    cable: Cable
    length: float
    sections: int
    damping: float

    def mean(self, d: float, free: float, across: float) -> float:
        """T [N] at rest; `across` is w."""
        stiffness, sag = self.cable.stiffness, d**3 * across**2 / 24

        def surplus(tension):
            return free * (1 + tension / stiffness) - d - sag / tension**2

        high = max(2 * stiffness * (d / free - 1), 1.0)
        while surplus(high) < 0:
            high *= 2
        return brentq(surplus, 1e-3, high, rtol=1e-14)

    def pull(self, winch, payout, place, speed) -> Pull:
        """`winch` is (3, 3): place, speed and acceleration of the winch; `payout` s, s', s"."""
        cable, n, gravity = self.cable, self.sections, np.array([0.0, -G, 0.0])
        paid, rate, acceleration = payout
        r, v, free = place - winch[0], speed - winch[1], self.length + paid
        d = float(np.linalg.norm(r))
        e = r / d
        grows = v @ e
        turns = (v - grows * e) / d
        tension = self.mean(d, free, cable.density * float(np.linalg.norm(np.cross(e, gravity))))
        tension += 2 * self.damping * cable.impedance / n * (grows - rate * d / free)
        mass, entering = cable.density * free, cable.density * rate
        # Without the load's own acceleration a: that part of f1 is -rho L a.
        if self.form == "paper":
            f0 = mass * (gravity - winch[2]) - entering * winch[1]
            f1 = mass * winch[2] - entering * v
        else:
            f0 = mass * (gravity - winch[2] - acceleration * e - 2 * rate * turns)
            f1 = mass * (winch[2] + acceleration * e + 2 * grows * turns)
        top = tension + float(e @ (f0 * (1 - 1 / n) / 2 + f1 / 6))
        return Pull(f0 / 2 + f1 / 3 - tension * e, mass / 3, top, e)

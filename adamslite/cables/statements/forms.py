"""The statements of a cable on a pulley, in four forms.

    fixed        sections of fixed free length L_0
    brute force  the same, and the supply is laid out as sections that pass the sheave one by one
    paper        N sections of free length H = (l0 + S)/N that all grow with the payout S; nodes in
                 between gain mass Dm = rho S/N, force -d(Dm V)/dt + Dm g
    ale          the same nodes as points that the cable flows through

Node 0 is at the sheave (MARKER/1, ground), node k at MARKER/k+1. With XI = 1 - k/N, W = XI S' and
d/dk the central difference, the ale node has the force

    -Dm (ACC - g) - rho (W (d v/dk 2 - S'/LT d x/dk 2) + W^2/H d2 x/dk2 + XI S" d x/dk)

which is -Dm (ACC - g) less (m0 + Dm) times the convective part of the acceleration.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import wrap

from adamslite.cables.description.components import Cable
from adamslite.cables.vectors import Vector

# Of a component, as a share of the largest.
ROUND_OFF = 1e-12
PULLEY = 9001
AXES = "XYZ"


@dataclass(frozen=True)
class Side:
    """What the statements of one variable-length cable are called; a scene may have two.

    `name` is appended to its variables, node k is MARKER/first + k, except node `tip[0]`, which is
    MARKER/tip[1]; the pulley is PART/pulley, its bearing MARKER/pulley + 1. `carried` when the
    bearing is on a part whose attitude changes.
    """

    name: str = ""
    first: int = 1
    pulley: int = PULLEY
    tip: tuple[int, int] = (-1, 0)
    carried: bool = False

    def node(self, k: int) -> int:
        """Marker of node k."""
        return self.tip[1] if k == self.tip[0] else self.first + k


ONLY = Side()


def number(value: float) -> str:
    """Short text of a number."""
    return f"{value + 0.0:.11g}"


def rounded(values: Sequence[float]) -> tuple[float, ...]:
    """Components without those that are rounding errors of the largest."""
    least = ROUND_OFF * max(map(abs, values), default=0.0)
    return tuple(x if abs(x) > least else 0.0 for x in values)


def head(
    title: str, notes: str, *lines: str, author: str = "generate.py", comments: str = ""
) -> str:
    """Title, comments and units; `comments` are lines that stand below the notes as they are."""
    text = "".join(f"! {line}\n" for line in wrap(" ".join(notes.split()), 96))
    return f"{title}\n{text}! Written by {author}.\n{comments}\nUNITS/SYSTEM=MKS\n" + "".join(
        f"{line}\n" for line in lines
    )


def tail(integrator: str, end: float, steps: int) -> str:
    """The run."""
    return f"\nINTEGRATOR/{integrator}\nSIMULATE/DYNAMIC, END={number(end)}, STEPS={steps}\nEND\n"


def point(i: int, mass: float, place: Vector, speed: Sequence[float] = ()) -> str:
    """A mass with a marker of its number."""
    ways = zip(AXES, rounded(speed), strict=False)
    start = "".join(f", V{a}={number(v)}" for a, v in ways if v)
    x, y, z = (*rounded(place), 0.0, 0.0)[:3]
    return (
        f"POINT_MASS/{i}, MASS={number(mass)}, CM={i}"
        f", QG={number(x)},{number(y)},{number(z)}{start}\nMARKER/{i}, POINT_MASS={i}\n"
    )


def cable_variables(cable: Cable, damping_time: float = 0.0) -> str:
    """Names for EA, rho and, with damping, the time tau of T = EA (strain + tau strain rate)."""
    text = (
        f"\nVARIABLE/EA, FUNCTION={number(cable.stiffness)}\n"
        f"VARIABLE/rho, FUNCTION={number(cable.density)}\n"
    )
    if damping_time:
        text += f"VARIABLE/tau, FUNCTION={number(damping_time)}\n"
    return text


def section(
    s: int, i: int, j: int, free: str, damped: bool = False, pulls_only: bool = False
) -> str:
    """SFORCE/s between MARKER/i and MARKER/j of the free length `free`: L_0, or H of a side."""
    pull = elastic(i, j, free, damped)
    pull = f"MAX(0,{pull})" if pulls_only else pull
    return f"SFORCE/{s}, I={i}, J={j}, FUNCTION=-{pull}\n"


def elastic(i: int, j: int, free: str, damped: bool) -> str:
    """EA (strain + tau strain rate) between MARKER/i and MARKER/j."""
    grows = f"-SD{free[1:]}*DM({i},{j})/LT{free[1:]}" if free[0] == "H" else ""
    rate = f"+tau*(VR({i},{j}){grows})/{free}" if damped else ""
    return f"EA*(DM({i},{j})/{free}-1{rate})"


def length_variables(a: str, sections: int, length: float, ways: list[str]) -> str:
    """Payout S, its rates, length LT, H of a section, mass Dm of a node, from the expressions of S,
    S' and S"; `a` is appended to the names.
    """
    return (
        f"\n! Payout and its rates; free length of the cable and of a section; mass a node gains.\n"
        f"VARIABLE/S{a}, FUNCTION={ways[0]}\n"
        f"VARIABLE/SD{a}, FUNCTION={ways[1]}\n"
        f"VARIABLE/SDD{a}, FUNCTION={ways[2]}\n"
        f"VARIABLE/LT{a}, FUNCTION={number(length)}+S{a}\n"
        f"VARIABLE/H{a}, FUNCTION=LT{a}/{sections}\n"
        f"VARIABLE/Dm{a}, FUNCTION=rho*S{a}/{sections}\n"
    )


def grown(form: str, k: int, sections: int, axes: str = "XY", side: Side = ONLY) -> str:
    """What the payout does to node k between the sheave and the tip."""
    i = side.node(k)
    return vforce(i, i, axes, [_grown(form, k, sections, a, side) for a in axes])


def grown_tip(form: str, s: int, sections: int, axes: str = "XY", side: Side = ONLY) -> str:
    """VFORCE/s: what it does to the tip, half a section of mass that moves with the cable."""
    i, n = side.node(sections), side.name
    lost = f"-rho*SD{n}/{2 * sections}*V{{a}}({i})" if form == "paper" else ""
    return vforce(
        s, i, axes, [f"-Dm{n}/2*(ACC{a}({i})-{gravity(a)}){lost.format(a=a)}" for a in axes]
    )


def gravity(axis: str) -> str:
    """The name of gravity along an axis."""
    return {"X": "IGRAV", "Y": "JGRAV", "Z": "KGRAV"}[axis]


def vforce(s: int, i: int, axes: str, components: list[str]) -> str:
    """VFORCE/s on MARKER/i; ground takes the reaction."""
    lines = "\\\n".join(f", F{a}={f}" for a, f in zip(axes, components, strict=True))
    return f"VFORCE/{s}, I={i}, J_PART=1\n{lines}\n"


def _grown(form: str, k: int, sections: int, a: str, side: Side) -> str:
    i, after, before, n = side.node(k), side.node(k + 1), side.node(k - 1), side.name
    gained = f"-Dm{n}*(ACC{a}({i})-{gravity(a)})"
    if form == "paper":
        return f"{gained}-rho*SD{n}/{sections}*V{a}({i})"
    xi = number(1 - k / sections)
    return (
        f"{gained}-rho*({xi}*SD{n}*(V{a}({after},{before})-SD{n}/LT{n}*D{a}({after},{before}))\n"
        f",  +({xi}*SD{n})**2/H{n}*(D{a}({after},{i})-D{a}({i},{before}))"
        f"+{xi}*SDD{n}*D{a}({after},{before})/2)"
    )

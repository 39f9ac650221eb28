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

from textwrap import wrap

from formulas import Cable

PULLEY, BEARING = 9001, 9002
RADIUS = 0.5
# "The impact speed is constant": the hook is a mass that no cable slows down.
HEAVY = 1e9
AXES = "XYZ"


def number(value: float) -> str:
    """Short text of a number."""
    return f"{value + 0.0:.11g}"


def head(title: str, notes: str, *lines: str) -> str:
    """Title, comments and units."""
    text = "".join(f"! {line}\n" for line in wrap(" ".join(notes.split()), 96))
    return f"{title}\n{text}! Written by generate.py.\n\nUNITS/SYSTEM=MKS\n" + "".join(
        f"{line}\n" for line in lines
    )


def tail(integrator: str, end: float, steps: int) -> str:
    """The run."""
    return f"\nINTEGRATOR/{integrator}\nSIMULATE/DYNAMIC, END={number(end)}, STEPS={steps}\nEND\n"


def point(i: int, mass: float, place, speed=()) -> str:
    """A mass with a marker of its number."""
    start = "".join(f", V{a}={number(v)}" for a, v in zip(AXES, speed, strict=False) if v)
    x, y, z = (*place, 0.0, 0.0)[:3]
    return (
        f"POINT_MASS/{i}, MASS={number(mass)}, CM={i}"
        f", QG={number(x)},{number(y)},{number(z)}{start}\nMARKER/{i}, POINT_MASS={i}\n"
    )


def cable_variables(cable: Cable, damping: float = 0.0) -> str:
    """Names for EA, rho and, with a share of critical damping, the damper of a section."""
    text = (
        f"\nVARIABLE/EA, FUNCTION={number(cable.stiffness)}\n"
        f"VARIABLE/rho, FUNCTION={number(cable.density)}\n"
    )
    if damping:
        text += f"VARIABLE/damper, FUNCTION=2*{damping:g}*SQRT(EA*rho)\n"
    return text


def section(s: int, i: int, j: int, free: str, damping: float = 0.0) -> str:
    """SFORCE/s between MARKER/i and MARKER/j of the free length `free`."""
    grows = f"-SD*DM({i},{j})/LT" if free == "H" else ""
    damper = f"-damper*(VR({i},{j}){grows})" if damping else ""
    return f"SFORCE/{s}, I={i}, J={j}, FUNCTION=-EA*(DM({i},{j})/{free}-1){damper}\n"


def impedance(s: int, i: int, cable: Cable, side: int = 1) -> str:
    """The pull of a long straight run on MARKER/i, along +x (`side` 1) or -x (-1)."""
    return (
        "! A long run goes on from here: it pulls with T0 + rho c v, v the speed away from it\n"
        "! (z of the marker is x).\n"
        f"MARKER/{s}, PART=1, REULER=90D,90D,0D\n"
        f"SFORCE/{s}, ACTIONONLY, I={i}, J={s}"
        f", FUNCTION={number(side * cable.pretension)}-SQRT(EA*rho)*VX({i})\n"
    )


def through_the_sheave(s: int, i: int, j: int, supply: int) -> str:
    """A section that may lie over the sheave, a point at the origin.

    SFORCE/s while both ends are on one side; else SFORCE/s+10000 and s+20000 pull both towards the
    sheave with one tension. MARKER/`supply` takes the pull of the supply.
    """
    over, pull = f"IF(DX({i})*DX({j}):", f"-EA*((DM({i})+DM({j}))/L_0-1)"
    return (
        f"SFORCE/{s}, I={i}, J={j}, FUNCTION={over} 0,0,-EA*(DM({i},{j})/L_0-1))\n"
        f"SFORCE/{s + 10000}, I={i}, J=1, FUNCTION={over} {pull},0,0)\n"
        f"SFORCE/{s + 20000}, I={j}, J={supply}, FUNCTION={over} {pull},0,0)\n"
    )


def payout_variables(cable: Cable, sections: int, length: float) -> str:
    """Payout S and its rates from the pulley; length LT, H of a section; mass Dm of a node."""
    return (
        f"\n! Payout and its rates; free length of the cable and of a section; mass a node gains.\n"
        f"VARIABLE/S, FUNCTION={RADIUS:g}*AZ({PULLEY},{BEARING})\n"
        f"VARIABLE/SD, FUNCTION={RADIUS:g}*WZ({PULLEY},{BEARING})\n"
        f"VARIABLE/SDD, FUNCTION={RADIUS:g}*WDTZ({PULLEY},{BEARING})\n"
        f"VARIABLE/LT, FUNCTION={number(length)}+S\n"
        f"VARIABLE/H, FUNCTION=LT/{sections}\n"
        f"VARIABLE/Dm, FUNCTION=rho*S/{sections}\n"
    )


def pulley(inertia: float, speed: float = 0.0, place=(0.0, RADIUS)) -> str:
    """A pulley of `inertia` = J/R^2 [kg] beside the sheave point, turning at speed/R."""
    x, y = place
    spin = f", WZ={number(speed / RADIUS)}" if speed else ""
    axial = number(inertia * RADIUS**2)
    return (
        f"\nMARKER/{BEARING}, PART=1, QP={number(x)},{number(y)},0\n"
        f"PART/{PULLEY}, MASS={number(inertia)}, CM={PULLEY}, IP={axial},{axial},{axial}"
        f", QG={number(x)},{number(y)},0{spin}\n"
        f"MARKER/{PULLEY}, PART={PULLEY}\n"
        f"JOINT/1, REVOLUTE, I={PULLEY}, J={BEARING}\n"
    )


def grown(form: str, k: int, sections: int, axes: str = "XY") -> str:
    """What the payout does to node k between the sheave and the tip."""
    return _vforce(k + 1, axes, [_grown(form, k, sections, a) for a in axes])


def grown_tip(form: str, k: int, sections: int, axes: str = "XY") -> str:
    """What it does to the tip, which has half a section's mass and moves with the cable."""
    i, lost = k + 1, f"-rho*SD/{2 * sections}*V{{a}}({k + 1})" if form == "paper" else ""
    return _vforce(i, axes, [f"-Dm/2*(ACC{a}({i})-{_gravity(a)}){lost.format(a=a)}" for a in axes])


def _gravity(axis: str) -> str:
    return {"X": "IGRAV", "Y": "JGRAV", "Z": "KGRAV"}[axis]


def _vforce(i: int, axes: str, components: list[str]) -> str:
    lines = "\\\n".join(f", F{a}={f}" for a, f in zip(axes, components, strict=True))
    return f"VFORCE/{i}, I={i}, J_PART=1\n{lines}\n"


def _grown(form: str, k: int, sections: int, a: str) -> str:
    i, after, before = k + 1, k + 2, k
    gained = f"-Dm*(ACC{a}({i})-{_gravity(a)})"
    if form == "paper":
        return f"{gained}-rho*SD/{sections}*V{a}({i})"
    xi = number(1 - k / sections)
    return (
        f"{gained}-rho*({xi}*SD*(V{a}({after},{before})-SD/LT*D{a}({after},{before}))\n"
        f",  +({xi}*SD)**2/H*(D{a}({after},{i})-D{a}({i},{before}))"
        f"+{xi}*SDD*D{a}({after},{before})/2)"
    )

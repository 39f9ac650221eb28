"""A trolley on a bridge, its hoist and the load below: sway.

The bridge lies along x, the load hangs down, -y. With the trolley at x, a rope of the length l and
no mass, at the angle a from the vertical (positive when the load is ahead of the trolley):

    l a" + 2 l' a' + g sin(a) + x" cos(a) = 0
    T = m (g cos(a) + l a'^2 - l" - x" sin(a))
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from formulas import Cable, G
from laws import Law, Travel, law
from pulleys import RADIUS, damped_variables, payout_variables
from ropes import Straight, balance, drum, nodes, tensions
from scipy.integrate import solve_ivp
from spans import FORMS, table
from sway import Ramp, most_sway, no_sway

from adamslite.cables.statements.forms import (
    PULLEY,
    Side,
    head,
    number,
    point,
    tail,
)

LOAD, TROLLEY = 5000, 2
DAMPING = 0.2
#: Relative, with a rope without mass and with one: its tension is EA/T times less exact.
RIGID_ERROR, ROPE_ERROR = 1e-8, 1e-6
AHEAD = np.array([1.0, 0.0, 0.0])


@dataclass(frozen=True)
class Crane:
    """Load, trolley and winch (J/R^2) [kg], length of the rope at the start [m], payout."""

    load: float
    trolley: float
    winch: float
    length: float
    payout: Law = Law()
    cable: Cable = Cable(1e8, 0.0)
    sections: int = 1

    @property
    def side(self) -> Side:
        """Names of the rope."""
        return Side(tip=(self.sections, LOAD))


def bridge(c: Crane, title: str, notes: str, travel: str) -> str:
    """Head, trolley, drive of the trolley (none: it rolls freely) and winch."""
    text = head(
        title,
        notes,
        f"ACCGRAV/JGRAV={number(-G)}",
        "",
        "PART/1, GROUND",
        "MARKER/6002, PART=1, REULER=90D,90D,0D  ! z along the bridge",
        "",
        "! The trolley; the rope leaves it at MARKER/1.",
        f"PART/{TROLLEY}, MASS={number(c.trolley)}, CM=1, IP=100,100,100",
        f"MARKER/1, PART={TROLLEY}",
        f"MARKER/6001, PART={TROLLEY}, REULER=90D,90D,0D",
        "JOINT/1, TRANSLATIONAL, I=6001, J=6002",
    )
    text += f"MOTION/1, JOINT=1, FUNCTION={travel}\n" if travel else ""
    return text + drum(c.side, TROLLEY, (0.0, RADIUS), c.payout, c.winch)


def rigid(
    c: Crane, title: str, notes: str, travel: str, end: float, steps: int, angle: float = 0.0
) -> str:
    """The rope as a length that is what the winch has left of it; the load starts at `angle`."""
    text = bridge(c, title, notes, travel)
    place = [c.length * np.sin(angle), -c.length * np.cos(angle)]
    turn = f"({PULLEY},{PULLEY + 1})"
    text += (
        "\n! The load; the length of the rope.\n"
        + point(LOAD, c.load, place)
        + f"VARIABLE/L, FUNCTION={number(c.length)}+{RADIUS:g}*AZ{turn}\n"
        f"GCON/1, FUNCTION=DM({LOAD},1)-L\n"
        "\n! Energy; work of the winch and of the drive of the trolley.\n"
        f"DIFF/W, IC=0, FUNCTION=MOTION({PULLEY},0,8)*WZ{turn}"
        + ("+MOTION(1,0,2)*VX(1)" if travel else "")
        + "\n"
        f"VARIABLE/E, FUNCTION={number(c.load)}*(VM({LOAD})**2/2+{G:g}*DY({LOAD}))"
        f"+{number((c.trolley + c.winch) / 2)}*VX(1)**2\n"
        f",  +{number(c.winch * RADIUS**2 / 2)}*WZ{turn}**2\n"
        "\n! Place of the trolley, of the load from it; pull of the rope.\n"
        f"REQUEST/1, F2=DX(1)\\ F3=DX({LOAD},1)\\ F4=DY({LOAD},1)\n"
        f"REQUEST/2, F2=MOTION({PULLEY},0,8)\\ F3=E-DIF(W)\\"
        f" F4={number(c.load)}*VX({LOAD})+{number(c.trolley + c.winch)}*VX(1)\n"
    )
    return text + tail("GSTIFF, SI2, ERROR=1.0E-7", end, steps)


# ---- constant acceleration, for the whole or half a period ------------------------------------


RAMPS = {
    "": (Crane(8000.0, 1500.0, 100.0, 12.0), 0.6),
    "-second": (Crane(20000.0, 4000.0, 300.0, 25.0), -1.5),
}


def ramps() -> Iterator[tuple[str, str, str]]:
    """Closed forms for any amplitude, to the right and to the left."""
    for name, (crane, acceleration) in RAMPS.items():
        ramp = Ramp(acceleration, crane.length)
        whole = Travel(acceleration, ramp.period, 3.0)
        half = Travel(acceleration, ramp.period / 2, 1e3)
        for scene, travel, sway, end in (
            ("no-sway", whole, lambda t, r=ramp: no_sway(r, 3.0, t), 2 * ramp.period + 6.0),
            ("most-sway", half, lambda t, r=ramp: most_sway(r, t), 3.0 * ramp.period),
        ):
            deck = rigid(
                crane,
                f"Crane: {scene.replace('-', ' ')}",
                f"""The trolley starts with {acceleration:g} m/s**2 for {travel.ramp:.6g} s,
                {"one period" if scene == "no-sway" else "half a period"} of the load's swing about
                the apparent vertical{", and stops alike" if scene == "no-sway" else ""}. The rope
                of {crane.length:g} m is held by the brake of the winch.""",
                travel.text,
                end,
                400,
            )
            t = np.linspace(0, end, 101)
            angle, _, pull = sway(t)
            place = crane.length * np.array([np.sin(angle), -np.cos(angle)])
            lines = [
                "Sway in closed form: README.md",
                "written by generate.py",
                f"tolerance: abs {number(2e-6 * crane.length)}",
                f"tolerance REQUEST/2.F2: abs {number(2e-5 * crane.load * G * RADIUS)}",
                f"tolerance REQUEST/2.F3: abs {number(1e-5 * crane.load * G * crane.length)}",
            ]
            energy = np.full_like(t, -crane.load * G * crane.length)
            header = ["time", "REQUEST/1.F2", "REQUEST/1.F3", "REQUEST/1.F4"]
            header += ["REQUEST/2.F2", "REQUEST/2.F3"]
            torque = -crane.load * pull * RADIUS
            columns = [t, travel(t), *place, torque, energy]
            yield f"{scene}{name}", deck, table(header, lines, columns)


# ---- free trolley: momentum -------------------------------------------------------------------


def rolling(c: Crane, angle: float, t: np.ndarray) -> np.ndarray:
    """Trolley and load from rest, the load aside by `angle`: x, load from it (2), torque: (4, nt).

    With M the trolley with its winch, the momentum M x' + m (x' + (l sin a)') stays 0 and

        (M + m sin(a)^2) x" = m sin(a) (g cos(a) + l a'^2 - l")
    """
    trolley = c.trolley + c.winch

    def accelerates(s, y):
        sine, cosine = np.sin(y[1]), np.cos(y[1])
        outward = G * cosine + (c.length + s[0]) * y[3] ** 2 - s[2]
        x = c.load * sine * outward / (trolley + c.load * sine**2)
        return x, c.load * (outward - x * sine)

    def rates(time, y):
        s = c.payout(time)
        x, _ = accelerates(s, y)
        turns = -(2 * s[1] * y[3] + G * np.sin(y[1]) + x * np.cos(y[1])) / (c.length + s[0])
        return [y[2], y[3], x, turns]

    start = [0.0, angle, 0.0, 0.0]
    run = solve_ivp(rates, (0, t[-1]), start, "DOP853", t_eval=t, rtol=1e-11, atol=1e-12)
    paid = np.array([c.payout(time) for time in t])
    pulls = [accelerates(s, y)[1] for s, y in zip(paid, run.y.T, strict=True)]
    x, a = run.y[:2]
    place = (c.length + paid[:, 0]) * np.array([np.sin(a), -np.cos(a)])
    return np.array([x, *place, RADIUS * (c.winch * paid[:, 2] - np.array(pulls))])


FREE = {
    "": (Crane(3000.0, 1200.0, 200.0, 10.0, law((1, 7, 5.0))), 20.0),
    "-second": (Crane(6000.0, 9000.0, 400.0, 22.0, law((0, 8, -14.0), (9, 12, 3.0))), -30.0),
}


def free() -> Iterator[tuple[str, str, str]]:
    """The load is let go aside, lowered and lifted while it swings."""
    for name, (crane, degrees) in FREE.items():
        t = np.linspace(0, 15.0, 101)
        angle = np.radians(degrees)
        deck = rigid(
            crane,
            "Crane: the trolley rolls freely",
            f"""The load is let go {degrees:g} degrees from the vertical; the trolley rolls without
            a drive while the winch works.""",
            "",
            15.0,
            400,
            angle,
        )
        weight = crane.load * G
        energy = -weight * crane.length * np.cos(angle)
        lines = [
            "Momentum, energy, and the two equations of motion: README.md",
            "written by generate.py",
            f"tolerance: abs {number(2e-6 * crane.length)}",
            f"tolerance REQUEST/2.F2: abs {number(2e-5 * weight * RADIUS)}",
            f"tolerance REQUEST/2.F3: abs {number(1e-5 * weight * crane.length)}",
            f"tolerance REQUEST/2.F4: abs {number(1e-5 * crane.load)}",
        ]
        header = ["time", "REQUEST/1.F2", "REQUEST/1.F3", "REQUEST/1.F4"]
        header += ["REQUEST/2.F2", "REQUEST/2.F3", "REQUEST/2.F4"]
        columns = [t, *rolling(crane, angle, t), np.full_like(t, energy), np.zeros_like(t)]
        yield f"free-trolley{name}", deck, table(header, lines, columns, RIGID_ERROR)


# ---- rope with mass ---------------------------------------------------------------------------


def at_rest(c: Crane) -> tuple[np.ndarray, float]:
    """Depths of the nodes 1 .. N below the trolley [m]; energy of rope and load [J]."""
    n, free, node = c.sections, c.length / c.sections, c.cable.density * c.length / c.sections
    carried = c.load + node * (n - np.arange(1, n + 1) + 0.5)
    strain = carried * G / c.cable.stiffness
    depths = np.cumsum(free * (1 + strain))
    height = node * (depths.sum() - depths[-1] / 2) + c.load * depths[-1]
    return depths, c.cable.stiffness * free / 2 * float(strain @ strain) - G * height


def elastic(c: Crane, form: str, travel: Law, end: float) -> str:
    """The rope as a variable-length cable, from rest."""
    n, side = c.sections, c.side
    text = bridge(
        c,
        f"Crane: hoisting on the way ({form})",
        f"""Trolley and winch are driven. The rope has {n} sections of variable length; at the
        start everything hangs at rest.""",
        travel.text(),
    )
    text += damped_variables(c.cable, DAMPING) + payout_variables(c.cable, n, c.length, side)
    text += tensions(side, n)
    half = c.cable.density * c.length / n / 2
    depths, _ = at_rest(c)
    text += "\n! The load.\n" + point(LOAD, c.load + half, [0, -depths[-1]])
    text += nodes(form, side, 2 * half, [(0.0, -depth) for depth in depths[:-1]])
    text += (
        f"\n! Place of the trolley, of the load from it; tension at the winch.\n"
        f"REQUEST/1, F2=DX(1)\\ F3=DX({LOAD},1)\\ F4=DY({LOAD},1)\nREQUEST/2, F2=T1\n"
    )
    if form == "ale":
        text += balance(side, n) + (
            "! Energy of load and rope, less the work.\n"
            f"REQUEST/3, F2=E+{number(c.load)}*(VM({LOAD})**2/2+{G:g}*DY({LOAD},1))-DIF(W)\n"
        )
    return text + tail("HHT, ERROR=1.0E-6, HMAX=0.002", end, round(end / 0.05))


def straight(c: Crane, form: str, travel: Law, t: np.ndarray) -> np.ndarray:
    """Trolley, load from it (2), tension in the first section: (4, nt). The rope is `Straight`."""
    rope = Straight(form, c.cable, c.length, c.sections, DAMPING)

    def forces(time, y):
        pull = rope.pull(np.outer(travel(time), AHEAD), c.payout(time), y[:3], y[3:])
        a = (pull.constant - [0.0, c.load * G, 0.0]) / (c.load + pull.mass)
        return a, pull.first(a)

    def rates(time, y):
        return [*y[3:], *forces(time, y)[0]]

    carried = (c.load + c.cable.density * c.length / 2) * G / c.cable.stiffness
    start = [0.0, -c.length * (1 + carried), 0.0, 0.0, 0.0, 0.0]
    run = solve_ivp(rates, (0, t[-1]), start, "DOP853", t_eval=t, rtol=1e-10, atol=1e-11)
    x = np.array([travel(time)[0] for time in t])
    top = [forces(time, y)[1] for time, y in zip(t, run.y.T, strict=True)]
    return np.array([x, run.y[0] - x, run.y[1], top])


HOISTS = {
    "": (
        Crane(8000.0, 1500.0, 100.0, 8.0, law((0, 5, 10.0)), Cable(4.0e7, 5.0), 12),
        law((1, 9, 12.0)),
        14.0,
    ),
    "-second": (
        Crane(20000.0, 4000.0, 300.0, 30.0, law((0.5, 8, -18.0)), Cable(1.2e8, 14.0), 15),
        law((0, 10, -15.0), (10.5, 15, 4.0)),
        15.0,
    ),
}


def hoisting() -> Iterator[tuple[str, str, str]]:
    """Lowered on the way to the right, lifted on the way to the left; both forms of the rope."""
    for name, (crane, travel, end) in HOISTS.items():
        t = np.linspace(0, end, round(end / 0.1) + 1)
        allowed = number(1e-3 * crane.load * G * abs(crane.payout(end)[0]))
        energy = number(at_rest(crane)[1])
        for form in FORMS:
            columns = straight(crane, form, travel, t)
            header = ["time", "REQUEST/1.F2", "REQUEST/1.F3", "REQUEST/1.F4", "REQUEST/2.F2"]
            lines = [
                "The load on a straight rope with mass: README.md",
                "written by generate.py",
                "tolerance: abs 1e-3",
                "tolerance REQUEST/2.F2: peak 2e-3",
            ]
            if form == "ale":
                lines += [
                    f"measure: {least} REQUEST/3.F2 = {energy} tol abs {allowed}"
                    for least in ("min", "max")
                ]
            yield (
                f"hoist-{form}{name}",
                elastic(crane, form, travel, end),
                table(header, lines, [t, *columns], ROPE_ERROR),
            )


def crane() -> Iterator[tuple[str, str, str]]:
    """All of them."""
    yield from ramps()
    yield from free()
    yield from hoisting()


CASES = {"crane": crane}

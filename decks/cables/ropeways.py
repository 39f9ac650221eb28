"""A cable car on a track rope between two towers: the contact moves along the rope.

The towers hold the rope at the origin and at (span, 0). The carriage is node 0 of both parts of the
rope, whose free lengths it shifts from one to the other: its wheel turns by S/R when S has passed,
so that the left part has the length l1 + S and the right one l2 - S.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import strings
from formulas import Cable, G
from laws import Law, law
from pulleys import RADIUS, damped_variables, payout_variables
from ropes import hanging, nodes, stored, tensions, wheel
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve
from spans import table

from adamslite.cables.statements.forms import Side, head, number, tail, vforce

CARRIAGE, WHEEL, DAMPING = 2, 9001, 0.2
#: Of the car that coasts, relative.
ERROR = 1e-8


@dataclass(frozen=True)
class Ropeway:
    """Rope, its free length and the span [m], car with carriage and wheel (J/R^2) [kg], start [m].

    `sections` of each part.
    """

    cable: Cable
    span: float
    car: float
    start: float
    sections: int = 20
    wheel: float = 20.0

    @property
    def length(self) -> float:
        """Of the free rope, which the pretension stretches over the span [m]."""
        return self.span / (1 + self.cable.strain)

    @property
    def mass(self) -> float:
        """Of car and wheel [kg]."""
        return self.car + self.wheel

    @property
    def sides(self) -> tuple[Side, Side]:
        """The left and the right part."""
        n = self.sections
        return Side("L", 1, WHEEL, (n, 8001)), Side("R", 2001, WHEEL, (n, 8002))


def at_rest(r: Ropeway) -> tuple[np.ndarray, np.ndarray, float]:
    """Nodes of both parts from the towers to the carriage, (N, 2); free length of the left one.

    The carriage is held at x = start and its wheel turns freely.
    """
    n, node = r.sections, r.cable.density * r.length / r.sections

    def parts(y):
        lengths = (y[4], r.length - y[4])
        return [
            hanging(r.cable, length, n, (x, 0.0), pull)
            for length, x, pull in zip(lengths, (0.0, r.span), (y[:2], y[2:4]), strict=True)
        ]

    def residual(y):
        left, right = parts(y)
        return [
            left[-1][0] - r.start,
            *(left[-1] - right[-1]),
            np.hypot(*y[:2]) - np.hypot(*y[2:4]),
            y[1] + y[3] + (r.mass + node / 2) * G,
        ]

    share, pull = r.start / r.span, r.cable.pretension + 2 * r.mass * G
    guess = [pull, -r.mass * G * (1 - share), -pull, -r.mass * G * share, r.length * share]
    found = fsolve(residual, guess, xtol=1e-12)
    return *parts(found), found[4]


def through(side: Side) -> str:
    """What the rope that runs through node 0, the carriage, does to it.

    Half a section there has the acceleration of the rope, and the rope that goes from one part to
    the other changes its direction:

        -rho H/2 (x" + 2 S' x'_S + S" x_S - g) - rho S'^2 x_S,   x_S = (x_1 - x_0)/H
    """
    i, j, n = side.first, side.node(1), side.name
    return vforce(
        8000 + i,
        i,
        "XY",
        [
            f"-rho*(H{n}/2*(ACC{a}({i})-{g})+SD{n}*(V{a}({j},{i})-SD{n}/LT{n}*D{a}({j},{i}))\n"
            f",  +(SDD{n}/2+SD{n}**2/H{n})*D{a}({j},{i}))"
            for a, g in (("X", "IGRAV"), ("Y", "JGRAV"))
        ],
    )


def deck(r: Ropeway, title: str, notes: str, haul: Law | None, run: str) -> str:
    """Towers, carriage with its wheel, both parts of the rope."""
    left, right, length = at_rest(r)
    (x, y), n = left[-1], r.sections
    text = head(
        title,
        f"""{notes} The carriage (PART/{CARRIAGE}) runs on a track rope between two towers
        {r.span:g} m apart; each part of the rope has {n} sections, and its length changes by what
        the wheel (PART/{WHEEL}) has let through.""",
        f"ACCGRAV/JGRAV={number(-G)}",
        "",
        "PART/1, GROUND",
        "MARKER/8001, PART=1",
        f"MARKER/8002, PART=1, QP={r.span:g},0,0",
        "",
        f"PART/{CARRIAGE}, MASS={number(r.car)}, CM=1, IP=1000,1000,1000"
        f", QG={number(x)},{number(y)},0",
        f"MARKER/1, PART={CARRIAGE}",
        f"MARKER/2001, PART={CARRIAGE}",
        "JPRIM/1, ORIENTATION, I=1, J=8001",
    )
    text += f"MOTION/1, I=1, J=8001, X, FUNCTION={number(x)}{haul.text()}\n" if haul else ""
    text += damped_variables(r.cable, DAMPING) + wheel(r.sides[0], CARRIAGE, (0.0, 0.0), r.wheel)
    text = text.replace(
        f"QG=0,0,0\nMARKER/{WHEEL}", f"QG={number(x)},{number(y)},0\nMARKER/{WHEEL}"
    )
    parts = zip(r.sides, (left, right), (length, r.length - length), (1, -1), strict=True)
    for side, places, free, sign in parts:
        text += payout_variables(r.cable, n, free, side, sign * RADIUS) + tensions(side, n)
        node = r.cable.density * free / n
        text += nodes("ale", side, node, places[-2::-1], held=True) + through(side)
    text += f"SFORCE/{WHEEL}, ROTATIONAL, ACTIONONLY, I={WHEEL}, J={WHEEL + 1}"
    text += f", FUNCTION={RADIUS:g}*(TL1-TR1)\n"
    text += (
        "\n! Place of the car; tension beside it, force of the haul.\n"
        "REQUEST/1, F2=DX(1)\\ F3=DY(1)\n"
        f"REQUEST/2, F2=TL1\\ F3={'MOTION(1,0,2)' if haul else '0'}\n"
    )
    return text + ("" if haul else energy(r)) + run


def energy(r: Ropeway) -> str:
    """That of car, wheel and rope, in REQUEST/3."""
    names = [f"{number(r.mass / 2)}*VM(1)**2+{number(r.mass * G)}*DY(1)"]
    names.append(f"{number(r.wheel * RADIUS**2 / 2)}*WZ({WHEEL})**2")
    text, n = "", r.sections
    for side in r.sides:
        stores, sums = stored(side, n)
        s, one = side.name, side.node(1)
        own = "+".join(f"(V{a}(1)+SD{s}*D{a}({one},1)/H{s})**2" for a in "XY")
        heights = "\n,  +".join(f"DY({side.node(k)})" for k in range(1, n))
        text += f"{stores}VARIABLE/V{s}, FUNCTION=rho*H{s}*({G:g}*({heights}\n,  +DY(1)/2)"
        text += f"\n,  +({own})/4)\n"
        names += [*sums, f"V{s}"]
    total = "\n,  +".join(names)
    return f"\n! Energy of everything.\n{text}REQUEST/3, F2={total}\n"


# ---- coasting: energy, and a straight rope ------------------------------------------------------


def tension(r: Ropeway, place: np.ndarray) -> float:
    """T beside the car [N] at rest, both parts straight but for their sag."""
    towers = np.array([[0.0, 0.0], [r.span, 0.0]])
    d = np.linalg.norm(place - towers, axis=1)
    across = r.cable.density * G * np.abs(place[0] - towers[:, 0]) / d
    above = r.cable.density * G * -place[1] / 2

    def surplus(pull):
        sag = (d**3 * across**2).sum() / 24 / (pull + above) ** 2
        stretch = (d * (pull + above)).sum() / r.cable.stiffness
        return r.length + stretch - d.sum() - sag

    return brentq(surplus, 1.0, r.cable.stiffness, rtol=1e-14)


def loose(r: Ropeway) -> float:
    """Height of a car that nothing holds across its rope at the start [m]: T (e_1 + e_2) and its
    weight, with half of the rope, balance along e_1 + e_2.
    """
    towers = np.array([[0.0, 0.0], [r.span, 0.0]])

    def surplus(y):
        place = np.array([r.start, y])
        d = np.linalg.norm(towers - place, axis=1)
        pull = ((towers - place) / d[:, None]).sum(0)
        weight = (r.mass + r.cable.density * d.sum() / 2) * G
        return tension(r, place) - weight * pull[1] / (pull @ pull)

    return brentq(surplus, -0.1 * r.span, -1e-3 * r.span)


def coasting(r: Ropeway, t: np.ndarray, height: float | None = None) -> np.ndarray:
    """Place of the car, (2,), and tension, (3, nt), from rest at the start: where it begins to
    move along the ground, or at a `height`.

    Along a part of the length d, direction e from its tower to the car, the rope does not move but
    across: at the distance x d from the tower it has the acceleration x d e".
    """
    density, towers = r.cable.density, np.array([[0.0, 0.0], [r.span, 0.0]])

    def rates(_, y):
        place, v = y[:2], y[2:]
        pull, ends = tension(r, place), []
        matrix, force = r.mass * np.eye(2), np.array([0.0, -r.mass * G])
        for tower in towers:
            d = float(np.hypot(*(place - tower)))
            e, m = (place - tower) / d, density * d
            across = np.eye(2) - np.outer(e, e)
            turns = across @ v / d
            matrix += m / 3 * across
            # The sag turns the rope's end from e, by half its weight across.
            weight = across @ [0.0, -m * G / 2]
            force += weight - np.sqrt(pull**2 - weight @ weight) * e
            force += 2 * m / 3 * (v @ e) * turns
            ends.append((e, turns))
        (left, left_turns), (right, right_turns) = ends
        # The wheel: S' = n.v of the rope passes; it changes its direction and turns the wheel.
        n, turning = (left - right) / 2, (left_turns - right_turns) / 2
        force += density * (n @ v) ** 2 * (left + right)
        matrix += r.wheel * np.outer(n, n)
        force -= r.wheel * (turning @ v) * n
        return [*v, *np.linalg.solve(matrix, force)]

    def upward(y):
        return rates(0.0, [r.start, y, 0.0, 0.0])[3]

    lowest = -0.45 * r.span
    height = brentq(upward, lowest, -1e-3) if height is None else height
    start = [r.start, height, 0.0, 0.0]
    run = solve_ivp(rates, (0, t[-1]), start, "DOP853", t_eval=t, rtol=1e-9, atol=1e-9)
    return np.array([*run.y[:2], [tension(r, y[:2]) for y in run.y.T]])


# ---- the scenes ---------------------------------------------------------------------------------


def plain(t: float) -> str:
    """The run."""
    return tail("HHT, ERROR=1.0E-6, HMAX=0.01", t, round(t / 0.1))


COASTS = {
    "": Ropeway(Cable(9.0e7, 3.5, 9.0e4), 180.0, 2500.0, 20.0, sections=24),
    "-second": Ropeway(Cable(6.0e7, 2.0, 4.0e4), 120.0, 1200.0, 100.0),
}


def coasts() -> Iterator[tuple[str, str, str]]:
    """Let go near a tower, to the right and to the left: down, up to its mirror image, and back."""
    for name, r in COASTS.items():
        t = np.linspace(0, 40.0, 201)
        columns = coasting(r, t)
        text = deck(r, "Cable car: let go", "The car is let go and rolls.", None, plain(40.0))
        mirror = r.span - r.start
        lost = 1e-3 * r.mass * G * float(np.ptp(columns[1]))
        turns = "max" if mirror > r.start else "min"
        lines = [
            "Energy, and the car on a straight rope: README.md",
            "written by generate.py",
            f"measure: {turns} REQUEST/1.F2 = {mirror:g} tol abs 5e-3",
            f"measure: range REQUEST/3.F2 = 0 tol abs {number(lost)}",
            f"tolerance REQUEST/1.F2: abs {number(3e-4 * r.span)}",
            "tolerance REQUEST/1.F3: abs 1.1e-2",
            "tolerance REQUEST/2.F2: peak 2e-3",
        ]
        header = ["time", "REQUEST/1.F2", "REQUEST/1.F3", "REQUEST/2.F2"]
        yield f"coasting{name}", text, table(header, lines, [t, *columns], ERROR)


HAULS = {
    "": (Ropeway(Cable(9.0e7, 5.0, 2.0e5), 300.0, 1500.0, 30.0), law((1, 26, 240.0)), 34.0),
    "-second": (Ropeway(Cable(6.0e7, 3.0, 1.2e5), 200.0, 800.0, 180.0), law((0, 14, -150.0)), 22.0),
}


def hauls() -> Iterator[tuple[str, str, str]]:
    """Hauled across, to the right and to the left."""
    for name, (r, haul, end) in HAULS.items():
        t = np.linspace(0, end, round(end / 0.2) + 1)
        rope = strings.Loaded(r.cable, r.length, r.span, r.mass)
        columns = strings.hauled(rope, lambda time, r=r, haul=haul: haul(time) + [r.start, 0, 0], t)
        text = deck(r, "Cable car: hauled", "The car is hauled across.", haul, plain(end))
        lines = [
            "Load on a taut string: README.md",
            "written by generate.py",
            "tolerance REQUEST/1.F3: peak 5e-3",
            "tolerance REQUEST/2.F2: peak 5e-3",
        ]
        header = ["time", "REQUEST/1.F3", "REQUEST/2.F2"]
        yield f"hauled{name}", text, table(header, lines, [t, *columns], strings.HAULED_ERROR)


SLOW = {
    "": (Ropeway(Cable(9.0e7, 3.5, 9.0e4), 180.0, 2500.0, 18.0), law((0, 100, 144.0)), 100.0),
    "-second": (Ropeway(Cable(6.0e7, 6.0, 7.0e4), 120.0, 1200.0, 108.0), law((0, 80, -96.0)), 80.0),
}


def slow() -> Iterator[tuple[str, str, str]]:
    """Slowly across: the path of a load at rest."""
    for name, (r, haul, end) in SLOW.items():
        t = np.linspace(0, end, 51)
        rope = strings.Loaded(r.cable, r.length, r.span, r.mass)
        places = np.array([haul(time)[0] + r.start for time in t])
        columns = np.transpose([rope.at_rest(x) for x in places])
        columns[2] += [r.mass * haul(time)[2] for time in t]
        text = deck(r, "Cable car: slowly across", "The car is hauled across.", haul, plain(end))
        section = 0.9 * r.span / r.sections
        sag = r.cable.density * G * section**2 / 4 / columns[1].min()
        lines = [
            "Elastic catenaries: README.md",
            "written by generate.py",
            "tolerance REQUEST/1.F2: abs 1e-6",
            f"tolerance REQUEST/1.F3: abs {number(sag)}",
            "tolerance REQUEST/2.F2: peak 1e-3",
            "tolerance REQUEST/2.F3: peak 1e-2",
        ]
        header = ["time", "REQUEST/1.F2", "REQUEST/1.F3", "REQUEST/2.F2", "REQUEST/2.F3"]
        yield f"slow{name}", text, table(header, lines, [t, places, *columns], strings.REST_ERROR)


def cable_car() -> Iterator[tuple[str, str, str]]:
    """All of them."""
    yield from slow()
    yield from coasts()
    yield from hauls()


CASES = {"cable-car": cable_car}

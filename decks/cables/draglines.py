"""The bucket of a drag-line: a hoist rope over the boom's point and a drag rope from the house.

The house turns about the y axis, by the angle a; at a = 0 the boom is in the plane of x and y.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from formulas import Cable, G
from laws import Law, Move, law
from pulleys import damped_variables, payout_variables
from ropes import Straight, balance, drum, hanging, nodes, tensions
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve
from spans import FORMS, table

from adamslite.cables.statements.forms import Side, head, number, point, tail

BUCKET, HOUSE, SECTIONS, DAMPING = 5000, 2, 12, 0.2
#: Of the bucket on straight ropes, relative.
ERROR = 1e-6


@dataclass(frozen=True)
class Dragline:
    """Points of the ropes on the house, path of the bucket [m], its mass [kg], soil [N], slewing.

    The winches take `path`, (time, x, y) each, as if ropes neither sagged nor stretched.
    """

    cable: Cable
    mass: float
    boom: tuple[float, float]
    fairlead: tuple[float, float]
    path: tuple[tuple[float, float, float], ...]
    soil: Law = Law()
    creep: float = 0.2
    slew: Law = Law()
    turns: bool = False
    end: float = 20.0
    band: float = 5e-3  # of the tensions, of their largest: README.md

    @property
    def points(self) -> tuple[tuple[Side, tuple[float, float]], ...]:
        """Hoist and drag rope: names and where they leave the house."""
        tip = (SECTIONS, BUCKET)
        return (
            (Side("H", 1, 9001, tip, self.turns), self.boom),
            (Side("D", 2001, 9011, tip, self.turns), self.fairlead),
        )

    def lengths(self, point: tuple[float, float]) -> np.ndarray:
        """Distances of the path's places from a point [m]."""
        return np.array([np.hypot(x - point[0], y - point[1]) for _, x, y in self.path])

    def payout(self, point: tuple[float, float]) -> Law:
        """What the winch of a rope does."""
        steps = np.diff(self.lengths(point))
        times = [time for time, _, _ in self.path]
        return Law(tuple(map(Move, times[:-1], times[1:], map(float, steps))))

    def leaves(self, point: tuple[float, float], t: float) -> np.ndarray:
        """Place, speed and acceleration of a point of the house at (x, y): (3, 3)."""
        (x, y), (a, w, dw) = point, self.slew(t)
        out, across = np.array([np.cos(a), 0, -np.sin(a)]), np.array([-np.sin(a), 0, -np.cos(a)])
        return np.array([x * out + [0, y, 0], x * w * across, x * (dw * across - w**2 * out)])


def deck(d: Dragline, form: str, axes: str) -> str:
    """House with boom, two winches, two ropes of the form, the bucket."""
    text = head(
        f"Drag-line bucket ({form})",
        f"""The house (PART/{HOUSE}) carries boom, fairlead and winches; MARKER/1 is the sheave at
        the boom's point, MARKER/2001 the fairlead. Both ropes have {SECTIONS} sections of variable
        length and end at the bucket (MARKER/{BUCKET}). All rests at the start.""",
        f"ACCGRAV/JGRAV={number(-G)}",
        "",
        "PART/1, GROUND",
        "MARKER/6002, PART=1, REULER=0D,-90D,0D     ! z upwards: slewing",
        "",
        f"PART/{HOUSE}, MASS=4.0E5, CM=6001, IP=2.0E7,2.0E7,2.0E7",
        f"MARKER/6001, PART={HOUSE}, REULER=0D,-90D,0D",
        *(f"MARKER/{side.first}, PART={HOUSE}, QP={x:g},{y:g},0" for side, (x, y) in d.points),
        "JOINT/1, REVOLUTE, I=6001, J=6002",
        f"MOTION/1, JOINT=1, FUNCTION={d.slew.text()}",
    )
    text += damped_variables(d.cable, DAMPING)
    bucket, ropes = d.mass, ""
    for (side, start), places in zip(d.points, at_rest(d), strict=True):
        length = d.lengths(start)[0]
        node = d.cable.density * length / SECTIONS
        ropes += drum(side, HOUSE, start, d.payout(start), 1000.0)
        ropes += payout_variables(d.cable, SECTIONS, length, side) + tensions(side, SECTIONS)
        ropes += nodes(form, side, node, places[:-1], axes)
        bucket += node / 2
    text += "\n! The bucket.\n" + point(BUCKET, bucket, places[-1]) + ropes
    text += soil(d) if d.soil.moves else ""
    text += (
        "\n! Place of the bucket; tensions at boom and fairlead.\n"
        f"REQUEST/1, F2=DX({BUCKET})\\ F3=DY({BUCKET})\\ F4=DZ({BUCKET})\n"
        f"REQUEST/2, F2=TH1\\ F3=TD1\n"
    )
    if form == "ale" and axes == "XY":
        text += "".join(balance(side, SECTIONS) for side, _ in d.points)
        text += "! Energy of bucket and ropes, less the work of winches and soil.\nREQUEST/3"
        text += f", F2={number(d.mass)}*(VM({BUCKET})**2/2+{G:g}*DY({BUCKET}))+EH+ED\n"
        text += ",  -DIF(WH)-DIF(WD)" + ("-DIF(WS)" if d.soil.moves else "") + "\n"
    run = tail("HHT, ERROR=1.0E-6, HMAX=0.005", d.end, round(d.end / 0.05))
    return text + run


def soil(d: Dragline) -> str:
    """Resistance against the bucket's motion, and its work."""
    parts = "\\".join(f"\n, F{a}=-RS*V{a}({BUCKET})" for a in "XY")
    return (
        "\n! Soil resists while the bucket fills.\n"
        f"VARIABLE/RS, FUNCTION=({d.soil.text()})\n,  /SQRT(VM({BUCKET})**2+{d.creep:g}**2)\n"
        f"VFORCE/7000, I={BUCKET}, J_PART=1{parts}\n"
        f"DIFF/WS, IC=0, FUNCTION=-RS*VM({BUCKET})**2\n"
    )


def force(d: Dragline, form: str, t: float, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Acceleration of the bucket, (3,), and tensions in the first sections, (2,)."""
    f, mass, pulls = np.array([0.0, -d.mass * G, 0.0]), d.mass, []
    for _, start in d.points:
        rope = Straight(form, d.cable, d.lengths(start)[0], SECTIONS, DAMPING)
        pulls.append(rope.pull(d.leaves(start, t), d.payout(start)(t), y[:3], y[3:]))
        f, mass = f + pulls[-1].constant, mass + pulls[-1].mass
    f -= d.soil(t)[0] * y[3:] / np.sqrt(y[3:] @ y[3:] + d.creep**2)
    return f / mass, np.array([pull.first(f / mass) for pull in pulls])


def at_rest(d: Dragline) -> tuple[np.ndarray, np.ndarray]:
    """Nodes of both ropes at the start, (N, 2) each; the last is the bucket."""
    lengths = [d.lengths(start)[0] for _, start in d.points]
    weight = G * (d.mass + d.cable.density * sum(lengths) / SECTIONS / 2)

    def ropes(pull):
        """`pull` of the bucket on the hoist rope; the drag rope takes the rest of its weight."""
        pulls = (pull, np.array([0.0, -weight]) - pull)
        return [
            hanging(d.cable, length, SECTIONS, start, end)
            for (_, start), length, end in zip(d.points, lengths, pulls, strict=True)
        ]

    def gap(pull):
        hoist, drag = ropes(pull)
        return hoist[-1] - drag[-1]

    # Without sag and stretch the ropes point to the path's first place.
    pairs = zip(d.points, lengths, strict=True)
    along = [(np.array(d.path[0][1:]) - start) / r for (_, start), r in pairs]
    shares = np.linalg.solve(np.transpose(along), [0.0, -weight])
    return tuple(ropes(fsolve(gap, shares[0] * along[0], xtol=1e-12)))


def motion(d: Dragline, form: str, t: np.ndarray) -> np.ndarray:
    """Place of the bucket and both tensions: (5, nt)."""

    def rates(time, y):
        return [*y[3:], *force(d, form, time, y)[0]]

    def unbalanced(place):
        return force(d, form, 0.0, np.array([*place, 0.0, 0.0, 0.0, 0.0]))[0][:2]

    start = [*fsolve(unbalanced, at_rest(d)[0][-1], xtol=1e-11), 0.0, 0.0, 0.0, 0.0]
    run = solve_ivp(rates, (0, t[-1]), start, "DOP853", t_eval=t, rtol=1e-10, atol=1e-10)
    tension = [force(d, form, time, y)[1] for time, y in zip(t, run.y.T, strict=True)]
    return np.array([*run.y[:3], *np.transpose(tension)])


LARGE = Dragline(Cable(9.0e7, 6.0), 2.0e4, (49.0, 34.0), (2.0, 1.5), ())
SMALL = Dragline(Cable(5.0e7, 3.2), 8.0e3, (32.0, 22.0), (1.0, 2.0), ())
DIG = {
    "": replace(
        LARGE,
        path=((1, 36, -8), (10, 22, -5), (11, 22, -5), (20, 32, 12)),
        soil=law((2, 5, 7e4), (6, 9, -7e4)),
        band=5e-2,
    ),
    "-second": replace(
        SMALL,
        path=((0, 14, 5), (10, 25, -4), (11, 25, -4), (20, 14, -2)),
        soil=law((11, 14, 2e4), (16, 19, -2e4)),
        band=6e-2,
    ),
}
SLEW = {
    "": replace(
        LARGE, path=((0, 30, 5), (12, 36, 12)), slew=law((1, 18, np.radians(90))), turns=True
    ),
    "-second": replace(
        SMALL, path=((2, 24, -2), (14, 18, 4)), slew=law((0, 18, np.radians(-120))), turns=True
    ),
}


def mean(column: str, t: np.ndarray, tension: np.ndarray) -> str:
    """A measure: the tension over the second half of the run, without the waves in the rope."""
    late = t >= t[-1] / 2
    value = np.trapezoid(tension[late], t[late]) / np.ptp(t[late])
    return f"measure: mean REQUEST/2.{column} from {t[-1] / 2:g} = {value:.6g} tol rel 1e-3"


def dragline() -> Iterator[tuple[str, str, str]]:
    """Digging and throwing in the plane of the boom, in both forms; slewing to either side."""
    scenes = [("dig", DIG, form, "XY", 5e-3) for form in FORMS]
    scenes.append(("slew", SLEW, "ale", "XYZ", 1e-3))
    for scene, sets, form, axes, place in scenes:
        for name, d in sets.items():
            t = np.linspace(0, d.end, round(d.end / 0.1) + 1)
            columns = motion(d, form, t)
            lines = [
                "Bucket on two straight ropes with sag: README.md",
                "written by generate.py",
                f"tolerance: abs {place:g}",
                f"tolerance REQUEST/2.*: peak {d.band:g}",
                *(mean(f"F{k + 2}", t, pull) for k, pull in enumerate(columns[3:])),
            ]
            if form == "ale" and axes == "XY":
                heights = [y for _, _, y in d.path]
                work = d.mass * G * (max(heights) - min(heights))
                lines.append(f"measure: range REQUEST/3.F2 = 0 tol abs {number(1e-3 * work)}")
            header = [
                "time",
                *(f"REQUEST/1.F{k}" for k in (2, 3, 4)),
                "REQUEST/2.F2",
                "REQUEST/2.F3",
            ]
            yield (
                f"{scene}-{form}{name}",
                deck(d, form, axes),
                table(header, lines, [t, *columns], ERROR),
            )


CASES = {"drag-line": dragline}

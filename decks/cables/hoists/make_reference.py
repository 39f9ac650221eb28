"""Write the decks of this folder from their descriptions, and their references."""

import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent)]

from described_cases import write  # noqa: E402
from formulas import G  # noqa: E402
from spans import table  # noqa: E402

DOWN = np.array([0.0, -G])


def step5(t, t0, t1):
    """Value, first and second derivative of STEP5 from 0 to 1."""
    u, h = np.clip((t - t0) / (t1 - t0), 0, 1), t1 - t0
    return (u**3 * (10 - 15 * u + 6 * u * u), 30 * u**2 * (1 - u) ** 2 / h,
            60 * u * (1 - 3 * u + 2 * u * u) / h**2)  # fmt: skip


@dataclass(frozen=True)
class Rope:
    """An elastic straight rope from a drum at `top` to the place `hook` of the load."""

    ea: float
    rho: float
    length: float
    top: tuple
    hook: tuple
    damping_time: float = 0.0
    sections: int = 1
    pulls_only: bool = False

    def tension(self, long, grows, free, pays):
        """In the middle: EA (strain + tau strain rate)."""
        rate = (grows - pays * long / free) / free
        pull = self.ea * (long / free - 1 + self.damping_time * rate)
        return max(pull, 0.0) if self.pulls_only else pull


@dataclass(frozen=True)
class Lift:
    """A rigid body at (x, y), turned by f, on ropes whose free lengths l change alike.

    The particle m from the hook of a rope is at p + d (1 - m/l), d from its drum p to its hook:

        a = d" (1 - m/l) + 2 d' m l'/l^2 + d m (l"/l^2 - 2 l'^2/l^3)

    and the rope acts on its hook with -T d/|d| + integral of rho (g - a) (1 - m/l) dm, by the
    principle of virtual displacements.
    """

    mass: float
    inertia: float
    at: tuple
    ropes: tuple
    paid: float = 0.0
    starts_at_rest: bool = True

    def hooks(self, q, v):
        """Of every rope d, d', what x", y", f" give of d", and the rest of d"."""
        c, s = np.cos(q[2]), np.sin(q[2])
        for rope in self.ropes:
            own = np.subtract(rope.hook, self.at)
            r = np.array([c * own[0] - s * own[1], s * own[0] + c * own[1]])
            aside = np.array([-r[1], r[0]])
            d = q[:2] + r - rope.top
            yield (
                rope,
                d,
                v[:2] + v[2] * aside,
                np.array([[1, 0, aside[0]], [0, 1, aside[1]]]),
                (-r * v[2] ** 2),
            )

    def solved(self, t, q, v):
        """Accelerations, and the force of every rope on its hook."""
        s, s1, s2 = (self.paid * x for x in step5(t, 0, 2))
        matrix = np.diag([self.mass, self.mass, self.inertia or 1.0])
        loads, parts = np.array([0, -self.mass * G, 0.0]), []
        for rope, d, d1, jac, rest in self.hooks(q, v):
            free = rope.length + s
            long = np.hypot(*d)
            pull = rope.tension(long, d @ d1 / long, free, s1)
            moved = rope.rho * free / 3
            flow = 2 * d1 * s1 / free**2 + d * (s2 / free**2 - 2 * s1**2 / free**3)
            force = -pull * d / long + rope.rho * (DOWN * free / 2 - flow * free**2 / 6)
            matrix = matrix + moved * jac.T @ jac
            loads = loads + jac.T @ (force - moved * rest)
            parts.append((force - moved * rest, moved * jac, d / long))
        if not self.inertia:
            matrix[2], loads[2] = [0, 0, 1], 0.0
        found = np.linalg.solve(matrix, loads)
        return found, [-(force - moved @ found) @ e for force, moved, e in parts]

    def rest(self):
        """Where it hangs."""
        found = root(lambda q: self.solved(0.0, q, np.zeros(3))[0], [*self.at, 0.0], tol=1e-13)
        return found.x

    def motion(self, end, rows):
        """Places, and tensions at the hooks."""
        t = np.linspace(0, end, rows + 1)
        start = self.rest() if self.starts_at_rest else np.array([*self.at, 0.0])
        y = solve_ivp(lambda t, y: [*y[3:], *self.solved(t, y[:3], y[3:])[0]], (0, end),
                      [*start, 0, 0, 0], "DOP853", t, rtol=1e-10, atol=1e-11,
                      max_step=2e-3).y  # fmt: skip
        pulls = [self.solved(x, q[:3], q[3:])[1] for x, q in zip(t, y.T, strict=True)]
        return t, y, np.array(pulls).T


def lifted(lift, end, rows, place, bounds):
    """Table of the places and of the tensions at the hooks."""
    t, y, pulls = lift.motion(end, rows)
    columns = {f"{place}.x": y[0], f"{place}.y": y[1]}
    if lift.inertia:
        columns["REQUEST/50.F4"] = y[2]
    columns |= {f"REQUEST/{k}.F3": pull for k, pull in enumerate(pulls, 1)}
    way, pull = bounds
    lines = [
        "Place and tilt of the load, tensions at its hooks: README.md",
        "written by make_reference.py",
        f"tolerance: abs {way:g}",
        f"tolerance REQUEST/*.F3: peak {pull:g}",
    ]
    return table(["time", *columns], lines, [t, *columns.values()], 1e-9)


def parted(mass, stiffness, heights, breaking, paid, rho, times):
    """A point on two ropes that just reach it; the first one parts at its root."""
    soft = np.divide(heights, stiffness)
    shares = mass * G / soft / sum(1 / soft)
    lengths = np.divide(heights, 1 + shares / stiffness)
    ropes = [
        Rope(ea, rho, length, (0, high - 10), (0, -10), damping_time=tau, pulls_only=k > 0)
        for k, (ea, length, high, tau) in enumerate(
            zip(stiffness, lengths, heights, times, strict=True)
        )
    ]
    whole = Lift(mass, 0, (0, -10), tuple(ropes), paid)
    left = replace(whole, ropes=(ropes[1],))
    t = np.linspace(0, 3, 121)

    def pulls(lift, t, y):
        return lift.solved(t, y[:3], y[3:])[1]

    def parts(t, y):
        return pulls(whole, t, y)[0] - breaking

    parts.terminal = True
    known = {
        "method": "DOP853",
        "rtol": 1e-10,
        "atol": 1e-11,
        "max_step": 2e-3,
        "dense_output": True,
    }
    first, then = (
        lambda t, y, lift=lift: [*y[3:], *lift.solved(t, y[:3], y[3:])[0]] for lift in (whole, left)
    )
    one = solve_ivp(first, (0, 3), [0, -10, 0, 0, 0, 0], events=parts, **known)
    at = one.t_events[0][0]
    two = solve_ivp(then, (at, 3), one.y_events[0][0], **known)
    y = np.array([(one if x < at else two).sol(x) for x in t])
    forces = [pulls(whole, x, s) if x < at else [0.0, *pulls(left, x, s)]
              for x, s in zip(t, y, strict=True)]  # fmt: skip
    columns = {"POINT_MASS/50.y": y[:, 1]}
    columns |= {f"REQUEST/{k}.F3": pull for k, pull in enumerate(np.transpose(forces), 1)}
    lines = [
        "Place of the load, tensions at its hooks: README.md",
        "written by make_reference.py",
        "tolerance: abs 2e-4",
        "tolerance REQUEST/*.F3: peak 1e-2",
    ]
    return table(["time", *columns], lines, [t, *columns.values()], 1e-9)


def turned(place, at, q):
    """A place of a body that was at `at`."""
    own, (c, s) = np.subtract(place, at), (np.cos(q[2]), np.sin(q[2]))
    return np.array([q[0] + c * own[0] - s * own[1], q[1] + s * own[0] + c * own[1]])


def measured(title, values):
    """Numbers at the start and at the end of a run at rest."""
    lines = [f"{title}: README.md", "written by make_reference.py"]
    for name, (value, bound) in values.items():
        for what in ("value", "last"):
            at = " at 0" if what == "value" else ""
            lines.append(f"measure: {what} {name}{at} = {value:.10g} tol {bound}")
    return "".join(f"# {line}\n" for line in lines)


def below_sheave(mass, at, ea, rho, hooks, radius):
    """Place, tilt and tensions at its hooks of a load whose one rope goes over a sheave.

    The sheave turns by s/R until both sides pull alike at the rim; half of a side is on its hook.
    """
    tops = [(-radius, 0.0), (radius, 0.0)]
    hung = mass * G / 2
    # As drawn each side has half of the weight at its hook, and its own weight above.
    drawn = [np.hypot(*np.subtract(h, p)) for h, p in zip(hooks, tops, strict=True)]
    free = [root(lambda f, x=x: x - f * (1 + (hung + rho * f * G / 2) / ea), x).x[0] for x in drawn]

    def sides(z):
        for hook, p, f, sign in zip(hooks, tops, free, (1, -1), strict=True):
            place, own = turned(hook, at, z[:3]), f + sign * z[3]
            d = place - p
            yield place, d / np.hypot(*d), ea * (np.hypot(*d) / own - 1), rho * own / 2

    def balance(z):
        force, turn, rim = np.array([0, -mass * G]), 0.0, []
        for place, e, pull, half in sides(z):
            up = -pull * e + half * DOWN
            force = force + up
            r = place - z[:2]
            turn += r[0] * up[1] - r[1] * up[0]
            rim.append(pull + half * G)
        return [*force / hung, turn / hung, (rim[1] - rim[0]) / hung]

    found = root(balance, [*at, 0.0, 0.0], tol=1e-14).x
    return found, [pull + half * DOWN @ -e for _, e, pull, half in sides(found)]


def hangs_from_beam(beam, box, ropes):
    """Two bodies: a beam on a hinge, and a box on two ropes below it: forces in balance."""
    (m1, at1), (m2, at2) = beam, box

    def ends(z):
        q1 = np.array([*turned(at1, (0, 0), [0, 0, z[0]]), z[0]])
        for rope in ropes:
            yield rope, turned(rope.top, at1, q1), turned(rope.hook, at2, z[1:])

    def balance(z):
        arm1 = turned(at1, (0, 0), [0, 0, z[0]])
        force, turn1, turn2 = np.array([0, -m2 * G]), -m1 * G * arm1[0], 0.0
        for rope, a, b in ends(z):
            d, half = b - a, rope.rho * rope.length / 2 * G
            pull = rope.ea * (np.hypot(*d) / rope.length - 1) * d / np.hypot(*d)
            up, down = -pull - [0, half], pull - [0, half]
            force = force + up
            r = b - z[1:3]
            turn1 += a[0] * down[1] - a[1] * down[0]
            turn2 += r[0] * up[1] - r[1] * up[0]
        return [turn1 / 100, *force / 100, turn2 / 100]

    found = root(balance, [0.0, *at2, 0.0], tol=1e-13).x
    pulls = []
    for rope, a, b in ends(found):
        d = b - a
        e = d / np.hypot(*d)
        pull = rope.ea * (np.hypot(*d) / rope.length - 1)
        pulls.append(pull + rope.rho * rope.length / 2 * DOWN @ -e)
    return found, pulls


def equaliser():
    place, pulls = below_sheave(250, (0.1, -8.4), 2e6, 0.01, ((-0.5, -8), (0.5, -8)), 0.5)
    values = {
        "PART/40.x": (place[0], "abs 1e-7"), "PART/40.y": (place[1], "abs 1e-7"),
        "REQUEST/40.F4": (place[2], "abs 1e-7"),
    } | {f"REQUEST/{k}.F3": (pull, "rel 1e-6") for k, pull in enumerate(pulls, 1)}  # fmt: skip
    return measured("A load below an equaliser sheave", values)


def equalising_beam():
    ropes = (
        Rope(3e6, 0.02, 6, (-0.6, -0.1), (-0.6, -6.1)),
        Rope(4e5, 0.01, 6.02, (0.9, -0.1), (0.9, -6.1)),
    )
    place, pulls = hangs_from_beam((20, (0.05, -0.1)), (350, (0.1, -6.8)), ropes)
    values = {
        "REQUEST/50.F4": (place[0], "abs 1e-7"), "PART/60.x": (place[1], "abs 1e-7"),
        "PART/60.y": (place[2], "abs 1e-7"), "REQUEST/60.F4": (place[3], "abs 1e-7"),
    } | {f"REQUEST/{k}.F3": (pull, "rel 1e-6") for k, pull in enumerate(pulls, 1)}  # fmt: skip
    return measured("A load below an equalising beam", values)


FALLS = Lift(500, 0, (0, -10), (
    Rope(4e6, 0.4, 10, (0, 0), (0, -10), 6.32e-4, 2),
    Rope(1e6, 0.1, 12, (0, 2), (0, -10), 7.59e-4, 2),
), -1.5)  # fmt: skip
LOWERED = Lift(3000, 0, (0, -10), (
    Rope(9e6, 1.2, 9.98, (0, 0), (0, -10), 7.3e-4, 3),
    Rope(2e7, 2, 12.01, (0, 2), (0, -10), 7.59e-4, 3),
), 4.0)  # fmt: skip
BEAM = Lift(600, 700, (0.5, -10.3), (
    Rope(8e5, 0.02, 10, (-2, 0), (-2, -10), 6.32e-4),
    Rope(2e5, 0.02, 10, (2, 0), (2, -10), 1.26e-3),
), -1.5)  # fmt: skip
SHORT = Lift(90, 30, (-0.2, -4.5), (
    Rope(6e4, 0.01, 4.1, (-0.7, 0), (-0.7, -4), 9.8e-4),
    Rope(3e5, 0.03, 4, (0.7, 0), (0.7, -4), 7.59e-4),
), 2.5)  # fmt: skip
DROPPED = Lift(400, 0, (0, -10), (
    Rope(5e5, 0.005, 10, (0, 0), (0, -10), pulls_only=True),
    Rope(2e6, 0.005, 10.1, (0, 0), (0, -10), pulls_only=True),
), starts_at_rest=False)  # fmt: skip
SNATCHED = Lift(60, 0, (0, -6), (
    Rope(2e4, 0.002, 6, (0, 0), (0, -6), pulls_only=True),
    Rope(8e4, 0.002, 6.25, (0, 0), (0, -6), pulls_only=True),
), starts_at_rest=False)  # fmt: skip
CASES = {
    "falls": lambda: lifted(FALLS, 3, 60, "POINT_MASS/50", (5e-5, 2e-3)),
    "falls-lowered": lambda: lifted(LOWERED, 3, 60, "POINT_MASS/50", (5e-5, 4e-3)),
    "beam": lambda: lifted(BEAM, 3, 60, "PART/50", (1e-4, 1e-3)),
    "beam-lowered": lambda: lifted(SHORT, 3, 60, "PART/50", (1e-4, 1e-3)),
    "late": lambda: lifted(DROPPED, 2, 200, "POINT_MASS/50", (1e-4, 1e-2)),
    "late-soft": lambda: lifted(SNATCHED, 2, 200, "POINT_MASS/50", (2e-4, 1e-2)),
    "parting": lambda: parted(500, (4e6, 1e6), (10, 12), 4700, -1.5, 0.002, (8.94e-5, 2.15e-4)),
    "parting-lowered": lambda: parted(
        220, (6e5, 2e6), (10, 12), 700, 3.0, 0.001, (1.63e-4, 1.07e-4)
    ),
    "equaliser": equaliser,
    "beam-on-beam": equalising_beam,
}


if __name__ == "__main__":
    write(HERE, CASES)

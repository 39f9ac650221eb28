"""Write the decks of this folder from their descriptions, and their references."""

import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent)]

from described_cases import write  # noqa: E402
from formulas import G  # noqa: E402
from spans import table  # noqa: E402

#: Displacement of a rim at which its brake holds, time in which it lets go, speed it smooths over.
GRIP, LETS_GO, STICKS = 1e-4, 0.01, 1e-8


def step(t, t0, t1):
    d = np.clip((t - t0) / (t1 - t0), 0, 1)
    return d * d * (3 - 2 * d)


@dataclass(frozen=True)
class Hoist:
    """A weight on a rope without stretch from a drum or reel; payout s, speed v = r w.

        M (v' - g) = -T,     J w' = r T - Q - B,     v' = r w' + r' w,    r' = -h w/(2 pi)

    The pack takes its angular momentum along as it leaves: no term J' w.
    """

    mass: float
    radius: float
    inertia: float
    curve: tuple
    brake: float
    limits: tuple
    end: float
    rows: int
    gain: float = 0.0
    brakes: bool = True
    thickness: float = 0.0
    core: float = 0.0
    rho: float = 0.0

    def asked(self, t, v):
        """Torque that is asked of the motor."""
        if self.gain:
            return self.gain * (v + 0.8 * step(t, 0, 1))
        return 500 + 150 * v

    def applied(self, t, stopped):
        """Share of the brake."""
        own = 1 - step(t, 0.1, 0.2) if self.gain else step(t, 4, 4.2) * self.brakes
        return 1 - (1 - own) * (1 - stopped)

    def drum(self, s):
        """Radius and inertia."""
        r = np.sqrt(self.radius**2 - self.thickness * s / np.pi)
        pack = 0.0
        if self.thickness:
            pack = self.rho * np.pi / 2 / self.thickness * (r**4 - self.core**4)
        return r, self.inertia + pack

    def torques(self, t, y, stopped):
        """Of the motor and of the brake."""
        s, v, held = y
        w = abs(v) / self.drum(s)[0]
        most = max(np.interp(w, *zip(*self.curve, strict=True)), 0.0)
        motor = (1 - stopped) * np.clip(self.asked(t, v), -most, most)
        held = held + 5e-3 * v * np.exp(-((v / 1e-3) ** 2))  # what damps it at rest
        return motor, self.brake * self.applied(t, stopped) * held / GRIP

    def rates(self, t, y, stopped):
        """Of s, v and the displacement of the brake."""
        s, v, held = y
        (r, j), (motor, brake) = self.drum(s), self.torques(t, y, stopped)
        w = v / r
        shrinks = -self.thickness * w / (2 * np.pi)
        turn = (r * self.mass * (G - shrinks * w) - motor - brake) / (j + self.mass * r**2)
        on = self.applied(t, stopped)
        holds = on * v * (1 - np.tanh(v / STICKS) * held / GRIP) - (1 - on) * held / LETS_GO
        return [v, r * turn + shrinks * w, holds]

    def slopes(self, t, y, stopped):
        """Of the rates, by differences of suitable size."""
        y = np.asarray(y)
        return np.array(
            [np.subtract(self.rates(t, y + d, stopped), self.rates(t, y - d, stopped)) / 2 / d.max()
             for d in np.diag([1e-6, 1e-10, 1e-8])]
        ).T  # fmt: skip

    def motion(self):
        """States at the output times, and when the limit switch acts."""
        times = np.linspace(0, self.end, self.rows + 1)

        def reaches(t, y, stopped):
            return (y[0] - self.limits[0]) * (self.limits[1] - y[0])

        reaches.terminal = True
        known = {
            "method": "Radau",
            "jac": self.slopes,
            "rtol": 1e-10,
            "atol": 1e-13,
            "max_step": 0.05,
            "first_step": 1e-8,
        }
        first = solve_ivp(self.rates, (0, self.end), [0, 0, 0], dense_output=True,
                          events=reaches, args=(0.0,), **known)  # fmt: skip
        if not first.t_events[0].size:
            return times, first.sol(times).T, np.inf
        stop = first.t_events[0][0]
        then = solve_ivp(self.rates, (stop, self.end), first.y_events[0][0], dense_output=True,
                         args=(1.0,), **known)  # fmt: skip
        states = [(first if t < stop else then).sol(t) for t in times]
        return times, np.array(states), stop


def hoisted(hoist, noise):
    """Payout, speed, torques of motor and brake, tension."""
    t, y, stop = hoist.motion()
    stopped = (t >= stop).astype(float)
    torques = np.array([hoist.torques(*row) for row in zip(t, y, stopped, strict=True)])
    pull = [hoist.mass * (G - hoist.rates(*row)[1]) for row in zip(t, y, stopped, strict=True)]
    # Where the brake swings its torque follows the displacement, 1e-4 m for all of it.
    columns = {
        "VARIABLE/S_10": y[:, 0], "VARIABLE/SD_10": y[:, 1], "VARIABLE/engine_10": torques[:, 0],
        "VARIABLE/brake_10": torques[:, 1], "GCON/1.f": -np.array(pull),
    }  # fmt: skip
    if abs(hoist.limits[0]) < 99:
        columns["VARIABLE/stopped_10"] = stopped
    way, speed, torque = noise
    lines = [
        "Payout, its speed, torques of motor and brake, tension: README.md",
        "written by make_reference.py",
        f"tolerance VARIABLE/*: abs {torque:g}",
        f"tolerance VARIABLE/S_10: abs {way:g}",
        f"tolerance VARIABLE/SD_10: abs {speed:g}",
        f"tolerance GCON/1.f: abs {torque / hoist.radius:g}",
        "tolerance VARIABLE/stopped_10: abs 1e-12",
    ]
    return table(["time", *columns], lines, [t, *columns.values()], 1e-8)


def landed(mass, ea, rho, height, depth, floor, sections, paid, back):
    """Numbers of a load that lands, lies, and hangs again: laws of momentum at rest."""
    strain = (mass + rho * height / 2) * G / ea
    free = height / (1 + strain)
    lying, hanging = free + paid, free + paid - back
    half = rho * lying / sections / 2
    push = (mass + half) * G
    pull = (rho * lying - half) * G
    load = (mass + rho * hanging) * G
    touches = depth / (1 + strain) / paid  # share of the payout at which it touches
    d = brentq(lambda d: d**3 * (10 - 15 * d + 6 * d * d) - touches, 0, 1)
    floor_at = -height - depth
    lines = [
        "A load that lands, lies on the floor, and is lifted: README.md",
        "written by make_reference.py",
        f"measure: value VFORCE/25.fz at 9.5 = {push:.10g} tol rel 1e-5",
        f"measure: value REQUEST/1.F2 at 9.5 = {pull:.10g} tol rel 5e-3",
        f"measure: value POINT_MASS/20.y at 9.5 = {floor_at - push / floor:.10g} tol abs 1e-6",
        f"measure: arrival POINT_MASS/20.y through {floor_at:.10g} = {8 * d:.6g} tol abs 0.02",
        f"measure: mean REQUEST/1.F2 from 18.5 to 20 = {load:.10g} tol rel 1e-2",
    ]
    return "".join(f"# {line}\n" for line in lines)


def reeved(mass, wheel, drum, torque, radius=0.25):
    """A block on four falls, drum to anchor: constant accelerations.

    When the drum pays out s, the block of two sheaves sinks by s/4; over the first sheave go 3/4 of
    s, over the crown sheave 2/4, over the second 1/4.
    """
    m = wheel / radius**2
    moved = mass + 2 * m
    a = (moved * G / 4 - torque / radius) / (drum / radius**2 + moved / 16 + m * 14 / 16)
    pulls = [torque / radius + drum / radius**2 * a]
    for share in (3, 2, 1):
        pulls.append(pulls[-1] + m * share / 4 * a)
    t = np.linspace(0, 2, 41)
    way = a * t**2 / 2
    columns = {"REQUEST/10.F2": way, "REQUEST/10.F3": a * t, "PART/20.y": -2 - way / 4,
               "PART/40.y": -2 - way / 4}  # fmt: skip
    columns |= {f"GCON/{p}.f": np.full_like(t, -pull) for p, pull in enumerate(pulls, 1)}
    lines = [
        "Payout, its speed, places of the sheaves, tensions of the falls: README.md",
        "written by make_reference.py",
        "tolerance: abs 1e-7",
        "tolerance GCON/*: rel 1e-6",
    ]
    return table(["time", *columns], lines, [t, *columns.values()], 1e-9)


def on_a_block(rope, block, load, pull, rows=48):
    """A block that moves by h on its slide; one end of the rope is held below, the other one has
    the load, which moves twice as far. With the rope l0 - h on its side, by Lagrange's equations

        (M + J/R^2 + 4 (m + rho (l0 - h))) h" = F - M g - 2 (m + rho (l0 - h)) g + 2 rho h'^2
    """
    (rho, held), (mass, inertia, radius), (m, long) = rope, block, load
    moved, turned = mass + inertia / radius**2, inertia / radius**2

    def gain(t, h, v):
        carried = m + rho * (long - h)
        force = pull(t, v) - moved * G - 2 * carried * G + 2 * rho * v**2
        return force / (moved + turned + 4 * carried)

    t = np.linspace(0, 1.2, rows + 1)
    h, v = solve_ivp(lambda t, y: [y[1], gain(t, *y)], (0, 1.2), [0, 0], "DOP853", t,
                     rtol=1e-11, atol=1e-12).y  # fmt: skip
    a = gain(t, h, v)
    right = (m + rho * (long - h)) * (G + 2 * a)
    left = right + turned * a
    columns = {
        "PART/22.y": h, "REQUEST/1.F2": left, "REQUEST/1.F3": left - rho * G * (held + h),
        "REQUEST/2.F2": right, "REQUEST/2.F3": m * (G + 2 * a),
    }  # fmt: skip
    lines = ["A block on heavy rope: README.md", "written by make_reference.py"]
    for name, values in columns.items():
        bound = "abs 3e-5" if "PART" in name else "rel 1e-4"
        # Before, the rope rings as the forces set in.
        for k in range(rows // 4, rows + 1, rows // 4):
            lines.append(f"measure: value {name} at {t[k]:.10g} = {values[k]:.10g} tol {bound}")
    return "".join(f"# {line}\n" for line in lines)


MOTOR = Hoist(400, 0.3, 40, ((0, 1500), (2, 1500), (6, 0)), 3000, (-4, 1), 10, 200, gain=2e4)
REEL = Hoist(150, 0.5, 12, ((0, 900), (3, 700), (8, 300)), 1800, (-99, 99), 8, 160,
             thickness=0.01, core=0.2, rho=0.6)  # fmt: skip
GROWS = replace(MOTOR, thickness=0.012, core=0.12, rho=1.5)
LOWERS = replace(REEL, limits=(-0.5, 2.4), brakes=False)
BLOCKS = {
    "block-lifts": lambda: on_a_block(
        (6, 3), (60, 6, 0.4), (40, 9), lambda t, v: 3600 + 400 * np.sin(4 * t)
    ),
    "block-sinks": lambda: on_a_block(
        (2.5, 6), (150, 4, 0.25), (90, 5), lambda t, v: 4000 - 500 * v
    ),
}
CASES = BLOCKS | {
    "reeved": lambda: reeved(180, 0.5, 3, 100),
    "reeved-heavy": lambda: reeved(1100, 2, 9, 850),
    "landing": lambda: landed(600, 4e6, 0.8, 12, 1, 1e6, 4, 1.2, 1.0),
    "landing-heavy": lambda: landed(2000, 2e7, 2.5, 25, 2, 5e6, 6, 2.3, 1.9),
    "hoist": lambda: hoisted(MOTOR, (2e-6, 2e-6, 0.01)),
    "hoist-reel": lambda: hoisted(REEL, (2e-6, 2e-6, 0.01)),
    "reel-hoist": lambda: hoisted(GROWS, (2e-6, 2e-6, 0.01)),
    "reel-lowers": lambda: hoisted(LOWERS, (2e-6, 2e-6, 0.01)),
}


if __name__ == "__main__":
    write(HERE, CASES)

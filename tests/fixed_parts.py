"""Random machines with parts that JOINT/FIXED holds together, as decks."""

from __future__ import annotations

import re

import numpy as np
from frame_constraints import any_rotation, euler_313

Array = np.ndarray
HEAD = """Parts held together, seed {seed}
UNITS/{units}
ACCGRAV/IGRAV={gx!r}, JGRAV={gy!r}
PART/1, GROUND
MARKER/1, PART=1
"""
UNITS = (("SYSTEM=MKS", 1.0), ("FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND", 1e3))


class Machine:
    """A chain of lumps on ball joints and hinges; each lump is one to four parts that are FIXED to
    each other, in any order and with I on either.
    """

    def __init__(self, seed: int) -> None:
        self.rng = rng = np.random.default_rng(seed)
        self.units, self.length = UNITS[seed % 2]
        self.poses: dict[int, tuple[Array, Array]] = {1: (np.zeros(3), np.eye(3))}
        self.marker, self.joint, self.fixed = 100, 0, 0
        gravity = {"gx": float(rng.normal()) * self.length, "gy": -9.81 * self.length}
        self.lines = [HEAD.format(seed=seed, units=self.units, **gravity)]
        before, self.holds_all = 1, True
        for lump in range(rng.integers(1, 4)):
            parts = [self.part() for _ in range(rng.integers(1, 5))]
            for k, part in enumerate(parts[1:], 1):
                self.fix(part, parts[rng.integers(0, k)])
            held = lump == 0 and rng.random() < 0.3
            if held:
                self.fix(parts[0], 1)
            else:
                self.hang(parts[rng.integers(len(parts))], before)
            before = parts[rng.integers(len(parts))]
            self.holds_all &= lump == 0 and held
        for _ in range(rng.integers(1, 5)):
            self.force()

    def text(self, end: float = 0.2, steps: int = 4) -> str:
        """The deck."""
        return "".join(self.lines) + f"SIMULATE/DYNAMIC, END={end}, STEPS={steps}\nEND\n"

    def part(self) -> int:
        number = len(self.poses) + 1
        rng, L = self.rng, self.length
        pose = rng.uniform(-1, 1, 3) * L, any_rotation(rng)
        self.poses[number] = pose
        mass = rng.uniform(0.5, 5)
        moments = mass * L * L * rng.uniform(0.1, 0.15, 3)
        products = mass * L * L * rng.uniform(-0.01, 0.01, 3)
        self.lines.append(
            f"PART/{number}, MASS={float(mass)!r}, CM={number}, IP={_list([*moments, *products])}, "
            f"QG={_list(pose[0])}, REULER={_list(euler_313(pose[1]))}\n"
        )
        turned = _list(euler_313(any_rotation(rng)))
        centre = _list(rng.uniform(-0.2, 0.2, 3) * L)
        self.lines.append(f"MARKER/{number}, PART={number}, QP={centre}, REULER={turned}\n")
        return number

    def at(self, part: int, place: Array, axes: Array) -> int:
        """A marker of a part at a place in ground."""
        self.marker += 1
        origin, turned = self.poses[part]
        p, R = turned.T @ (place - origin), turned.T @ axes
        self.lines.append(
            f"MARKER/{self.marker}, PART={part}, QP={_list(p)}, REULER={_list(euler_313(R))}\n"
        )
        return self.marker

    def pair(self, a: int, b: int) -> tuple[int, int]:
        place, axes = self.rng.uniform(-1, 1, 3) * self.length, any_rotation(self.rng)
        found = self.at(a, place, axes), self.at(b, place, axes)
        return found if self.rng.random() < 0.5 else found[::-1]

    def join(self, kind: str, a: int, b: int) -> None:
        i, j = self.pair(a, b)
        self.joint += 1
        self.lines.append(f"JOINT/{self.joint}, {kind}, I={i}, J={j}\n")

    def fix(self, a: int, b: int) -> None:
        self.fixed += 1
        self.join("FIXED", a, b)

    def watched(self) -> str:
        """The deck, with every reaction of a FIXED joint in a REQUEST: by its own function on I or
        J, as net force, or by a VARIABLE, along the axes of any marker.
        """
        rng = np.random.default_rng(self.marker)
        found = re.findall(r"JOINT/(\d+), FIXED, I=(\d+), J=(\d+)", "".join(self.lines))
        markers = re.findall(r"MARKER/(\d+)", "".join(self.lines))
        lines = []
        for joint, i, j in found:
            rm, flag, of = rng.choice(markers), rng.integers(2), ((i, j), (j, i))[rng.integers(2)]
            comps = (2, 3, 4, 6, 7, 8)
            calls = [f"F{c}=JOINT({joint},{flag},{c},{rm})" for c in comps]
            lines.append((
                f"REQUEST/j{joint}, " + "\\ ".join([*calls, f"F5=JOINT({joint},{flag},5,0)"]),
                f"REQUEST/j{joint}, FORCE, I={of[0]}, J={of[1]}, RM={rm}",
                f"VARIABLE/j{joint}, FUNCTION=JOINT({joint},{flag},7,{rm})+FX({i},0,{rm})\n"
                f"REQUEST/j{joint}, F1=VARVAL(j{joint})",
            )[rng.integers(3)])  # fmt: skip
        return self.text(0.05).replace("SIMULATE", "\n".join(lines) + "\nSIMULATE")

    def hang(self, a: int, b: int) -> None:
        kinds = ("SPHERICAL", "REVOLUTE", "HOOKE", "CYLINDRICAL", "TRANSLATIONAL")
        self.join(kinds[self.rng.integers(len(kinds))], a, b)

    def force(self) -> None:
        rng, L = self.rng, self.length
        a, b = rng.permutation([part for part in self.poses if part > 1] + [1])[:2]
        if a == 1:
            a, b = b, a
        i, j = (self.at(p, rng.uniform(-1, 1, 3) * L, any_rotation(rng)) for p in (a, b))
        number = self.marker
        distance = f"DM({i},{j})"
        turn = f"{5 * L!r}"
        self.lines.append((
            f"SPRINGDAMPER/{number}, I={i}, J={j}, K={50 / L!r}, C={1 / L!r}, LENGTH={0.3 * L!r}\n",
            f"SFORCE/{number}, I={i}, J={j}, FUNCTION=20*SIN(3*TIME)-{9 / L!r}*{distance}\n",
            f"SFORCE/{number}, ROTATIONAL, I={i}, J={j}, FUNCTION={turn}*COS(TIME)\n",
            f"BUSHING/{number}, I={i}, J={j}, K={_list([10 / L] * 3)}, KT={_list([L] * 3)}, "
            f"C={_list([1 / L] * 3)}\n",
            f"VFORCE/{number}, I={i}, J_PART=1, FX=5\\ FZ=-{1 / L!r}*VZ({i})\n",
            f"GFORCE/{number}, I={i}, J_PART=1, FY=3*TIME\\ TX={turn}\n",
        )[rng.integers(6)])  # fmt: skip
        self.lines.append(f"REQUEST/{number}, ACCELERATION, I={i}, J={j}, RM={j}\n")


def _list(values: Array | list[float] | tuple[float, ...]) -> str:
    return ",".join(repr(float(value)) for value in values)

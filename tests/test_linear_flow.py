"""Eigenvalues about steady motions against the program's own simulation of small disturbances.

Random mechanisms on a turntable: two parts of full inertia on joints with oblique axes, held by
bushings, and a symmetric rotor that spins on the last of them; the table is driven by its angle, by
its speed, or by a regulator with an integral.  Dampers bring each to the motion that is steady for
whoever turns with the table; in metres and in centimetres.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from small_motions import Flow, distance

import adamslite
from adamslite.analyses.linearization.linearization import linear
from adamslite.analyses.session.session import Session
from adamslite.elements.simulate import Simulate
from adamslite.results.outcomes import Outcome

JOINTS = ("REVOLUTE", "UNIVERSAL", "SPHERICAL", "CYLINDRICAL")
DRIVES = {
    "angle": "MOTION/1, JOINT=1, FUNCTION={w}*TIME",
    "speed": "MOTION/1, JOINT=1, VELOCITY, FUNCTION={w}",
    "regulator": (
        "DIFF/1, IC=0, FUNCTION={w}-WZ(20,1)\n"
        "SFORCE/1, ROTATIONAL, I=20, J=1, FUNCTION={c}*({w}-WZ(20,1))+2*{c}*DIF(1)"
    ),
}
QUARTER = Rotation.from_euler("x", 90, degrees=True)
SETTLED = 16.0


def row(values) -> str:
    return ",".join(f"{value:.6f}" for value in values)


class Mechanism:
    """A random deck; forces are newtons whatever the unit of length."""

    def __init__(self, seed: int, unit: str, turning: bool = True) -> None:
        self.rng = np.random.default_rng(seed)
        self.drive, self.long = list(DRIVES)[seed % 3], {"METER": 1.0, "CENTIMETER": 1e2}[unit]
        w, spin = (x * self.rng.choice([-1, 1]) for x in self.rng.uniform([1, 5], [3, 20]))
        w *= turning
        self.lines = [
            f"mechanism {seed}",
            f"UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={unit}, TIME=SECOND",
            f"ACCGRAV/KGRAV={-9.81 * self.long}", "PART/1, GROUND", "MARKER/1, PART=1",
            f"PART/2, MASS=5, CM=20, IP={row(self.long**2 * np.array([3, 2, 4]))}, WZ={w:.3f}",
            "MARKER/20, PART=2", "JOINT/1, REVOLUTE, I=20, J=1",
            DRIVES[self.drive].format(w=f"{w:.3f}", c=20 * self.long),
        ]  # fmt: skip
        place = np.zeros(3)
        for part in (3, 4):
            place = place + self._hang(part, place)
        place = place + self._at(5, 4, 0.15)
        self.lines += [
            f"PART/5, MASS=0.5, CM=50, IP={row(self.long**2 * np.array([0.02, 0.02, 0.03]))}, "
            f"QG={row(place)}, REULER={self.turned}",
            "MARKER/50, PART=5", "JOINT/5, REVOLUTE, I=50, J=55",
            f"MOTION/5, JOINT=5, VELOCITY, FUNCTION={spin:.3f}", "END",
        ]  # fmt: skip
        self.text = "\n".join(self.lines) + "\n"

    def _euler(self, rotation: Rotation) -> str:
        return ",".join(f"{x:.9f}D" for x in rotation.as_euler("ZXZ", degrees=True))

    def _at(self, part: int, parent: int, reach: float) -> np.ndarray:
        """A marker of random axes on the parent for the next part; its place."""
        place = self.long * self.rng.uniform(-reach, reach, 3)
        self.axes = Rotation.random(rng=self.rng)
        self.turned = self._euler(self.axes)
        self.lines.append(f"MARKER/{part}5, PART={parent}, QP={row(place)}, REULER={self.turned}")
        return place

    def _hang(self, part: int, origin: np.ndarray) -> np.ndarray:
        place = self._at(part, part - 1, 0.25)
        kind = str(self.rng.choice(JOINTS))
        across = self.axes * QUARTER if kind == "UNIVERSAL" else self.axes
        half = self.rng.uniform(-0.2, 0.2, (3, 3))
        tensor = self.long**2 * (half @ half.T + 0.02 * np.eye(3))
        sides = (*np.diag(tensor), tensor[0, 1], tensor[0, 2], tensor[1, 2])
        stiff, damped = (f"{x / self.long:.6g}" for x in (400, 30))
        turning, braked = (f"{x * self.long:.6g}" for x in (10, 1))
        self.lines += [
            f"PART/{part}, MASS=2, CM={part}0, IP={row(sides)}, QG={row(origin + place)}",
            f"MARKER/{part}0, PART={part}, QP={row(self.long * self.rng.uniform(-0.1, 0.1, 3))}",
            f"MARKER/{part}1, PART={part}, REULER={self._euler(across)}",
            f"MARKER/{part}2, PART={part}, REULER={self.turned}",
            f"JOINT/{part}, {kind}, I={part}1, J={part}5",
            f"BUSHING/{part}, I={part}2, J={part}5, K={','.join(3 * [stiff])}, "
            f"C={','.join(3 * [damped])}, KT={','.join(3 * [turning])}, "
            f"CT={','.join(3 * [braked])}",
        ]
        return place


def settled(mechanism: Mechanism) -> Session:
    """The mechanism when its dampers have done their work."""
    flags = {"method": "RADAU", "error": 1e-9 * mechanism.long}
    session = Session(adamslite.read(mechanism.text), None, flags)
    session.execute([Simulate(kind="DYNAMICS", end=SETTLED, steps=1)])
    assert session.outcome is Outcome.DONE
    return session


def differs(mechanism: Mechanism, observer: int | None, seed: int) -> float:
    """How far the eigenvalues are from the exponents of the flow."""
    session = settled(mechanism)
    found = linear(session.system, relative_to=observer)
    assert found.steady
    if observer is not None:
        for other in (None, 50):
            assert linear(session.system, relative_to=other).steady_for == "with RM=20"
    time = 1.0 / np.abs(found.eigenvalues).max()
    flow = Flow(session, 1e-11 * mechanism.long, observer)
    count = len(found.eigenvalues) + 3
    return distance(found.eigenvalues, flow.exponents(count, time, 1e-4, seed))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("seed", "unit", "observer"),
    [
        (0, "METER", 20),
        (1, "METER", 30),
        (2, "METER", 20),
        (2, "METER", 40),
        (4, "CENTIMETER", 20),
    ],
)
def test_mechanisms_on_turntables(seed: int, unit: str, observer: int) -> None:
    """Seen from the table or from a part on it; the ground and the rotor are told to go there."""
    assert differs(Mechanism(seed, unit), observer, seed) < 1e-5


@pytest.mark.parametrize(("seed", "unit"), [(3, "METER"), (9, "CENTIMETER")])
def test_a_spinning_rotor_on_mechanisms_at_rest(seed: int, unit: str) -> None:
    """Seen from the ground: its symmetry makes the motion steady."""
    assert differs(Mechanism(seed, unit, turning=False), None, seed) < 1e-5

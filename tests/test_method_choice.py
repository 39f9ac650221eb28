"""What AUTO takes where bodies meet, and that it is right there."""

from __future__ import annotations

import numpy as np
import pytest

import adamslite as al
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

PENDULUM = """a rod of {mass} kg and 1 m between two stops
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={unit}, TIME=SECOND
ACCGRAV/JGRAV=-{gravity}
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS={mass}, CM=2, IP={inertia},{inertia},{inertia}, QG=0,-{half},0, VX={half}, WZ=2
MARKER/2, PART=2
MARKER/3, PART=2, QP=0,{half},0
JOINT/1, REVOLUTE, I=3, J=1
SFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION={torque}
END
"""
STOPS = "BISTOP(AZ(3,1), WZ(3,1,1), -0.3, 0.2, {k}, 1.5, {c}, 0.01)"

CONVEL = """two shafts at an angle, with a joint whose branch follows the state
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
MARKER/11, PART=1, QP=1,0,0, REULER=0,10D,0
PART/2, MASS=1, CM=2, IP=1,1,1, WZ=1
MARKER/2, PART=2
PART/3, MASS=1, CM=3, IP=1,1,1, QG=1,0,0, REULER=0,10D,0
MARKER/3, PART=3
JOINT/1, REVOLUTE, I=2, J=1
JOINT/2, REVOLUTE, I=3, J=11
SFORCE/1, ROTATIONAL, ACTIONONLY, I=3, J=11, FUNCTION=SIN(AZ(3,11))
END
"""

FLATTENED = """a parallelogram that is flattened twice in every turn, its crank on a soft stop below
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=1,0,0
MARKER/9, PART=1, FLOATING
PART/10, MASS=1, CM=12, IP=0.001,0.0833333,0.0833333, REULER=90D,0,0, VX=0.5, WZ=-1
MARKER/10, PART=10
MARKER/11, PART=10, QP=1,0,0
MARKER/12, PART=10, QP=0.5,0,0
PART/20, MASS=1, CM=22, IP=0.001,0.0833333,0.0833333, QG=1,0,0, REULER=90D,0,0, VX=0.5, WZ=-1
MARKER/20, PART=20
MARKER/21, PART=20, QP=1,0,0
MARKER/22, PART=20, QP=0.5,0,0
PART/40, MASS=1, CM=42, IP=0.001,0.0833333,0.0833333, QG=0,1,0, VX=1
MARKER/40, PART=40
MARKER/41, PART=40, QP=1,0,0
MARKER/42, PART=40, QP=0.5,0,0
JOINT/1, REVOLUTE, I=10, J=1
JOINT/2, REVOLUTE, I=20, J=2
JOINT/3, REVOLUTE, I=40, J=11
JOINT/4, REVOLUTE, I=41, J=21
VFORCE/1, I=12, JFLOAT=9, RM=1, FX=0\\FY=50*MAX(0, -0.3-DY(12))\\FZ=0
END
"""


def pendulum(mass: float = 1.0, length: float = 1.0, torque: str = "", k: float = 1e4) -> str:
    """The rod with lengths in metres / ``length``; torques in force times that."""
    inertia = mass * length**2 / 12.0
    return PENDULUM.format(
        mass=mass, unit="METER" if length == 1.0 else "MILLIMETER", gravity=9.81 * length,
        inertia=inertia, half=0.5 * length,
        torque=torque or STOPS.format(k=mass * k * length**2, c=mass * 5.0 * length**2),
    )  # fmt: skip


ELASTIC = "IMPACT(DY({i}),VY({i}),0,1E6,1.5,0,0.001)"
# Full damping from a depth of 0.01 mm on, where 1e5 N s/m stop 0.1 kg within a microsecond, and
# 30 N that press on.
VISCOUS = "IMPACT(DY({i}),VY({i}),0,1E6,1.1,1E5,1E-5)-30"


def balls(count: int, law: str) -> str:
    """Balls of 0.1 to 0.4 kg above a floor: nothing ties them together."""
    lines = [
        "balls",
        "UNITS/SYSTEM=MKS",
        "ACCGRAV/JGRAV=-9.81",
        "PART/1, GROUND",
        "MARKER/1, PART=1",
    ]
    for i in range(2, count + 2):
        lines += [
            f"POINT_MASS/{i}, MASS={0.1 * (1 + i % 4)}, CM={i}, QG={i},{0.05 + 0.03 * (i % 7)},0",
            f"MARKER/{i}, POINT_MASS={i}",
            f"VFORCE/{i}, I={i}, J_PART=1, FX=0\\FZ=0\\FY={law.format(i=i)}",
        ]
    return "\n".join([*lines, "END", ""])


def auto(deck: str, end: float = 1.0, error: float = 1e-4, steps: int = 100) -> Results:
    return al.simulate(al.read(deck), end=end, steps=steps, integrator="AUTO", error=error)


def taken(results: Results) -> str:
    return results.meta["integrator"].partition(" ")[0]


@pytest.mark.parametrize(("mass", "length"), [(1.0, 1.0), (1e-3, 1.0), (1e3, 1.0), (2.0, 1e3)])
def test_a_joint_and_a_stop_are_solved_by_radau(mass: float, length: float) -> None:
    """In any units and with any mass the same method, the same steps but for rounding of ERROR on
    lengths, and the angle of a run at 1e-9.
    """
    deck = pendulum(mass, length)
    found = auto(deck, error=1e-5)
    assert taken(found) == "RADAU"
    assert "SFORCE/1 sets in and breaks off" in found.meta["integrator chosen"]
    truth = al.simulate(al.read(deck), end=1.0, steps=100, integrator="ABAM", error=1e-10)
    np.testing.assert_allclose(found["PART/2.x"], truth["PART/2.x"], atol=2e-4 * length)


def test_a_stiff_stop_costs_no_more_than_a_soft_one() -> None:
    """An explicit formula would follow the closed contact with ten times the steps for a hundred
    times the stiffness; the tries of AUTO grow by less than half.
    """
    tries = [
        found.summary["steps"] + found.summary["rejected"]
        for found in (auto(pendulum(k=k)) for k in (1e4, 1e6, 1e8))
    ]
    assert max(tries) < 1.5 * min(tries)


def test_radau_is_as_exact_as_the_explicit_formula_in_its_place() -> None:
    """At ERROR of 1e-3 the steps are those of 1e-4; others keep theirs."""
    coarse, fine = (auto(pendulum(), error=error) for error in (1e-3, 1e-4))
    np.testing.assert_array_equal(coarse.values, fine.values)
    assert "ERROR=0.0001" in coarse.meta["integrator"]
    assert "ERROR=1e-05" in auto(pendulum(), error=1e-5).meta["integrator"]


@pytest.mark.parametrize("deck", [CONVEL, pendulum(torque="-5*AZ(3,1)")])
def test_where_nothing_meets_the_explicit_formula_stays(deck: str) -> None:
    assert taken(auto(deck)) == "RKF45"


def test_free_balls_few_are_located_many_are_passed() -> None:
    """Few: each contact is located, energy at the end within 1e-3.  A hundred: equal steps."""
    few = auto(balls(3, ELASTIC))
    assert taken(few) == "RKF45"
    for i in (2, 3, 4):
        y, v = few[f"POINT_MASS/{i}.y"], few[f"POINT_MASS/{i}.vy"]
        free = y > 0.0
        energy = 9.81 * y[free] + 0.5 * v[free] ** 2
        np.testing.assert_allclose(energy, energy[0], rtol=1e-3)
    assert taken(auto(balls(100, ELASTIC), end=0.1, steps=10)) == "VERLET"


def test_a_posture_that_radau_does_not_pass_is_passed_by_the_method_in_reserve() -> None:
    """At a small ERROR it stops where the parallelogram lies flat; the run begins again, and is
    that of the explicit formula, number for number.
    """
    settings = {"end": 10.0, "steps": 50, "error": 1e-9}
    deck = al.read(FLATTENED)
    alone = al.simulate(deck, integrator="RADAU", **settings)
    assert alone.outcome in (Outcome.NEWTON_FAILED, Outcome.STEP_TOO_SMALL)
    found = al.simulate(deck, integrator="AUTO", **settings)
    assert found.outcome is Outcome.DONE
    assert found.meta["integrator chosen"] == "explicit, because RADAU stalled"
    known = al.simulate(deck, integrator="RKF45", **settings)
    np.testing.assert_array_equal(found.values, known.values)


def test_a_contact_that_creeps_is_left_to_radau() -> None:
    """What decays within some microseconds holds steps of the explicit formula down, in 0.4 s to
    18 549 of them; the run begins again, and is that of RADAU.
    """
    deck = balls(2, VISCOUS)
    found = auto(deck, end=0.4, steps=40)
    assert found.meta["integrator chosen"] == "implicit, because RKF45 stalled"
    assert found.summary["steps"] < 200
    known = al.simulate(al.read(deck), end=0.4, steps=40, integrator="RADAU", error=1e-4)
    np.testing.assert_array_equal(found.values, known.values)


def test_with_a_delay_the_explicit_formula_gets_through_by_itself() -> None:
    """The past of a delay is written for one run: nothing is in reserve, and nothing given up."""
    delayed = "VARIABLE/1, FUNCTION=DELAY(DY(2), 0.1, 0)\nEND\n"
    found = auto(balls(1, VISCOUS).replace("END\n", delayed), end=0.2, steps=10)
    assert found.outcome is Outcome.DONE
    assert taken(found) == "RKF45"
    assert found.summary["steps"] > 1000


def test_a_look_at_a_run_does_not_alter_it() -> None:
    """Balls that come to rest, 20 s: looked at twice, the numbers of the explicit formula alone."""
    deck = balls(3, "IMPACT(DY({i}),VY({i}),0,1E6,1.0,500,0.001)")
    found = auto(deck, end=20.0)
    assert taken(found) == "RKF45"
    assert found.summary["steps"] > 4000
    known = al.simulate(al.read(deck), end=20.0, steps=100, integrator="RKF45", error=1e-4)
    np.testing.assert_array_equal(found.values, known.values)


def test_the_formulation_of_a_method_holds_after_one_that_has_another() -> None:
    """The velocity of the rod stays across it, which index 3 alone does not see to."""
    commands = (
        "INTEGRATOR/ABAM\nSIMULATE/DYNAMIC, END=0.2, STEPS=10\n"
        "INTEGRATOR/GSTIFF, SI2, ERROR=1E-3\nSIMULATE/DYNAMIC, END=1, STEPS=40\nSTOP\n"
    )
    deck = al.read(pendulum())
    found = al.simulate(deck, commands=al.read_commands(commands, deck))
    x, y, vx, vy = (found[f"PART/2.{c}"] for c in ("x", "y", "vx", "vy"))
    np.testing.assert_allclose(x * vx + y * vy, 0.0, atol=1e-4)

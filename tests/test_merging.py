"""Parts that JOINT/FIXED holds together are one body; nothing of what is written changes."""

from __future__ import annotations

import numpy as np
import pytest
from fixed_parts import Machine
from tiers import every

import adamslite
from adamslite.model.merging import MergedModel, merged
from adamslite.model.model import assemble

PENDULUM = """Two parts that are one pendulum, pushed on the second
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=2, IP=0.1,0.2,0.15, QG=1,0,0{speeds}
MARKER/2, PART=2
MARKER/3, PART=2, QP=-1,0,0
MARKER/4, PART=2, QP=1,0,0
PART/3, MASS={mass}, CM=6, IP={mass},{mass},{mass}, QG=2,0,0{more}
MARKER/5, PART=3
MARKER/6, PART=3, QP=0.5,0,0
JOINT/1, REVOLUTE, I=3, J=1
JOINT/2, FIXED, I=5, J=4
{extra}
SIMULATE/{kind}, END=0.5, STEPS=5
END
"""
FLOOR = (
    "MARKER/9, PART=1, QP=2.5,-0.3,0, REULER=0,-90D,0\nGRAPHICS/1, ELLIPSOID, CM=6"
    ", XSCALE=0.1, YSCALE=0.1, ZSCALE=0.1\n"
    "GRAPHICS/2, PLANE, RM=9, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1\n"
)
IMPACT = "IMPACT, STIFFNESS=1E4, EXPONENT=1.5, DAMPING=1, DMAX=0.01"
SPEEDS = {"speeds": ", VY=2, WZ=2", "more": ", VY=5, WZ=2"}


def deck(extra: str = "", kind: str = "DYNAMICS", **values: object) -> adamslite.Deck:
    given = {"mass": 3, "speeds": "", "more": "", **values}
    return adamslite.read(PENDULUM.format(extra=extra, kind=kind, **given))


def is_merged(found: adamslite.Deck) -> bool:
    return isinstance(merged(assemble(found)), MergedModel)


def sizes(results: adamslite.Results) -> np.ndarray:
    """Of every column the largest value of its kind (vx with vy and vz), or 1: (nc,)."""
    kinds = [
        name.partition(".")[2].rstrip("xyz") if "REQUEST" not in name else name
        for name in results.names
    ]
    largest = np.abs(results.values).max(axis=0)
    return np.array([max(largest[[k == kind for k in kinds]].max(), 1.0) for kind in kinds])


def difference(found: adamslite.Deck, **options: object) -> float:
    """The largest difference of any column with and without the rule."""
    one = adamslite.simulate(found, **options)
    other = adamslite.simulate(found, no_reduction=["fixed"], **options)
    assert one.outcome.name == other.outcome.name == "DONE"
    assert one.names == other.names
    assert one.summary["dof"] == other.summary["dof"]
    np.testing.assert_array_equal(one.time, other.time)
    return float((np.abs(one.values - other.values).max(axis=0) / sizes(other)).max())


@pytest.mark.parametrize("seed", every(6, range(3, 33)))
def test_random_machines_have_the_same_results(seed: int) -> None:
    """Lumps of one to four parts on other joints, with springs, bushings, forces and torques
    between any of them, metres and millimetres: all channels of parts and joints to 1e-9.
    """
    machine = Machine(seed)
    found = adamslite.read(machine.text(0.05))
    model = merged(assemble(found))
    if not isinstance(model, MergedModel):
        assert not machine.fixed or machine.holds_all
        return
    assert machine.fixed == len(model.cuts)
    assert difference(found, error=1e-10, integrator="RADAU") < 1e-9


@pytest.mark.parametrize("seed", every(6, range(100, 130)))
def test_reactions_that_are_watched_are_the_same(seed: int) -> None:
    """Every reaction of a FIXED joint of such a machine in a REQUEST, each of its columns to 1e-9
    of the largest of its kind.
    """
    machine = Machine(seed)
    found = adamslite.read(machine.watched())
    if not is_merged(found):
        assert not machine.fixed or machine.holds_all
        return
    assert difference(found, error=1e-10, integrator="RADAU") < 1e-9


@pytest.mark.parametrize(("mass", "signs"), [(3, ("5", "4")), (0.7, ("4", "5"))])
def test_what_the_joint_carries_is_what_the_second_part_needs(
    mass: float, signs: tuple[str, str]
) -> None:
    """At the start, held level at rest, M m at distances a = 1, b = 2.5 from the pin turn with

        alpha = -g (2 a + m b) / (J + 2 a^2 + m (1 + b^2)),    J = 0.15

    and the joint at c = 2 carries m (g + alpha b) and its moment m alpha + m (g + alpha b)(b - c).
    """
    i, j = signs
    text = PENDULUM.replace("I=5, J=4", f"I={i}, J={j}")
    found = adamslite.read(text.format(mass=mass, speeds="", more="", extra="", kind="DYNAMICS"))
    assert is_merged(found)
    results = adamslite.simulate(found)
    g = 9.81
    alpha = -g * (2 + mass * 2.5) / (0.15 + 2 + mass * (1 + 2.5**2))
    force = mass * (g + alpha * 2.5)
    sign = 1 if i == "5" else -1
    assert results["JOINT/2.fy"][0] == pytest.approx(sign * force, rel=1e-9)
    assert results["JOINT/2.tz"][0] == pytest.approx(sign * (mass * alpha + force * 0.5), rel=1e-9)


@pytest.mark.parametrize("integrator", ["GSTIFF", "HHT", "RKF45", "ABAM"])
def test_every_method_runs(integrator: str) -> None:
    error = 1e-7 if integrator == "HHT" else 1e-10
    assert difference(deck(**SPEEDS), integrator=integrator, error=error) < 1e3 * error


@pytest.mark.parametrize(
    "extra",
    [
        "SFORCE/1, I=6, J=1, FUNCTION=0.1*JOINT(2,0,2,0)",
        "SFORCE/1, I=6, J=1, FUNCTION=0.1*FX(5,4)",
        "VARIABLE/1, FUNCTION=JOINT(2,0,2,0)\nSFORCE/1, I=6, J=1, FUNCTION=0.1*VARVAL(1)",
        "DIFF/1, IC=0, FUNCTION=JOINT(2,0,2,0)-DIF(1)",
        "MARKER/7, PART=3, QP=0.2,0,0\nMARKER/8, PART=2, QP=0.2,0,0\nGCON/1, FUNCTION=DM(7,8)-1",
        "MARKER/7, PART=3, QP=0,1,0\nMARKER/8, PART=2, QP=1,1,0\nJOINT/3, FIXED, I=7, J=8",
        "MARKER/7, PART=3\nMARKER/8, PART=2, QP=1,0,0\nJOINT/3, REVOLUTE, I=7, J=8",
        f"{FLOOR}CONTACT/1, IGEOM=1, JGEOM=2, POISSON, PENALTY=1E4, RESTITUTION_COEFFICIENT=0.5",
        f"{FLOOR}CONTACT/1, IGEOM=1, JGEOM=2, {IMPACT}\nGRAPHICS/3, ELLIPSOID, CM=4"
        f", XSCALE=0.1, YSCALE=0.1, ZSCALE=0.1\nCONTACT/2, IGEOM=3, JGEOM=2, {IMPACT}",
    ],
)
def test_parts_stay_apart_where_the_joint_counts(extra: str) -> None:
    """Fed back, in a loop, beside another joint; where a law knows masses, or both parts touch."""
    assert not is_merged(deck(extra))


@pytest.mark.parametrize(
    "values",
    [{"speeds": ", VY=1, WZ=1"}, {"speeds": ", VY=1, WZ=1", "more": ", VY=2.5, WZ=1.1"}],
)
def test_speeds_that_contradict_are_settled_part_by_part(values: dict[str, str]) -> None:
    found = deck(**values)
    assert not is_merged(found)
    assert difference(found) == 0.0


def test_speeds_that_another_joint_does_not_allow_are_settled_part_by_part() -> None:
    """The two parts start as one, but along the pin: how that is settled depends on each part."""
    found = deck(speeds=", VX=1", more=", VX=1")
    assert is_merged(found)
    one = adamslite.simulate(found)
    np.testing.assert_array_equal(
        one.values, adamslite.simulate(found, no_reduction=["fixed"]).values
    )


def test_what_counts_from_where_other_joints_close_does_so_part_by_part() -> None:
    """COUPLERs between joints that are drawn apart: closing them moves every part by itself."""
    extra = EXTRAS["couplers on both parts"].replace("QP=1.2,-2,0", "QP=1.1,-2,0")
    found = deck(extra)
    assert is_merged(found)
    assert difference(found) == 0.0


def test_parts_drawn_apart_stay_apart() -> None:
    text = PENDULUM.format(mass=3, speeds="", more="", extra="", kind="DYNAMICS")
    assert not is_merged(adamslite.read(text.replace("QG=2,0,0", "QG=2,1E-7,0")))


@pytest.mark.parametrize("mass", [0, 3])
def test_statics_and_a_part_without_mass(mass: float) -> None:
    """A part without mass is carried; at rest the joint carries the weight behind it."""
    extra = "SFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION=-50*AZ(3,1)-5*WZ(3,1)"
    text = PENDULUM.format(mass=mass, speeds="", more="", extra=extra, kind="STATICS")
    text = text.replace("STATICS, END=0.5, STEPS=5", "STATICS")
    if not mass:
        text = text.replace("IP=0,0,0, ", "")
    found = adamslite.read(text)
    assert is_merged(found)
    assert difference(found) < 1e-7
    assert adamslite.simulate(found)["JOINT/2.fy"][0] == pytest.approx(9.81 * mass, abs=1e-6)


def test_a_part_that_ground_holds_keeps_its_channels() -> None:
    """The second part is FIXED to ground beside the pendulum: it stands, and its joint carries its
    weight and the pull of a spring.
    """
    text = PENDULUM.replace("I=5, J=4", "I=5, J=9").replace(
        "{extra}", "MARKER/9, PART=1, QP=2,0,0\nSPRINGDAMPER/1, I=6, J=2, K=10, C=1, LENGTH=1"
    )
    found = adamslite.read(text.format(mass=3, speeds="", more="", kind="DYNAMICS"))
    model = merged(assemble(found))
    assert isinstance(model, MergedModel)
    assert len(model.bodies) == 1
    assert difference(found, error=1e-10, integrator="RADAU") < 1e-9


def test_commands_that_look_into_the_model_leave_parts_apart() -> None:
    """DEACTIVATE of the joint in mid-run: the parts fall apart as without the rule."""
    commands = adamslite.read_commands(
        "DEACTIVATE/JOINT, ID=2\nSIMULATE/DYNAMICS, END=1, STEPS=5\nSTOP\n", deck()
    )
    results = [
        adamslite.simulate(deck(), commands=commands, no_reduction=rules)
        for rules in ((), ("fixed",))
    ]
    np.testing.assert_array_equal(results[0].values, results[1].values)


@pytest.mark.parametrize("watched", ["LE, VALUE=-0.5, FUNCTION=DY(6,1)",
                                     "GE, VALUE=13, FUNCTION=JOINT(2,0,1,0)"])  # fmt: skip
def test_a_sensor_stops_both_at_the_same_time(watched: str) -> None:
    found = deck(f"SENSOR/1, HALT, {watched}")
    assert is_merged(found)
    one, other = (
        adamslite.simulate(found, error=1e-10, integrator="RADAU", no_reduction=rules)
        for rules in ((), ("fixed",))
    )
    assert one.outcome == other.outcome
    np.testing.assert_allclose(one.time, other.time, rtol=1e-9)


EXTRAS = {
    "driven": "MOTION/1, JOINT=1, ROTATION, FUNCTION=SIN(3*TIME)",
    "a speed is driven": "MOTION/1, JOINT=1, ROTATION, VELOCITY, FUNCTION=3",
    "an expression jumps": "SFORCE/1, ROTATIONAL, I=6, J=1, FUNCTION=STEP(TIME,0.1,0,0.2,9)"
    "+IF(TIME-0.3:0,0,20)",
    "an impact": "VFORCE/2, I=6, J_PART=1, FX=0\\ "
    "FY=IMPACT(DY(6,1),VY(6,1),-0.3,1E4,1.5,10,0.01)\\ FZ=0",
    "a spring inside": "SPRINGDAMPER/1, I=6, J=3, K=100, C=1, LENGTH=1",
    "a beam to ground": "MARKER/9, PART=1, QP=3.5,0,0\nBEAM/1, I=9, J=6, LENGTH=1, IXX=1E-6, "
    "IYY=1E-6, IZZ=1E-6, AREA=1E-4, EMODULUS=1E9, GMODULUS=1E9, CRATIO=0.01",
    "a reaction that follows": "MARKER/9, PART=3, FLOATING\n"
    "VFORCE/3, I=3, JFLOAT=9, FX=5\\ FY=1\\ FZ=0",
    "added mass": "VFORCE/3, I=6, J_PART=1, FX=0\\ FY=-0.5*ACCY(6)\\ FZ=0",
    "a variable of itself": "VARIABLE/1, IC=1, FUNCTION=0.5*VARVAL(1)+ACCY(6)*0.01\n"
    "REQUEST/1, F1=VARVAL(1)",
    "a contact": f"{FLOOR}CONTACT/1, IGEOM=1, JGEOM=2, {IMPACT}\nREQUEST/1, FORCE, I=5, J=4",
    "friction": "FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, PIN_RADIUS=0.1",
    "a coupler": "PART/8, MASS=1, CM=81, IP=1,1,1, QG=0,2,0\nMARKER/81, PART=8\n"
    "MARKER/82, PART=1, QP=0,2,0\nJOINT/5, REVOLUTE, I=81, J=82\n"
    "COUPLER/1, JOINTS=1,5, TYPE=R:R, SCALES=1,2",
    "couplers on both parts": "PART/8, MASS=1, CM=81, IP=1,1,1, QG=0,2,0\nMARKER/81, PART=8\n"
    "MARKER/82, PART=2, QP=0.2,0,0\nMARKER/83, PART=3, QP=0,0.3,0\n"
    "PART/9, MASS=2, CM=91, IP=1,2,3, QG=0,1,0\nMARKER/91, PART=9\n"
    "MARKER/92, PART=8, QP=1.2,-2,0\nMARKER/93, PART=9, QP=2,-0.7,0\n"
    "JOINT/5, REVOLUTE, I=92, J=82\nJOINT/6, REVOLUTE, I=93, J=83\n"
    "COUPLER/1, JOINTS=5,6, TYPE=R:R, SCALES=1,2\nREQUEST/1, FORCE, I=5, J=4, RM=3",
    "a constraint on both parts": "PART/8, MASS=1, CM=81, IP=1,1,1, QG=1,2,0\nMARKER/81, PART=8\n"
    "GCON/1, FUNCTION=DM(6,81)+0.5*DM(2,81)-0.3*DY(5,81,81)-VARVAL(1)\n"
    "VARIABLE/1, FUNCTION=4.0-0.1*TIME\nREQUEST/1, F3=JOINT(2,1,3,81)\\ F8=JOINT(2,1,8,81)",
    "a general constraint": "PART/8, MASS=1, CM=81, IP=1,1,1, QG=1,2,0\nMARKER/81, PART=8\n"
    "GCON/1, FUNCTION=DM(6,81)-2.5",
    "a redundant hinge": "MARKER/9, PART=3, QP=-2,0,1\nMARKER/19, PART=1, QP=0,0,1\n"
    "JOINT/3, REVOLUTE, I=9, J=19",
}  # fmt: skip


@pytest.mark.parametrize("name", every(3, EXTRAS))
def test_whatever_else_acts(name: str) -> None:
    """To 1e-9; what a redundant hinge carries is shared out as with every part by itself."""
    found = deck(EXTRAS[name])
    assert is_merged(found)
    assert difference(found, error=1e-10, integrator="RADAU") < 1e-9


@pytest.mark.parametrize("error", every(1, [1e-6, 1e-10]))
def test_creep_that_has_ended_changes_no_branch(error: float) -> None:
    """Once a joint slips its creep is constant; |D| had an edge there that the last digit crossed,
    at which one run of ten stood still or took thousands of steps.
    """
    found, steps = deck(EXTRAS["friction"]), []
    for k in range(40):
        for rules in ((), ("fixed",)):
            results = adamslite.simulate(
                found, error=error * (1 + 1e-4 * k), integrator="RADAU", no_reduction=rules
            )
            assert results.outcome.name == "DONE"
            steps.append(results.summary["steps"])
    assert max(steps) < 3 * np.median(steps)


def test_turns_are_counted() -> None:
    """Whirled round more than twice against a torsion spring that takes hold of the second part."""
    extra = "SFORCE/1, ROTATIONAL, I=6, J=1, FUNCTION=-3*AZ(6,1)\nREQUEST/1, F1=AZ(6,1)"
    found = deck(extra, speeds=", VY=30, WZ=30", more=", VY=75, WZ=30")
    assert is_merged(found)
    assert difference(found, error=1e-10, integrator="RADAU") < 1e-9
    assert adamslite.simulate(found)["REQUEST/1.F1"].max() > 4 * np.pi

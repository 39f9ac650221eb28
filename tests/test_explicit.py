"""The explicit integrators: order, exactness against the implicit ones, drift, what they refuse."""

import numpy as np
import pytest

import adamslite as al
from adamslite.analyses.dynamics import dynamic
from adamslite.analyses.dynamics.dynamic import Settings
from adamslite.equations.system import System
from adamslite.errors import UsageError
from adamslite.results.outcomes import Outcome

SPRING = """two masses on springs
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=1.1,0,0
MARKER/2, POINT_MASS=2
POINT_MASS/3, MASS=2, CM=3, QG=2,0.3,0
MARKER/3, POINT_MASS=3
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=50, LENGTH=1
SPRINGDAMPER/2, TRANSLATIONAL, I=3, J=2, K=80, LENGTH=1
END
"""

PENDULUM = """a rigid pendulum
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=0.1,0.1,0.1, QG=1,0,0
MARKER/2, PART=2
MARKER/3, PART=2, QP=-1,0,0
JOINT/1, REVOLUTE, I=3, J=1
END
"""


def run(deck: str, integrator: str, **settings):
    return al.simulate(al.read(deck), end=2.0, steps=4, integrator=integrator, **settings)


@pytest.mark.parametrize("deck", [SPRING, PENDULUM], ids=["springs", "pendulum"])
@pytest.mark.parametrize("word", ["ABAM", "RKF45", "AUTO"])
def test_explicit_and_implicit_agree(deck: str, word: str):
    """Order 8 at 1e-9 against the BDF at 1e-9: positions within 1e-6."""
    found, known = run(deck, word, error=1e-9), run(deck, "GSTIFF", error=1e-9)
    assert found.outcome is Outcome.DONE
    for name in known:
        if name.endswith((".x", ".y")):
            np.testing.assert_allclose(found[name], known[name], atol=1e-6)


def test_projection_keeps_the_joint_closed():
    """Ten seconds of the pendulum: the pin stays within 1e-10 of its place."""
    results = al.simulate(al.read(PENDULUM), end=10.0, steps=20, integrator="ABAM", error=1e-8)
    length = np.hypot(results["PART/2.x"], results["PART/2.y"])
    np.testing.assert_allclose(length, 1.0, atol=1e-9)


@pytest.mark.parametrize("error", [1e-5, 1e-7])
def test_projection_leaves_nothing_but_round_off(error: float):
    """Whatever a step is off by, the place stays on the circle, the velocity along it."""
    results = al.simulate(al.read(PENDULUM), end=10.0, steps=10, integrator="ABAM", error=error)
    x, y, vx, vy, w = (results[f"PART/2.{name}"] for name in ("x", "y", "vx", "vy", "wz"))
    np.testing.assert_allclose(np.hypot(x, y), 1.0, rtol=0, atol=1e-13)
    np.testing.assert_allclose(vx, -w * y, rtol=0, atol=1e-11)
    np.testing.assert_allclose(vy, w * x, rtol=0, atol=1e-11)


@pytest.mark.parametrize("masses", [0, 1, 2, 5])
def test_a_part_behind_point_masses_spins_as_if_alone(masses: int):
    """A symmetric top without torque: w turns about L with |L|/I1.

    PART/9, MASS=1, CM=9, IP=1,1,2, WX=1, WZ=2        L = (1, 0, 4), recorded within long steps
    """
    flying = "".join(
        f"POINT_MASS/{k}, MASS=1, CM={k}, QG={k},0,0, VX=0.3\nMARKER/{k}, POINT_MASS={k}\n"
        for k in range(2, 2 + masses)
    )
    top = "PART/9, MASS=1, CM=9, IP=1,1,2, WX=1, WZ=2\nMARKER/9, PART=9\n"
    deck = f"a top\nPART/1, GROUND\nMARKER/1, PART=1\n{flying}{top}END\n"
    settings = {"integrator": "ABAM", "error": 1e-9, "hmax": 1.0}
    results = al.simulate(al.read(deck), end=5.0, steps=100, **settings)
    assert results.summary["steps"] < 80
    moment, start = np.array([1.0, 0.0, 4.0]), np.array([1.0, 0.0, 2.0])
    axis, angle = moment / np.sqrt(17.0), np.sqrt(17.0) * results.time[:, None]
    along = axis * (axis @ start)
    expected = along + np.cos(angle) * (start - along) + np.sin(angle) * np.cross(axis, start)
    found = np.column_stack([results[f"PART/9.w{c}"] for c in "xyz"])
    np.testing.assert_allclose(found, expected, atol=1e-7)


def test_verlet_is_of_order_two():
    """Half the step, a quarter of the error."""
    known = run(SPRING, "ABAM", error=1e-10)["POINT_MASS/3.x"][-1]
    errors = [
        abs(run(SPRING, "VERLET", hmax=h)["POINT_MASS/3.x"][-1] - known) for h in (0.002, 0.001)
    ]
    assert 3.0 < errors[0] / errors[1] < 5.0


def test_verlet_refuses_constraints():
    with pytest.raises(UsageError, match="VERLET"):
        run(PENDULUM, "VERLET")


def test_verlet_gives_up_before_a_pole_of_a_force():
    """x" = 1/(0.707.. - t)^2 has no state at 0.707..; steps below 1e-8 output steps give up."""
    scene = "a pole\nPART/1, GROUND\nPOINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\n"
    scene += "VFORCE/1, I=2, J_PART=1, FX=1/(SQRT(0.5)-TIME)**2\nEND\n"
    assert Settings(method="VERLET").least_step(10.0, 0.1) == pytest.approx(1e-9)
    results = run(scene.replace("END", "INTEGRATOR/VERLET, HMIN=1E-6\nEND"), "VERLET")
    assert results.outcome is Outcome.STEP_TOO_SMALL
    assert results.time[-1] == 0.5


LAGGING_TOP = """A spinning top, pushed by a filter of its position that is faster than the steps
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=0.408, CM=22, IP=0.0013,0.0013,0.0009, REULER=0,0.8,0, WZ=14, WX=1.4
MARKER/20, PART=2
MARKER/22, PART=2, QP=0,0,0.067
JOINT/1, SPHERICAL, I=20, J=1
DIFF/1, FUNCTION={pace}*(DX(22)-DIF(1))
VFORCE/1, I=22, J_PART=1, FX=-67*DX(22)-21*DIF(1)
END
"""


@pytest.mark.parametrize("pace", [235, 180])
def test_records_between_steps_at_the_bound_of_stability(pace: int) -> None:
    """The polynomial between the ends was off by 2e-4 where the ends were right to 1e-6."""
    kernels = al.compile_model(al.assemble(al.read(LAGGING_TOP.format(pace=pace))))
    settings = {"end": 1.6, "steps": 30}
    found = al.simulate(kernels, integrator="ABAM", error=1e-6, **settings)
    known = al.simulate(kernels, integrator="RADAU", error=1e-9, **settings)
    assert found["DIFF/1"] == pytest.approx(known["DIFF/1"], abs=1e-5)


#: A force that jumps with time, between the requested outputs.
KICKED = SPRING.replace("END\n", "VFORCE/1, I=3, J_PART=1, FY=IF(TIME-0.77:0,0,5)\nEND\n")


@pytest.mark.parametrize("deck", [SPRING, KICKED], ids=["springs", "kicked"])
@pytest.mark.parametrize(("method", "error"), [("ABAM", 1e-9), ("HHT", 1e-5), ("VERLET", 1e-9)])
@pytest.mark.parametrize("unwatched", [0.0, 6.0, 200.0, 2000.0, 1e9])
def test_a_run_that_pauses_continues_as_if_it_had_not(
    deck: str, method: str, error: float, unwatched: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first tries are made without a thread: none, one, 33 or all of them; of VERLET as many
    steps as take as long, up to an output time.
    """
    known = run(deck, method, error=error)
    assert known.summary["steps"] > 50
    monkeypatch.setattr(dynamic, "UNWATCHED", unwatched)
    found = run(deck, method, error=error)
    np.testing.assert_array_equal(found.values, known.values)
    for word in ("steps", "rejected", "events"):
        assert found.summary[word] == known.summary[word]


@pytest.mark.parametrize("unwatched", [200.0, 1e9])
def test_an_interrupt_within_the_first_tries_is_heeded(
    unwatched: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Python raises it when native code returns; of a run that is over by then, what called it
    must know."""
    integrate, calls = System.integrate, []

    def interrupted(system: System, entry: str) -> int:
        code = integrate(system, entry)
        calls.append(code)
        if len(calls) == 1:
            raise KeyboardInterrupt
        return code

    monkeypatch.setattr(dynamic, "UNWATCHED", unwatched)
    monkeypatch.setattr(dynamic, "FEW", 2**40)
    monkeypatch.setattr(System, "integrate", interrupted)
    assert run(SPRING, "ABAM", error=1e-9).outcome is Outcome.INTERRUPTED


@pytest.mark.parametrize("masses", [1, 2, 3, 4, 5, 9])
@pytest.mark.parametrize("gravity", [0.0, -9.81])
def test_masses_on_which_no_force_acts(masses: int, gravity: float) -> None:
    """y = v t + g/2 t^2; nothing to evaluate, by component or otherwise."""
    points = "".join(
        f"POINT_MASS/{k}, MASS={k}, CM={k}, QG={k},0,0, VY=0.1\nMARKER/{k}, POINT_MASS={k}\n"
        for k in range(2, 2 + masses)
    )
    deck = f"masses\nACCGRAV/JGRAV={gravity}\nPART/1, GROUND\nMARKER/1, PART=1\n{points}END\n"
    found = run(deck, "ABAM", error=1e-8)
    assert found.outcome is Outcome.DONE
    for k in range(2, 2 + masses):
        expected = 0.1 * found.time + 0.5 * gravity * found.time**2
        np.testing.assert_allclose(found[f"POINT_MASS/{k}.y"], expected, atol=1e-12)


def test_no_error_is_large_against_a_state_beyond_all_numbers() -> None:
    """x = 5e154 t^2: a share of it says nothing, so no step is taken."""
    scene = "a push\nPART/1, GROUND\nPOINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\n"
    found = run(scene + "VFORCE/1, I=2, J_PART=1, FX=1E155\nEND\n", "ABAM", error=1e-3)
    assert found.outcome is Outcome.NOT_FINITE and len(found.time) == 1


BOUNCING = """a mass that is driven against a stiff wall again and again
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS={mass}, CM=2, QG=0.3,0,0, VX={speed}
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=IMPACT(DX(2),VX(2),0,{stiffness},{power},0,0.01)-3*DX(2)-1
SIMULATE/DYNAMIC, END=4, STEPS=50
END
"""


@pytest.mark.parametrize("seed", range(5))
def test_a_wall_of_any_power_is_left_as_precisely_as_it_is_met(seed: int) -> None:
    """Behind an event a force may begin with a power of the time that is not whole.  There the
    estimate of order 5, tamed by that of order 3 as if both were of their orders, fell short by a
    factor of a hundred and more.
    """
    some = np.random.default_rng(seed)
    for _ in range(4):
        power, stiffness = some.uniform(1.1, 2.9), 10 ** some.uniform(4, 7)
        deck = al.read(
            BOUNCING.format(
                mass=some.uniform(0.2, 3), speed=-some.uniform(0.3, 2),
                stiffness=stiffness, power=power,
            )
        )  # fmt: skip
        known = al.simulate(deck, integrator="RADAU", error=1e-11)["POINT_MASS/2.vx"]
        found = al.simulate(deck, integrator="ABAM", error=1e-8)["POINT_MASS/2.vx"]
        assert np.abs(found - known).max() < 500e-8 * np.ptp(known)


TAPPED = """a four-bar linkage whose crank taps a stiff wall at every swing
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=1.138,0,0
PART/2, MASS=0.1221, CM=22, IP=1E-3,0.0008699,0.0008699, REULER=1.745,0,0
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.2924,0,0
MARKER/22, PART=2, QP=0.1462,0,0
PART/3, MASS=0.1221, CM=32, IP=1E-3,0.01158,0.01158, QG=-0.0506799137237126,0.2879744890523413,0
MARKER/30, PART=3
MARKER/31, PART=3, QP=1.138,0,0
MARKER/32, PART=3, QP=0.569,0,0
PART/4, MASS=0.1221, CM=42, IP=1E-3,0.0008699,0.0008699, QG=1.138,0,0, REULER=1.745,0,0
MARKER/40, PART=4
MARKER/41, PART=4, QP=0.2924,0,0
MARKER/42, PART=4, QP=0.1462,0,0
JOINT/1, REVOLUTE, I=20, J=1, IC=1.745,-0.7045
JOINT/2, REVOLUTE, I=30, J=21
JOINT/3, REVOLUTE, I=31, J=41
JOINT/4, REVOLUTE, I=40, J=2
SFORCE/1, ROTATIONAL, I=20, J=1, FUNCTION=-12.047*(AZ(20,1)-PI/2)-83.51*(AZ(20,1)-PI/2)**3
, +IMPACT(AZ(20,1)-PI/2,WZ(20,1),-0.07336,333200.0,1.342,2.042,0.003895)
SIMULATE/DYNAMIC, END=2.946, STEPS=200
END
"""


@pytest.mark.parametrize("error", [1e-6, 3e-7, 1e-7])
def test_steps_are_not_tried_until_an_estimate_is_low_by_chance(error: float) -> None:
    """Three rejections one after the other led back to before the wall, where constraints hold
    firmly, 24 times: three tries of a step for one, and the last of many estimates.
    """
    deck = al.read(TAPPED)
    known = al.simulate(deck, integrator="RADAU", error=1e-9)["PART/2.x"]
    found = al.simulate(deck, integrator="ABAM", error=error)
    assert np.abs(found["PART/2.x"] - known).max() < 300 * error * np.ptp(known)
    assert found.summary["rejected"] < found.summary["steps"]

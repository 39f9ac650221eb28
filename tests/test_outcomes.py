"""How runs end early: by name, with statement, line and time, and with what was computed."""

from __future__ import annotations

import _thread
import re
import signal
import threading
from pathlib import Path

import numpy as np
import pytest
from outcome_scenes import FALLING, PRINTED, WHEN, ended_early, reason, with_integrator
from scenes import GROUND, PENDULUM, chain, done, run

import adamslite as al
from adamslite import Outcome
from adamslite.reading.read import read_commands


def test_the_printed_sign_stops_where_the_mass_is_cancelled():
    """Free fall with dm = 10 t and m0 = 10: no solution beyond t = 1."""
    results = run(FALLING + PRINTED + "END\n", 2.0, 20, error=1e-8)
    assert results.outcome is Outcome.SINGULAR_ACCELERATION
    assert results.summary["t_end"] == pytest.approx(1.0, abs=1e-3)
    assert "VFORCE/7 (<text>:8:1)" in results.message
    assert results.time[-1] == pytest.approx(0.9)
    speed = -9.81 * results.time * (10 - 5 * results.time) / (10 - 10 * results.time)
    np.testing.assert_allclose(results["POINT_MASS/2.vy"], speed, rtol=1e-5, atol=1e-9)


@pytest.mark.parametrize("stiffness", (4e5, 4e7))
@pytest.mark.parametrize("error", (1e-3, 1e-6))
def test_a_stiff_spring_does_not_carry_the_run_through(stiffness, error):
    """From equilibrium the implicit formula would pass dm = m0 unseen: the mass's sign tells."""
    spring = f"SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=9, FUNCTION=-{stiffness}*DY(2)\n"
    upward = "MARKER/9, PART=1, REULER=0,-90D,0\n"
    start = f"QG=0,{-98.1 / stiffness},0"
    deck = FALLING.replace("CM=2", f"CM=2, {start}") + upward + spring + PRINTED + "END\n"
    results = run(deck, 2.0, 200, error=error)
    assert results.outcome is Outcome.SINGULAR_ACCELERATION
    assert results.summary["t_end"] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU", "ABAM"))
def test_the_coordinate_that_loses_its_inertia_is_named(method):
    """Of two masses, 10 and 0.001, the heavy one loses its inertia along y at t = 1."""
    light = "POINT_MASS/3, MASS=0.001, CM=3\nMARKER/3, POINT_MASS=3\n"
    force = "VFORCE/7, I=2, J_PART=1, FY=VARVAL(5)*ACCY(2)\nEND\n"
    results = run(with_integrator(FALLING + light + force, method), 2.0, 20)
    assert results.outcome is Outcome.SINGULAR_ACCELERATION
    assert results.summary["t_end"] == pytest.approx(1.0, abs=1e-2)
    assert "POINT_MASS/2 (<text>:5:1), y, loses its inertia" in results.message


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU", "ABAM"))
def test_a_pole_beside_a_force_of_accelerations_is_not_a_lost_mass(method):
    """The added mass 0.5 adds, and does not cancel; beside it a wheel, whose joint has no pivots.

    x" = 1/(0.707.. - t)^2/10.5, driven past its pole: whether the error test or the corrector gives
    up first there is a matter of rounding.
    """
    wheel = "PART/3, MASS=1, CM=3, IP=1,1,1\nMARKER/3, PART=3\nJOINT/3, REVOLUTE, I=3, J=1\n"
    force = "VFORCE/7, I=2, J_PART=1, FX=-0.5*ACCX(2)+1/(SQRT(0.5)-TIME)**2\nEND\n"
    results = run(with_integrator(FALLING + wheel + force, method), 2.0, 20)
    assert results.outcome in (Outcome.STEP_TOO_SMALL, Outcome.NEWTON_FAILED)
    assert results.summary["t_end"] == pytest.approx(0.5**0.5, abs=1e-3)


def test_a_mass_cancelled_through_a_variable_is_seen_too():
    deck = (
        FALLING
        + "VARIABLE/6, FUNCTION=0.5*VARVAL(6)+VARVAL(5)*0.5*ACCY(2)\n"
        + "VFORCE/7, I=2, J_PART=1, FY=VARVAL(6)+1\nEND\n"
    )
    results = run(deck, 2.0, 20)
    assert results.outcome is Outcome.SINGULAR_ACCELERATION
    assert results.summary["t_end"] == pytest.approx(1.0, abs=1e-3)
    assert "VARIABLE/6" in results.message


def test_infinite_forces_are_told_from_singular_masses():
    deck = FALLING + "VFORCE/7, I=2, J_PART=1, FX=1/TIME\nEND\n"
    assert run(deck, 1.0).outcome is Outcome.NOT_FINITE


def test_a_start_without_a_value_is_told_from_one_that_is_not_determined():
    """SIMULATE/INITIAL_CONDITIONS solves for accelerations, too."""
    deck = FALLING + "VFORCE/7, I=2, J_PART=1, FX=1/TIME\nEND\n"
    commands = read_commands("SIMULATE/INITIAL_CONDITIONS\n", al.read(deck))
    results = al.simulate(al.read(deck), commands=commands)
    assert results.outcome is Outcome.NOT_FINITE and "VFORCE/7" in results.message


def test_a_state_that_runs_away_is_named():
    """y' = y^2 from 1 leaves every bound at t = 1."""
    results = run(FALLING + "DIFF/3, IC=1, FUNCTION=DIF(3)**2\nEND\n", 2.0, 20)
    assert results.outcome in (Outcome.STEP_TOO_SMALL, Outcome.NOT_FINITE, Outcome.NEWTON_FAILED)
    assert "DIFF/3 (<text>:8:1)" in results.message
    assert results.summary["t_end"] == pytest.approx(1.0, abs=0.02)
    np.testing.assert_allclose(results["DIFF/3"][:9], 1 / (1 - results.time[:9]), rtol=0.05)


def test_poles_known_beforehand_are_not_a_number_not_a_crash():
    results = done(FALLING + "VARIABLE/6, FUNCTION=TIME/0\nEND\n", 1.0, 2)
    assert np.isnan(results["VARIABLE/6"]).all()


def test_columns_without_a_value_are_told():
    """A request need not have a value, but it is said where it has none."""
    results = done(FALLING + "REQUEST/1, F1=1/TIME\\F2=SQRT(0.6-TIME)\\F3=1\nEND\n", 1.0, 4)
    assert results.meta["no number"] == "REQUEST/1.F1 at t = 0; REQUEST/1.F2 at t = 0.75"
    assert "no number" not in done(FALLING + "END\n", 1.0, 2).meta


def test_time_only_variables_need_no_order():
    """A variable may use one that the deck defines later."""
    deck = FALLING + "VARIABLE/6, FUNCTION=2*VARVAL(7)\nVARIABLE/7, FUNCTION=3*VARVAL(5)\nEND\n"
    moved = done(deck.replace("END", "VFORCE/1, I=2, J_PART=1, FX=VARVAL(6)\nEND"), 1.0, 2)
    np.testing.assert_allclose(moved["VARIABLE/6"], 60 * moved.time)
    np.testing.assert_allclose(moved["POINT_MASS/2.ax"], 6 * moved.time)


@pytest.fixture
def listening():
    """Ctrl-C raises KeyboardInterrupt, even in a process that a shell started to ignore it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.filterwarnings("ignore")
def test_an_interrupted_run_keeps_what_it_has(listening):
    """Ctrl-C during a long run ends it by name, with the records made until then."""

    class Watch:
        """Stands for progress: asks for an interrupt once the run has begun."""

        asked = False

        def __call__(self, time: float, end: float) -> None:
            if not self.asked and time > 0.0:
                self.asked = True
                threading.Thread(target=_thread.interrupt_main).start()

        def say(self, sentence: str) -> None:
            return

    deck = chain(40)
    results = al.simulate(al.read(deck), end=1e5, steps=1_000_000, progress=Watch())
    assert results.outcome is Outcome.INTERRUPTED
    assert 0 < len(results.time) < 1_000_000
    assert np.isfinite(results.values).all()
    assert results.summary["t_end"] >= results.time[-1]
    assert re.fullmatch(rf"At {WHEN[3:]} and order \d\.", reason(results))


# Free, so that only its rotation has an error: that of order 1 in the first step.
SPINNING = GROUND + "PART/2, MASS=1, CM=2, IP=1,2,3, WX=1, WY=2, WZ=1\nMARKER/2, PART=2\nEND\n"


def test_a_step_too_small_names_what_the_error_test_fails_for():
    """HMIN = 0.1, and the error of order 1 is far above ERROR."""
    results = ended_early(with_integrator(SPINNING, "GSTIFF, ERROR=1E-6, HMIN=0.1"))
    assert results.outcome is Outcome.STEP_TOO_SMALL
    told = re.fullmatch(
        r"PART/2 \(<text>:4:1\), (.*): at t = 0, in step 1 of size 0\.1 \(HMIN\) and order 1, "
        r"the estimated error is ([\d.e+]+) times ERROR\. HMIN allows no shorter step; .*",
        reason(results),
    )
    assert told and told[1].startswith(("rotation about", "angular velocity about"))
    assert float(told[2]) > 1.0
    assert results.time.tolist() == [0.0]


@pytest.mark.parametrize("method", ("GSTIFF", "GSTIFF, I3", "HHT", "RADAU"))
def test_a_corrector_that_failed_names_equation_and_unknown(method):
    """A pendulum that swings may not iterate twice."""
    results = ended_early(with_integrator(PENDULUM, f"{method}, MAXIT=1, HMIN=0.1"))
    assert results.outcome is Outcome.NEWTON_FAILED
    place = r"(PART/2 \(<text>:5:1\)|JOINT/1 \(<text>:8:1\)), "
    told = re.fullmatch(
        place + r"(forces along|torques about|speed of )?.*: at t = 0, in step 1 of size 0\.1 "
        r"\(HMIN\) and order \d, this equation is off by ([\d.e+-]+) after iteration 1, more than "
        r"all others\. " + place + r".+, changes most, by ([\d.e+-]+)\. HMIN allows no shorter .*",
        reason(results),
    )
    assert told, results.message
    assert float(told[3]) > 0.0


def test_fixed_steps_end_where_the_corrector_fails_and_keep_what_there_was():
    """A force that grows without bound at t = 1/2, where x reaches 1."""
    deck = GROUND + "POINT_MASS/2, MASS=1, CM=2, VX=2\nMARKER/2, POINT_MASS=2\n"
    deck += "VFORCE/1, I=2, J_PART=1, FX=1E-3/(1-DX(2))**9\nEND\n"
    results = ended_early(with_integrator(deck, "CONSTANT_BDF, HMAX=0.01"), 1.0, 100)
    assert results.outcome in (Outcome.NEWTON_FAILED, Outcome.NOT_FINITE)
    assert re.search(WHEN, reason(results))
    assert "POINT_MASS/2 (<text>:4:1), x" in reason(results) or "VFORCE/1" in reason(results)
    assert 0.1 < results.time[-1] <= 0.5
    np.testing.assert_allclose(results["POINT_MASS/2.x"][:11], 2.0 * results.time[:11], rtol=1e-2)


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU"))
def test_an_expression_without_a_value_is_named(method):
    """The root of a negative number from t = 0.5 on, in the second of two forces."""
    force = "VFORCE/6, I=2, J_PART=1, FX=3\nVFORCE/7, I=2, J_PART=1, FX=SQRT(0.5-TIME)\nEND\n"
    results = ended_early(FALLING + force, integrator=method)
    assert results.outcome is Outcome.NOT_FINITE
    value = r"SQRT\(0\.5 - TIME\) has no finite value at 0\.5 - TIME = -[\d.e-]+"
    assert re.fullmatch(
        rf"VFORCE/7 \(<text>:9:1\): {WHEN} and order \d, {value}\.", reason(results)
    )
    assert results.summary["t_end"] == pytest.approx(0.5, abs=1e-6)
    assert results.time[-1] >= 0.4


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU", "ABAM"))
def test_a_variable_without_a_root_any_more_names_equation_unknown_and_iteration(method):
    """V = V^2 + t has a root until t = 1/4 only."""
    loop = "VARIABLE/6, FUNCTION=VARVAL(6)**2+TIME\nVFORCE/7, I=2, J_PART=1, FX=VARVAL(6)\nEND\n"
    results = ended_early(with_integrator(FALLING + loop, method))
    assert results.outcome is Outcome.NEWTON_FAILED
    assert results.summary["t_end"] == pytest.approx(0.25, abs=1e-3)
    told = rf"\w+/\d \(<text>:\d:1\).*: {WHEN} and order \d, this equation is off by \S+ after "
    told += (
        r"iteration \d+, more than all others\. VARIABLE/6 \(<text>:8:1\), changes most, by \S+\."
    )
    assert re.fullmatch(told, reason(results))


ALL = ("GSTIFF", "GSTIFF, I3", "CONSTANT_BDF", "HHT", "NEWMARK", "RADAU", "ABAM", "VERLET")


@pytest.mark.parametrize("method", ALL)
def test_one_body_without_a_value_among_others_that_are_well(method):
    """x" = 3 sqrt(1 - x) has no value beyond x = 1, which it passes at t = 0.83 from x' = 0.2.

    What comes after it, in numbers and in bodies, is at rest: a largest error or increment over all
    of them must not forget the one that is not a number.
    """
    deck = GROUND + "POINT_MASS/2, MASS=1, CM=2, VX=0.2\nMARKER/2, POINT_MASS=2\n"
    deck += "POINT_MASS/3, MASS=1, CM=3, QG=0,1,0\nMARKER/3, POINT_MASS=3\n"
    deck += "VFORCE/7, I=2, J_PART=1, FX=3*SQRT(1-DX(2))\nEND\n"
    results = ended_early(with_integrator(deck, method), 2.0, 20)
    assert results.outcome is Outcome.NOT_FINITE
    assert reason(results).startswith("VFORCE/7 (<text>:8:1): at t = 0.")
    assert 0.6 < results.time[-1] < 0.9
    assert np.isfinite(results.values).all()


CRANK = """\
PART/2, MASS=1, CM=2, IP=1,1,1, QG=1,0,0
MARKER/2, PART=2
MARKER/21, PART=2, QP=-1,0,0
MARKER/22, PART=2, QP=1,0,0
JOINT/1, REVOLUTE, I=21, J=1
PART/3, MASS=1, CM=3, IP=1,1,1, QG=3.5,0,0
MARKER/3, PART=3
MARKER/31, PART=3, QP=-1.5,0,0
MARKER/32, PART=3, QP=1.5,0,0
JOINT/2, REVOLUTE, I=31, J=22
MARKER/12, PART=1, QP=5,0,0, REULER=90D,90D,0
JPRIM/3, INPLANE, I=32, J=12
MOTION/1, JOINT=1, ROTATION, FUNCTION=TIME
END
"""


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU", "ABAM"))
def test_a_mechanism_that_locks_is_not_torn_apart(method):
    """A crank of 2 m and a rod of 3 m to a point on the plane x = 5, both stretched at the start.

    The plane and the pin hold the same way there, and one row is left out; a crank that turns
    opens it by 5 - 2 cos t - 3 cos b, sin b = 2/3 sin t: above 0.01 beyond t = 0.08.
    """
    results = ended_early(with_integrator(GROUND + CRANK, method), 5.0, 500)
    assert results.outcome is Outcome.TORN
    assert re.match(r"JOINT/2 \(.*\), x of I - J: at t = 0\.\d+, it opens\.", reason(results))
    assert results.time[-1] < 0.5


def test_steps_of_verlet_that_are_too_long_tell_the_longest():
    """k/m = 1e6: h <= 2/1000 but for 7 % of caution."""
    deck = GROUND + "POINT_MASS/2, MASS=1, CM=2, VX=1\nMARKER/2, POINT_MASS=2\n"
    deck += "VFORCE/1, I=2, J_PART=1, FX=-1E6*DX(2)\nEND\n"
    results = ended_early(with_integrator(deck, "VERLET, HINIT=0.1"))
    assert results.outcome is Outcome.UNSTABLE
    assert reason(results) == (
        "At t = 0, in step 1 of size 0.1 and order 2; stable are steps up to 0.00186."
    )


def test_a_branch_that_chatters_is_named_with_time_and_step():
    deck = GROUND + "POINT_MASS/2, MASS=1, CM=2, VX=1\nMARKER/2, POINT_MASS=2\n"
    results = ended_early(deck + "VFORCE/1, I=2, J_PART=1, FX=-2*SIGN(1,VX(2))\nEND\n", error=1e-7)
    assert results.outcome is Outcome.CHATTERING
    assert re.fullmatch(rf"VFORCE/1 \(<text>:6:1\): {WHEN} and order \d\.", reason(results))
    assert results.time[-1] == pytest.approx(0.5)


def test_a_motion_that_jumps_is_named_with_time_and_quantity():
    deck = GROUND + (
        "PART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2, PART=2\nJOINT/1, TRANSLATIONAL, I=2, J=1\n"
        "MOTION/1, JOINT=1, FUNCTION=IF(TIME-0.25: 0, 0, 0.5)\nPOINT_MASS/3, MASS=1, CM=3\n"
        "MARKER/3, POINT_MASS=3\n"
    )
    results = ended_early(deck + "END\n")
    assert results.outcome is Outcome.BROKEN_MOTION
    assert reason(results) == "MOTION/1 (<text>:7:1): at t = 0.25, the displacement jumps."


def test_a_cancelled_mass_names_the_force_time_and_step():
    results = ended_early(FALLING + PRINTED + "END\n", 2.0, 20, error=1e-8)
    inert = r"POINT_MASS/2 \(<text>:5:1\), [xyz], loses its inertia"
    told = rf"VFORCE/7 \(<text>:8:1\): {WHEN} and order \d\. {inert}\."
    assert re.fullmatch(told, reason(results))


def test_a_function_of_python_that_raises():
    """The routine of VARIABLE/1 divides by zero at the start."""
    law = "VARIABLE/1, FUNCTION=USER(0)\nVFORCE/1, I=2, J_PART=1, FX=VARVAL(1)\n"
    text = FALLING.replace("END\n", "") + law + "END\n"
    deck = al.read(text, user={"VARSUB": lambda given, time: 1 / given[0]})
    results = al.simulate(deck, end=1.0, steps=2)
    assert results.outcome is Outcome.ROUTINE_FAILED
    assert re.match(r"VARIABLE/1 .* failed: ZeroDivisionError", results.message)


def test_every_outcome_is_provoked():
    files = Path(__file__).parent.glob("test_outcomes*.py")
    text = "".join(file.read_text(encoding="utf-8") for file in files)
    others = {each for each in Outcome if not each.is_requested} - {Outcome.NO_END_TIME}
    assert all(f"Outcome.{each.name}" in text for each in others)

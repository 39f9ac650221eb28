"""SENSOR: the time at which an expression reaches a value ends a simulation, or the run.

Expected times are closed forms.  A crossing is located to a hundredth of ERROR of the step in
which it is found, and positions are off by some ERROR: 1e-8 of a second and more is left.
"""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest

from adamslite import Outcome, Results, read, simulate
from adamslite.analyses.dynamics import sensors
from adamslite.analyses.session.session_state import SessionState
from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.reading.read import read_commands

METHODS = ("GSTIFF", "GSTIFF, I3", "WSTIFF", "HHT", "NEWMARK", "RADAU", "RKF45")
G = 9.80665
FALLING = """A mass falls from rest
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2
MARKER/2, POINT_MASS=2
ACCGRAV/JGRAV=-9.80665
"""
RUN = "SIMULATE/DYNAMIC, END=2, STEPS=4\nSIMULATE/DYNAMIC, END=3, STEPS=4\n"


def fall(sensor: str, method: str = "GSTIFF", error: float = 1e-8) -> Results:
    """The mass under a sensor."""
    return simulate(read(f"{FALLING}{sensor}\nINTEGRATOR/{method}, ERROR={error}\n{RUN}END\n"))


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    "condition",
    ["LE, VALUE=-1, ERROR=0, FUNCTION=DY(2,1)", "GE, VALUE=1, ERROR=0, FUNCTION=-DY(2,1)",
     "EQ, VALUE=-1, ERROR=1D-12, FUNCTION=DY(2,1)", "VALUE=1, ERROR=0, FUNCTION=DM(2,1)",
     "GE, VALUE=1, ERROR=0.1, FUNCTION=-0.1-DY(2,1)",
     "LE, VALUE=-1.1, ERROR=0.1, FUNCTION=DY(2,1)"],
)  # fmt: skip
def test_a_falling_mass_is_halted_at_its_depth(method: str, condition: str) -> None:
    """y = -g t^2/2 is -1 at t = sqrt(2/g), whichever relation watches it from whichever side."""
    results = fall(f"SENSOR/1, HALT, {condition}", method)
    assert results.outcome is Outcome.HALTED
    assert results.time[:-1].tolist() == [0.0]
    assert abs(results.time[-1] - sqrt(2 / G)) < 1e-8
    assert abs(results["POINT_MASS/2.y"][-1] + 1) < 1e-8 * 5
    assert abs(results["POINT_MASS/2.vy"][-1] + sqrt(2 * G)) < 1e-7


@pytest.mark.parametrize("method", METHODS)
def test_an_expression_of_time_is_met_exactly(method: str) -> None:
    results = fall("SENSOR/1, HALT, GE, VALUE=1.3, ERROR=0, FUNCTION=TIME", method)
    assert results.time.tolist() == [0.0, 0.5, 1.0, 1.3]


@pytest.mark.parametrize("value", [0.95, -0.95])
def test_a_window_that_is_passed_within_a_step(value: float) -> None:
    """sin(10 t) is 0.95 from below at asin(0.95)/10, -0.95 at (pi + asin(0.95))/10."""
    deck = f"""{FALLING}DIFF/1, IC=0, FUNCTION=10*DIF(2)
DIFF/2, IC=1, FUNCTION=-10*DIF(1)
SENSOR/1, HALT, VALUE={value}, ERROR=1E-7, FUNCTION=DIF(1)
INTEGRATOR/RADAU, ERROR=1E-8
{RUN}END
"""
    expected = (np.arcsin(0.95) + (pi if value < 0 else 0)) / 10
    slack = 1e-7 / (10 * sqrt(1 - 0.95**2)) + 1e-8
    assert abs(simulate(read(deck)).time[-1] - expected) < slack


@pytest.mark.parametrize("condition", ["EQ", "GE"])
def test_a_constant_that_is_not_the_value_ends_nothing(condition: str) -> None:
    results = fall(f"SENSOR/1, HALT, {condition}, VALUE=1, FUNCTION=0")
    assert results.outcome is Outcome.DONE
    assert results.time[-1] == 3.0


def test_default_error_is_a_thousandth() -> None:
    """Within 0.001 of -1 from t = sqrt(2 0.999/g) on."""
    results = fall("SENSOR/1, HALT, VALUE=-1, FUNCTION=DY(2,1)")
    assert abs(results.time[-1] - sqrt(2 * 0.999 / G)) < 1e-8


def test_what_is_never_reached_ends_nothing() -> None:
    results = fall("SENSOR/1, HALT, GE, VALUE=1, FUNCTION=DY(2,1)")
    assert results.outcome is Outcome.DONE
    assert results.time[-1] == 3.0


PENDULUM = """A pendulum of 1 m released at 1 rad from its lowest point
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=3, IP=0,0,0, QG=0.8414709848078965,-0.5403023058681398,0, REULER=1,0,0
MARKER/3, PART=2
MARKER/2, PART=2, QP=0,1,0
MARKER/4, PART=2
JOINT/1, REVOLUTE, I=2, J=1
ACCGRAV/JGRAV=-9.80665
SFORCE/1, I=4, J=1, TRANSLATION, FUNCTION=0
SENSOR/7, LE, VALUE=0, ERROR=0, RETURN, FUNCTION=DX(3,1)
INTEGRATOR/GSTIFF, ERROR=1E-9
END
"""
QUARTER = "SIMULATE/DYNAMIC, END=5, STEPS=50\n"


def quarter_period() -> float:
    """K(sin 1/2)/sqrt(g)."""
    a, b = 1.0, np.cos(0.5)
    for _ in range(8):
        a, b = (a + b) / 2, sqrt(a * b)
    return pi / (2 * a) / sqrt(G)


def test_a_pendulum_returns_at_its_lowest_point_and_continues_with_the_next_command() -> None:
    """There it loses its weight, and turns on with the speed sqrt(2 g (1 - cos 1))."""
    deck = read(PENDULUM)
    text = f"{QUARTER}DEACT/SENSOR, ID=7\nACCGRAV/JGRAV=0\nSIM/DYN, DURATION=1, STEPS=4\nSTOP\n"
    results = simulate(deck, commands=read_commands(text, deck))
    t, speed = quarter_period(), sqrt(2 * G * (1 - np.cos(1.0)))
    event = np.searchsorted(results.time, t - 1e-6)
    assert results.outcome is Outcome.DONE
    assert abs(results.time[event] - t) < 1e-8
    np.testing.assert_allclose(results.time[event:] - t, np.linspace(0, 1, 5), atol=1e-8)
    turned = -speed * np.linspace(0, 1, 5)
    np.testing.assert_allclose(results["PART/2.x"][event:], np.sin(turned), atol=1e-6)
    np.testing.assert_allclose(results["PART/2.y"][event:], -np.cos(turned), atol=1e-6)
    assert "SENSOR/7 at t = " in results.meta["sensor"]


def test_a_sensor_that_is_still_true_returns_at_once() -> None:
    deck = read(FALLING + "SENSOR/1, LE, VALUE=-1, RETURN, FUNCTION=DY(2,1)\nEND\n")
    text = "SIM/DYN, END=2, STEPS=4\nSIM/DYN, END=3, STEPS=4\nDEACT/SENS, ID=1\n"
    results = simulate(deck, commands=read_commands(text + "SIM/DYN, END=2, STEPS=2", deck))
    assert len(results.time) == 4
    assert results.time[-1] == 2.0
    assert abs(results["POINT_MASS/2.y"][-1] + 2 * G) < 0.01


def test_activate_restores_a_sensor() -> None:
    deck = read(FALLING + "SENSOR/1, LE, VALUE=-1, ERROR=0, HALT, FUNCTION=DY(2,1)\nEND\n")
    text = (
        "DEACT/SENSOR, ID=1\nSIM/DYN, END=0.2, STEPS=1\nACT/SENSOR, ID=1\nSIM/DYN, END=3, STEPS=1"
    )
    results = simulate(deck, commands=read_commands("INTEG/ERROR=1E-8\n" + text, deck))
    assert len(results.time) == 3
    assert abs(results.time[-1] - sqrt(2 / G)) < 1e-8


def test_the_first_of_several_sensors_decides_and_halt_wins() -> None:
    late = "SENSOR/1, LE, VALUE=-2, HALT, FUNCTION=DY(2,1)\n"
    both = "SENSOR/2, LE, VALUE=-1, ERROR=0, RETURN, FUNCTION=DY(2,1)\n"
    same = "SENSOR/3, LE, VALUE=-1, ERROR=0, HALT, FUNCTION=DY(2,1)"
    results = fall(late + both + same)
    assert results.outcome is Outcome.HALTED
    assert abs(results.time[-1] - sqrt(2 / G)) < 1e-8
    assert [f"SENSOR/{n}" in results.meta["sensor"] for n in (1, 2, 3)] == [False, True, True]


@pytest.mark.parametrize("method", ["GSTIFF", "RKF45"])
def test_senval_keeps_the_time_for_later_analyses(method: str) -> None:
    """From t1 = sqrt(2/g), where y = -1 and v = -g t1, a force 2 t/t1 N on 2 kg lets v rise by
    integral (t/t1) dt; before, SENVAL is 0 and the force too.  It outlives DEACTIVATE.
    """
    force = "IF(SENVAL(1):0,0,2*TIME/SENVAL(1))"
    deck = read(
        f"{FALLING}SENSOR/1, LE, VALUE=-1, ERROR=0, RETURN, EVALUATE=TIME\\ FUNCTION=DY(2,1)\n"
        f"VARIABLE/1, FUNCTION=SENVAL(1)\nSFORCE/1, I=2, J=1, TRANSLATION, ACTIONONLY, FUNCTION=0\n"
        f"VFORCE/1, I=2, JFLOAT=5, RM=1, FX=0\\ FY={force}\\ FZ=0\nMARKER/5, PART=1, FLOATING\n"
        f"INTEGRATOR/{method}, ERROR=1E-9\nEND\n"
    )
    text = "SIM/DYN, END=3, STEPS=3\nDEACT/SENSOR, ID=1\nSIM/DYN, DURATION=1, STEPS=2\n"
    results = simulate(deck, commands=read_commands(text, deck))
    first = sqrt(2 / G)
    assert results["VARIABLE/1"].tolist()[:-2] == [0.0, 0.0]
    np.testing.assert_allclose(results["VARIABLE/1"][-2:], first, atol=1e-8)
    t = results.time[-1]
    expected = -G * t + (t**2 - first**2) / (2 * first)
    assert abs(results["POINT_MASS/2.vy"][-1] - expected) < 1e-6


def test_a_motion_that_begins_when_a_sensor_has_triggered() -> None:
    """The disk turns by STEP5 over 0.5 s from the time at which the mass has fallen by 1 m."""
    motion = "IF(SENVAL(1):0,0,STEP5(TIME,SENVAL(1),0,SENVAL(1)+0.5,1))"
    deck = read(
        f"{FALLING}PART/3, MASS=1, CM=3, IP=1,1,1\nMARKER/3, PART=3\n"
        f"JOINT/1, REVOLUTE, I=3, J=1\nMOTION/1, JOINT=1, ROTATION, FUNCTION={motion}\n"
        "SENSOR/1, LE, VALUE=-1, ERROR=0, RETURN, EVALUATE=TIME\\ FUNCTION=DY(2,1)\n"
        "REQUEST/1, F1=AZ(3,1)\\\nINTEGRATOR/RADAU, ERROR=1E-8\nEND\n"
    )
    text = "SIM/DYN, END=3, STEPS=3\nDEACT/SENSOR, ID=1\nSIM/DYN, DURATION=0.5, STEPS=2\n"
    results = simulate(deck, commands=read_commands(text, deck))
    np.testing.assert_allclose(results["REQUEST/1.F1"], [0, 0, 0.5, 1], atol=1e-8)


@pytest.mark.parametrize(
    ("sensor", "run"),
    [
        ("FUNCTION=DY(2,1)", "INTEGRATOR/VERLET, HINIT=0.01\nSIMULATE/DYNAMIC, END=1, STEPS=4"),
        ("FUNCTION=DY(2,1)", "INTEGRATOR/HHT, HINIT=.1, HMAX=.1, HMIN=.1\nSIM/DYN, END=1, STEPS=4"),
        ("VALUE=3, FUNCTION=3", "SIMULATE/DYNAMIC, END=1, STEPS=4"),
        ("FUNCTION=DY(2,1)", "SIMULATE/STATICS, END=1, STEPS=4"),
    ],
)  # fmt: skip
def test_a_sensor_that_cannot_be_watched_is_named(sensor: str, run: str) -> None:
    with pytest.raises(UsageError, match="SENSOR/1 cannot be watched"):
        simulate(read(f"{FALLING}SENSOR/1, HALT, {sensor}\n{run}\nEND\n"))


def test_a_halted_run_is_no_failure(tmp_path, capsys) -> None:
    deck = tmp_path / "halted.adm"
    deck.write_text(f"{FALLING}SENSOR/1, HALT, LE, VALUE=-1, FUNCTION=DY(2,1)\n{RUN}END\n")
    assert main(["solve", str(deck)]) == 0
    shown = capsys.readouterr().err
    assert "SENSOR with HALT ended the run" in shown
    assert "SENSOR/1 at t = " in shown


@pytest.mark.parametrize("method", METHODS)
def test_print_adds_an_output_each_time(method: str) -> None:
    """sin(5 t) rises through 0.5 at (pi/6 + 2 n pi)/5."""
    deck = f"""{FALLING}DIFF/1, IC=0, FUNCTION=5*DIF(2)
DIFF/2, IC=1, FUNCTION=-5*DIF(1)
SENSOR/1, PRINT, GE, VALUE=0.5, ERROR=0, FUNCTION=DIF(1)
INTEGRATOR/{method}, ERROR=1E-8
SIMULATE/DYNAMIC, END=3, STEPS=3
END
"""
    results = simulate(read(deck))
    crossings = (pi / 6 + 2 * pi * np.arange(3)) / 5
    # The methods of order 2 are off by more than ERROR after three periods, NEWMARK as of order 1.
    band = {"HHT": 1e-5, "NEWMARK": 1e-4}.get(method, 1e-6)
    np.testing.assert_allclose(results.time, sorted([0, 1, 2, 3, *crossings]), atol=band)
    assert results.meta["sensor passed"].endswith("and 2 times later")
    np.testing.assert_allclose(results["DIFF/1"], np.sin(5 * results.time), atol=10 * band)


def test_the_output_step_changes() -> None:
    results = fall("SENSOR/1, DT=0.2, GE, VALUE=1.3, ERROR=0, FUNCTION=TIME")
    expected = [0, 0.5, 1.0, 1.5, 1.7, 1.9, 2.0, 2.25, 2.5, 2.75, 3.0]
    np.testing.assert_allclose(results.time, expected, atol=1e-12)
    np.testing.assert_allclose(results["POINT_MASS/2.y"], -G * results.time**2 / 2, rtol=1e-7)


@pytest.mark.parametrize("step", ["", ", STEPSIZE=1E-4"])
def test_a_value_is_kept_while_the_analysis_continues(step: str) -> None:
    """A thrust of twice the weight from y = -1 on, there at t1: y = -1 - v t + g t^2/2."""
    deck = f"""{FALLING}SENSOR/1, EVALUATE=4*{G}\\, LE, VALUE=-1, ERROR=0, FUNCTION=DY(2,1){step}
VFORCE/1, I=2, J_PART=1, FX=0\\FY=SENVAL(1)\\FZ=0
INTEGRATOR/GSTIFF, ERROR=1E-8
SIMULATE/DYNAMIC, END=1, STEPS=20
END
"""
    results = simulate(read(deck))
    first, t = sqrt(2 / G), results.time
    late = np.maximum(t - first, 0.0)
    expected = np.where(t < first, -G * t**2 / 2, -1 - sqrt(2 * G) * late + G * late**2 / 2)
    np.testing.assert_allclose(results["POINT_MASS/2.y"], expected, atol=1e-6)
    assert len(t) == 21


def test_one_that_ends_and_one_that_continues() -> None:
    results = fall(
        "SENSOR/1, PRINT, GE, VALUE=0.3, ERROR=0, FUNCTION=TIME\n"
        "SENSOR/2, HALT, GE, VALUE=0.7, ERROR=0, FUNCTION=TIME"
    )
    assert results.outcome is Outcome.HALTED
    np.testing.assert_allclose(results.time, [0, 0.3, 0.5, 0.7], atol=1e-12)


def test_one_that_is_true_from_the_start_acts_once() -> None:
    results = fall("SENSOR/1, PRINT, GE, VALUE=-1, ERROR=0, FUNCTION=TIME")
    assert results.time.tolist() == [0, 0.5, 1, 1.5, 2, 2.25, 2.5, 2.75, 3]


ENDLESS = r"""A mass that two sensors push to and fro
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
MARKER/5, PART=1, FLOATING
POINT_MASS/2, MASS=1
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, JFLOAT=5, RM=1, FX=0\ FY=IF(SENVAL(1)-SENVAL(2)-0.5:-1,-1,1)\ FZ=0
SENSOR/1, LE, VALUE=-0.01, ERROR=0, EVALUATE=1+SENVAL(2)\ FUNCTION=VY(2,1)
SENSOR/2, GE, VALUE={above}, ERROR=0, EVALUATE=SENVAL(1)\ FUNCTION=VY(2,1)
SIMULATE/DYNAMICS, END=0.05, STEPS=1
SIMULATE/DYNAMICS, END=0.1, STEPS=1
END
"""


def test_sensors_that_act_without_a_pause_end_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """From -0.01 m/s at 0.01 s on to and fro between speeds that differ by 1e-7 m/s, at 1 m/s^2:
    a million times in a tenth of a second.  5e-4 m/s apart they act two hundred times.
    """
    monkeypatch.setattr(sensors, "ENDLESS", 60)
    results = simulate(read(ENDLESS.format(above="-0.0099999")))
    assert results.outcome is Outcome.CHATTERING
    assert "SENSOR/" in results.message and "acts again at once: at t = 0.01" in results.message
    assert results.time[-1] == pytest.approx(0.01, abs=1e-4)
    slow = simulate(read(ENDLESS.format(above="-0.0095")))
    assert slow.outcome is Outcome.DONE and slow.time[-1] == 0.1
    assert "SENSOR/1 at t = 0.01" in slow.meta["sensor passed"]


def test_a_sensor_whose_value_stays_compiles_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """EVALUATE=0 leaves SENVAL as it is: the same model goes on."""
    changed: list[object] = []
    monkeypatch.setattr(SessionState, "change", lambda self, deck: changed.append(deck))
    results = fall("SENSOR/1, LE, VALUE=-1, ERROR=0, EVALUATE=0\\ FUNCTION=DY(2,1)\n"
                   "VARIABLE/1, FUNCTION=SENVAL(1)")  # fmt: skip
    assert results.time[-1] == 3.0 and not changed


def test_a_sensor_asks_for_no_more_outputs_than_there_may_be() -> None:
    with pytest.raises(UsageError, match="SENSOR/1: there may be 1e.08 output steps; a longer DT"):
        fall("SENSOR/1, LE, VALUE=-1, ERROR=0, DT=1E-9, FUNCTION=DY(2,1)")


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU", "RKF45"))
@pytest.mark.parametrize("of", ("TIME", "DX(2,1)"))
@pytest.mark.parametrize("apart", [0.0, 5e-14, -9e-14, 1e-12, -1e-9])
def test_two_sensors_at_nearly_the_same_time_both_act(method: str, of: str, apart: float) -> None:
    """A mass at 1 m/s from x = 0: x is the time."""
    deck = f"""\
two sensors
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, VX=1
MARKER/2, POINT_MASS=2
SENSOR/1, GE, VALUE=0.5123, ERROR=0, FUNCTION={of}
SENSOR/2, GE, VALUE={0.5123 + apart!r}, ERROR=0, FUNCTION={of}
END
"""
    results = simulate(read(deck), end=1.0, steps=10, integrator=method, error=1e-6)
    assert results.outcome is Outcome.DONE, results.message
    for sensor in ("SENSOR/1", "SENSOR/2"):
        assert results.meta["sensor passed"].count(f"{sensor} at t = 0.5") == 1
    assert "later" not in results.meta["sensor passed"]


PEAK = """A mass on a spring, its sensor just below a peak
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, QG={start}, 0, 0
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=-{stiffness}*DX(2)
SENSOR/1, FUNCTION={function}\\, VALUE={value}, ERROR={error}, {relation}, HALT
SIMULATE/DYNAMIC, END={end}, STEPS={steps}
END
"""


@pytest.mark.numerical
@pytest.mark.parametrize("method", ["ABAM", "RKF45", "AUTO", "RADAU", "GSTIFF"])
def test_a_value_just_below_a_peak_is_met(method: str) -> None:
    """x = A cos wt, v = -A w sin wt and x'' = -w^2 x come within 1e-5 to 1e-2 of the amplitude of
    the value; long steps of the explicit formula pass the peak whole.
    """
    rng = np.random.default_rng(5)
    for _ in range(12):
        w, a = 10 ** rng.uniform(0, 1.5), 10 ** rng.uniform(-1, 1)
        share = 1 - 10 ** rng.uniform(-5, -2)
        relation = str(rng.choice(["GE", "LE", "EQ"]))
        sign, end, steps = -1 if relation == "LE" else 1, 7.0 / w, int(rng.choice([1, 3, 30]))
        way = int(rng.integers(3))
        top = a * w**way
        first = pi * (1.5 if sign > 0 else 0.5) if way == 1 else pi
        start = a if way == 1 else sign * a * (way - 1)
        deck = PEAK.format(
            start=start, stiffness=w * w, function=("DX(2)", "VX(2)", "ACCX(2)")[way],
            value=sign * share * top, error=1e-9 * top, relation=relation, end=end, steps=steps,
        )  # fmt: skip
        for error in (1e-6, 1e-8):
            results = simulate(deck, integrator=method, error=error)
            assert results.outcome is Outcome.HALTED
            wide = np.arccos(share) / w
            time = first / w - wide
            # A value off by e of the amplitude moves the time by e/(w sqrt(2 (1 - share))).
            off = 30 * error / (a if method == "GSTIFF" else top)
            assert abs(results.time[-1] - time) < 0.05 * wide + off / (w * wide * w)


def test_auto_chooses_a_method_that_locates_sensors() -> None:
    """Equal steps of VERLET would suit the mass, but watch no sensor."""
    deck = PEAK.format(
        start=1, stiffness=100, function="VX(2)", value=9, error=0, relation="GE", end=1, steps=100
    )
    results = simulate(deck, integrator="AUTO")
    assert results.outcome is Outcome.HALTED
    assert abs(results.time[-1] - (1.5 * pi - np.arccos(0.9)) / 10) < 1e-3

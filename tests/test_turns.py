"""Whole turns of AX, AY and AZ belong to the markers, whatever becomes of the expressions.

A wheel turns at a constant rate w; its angle is w t, beyond half a turn, before and after sensors
and commands have changed what depends on it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from adamslite import Results, read
from adamslite.analyses.simulation import simulate
from adamslite.outputs.saved_files import SavedFiles
from adamslite.reading.read import read_commands

METHODS = ("GSTIFF", "GSTIFF, I3", "WSTIFF", "HHT", "NEWMARK", "RADAU", "RKF45", "ABAM")
RATES = (12.0, -12.0, 5.0)


def wheel(
    lines: str, rate: float, method: str = "RADAU", commands: str = "", files: Any = None
) -> Results:
    """A wheel on the ground with a few more lines, over 2 s or by commands."""
    deck = read(
        f"""A wheel
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1, WZ={rate}
MARKER/2, PART=2
PART/3, MASS=1, CM=3, IP=1,1,1
MARKER/3, PART=3
JOINT/1, REVOLUTE, I=2, J=1
JOINT/2, REVOLUTE, I=3, J=1
{lines}
INTEGRATOR/{method}, ERROR=1E-8
{"" if commands else "SIMULATE/DYNAMIC, END=2, STEPS=4"}
END
"""
    )
    if not commands:
        return simulate(deck)
    return simulate(deck, commands=read_commands(commands, deck), files=files)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    "watched", ["FUNCTION=TIME\\, VALUE=1.5", "FUNCTION=ABS(AZ(2,1))\\, VALUE={}"]
)
@pytest.mark.parametrize("rate", RATES)
def test_an_angle_times_senval(method: str, watched: str, rate: float) -> None:
    """SENVAL is 1 from t = 1.5 on: the integral of SENVAL w t to 2 is w (2^2 - 1.5^2)/2.

    NEWMARK integrates the angle itself over 2 s, without a sensor, to 2e-5 of the integral.
    """
    sensor = watched.format(abs(rate) * 1.5)
    results = wheel(
        f"SENSOR/1, {sensor}, ERROR=0, GE, EVALUATE=1\n"
        "VARIABLE/1, FUNCTION=AZ(2,1)\nVARIABLE/2, FUNCTION=SENVAL(1)\n"
        "VARIABLE/3, FUNCTION=SENVAL(1)*AZ(1,2)\n"
        "DIFF/1, FUNCTION=SENVAL(1)*AZ(2,1)\nDIFF/2, FUNCTION=VARVAL(2)*VARVAL(1)\n"
        "DIFF/3, FUNCTION=IF(SENVAL(1): 0, 0, AZ(2,1))\n"
        "SFORCE/1, ROTATIONAL, ACTIONONLY, I=3, J=1, FUNCTION=SENVAL(1)*AZ(2,1)",
        rate,
        method,
    )
    expected = rate * (2**2 - 1.5**2) / 2
    error = 2e-5 * abs(expected) if method == "NEWMARK" else 1e-5
    for name in ("DIFF/1", "DIFF/2", "DIFF/3", "PART/3.wz"):
        assert abs(results[name][-1] - expected) < error, name
    assert abs(results["VARIABLE/3"][-1] + 2 * rate) < 1e-5


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize(
    "after",
    ["AZ(2,1)+0*TIME", "2*AZ(2,1)-AZ(2,1)", "-AZ(1,2)+SIN(0*WZ(2,1))", "AZ(2,1)*COS(0*AX(2,1))"],
)
def test_a_redefined_expression_goes_on_with_its_turns(after: str, rate: float) -> None:
    """The same angle in other words, as a value and as a torque on a second wheel."""
    results = wheel(
        "VARIABLE/1, FUNCTION=AZ(2,1)\nVARIABLE/2, FUNCTION=AZ(1,2)\n"
        "SFORCE/1, ROTATIONAL, ACTIONONLY, I=3, J=1, FUNCTION=AZ(2,1)",
        rate,
        commands="SIM/DYN, END=1.5, STEPS=2\n"
        f"VARIABLE/1, FUNCTION={after}\nSFORCE/1, FUNCTION={after}\nSIM/DYN, END=2, STEPS=2\n",
    )
    np.testing.assert_allclose(results["VARIABLE/1"], rate * results.time, atol=1e-6)
    np.testing.assert_allclose(results["PART/3.wz"], rate * results.time**2 / 2, atol=1e-6)


def test_a_new_expression_shares_the_turns_of_an_old_one() -> None:
    """What a request already counts a torque that is new finds."""
    results = wheel(
        "REQUEST/1, F1=AZ(2,1)\\\nVARIABLE/1, FUNCTION=0\n"
        "SFORCE/1, ROTATIONAL, ACTIONONLY, I=3, J=1, FUNCTION=0",
        12.0,
        commands="SIM/DYN, END=1.5, STEPS=2\nVARIABLE/1, FUNCTION=AZ(2,1)\n"
        "SFORCE/1, FUNCTION=AZ(2,1)\nSIM/DYN, END=2, STEPS=2\n",
    )
    assert abs(results["VARIABLE/1"][-1] - 24) < 1e-6
    assert abs(results["PART/3.wz"][-1] - 10.5) < 1e-6


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize(
    ("first", "factor"), [("", 0), ("SIM/DYN, END=0.5, STEPS=2\n", 0.5**2 / 2)]
)
def test_what_is_switched_off_counts_on(first: str, factor: float, rate: float) -> None:
    """A torque w t acts up to 0.5 s or not at all, and again from 1.5 s to 2 s."""
    results = wheel(
        "SFORCE/1, ROTATIONAL, ACTIONONLY, I=3, J=1, FUNCTION=AZ(2,1)",
        rate,
        commands=f"{first}DEACTIVATE/SFORCE, ID=1\nSIM/DYN, END=1.5, STEPS=2\n"
        "ACTIVATE/SFORCE, ID=1\nSIM/DYN, END=2, STEPS=2\n",
    )
    expected = rate * (factor + (2**2 - 1.5**2) / 2)
    assert abs(results["PART/3.wz"][-1] - expected) < 1e-6


def test_a_sensor_switched_off_counts_on() -> None:
    """21 rad at 12 rad/s are reached at 1.75 s."""
    results = wheel(
        "SENSOR/1, FUNCTION=AZ(2,1)\\, VALUE=21, ERROR=0, GE, HALT",
        12.0,
        commands="DEACTIVATE/SENSOR, ID=1\nSIM/DYN, END=1.5, STEPS=2\n"
        "ACTIVATE/SENSOR, ID=1\nSIM/DYN, END=2, STEPS=2\n",
    )
    assert abs(results.time[-1] - 1.75) < 1e-8


AWAY = (
    ("AZ(2,1)", "0", "AZ(2,1)"),
    ("AZ(2,1)", "AZ(3,1)", "-AZ(1,2)"),
    ("ORIENT(26,3,2,1)", "SIN(TIME)", "AZ(2,1)"),
    ("2*AZ(2,1)", "AZ(1,3)", "AZ(2,1)+0*WZ(2,1)"),
)


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize(("before", "between", "after"), AWAY)
def test_an_angle_that_is_taken_away_comes_back_with_its_turns(
    before: str, between: str, after: str, rate: float
) -> None:
    """Nothing but VARIABLE/1 has the angle, and from 1.5 s to 1.7 s not even that."""
    function = "VARIABLE/1, FUNCTION="
    results = wheel(
        f"{function}{before}", rate,
        commands=f"SIM/DYN, END=1.5, STEPS=2\n{function}{between}\nSIM/DYN, END=1.6, STEPS=1\n"
        f"{function}{between}+0\nSIM/DYN, END=1.7, STEPS=1\n{function}{after}\n"
        "SIM/DYN, END=2, STEPS=2\n",
    )  # fmt: skip
    assert abs(results["VARIABLE/1"][-1] - 2 * rate) < 1e-6


@pytest.mark.parametrize("request_", ["", "REQUEST/1, F1=AZ({new},1)\\\n"])
@pytest.mark.parametrize(("old", "new", "value"), [(2, 3, 0.0), (3, 2, 24.0)])
def test_another_angle_has_turns_of_its_own(
    old: int, new: int, value: float, request_: str
) -> None:
    """What takes the place of another angle neither takes its turns nor begins anew."""
    function = "VARIABLE/1, FUNCTION=AZ({},1)\n"
    results = wheel(
        function.format(old) + request_.format(new=new), 12.0,
        commands=f"SIM/DYN, END=1.5, STEPS=2\n{function.format(new)}SIM/DYN, END=2, STEPS=2\n",
    )  # fmt: skip
    assert abs(results["VARIABLE/1"][-1] - value) < 1e-6


def test_turns_of_two_angles_that_are_taken_away_come_back_with_a_file(tmp_path: Path) -> None:
    """Both are saved while no statement has either, 18 rad and -18 rad, and used in another run."""
    function = "VARIABLE/1, FUNCTION="
    lines = f"{function}AZ(2,1)\nVARIABLE/2, FUNCTION=AZ(1,2)"
    first = (
        f"SIM/DYN, END=1.5, STEPS=2\n{function}0\nVARIABLE/2, FUNCTION=0\n"
        "SAVE/SYSTEM, FILE=turns\nSIM/DYN, END=2, STEPS=2\n"
    )
    again = f"RELOAD/SYSTEM, FILE=turns\nVARIABLE/2, FUNCTION=AZ(2,1)\n{function}AZ(1,2)\n"
    again += "SIM/DYN, END=1.6, STEPS=2\n"
    for commands in (first + again, again):
        results = wheel(lines, 12.0, commands=commands, files=SavedFiles(tmp_path))
        assert abs(results["VARIABLE/1"][-1] + 19.2) < 1e-6
        assert abs(results["VARIABLE/2"][-1] - 19.2) < 1e-6


@pytest.mark.parametrize("element", ["JOINT, ID=5", "COUPLER, ID=1", "GEAR, ID=1"])
def test_constraints_that_count_turns_count_on_while_they_are_switched_off(element: str) -> None:
    """A nut on a screw, and two pairs of wheels, move as if they were held; nothing is to be moved
    when they are held again, after five turns.
    """
    speed = 3.0 / np.pi
    results = wheel(
        f"PART/4, MASS=1, CM=4, IP=1,1,1, WZ=6, VZ={speed}\nMARKER/4, PART=4\n"
        "JOINT/4, CYLINDRICAL, I=4, J=1\nJOINT/5, SCREW, I=4, J=1, PITCH=1\n"
        "MARKER/6, PART=1, QP=-0.5,0,0, REULER=0,90D,0\nMARKER/7, PART=1, QP=-1.5,0,0\n"
        "PART/7, MASS=1, CM=8, IP=1,1,1, QG=-1.5,0,0, WZ=-6\nMARKER/8, PART=7\n"
        "JOINT/7, REVOLUTE, I=8, J=7\nCOUPLER/1, JOINTS=1,7, TYPE=R:R, SCALES=2\n"
        "GEAR/1, JOINTS=1,7, CV=9\nMARKER/9, PART=1, QP=-0.5,0,0, REULER=0,90D,0",
        12.0,
        commands="DEACTIVATE/JOINT, ID=5\nDEACTIVATE/COUPLER, ID=1\nDEACTIVATE/GEAR, ID=1\n"
        f"SIM/DYN, END=2.6, STEPS=2\nACTIVATE/{element}\nSIM/DYN, END=3, STEPS=2\n",
    )
    np.testing.assert_allclose(results["PART/4.z"], speed * results.time, atol=1e-6)
    turned = np.unwrap(results["PART/7.psi"], period=2 * np.pi)
    np.testing.assert_allclose(np.cos(turned + 6 * results.time), 1, atol=1e-9)


def test_turns_counted_while_switched_off_come_back_with_a_state() -> None:
    """RELOAD into the model as it is now, where the torque acts: 10.5 once more."""
    again = "ACTIVATE/SFORCE, ID=1\nSIM/DYN, END=2, STEPS=2\n"
    results = wheel(
        "SFORCE/1, ROTATIONAL, ACTIONONLY, I=3, J=1, FUNCTION=AZ(2,1)",
        12.0,
        commands="DEACTIVATE/SFORCE, ID=1\nSIM/DYN, END=1.5, STEPS=2\nSAVE/STATES, BUFFER=1\n"
        f"{again}RELOAD/STATES, BUFFER=1\n{again}",
    )
    assert abs(results["PART/3.wz"][-1] - 10.5) < 1e-6


def test_states_put_into_a_changed_model_bring_their_turns() -> None:
    """From 48 rad at 4 s back to 18 rad at 1.5 s, in a model that has another expression."""
    results = wheel(
        "VARIABLE/1, FUNCTION=AZ(2,1)",
        12.0,
        commands="SIM/DYN, END=1.5, STEPS=2\nSAVE/STATES, BUFFER=1\nSIM/DYN, END=4, STEPS=2\n"
        "VARIABLE/1, FUNCTION=AZ(2,1)+0*TIME\nRELOAD/STATES, BUFFER=1\nSIM/DYN, END=2, STEPS=2\n",
    )
    assert results.time[-1] == 2.0
    assert abs(results["VARIABLE/1"][-1] - 24) < 1e-6


def test_inclination_followed_past_pi_goes_on() -> None:
    """INCANG counts on where the product with SENVAL comes to be."""
    results = wheel(
        "MARKER/4, PART=1, QP=1,0,0\nMARKER/5, PART=2, QP=1,0,0\n"
        "SENSOR/1, FUNCTION=TIME\\, VALUE=1.5, ERROR=0, GE, EVALUATE=1\n"
        "VARIABLE/1, FUNCTION=INCANG(5,1,4)\nVARIABLE/2, FUNCTION=SENVAL(1)*INCANG(5,1,4)",
        3.0,
    )
    assert abs(abs(results["VARIABLE/2"][-1]) - 6) < 1e-6
    assert results["VARIABLE/1"][-1] == results["VARIABLE/2"][-1]

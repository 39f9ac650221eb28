"""DELAY: values of the past, against closed forms and an independent method of steps."""

from __future__ import annotations

from math import factorial

import numpy as np
import pytest
from tiers import fast

import adamslite as al
from adamslite.errors import UsageError
from adamslite.reading.read import read_commands

HEAD = "a delay\nPART/1, GROUND\nMARKER/1\nPOINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\n"


def run(text: str, method: str = "RADAU", end: float = 5.0, error: float = 1e-7) -> al.Results:
    results = al.simulate(
        al.read(f"{HEAD}{text}\nEND\n"), end=end, steps=50, integrator=method, error=error
    )
    assert results.outcome is al.Outcome.DONE
    assert "delay" not in results.meta
    return results


def steps_of_decay(rate: float, delay: float, start: float, times: np.ndarray) -> np.ndarray:
    """s' = -rate s(t - delay), s = start until 0: a polynomial that gains a term every delay."""
    found = np.zeros(len(times))
    for k in range(int(times[-1] / delay) + 2):
        later = np.maximum(times - (k - 1) * delay, 0.0) if k else np.ones(len(times))
        found += start * (-rate * later) ** k / factorial(k)
    return found


@pytest.mark.parametrize("method", fast(["RADAU", "GSTIFF", "HHT", "ABAM"], "RADAU", "GSTIFF"))
@pytest.mark.parametrize(("rate", "delay", "start"), [(1.0, 1.0, 1.0), (-0.7, 0.45, -3.0)])
def test_decay_by_a_delayed_state(method: str, rate: float, delay: float, start: float) -> None:
    """s' = -rate s(t - delay)."""
    results = run(f"DIFF/1, IC={start}, FUNCTION=-({rate})*DELAY(DIF(1),{delay},{start})", method)
    exact = steps_of_decay(rate, delay, start, results.time)
    band = {"HHT": 5e-5, "GSTIFF": 2e-5}.get(method, 1e-8)
    np.testing.assert_allclose(results["DIFF/1"], exact, rtol=0, atol=band * np.abs(exact).max())


def test_a_delayed_function_of_time() -> None:
    """SIN(2 TIME) 0.53 s ago, 7 before; delayed once more, and in one go."""
    results = run(
        "VARIABLE/1, FUNCTION=DELAY(SIN(2*TIME),0.53,7)\n"
        "VARIABLE/2, FUNCTION=DELAY(VARVAL(1),0.3,-1)\nVARIABLE/3, FUNCTION=DELAY(TIME,9)"
    )
    t = results.time
    late, later = t > 0.53, t > 0.83
    np.testing.assert_allclose(results["VARIABLE/1"][late], np.sin(2 * (t[late] - 0.53)), atol=1e-9)
    np.testing.assert_allclose(results["VARIABLE/1"][~late], 7.0)
    np.testing.assert_allclose(
        results["VARIABLE/2"][later], np.sin(2 * (t[later] - 0.83)), atol=1e-9
    )
    np.testing.assert_allclose(results["VARIABLE/2"][(t > 0.3) & ~later], 7.0)
    np.testing.assert_allclose(results["VARIABLE/2"][t < 0.29], -1.0)
    np.testing.assert_allclose(results["VARIABLE/3"], 0.0)


def by_runge_kutta(gain: float, delay: float, times: np.ndarray, h: float = 2.5e-3) -> np.ndarray:
    """x'' = -4 x + gain x'(t - delay), x = 1, x' = 0 until 0, by steps of order 4, the
    middle of a past step from the cubic through its ends.
    """
    n = round(delay / h)
    x, v, a = [1.0], [0.0], []
    for i in range(int(np.ceil(times[-1] / h)) + 1):
        past = [0.0, 0.0, 0.0]  # at the start, in the middle, at the end of the step
        if i >= n:
            k = i - n
            middle = (
                0.5 * (v[k] + v[k + 1]) + 0.125 * h * (a[k] - a[k + 1]) if k + 1 < len(a) else 0.0
            )
            past = [v[k], middle, v[k + 1]]
        force = [gain * each for each in past]
        a.append(-4 * x[-1] + force[0])
        k1 = (v[-1], -4 * x[-1] + force[0])
        k2 = (v[-1] + h / 2 * k1[1], -4 * (x[-1] + h / 2 * k1[0]) + force[1])
        k3 = (v[-1] + h / 2 * k2[1], -4 * (x[-1] + h / 2 * k2[0]) + force[1])
        k4 = (v[-1] + h * k3[1], -4 * (x[-1] + h * k3[0]) + force[2])
        x.append(x[-1] + h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]))
        v.append(v[-1] + h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1]))
    return np.array(x)[np.rint(times / h).astype(int)]


@pytest.mark.parametrize(("gain", "delay"), [(-0.5, 0.4), (0.8, 1.1)])
def test_an_oscillator_damped_or_driven_by_its_past_velocity(gain: float, delay: float) -> None:
    """x'' = -4 x + gain x'(t - delay), x(0) = 1."""
    deck = f"VFORCE/1, I=2, J_PART=1, FX=-4*DX(2)+({gain})*DELAY(VX(2),{delay},0)\\FY=0\\FZ=0"
    moved = HEAD.replace("CM=2", "CM=2, QG=1,0,0")
    results = al.simulate(
        al.read(f"{moved}{deck}\nEND\n"), end=5.0, steps=50, error=1e-8, integrator="RADAU"
    )
    exact = by_runge_kutta(gain, delay, results.time)
    np.testing.assert_allclose(results["POINT_MASS/2.x"], exact, rtol=0, atol=1e-7)


def test_a_run_in_two_commands_is_the_run_in_one() -> None:
    """The past lasts from one SIMULATE to the next."""
    deck = al.read(
        f"{HEAD}DIFF/1, IC=1, FUNCTION=-DELAY(DIF(1),1,1)\nINTEGRATOR/RADAU, ERROR=1E-8\n"
        "SIMULATE/DYNAMIC, END=1.7, STEPS=17\nSIMULATE/DYNAMIC, END=4, STEPS=23\nEND\n"
    )
    results = al.simulate(deck)
    exact = steps_of_decay(1.0, 1.0, 1.0, results.time)
    np.testing.assert_allclose(results["DIFF/1"], exact, rtol=0, atol=1e-9)
    assert len(results.time) == 41


def test_a_past_that_jumps_is_reported() -> None:
    """No cubic follows IF: the error of what is kept of it is larger than ERROR."""
    deck = f"{HEAD}VARIABLE/1, FUNCTION=DELAY(IF(TIME-1.234:0,0,1),0.7)\nEND\n"
    results = al.simulate(al.read(deck), end=3.0, steps=30)
    assert "DELAY(IF(" in results.meta["delay"]
    late = results.time > 2.1
    np.testing.assert_allclose(results["VARIABLE/1"][late], 1.0, atol=1e-2)


@pytest.mark.parametrize(
    "command", ["SIMULATE/INITIAL\nLINEAR/EIGENSOL", "SIMULATE/KINEMATICS, END=1, STEPS=3"]
)
def test_what_has_no_past_is_rejected(command: str) -> None:
    deck = al.read(f"{HEAD}VARIABLE/1, FUNCTION=DELAY(TIME,1)\nJPRIM/1, INLINE, I=2, J=1\nEND\n")
    commands = read_commands(f"{command}\nSTOP\n", deck)
    with pytest.raises(UsageError, match="cannot be computed with DELAY"):
        al.simulate(deck, commands=commands)


@pytest.mark.parametrize(
    ("call", "reason"),
    [
        ("DELAY(DX(2),-1)", "greater than 0"),
        ("DELAY(DX(2),0)", "greater than 0"),
        ("DELAY(DX(2),TIME)", "must be a number"),
        ("DELAY(DX(2),1,DX(2))", "must be a number"),
    ],
)
def test_a_delay_is_a_positive_number(call: str, reason: str) -> None:
    with pytest.raises(al.DeckError, match=reason):
        al.read(f"{HEAD}VARIABLE/1, FUNCTION={call}\nEND\n")

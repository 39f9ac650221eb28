"""What a run says about its own accuracy: errors that add up, steps near a bound, divided steps."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scenes import GROUND, done

import adamslite as al
from adamslite.analyses.dynamics.dynamic import Settings
from adamslite.analyses.dynamics.history import History, Piece
from adamslite.analyses.findings.accuracy_notes import _added_up
from adamslite.analyses.findings.standstill import largest_travel
from adamslite.deck.python_routine import reads
from adamslite.results.run_error import error_of

METHODS = ("GSTIFF", "HHT", "NEWMARK", "RADAU", "ABAM", "VERLET", "AUTO")


def spring(stiffness: float, start: float) -> str:
    """1 kg on a spring to the origin, let go at x = start: x = start cos(w t), w^2 = stiffness."""
    return (
        GROUND
        + f"POINT_MASS/2, MASS=1, CM=2, QG={start},0,0\nMARKER/2, POINT_MASS=2\n"
        + f"VFORCE/1, I=2, J_PART=1, FX=-{stiffness}*DX(2)\nEND\n"
    )


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("stiffness", "start", "end"), [(1e5, 0.5, 5.0), (2.5e3, 0.02, 20.0)], ids=["stiff", "small"]
)
def test_errors_that_add_up_are_told(method: str, stiffness: float, start: float, end: float):
    """Off by more than 1e-3 of the way (twice the amplitude), a run says so."""
    results = done(spring(stiffness, start), end, 200, integrator=method, error=1e-6)
    truth = start * np.cos(math.sqrt(stiffness) * results.time)
    off = np.abs(results["POINT_MASS/2.x"] - truth).max() / (2 * start)
    note = results.meta.get("accuracy", "")
    assert off < 1e-3 or "estimated global error" in note
    if note:
        assert off > 1e-4
        assert float(note.split()[3]) == pytest.approx(off * 2 * start, rel=0.5)


def test_a_formula_has_one_order():
    """GAMMA=0.7 of NEWMARK damps at the price of the second order."""
    note = done(spring(1.0, 1.0), 9.0, 10, integrator="NEWMARK", error=1e-6).meta["accuracy"]
    assert "the formula is of order 1" in note and "the formula is of order 2" not in note


@pytest.mark.parametrize(("speed", "told"), [(0.0, True), (50.0, False)])
def test_vibrations_are_damped_where_they_carry_energy(speed: float, told: bool):
    """A vibration of 20 mm at 20 rad/s, 0.4 m/s, in a run that goes at 50 m/s or not at all."""
    deck = GROUND + (
        f"POINT_MASS/2, MASS=1000, CM=2, VX={speed}\nMARKER/2, POINT_MASS=2\n"
        f"POINT_MASS/3, MASS=1, CM=3, QG=1.02,0,0, VX={speed}\nMARKER/3, POINT_MASS=3\n"
        "SPRINGDAMPER/1, TRANSLATIONAL, I=3, J=2, K=400, LENGTH=1\nEND\n"
    )
    note = done(deck, 20.0, 40, integrator="HHT", error=1e-3).meta["accuracy"]
    assert "estimated global error" in note and ("damped, not followed" in note) == told


@pytest.mark.parametrize("error", [1e-3, 1e-6])
def test_a_formula_that_errs_little_has_no_order(error: float):
    """A mass that falls: steps of any length are exact, and nothing is said of GAMMA."""
    deck = GROUND + "ACCGRAV/JGRAV=-9.81\nPOINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\nEND\n"
    results = done(deck, 1.0, 10, integrator="NEWMARK", error=error)
    assert results["POINT_MASS/2.y"][-1] == pytest.approx(-4.905)
    assert "accuracy" not in results.meta


@pytest.mark.parametrize("method", ("GSTIFF", "RADAU", "ABAM"))
def test_a_short_run_says_nothing(method: str):
    """A period of 2 pi, 1e-6 allowed in a step: some hundred steps at most, 1e-4 of the way."""
    results = done(spring(1.0, 1.0), 2 * math.pi, 20, integrator=method, error=1e-6)
    assert "accuracy" not in results.meta


@pytest.mark.parametrize("error", [1.0, 1e-3])
@pytest.mark.parametrize("method", ["HHT", "CONSTANT_BDF"])
def test_equal_steps_do_not_depend_on_error(method: str, error: float):
    """A pendulum of 1 kg on a spring of 1e5 N/m: with ERROR = 1 the corrector still converges."""
    deck = (
        GROUND + "ACCGRAV/JGRAV=-9.81\nPOINT_MASS/2, MASS=1, CM=2, QG=1,0,0\n"
        "MARKER/2, POINT_MASS=2\n"
        "SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=1E5, LENGTH=1\n"
        f"INTEGRATOR/{method}, HINIT=1E-3, HMIN=1E-3, HMAX=1E-3, ERROR={error}\nEND\n"
    )
    results, tight = done(deck, 1.0, 10), done(deck, 1.0, 10, error=1e-8)
    assert results.summary["steps"] == tight.summary["steps"]
    for name in ("POINT_MASS/2.x", "POINT_MASS/2.y"):
        np.testing.assert_allclose(results[name], tight[name], atol=2e-3)


def test_divided_steps_are_told():
    """The same pendulum in steps of 10 ms: some take more than two iterations."""
    deck = (
        GROUND + "ACCGRAV/JGRAV=-9.81\nPOINT_MASS/2, MASS=1, CM=2, QG=1,0,0\n"
        "MARKER/2, POINT_MASS=2\n"
        "SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=1E5, LENGTH=1\n"
        "INTEGRATOR/HHT, HINIT=1E-2, HMIN=1E-2, HMAX=1E-2, MAXIT={}\nEND\n"
    )
    assert "divided" not in done(deck.format(10), 1.0).meta.get("accuracy", "")
    results = done(deck.format(2), 1.0)
    assert results.summary["steps"] > 100
    assert "steps were divided" in results.meta["accuracy"]


@pytest.mark.parametrize(("mass", "stiffness"), [(1.0, 1e4), (0.25, 100.0)])
@pytest.mark.parametrize("share", [0.5, 0.9, 0.97])
def test_a_step_near_the_bound_of_stability_is_told(mass: float, stiffness: float, share: float):
    """VERLET is stable up to h = 2 sqrt(m/k) without damping; above 0.93 of that it is reported."""
    bound = 2.0 * math.sqrt(mass / stiffness)
    deck = (
        GROUND + f"POINT_MASS/2, MASS={mass}, CM=2, QG=1,0,0\nMARKER/2, POINT_MASS=2\n"
        f"VFORCE/1, I=2, J_PART=1, FX=-{stiffness}*DX(2)\n"
        f"INTEGRATOR/VERLET, HINIT={share * bound!r}\nEND\n"
    )
    note = done(deck, 10 * share * bound, 1).meta.get("accuracy", "")
    assert ("longest stable step" in note) == (share > 0.93)
    assert f"{bound:.3g}" in note or share < 0.93


@pytest.mark.parametrize("method", ("GSTIFF", "RADAU", "ABAM"))
@pytest.mark.parametrize(("push", "mass", "told"), [(400.0, 0.1, True), (400.0, 10.0, False)])
def test_round_off_that_a_push_lifts_is_told(method: str, push: float, mass: float, told: bool):
    """A mass between two walls 1 m away, pushed by both: y" = 2 P/(m l) y, 89 1/s and 9 1/s.

    From y = 1e-12 it leaves the line in 0.31 s or stays; a bound takes sqrt(2) of the rate of each.
    """
    deck = (
        GROUND + f"POINT_MASS/2, MASS={mass}, CM=2, QG=0,1E-12,0\nMARKER/2, POINT_MASS=2\n"
        "MARKER/3, PART=1, QP=-1,0,0\nMARKER/4, PART=1, QP=1,0,0\n"
        f"SFORCE/1, TRANSLATIONAL, I=2, J=3, FUNCTION={push}\n"
        f"SFORCE/2, TRANSLATIONAL, I=2, J=4, FUNCTION={push}\nEND\n"
    )
    results = done(deck, 0.4, 40, integrator=method, error=1e-8)
    left = np.abs(results["POINT_MASS/2.y"]).max() > 0.1
    assert left == told == ("pushed masses apart" in results.meta.get("accuracy", ""))


@pytest.mark.parametrize(("start", "play", "stiffness"), [(0.4, 0.07, 7000.0), (0.3, 0.1, 12000.0)])
def test_events_that_shift_one_another_are_told(start: float, play: float, stiffness: float):
    """A spring with play, 2 s: arcs of a quarter period and free flights, as often as they fit.

    In contact q = q0 cos(w t), q0 = start - play, for a half period pi/w; the gap of 2 play is
    crossed with w q0.
    """
    law = f"-{stiffness}*MAX(ABS(DX(2))-{play},0)*SIGN(1,DX(2))"
    deck = (
        GROUND
        + f"POINT_MASS/2, MASS=1, CM=2, QG={start},0,0\nMARKER/2, POINT_MASS=2\n"
        + f"VFORCE/1, I=2, J_PART=1, FX={law}\nEND\n"
    )
    results = done(deck, 2.0, 200, integrator="GSTIFF", error=1e-6)
    w, q0 = math.sqrt(stiffness), start - play
    flight = 2 * play / (w * q0)
    half = math.pi / w + flight

    def place(t: float) -> float:
        passed, t = divmod(t + math.pi / (2 * w), half)
        inside = t < math.pi / w
        x = play + q0 * math.sin(w * t) if inside else play - w * q0 * (t - math.pi / w)
        return x if passed % 2 == 0 else -x

    off = max(
        abs(x - place(t)) for t, x in zip(results.time, results["POINT_MASS/2.x"], strict=True)
    )
    assert off > 2e-4
    assert "estimated global error" in results.meta["accuracy"]
    best = done(deck, 2.0, 200, integrator="ABAM", error=1e-9)
    truth = [place(t) for t in best.time]
    assert best["POINT_MASS/2.x"] == pytest.approx(truth, abs=1e-6)
    assert "accuracy" not in best.meta


def test_few_events_of_a_motion_that_amplifies_are_told():
    """A driven trolley of 6.5 kg between springs with play, which carries a pendulum: 38 events.

    RADAU and ABAM at ERROR of 1e-10 agree within 1e-7; GSTIFF at 1e-6 is off by 1.6e-3 of the way,
    nine times the errors that it has added up.
    """
    deck = GROUND + (
        "ACCGRAV/JGRAV=-9.81\nMARKER/5, PART=1, REULER=90D,90D,-0.8169\n"
        "PART/2, MASS=6.543, CM=20, IP=6.543,6.543,6.543\n"
        "MARKER/20, PART=2, REULER=90D,90D,-0.8169\nMARKER/24, PART=2\n"
        "JOINT/1, TRANSLATIONAL, I=20, J=5, IC=0.3399,4.298\n"
        "PART/3, MASS=1.962, CM=32, IP=0.2482,0.2482,0.02482\nMARKER/30, PART=3\n"
        "MARKER/32, PART=3, QP=0,-0.616,0\nJOINT/2, REVOLUTE, I=30, J=24, IC=0.1958,1.128\n"
        "VARIABLE/1, FUNCTION=DZ(20,5,5)*1.432\n"
        "VARIABLE/3, FUNCTION=ATAN(VARVAL(1)*(1-VARVAL(1)))\n"
        "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=5, FUNCTION=-1737*DZ(20,5,5)\n"
        ", +37.97*SIN(30.42*TIME)-54.42*VARVAL(3)\n"
        ", -517.6*MAX(ABS(DZ(20,5,5))-0.1074,0)*SIGN(1,DZ(20,5,5))\nEND\n"
    )
    best, other = (done(deck, 2.613, 30, integrator=m, error=1e-10) for m in ("RADAU", "ABAM"))
    run = done(deck, 2.613, 30, integrator="GSTIFF", error=1e-6)
    assert error_of(other, best) < 1e-7
    assert error_of(run, best) > 1e-3
    assert "estimated global error" in run.meta["accuracy"]


@pytest.mark.parametrize(("size", "told"), [(2e-3, True), (30.0, False)])
def test_a_state_that_is_small_against_error_is_told(size: float, told: bool):
    """ERROR of 1e-4 is absolute below 1: a share of a small state, not of one above 1.

    s' = 20 (c sin 14 t - s) from rest: s = 20 c/596 (20 sin 14 t - 14 cos 14 t + 14 exp(-20 t)).
    """
    filtered = GROUND + (
        "POINT_MASS/2, MASS=1, CM=2, VX=1\nMARKER/2, POINT_MASS=2\n"
        f"DIFF/1, FUNCTION=20*({size}*SIN(14*TIME)-DIF(1))\nEND\n"
    )
    results = done(filtered, 2.0, 40, integrator="GSTIFF", error=1e-4)
    t = results.time
    truth = 20 * np.sin(14 * t) - 14 * np.cos(14 * t) + 14 * np.exp(-20 * t)
    off = np.abs(results["DIFF/1"] - truth * 20 * size / 596).max() / (0.8 * size)
    assert ("in DIFF/1" in results.meta.get("accuracy", "")) is told
    assert off > 1e-3 if told else off < 1e-3


def at_a_wall(force: str) -> str:
    """1.5 kg that flies at 2 m/s against a wall at x = 0, 0.31 m away."""
    return (
        GROUND + "POINT_MASS/2, MASS=1.5, CM=2, QG=0.31,0,0, VX=-2\nMARKER/2, POINT_MASS=2\n"
        f"VARIABLE/1, FUNCTION={force}\nVFORCE/1, I=2, J_PART=1, FX=VARVAL(1)\nEND\n"
    )


@pytest.mark.parametrize(
    ("method", "stiffness", "error", "told"),
    [("HHT", 1e10, 1e-3, True), ("HHT", 1e10, 1e-7, False), ("RADAU", 1e8, 1e-3, False)],
)
def test_an_impact_that_was_damped_is_told(method: str, stiffness: float, error: float, told: bool):
    """The wall gives the speed back: what is off by more than 3 % says so."""
    deck = at_a_wall(f"{stiffness}*MAX(0,-DX(2))")
    results = done(deck, 0.35, 11, integrator=method, error=error)
    assert (abs(results["POINT_MASS/2.vx"][-1] - 2) > 0.06) == told
    assert not told or "estimated global error" in results.meta.get("accuracy", "")


@pytest.mark.parametrize(
    ("stiffness", "error", "told"), [(1e11, 1e-3, True), (1e8, 1e-4, False), (1e8, 1e-7, False)]
)
def test_a_wall_that_a_routine_hides_is_told(stiffness: float, error: float, told: bool):
    """The same from Python, which says nothing about edges: RADAU damps it in long steps."""

    @reads("DX(2, 1)")
    def wall(given: tuple[float, ...], time: float, x: float) -> float:
        return given[0] * max(0.0, -x)

    deck = al.read(at_a_wall(f"USER({stiffness})"), user={"VARIABLE/1": wall})
    results = al.simulate(deck, end=0.35, steps=5, integrator="RADAU", error=error)
    assert ("estimated global error" in results.meta.get("accuracy", "")) == told
    assert (abs(results["POINT_MASS/2.vx"][-1] - 2) > 0.06) == told


@pytest.mark.parametrize(("way", "moves"), [(1e-13, False), (1e-9, True)])
def test_rounding_of_a_place_is_no_way(way: float, moves: bool) -> None:
    """A body 100 m from the origin, whose place has 14 digits."""
    history = History()
    history.extend(Piece(np.arange(2.0), ("PART/2.x",), np.array([[100.0], [100.0 + way]])))
    assert largest_travel(history) == pytest.approx(way if moves else 0.0, abs=2e-14)


def test_bodies_that_only_turn_have_no_way_to_compare_with() -> None:
    """Rounding moves their centres by 1e-60; a share of that would be a number of fifty digits."""
    deck = """\
two drums on one clutch, 300 apart
ACCGRAV/KGRAV=-9806.65
PART/1, GROUND
MARKER/1, PART=1, REULER=90D,90D,0
MARKER/2, PART=1, QP=0,300,0, REULER=90D,90D,0
PART/7, MASS=3.3, CM=70, IP=41000,23000,23000
MARKER/70, PART=7
MARKER/71, PART=7, REULER=90D,90D,0
PART/8, MASS=2.1, CM=80, IP=17000,9000,9000, QG=0,300,0, WX=23
MARKER/80, PART=8
MARKER/81, PART=8, REULER=90D,90D,0
JOINT/1, REVOLUTE, I=71, J=1
JOINT/2, REVOLUTE, I=81, J=2
SFORCE/1, ROTATIONAL, I=81, J=2, FUNCTION=-1300*WZ(81,2)
END
"""
    results = al.simulate(al.read(deck), end=1.5, steps=150, integrator="RADAU", error=1e-8)
    assert "longest way" not in results.meta.get("accuracy", "")


def test_an_action_along_an_axis_is_no_strut():
    """A jet of 400 N on 0.1 kg, 1 mm from the marker whose z axis it has: 2000 m/s in 0.5 s, and
    nothing turns it; a strut would have grown 1e+89 times.
    """
    deck = (
        GROUND + "POINT_MASS/2, MASS=0.1, CM=2, QG=0,0,0.001\nMARKER/2, POINT_MASS=2\n"
        "MARKER/3, PART=1\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=3, FUNCTION=400\nEND\n"
    )
    results = done(deck, 0.5, 50, integrator="RADAU", error=1e-6)
    assert results["POINT_MASS/2.vz"][-1] == pytest.approx(2000.0)
    assert "pushed masses apart" not in results.meta.get("accuracy", "")


def test_a_growth_beyond_round_off_has_no_number():
    """A mass of 1 mg between two walls that push for 0.4 s: exp(11300 t)."""
    deck = (
        GROUND + "POINT_MASS/2, MASS=1E-6, CM=2\nMARKER/2, POINT_MASS=2\n"
        "MARKER/3, PART=1, QP=-1,0,0\nMARKER/4, PART=1, QP=1,0,0\n"
        "SFORCE/1, TRANSLATIONAL, I=2, J=3, FUNCTION=400\n"
        "SFORCE/2, TRANSLATIONAL, I=2, J=4, FUNCTION=400\nEND\n"
    )
    note = done(deck, 0.4, 40, integrator="GSTIFF", error=1e-3).meta["accuracy"]
    assert "grew more than 1e+15 times" in note


def test_events_shift_one_another_where_sums_are_all_there_is():
    """Thirty events make three of a sum of 3e-4 at ERROR=1e-3, on a way of 1 m."""
    history = History()
    history.extend(Piece(np.arange(2.0), ("PART/2.x",), np.array([[0.0], [1.0]])))
    counts = SimpleNamespace(restarts=30, steps=100)
    (note,) = _added_up(Settings(error=1e-3), counts, 1.0, history)
    assert "100 steps add up to 0.30% of" in note
    assert not [*_added_up(Settings(error=1e-3), counts, 0.1, history)]


def test_a_sum_beyond_the_motion_has_no_number():
    """A belt drive: 80 000 steps, 650 m of errors where a body travels 1 mm at most."""
    history = History()
    history.extend(Piece(np.arange(2.0), ("PART/2.x",), np.array([[0.0], [1e-3]])))
    counts = SimpleNamespace(restarts=0, steps=80_000)
    (beyond,) = _added_up(Settings(error=1e-3), counts, 650e3, history)
    assert "more than the largest travel of a body" in beyond and "%" not in beyond
    assert "a smaller ERROR than 0.001 keeps" in beyond
    (within,) = _added_up(Settings(error=1e-3), counts, 0.5, history)
    assert "50.00% of the largest travel" in within


def test_numbers_of_the_integrator_are_not_compared() -> None:
    """HSIZE is another one in every run; a vibration of 1 Hz, exact to 1e-6, is not doubted."""
    deck = (
        GROUND + "POINT_MASS/2, MASS=1, CM=2, QG=1,0,0\nMARKER/2, POINT_MASS=2\n"
        "VFORCE/1, I=2, J_PART=1, FX=-39.478*DX(2)\\FY=0\\FZ=0\n"
        "REQUEST/1, F1=DX(2)\\F2=HSIZE()\\F3=2*ORDER()\nEND\n"
    )
    results = done(deck, 1.0, 7, integrator="RADAU", error=1e-7)
    assert np.abs(results["REQUEST/1.F1"] - np.cos(np.sqrt(39.478) * results.time)).max() < 1e-6
    assert np.ptp(results["REQUEST/1.F2"]) > 0.001 and "accuracy" not in results.meta

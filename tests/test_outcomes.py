"""How runs end early: by name, with statement, line and time, and with what was computed."""

from __future__ import annotations

import _thread
import signal
import threading

import numpy as np
import pytest
from scenes import GROUND, chain, done, run

import adamslite as al
from adamslite import Outcome

FALLING = (
    GROUND
    + "ACCGRAV/JGRAV=-9.81\nPOINT_MASS/2, MASS=10, CM=2\nMARKER/2, POINT_MASS=2\n"
    + "VARIABLE/5, FUNCTION=10*TIME\n"
)
PRINTED = (
    "VFORCE/7, I=2, J_PART=1, FX=VARVAL(5)*ACCX(2)+10*VX(2)\\"
    "FY=VARVAL(5)*(ACCY(2)-JGRAV)+10*VY(2)\\FZ=VARVAL(5)*ACCZ(2)+10*VZ(2)\n"
)


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

"""Demands on the decks of decks/torture that no column of a result says."""

from __future__ import annotations

import numpy as np
import pytest

import adamslite
from adamslite.errors import UsageError
from adamslite.resources import find
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.scene import load_scene, run_scene


def solved(deck: str, **options: object) -> Results:
    """Results of a deck below decks/."""
    results = run_scene(load_scene(find("decks") / deck), options)
    assert results.outcome is Outcome.DONE, results.message
    return results


@pytest.mark.parametrize("error", (1e-4, 1e-6, 1e-8))
def test_the_step_does_not_follow_a_node_without_mass(error: float) -> None:
    """A microgram on springs, 67000 times as fast as the motion: at most ten times the steps."""
    light, without = (
        solved(f"torture/massless-node/{deck}.adm", error=error).summary["steps"]
        for deck in ("massless-node", "one-spring")
    )
    assert light < 10 * without


@pytest.mark.parametrize(
    ("deck", "redundant"), [("four-bar/four-bar.adm", 3), ("bricard/bricard.adm", 1)]
)
def test_redundant_rows_are_counted_and_named(deck: str, redundant: int) -> None:
    """One degree of freedom is left, and each row that was left out has a name."""
    results = solved(deck, end=0.01, steps=1)
    assert results.summary["dof"] == 1
    named = results.meta["redundant"].partition(": ")[2].split("; ")
    assert len(named) == redundant
    assert all(name.startswith("JOINT/") for name in named)


TRAPEZOIDS = ("HHT, ALPHA=0", "HHT, ALPHA=-0.01", "NEWMARK, BETA=0.25, GAMMA=0.5")


def pendulum(integrator: str) -> adamslite.Deck:
    """A mass on a rod (decks/pendulum-gcon) with another INTEGRATOR."""
    text = (find("decks") / "pendulum-gcon/pendulum-gcon.adm").read_text()
    return adamslite.read(text.replace("GSTIFF, SI2", integrator))


@pytest.mark.parametrize("integrator", TRAPEZOIDS)
def test_the_trapezoidal_rule_is_refused_on_constraints(integrator: str) -> None:
    """Its reactions alternate and grow; with equal steps the pendulum ends 0.2 m off."""
    with pytest.raises(UsageError, match="GCON/1 is a constraint.* ring.*ALPHA=-0.05"):
        adamslite.simulate(pendulum(integrator))


@pytest.mark.parametrize("integrator", TRAPEZOIDS)
def test_it_may_run_what_nothing_constrains(integrator: str) -> None:
    """x" = -x from 1: cos(10) to 1e-3, ten times what 2000 steps of ERROR = 1e-7 may add up to."""
    deck = adamslite.read(
        "spring\nPART/1, GROUND\nMARKER/1, PART=1\nPOINT_MASS/2, MASS=1, CM=2, QG=1,0,0\n"
        "MARKER/2, POINT_MASS=2\nVFORCE/1, I=2, J_PART=1, FX=-DX(2)\\FY=0\\FZ=0\n"
        f"INTEGRATOR/{integrator}, ERROR=1E-7\nEND\n"
    )
    results = adamslite.simulate(deck, end=10.0, steps=10)
    assert results["POINT_MASS/2.x"][-1] == pytest.approx(np.cos(10.0), abs=1e-3)


def test_a_little_damping_is_enough() -> None:
    """HHT with ALPHA=-0.05: the pull of the rod stays within 1e-3 of 3 m g sin, no alternation."""
    results = adamslite.simulate(pendulum("HHT, ALPHA=-0.05"), error=1e-7)
    pull, y = results["GCON/1.f"], results["POINT_MASS/2.y"]
    np.testing.assert_allclose(np.abs(pull), -3 * 9.81 * y, atol=1e-3 * 29.43)


@pytest.mark.parametrize(
    ("integrator", "told"),
    [
        ("NEWMARK", "order 1"),
        ("HHT", "order 2"),
        ("GSTIFF, I3", "velocities"),
        ("CONSTANT_BDF, HMAX=0.01", "half of HINIT"),
        ("GSTIFF, SI2", ""),
        ("RADAU", ""),
        ("ABAM", ""),
    ],
)
def test_what_error_does_not_promise_is_told(integrator: str, told: str) -> None:
    """A second of a pendulum at ERROR=1e-3: what is off by 0.2 % of its way or more says why."""
    results = adamslite.simulate(pendulum(integrator), end=1.0, steps=10, error=1e-3)
    note = results.meta.get("accuracy", "")
    assert told in note and bool(told) == bool(note)


def test_waves_that_hht_filters_are_told() -> None:
    """Meant or not, HHT cannot know: at ERROR = 1e-4 it damps waves of 10 mm, and says so."""
    told = solved("torture/ringing/waves.adm", integrator="HHT", error=1e-4).meta["accuracy"]
    assert "damped, not followed" in told and "RADAU" in told
    calm = solved("pendulum-gcon/pendulum-gcon.adm", integrator="HHT", error=1e-4)
    assert "damped" not in calm.meta.get("accuracy", "")


def test_a_start_that_contradicts_a_rod_is_told() -> None:
    """0.01 m/s along the rod is taken away, 1 m/s across it stays."""
    results = solved("torture/inconsistent-start/inconsistent-start.adm", end=0.1, steps=1)
    assert "POINT_MASS/2 by 0.01" in results.meta["start speeds"]
    assert "start speeds" not in solved("andrews/andrews.adm", end=0.001, steps=1).meta


def test_equal_turns_are_no_error_of_hht() -> None:
    """Bodies that turn evenly (decks/torture/gimbal-lock): the step is a turn, not a chord.

    1.5 rad/s with steps of 0.1 s: a chord of the Cayley vector would lose 3e-4 rad a step, 0.03 in
    all; 1e-5 are left for the interpolation at ERROR = 1e-6, a tenth of it in a step.
    """
    results = solved("torture/gimbal-lock/gimbal-lock.adm", integrator="HHT", error=1e-6)
    exact = np.cos(3.0 * results.time)
    np.testing.assert_allclose(results["REQUEST/4.F2"], exact, atol=1e-5)


def test_a_short_hmax_is_not_spent_on_a_low_order() -> None:
    """Where HMAX caps the step every order offers the same; the lowest would be the worst.

    At ERROR = 1e-3 the pendulum of benchmark A01 ends 5e-2 m off with free steps. A step of 0.01 s
    is 0.08 rad of its fastest turn, and a formula of order 1 would lose a third of the swing.
    """
    deck = pendulum("GSTIFF, SI2")
    free, capped = (
        adamslite.simulate(deck, end=10.0, steps=10, error=1e-3, hmax=hmax)["POINT_MASS/2.x"][-1]
        for hmax in (1.0, 0.01)
    )
    exact = -0.275087462576
    assert abs(capped - exact) < 0.2 * abs(free - exact)


@pytest.mark.parametrize(("deck", "grows"), [("below", 0.0), ("above", 32.4)])
def test_transport_faster_than_waves_shows_in_the_modes(deck: str, grows: float) -> None:
    """Greatest growth rate of a string through eyelets: of the nine nodes' matrix, to its digits.

    Below the speed of its waves the rates are pairs with a real part of round-off.
    """
    path = find("decks") / f"torture/supercritical/{deck}.adm"
    rates = adamslite.linearize(adamslite.read(path)).eigenvalues
    assert rates.real.max() == pytest.approx(grows, abs=5e-2 if grows else 1e-4)

"""Edges in time as near to the end of a run or to an output time as round-off of the time."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from pytest import approx
from scenes import GROUND, SPRING, done, options, system

import adamslite as al
from adamslite.analyses.clock import stops as stops_module
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

FORMULAS = ("GSTIFF", "GSTIFF I3", "HHT", "NEWMARK", "RADAU", "RKF45", "ABAM", "VERLET")


def moved_by(force: str, x: float = 0.0) -> str:
    """A point mass of 1 kg on which a force acts along x."""
    return (
        f"{GROUND}POINT_MASS/2, MASS=1, CM=2, QG={x},0,0\nMARKER/2, POINT_MASS=2\n"
        f"VFORCE/1, I=2, J_PART=1, FX={force}\nEND\n"
    )


def in_parts(deck: str, *ends: float, **options: Any) -> Results:
    """Solve a deck by several SIMULATEs of 20 output steps each."""
    parts = [f"SIMULATE/DYNAMIC, END={end!r}, STEPS=20\n" for end in ends]
    results = al.simulate(al.read(deck.replace("END\n", "".join(parts) + "END\n")), **options)
    assert results.outcome is Outcome.DONE, results.message
    return results


@pytest.mark.parametrize("gap", [1e-16, 4.4e-14, 1e-12])
@pytest.mark.parametrize("formula", FORMULAS)
def test_an_edge_just_before_the_end_of_a_run(formula, gap):
    """1 N from t = 0.5/9 on, ``gap`` before the end of a run and of its part: v = t - 0.5/9.

    Steps between edge and end, and the rest that round-off of the time leaves of them, are far
    below any step of the run.
    """
    edge = 0.5 / 9.0
    deck = moved_by("IF(9*TIME-0.5: 0, 0, 1)")
    last = in_parts(deck, edge + gap, 0.1, **options(formula, 1e-5))
    assert last["POINT_MASS/2.vx"][20] == approx(0.0, abs=2 * gap)
    assert last["POINT_MASS/2.vx"][-1] == approx(0.1 - edge, rel=1e-4)
    inside = done(deck, 2 * (edge + gap), 20, **options(formula, 1e-5))
    assert inside["POINT_MASS/2.vx"][-1] == approx(edge, rel=1e-4)


@pytest.mark.parametrize("formula", ("GSTIFF", "RKF45"))
@pytest.mark.parametrize("share", [1e-15, 1e-12])
def test_an_edge_just_before_the_end_of_a_run_that_begins_late(formula, share):
    """From t = 1000 on 0.3 s: the digits of the time are those of 1000 and not of the run."""
    deck = moved_by("1E-3+MAX(0,TIME-1000.3)")
    last = in_parts(deck, 1000.0, 1000.3 * (1.0 + share), **options(formula, 1e-2))
    assert last["POINT_MASS/2.vx"][-1] == approx(1.0003, rel=1e-6)


def test_an_edge_just_before_an_output_time_leaves_the_steps_behind_it_long():
    """10 N on a swinging mass, x = c + (0.1 cos 5 - c) cos w s - 0.1 sin 5 sin w s, c = 1 mm."""
    swing = "-1E4*DX(2)"
    plain = done(moved_by(swing, x=0.1), 0.1, 20, **options("VERLET", 1e-6))
    pushed = moved_by(f"{swing}+IF(TIME-{0.05 - 1e-12!r}:0,0,10)", x=0.1)
    run = done(pushed, 0.1, 20, **options("VERLET", 1e-6))
    place = 1e-3 + (0.1 * np.cos(5.0) - 1e-3) * np.cos(5.0) - 0.1 * np.sin(5.0) ** 2
    assert run["POINT_MASS/2.x"][-1] == approx(place, abs=1e-4)
    assert run.summary["steps"] < 1.5 * plain.summary["steps"]


@pytest.mark.parametrize("method", ["GSTIFF", "HHT", "RADAU", "ABAM", "VERLET"])
def test_a_largest_step_beyond_the_run_is_no_limit(method: str) -> None:
    """Also where its square is no number."""
    deck = al.read(SPRING)
    runs = [al.simulate(deck, end=1.0, steps=4, integrator=method, hmax=h) for h in (1.0, 1e300)]
    assert all(each.outcome is al.Outcome.DONE for each in runs)
    assert (runs[0].values == runs[1].values).all()


@pytest.mark.parametrize("block", (3, 2**15))
def test_changes_do_not_depend_on_how_many_are_found_at_once(block: int, monkeypatch) -> None:
    """A floor that passes 39 numbers beside a step; the root of a negative number changes never."""
    monkeypatch.setattr(stops_module, "BLOCK", block)
    run_of = system(moved_by("AINT(40*TIME)+IF(TIME-0.5126: 0, 1, 1)+AINT(SQRT(TIME-2))"))
    found = stops_module.stops(run_of, np.array([0.0, 1.0]))
    assert found == approx(np.sort([*np.arange(1, 41) / 40, 0.5126]), abs=1e-12)

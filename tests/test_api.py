"""The stages of the package, one by one, as a Python user sees them."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import PENDULUM

import adamslite as al


def test_every_stage_can_be_looked_at():
    deck = al.read(PENDULUM)
    assert deck.find("PART", 2).mass == 2.0
    assert not any(d.is_error for d in al.check(deck))
    model = al.assemble(deck)
    assert (len(model.bodies), len(model.constraints)) == (1, 1)
    kernels = al.compile_model(model)
    assert {g.face for g in kernels.groups} >= {"reactions", "position", "velocity"}
    results = al.simulate(kernels, end=1.0, steps=5)
    assert results.outcome is al.Outcome.DONE
    assert results.summary["dof"] == 1
    assert results["PART/2.x"].shape == results.time.shape == (6,)


def test_a_deck_a_model_and_its_kernels_give_the_same_results():
    deck = al.read(PENDULUM)
    scenes = (deck, al.assemble(deck), al.compile_model(al.assemble(deck)))
    first, *others = (al.simulate(s, end=0.5, steps=5).values for s in scenes)
    for each in others:
        np.testing.assert_array_equal(each, first)


def test_results_are_saved_and_compared(tmp_path):
    results = al.simulate(al.read(PENDULUM), end=0.5, steps=5)
    results.save(tmp_path / "run.csv")
    back = al.Results.load(tmp_path / "run.csv")
    assert back.names == results.names
    np.testing.assert_allclose(back.values, results.values, rtol=1e-12, atol=1e-300)
    al.compare(results, back)


def test_a_wrong_name_is_answered_with_the_near_ones():
    results = al.simulate(al.read(PENDULUM), end=0.5, steps=5)
    with pytest.raises(KeyError, match="did you mean PART/2"):
        results["PART/2.xx"]


def test_a_run_without_an_end_is_a_fault_of_use():
    from adamslite.errors import UsageError

    with pytest.raises(UsageError, match="SIMULATE"):
        al.simulate(al.read(PENDULUM))
    for wrong in ({"end": -1.0}, {"end": 1.0, "steps": 0}):
        with pytest.raises(UsageError):
            al.simulate(al.read(PENDULUM), **wrong)


def test_arguments_win_over_the_deck():
    deck = PENDULUM.replace("END", "SIMULATE/DYNAMICS, END=1, STEPS=4\nINTEGRATOR/ERROR=1E-8\nEND")
    assert al.simulate(al.read(deck)).time[-1] == 1.0
    fine = al.simulate(al.read(deck))
    coarse = al.simulate(al.read(deck), error=1e-2)
    assert coarse.summary["steps"] < fine.summary["steps"]
    assert al.simulate(al.read(deck), end=2.0, steps=8).time.size == 9


def test_steps_of_the_last_run_are_replaced_and_not_its_end():
    """DURATION counts from where the run before it ends: 1 s and another 0.5 s."""
    runs = "SIMULATE/DYNAMICS, END=1, STEPS=4\nSIMULATE/DYNAMICS, DURATION=0.5, STEPS=4\nEND"
    results = al.simulate(al.read(PENDULUM.replace("END", runs)), steps=2)
    np.testing.assert_allclose(results.time, [0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5], rtol=1e-15)


def test_steps_alone_do_not_make_a_run_of_a_single_equilibrium():
    from adamslite.errors import UsageError

    with pytest.raises(UsageError, match="There is no end time"):
        al.simulate(al.read(PENDULUM.replace("END", "SIMULATE/STATICS\nEND")), steps=2)

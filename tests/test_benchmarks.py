"""The scenes of the benchmarks: their decks are decks, and their arrays what the decks say."""

import numpy as np
import pytest

from adamslite import read
from benchmarks.decks import deck
from benchmarks.peers import PROGRAMS
from benchmarks.reference import reference
from benchmarks.scenes import CHAINS, acceleration, chain, parameters, sizes


@pytest.mark.parametrize("scene", list(parameters()))
def test_the_deck_of_a_scene_has_no_mistakes(scene: str) -> None:
    assert read(deck(scene, min(sizes(scene)))).of("SIMULATE")


@pytest.mark.parametrize("scene", CHAINS)
def test_the_deck_of_a_chain_has_its_masses_in_their_places(scene: str) -> None:
    n = min(sizes(scene))
    c = chain(scene, n)
    masses = read(deck(scene, n)).of("POINT_MASS")
    assert [m.id for m in masses] == list(range(2, n + 2))
    np.testing.assert_array_equal([m.mass for m in masses], c.mass)
    np.testing.assert_array_equal([m.qg for m in masses], c.position)
    np.testing.assert_array_equal([(m.vx, m.vy, m.vz) for m in masses], c.velocity)


def test_springs_act_and_react() -> None:
    c = chain("S2", 100)
    inside = slice(20, 80)  # moves only these, so the ends pull as before
    x, rule = c.position.copy(), acceleration(c)
    before = c.mass @ rule(0.0, x, 0.0 * x)
    x[inside] += 0.1 * np.random.default_rng(1).standard_normal((60, 3))
    np.testing.assert_allclose(c.mass @ rule(0.0, x, 0.0 * x), before, atol=1e-6)


@pytest.mark.parametrize("scene", list(parameters()))
def test_a_reference_is_at_hand(scene: str) -> None:
    truth = reference(scene, min(sizes(scene)))
    assert truth is not None and np.isfinite(truth).all()


def test_programs_climb_from_loose_to_tight() -> None:
    for program in PROGRAMS.values():
        for scene in program.scenes:
            rungs = program.ladder(scene, min(sizes(scene)))
            steps = [rung.get("steps", 0) for rung in rungs]
            allowed = [rung.get("rtol", rung.get("error", 1.0)) for rung in rungs]
            assert rungs and steps == sorted(steps) and allowed == sorted(allowed, reverse=True)

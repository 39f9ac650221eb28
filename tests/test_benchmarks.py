"""The scenes of the benchmarks: their decks are decks, and their arrays what the decks say."""

import numpy as np
import pytest

import adamslite as al
from adamslite import read
from adamslite.verification.variants import variants
from benchmarks import counts
from benchmarks.decks import deck
from benchmarks.growth import worth_measuring
from benchmarks.measure import Effort, point, steps_needed
from benchmarks.mechanisms import PLANAR, SPATIAL, WATCHED, mechanism, truth, watched
from benchmarks.peers import PROGRAMS, numba_chain
from benchmarks.peers.ours import FIXED_STEPS
from benchmarks.peers.program import Program
from benchmarks.planar import Equations, planar
from benchmarks.reference import reference
from benchmarks.scenes import (
    CHAINS,
    FALL,
    FALLING,
    STARTING,
    acceleration,
    chain,
    parameters,
    sizes,
)
from benchmarks.structures import NET, REVOLUTES, structure
from benchmarks.worker import answer, error_of


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


@pytest.mark.parametrize("scene", CHAINS)
def test_a_reference_is_at_hand(scene: str) -> None:
    known = reference(scene, min(sizes(scene)))
    assert known is not None and np.isfinite(known).all()


@pytest.mark.parametrize("scene", [*PLANAR, *SPATIAL])
def test_what_is_watched_of_a_mechanism_is_known(scene: str) -> None:
    assert np.isfinite(truth(scene, min(sizes(scene)))).all()


@pytest.mark.parametrize("scene", PLANAR)
def test_planar_equations_start_like_the_mechanism_in_space(scene: str) -> None:
    """Pins are closed, their rates vanish, and the accelerations meet the constraints."""
    n = min(sizes(scene))
    m = planar(scene, n)
    equations = Equations(m)
    gradient, gamma = equations.constraints(m.place, m.speed)
    a, _ = equations.accelerations(m.place, m.speed)
    size = np.abs(m.speed).max() + 1.0
    np.testing.assert_allclose(gradient @ m.speed.ravel(), 0.0, atol=1e-7 * size)
    np.testing.assert_allclose(gradient @ a.ravel(), gamma, atol=1e-8 * size**2)
    for i, p, j, q in m.pins:
        apart = _point(m.place, i, p) - _point(m.place, j, q)
        np.testing.assert_allclose(apart, 0.0, atol=1e-8)


def _point(place: np.ndarray, body: int, p: np.ndarray) -> np.ndarray:
    if body < 0:
        return p
    c, s = np.cos(place[body, 2]), np.sin(place[body, 2])
    return place[body, :2] + np.array([[c, -s], [s, c]]) @ p


def test_the_pendulum_of_the_peers_swings_as_the_law_says() -> None:
    """A uniform rod of 1.5 m from the horizontal: phi" = (3 g/2 l) cos(phi) = 9.81 cos(phi)."""
    m = planar("A01", 1)
    a, _ = Equations(m).accelerations(m.place, m.speed)
    assert abs(a[0, 2]) == pytest.approx(9.81, rel=1e-9)


def test_energy_and_angle_are_watched_at_the_start_of_the_four_bars() -> None:
    m, n = mechanism("S4", 4), 4
    p = planar("S4", n)
    angle, energy = watched("S4", n, p.place, p.speed)
    assert angle == pytest.approx(np.pi / 2)
    assert energy == pytest.approx(truth("S4", n)[1], rel=1e-12)
    assert m.n == 2 * n + 1


def test_programs_climb_from_loose_to_tight() -> None:
    for program in PROGRAMS.values():
        for scene in program.scenes:
            rungs = program.ladder(scene, min(sizes(scene)))
            steps = [rung.get("steps", 0) for rung in rungs]
            allowed = [rung.get("rtol", rung.get("error", 1.0)) for rung in rungs]
            assert steps == sorted(steps) and allowed == sorted(allowed, reverse=True)


def test_every_integrator_takes_part() -> None:
    names = {name for name, program in PROGRAMS.items() if program.kind == "ours"}
    assert {f"adamslite {variant.label}" for variant in variants()} <= names


def test_ours_answers_with_the_error_of_a_scene() -> None:
    name = next(name for name in PROGRAMS if "SI2" in name)
    for scene, bound in (("S1", 1e-4), ("A01", 1e-2)):
        question = {"scene": scene, "n": min(sizes(scene)), "settings": {"error": 1e-6}}
        told = answer(name, question)
        assert told["ok"] and told["error"] < bound and told["steps"] > 10


def test_what_cannot_be_done_is_told() -> None:
    told = answer("adamslite VERLET", {"scene": "A01", "n": 1, "settings": {"error": 1e-3}})
    assert not told["ok"] and told["refused"] and "JOINT/1" in told["reason"]


def test_a_method_of_order_two_needs_ten_times_the_steps_for_a_hundredth_of_the_error() -> None:
    program = Program("", "implicit", (), lambda s, n: [], answer, bool, order=2)
    made = point("Exudyn", "S1", 10, {"steps": 100})
    made.error = 1e-3
    assert steps_needed(program, made, 1e-5) == pytest.approx(900.0)


def test_nothing_is_begun_when_the_time_is_up() -> None:
    assert not Effort((1e-3,), 1.0, 3).over and Effort((1e-3,), 1.0, 3, deadline=0.0).over


def test_a_matrix_that_is_kept_does_not_spoil_the_answer() -> None:
    """S1 with 200 masses in 100 equal steps of HHT: full Newton iterations leave 6 mm of 10 m.

    Matrices kept without a look at how iterations contract have left 0.45 m, and no word of it.
    """
    solved = FIXED_STEPS.solve("S1", 200, {"steps": 100})
    assert solved.ok
    assert error_of("S1", 200, solved.values)["error"] < 0.01


def test_the_start_of_the_cable_lasts_as_many_segments_at_every_size() -> None:
    ends = [chain(STARTING, n).end * n for n in (10, 200)]
    assert ends[0] == pytest.approx(ends[1])
    assert "END" in deck(STARTING, 10)
    assert chain(FALLING, 10).end == chain(FALLING, 200).end == FALL


@pytest.mark.parametrize(("steps", "scene"), [(21, FALLING), (600, STARTING)])
def test_the_cost_of_a_step_is_not_that_of_first_steps(steps: int, scene: str) -> None:
    """Growth is measured over a longer time for a program that has hardly started otherwise."""

    class Finished:
        def ask(self, point: object, patience: float | None = None) -> dict[str, object]:
            return {"ok": True, "steps": steps}

    name = "adamslite GSTIFF SI2"
    assert worth_measuring(name, {"error": 1e-4}, {name: Finished()}, 200) == scene


def test_every_watched_deck_has_its_channels_in_the_reference() -> None:
    for scene, told in WATCHED.items():
        assert len(truth(scene, 1)) == len(told.channels)


def test_counts_that_changed_are_named_with_their_bands() -> None:
    """Counts of a run have a band, a share of the count or of the steps; code has none."""
    kept = {"steps": 200, "rejected": 3, "newton": 500, "entries": 90, "instructions": 1000}
    rows = [("S1 10 HHT", kept, 0.01), ("gone", kept, 0.0)]
    found = {
        "S1 10 HHT": {**kept, "steps": 202, "rejected": 6, "newton": 480, "instructions": 1001},
        "new": kept,
    }
    assert counts.differences(rows, found) == [
        "S1 10 HHT: rejected 3 -> 6 (+100.0 %, 2 allowed)",
        "S1 10 HHT: newton 500 -> 480 (-4.0 %, 5 allowed)",
        "S1 10 HHT: instructions 1000 -> 1001 (+0.1 %)",
        "gone: is kept, but no longer counted",
        "new: is counted, but not kept",
    ]


def test_a_band_is_twice_what_processors_differ_by() -> None:
    one = {"steps": 100, "rejected": 2, "newton": 200}
    other = {"steps": 103, "rejected": 6, "newton": 202}
    assert counts.band(one, []) == counts.band(one, [one]) == 0.0
    assert counts.band(one, [one, other]) == pytest.approx(0.08)


def test_counts_are_kept_for_every_scene_that_is_counted() -> None:
    """Matrix and code of a small scene are those of the file, whatever the processor."""
    rows = {name: kept for name, kept, _ in counts.kept()}
    names = {counts.name_of(s, n, m) for s, n, methods, _ in counts.SCENES for m in methods}
    assert names <= set(rows)
    kernels, *_ = counts.prepared("S1", 10)
    assert counts.factor_entries(kernels) == rows["S1 10 HHT"]["entries"]
    assert counts.instructions(kernels) == rows["S1 10 HHT"]["instructions"]
    assert counts.lines_of("define void @f() {\nentry:\n  %a = add i64 1, 2\n  ret void\n}") == 2


@pytest.mark.parametrize(("kind", "size"), [(NET, 4), (REVOLUTES, 4)])
def test_structures_are_decks(kind: str, size: int) -> None:
    """A net of n x n knots with its first row held; a chain with one freedom for each rod."""
    model = al.assemble(al.read(structure(kind, size)))
    bodies = {NET: size * (size - 1), REVOLUTES: size}[kind]
    assert sum(s.keyword in ("PART", "POINT_MASS") for s in model.deck.statements) == bodies + 1
    springs = {NET: 2 * size * (size - 1) - (size - 1), REVOLUTES: 0}[kind]
    assert sum(s.keyword == "SPRINGDAMPER" for s in model.deck.statements) == springs


@pytest.mark.parametrize("scene", CHAINS)
def test_the_compiled_right_hand_side_is_that_of_numpy(scene: str) -> None:
    """Every state of a chain in some motion; sums in another order."""
    pytest.importorskip("numba")
    c = chain(scene, 10)
    generator = np.random.default_rng(2)
    x, v = c.position + 1e-3 * generator.random((10, 3)), generator.random((10, 3))
    right = np.zeros(3) if c.right is None else c.right
    out = np.zeros(60)
    numba_chain.compiled()(
        0.3, np.hstack((x, v)).ravel(), out, np.concatenate((c.left, right)), c.mass,
        np.array([c.k, c.d, c.l0, c.gravity, c.rate, float(c.right is not None)]),
    )  # fmt: skip
    found, expected = out.reshape(10, 6), acceleration(c)(0.3, x, v)
    np.testing.assert_array_equal(found[:, :3], v)
    np.testing.assert_allclose(found[:, 3:], expected, rtol=1e-9, atol=1e-9 * abs(expected).max())

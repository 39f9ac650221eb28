"""Methods on random decks (`python -m benchmarks.differential`): the judge, the truths of the
kinds, and mixed decks, on which none is off without saying so and AUTO is right wherever a method
is.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tiers import fast

from adamslite import simulate
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.verification.variants import Variant
from benchmarks.differential import AUTO, RIGHT, SILENT, Task, attempt, sample
from benchmarks.judging import ROWS, WARNED, Bench, limit, off_by, verdict
from benchmarks.posed import KINDS, Posed, Truth, pose
from benchmarks.truths import MIXED, key, packed, unpacked

SEED, DECKS, GROUP = 1, 100, 4


@pytest.mark.parametrize("first", fast(range(0, DECKS, GROUP), 24))
def test_no_method_is_silently_wrong(first: int) -> None:
    reports = [
        attempt(Task(MIXED, number, SEED), errors=(1e-6,)) for number in range(first, first + GROUP)
    ]
    silent = [(r.title, j) for r in reports for j in r.judged if j.verdict == SILENT]
    assert not silent
    for report in reports:
        verdicts = {j.method: j.verdict for j in report.judged}
        others = [verdict for method, verdict in verdicts.items() if method != AUTO]
        if RIGHT in others:
            assert verdicts[AUTO] == RIGHT, report
    # Most decks have a motion that two methods agree upon.
    assert sum(bool(report.judged) for report in reports) >= GROUP // 2


def torsion() -> tuple[Posed, Truth]:
    """A problem with a closed form that every method solves."""
    number = [make.__name__ for make in KINDS["rotating"]].index("torsion")
    problem = pose("rotating", number, SEED)
    return problem, problem.solve()


def test_a_planted_error_is_silent_unless_the_results_tell() -> None:
    problem, truth = torsion()
    results = simulate(problem.text, integrator="RADAU", error=1e-9, hmax=problem.end / 2000)
    assert verdict("RADAU", 1e-6, problem, results, truth).verdict == RIGHT
    name, amount = problem.channels[0].column, 1.5 * limit(1e-6) * truth.ranges[0]
    moved = _changed(results, name, amount)
    found = verdict("RADAU", 1e-6, problem, moved, truth)
    assert found.verdict == SILENT and found.kind == "angle"
    assert found.off == pytest.approx(1.5e-3, rel=0.1)
    # What is due at 1e-6 is within the limit at the default.
    assert verdict("RADAU", 1e-3, problem, moved, truth).verdict == RIGHT
    telling = replace(moved, meta={**moved.meta, "accuracy": "estimated error 1 rad"})
    assert verdict("RADAU", 1e-6, problem, telling, truth).verdict == WARNED


def test_a_note_of_a_right_run_is_a_false_alarm() -> None:
    problem, truth = torsion()
    results = simulate(problem.text, integrator="RADAU", error=1e-9, hmax=problem.end / 2000)
    quiet = replace(results, meta={k: v for k, v in results.meta.items() if k != "accuracy"})
    loud = replace(quiet, meta={**quiet.meta, "accuracy": "estimated error 1 rad"})
    assert not verdict("RADAU", 1e-6, problem, quiet, truth).false_alarm
    assert verdict("RADAU", 1e-6, problem, loud, truth).false_alarm
    amount = 0.5 * limit(1e-6) * truth.ranges[0]
    nearly = _changed(loud, problem.channels[0].column, amount)
    assert not verdict("RADAU", 1e-6, problem, nearly, truth).false_alarm


def test_a_sensor_that_is_passed_is_silent() -> None:
    number = next(n for n in range(50) if 0.0 < pose("sensors", n, SEED).halts(0.0)[1] < np.inf)
    problem = pose("sensors", number, SEED)
    truth = problem.solve()
    ended = simulate(problem.text, integrator="RADAU", error=1e-9, hmax=problem.end / 2000)
    assert off_by(problem, ended, truth)[0] < 1e-4
    text = "\n".join(line for line in problem.text.splitlines() if "SENSOR" not in line)
    passed = simulate(text, integrator="RADAU", error=1e-9, hmax=problem.end / 2000)
    assert verdict("RADAU", 1e-6, problem, passed, truth).kind == "sensor"


def test_missing_rows_are_wrong() -> None:
    problem, truth = torsion()
    results = simulate(problem.text, steps=problem.steps + 1)
    assert off_by(problem, results, truth) == (np.inf, ROWS)


#: Families whose truth takes scipy less than a second, and numbers of decks that steps of 1/4000 of
#: the run resolve.
CHEAP = {
    "stiffness": (0, 3, 5),
    "tables": (0, 3),
    "singular": (1, 3),
    "rotating": range(6),
    "amplifying": range(3),
    "scales": (0, 1),
    "sensors": (1, 3),
    "pulleys": (1, 3),
}


@pytest.mark.numerical
@pytest.mark.parametrize("kind", CHEAP)
def test_deck_and_equations_of_a_family_are_the_same(kind: str) -> None:
    """The program with short steps agrees with the equations that the family states again."""
    for number in CHEAP[kind]:
        problem = pose(kind, number, 7)
        results = simulate(problem.text, integrator="RADAU", error=1e-8, hmax=problem.end / 4000)
        assert off_by(problem, results, problem.solve())[0] < 1e-4, problem.title


def test_decks_are_fixed_by_kind_seed_and_number_and_truths_are_kept() -> None:
    one, same, other = pose("tables", 1, 3), pose("tables", 1, 3), pose("tables", 1, 4)
    assert one.text == same.text and key(one) == key(same) != key(other)
    truth = Truth(np.array([[1.0, 2.0]]), np.array([[1.0, 2.5]]), np.array([1.0, 0.5]))
    again = unpacked(packed(truth))
    assert np.array_equal(again.least, truth.least) and np.array_equal(again.most, truth.most)


def test_truths_of_the_sample_belong_to_its_decks() -> None:
    tasks, kept = sample()
    assert len(tasks) == len(kept) == 200
    for task in tasks[::10]:
        assert key(pose(task.kind, task.number, task.seed)) in kept


def test_judging_runs_a_method_as_a_user_does() -> None:
    problem, truth = torsion()
    found = Bench(problem).judge(Variant("ABAM"), 1e-6, truth)
    assert found.method == "ABAM" and found.kind == "angle"


@pytest.mark.numerical
def test_a_step_that_ends_within_round_off_of_another_pace_has_reached_it() -> None:
    """Both ended STEP_TOO_SMALL with a step of one rounding of the time, which led to a fence."""
    for kind, method in (("scales", "RADAU"), ("stiffness", "GSTIFF")):
        results = simulate(pose(kind, 7, 31).text, integrator=method, error=1e-4)
        assert results.outcome is Outcome.DONE, results.message


def _changed(results: Results, name: str, amount: float) -> Results:
    """Results with one column off."""
    values = results.values.copy()
    values[1:, results.names.index(name)] += amount
    return replace(results, values=values)

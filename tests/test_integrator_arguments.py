"""Every argument of INTEGRATOR has the effect that integrators.md says, or a note says none.

The scene is the pendulum of `scenes`, released level, unless a test says otherwise.
"""

from __future__ import annotations

import numpy as np
import pytest
from scenes import GROUND, PENDULUM

import adamslite as al
from adamslite import Outcome
from adamslite.language.method import ARGUMENTS, methods
from adamslite.results.results import Results

IMPLICIT = ("GSTIFF", "GSTIFF, I3", "CONSTANT_BDF", "HHT", "NEWMARK", "RADAU")
FREE = GROUND + "POINT_MASS/2, MASS=1, CM=2, VX=1\nMARKER/2, POINT_MASS=2\nEND\n"
SWING = "VFORCE/1, I=2, J_PART=1, FX=-100*DX(2,1)\nEND"
VALUES = {
    "PATTERN": "T:F", "INTERPOLATE": "ON", "CORRECTOR": "MODIFIED", "KMAX": "3", "MAXIT": "5",
    "ALPHA": "-0.1", "BETA": "0.4", "GAMMA": "0.7",
}  # fmt: skip


def solve(arguments: str, deck: str = PENDULUM, end: float = 2.0, steps: int = 10) -> Results:
    """Run a deck with these arguments of INTEGRATOR."""
    scene = al.read(deck.replace("END", f"INTEGRATOR/{arguments}\nEND"))
    return al.simulate(scene, end=end, steps=steps)


def counts(arguments: str, *names: str, **options) -> list[int]:
    results = solve(arguments, **options)
    assert results.outcome is Outcome.DONE, results.message
    return [results.summary[name] for name in names]


# ---- steps ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", (*IMPLICIT, "ABAM"))
def test_hmax_is_the_longest_step(method):
    (steps,) = counts(f"{method}, HMAX=0.01", "steps")
    assert steps >= 200


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU", "ABAM"))
def test_hinit_is_the_first_step(method):
    """A free mass has no error: the run ends after the first step when that is long enough."""
    run = {"deck": FREE, "end": 0.1, "steps": 1}
    assert counts(f"{method}, HINIT=0.1", "steps", **run) == [1]
    assert counts(f"{method}, HINIT=0.001", "steps", **run)[0] > 2


@pytest.mark.parametrize(
    ("method", "least"),
    [("GSTIFF", 0.01), ("GSTIFF, I3", 0.01), ("HHT", 0.01), ("RADAU", 0.1), ("ABAM", 0.2)],
)
def test_a_run_ends_when_a_step_of_hmin_fails(method, least):
    """What was computed until then is kept; without HMIN the run is done."""
    asked = f"{method}, ERROR=1E-8, HMAX=0.4, INTERPOLATE=ON"
    results = solve(f"{asked}, HMIN={least}", steps=2000)
    assert results.outcome is Outcome.STEP_TOO_SMALL
    assert f"of size {least:g} (HMIN)" in results.message
    assert results.time[-1] == pytest.approx(results.summary["t_end"], abs=1e-3)
    assert solve(asked).outcome is Outcome.DONE


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "NEWMARK", "RADAU", "ABAM"))
def test_a_step_to_a_stop_may_be_shorter_than_hmin(method):
    """Edges 1 ms apart, and HMIN is 10 ms: v = 0.001 * 5 from the first, nothing from the rest."""
    force = "VFORCE/1, I=2, J_PART=1, FX=IF(TIME-0.501: 0, 0, IF(TIME-0.502: 5, 0, 0))\nEND"
    results = solve(f"{method}, HMIN=0.01", deck=FREE.replace("END", force), end=1.0)
    assert results.outcome is Outcome.DONE, results.message
    assert results["POINT_MASS/2.vx"][-1] == pytest.approx(1.005, rel=1e-9)


@pytest.mark.parametrize("method", ("GSTIFF", "CONSTANT_BDF"))
def test_kmax_is_the_highest_order(method):
    """Order 1 loses energy that order 5 keeps."""
    low, high = (solve(f"{method}, KMAX={k}, HMAX=0.02") for k in (1, 5))
    fallen = [
        abs(r["PART/2.vx"][-1] - solve("RADAU, ERROR=1E-8")["PART/2.vx"][-1]) for r in (low, high)
    ]
    assert fallen[0] > 10 * fallen[1]


@pytest.mark.parametrize("method", ("GSTIFF", "GSTIFF, I3", "HHT", "NEWMARK", "RADAU", "ABAM"))
def test_interpolate_decides_whether_steps_pass_output_times(method):
    """A free mass has no error: steps grow to HMAX, or to the next output time."""
    run = {"deck": FREE, "end": 1.0, "steps": 200}
    on, off = (
        counts(f"{method}, HMAX=1, INTERPOLATE={word}", "steps", **run) for word in ("ON", "OFF")
    )
    assert on[0] < 30
    assert 200 <= off[0] < 220
    usual = counts(f"{method}, HMAX=1", "steps", **run)
    assert usual == (off if method == "RADAU" else on)


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU", "ABAM"))
def test_stepped_on_outputs_agree_with_interpolated_ones(method):
    on, off = (solve(f"{method}, ERROR=1E-7, INTERPOLATE={word}") for word in ("ON", "OFF"))
    np.testing.assert_allclose(on["PART/2.x"], off["PART/2.x"], atol=1e-3)
    assert off.summary["steps"] != on.summary["steps"]


# ---- the corrector -------------------------------------------------------------------------------


@pytest.mark.parametrize("method", IMPLICIT)
def test_pattern_says_which_iterations_renew_the_matrix(method):
    """Matrices for accelerations at the start and the ten outputs are among those counted."""
    every, fourth, never = (
        counts(f"{method}, PATTERN={p}", "factorizations", "newton") for p in ("T", "T:F:F:F", "F")
    )
    per_matrix = 2 if method == "RADAU" else 1
    assert every[0] >= per_matrix * every[1]
    assert never[0] < fourth[0] < every[0]
    assert never[1] >= fourth[1] >= every[1] or method == "RADAU"


@pytest.mark.parametrize("method", IMPLICIT)
def test_pattern_does_not_change_the_motion(method):
    """Ten times ERROR is what methods themselves differ by."""
    runs = [solve(f"{method}, ERROR=1E-6, PATTERN={p}")["PART/2.x"] for p in ("T", "T:F:F:F", "F")]
    np.testing.assert_allclose(runs[1], runs[0], atol=2e-3)
    np.testing.assert_allclose(runs[2], runs[0], atol=2e-3)


@pytest.mark.parametrize("method", IMPLICIT)
def test_the_original_corrector_waits_for_multipliers(method):
    """It takes more iterations, or more matrices that spare some."""
    original, constant, modified, usual = (
        counts(f"{method}, HMAX=0.05{word}", "newton", "steps", "factorizations")
        for word in (
            ", CORRECTOR=ORIGINAL", ", CORRECTOR=ORIG_CONSTANT", ", CORRECTOR=MODIFIED", "",
        )
    )  # fmt: skip
    assert original[0] > modified[0] or original[2] > modified[2]
    assert constant == original
    assert usual == modified


@pytest.mark.parametrize("method", ("GSTIFF", "GSTIFF, I3", "CONSTANT_BDF"))
def test_adaptivity_loosens_the_corrector(method):
    """Fewer iterations a step; and the more so the shorter the step.  An iteration that only finds
    the residual small is none, with and without it: 1.3 to 1.5 a step are left to gain from.
    """

    def iterations(arguments: str) -> float:
        newton, steps = counts(f"{method}, {arguments}", "newton", "steps")
        return newton / steps

    assert iterations("HMAX=0.01, ADAPTIVITY=1E-5") < 0.97 * iterations("HMAX=0.01")
    assert iterations("HMAX=0.01, ADAPTIVITY=1E-12") == iterations("HMAX=0.01")


def test_maxit_ends_the_corrector():
    """Fixed steps cannot be cut: one iteration is not enough, ten are."""
    assert solve("CONSTANT_BDF, HMAX=0.05, MAXIT=1").outcome is Outcome.NEWTON_FAILED
    assert solve("CONSTANT_BDF, HMAX=0.05").outcome is Outcome.DONE
    for method in ("GSTIFF, I3", "HHT", "RADAU"):
        few, many = (counts(f"{method}, HMAX=0.2, MAXIT={n}", "steps")[0] for n in (1, 10))
        assert few > 2 * many, method


# ---- SCALE ---------------------------------------------------------------------------------------


def test_scale_multiplies_error_for_its_kind_of_coordinate():
    """All six by 1/100 is ERROR by 1/100; angles and their rates alone are not felt by a mass."""
    tight = counts("ABAM, ERROR=1E-6", "steps", "rejected")
    assert counts("ABAM, ERROR=1E-4, SCALE=.01,.01,.01,.01,.01,.01", "steps", "rejected") == tight
    assert counts("ABAM, ERROR=1E-4", "steps") < tight[:1]
    falls = {"deck": FREE.replace("END", SWING), "end": 2.0, "steps": 1}
    plain, turning, moving = (
        counts(f"ABAM, ERROR=1E-4{scale}", "steps", **falls)
        for scale in ("", ", SCALE=1,.001,.001,1,.001,.001", ", SCALE=.001,1,1,.001")
    )
    assert plain == turning < moving


def test_scale_must_be_positive():
    """INTEGRATOR/ABAM, SCALE=1,-1 is a mistake; without it, a warning says how it is read."""
    with pytest.raises(al.DeckError, match="SCALE of INTEGRATOR must be above zero"):
        al.read(FREE.replace("END", "INTEGRATOR/ABAM, SCALE=1,-1\nEND"))
    deck = al.read(FREE.replace("END", "INTEGRATOR/ABAM, SCALE=1,1\nEND"))
    assert [d.code for d in al.check(deck)] == ["scale-order"]


# ---- without effect ------------------------------------------------------------------------------


@pytest.mark.parametrize("word", ARGUMENTS)
def test_what_has_no_effect_is_told_with_the_reason(word):
    """And what has one is not."""
    for name, method in methods().items():
        value = VALUES.get(word, "0.001")
        deck = al.read(FREE.replace("END", f"INTEGRATOR/{name}, {word}={value}\nEND"))
        told = [d for d in al.check(deck) if d.code == "no-effect"]
        assert bool(told) != method.uses(word), (name, word)
        if told:
            assert method.use(word)[1:] in told[0].hint


def test_a_flag_that_changes_the_method_leaves_a_comment_in_the_results():
    scene = al.read(PENDULUM.replace("END", "INTEGRATOR/GSTIFF, PATTERN=T:F\nEND"))
    assert "integrator arguments" not in al.simulate(scene, end=0.1, steps=1).meta
    told = al.simulate(scene, end=0.1, steps=1, integrator="ABAM").meta["integrator arguments"]
    assert told == "without effect: PATTERN, because an explicit formula has no corrector"

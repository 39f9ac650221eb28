"""What accuracy costs: errors against a reference, the reference itself, the recommendation."""

from __future__ import annotations

import csv
from collections.abc import Callable
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fakes import SUMMARY

from adamslite.cli.main import main
from adamslite.elements.integrator import Integrator
from adamslite.errors import RunFailed, UsageError
from adamslite.language.method import AUTO
from adamslite.outputs import chart as drawing
from adamslite.outputs.chart import spread
from adamslite.progress import RunState
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.results.run_error import error_of
from adamslite.verification.work_precision import (
    TIGHT,
    Chart,
    Point,
    Truth,
    Variant,
    measure,
    patient,
    variants,
)

SPRING = """\
a mass on a spring: x = cos(10 t)
PART/1, GROUND
MARKER/1, PART=1, QP=-1,0,0
POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=100, LENGTH=1
SIMULATE/DYNAMIC, END=1, STEPS=10
END
"""
TIME = np.linspace(0.0, 1.0, 11)


def body(shift: float = 0.0, turn: float = 0.0, **facts: Any) -> Results:
    """PART/2 goes 2 along x and turns 3 rad about z, to which ``shift`` and ``turn`` are added."""
    columns = {"x": 2 * TIME + shift, "y": 0 * TIME, "z": 0 * TIME, "psi": 3 * TIME + turn,
               "theta": 0 * TIME, "phi": 0 * TIME, "az": 0 * TIME}  # fmt: skip
    names = tuple(f"PART/2.{name}" for name in columns)
    values = np.column_stack(list(columns.values()))
    return Results(time=TIME, names=names, values=values, **{"summary": SUMMARY, **facts})


def test_a_shift_counts_against_the_longest_way() -> None:
    assert error_of(body(shift=0.02), body()) == pytest.approx(0.01)


def test_a_turn_counts_in_radians_and_full_turns_do_not() -> None:
    assert error_of(body(turn=0.02), body()) == pytest.approx(0.02)
    assert error_of(body(turn=2 * np.pi), body()) == pytest.approx(0.0, abs=1e-14)


def test_at_theta_zero_psi_and_phi_are_one_angle() -> None:
    other = body()
    moved = other.values.copy()
    moved[:, [3, 5]] = moved[:, [5, 3]]
    swapped = Results(time=TIME, names=other.names, values=moved)
    assert error_of(swapped, other) == pytest.approx(0.0, abs=1e-14)


def test_named_channels_count_against_their_largest_value() -> None:
    assert error_of(body(shift=0.02, turn=1.0), body(), ["part/2.x"]) == pytest.approx(0.01)


def test_what_is_not_a_number_is_infinitely_wrong() -> None:
    assert error_of(body(shift=np.nan), body()) == inf


def test_every_supported_integrator_is_charted_once() -> None:
    """AUTO is one of the others; CONSTANT_BDF has no error test, so ERROR is no scale for it."""
    found = variants()
    names = [name for v in found for name in {v.integrator, *v.also}]
    assert set(names) == set(Integrator.arguments["method"].supported) - {AUTO, "CONSTANT_BDF"}
    assert len({v.label for v in found}) == len(found)
    assert {v.formulation for v in found if v.integrator == "GSTIFF"} == {"I3", "SI2"}
    assert {v.formulation for v in found if v.integrator != "GSTIFF"} == {""}


def method(cost: float, shift: Callable[[float], float]) -> Callable[..., Results]:
    """A run that is ``shift(error)`` wrong and costs ``cost`` per root of 1/ERROR."""

    def run(error: float, **options: Any) -> Results:
        summary = {**SUMMARY, "solve_cpu_s": cost * error**-0.5}
        return body(shift=2.0 * shift(error), summary=summary)

    return run


def runs(**methods: Callable[..., Results]) -> Callable[..., Results]:
    """Each integrator as its own run; the others refuse."""

    def run(integrator: str, **options: Any) -> Results:
        if integrator not in methods:
            raise UsageError(f"{integrator} cannot")
        return methods[integrator](**options)

    return run


TRIED = [Variant("ABAM"), Variant("GSTIFF"), Variant("HHT")]
ERRORS = (1e-2, 1e-4, 1e-6)


def test_the_cheapest_with_enough_digits_is_recommended() -> None:
    cheap, exact = method(1e-4, lambda e: 9 * e), method(1e-2, lambda e: 0.5 * e)
    made = measure(runs(ABAM=cheap, GSTIFF=exact), TRIED, ERRORS)
    assert not made.useless
    assert (made.recommended(3).program, made.recommended(3).setting) == ("ABAM", "ERROR=0.0001")
    assert made.recommended(6).program == "GSTIFF"
    assert made.recommended(9) is None
    assert [p.reason for p in made.points if not p.ok] == ["HHT cannot"]


def test_a_hit_by_luck_is_not_recommended() -> None:
    lucky = method(1e-9, lambda e: 1e-5 if e == 1e-2 else 2e-2 * e**0.25)
    sound = method(1.0, lambda e: e)
    made = measure(runs(HHT=lucky, GSTIFF=sound, ABAM=sound), TRIED, ERRORS)
    assert made.recommended(4).program != "HHT"


def test_no_error_is_believed_below_what_the_reference_is_known_to() -> None:
    made = measure(runs(ABAM=method(1.0, lambda e: 1e4 * e)), TRIED, (TIGHT,))
    # ERROR=1e-8 is 1e-4 off, ERROR=1e-10 is 1e-6 off: 99e-6 apart
    assert made.truth.doubt == pytest.approx(9.9e-5)
    assert made.points[0].error == made.truth.doubt
    assert "no other method" in made.truth.origin


def test_tight_runs_that_disagree_are_reported() -> None:
    chaotic = {"ABAM": method(1.0, lambda e: e), "GSTIFF": method(1.0, lambda e: 0.3 + e)}
    made = measure(runs(**chaotic), TRIED, ERRORS)
    assert made.useless and made.truth.doubt == pytest.approx(0.3)
    assert "disagrees" in made.truth.origin


def test_steps_bound_by_hmax_do_not_look_exact() -> None:
    same = {"ABAM": method(1.0, lambda e: 2e-7), "GSTIFF": method(1.0, lambda e: 1e-2 * e**0.5)}
    made = measure(runs(**same), TRIED, ERRORS)
    assert made.truth.doubt == pytest.approx(1e-7)  # how far GSTIFF is, not 0


def test_without_any_tight_run_the_reasons_are_told() -> None:
    def fails(**options: Any) -> Results:
        return body(outcome=Outcome.NEWTON_FAILED, message="JOINT/7 locks")

    with pytest.raises(RunFailed, match="JOINT/7 locks"):
        measure(runs(ABAM=fails), TRIED, ERRORS)


def test_a_run_that_takes_too_long_is_given_up() -> None:
    def slow(progress: Any, **options: Any) -> Results:
        try:
            while True:
                progress.watch(RunState(time=0.1, end=1.0))
        except KeyboardInterrupt:
            return body(outcome=Outcome.INTERRUPTED)

    results = patient(slow, 0.05)(error=1e-3)
    assert results.outcome is Outcome.INTERRUPTED and "given up" in results.message


def test_an_interruption_by_the_user_goes_on() -> None:
    def interrupted(**options: Any) -> Results:
        return body(outcome=Outcome.INTERRUPTED)

    with pytest.raises(KeyboardInterrupt):
        patient(interrupted, 1e6)(error=1e-3)


def test_runs_given_up_do_not_spoil_looser_ones() -> None:
    points = [
        Point(program="HHT", setting="loose", error=1e-4, cpu=[1.0]),
        Point(program="HHT", setting="tight", reason="too long", given_up=True),
    ]
    made = Chart(points, Truth(body(), 0.0, ""))
    assert made.recommended(4).setting == "loose"


@pytest.mark.parametrize(
    "heights, least",
    [([0.5, 0.5, 0.5], 0.1), ([0.0, 1.0], 0.1), ([0.3, 0.31, 0.29, 0.9, 0.305], 0.05)],
)
def test_names_keep_their_order_and_do_not_touch(heights: list[float], least: float) -> None:
    places = spread(heights, least)
    order = np.argsort(heights, kind="stable")
    gaps = np.diff(np.array(places)[order])
    assert (gaps >= least - 1e-12).all()
    assert np.mean(places) == pytest.approx(np.mean(heights))


@pytest.fixture
def deck(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    Path("spring.adm").write_text(SPRING)
    return "spring.adm"


def test_a_deck_is_charted(deck: str, capsys: pytest.CaptureFixture) -> None:
    pytest.importorskip("matplotlib")
    assert main(["chart", deck, "--error", "1e-3", "1e-6", "--repeats", "2"]) == 0
    out = capsys.readouterr().out
    assert "recommended: " in out and "digits" in out
    rows = list(csv.DictReader(Path("spring-chart.csv").open()))
    programs = {row["program"] for row in rows}
    assert programs == {v.label for v in variants()}
    assert all(float(row["error"]) < 0.1 for row in rows if row["program"] == "GSTIFF SI2")
    assert Path("spring-chart.png").read_bytes().startswith(b"\x89PNG")
    assert "GSTIFF" in Path("spring-chart.svg").read_text()


def test_without_matplotlib_all_but_the_drawing_is_done(
    deck: str, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    def absent() -> None:
        raise UsageError(drawing.ABSENT)

    monkeypatch.setattr(drawing, "need_matplotlib", absent)
    assert main(["chart", deck, "--error", "1e-3", "--repeats", "1", "-o", "mine"]) == 0
    out, err = capsys.readouterr()
    assert "recommended" in out or "no run has" in out
    assert "matplotlib" in err and sorted(p.name for p in Path().glob("mine*")) == ["mine.csv"]


@pytest.mark.parametrize(
    "words, code, told",
    [
        (["--integrator", "EULER"], 2, "there are ABAM"),
        (["--channel", "POINT_MASS/2.q"], 2, "POINT_MASS/2.x"),
        (["--error", "0"], 2, "positive"),
        (["-o", "nowhere/x"], 5, "no such folder"),
    ],
)
def test_what_cannot_be_charted_is_told(
    deck: str, capsys: pytest.CaptureFixture, words: list[str], code: int, told: str
) -> None:
    assert main(["chart", deck, *words]) == code
    assert told in capsys.readouterr().err
    assert not list(Path().glob("*.csv"))


def test_a_deck_without_motion_has_nothing_to_choose(deck: str, capsys) -> None:
    Path(deck).write_text(SPRING.replace("SIMULATE/DYNAMIC, END=1, STEPS=10", "SIMULATE/STATICS"))
    assert main(["chart", deck]) == 2
    assert "nothing to choose" in capsys.readouterr().err

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
from figure_checks import assert_legible
from tiers import every

from adamslite.cli.main import main
from adamslite.elements.integrator import Integrator
from adamslite.errors import RunFailed, UsageError
from adamslite.language.method import AUTO
from adamslite.plots import style
from adamslite.plots.accuracy_chart import accuracy_chart, limited
from adamslite.plots.cost_charts import IMPLICIT, LIMIT, OURS, Line, front
from adamslite.plots.style import looks_of_methods, looks_of_peers
from adamslite.progress import RunState
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.results.run_error import error_of
from adamslite.verification.variants import Variant, patient, variants
from adamslite.verification.work_precision import (
    TIGHT,
    Chart,
    Point,
    Truth,
    alike,
    by_steps,
    measure,
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


def points(program: str, *rows: tuple[float, float, int]) -> list[Point]:
    """(error, CPU [s], steps) from loose to tight."""
    return [
        Point(program=program, setting=f"ERROR=1e-{k}", error=error, cpu=[cpu], steps=steps)
        for k, (error, cpu, steps) in enumerate(rows, 1)
    ]


def made_of(*groups: list[Point]) -> Chart:
    return Chart([p for group in groups for p in group], Truth(body(), 1e-12, "a tight run"))


def test_what_timing_cannot_tell_apart_is_chosen_by_its_digits() -> None:
    """1.00 ms for 3 digits, 1.03 ms for 9: the same time."""
    quick = points("HHT", (1e-3, 1.00e-3, 100))
    exact = points("ABAM", (1e-9, 1.03e-3, 90))
    slower = points("RADAU", (1e-12, 1.5e-3, 90))
    assert made_of(quick, exact, slower).recommended(3).program == "ABAM"
    exact[0].cpu = [1.04e-3, 1.5e-3, 1.6e-3]  # its quickest run is as quick
    assert made_of(quick, exact).recommended(3).program == "ABAM"
    exact[0].cpu = [1.2e-3, 1.2e-3, 1.3e-3]
    assert made_of(quick, exact).recommended(3).program == "HHT"


def test_runs_with_the_same_steps_and_error_are_one() -> None:
    mine = points("HHT", (1e-3, 1.0, 402), (1e-3, 1.0, 402), (1e-3, 1.0, 402), (2e-4, 1.0, 402),
                  (1e-5, 1.0, 900))  # fmt: skip
    assert [len(group) for group in by_steps(mine)] == [4, 1]
    assert [len(group) for group in alike(mine)] == [3, 1, 1]
    assert limited(made_of(mine)) == ["HHT (4 ERROR, 402 steps)"]
    assert limited(made_of(mine[3:])) == []


def test_the_pareto_front_has_the_cheapest_for_every_error() -> None:
    ours = Line("HHT", OURS, [1e-1, 1e-3, 1e-5], [1.0, 3.0, 9.0])
    peer = Line("scipy BDF", IMPLICIT, [1e-2, 1e-6], [2.0, 8.0])
    bound = Line("C RK4", LIMIT, [1e-9], [0.1])
    assert front([ours, peer, bound]) == [(1e-6, 8.0), (1e-3, 3.0), (1e-2, 2.0), (1e-1, 1.0)]


def test_every_method_has_a_colour_and_a_marker_of_its_own() -> None:
    names = [variant.label for variant in variants()]
    found = looks_of_methods([*names, "AUTO", "EULER", "LEAPFROG"])
    assert len({look.marker for look in found.values()}) == len(found)
    assert len({look.color for name, look in found.items() if name in names}) == len(names)


def test_other_programs_differ_in_colour_or_marker() -> None:
    names = ["scipy BDF", "scipy LSODA", "Exudyn RK44", "MuJoCo RK4", "unheard of"]
    found = looks_of_peers(names, lambda name: "RK" in name)
    assert len({(look.color, look.marker) for look in found.values()}) == len(names)
    assert found["Exudyn RK44"].dashes != found["scipy BDF"].dashes == "-"


def drawn(chart: Chart, **options: Any) -> Any:
    pytest.importorskip("matplotlib")
    figure = accuracy_chart(chart, "spring.adm", **options)
    assert_legible(figure)
    return figure


def heading(figure: Any) -> str:
    return " ".join(text.get_text() for text in figure.texts)


@pytest.mark.slow
def test_the_chart_says_what_is_recommended_and_what_limits_the_steps() -> None:
    slow = points("HHT", (1e-2, 2e-3, 402), (1e-4, 2e-3, 402), (1e-6, 2e-3, 402))
    quick = points("ABAM", (1e-2, 1e-4, 20), (1e-5, 2e-4, 40), (1e-9, 4e-4, 80))
    figure = drawn(made_of(slow, quick), digits=3)
    words = heading(figure)
    assert "ABAM at ERROR=1e-2 is the cheapest with 3 digits: 0.2 ms for 5" in words
    assert "Reference: a tight run." in words
    assert "whatever ERROR, of HHT (3 ERROR, 402 steps)" in words
    (axis,) = figure.axes
    assert "part of the longest travel" in axis.get_xlabel()
    assert {"better", "ERROR=1e-2"} <= {text.get_text() for text in axis.texts}
    named = drawn(made_of(slow, quick), channels=["PART/2.x"])
    assert named.axes[0].get_xlabel().startswith("largest error of PART/2.x, part of the largest")


@pytest.mark.parametrize("across", every(3, [1e-14, 1e-9, 1e-4, 1e-1, 1.0]))
def test_a_single_point_is_legible_wherever_it_is(across: float) -> None:
    others = points("HHT", (1.0, 1.0, 10), (1e-14, 2.0, 20))
    drawn(made_of(points("ABAM", (across, 1e-3, 5))), digits=1)
    drawn(made_of(points("ABAM", (across, 1e-3, 5)), others), digits=1)


def test_infinite_errors_and_times_below_the_clock_are_drawn_as_far_as_they_can_be() -> None:
    coarse = points("HHT", (np.inf, 1e-3, 5), (1e-2, 0.0, 10), (1e-4, 0.0, 20))
    figure = drawn(made_of(coarse, points("ABAM", (np.inf, 1e-3, 5))))
    (line,) = [each for each in figure.axes[0].get_lines() if len(each.get_xdata()) == 2
               and each.get_marker() == "v"]  # fmt: skip
    assert list(line.get_xdata()) == [1e-2, 1e-4]
    assert accuracy_chart(made_of(coarse[:1]), "spring.adm") is None


def test_a_chart_without_a_recommendation_says_so() -> None:
    coarse = made_of(points("HHT", (1e-1, 1.0, 5)))
    assert "No setting has 3 digits" in heading(drawn(coarse))
    assert "do not agree" in heading(drawn(Chart(coarse.points, Truth(body(), 0.3, "x"))))
    assert accuracy_chart(made_of(), "spring.adm") is None


@pytest.fixture
def deck(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    Path("spring.adm").write_text(SPRING)
    return "spring.adm"


@pytest.mark.slow
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
        raise UsageError(style.ABSENT)

    monkeypatch.setattr(style, "need_matplotlib", absent)
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

"""Ropes beside other programs: closed forms, ours, and those of the others that are installed."""

from __future__ import annotations

import pytest
from tiers import slow

from benchmarks import beside, rope_cases
from benchmarks.rope_cases import LIGHT, LOWERED, MOORED, RopeRun

#: What each program leaves of its scene, relative.
LEFT = {
    ("lowered", "exudyn"): 0.286, ("lowered", "moordyn"): 0.45, ("moored", "moordyn"): 3e-3,
    ("moored", "moorpy"): 1e-9, ("shaken", "moordyn"): 1e-2, ("moved", "moordyn"): 1e-2,
    ("moved", "adamslite"): 2.5e-3,
}  # fmt: skip
DEAR = ("10 segments", "76 segments", "25 segments", "50 segments", "68 segments")


def named(run: RopeRun) -> str:
    return f"{run.scene}, {run.package}, {run.setting}"


@pytest.mark.parametrize(
    "index",
    [
        slow(k, id=named(run)) if run.setting.startswith(DEAR) else pytest.param(k, id=named(run))
        for k, run in enumerate(beside.RUNS)
    ],
)
def test_a_program_solves_the_scene(index: int) -> None:
    run = beside.RUNS[index]
    if not beside.installed(run):
        pytest.skip(f"{run.package} is not installed")
    found, exact = beside.answer(index), rope_cases.closed_form(run.scene)
    assert found is not None
    error = abs(found.value / exact - 1) if exact else found.value
    assert error < LEFT.get((run.scene, run.package), 1e-3)


def test_closed_forms() -> None:
    """A weight of 1000 kg and 72 m of rope in the mean; (M g less M S") over the second second."""
    assert rope_cases.closed_form(LOWERED) == pytest.approx((1000 + 5.536 * 72) * 9.81, rel=1e-9)
    gained = rope_cases.payout(2.0)[1] - rope_cases.payout(1.0)[1]
    assert rope_cases.closed_form(LIGHT) == pytest.approx(1000 * (9.81 - gained), abs=3)
    assert rope_cases.closed_form(MOORED) == pytest.approx(2065.496, rel=1e-6)


def test_a_reeving_spring_lacks_the_weight_of_the_rope() -> None:
    """At the top M g instead of (M + rho l) g: 28 % in this scene."""
    index = next(
        k for k, r in enumerate(beside.RUNS) if (r.scene, r.package) == (LOWERED, "exudyn")
    )
    if not beside.installed(beside.RUNS[index]):
        pytest.skip("exudyn is not installed")
    found = beside.answer(index)
    assert found is not None
    assert found.value == pytest.approx(1000 * 9.81, rel=1e-4)


def test_the_page_has_a_line_for_every_run() -> None:
    page = beside.PAGE.read_text(encoding="utf-8")
    rows = [line.split(" | ") for line in page.splitlines() if line.startswith("| ")][1:]
    kept = [(cells[0].removeprefix("| "), cells[1], cells[2]) for cells in rows]
    assert kept == [(rope_cases.TITLES[r.scene], r.package, r.setting) for r in beside.RUNS]

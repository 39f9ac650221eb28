"""The events of a run, from its results or from their file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scenes import GROUND, run

from adamslite.results.events import Event, events_of
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

FALL = (
    GROUND
    + """\
ACCGRAV/KGRAV=-10
POINT_MASS/2, MASS=1, CM=2
MARKER/2, POINT_MASS=2
SENSOR/1, LE, FUNCTION=DZ(2), VALUE=-5, ERROR=1E-6, {}
END
"""
)


def table(**facts) -> Results:
    time = np.array([0.0, 1.0, 2.0, 3.0])
    names = ("CONTACT/1.incidents", "PART/2.x")
    values = np.column_stack([[0.0, 2.0, 2.0, 0.0], time])
    return Results(time=time, names=names, values=values, **facts)


def test_a_sensor_that_ends_the_run_is_an_event(tmp_path: Path) -> None:
    """A fall of 5 m at 10 m/s^2 takes 1 s."""
    results = run(FALL.format("HALT"), 2.0, 20, error=1e-7)
    assert results.outcome is Outcome.HALTED
    results.save(tmp_path / "fall.csv")
    for found in (events_of(results), events_of(Results.load(tmp_path / "fall.csv"))):
        assert len(found) == 1
        assert abs(found[0].time - 1.0) < 1e-5
        assert found[0].text.startswith("ended by SENSOR/1 at t = ")


def test_contacts_begin_and_end_at_output_times() -> None:
    assert events_of(table()) == [
        Event(1.0, "CONTACT/1 touches by t = 1"),
        Event(3.0, "CONTACT/1 parts by t = 3"),
    ]


def test_an_early_end_is_the_last_event(tmp_path: Path) -> None:
    results = table(outcome=Outcome.NEWTON_FAILED, message="JOINT/7 locks")
    results.save(tmp_path / "early.csv")
    for found in (results, Results.load(tmp_path / "early.csv")):
        assert events_of(found)[-1] == Event(3.0, "stopped early at t = 3: NEWTON_FAILED")


def test_several_of_a_comment_are_in_the_order_of_time() -> None:
    passed = "SENSOR/2 at t = 0.25; SENSOR/1 at t = 2e-1 and 3 times later"
    meta = {"no number": "PART/2.x at t = 2.5", "sensor passed": passed}
    assert [e for e in events_of(table(meta=meta)) if "CONTACT" not in e.text] == [
        Event(0.2, "SENSOR/1 at t = 2e-1 and 3 times later"),
        Event(0.25, "SENSOR/2 at t = 0.25"),
        Event(2.5, "no number in PART/2.x at t = 2.5"),
    ]


def test_empty_results_have_no_events() -> None:
    empty = Results(time=np.empty(0), names=(), values=np.empty((0, 0)), outcome=Outcome.TORN)
    assert events_of(empty) == []

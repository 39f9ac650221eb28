"""The first tries of a run, which are made without a thread as long as they take little time."""

from __future__ import annotations

import threading

import pytest
from scenes import GROUND, done

from adamslite.analyses.dynamics import dynamic
from adamslite.equations.system import System

POINT = GROUND + "POINT_MASS/2, MASS=1, CM=2, QG=1,0,0\nMARKER/2, POINT_MASS=2\n"


@pytest.mark.parametrize(("each", "watched"), [(0.0, False), (1e-3, False), (0.02, True)])
@pytest.mark.parametrize("method", ("HHT", "ABAM", "VERLET"))
def test_tries_that_take_long_are_watched_after_a_few(
    method: str, each: float, watched: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """20 000 forces on one part: its unknowns are few, and 4 000 tries took 20 s in the thread in
    which nothing is heard.
    """
    integrate, calls = System.integrate, []

    def noted(system: System, entry: str) -> int:
        calls.append((threading.current_thread(), int(system.settings.pause)))
        return integrate(system, entry)

    monkeypatch.setattr(System, "integrate", noted)
    monkeypatch.setattr(dynamic, "thread_time", lambda: each * len(calls))
    done(POINT + "VFORCE/1, I=2, J_PART=1, FX=-DX(2)\nEND\n", 50.0, integrator=method, hmax=0.01)
    threads, pauses = zip(*calls, strict=True)
    assert pauses[0] == dynamic.FEW and len(calls) > 1
    assert (threads[-1] is not threading.main_thread()) == watched
    if watched:
        assert set(threads[:-1]) == {threading.main_thread()} and pauses == (dynamic.FEW, 0)


@pytest.mark.parametrize("method", ("HHT", "ABAM"))
def test_a_pause_is_no_try(method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Or AUTO would look at a run after as many tries as the machine left it pauses."""
    integrate, systems = System.integrate, []

    def noted(system: System, entry: str) -> int:
        systems.append(system)
        return integrate(system, entry)

    monkeypatch.setattr(System, "integrate", noted)
    counts = []
    for unwatched in (0.0, 1e9):
        monkeypatch.setattr(dynamic, "UNWATCHED", unwatched)
        before = len(systems)
        done(
            POINT + "VFORCE/1, I=2, J_PART=1, FX=-DX(2)\nEND\n", 50.0, integrator=method, hmax=0.01
        )
        counts.append((len(systems) - before, int(systems[-1].count.tries)))
    (calls, tries), (more, same) = counts
    assert calls == 1 < more and tries == same > 1000

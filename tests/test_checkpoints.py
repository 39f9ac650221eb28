"""Blocks of records and states of runs, within one process."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from unfinished_scenes import box, chain, pendulum

import adamslite as al
from adamslite.analyses.dynamics import checkpoint, dynamic, history
from adamslite.analyses.dynamics.history import History, Journal, Piece
from adamslite.analyses.session.session import Session
from adamslite.analyses.simulation import simulate
from adamslite.elements.simulate import Simulate
from adamslite.equations.system import System
from adamslite.integrators.verlet.control import Control
from adamslite.results.outcomes import Outcome

#: Methods, and the deck that each runs here.
METHODS = {
    "GSTIFF": pendulum, "CONSTANT_BDF": pendulum, "HHT": pendulum, "NEWMARK": pendulum,
    "RADAU": pendulum, "RKF45": pendulum, "VERLET": chain,
}  # fmt: skip


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("room", [150, 1000])
def test_where_blocks_end_changes_no_number(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, method: str, room: int
) -> None:
    """Steps that cover many output times, where the method interpolates."""
    deck = al.read(METHODS[method](5, 700))
    hmax = 0.01 if method == "CONSTANT_BDF" else 1.0
    whole = al.simulate(deck, integrator=method, hmax=hmax)
    monkeypatch.setattr(dynamic, "ROOM", room)
    monkeypatch.setattr(history, "MOST", 0)
    path = tmp_path / "x.part"
    parts = simulate(deck, integrator=method, hmax=hmax, journal=Journal(path, dict))
    assert path.exists() and parts.count == 701
    assert np.array_equal(parts.values, whole.values) and parts.meta == whole.meta


@pytest.mark.parametrize(
    ("words", "end"),
    [
        pytest.param("", 600, id=""),
        pytest.param("HINIT=2E-3", 400, id="equal steps"),
        pytest.param("ERROR=1E-7", 120, id="short steps", marks=pytest.mark.slow),
    ],
)
def test_verlet_is_held_between_outputs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: str, end: float
) -> None:
    """States are asked for wherever there may be one; none changes a number."""
    given = f"INTEGRATOR/VERLET{', ' * bool(words)}{words}\n"
    text = chain(end, 2).replace("SIMULATE", f"{given}SIMULATE")
    whole, inside = al.simulate(al.read(text)), []
    write = checkpoint.write

    def noted(*given: Any) -> None:
        inside.append(given[5].control[Control.fields["step"].at] != 0)
        write(*given)

    class Asking(history.Outlet):
        def begin(self) -> int | None:
            self.system.block.hold = True
            return super().begin()

        def take(self, code: int) -> None:
            super().take(code)
            self.system.block.hold = len(inside) < 200

    monkeypatch.setattr(history, "Outlet", Asking)
    monkeypatch.setattr(checkpoint, "write", noted)
    monkeypatch.setattr(history, "SETTLED", 0.0)
    monkeypatch.setattr(history, "EVERY", 0.0)
    monkeypatch.setattr(history, "LONG", 1e9)
    monkeypatch.setattr(dynamic, "WATCH_INTERVAL", 1e-4)
    parts = simulate(al.read(text), journal=Journal(tmp_path / "x.part", dict))
    assert any(inside)
    assert np.array_equal(parts.values, whole.values) and parts.meta == whole.meta
    for count in ("steps", "rejected"):
        assert parts.summary[count] == whole.summary[count]


@pytest.mark.parametrize("method", METHODS)
def test_a_state_holds_what_native_code_changes(
    monkeypatch: pytest.MonkeyPatch, method: str
) -> None:
    """Everything that is left out is as it was before the run."""
    deck = al.read(METHODS[method](2, 20))
    native, changed = dynamic.integrate, []

    def compared(system: System, *rest: Any) -> Outcome:
        before = {name: each.copy() for name, each in everything(system)}
        outcome = native(system, *rest)
        kept = {id(each) for each in states(system)}
        for name, each in everything(system):
            if id(each) not in kept and name not in ("record", "times"):
                assert np.array_equal(each, before[name]), name
            changed.append(not np.array_equal(each, before[name]))
        reals = [id(each) for each in system.instances.keep[1::2]]
        assert set(reals) <= kept
        return outcome

    monkeypatch.setattr("adamslite.analyses.session.session.integrate", compared)
    session = Session(deck, None, {"method": method})
    session.execute(deck.of(Simulate))
    assert session.outcome is Outcome.DONE and any(changed)


def states(system: System) -> list[np.ndarray]:
    return [each for _, each in checkpoint.arrays_of(system)]


def everything(system: System) -> Iterator[tuple[str, np.ndarray]]:
    """Arrays that native code sees."""
    for record in system.records():
        for name in record.references:
            value = getattr(record, name)
            yield name, getattr(value, "numbers", value)
    yield from ((f"instances {k}", each) for k, each in enumerate(system.instances.keep))


def test_rows_of_a_step_that_is_taken_back_are_taken_away() -> None:
    """The rows 4 to 7 were written in a step from which the method went back behind row 3."""
    deck = al.read(box(1, 10))
    session = Session(deck, None, {})
    system = session.system
    system.start_record(np.linspace(0.0, 1.0, 11), room=4)
    session.before = session.history.mark()
    wanted = np.arange(11) != 2
    for first in (0, 4):
        system.count.records = system.block.row = first + 4
        system.record[:] = 1.0 + first
        session.spill(system, system.times, wanted)
    assert session.history.count == 7 and system.block.first == 8
    system.block.row = 3
    session.spill(system, system.times, wanted)
    assert session.history.count == 2 and system.block.first == 3
    assert session.history.whole.times == pytest.approx([0.0, 0.1])
    system.block.row = 0
    session.spill(system, system.times, wanted)
    assert session.history.count == 0


def test_a_history_is_one_table_wherever_its_rows_are(tmp_path: Path) -> None:
    found = History()
    found.extend(Piece(np.arange(3.0), ("a", "b"), np.arange(6.0).reshape(3, 2)))
    found.extend(Piece(np.arange(3.0, 5.0), ("b", "c"), np.arange(4.0).reshape(2, 2)))
    assert found.names == ("a", "b", "c") and found.count == 5
    times, values = found.whole.times, found.whole.values
    assert np.array_equal(times, np.arange(5.0))
    assert np.isnan(values[:3, 2]).all() and np.isnan(values[3:, 0]).all()
    part = checkpoint.begin(tmp_path / "x.part", {}, 1.0)
    found.file(part)
    assert np.array_equal(found.whole.values, values, equal_nan=True)

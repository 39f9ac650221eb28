"""Native functions of derivatives: all are part of an entry, and Python finds what they find."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np
import pytest
from test_adjoint import DOUBLE
from test_engine import DERIVATIVES, TAPE, defined

import adamslite as al
from adamslite.equations.engine import engine_parts
from adamslite.integrators import motion_equations
from adamslite.native.translate import REGISTERED, call_address
from adamslite.sensitivity import begin, start, study, tangents, taped
from adamslite.sensitivity.transposed import ENTRY

ENTRIES = [*taped.FORMULAS.values(), ENTRY]


def test_every_native_function_of_derivatives_is_part_of_an_entry() -> None:
    for entry in ENTRIES:
        import_module(entry.rpartition(".")[0])
    own = {name for name, code in REGISTERED.items() if code.__module__.startswith(DERIVATIVES)}
    made = {name for entry in ENTRIES for part in engine_parts(entry) for name in defined(part)}
    assert own
    assert not own - made


class Interpreted:
    """Lets Python follow tapes, with the records that native code is given.

    Attributes
    ----------
    entries : list of str
        Entries that were followed.
    """

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.entries: list[str] = []
        self.records: list[Any] = []
        followed, collected, forward = taped.followed, taped.Collected, taped.Forward.zeros

        def along(system: Any, *given: Any) -> Any:
            self.records[:] = system.records()
            return followed(system, *given)

        def tangents_of(*given: Any) -> Any:
            made = collected(*given)
            self.records.append(made.record)
            return made

        def zeros() -> Any:
            self.records.append(forward())
            return self.records[-1]

        patch.setattr(study, "followed", along)
        patch.setattr(taped, "Collected", tangents_of)
        patch.setattr(taped.Forward, "zeros", staticmethod(zeros))
        patch.setattr(taped, "_native", self.entry)
        for room in (motion_equations, tangents, start, begin):
            patch.setattr(room, "call_address", call_address, raising=False)

    def entry(self, name: str) -> Any:
        room, _, function = name.rpartition(".")
        self.entries.append(name)
        return lambda *_: getattr(import_module(room), function)(*self.records)


@pytest.mark.parametrize("method", sorted(taped.FORMULAS))
@pytest.mark.parametrize("exact", [False, True])
def test_python_finds_what_native_code_finds(
    method: str, exact: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A mechanism with a state and a load that jumps, along the same steps."""
    monkeypatch.setattr(taped, "EXACT", exact)
    jump = "SFORCE/2, ROTATION, I=30, J=21, FUNCTION=IF(TIME-0.05: 0, 1, 1)\nEND\n"
    text, by = DOUBLE.replace("END\n", jump), ["PART/2.MASS", "PART/3.IP[2]", "MARKER/21.QP[0]"]
    run: dict[str, Any] = {"end": 0.1, "steps": 2, "error": 1e-4, "integrator": method}
    natively = al.sensitivities(text, by, **run)
    python = Interpreted(monkeypatch)
    by_python = al.sensitivities(text, by, **run)
    assert set(python.entries) == {taped.FORMULAS[method]}
    size = np.abs(natively.curves).max()
    assert size > 0.0
    assert np.abs(by_python.curves - natively.curves).max() <= 1e-9 * size


def test_the_tape_is_written_by_runs_that_are_asked_for_derivatives() -> None:
    """What `test_engine` leaves out of its runs: every kind of row is written and followed."""
    written: list[Any] = []

    class Kept(taped.Taped):
        def follow(self, system: Any, method: str) -> None:
            tape = system.tape
            written.append(tape.data[: tape.rows * tape.width].reshape(tape.rows, -1).copy())

    jump = "SFORCE/2, ROTATION, I=30, J=21, FUNCTION=IF(TIME-0.05: 0, 1, 1)\nEND\n"
    scene = study.Study(al.read(DOUBLE.replace("END\n", jump)), (), {"end": 0.1, "steps": 2})
    scene.session(Kept, scene.kernels).execute(scene.plan)
    (rows,) = written
    times, kinds = rows[:, 0], rows[:, 3]
    assert (np.diff(times) >= 0.0).all()
    assert times[[0, -1]] == pytest.approx([0.0, 0.1], abs=0.02)
    assert sorted(set(kinds)) == [0.0, 1.0, 2.0]
    assert times[kinds == 2.0] == pytest.approx([0.05], abs=1e-9)
    shared = {name.rpartition(".")[2] for name in REGISTERED if ".audit.tape." in name}
    assert shared == TAPE

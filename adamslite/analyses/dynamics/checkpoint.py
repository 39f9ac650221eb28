"""What a killed session goes on from, to the same bytes.

A session is repeated from its commands: reading, assembling and everything else that Python does
gives the same each time.  What takes long is the native code of its runs, each with a number.  Of
those the file of the session (:mod:`adamslite.outputs.part_file`) holds

    the last            all arrays that native code changes, and its code, at the last look,
    every long one      the same where it has ended,

so that a resumed session takes a run that has ended from there, goes on with the last one, and does
again what is short.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.errors import FormatError
from adamslite.integrators import contract
from adamslite.native.translate.records import ByReference, Nested, Record, Rows
from adamslite.outputs.part_file import DAMAGED, Filed, PartFile, Stretch

if TYPE_CHECKING:
    from adamslite.equations.system import System

#: Arrays with addresses, and those that Python fills before a run.
WITHOUT = frozenset(("group", "lane_runs", "times", "record", "stops", "paces"))
#: Records that native operations leave alone, and that other threads write to.
SHARED = ("settings", "block")
#: The number of no run: a session that begins.
NONE = -1
ELSEWHERE = "it is of another run"


def begin(path: Path, facts: Mapping[str, Any], end: float) -> PartFile:
    """The file of a session that has not got anywhere yet."""
    none: dict[str, Any] = {"names": [], "stretches": [], "run": NONE, "code": None, "ends": {}}
    return PartFile.create(path, {"facts": facts, **none, "time": 0.0, "end": end})


def write(
    part: PartFile,
    facts: Mapping[str, Any],
    stretches: Sequence[Stretch],
    ends: dict[int, Sequence[Any]],
    run: int,
    system: System,
    code: int | None = None,
) -> None:
    """Have a state count: that of a run that goes on, or of one that has ended with ``code``, which
    is kept from then on.
    """
    names, listed = _listed(stretches)
    state = {
        "facts": facts, "names": names, "stretches": listed, "run": run, "code": code,
        "ends": {**ends}, "time": float(system.report.t), "end": float(system.settings.t_end),
    }  # fmt: skip
    place = part.write_state(state, dict(arrays_of(system)), kept=code is not None)
    if code is not None:
        ends[run] = place
        place = part.write_state({**state, "ends": {**ends}}, {})
    part.commit(place)


def known_ends(part: PartFile) -> dict[int, Sequence[Any]]:
    """Where the ends of long runs are, by their numbers."""
    return {int(run): place for run, place in part.state["ends"].items()}


def resumed(
    part: PartFile, ends: Mapping[int, Sequence[Any]], run: int, system: System
) -> tuple[int, list[Stretch]] | None:
    """Put a run where the file has it: its code when it has ended, HELD when it goes on, and the
    rows so far; None when nothing is known of it.
    """
    if run in ends:
        state, arrays = part.load(ends[run])
    elif run == part.state.get("run") and part.state["code"] is None:
        state, arrays = part.state, part.arrays
    else:
        return None
    restore(system, arrays, part.path)
    code = contract.HELD if state["code"] is None else int(state["code"])
    return code, list(_stretches(part, state))


def arrays_of(system: System) -> Iterator[tuple[str, np.ndarray]]:
    """Everything that native code may change in a run, by name, in place."""
    yield from _of_record("", system.records()[0])
    for k, reals in enumerate(system.instances.keep[1::2]):
        yield f"reals {k}", reals
    yield "rows", system.rows.reshape(-1)


def _of_record(name: str, record: Record) -> Iterator[tuple[str, np.ndarray]]:
    """The numbers of a record and of those inside, arrays that it refers to."""
    for word, field in record.fields.items():
        value, label = getattr(record, word), f"{name}{word}"
        if isinstance(field, Nested) and value.refers:
            yield from _of_record(f"{label}.", value)
        elif isinstance(field, ByReference):
            if word not in WITHOUT:
                yield label, value.numbers if isinstance(value, Rows) else value
        else:
            yield label, record._ints[field.at : field.at + field.slots]


@contextmanager
def undisturbed(system: System) -> Iterator[None]:
    """Restore the memory of a paused run on exit: operations may overwrite it in between.

    Vectors of a method are scratch space of :mod:`adamslite.equations.operations`, so every
    operation between two calls of a method belongs inside.
    """
    time = system.settings.t
    kept = [(own, own.copy()) for name, own in arrays_of(system) if name not in SHARED]
    try:
        yield
    finally:
        system.settings.t = time
        for own, values in kept:
            own[:] = values


def restore(system: System, arrays: Mapping[str, np.ndarray], path: Path) -> None:
    """Put back what :func:`arrays_of` gave of an equal system in another process, but for limits:
    those of this run hold, and what crept up to one that has gone does not count.
    """
    problem = system.records()[0]
    budget = problem.budget
    most, short = int(budget.most), float(budget.short)
    rows = arrays.get("rows", np.zeros(0))
    if rows.size > system.record.size:
        raise FormatError(DAMAGED.format(path=path, why=ELSEWHERE))
    system.record[: rows.size] = rows
    for name, own in arrays_of(system):
        if name == "rows":
            continue
        kept = arrays.get(name)
        if kept is None or kept.size != own.size or kept.dtype != own.dtype:
            raise FormatError(DAMAGED.format(path=path, why=ELSEWHERE))
        own[:] = kept
    budget.most, budget.short, budget.crept = most, short, float(budget.crept) if short else 0.0
    problem.settings.stop = problem.block.hold = False


def _listed(stretches: Sequence[Stretch]) -> tuple[list[list[str]], list[list[int | None]]]:
    """Names of columns, each list once, and where rows with them are."""
    names: dict[tuple[str, ...], int] = {}
    listed: list[list[int | None]] = []
    for each in stretches:
        assert isinstance(each, Filed)
        number = names.setdefault(each.names, len(names))
        listed.append([number, each.at, each.count, each.sum])
    return [list(each) for each in names], listed


def _stretches(part: PartFile, state: Mapping[str, Any]) -> Iterator[Filed]:
    names = [tuple(map(str, each)) for each in state["names"]]
    for number, at, count, sum_ in state["stretches"]:
        found = Filed(part, names[number], at, count, sum_)
        found.check()
        yield found

"""What is carried out, and the output times of an analysis."""

from __future__ import annotations

from collections.abc import Iterable
from math import ceil
from typing import TYPE_CHECKING

import numpy as np

from adamslite.elements.simulate import MOST_STEPS, STEPS, Simulate, output_steps
from adamslite.equations.result_columns import column_names
from adamslite.errors import UsageError
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from pathlib import Path

    from adamslite.deck.deck import Deck
    from adamslite.deck.redefinition import Command
    from adamslite.equations.system import System

SETTINGS = ("INTEGRATOR", "EQUILIBRIUM", "KINEMATICS")
# Numbers of a run whose size is not worth a thought.
SMALL = 10_000_000
# A last interval shorter than this share of the whole is no interval of its own.
ROUND_OFF = 1e-9
# Times that are looked at together.
PART = 2**16


def output_times(command: Simulate, start: float) -> np.ndarray:
    """Times (nt,) from ``start`` to END (or over DURATION), STEPS of them or one every DTOUT.

    A SIMULATE without an end has the one time ``start``.

    Raises
    ------
    UsageError
        When END is not after ``start``, or there are more than ``MOST_STEPS`` output steps.
    """
    end = command.end if command.end is not None else None
    if end is None and command.duration is not None:
        end = start + command.duration
    if end is None:
        return np.array([start])
    return spread_times(start, end, command.steps, command.dtout)


def rows_of(commands: Iterable[Command]) -> int:
    """How many rows the analyses write, but for those whose begin is not known beforehand."""
    at: float | None = 0.0
    rows = 0
    for command in commands:
        if command.keyword == "RELOAD":
            at = None
        if not isinstance(command, Simulate) or command.at_once:
            continue
        start, at = at, command.end if at is None else command.until(at)
        if start is not None and at is not None:
            rows += 1 + ceil(output_steps(max(0.0, at - start), command.steps, command.dtout))
    return rows


def spread_times(start: float, end: float, steps: int | None, dtout: float | None) -> np.ndarray:
    """Times from ``start`` to ``end``: ``steps`` equal intervals, or one every ``dtout``."""
    _need_span(start, end, steps, dtout)
    if steps is None and dtout:
        whole = (end - start) / dtout
        steps = max(1, round(whole))
        if abs(steps - whole) > ROUND_OFF * max(1.0, whole):
            return np.append(np.arange(start, end - ROUND_OFF * dtout, dtout), end)
    return _even_times(start, end, steps or STEPS)


def _even_times(start: float, end: float, steps: int) -> np.ndarray:
    """The bits of ``numpy.linspace(start, end, steps + 1)``, some at a time, so that the user can
    interrupt it.
    """
    step = (end - start) / steps
    if steps < PART or step == 0.0:
        return np.linspace(start, end, steps + 1)
    times = np.empty(steps + 1)
    for first in range(0, steps + 1, PART):
        part = np.arange(first, min(first + PART, steps + 1), dtype=float)
        times[first : first + PART] = part * step + start
    times[-1] = end
    return times


def _need_span(start: float, end: float, steps: int | None, dtout: float | None) -> None:
    """Raise UsageError where there are no such times, or too many."""
    if end < start or (steps is not None and steps < 1):
        raise UsageError(
            f"The end time {end:g} must not lie before {start:g}, with at least one step."
        )
    if output_steps(end - start, steps, dtout) > MOST_STEPS:
        raise UsageError(
            f"There may be {MOST_STEPS:.0e} output steps: fewer STEPS, a longer DTOUT."
        )


def largest_step(times: np.ndarray) -> float:
    """Between output times (nt,), of which there may be too many for another array as long."""
    parts = (times[first : first + PART + 1] for first in range(0, len(times) - 1, PART))
    return max((float(np.diff(part).max()) for part in parts), default=0.0)


def plan_of(
    deck: Deck, commands: tuple[Command, ...], end: float | None, steps: int | None
) -> list[Command]:
    """What to carry out: settings of the deck, then the commands, or the deck's own SIMULATE
    statements.

    Flags replace the last SIMULATE, where it stands; one that takes no time is not replaced.
    """
    own = [s for s in deck.statements if s.keyword in SETTINGS]
    given = any(isinstance(c, Simulate) for c in commands)
    plan: list[Command] = [*own, *([] if given else deck.of(Simulate)), *commands]
    plan = [each for each in plan if each.keyword != "STOP"]
    runs = [(k, each) for k, each in enumerate(plan) if isinstance(each, Simulate)]
    if end is None and not runs:
        raise UsageError(Outcome.NO_END_TIME.value)
    if end is None and steps is None:
        return plan
    at, last = next((run for run in reversed(runs) if not run[1].at_once), (len(plan), None))
    dtout = last.dtout if last and steps is None else None
    if end is None and last:
        return [*plan[:at], dynamics(last.end, last.duration, steps, dtout), *plan[at + 1 :]]
    return [*plan[:at], dynamics(end, steps=steps, dtout=dtout), *plan[at + 1 :]]


def dynamics(
    end: float | None,
    duration: float | None = None,
    steps: int | None = None,
    dtout: float | None = None,
) -> Simulate:
    """A dynamic run requested by flags instead of a SIMULATE statement.

    Raises
    ------
    UsageError
        When it has no end, or one before zero, or too many steps.
    """
    least = end if end is not None else duration
    if least is None:
        raise UsageError(Outcome.NO_END_TIME.value)
    _need_span(0.0, least, steps, dtout)
    return Simulate(kind="DYNAMICS", end=end, duration=duration, steps=steps, dtout=dtout)


def need_room(
    system: System,
    plan: Iterable[Command],
    kept: int,
    output: Path | None,
    filed: bool,
    tables: int = 0,
    files: int = 1,
) -> None:
    """Reject a run whose results, with ``kept`` columns in a file, there is no room for; ``filed``:
    where its rows are many they are kept in a file, and all of them in memory ``tables`` times when
    it has ended; ``files`` have them.
    """
    plan = list(plan)
    rows, columns = rows_of(plan), len(column_names(system.kernels))
    record = system.nw + system.sizes.n_out
    if rows * (record + columns) > SMALL:
        from adamslite.analyses.setup.run_size import Rows, require_room

        filed = filed and not system.model.deck.delays and all(map(_is_filed, plan))
        made = _made(system, len(plan), record, columns, kept)
        require_room(Rows(rows, columns, record, made, filed, tables, files), kept, output)


def _made(system: System, analyses: int, record: int, columns: int, kept: int) -> int:
    """How many numbers are made of a record; see :mod:`adamslite.analyses.setup.run_size`."""
    chosen = kept if kept < columns else 0
    if columns == record - system.numbering.n_head:
        made = columns * (analyses > 1) + chosen
    else:
        made = 2 * columns + chosen * (analyses > 1)
    return made + (record + columns) // max(1, analyses) * bool(system.numbering.sensors)


def _is_filed(command: Command) -> bool:
    """Whether the rows of an analysis can be kept in a file while it lasts."""
    if not isinstance(command, Simulate) or command.at_once:
        return True
    return command.kind in ("DYNAMICS", "TRANSIENT")

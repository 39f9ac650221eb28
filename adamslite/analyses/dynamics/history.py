"""The time histories of a session: what its analyses wrote, one after the other.

They are a list of stretches of rows with the same columns.  A stretch is in memory, or in a file
(:mod:`adamslite.outputs.part_file`) where it has become too long for that, or the run takes long.
Then the file also holds what a killed session goes on from
(:mod:`adamslite.analyses.dynamics.checkpoint`).
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.integrators import contract

if TYPE_CHECKING:
    from adamslite.equations.system import System
    from adamslite.outputs.part_file import Part, PartFile, Stretch
    from adamslite.outputs.row_by_row import Growing

#: Time before the first state is written, and between two of them [s], less than five with what it
#: takes to ask for one and to write it; a run that took longer than the last is not done again.
SETTLED, EVERY, LONG = 4.0, 4.0, 1.0
#: How long an interruption waits for the last state [s].
PATIENCE = 0.5
#: Codes of runs that do not end for good.
LIMITED = (contract.INTERRUPTED, contract.STEP_LIMIT, contract.CREEPING)
#: Numbers of results that are kept in memory.
MOST = 2**21
# Numbers of a block: what is found block by block is the same wherever the rows are kept.
BLOCK = 2**18


@dataclass(frozen=True, eq=False)
class Piece:
    """Times (nt,), names of columns, values (nt, nc)."""

    times: np.ndarray
    names: tuple[str, ...]
    values: np.ndarray

    @property
    def count(self) -> int:
        """How many rows there are."""
        return len(self.times)

    def part(self, first: int, end: int) -> Part:
        """Times and values of some rows."""
        return self.times[first:end], self.values[first:end]

    def until(self, end: int) -> Piece:
        """The first rows alone."""
        return Piece(self.times[:end], self.names, self.values[:end])


class History:
    """Stretches of one table; commands between them may have changed the columns."""

    def __init__(self) -> None:
        self.stretches: list[Stretch] = []
        self.part: PartFile | None = None
        #: Files of results that are written while the run lasts.
        self.growing: Sequence[Growing] = ()

    def append(self, piece: Piece, static: bool, after_rest: bool, changed: bool = False) -> None:
        """Add the rows of an analysis; a state both ends and begins two analyses only once.

        An equilibrium (``static``) is another state at the same time, and keeps its row.  Motion
        that begins ``after_rest`` replaces it, unless the model has ``changed`` since.
        """
        last = self.stretches[-1] if self.stretches else None
        if last and last.count and piece.count and _end(last) == piece.times[0]:
            if after_rest and not static and not changed:
                self.stretches[-1] = last.until(last.count - 1)
                self._taken_back()
            elif not static and not after_rest:
                piece = Piece(piece.times[1:], piece.names, piece.values[1:])
        if piece.count or not last:
            self.extend(piece)

    def extend(self, piece: Piece) -> None:
        """Add further rows of the same analysis."""
        for file in self.growing:  # first: who is interrupted meanwhile adds the rows again
            file.follow(self)
        kept = self.part.continued(self.stretches, piece) if self.part else None
        self.stretches = [*self.stretches, piece] if kept is None else kept

    def file(self, part: PartFile) -> None:
        """Keep the rows in a file from here on."""
        filed: list[Stretch] = []
        for each in self.stretches:
            filed = part.continued(filed, each)
        self.part, self.stretches = part, filed

    def copy(self) -> History:
        """All rows in memory of their own."""
        found, whole = History(), self.whole
        found.extend(Piece(whole.times.copy(), whole.names, whole.values.copy()))
        return found

    def cut(self, rows: int) -> None:
        """Take the last rows away."""
        while rows > 0:
            last = self.stretches.pop()
            if last.count > rows:
                self.stretches.append(last.until(last.count - rows))
            rows -= last.count
        self._taken_back()

    def mark(self) -> list[Stretch]:
        """What :meth:`return_to` goes back to."""
        return list(self.stretches)

    def return_to(self, mark: list[Stretch]) -> None:
        """Forget what was added since."""
        self.stretches = list(mark)
        if self.part and any(isinstance(each, Piece) for each in mark):
            self.file(self.part)
        self._taken_back()

    def _taken_back(self) -> None:
        """Rows may have been taken back."""
        for file in self.growing:
            file.back_to(self.count)

    @property
    def in_memory(self) -> int:
        """Numbers that are kept in memory."""
        return _numbers(each for each in self.stretches if isinstance(each, Piece))

    @property
    def numbers(self) -> int:
        """All numbers, wherever they are."""
        return _numbers(self.stretches)

    @property
    def names(self) -> tuple[str, ...]:
        """The columns of all stretches; one that a stretch does not have holds no number there."""
        lists = dict.fromkeys(each.names for each in self.stretches)
        if len(lists) == 1:
            return next(iter(lists))
        return tuple(dict.fromkeys(name for names in lists for name in names))

    @property
    def count(self) -> int:
        """How many rows there are."""
        return sum(each.count for each in self.stretches)

    def parts(self, size: int, first: int = 0) -> Iterator[Part]:
        """Times and values of so many rows after the other, from the row ``first`` on, whatever
        stretches they are in.
        """
        names, room = self.names, size
        held: list[Part] = []
        for each in self.stretches:
            at = min(first, each.count)
            first -= at
            while at < each.count:
                took = min(room, each.count - at)
                times, values = each.part(at, at + took)
                values = values if each.names == names else _spread(each.names, names, values)
                held.append((times, values))
                at, room = at + took, room - took
                if room == 0:
                    yield _joined(held)
                    held, room = [], size
        if held:
            yield _joined(held)

    def blocks(self) -> Iterator[Part]:
        """The same in blocks whose size only depends on the number of columns."""
        return self.parts(max(1, BLOCK // max(1, len(self.names))))

    @property
    def whole(self) -> Piece:
        """All rows, in memory."""
        for times, values in self.parts(max(1, self.count)):
            return Piece(times, self.names, values)
        return Piece(np.zeros(0), self.names, np.zeros((0, len(self.names))))


def _numbers(stretches: Iterable[Stretch]) -> int:
    return sum(each.count * (len(each.names) + 1) for each in stretches)


def _end(stretch: Stretch) -> float:
    """The time of the last row."""
    return float(stretch.part(stretch.count - 1, stretch.count)[0][0])


def _joined(held: list[Part]) -> Part:
    if len(held) == 1:
        return held[0]
    return np.concatenate([times for times, _ in held]), np.concatenate([v for _, v in held])


def _spread(own: tuple[str, ...], names: tuple[str, ...], values: np.ndarray) -> np.ndarray:
    """Values of some columns under more names (nt, nc)."""
    column = {name: k for k, name in enumerate(names)}
    found = np.full((len(values), len(names)), np.nan)
    found[:, [column[name] for name in own]] = values
    return found


class Journal:
    """Where a session is kept that takes long.

    Parameters
    ----------
    path : Path
        The file; it is made when the session has taken ``SETTLED``, or its results become too many
        for the memory.
    facts : function that returns a mapping
        What the run is of, and how it was requested; kept with every state.
    found : PartFile or None
        The file of the session that is to be resumed.
    """

    #: Why a session cannot be resumed, of which rows alone are kept.
    unkept = ""
    #: Whether the run is being put where an earlier process had it: there is nothing new yet.
    catching_up = False
    #: Whether a page is drawn of its results, which needs them in memory.
    drawn = False
    #: Files of the results of its first session that are written while it lasts, by their paths.
    growing: Mapping[Path, Growing] = {}  # noqa: RUF012 - it is not changed

    def __init__(
        self, path: Path, facts: Callable[[], Mapping[str, Any]], found: PartFile | None = None
    ) -> None:
        self.path, self.facts, self.part = path, facts, found
        self.due = clock.monotonic() + SETTLED
        self.run, self.interrupted = -1, False
        self.ends: dict[int, Sequence[Any]] = {}

    def outlet(self, history: History, system: System, spill: Callable[[], None]) -> Outlet:
        """What takes the records of the next run, by ``spill``."""
        self.run += 1
        return Outlet(self, history, system, spill)

    def is_due(self) -> bool:
        """Whether it is time for another state."""
        return clock.monotonic() >= self.due

    def relieve(self, history: History) -> None:
        """There are too many rows for the memory."""
        self.due = 0.0

    def note(self) -> str:
        """What there is to say of the session by now."""
        return ""

    def write(self, history: History, system: System, code: int | None = None) -> None:
        """Keep the present run, which goes on or has ended with ``code``."""
        from adamslite.analyses.dynamics import checkpoint

        facts = self.facts()
        if self.part is None:
            self.part = checkpoint.begin(self.path, facts, float(system.settings.t_end))
        if history.part is None:
            history.file(self.part)
        checkpoint.write(self.part, facts, history.stretches, self.ends, self.run, system, code)
        self.due = clock.monotonic() + EVERY

    def resume(self, history: History, system: System) -> int | None:
        """Put the present run where the file has it; its code, None when it is not known there."""
        if self.part is None or not self.part.state:
            return None
        from adamslite.analyses.dynamics import checkpoint

        self.ends = checkpoint.known_ends(self.part) | self.ends
        self.catching_up = True
        found = checkpoint.resumed(self.part, self.ends, self.run, system)
        code = None
        if found:
            history.part, (code, history.stretches) = self.part, found
            for file in history.growing:
                file.follow(history)
        self.catching_up = False
        return code

    def close(self, keep: bool) -> None:
        """The results are written; the file stays if the run can go on."""
        if self.part and keep:
            self.part.close()
        elif self.part:
            self.part.remove()


class Unkept(Journal):
    """Of a session that cannot be resumed: only its rows go to a file, which has no name.

    Parameters
    ----------
    why : str
        The reason.
    folder : Path or None
        Where the file is; without, among temporary files.
    """

    def __init__(self, why: str, folder: Path | None) -> None:
        super().__init__(Path(), dict)
        self.unkept, self.folder, self.noted = why, folder, False

    def is_due(self) -> bool:
        return False

    def relieve(self, history: History) -> None:
        from adamslite.outputs.part_file import PartFile

        self.part = self.part or PartFile.nameless(self.folder)
        history.file(self.part)

    def note(self) -> str:
        if self.noted or clock.monotonic() < self.due:
            return ""
        self.noted = True
        return f"a run that is killed begins anew: it is not kept, because {self.unkept}"


class Outlet:
    """Takes the records of one run when there is no more room for them, and keeps the run."""

    def __init__(
        self,
        journal: Journal,
        history: History,
        system: System,
        spill: Callable[[], None],
    ) -> None:
        self.journal, self.history, self.system, self.spill = journal, history, system, spill
        self.began, self.interrupted = clock.monotonic(), 0.0

    def begin(self) -> int | None:
        """None for a run of its own; the code of one that has ended, or that goes on, from now in
        the state that the journal holds.
        """
        return self.journal.resume(self.history, self.system)

    def take(self, code: int) -> None:
        """Take the records of a full block, or write a state; called where the run goes on."""
        journal, block = self.journal, self.system.block
        if code == contract.FULL:
            self.spill()
            if self.history.part is None and self.history.in_memory > MOST:
                journal.relieve(self.history)
        if code == contract.HELD or journal.is_due():
            block.hold = False
            journal.write(self.history, self.system)
        if self.interrupted:
            self.system.settings.stop = True

    def look(self) -> None:
        """From another thread: ask for a state when it is time."""
        if self.interrupted:
            if clock.monotonic() > self.interrupted + PATIENCE:
                self.system.settings.stop = True
        elif self.journal.is_due():
            self.system.block.hold = True

    def interrupt(self) -> None:
        """From another thread: end the run, with a last state where there are earlier ones; at once
        when asked again.
        """
        self.journal.interrupted = True
        if self.journal.part is None or self.journal.unkept or self.interrupted:
            self.system.settings.stop = True
        else:
            self.interrupted = clock.monotonic()
            self.system.block.hold = True

    def expire(self) -> None:
        """From another thread: the same, for a limit."""
        if not self.interrupted:
            self.interrupt()

    def end(self, code: int, final: bool) -> None:
        """The run has ended with a code; ``final``: nothing else is tried where it has crept.

        One that a limit has ended goes on from its last state, with a larger limit.
        """
        journal, system = self.journal, self.system
        if journal.run in journal.ends:
            return
        over = code not in LIMITED or bool(system.triggered or system.report.torn)
        over |= code == contract.CREEPING and not final
        long = journal.part is not None and clock.monotonic() > self.began + LONG
        if journal.unkept:
            return
        if over and (long or journal.is_due()):
            journal.write(self.history, system, code)

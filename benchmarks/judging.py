"""The verdict on a run of a random deck.

*Off* is the error of a channel, a share of its own range in the whole motion, at its worst output
time, and the worst of its channels.  A run at ERROR is wrong where it is off by more than
``limit(ERROR)``, the larger of ``FELT`` and ``GROWN`` times ERROR: 1e-2 at 1e-3, 1e-3 from
1e-4 on.  ERROR bounds the error of a step; the limit leaves room for what ten steps add up to at
the default.  A larger error shows in a plot and has to be told whatever the ERROR is.

=======  ===========================================================================
right    reached the end, off by no more than the limit
warned   reached the end further off, and the results say that they are not to be trusted
stopped  refused or ended early, as a named outcome
slow     gave up after ``SECONDS``
silent   reached the end further off, and nothing says so
=======  ===========================================================================

A channel whose range is within half of ERROR, of its size for states, is at rest and not compared:
a single step may be off by as much.

A *false alarm* is a note of a run that is off by less than ``SHARE`` of the limit, as what the note
names is: columns that the truth does not have, such as tensions, are compared with a run of RADAU
at ``TIGHT``, which another method has to confirm within a tenth of that.  A run that a
SENSOR ends has to end between the times at which its channel, as far off as the run is, may reach
the value.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import cached_property, partial
from math import inf

import numpy as np

from adamslite import assemble, compile_model, read, simulate
from adamslite.errors import UsageError
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.verification.variants import Variant, patient
from benchmarks.posed import STATE, Posed, Truth
from benchmarks.truths import channels_of, column

FELT, GROWN, SHARE = 1e-3, 10.0, 0.1
AT_REST = 0.5
#: ERROR of the runs of two methods that what a note names is compared with.
TIGHT, WITNESSES = 1e-9, ("RADAU", "ABAM")
#: CPU [s] that a judged run may take.
SECONDS = 10.0

RIGHT, WARNED, STOPPED, SLOW, SILENT = "right", "warned", "stopped", "slow", "silent"
VERDICTS = (RIGHT, WARNED, STOPPED, SLOW, SILENT)
#: Comments of the results that say that numbers are not to be trusted as far as ERROR says.
WARNINGS = ("accuracy", "order", "energy", "audit", "warning")
#: Errors that are tried as those of a SENSOR that ends a run before its first output.
UNSEEN = tuple(np.geomspace(1e-7, 1e-1, 61).tolist())
#: What is off when rows are missing, or a SENSOR did not end the run.
ROWS, SENSOR = "rows", "sensor"


def limit(error: float) -> float:
    """Share of its range from which on an error of a channel has to be told."""
    return max(FELT, GROWN * error)


@dataclass(frozen=True)
class Judged:
    """What a method made of a deck at an ERROR; ``kind``: of the channel that is worst; ``named``:
    the error of the column that a note names, where that is looked at.
    """

    method: str
    error: float
    verdict: str
    off: float = 0.0
    kind: str = ""
    said: str = ""
    named: float = 0.0

    @property
    def false_alarm(self) -> bool:
        """Warned for nothing."""
        off = max(self.off, self.named)
        return bool(self.said) and self.verdict == RIGHT and off < SHARE * limit(self.error)


def told(results: Results) -> str:
    """What the results say against themselves."""
    return "; ".join(results.meta[key] for key in WARNINGS if key in results.meta)


class Bench:
    """A deck ready to be run by many methods."""

    def __init__(self, problem: Posed) -> None:
        self.problem = problem
        self._run = partial(
            simulate, compile_model(assemble(read(problem.text))), commands=problem.commands
        )

    def judge(self, variant: Variant, error: float, truth: Truth) -> Judged:
        """The verdict on one method."""
        named = variant.label
        try:
            results = patient(self._run, SECONDS)(error=error, **variant.options)
        except UsageError as refusal:
            return Judged(named, error, STOPPED, said=str(refusal))
        if results.outcome is Outcome.INTERRUPTED:
            return Judged(named, error, SLOW)
        halted = results.outcome is Outcome.HALTED and self.problem.halts is not None
        if results.outcome is not Outcome.DONE and not halted:
            return Judged(named, error, STOPPED, said=results.outcome.name)
        found = verdict(named, error, self.problem, results, truth)
        return replace(found, named=self._named_off(results)) if found.false_alarm else found

    @cached_property
    def _witnesses(self) -> list[Results]:
        """Runs at ``TIGHT`` that reached their end."""
        runs = [patient(self._run, SECONDS)(error=TIGHT, integrator=each) for each in WITNESSES]
        return [each for each in runs if each.outcome.is_requested]

    def _named_off(self, results: Results) -> float:
        """The largest error of a column that the notes name, a share of its range; 0 where the
        witnesses do not agree.
        """
        named = set(re.findall(r"(?:VARIABLE|REQUEST|DIFF)/[\w.]+", told(results)))
        columns, worst = sorted(named.intersection(results.names)), 0.0
        if not columns or len(self._witnesses) < len(WITNESSES):
            return worst
        for name in columns:
            rows = min(len(each.time) for each in (results, *self._witnesses))
            x, one, other = (each[name][:rows] for each in (results, *self._witnesses))
            off = float(np.abs(x - one).max()) / (float(np.ptp(one)) or inf)
            if float(np.abs(one - other).max()) <= SHARE * float(np.abs(x - one).max()):
                worst = max(worst, off)
        return worst


def verdict(method: str, error: float, problem: Posed, results: Results, truth: Truth) -> Judged:
    """Judge results that reached their end."""
    off, kind = off_by(problem, results, truth, error)
    said = told(results)
    if off <= limit(error):
        return Judged(method, error, RIGHT, off, kind, said)
    return Judged(method, error, WARNED if said else SILENT, off, kind, said)


def off_by(problem: Posed, results: Results, truth: Truth, error: float = 0.0) -> tuple[float, str]:
    """The largest error of a run and the kind of its channel; infinite where rows are missing.

    A SENSOR may meet its value where its channel is off by that or, between outputs, by ERROR;
    before the first output, the least error of its channel that explains the time is that of the
    run.
    """
    rows, given = _rows(problem, results)
    halted = results.outcome is Outcome.HALTED
    if not halted and len(rows) < len(truth.least):
        return inf, ROWS
    worst, kind = 0.0, ""
    for k, channel in enumerate(problem.channels or channels_of(results)):
        values = column(results, channel)[given]
        beyond = np.maximum(truth.least[rows, k] - values, values - truth.most[rows, k])
        scale = float(truth.ranges[k]) or 1.0
        size = float(np.abs(truth.most[:, k]).max()) if channel.kind == STATE else 1.0
        if scale <= AT_REST * error * size:
            continue
        off = max(float(beyond.max(initial=0.0)), 0.0) / scale if len(values) else 0.0
        if not np.isfinite(values).all():
            off = inf
        if off > worst or not kind:
            worst, kind = off, channel.kind
    if problem.halts:
        reached = float(results.time[-1]) if halted else inf
        unseen = halted and len(rows) < 2
        for allowed in UNSEEN if unseen else (max(worst, error),):
            first, last = problem.halts(allowed)
            room = 1e-9 * problem.end
            if first - room <= reached <= last + room:
                return (max(worst, allowed), SENSOR) if unseen else (worst, kind)
        return inf, SENSOR
    return worst, kind


def _rows(problem: Posed, results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Output rows of the truth that the results have, and which of their rows these are."""
    time = np.asarray(results.time)
    if not problem.end:
        count = min(len(time), problem.steps + 1)
        return np.arange(count), np.arange(count)
    asked = np.linspace(0.0, problem.end, problem.steps + 1)
    near = np.abs(time[None, :] - asked[:, None])
    rows = np.flatnonzero(near.min(axis=1) <= 1e-9 * problem.end)
    return rows, near[rows].argmin(axis=1)

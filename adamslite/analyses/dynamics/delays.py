"""The past that DELAY takes: a run in spans, at the start of each of which it is known.

The method of steps.  With delays tau_i a span from t ends at t + min tau_i at the latest, so that
e(t - tau_i) depends on earlier spans alone.  Where e jumps or bends at a time b, its delayed value
does at b + tau_i: spans end there, for MOST_SMOOTHED times in a row, each of which makes a solution
smoother by one derivative.

Of each span e is kept as the cubic spline through SAMPLES + 1 values.  Its error is estimated by
the spline through every second of them, and spans become shorter where it exceeds ERROR.

Reference: Bellen, Zennaro, Numerical Methods for Delay Differential Equations, 2003, sections 2.2
(where jumps arrive), 3.1 (method of steps).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from adamslite.errors import UsageError
from adamslite.language.expression import to_text
from adamslite.model.past import KNOTS, past_of
from adamslite.symbolic.interpolant import interpolant

if TYPE_CHECKING:
    from adamslite.equations.system import System
    from adamslite.kernels.groups import Kernels
    from adamslite.language.expression import Call
    from adamslite.model.past import Past

SAMPLES = 128
MOST_SMOOTHED = 6
# The error of a cubic spline is 1/16 of that through every second point, near its ends more.
HALVED = 8.0
# The first span is this share of the shortest delay, none is shorter than the second share.
FIRST_SPAN, SHORTEST = 0.25, 1e-3
# Places closer than this share of a delay are one.
SAME = 1e-9
# ... and samples closer to an output than this share of a span.
CLOSE = 1e-4
# Why analyses that are no run through time reject it.
NO_PAST = "its states have no past; use SIMULATE/DYNAMICS"
NOT_IN = "{what} cannot be computed with DELAY: {why}"


@dataclass
class Signal:
    """The past of one delayed expression: cubics ``pieces`` (n, 4) that begin at ``knots`` (n,);
    the last of them ends at ``end``.
    """

    knots: np.ndarray = field(default_factory=lambda: np.zeros(0))
    pieces: np.ndarray = field(default_factory=lambda: np.zeros((0, 4)))
    end: float = -np.inf

    def append(self, times: np.ndarray, values: np.ndarray) -> float:
        """Keep a span through these points; returns the estimated error."""
        spline = interpolant(times, values[:, None], "not-a-knot", "piece")
        half = interpolant(times[::2], values[::2, None], "not-a-knot", "piece")
        self.knots = np.append(self.knots, times[:-1])
        self.pieces = np.append(self.pieces, spline.pieces[1:-1, 0], axis=0)
        self.end = float(times[-1])
        return float(np.abs(half.at(times[1::2])[:, 0] - values[1::2]).max()) / HALVED

    def forget(self, before: float) -> None:
        """Leave out what no delay reaches any more."""
        first = max(0, int(np.searchsorted(self.knots, before, side="right")) - 1)
        self.knots, self.pieces = self.knots[first:], self.pieces[first:]

    def fill(self, past: Past, start: float, end: float) -> None:
        """Write what lies between two times into the table of ``past``."""
        table = past.table
        inner = self.knots[(self.knots > start) & (self.knots < end)]
        count = 1 + len(inner)
        knots = np.concatenate([[start], inner, end + (end - start) * np.arange(KNOTS - count)])
        at = np.searchsorted(self.knots, knots[:count] + 0.5 * np.diff(knots[: count + 1])) - 1
        pieces = np.zeros((KNOTS + 1, 4))
        pieces[1 : 1 + count, 0] = past.initial
        known = np.flatnonzero(at >= 0)
        at = at[known]
        pieces[1 + known] = _moved(self.pieces[at], knots[known] - self.knots[at])
        pieces[0, 0] = pieces[1, 0]
        last = _moved(pieces[[count]], np.array([end - knots[count - 1]]))
        pieces[1 + count :, 0] = last[0, 0]
        table.knots[:], table.pieces[:, 0] = knots, pieces


def _sampled(start: float, end: float, inside: np.ndarray) -> np.ndarray:
    """Times from ``start`` to ``end``, and those ``inside``, of which none is close to another."""
    even = np.linspace(start, end, SAMPLES + 1)[1:-1]
    near = np.searchsorted(inside, even)
    padded = np.concatenate([[-np.inf], inside, [np.inf]])
    apart = np.minimum(even - padded[near], padded[near + 1] - even)
    return np.union1d(np.append(even[apart > CLOSE * (end - start)], [start, end]), inside)


def _moved(pieces: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Cubics (n, 4) expanded about other places, ``x`` (n,) from the old ones."""
    a, b, c, d = pieces.T
    return np.stack(
        [a + x * (b + x * (c + x * d)), b + x * (2.0 * c + 3.0 * x * d), c + 3.0 * x * d, d], axis=1
    )


class Delays:
    """What is delayed in a session.

    ``worst``: by call, the largest estimated error of its past over ERROR max(1, |e|).
    """

    def __init__(self) -> None:
        self.signals: dict[Call, Signal] = {}
        self.breaks: dict[float, int] = {}
        self.worst: dict[Call, float] = {}
        self.longest = np.inf

    def spans(
        self,
        kernels: Kernels,
        system: System,
        times: np.ndarray,
        wanted: np.ndarray,
        error: float,
    ) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Times of records, and which of them are requested; ask for the next span after a run
        over the last one.
        """
        calls = kernels.model.deck.delays
        if not calls:
            yield times, wanted
            return
        self.begin(kernels, float(times[0]))
        start = float(times[0])
        while start < times[-1]:
            end = self._end(kernels, start, float(times[-1]))
            nearest = float(times[np.abs(times - end).argmin()])
            end = nearest if abs(nearest - end) <= SAME * (end - start) else end
            for call in calls:
                past = past_of(kernels.model, call)
                self.signals[call].fill(past, start - past.delay, end - past.delay)
            inside = times[(times >= start) & (times <= end)]
            sampled = _sampled(start, end, inside)
            yield sampled, np.isin(sampled, inside)
            if system.report.t < end or system.count.records < len(sampled):
                return
            self._keep(kernels, system, sampled, error)
            start = end

    def begin(self, kernels: Kernels, start: float) -> None:
        """An analysis may begin in a state of its own."""
        for call in kernels.model.deck.delays:
            self.signals.setdefault(call, Signal())
        self.breaks[start] = 0
        shortest = min(past_of(kernels.model, call).delay for call in kernels.model.deck.delays)
        self.longest = min(self.longest, FIRST_SPAN * shortest)

    def hold(self, kernels: Kernels, time: float) -> None:
        """The values of one time, for an equilibrium."""
        for call in kernels.model.deck.delays:
            past = past_of(kernels.model, call)
            at = time - past.delay
            self.signals.setdefault(call, Signal()).fill(past, at, at + SAME * past.delay)

    def _end(self, kernels: Kernels, start: float, end: float) -> float:
        """The end of the span that begins at ``start``."""
        whole, end = end, min(end, start + self.longest)
        for call in kernels.model.deck.delays:
            past, signal = past_of(kernels.model, call), self.signals[call]
            end = min(end, start + past.delay)
            later = signal.knots[signal.knots > start - past.delay]
            if len(later) > KNOTS - 3:
                end = min(end, float(later[KNOTS - 3]) + past.delay)
            for place, order in list(self.breaks.items()):
                arrives = place + past.delay
                if start + SAME * past.delay < arrives <= end + SAME * past.delay:
                    end = min(end, arrives)
                    if order < MOST_SMOOTHED:
                        self.breaks.setdefault(end, order + 1)
        return whole if whole - end < SAME * (end - start) else end

    def _keep(self, kernels: Kernels, system: System, times: np.ndarray, error: float) -> None:
        """The values of a span, and the length of the next one."""
        deck = kernels.model.deck
        record = system.record.reshape(-1)[: len(times) * (system.nw + system.sizes.n_out)]
        record = record.reshape(len(times), -1)
        share, shortest = 0.0, np.inf
        for call, key in deck.delays.items():
            column = system.nw + system.instances.outputs[deck.find("VARIABLE", key)]
            signal, past = self.signals[call], past_of(kernels.model, call)
            values = record[:, column]
            off = signal.append(times, values) / (error * max(1.0, float(np.abs(values).max())))
            signal.forget(float(times[-1]) - past.delay)
            self.worst[call] = max(self.worst.get(call, 0.0), off)
            share, shortest = max(share, off), min(shortest, past.delay)
        reach = max(past_of(kernels.model, call).delay for call in deck.delays)
        self.breaks = {t: n for t, n in self.breaks.items() if t > times[-1] - 2.0 * reach}
        # The error grows with the fourth power of the length.
        grow = min(2.0, 0.9 * max(share, 1e-4) ** -0.25)
        allowed = grow * float(times[-1] - times[0])
        # A span may have ended early for another reason.
        allowed = max(allowed, self.longest) if grow > 1.0 else allowed
        self.longest = min(max(allowed, SHORTEST * shortest), shortest)

    def note(self, kernels: Kernels) -> str:
        """Pasts that are known less exactly than ERROR; empty when there are none."""
        known = kernels.model.deck.delays
        found = [
            f"{to_text(call)} is {_off(share)} ERROR off"
            for call, share in self.worst.items()
            if share > 1.0 and call in known
        ]
        return "; ".join(found)


def _off(share: float) -> str:
    return f"up to {share:.2g} times"


def require_no_delay(kernels: Kernels, what: str, why: str) -> None:
    """Reject an analysis that delayed values have no part in.

    Raises
    ------
    UsageError
        When the deck delays something.
    """
    if kernels.model.deck.delays:
        raise UsageError(NOT_IN.format(what=what, why=why))

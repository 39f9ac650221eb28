"""Figures of a running integration: speed, time that is left, whether its steps have collapsed."""

from __future__ import annotations

import time as clock
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from adamslite.progress.base import RunState

#: Speeds are those of the last seconds [s].
WINDOW = 5.0
#: Steps have collapsed below this share of the mean step of better times, or of the longest one,
COLLAPSED, TINY = 1e-2, 1e-5
#: when they stay there for so long [s].
LASTING = 1.0
MINUTE, HOUR = 60, 3600


@dataclass(frozen=True)
class Look:
    """A state, when it was seen [s], and what follows from those before it.

    ``speed``: steps per second; ``left``: seconds to the end at the present speed, None where
    that is not known; ``limit``: what keeps the steps short, empty unless they have collapsed.
    """

    state: RunState
    at: float
    speed: float
    left: float | None
    limit: str

    @property
    def text(self) -> str:
        """``42 %  t = 0.84 of 2  h = 1.2e-04  order 5  31 000 steps/s  0:12 left``"""
        state = self.state
        parts = [f"{int(100 * state.share):3d} %", state.reached]
        parts += [f"h = {state.step:.1e}"] if state.step else []
        parts += [f"order {state.order}"] if state.order else []
        parts += [f"{_rounded(self.speed)} {state.counted}/s"] if self.speed else []
        parts += [f"{_duration(self.left)} left"] if self.left is not None else []
        parts += [f"short steps: {self.limit}"] if self.limit else []
        return "  ".join(parts)


class Meter:
    """Looks at one analysis after the other.

    ``now``: the clock [s].
    """

    def __init__(self, now: Callable[[], float] = clock.monotonic) -> None:
        self._now = now
        self._seen: deque[tuple[float, float, int]] = deque()
        self._begin()

    def _begin(self) -> None:
        self._seen.clear()
        self._collapsed_at: float | None = None
        self._best = 0.0

    def look(self, state: RunState) -> Look:
        """A look at the present state."""
        at, seen = self._now(), self._seen
        if seen and (state.time < seen[-1][1] or state.steps < seen[-1][2]):  # another analysis
            self._begin()
        seen.append((at, state.time, state.steps))
        while len(seen) > 2 and at - seen[1][0] >= WINDOW:
            seen.popleft()
        began, time, steps = seen[0]
        spent = at - began
        speed = (state.steps - steps) / spent if spent > 0.0 else 0.0
        advanced = state.time - time
        left = (state.end - state.time) * spent / advanced if advanced > 0.0 else None
        if state.steps > steps:
            self._best = max(self._best, advanced / (state.steps - steps))
        limit = state.limit() if self._have_collapsed(state, at) else ""
        return Look(state, at, speed, left, limit)

    def _have_collapsed(self, state: RunState, at: float) -> bool:
        """Whether steps are far shorter than they were, or than they may be, for long."""
        short = max(COLLAPSED * self._best, TINY * state.longest)
        if not 0.0 < state.step < short:
            self._collapsed_at = None
            return False
        if self._collapsed_at is None:
            self._collapsed_at = at
        return at - self._collapsed_at >= LASTING


def _rounded(number: float) -> str:
    """Two digits, with thin groups of three: 31 000."""
    if number < 100.0:
        return f"{number:.2g}"
    digits = len(str(int(number))) - 2
    return f"{round(number / 10**digits) * 10**digits:,}".replace(",", " ")


def _duration(seconds: float) -> str:
    """``0:07``, ``12:30``, ``3 h 05 min``, ``4 days``"""
    whole = int(seconds + 0.5)
    if whole < HOUR:
        return f"{whole // MINUTE}:{whole % MINUTE:02d}"
    if whole < 48 * HOUR:
        return f"{whole // HOUR} h {whole % HOUR // MINUTE:02d} min"
    return f"{whole // (24 * HOUR)} days"

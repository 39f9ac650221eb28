"""Whether a model with merged parts starts as drawn, and as it would part by part."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from adamslite.equations.system import System

# Of the largest place or speed: what is smaller is round-off.
NOTHING = 1e-11


class Drawn(NamedTuple):
    """Coordinates (n,), attitudes (9 bodies,) and velocities (n,) before the joints are closed."""

    q: np.ndarray
    base: np.ndarray
    u: np.ndarray

    @classmethod
    def of(cls, system: System) -> Drawn:
        """Those that a system has now."""
        return cls(system.q.copy(), system.base.copy(), system.u.copy())

    def differs(self, system: System) -> bool:
        """Whether a system was moved since, or got other speeds where these were not the only ones
        that its constraints allow.
        """
        closed_before = system.model.start is not None
        if system.q.size != self.q.size or system.broken or closed_before:
            return True
        moved = _changed(self.q, system.q) or _changed(self.base, system.base)
        return moved or (system.dof > 0 and _changed(self.u, system.u))


def _changed(before: np.ndarray, now: np.ndarray) -> bool:
    size = max(float(np.abs(each).max(initial=0.0)) for each in (before, now))
    return not float(np.abs(now - before).max(initial=0.0)) <= NOTHING * size


def other_rows_left_out(system: System) -> bool:
    """Whether other redundant rows are left out than with every part by itself: what they carry is
    then shared out in another way.
    """
    dropped = system.elimination.dropped
    if not dropped:
        return False
    # Few models have redundant rows.
    from adamslite.assembly.rank import TooManyDependent, names_of_rows
    from adamslite.assembly.start import redundant_rows

    own = {*names_of_rows(system.model.constraints, dropped)}
    try:
        return own != set(redundant_rows(system.model.deck))
    except TooManyDependent:
        return True

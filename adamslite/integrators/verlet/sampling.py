"""How often VERLET looks at its local error."""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.event_rows import POLE
from adamslite.integrators.linalg.norms import exceeds
from adamslite.integrators.linalg.plan import HUGE
from adamslite.integrators.motion_equations import WATCH, guard_values
from adamslite.integrators.verlet.control import Control
from adamslite.native.translate import native, rare

# Steps from one look at the local error to the next, where no force changes its law (a contact may
# begin and end between two looks) and stability decides how long they are: eight of these are one
# or two periods of the fastest vibration.
SAMPLE = 8
# ... and with equal steps, whose length nothing changes.
FIXED_SAMPLE = 32
# A run whose error has come to this many times ERROR is given up before its end.
HOPELESS = 1e6
# A larger number is none to form products of.
LARGE = 1e200


@native
def steps_per_estimate(P: Problem, C: Control, h: float) -> int:
    """Steps from one look at the local error to the next."""
    if C.fixed:
        return FIXED_SAMPLE
    return SAMPLE if P.sizes.watched + P.sizes.zones == 0 and 2.0 * h > C.limit else 1


@native
def local_error(P: Problem, h: float) -> float:
    """h^2 |a - earlier a|/6 against ERROR max(1, |q|)."""
    top = 0.0
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(3):
            change = abs(P.a[i + k] - P.ra[i + k])
            weight = max(1.0, abs(P.W[o + k]))
            if exceeds(change, top * weight):
                top = change / weight
    if not top < LARGE:
        return HUGE
    if P.sizes.zones > 0 and passes_pole(P):
        return LARGE
    return top * h * h / (6.0 * P.settings.error)


@native
def passes_pole(P: Problem) -> bool:
    """Whether a pole has changed since the last look by more than a share of its value nearer to
    zero, as it does where it is passed; keeps the present values.
    """
    first, found = P.sizes.nw + P.sizes.clocks + P.sizes.watched, False
    guard_values(P, WATCH)
    for k in range(P.sizes.zones):
        old, new = P.zone[k], P.guard[first + k]
        if P.kind[first - P.sizes.nw + k] == POLE:
            found = found or abs(new - old) > P.search.span * min(abs(new), abs(old))
        P.zone[k] = new
    return found


@native
@rare
def leave(P: Problem, C: Control, step: int, top: float, looks: int) -> float:
    """Give a try up before a step: for good where the run is to stop, else to be continued."""
    if not P.settings.stop:
        C.step, C.top, C.looks = step, top, looks
    return HUGE


@native
def note_steps(P: Problem, C: Control, count: int) -> None:
    """Count accepted steps."""
    P.count.steps += count
    P.count.residuals += count + 1
    C.since += count

"""Sensors: relations whose becoming true ends the run.

The relations of a sensor are guards like those of any IF; their changes are located, and the step
ends there.  A sensor triggers when all of them are true at the start of a run, or when one becomes
true while the others were; of EQ, a window |e - VALUE| <= ERROR with a relation for each border,
that is the entry from below or above, however narrow the window is.  One after which the analysis
continued sleeps until a relation has been false; round-off right after it triggered does not count.
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.event_rows import END
from adamslite.native.translate import native


@native
def start_sensors(P: Problem) -> None:
    """No sensor has triggered, nothing is known of their relations."""
    for k in range(P.sensors.size):
        P.sensors[k].first_was, P.sensors[k].second_was, P.sensors[k].triggered = 0, 0, 0


@native
def sense(P: Problem) -> None:
    """End the run where a sensor triggers; the present branches are in the workspace."""
    for k in range(P.sensors.size):
        first = 1 if P.W[P.sensors[k].first] > 0.0 else -1
        second = 1 if P.W[P.sensors[k].second] > 0.0 else -1
        entered = first > 0 and P.sensors[k].first_was < 0
        entered = entered or (second > 0 and P.sensors[k].second_was < 0)
        entered = entered and P.W[0] > P.sensors[k].quiet
        holds = first > 0 and second > 0
        if entered or (holds and P.sensors[k].asleep == 0):
            P.sensors[k].triggered, P.settings.stop = 1, True
        if not holds and P.W[0] > P.sensors[k].quiet:
            P.sensors[k].asleep = 0
        P.sensors[k].first_was, P.sensors[k].second_was = first, second


@native
def meets_sensor(P: Problem) -> bool:
    """Whether a relation of a sensor is different at the end of the step."""
    for k in range(P.sensors.size):
        if has_changed(P, P.sensors[k].first) or has_changed(P, P.sensors[k].second):
            return True
    return False


@native
def has_changed(P: Problem, offset: int) -> bool:
    """Whether the guard with its branch at ``offset`` has left it at the end of the step."""
    count, k = P.sizes.watched, offset - P.sizes.nw - P.sizes.clocks
    return k >= 0 and P.margin[END * count + k] < 0.0

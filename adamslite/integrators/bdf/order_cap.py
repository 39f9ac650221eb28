"""The cap on the order of BDF where orders above 2 cost more than they gain.

Orders 3 to 5 are unstable for undamped vibrations of some `h omega`.  In a stiff scene without
much damping they feed a vibration that the motion does not have until the error test holds it: it
stays at some hundred times ERROR, and the step at a fraction of its period, whatever ERROR is.
Order 2 damps it.  Seen on the differences, with r = |D_(k+1)| / |D_k| at order k,

    amplitude of what sets the step = |D_(k+1)| / r^(k+1)

When that is small in a whole window of steps, order 2 is tried for some windows.  Its steps
decide: if they get clearly longer than before, the cap stays; if not, it is lifted, and the next
trial is further away.
References: Hairer, Wanner, Solving ODEs II, 1996, section V.1 (stability of BDF); Hindmarsh,
Avoiding BDF stability barriers, LLNL UCRL-ID-120480, 1995 (the same trouble, seen by other signs).
"""

from __future__ import annotations

from adamslite.native.translate import Record, native

# Tries of a step in a window.
WINDOW = 50.0
# A vibration below this many times ERROR is suspected to be fed by the formula.
SUSPECT_AMPLITUDE = 100.0
# The share of a window's steps, or of rejections at order 3 and above, that makes a suspicion.
SUSPECT_SHARE, REJECTED_SHARE = 0.8, 0.14
# The cap is lifted when its steps are no longer this much longer than those before the trial.
STILL_PAYS = 4.0
# Steps that still grow, as after a start, are not held by anything.
STEADY = 1.5
# Windows of a trial; it has paid when a window covers this many times as much time as before.
TRIAL_WINDOWS, PAYS = 14.0, 8.0
# No trial when steps are longer than HMAX over this: there is too little to win.
ROOM = 20.0
# A trial that goes this much slower ends at once.
HOPELESS = 0.3
# Tries until the next trial; after each trial in vain as many times more, up to a number.
PATIENCE, MORE_PATIENCE, MOST_PATIENCE = 500.0, 4.0, 8000.0

WATCHING, TRYING, CAPPED = 0.0, 1.0, 2.0


class OrderCap(Record):
    """The cap and what is known of the present window of tries.

    ``tries`` of steps, ``travelled``: the time that they took the run on, ``suspect`` steps among
    them, ``bad``: rejections; ``pace``: time per try before the trial, ``windows`` of the trial,
    ``rest``: tries until the next one, ``next_rest`` after that.
    """

    state: float
    tries: float
    travelled: float
    suspect: float
    bad: float
    pace: float
    windows: float
    rest: float
    next_rest: float


@native
def start_watch(C: OrderCap) -> None:
    """Nothing suspected yet."""
    C[:] = 0
    C.next_rest = PATIENCE


@native
def forget_window(C: OrderCap) -> None:
    """A new window of tries begins."""
    C.tries, C.travelled, C.suspect, C.bad = 0.0, 0.0, 0.0, 0.0


@native
def suspect(C: OrderCap, order: int, low: float, high: float, error: float, steps: float) -> bool:
    """Whether |D_k| and |D_(k+1)| say that the formula fed what set the last ``steps`` steps."""
    if order < 3 or not (low > 0.0 and high > 0.0):
        return False
    suspected = high * (low / high) ** (order + 1.0) < SUSPECT_AMPLITUDE * error
    if suspected:
        C.suspect += steps
    return suspected


@native
def highest_order(C: OrderCap, top: int, most: int, h_max: float) -> int:
    """The highest order from now on, after an accepted step; ``top`` is that until now."""
    if C.tries < WINDOW:
        return top
    pace, tries = C.travelled / C.tries, C.tries
    suspected = C.suspect >= SUSPECT_SHARE * WINDOW or C.bad >= REJECTED_SHARE * WINDOW
    forget_window(C)
    if C.state != WATCHING:
        return after_window(C, pace, most)
    growing = pace > STEADY * C.pace
    C.pace = pace
    C.rest -= tries
    if growing or C.rest > 0.0 or pace * ROOM > h_max or not suspected:
        return top
    C.state, C.windows = TRYING, 0.0
    return 2


@native
def after_window(C: OrderCap, pace: float, most: int) -> int:
    """The highest order after a window of a trial, or of steps under the cap."""
    C.windows += 1.0
    if pace > PAYS * C.pace:
        C.state = CAPPED
    if C.state == CAPPED and pace > STILL_PAYS * C.pace:
        return 2
    if C.state == TRYING and C.windows < TRIAL_WINDOWS and pace > HOPELESS * C.pace:
        return 2
    if C.state == CAPPED:
        C.next_rest = PATIENCE
    C.state, C.rest = WATCHING, C.next_rest
    C.next_rest = min(MOST_PATIENCE, C.next_rest * MORE_PATIENCE)
    return most

"""The formula for point masses by component: four stages of order 4, or twelve of order 8.

Both know one state, so that they may change places after any step.  A step of order 8 costs three
of order 4: it pays where accuracy, not stability, makes those short,

    h4 < h8/3,    h8 <= 5.9/w,    h4 <= 4.6/w,

with the circular frequency w of the fastest vibration.  The size that the other formula would take
is the stable one, or for order 4 the one that the error of third order allows, which the pair of
order 8 estimates as well.
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.events.stops import longest_step
from adamslite.integrators.explicit.control import Control
from adamslite.integrators.explicit.error import SAFETY
from adamslite.integrators.explicit.stages import restore_state
from adamslite.integrators.unconstrained import POWERS, clear, invert_bodies, radius
from adamslite.native.translate import native, seldom

# Steps of order 4 and 8 times the circular frequency that are stable with light damping.
STABLE_QUICK, STABLE = 4.6, 5.9
# Evaluations of a step of order 8 against one of order 4; what it must gain to be taken.
COST, GAIN = 3.0, 1.3
# Steps above this share of the bound are at it; what their error may be, against ERROR.
AT_BOUND, CALM = 0.9999, 0.3
# A step whose error is below this share of ERROR might have been longer.
SMALL = 0.02
# Steps before the first change of formula, doubled with each; steps from one look at the fastest
# vibration to the next, a look costs five.
PATIENCE, LOOK, NEVER = 8, 200, 1 << 62
# From this ERROR on a run begins with order 4.
FINE = 1e-6


@native
@seldom
def look_for_fastest(P: Problem, C: Control) -> None:
    """The circular frequency of the fastest vibration at the accepted state, zero for none."""
    C.fastest, C.looked = 0.0, 0
    x = P.trial[0:]
    clear(x, P.sizes.n)
    if not P.sizes.added_mass or invert_bodies(P, P.D):
        C.fastest = radius(P, 1.0, 0.0, x, POWERS) ** 0.5


@native
@seldom
def begin_with_formula(P: Problem, C: Control) -> None:
    """The formula of a run's first step; steps whose size is given are of order 8 throughout."""
    look_for_fastest(P, C)
    equal = P.settings.h_min >= P.settings.h_max
    C.quick, C.patience = P.settings.error >= FINE and not equal, NEVER if equal else PATIENCE


@native
def choose_formula(P: Problem, C: Control, error: float) -> None:
    """Behind a step: the formula of the next one, which of order 4 stays stable."""
    C.steady, C.looked = C.steady + 1, C.looked + 1
    if C.looked >= LOOK:
        restore_state(P, C)
        look_for_fastest(P, C)
    if C.steady >= C.patience and error > SMALL and other_pays(P, C):
        C.quick = not C.quick
        C.steady, C.patience = 0, 2 * C.patience
        C.h = quick_step(C) if C.quick else 2.0 * C.h
    if C.quick and C.h * C.fastest > STABLE_QUICK:
        C.h = max(P.settings.h_min, STABLE_QUICK / C.fastest)


@native
def stays(C: Control, error: float) -> bool:
    """Whether the next step is as long as this one: stability decides, and errors are small."""
    at_bound = C.quick and not C.cautious and C.h * C.fastest > AT_BOUND * STABLE_QUICK
    return at_bound and error < CALM and C.steady > 0


@native
def other_pays(P: Problem, C: Control) -> bool:
    """Whether the other formula gets further for the same cost."""
    if C.quick:
        longest = longest_step(P)
        if C.fastest > 0.0:
            longest = min(longest, STABLE / C.fastest)
        return GAIN * COST * C.h < longest
    return COST * quick_step(C) > GAIN * C.h


@native
def quick_step(C: Control) -> float:
    """The step of order 4 that error and stability allow, from a step of order 8."""
    h = SAFETY * C.h_last * C.third**-0.25 if C.third > 0.0 else C.h_last
    return min(h, STABLE_QUICK / C.fastest) if C.fastest > 0.0 else h

"""Jolts: what happens to velocities within a step unseen from its ends, as in a short impact.

Methods that damp vibrations faster than their steps do so with the velocity of a body that meets a
hard wall, too, or lead so far into the wall that it is thrown back faster than it came; no estimate
of an error is large.  What is left open is

    |u+ - u - h (a + a+)/2|      where stages in between have accelerations of their own
    |h (a+ - a)/2|               where u+ follows from those at the ends alone
"""

from __future__ import annotations

from adamslite.integrators.contract import JOLT, Problem
from adamslite.native.translate import Reals, maximum, native

# Jolts below so many ERRORs are none.
UNFELT = 100.0


@native
def start_jolts(P: Problem) -> None:
    """None have been seen yet."""
    P.report.jolt, P.report.speed, P.report.jolts = 0.0, 0.0, 0


@native
def note_jolt(P: Problem, u: Reals, h: float, stages: bool) -> None:
    """Note what the step from velocities ``u`` and accelerations ``P.ra`` to those in place leaves
    open, and the largest velocity.

    With ``stages`` the jolt is large or not against velocities until the step.  Without, a start
    from rest is one: there the largest of the run tells.
    """
    R, jolt, speed, fastest = P.report, 0.0, max(UNFELT * P.settings.error, P.report.speed), 0.0
    for i in range(P.sizes.n):
        left_open = 0.5 * h * (P.a[i] - P.ra[i])
        if stages:
            left_open += P.u[i] - u[i] - h * P.a[i]
        jolt, speed = maximum(jolt, abs(left_open)), maximum(speed, abs(u[i]))
        fastest = maximum(fastest, abs(P.u[i]))
    R.jolt, R.speed = max(R.jolt, jolt), max(R.speed, fastest)
    if stages and jolt > JOLT * speed:
        R.jolts += 1

"""A step back: the return to an earlier accepted state from which no try failed.

Close to a posture in which constraints lose rank (dead centre, flattened parallelogram) they hold
the motion on its branch with a lever d, the distance from that posture: round-off e of positions
becomes an error e/d of the accepted position and e/d^2 of the velocity. A step that happens to land
there can be accepted, but no step may start from it. The way out is to land somewhere else.
Reference: Garcia de Jalon, Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994,
section 5.
"""

from __future__ import annotations

from adamslite.integrators.contract import STATE_ORIGIN, Problem
from adamslite.integrators.motion_equations import PART
from adamslite.native.translate import Reals, copy, native, seldom

# Accepted steps taken back in one place.
MOST_BACKS = 24
# The golden ratio spreads the lengths of repeated steps evenly over a range without multiples.
GOLDEN, SHORTEST = 0.6180339887498949, 0.4
# After so many shorter steps in vain longer ones are tried, which pass the place with a leap.
SHORT_TRIES, LONGEST = 16, 4.0
# A state is not kept for longer than parts turn by this angle: AZ and the like count turns by the
# nearest angle to the last accepted one, and two parts may turn against each other.
MOST_TURNED = 1.5


@native
def make_undoable(P: Problem, now: float, h: float, clean: bool) -> None:
    """Keep the state from which an accepted step of size h started, unless in the middle of
    trouble; ``clean`` when its first try was good.

    Steps that shrink towards a singular posture are accepted one by one, each after a rejection:
    the state before the first of them is the one to return to.
    """
    U = P.undoing
    if clean:
        U.trouble = max(0.0, U.trouble - 1.0)
    if P.undo.size > 0:
        angle = turning(P, h)
        U.turned += angle
        clear = U.trouble == 0.0 and now >= U.passed
        if not U.undoable or clear or U.turned > MOST_TURNED:
            U.undoable, U.backs, U.turned = True, 0, angle
            U.trouble_then = U.trouble
            remember(P)


@native
@seldom
def before_trouble(P: Problem, tried: float) -> float:
    """Back to the state kept before the trouble, which lies before the time ``tried``; the share of
    its step to take there, 0 when that was done often enough or there is no such state.
    """
    U = P.undoing
    if not U.undoable or U.backs >= MOST_BACKS:
        return 0.0
    U.backs, U.passed = U.backs + 1, max(U.passed, tried)
    U.turned, U.trouble = 0.0, U.trouble_then
    bring_back(P)
    spread = GOLDEN * U.backs - int(GOLDEN * U.backs)
    if U.backs <= SHORT_TRIES:
        return SHORTEST + (1.0 - SHORTEST) * spread
    return 1.0 + (LONGEST - 1.0) * spread


@native
def turning(P: Problem, h: float) -> float:
    """The largest angle by which a part turns in a time h at its present speed."""
    top = 0.0
    for b in range(P.sizes.nb):
        if P.body[b].width == PART:
            w = P.u[P.body[b].first + 3 :]
            top = max(top, w[0] * w[0] + w[1] * w[1] + w[2] * w[2])
    return h * top**0.5


@native
def remember(P: Problem) -> None:
    """Keep the last accepted state before the next one replaces it."""
    move_state(P, True)
    keep_audit(P)


@native
def bring_back(P: Problem) -> None:
    """What :func:`remember` kept."""
    move_state(P, False)
    bring_audit_back(P)


@native
def move_state(P: Problem, keep: bool) -> None:
    """The arrays of an accepted state one after another into ``undo``, or from there."""
    at = moved(P.history.size, P.history, P.undo, 0, keep)
    at = moved(P.control.size, P.control, P.undo, at, keep)
    at = moved(P.base.size, P.base, P.undo, at, keep)
    at = moved(P.ra.size, P.ra, P.undo, at, keep)
    at = moved(P.rz.size, P.rz, P.undo, at, keep)
    at = moved(P.pz.size, P.pz, P.undo, at, keep)
    for k in range(P.sizes.ns):
        o = P.scalar[P.sizes.m + P.sizes.nv + k] + STATE_ORIGIN
        moved(1, P.W[o:], P.undo, at + k, keep)


@native
def moved(n: int, x: Reals, kept: Reals, at: int, keep: bool) -> int:
    """x into a place of ``kept``, or from there; returns the place after it."""
    if keep:
        copy(kept[at:], x, n)
    else:
        copy(x, kept[at:], n)
    return at + n


@native
def keep_audit(P: Problem) -> None:
    """Remember the balance before steps that may have to be taken back."""
    if P.audit.on:
        P.audit.before[:] = P.audit.now
        copy(P.audit.previous_before, P.audit.previous, P.W.size)


@native
def bring_audit_back(P: Problem) -> None:
    """What :func:`keep_audit` kept."""
    if P.audit.on:
        P.audit.now[:] = P.audit.before
        copy(P.audit.previous, P.audit.previous_before, P.W.size)

"""VERLET: half a kick, drift, half a kick; for point masses without constraints.

    u+ = u- + h M^-1 f(t, q, u-),     q <- q + h u+         (u half a step away from q)

Second order, in forces of velocities first, because those see the velocity of half a step earlier.
Between two output times all steps are equal; their length keeps, with the largest eigenvalues
kappa of M^-1 K and c of M^-1 C,

    kappa h^2 + 2 c h <= 4 and the local error h^2 |change of a|/6 <= ERROR max(1, |q|);

an interval in which it grew too large is done again with shorter steps, and so is one in which
forces that change with the state became stiffer than that: a mass that meets a wall.
Reference: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2006, sections I.1.4, VIII.4.
"""

from __future__ import annotations

from math import floor

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.audit.balance import audit_leap
from adamslite.integrators.contract import (
    DONE,
    FULL,
    HELD,
    INTERRUPTED,
    LOADS,
    PAUSED,
    STABLE,
    STEP_TOO_SMALL,
    UNSTABLE,
    Problem,
)
from adamslite.integrators.events.events import start_events
from adamslite.integrators.events.stops import (
    end_of_pace,
    is_stop,
    longest_step,
    next_stop,
    present_stop,
    set_pace,
)
from adamslite.integrators.linalg.plan import HUGE, Plan
from adamslite.integrators.motion_equations import put_time, run_groups, track
from adamslite.integrators.records import has_room, write_record
from adamslite.integrators.step_back import bring_audit_back, keep_audit
from adamslite.integrators.stepping.budget import note_advance, would_overspend
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import OVERFLOW
from adamslite.integrators.unconstrained import POWERS, clear, divide_by_mass, put_free, radius
from adamslite.integrators.verlet.control import Control
from adamslite.integrators.verlet.lanes import take_lane_steps
from adamslite.integrators.verlet.sampling import (
    HOPELESS,
    LARGE,
    leave,
    local_error,
    note_steps,
    passes_pole,
    steps_per_estimate,
)
from adamslite.native.translate import Reals, native, rare

# Turns of the search for an eigenvalue from the vector found before, where laws are smooth.
POWERS_AGAIN = 8
# Intervals with fewer steps than this are not worth a new look at the eigenvalues each, which costs
# as much as 75 steps of the quickest kind: those that follow smooth laws.
WORTH, WORTH_SMOOTH = 200, 1000
SHRINK, GROW = 0.25, 2.0
# A law may have changed where the local error comes to this many times its mean, and where the
# change of an acceleration moves a velocity by this share of the largest within a step, and enough
# to move a position by the error that is allowed within the run.  Where the
# scene is then stiffer than it was (stable steps are below STIFFER times the longest so far), steps
# are at most the last share of a stable one: w h < 0.6 returns the speed to a wall within 3 %.
SPIKE, JOLT, STIFFER, IN_CONTACT = 4.0, 0.1, 0.9, 0.3
# Of the step that the error allows, after a rejected run and after an accepted one; an error below
# LEAST_ERROR counts as that.
SAFETY_DOWN, SAFETY, LEAST_ERROR = 0.8, 0.9, 1e-3
# An interval shorter than this share of a step says nothing about the next one.
CUT_OFF = 0.25
# Of HMAX, what stands for an HMIN that is not given (``least_step`` of the registered method).
LEAST = 1e-8
# What a number of steps may exceed a whole one by without one step more.
WHOLE = 1e-9
# Steps that take less than a try of a step by other methods.
STEPS_PER_TRY = 32
# Tries of one interval that may blow up: steps 4^8 times as short take any jump of a stiffness.
MOST_BLOWN = 8


@native
def verlet(P: Problem, L: Plan) -> int:
    """Integrate over the output times; returns an outcome."""
    C = Control(P.control)
    if not P.settings.begun:
        P.settings.begun = True
        begin(P, C)
    while C.row < P.times.size:
        P.block.row = C.row
        if C.step == 0:
            if P.settings.stop:
                return INTERRUPTED
            if not has_room(P, C.row):
                return FULL
            if P.block.hold:
                return HELD
        outcome = advance(P, L, C)
        if outcome == PAUSED or outcome == HELD:
            return outcome
        if outcome != DONE:
            restore_state(P, P.report.t)
            return outcome
        record(P, P.times[C.row], C)
        track(P)
    return DONE


@native
@rare
def begin(P: Problem, C: Control) -> None:
    """The first record, and the step to begin with."""
    C[:] = 0
    C.fixed = P.settings.h_init > 0.0
    P.report.order = 2
    start_events(P, False, False)
    P.report.stable_step = HUGE
    record(P, P.times[0], C)
    P.report.t = P.times[0]
    C.since = WORTH_SMOOTH
    C.wanted = P.settings.h_init if C.fixed else P.settings.h_max


@native
def advance(P: Problem, L: Plan, C: Control) -> int:
    """From one output time to the next over all stops between; returns an outcome, HELD where a
    state is asked for on the way.
    """
    at, end, outcome = P.report.t, P.times[C.row], DONE
    if C.step == 0:
        limit_step(P, C)
        if is_time_to_pause(P, (end - at) / (C.wanted if C.fixed else min(C.wanted, C.limit))):
            return PAUSED
    while at < end and outcome == DONE:
        set_pace(P, at)
        to = min(end, present_stop(P), end_of_pace(P))
        outcome = cover(P, L, C, at, to)
        if outcome == DONE:
            P.report.t, at = to, to
            if is_stop(P, to):
                P.count.events += 1
                next_stop(P, to)
    return outcome


@native
def record(P: Problem, t: float, C: Control) -> None:
    """Accelerations at the state in q and u, and a record of it."""
    restore_state(P, t)
    write_record(P, C.row)
    C.row += 1


@native
def restore_state(P: Problem, t: float) -> None:
    """Accelerations at the state in q and u."""
    put_free(P, t, P.q, P.u)
    run_groups(P, LOADS, P.F)
    divide_by_mass(P, P.F, P.history, 0.0, P.a)
    put_state(P, t, P.q, P.u, P.a, P.z, P.rd)


@native
def limit_step(P: Problem, C: Control) -> None:
    """The longest stable step at the workspace's state, when enough steps were taken since."""
    smooth = P.sizes.watched == 0 and not C.fixed
    if C.since < (WORTH_SMOOTH if smooth else WORTH):
        return
    C.since, C.limit = 0, STABLE * stable_step(P, C.limit > 0.0 and P.sizes.watched == 0)
    C.longest = max(C.longest, C.limit / STABLE)
    P.report.stable_step = min(P.report.stable_step, C.limit / STABLE)


@native
def stable_step(P: Problem, again: bool) -> float:
    """The longest stable step at the workspace's state; ``again``: not far from the last look."""
    n, turns = P.sizes.n, POWERS_AGAIN if again else POWERS
    x = P.history[9 * P.sizes.nb + 4 * n :]
    if not again:
        clear(x, 2 * n)
    kappa, c = radius(P, 1.0, 0.0, x, turns), radius(P, 0.0, 1.0, x[n:], turns)
    bottom = c + (c * c + 4.0 * kappa) ** 0.5
    return 4.0 / bottom if bottom > 0.0 else HUGE


@native
def stable_in_contact(P: Problem, C: Control, t: float, h: float) -> float:
    """The longest stable step at both ends of the step with the largest local error in the interval
    from ``t``, if a force that changes with the state has made the scene stiffer there.
    """
    n, speed, weight = P.sizes.n, 0.0, 1.0
    if P.sizes.watched == 0 or not C.top > SPIKE * C.mean:
        return HUGE
    hard = P.history[9 * P.sizes.nb + 2 * n :]
    for i in range(n):
        speed, weight = max(speed, abs(hard[n + i])), max(weight, abs(hard[i]))
    felt = P.settings.error / (P.times[P.times.size - 1] - P.times[0])
    if 6.0 * P.settings.error * C.top * weight < max(JOLT * speed, felt) * h:
        return HUGE
    put_free(P, t, hard, hard[n:])
    stable = stable_step(P, False)
    for i in range(n):  # velocities are those of the middle of the step
        hard[i] -= h * hard[n + i]
    put_free(P, t, hard, hard[n:])
    stable = min(stable, stable_step(P, False))
    return stable if stable < STIFFER * C.longest else HUGE


@native
def cover(P: Problem, L: Plan, C: Control, t: float, end: float) -> int:
    """From one output time or stop to the next by equal steps; returns an outcome."""
    fixed, old = C.fixed, P.history[9 * P.sizes.nb :]
    if C.step == 0:
        keep_start(P, old)
    wanted, blown = min(C.wanted if C.tried == 0.0 else C.tried, longest_step(P)), C.blown
    while C.step > 0 or not P.settings.stop:
        if not fixed:
            wanted = min(wanted, C.limit)
        h = (end - t) / max(1.0, 0.0 - floor(WHOLE - (end - t) / wanted))
        P.report.h = h
        count = int((end - t) / h + 0.5)
        refused = refusal(P, C, h, count, is_tiny(P, C, wanted) or blown == MOST_BLOWN)
        if refused != RUNNING:
            return refused
        if C.step == 0 and C.tried > 0.0 and is_time_to_pause(P, float(count)):
            return PAUSED
        error = take_steps(P, L, C, t, h, count)
        if C.step > 0:
            return HELD
        P.report.error = error
        stable = stable_in_contact(P, C, t, h) if error <= 1.0 else HUGE
        P.report.stable_step = min(P.report.stable_step, stable)
        if error <= 1.0 and h <= (stable if fixed else IN_CONTACT * stable):
            P.report.spent += C.spent
            C.tried, C.blown = 0.0, 0
            note_advance(P, h, count)
            C.wanted = choose_step(P, C, error, h, wanted)
            return DONE
        P.count.rejected += 1
        if fixed and not P.settings.stop:
            return UNSTABLE
        blown = 0 if error < HUGE else blown + 1
        wanted = h * (
            max(SHRINK, SAFETY_DOWN * error ** (-1.0 / 3.0)) if error < OVERFLOW else SHRINK
        )
        if error <= 1.0:
            wanted = min(0.5 * h, IN_CONTACT * stable)
        C.tried, C.blown = wanted, blown
        go_back(P, old)
    return INTERRUPTED


@native
def is_tiny(P: Problem, C: Control, wanted: float) -> bool:
    """Whether a step is below HMIN, or what stands for that, but not for stability alone."""
    least = min(P.settings.h_min, longest_step(P))
    if least <= LEAST * P.settings.h_max:
        least = min(least, C.limit)
    return wanted < least and not C.fixed


@native
def keep_start(P: Problem, old: Reals) -> None:
    """Where tries of an interval begin."""
    n = P.sizes.n
    for i in range(n):
        old[i], old[n + i] = P.q[i], P.u[i]
    keep_audit(P)


@native
def go_back(P: Problem, old: Reals) -> None:
    """Return there."""
    n = P.sizes.n
    for i in range(n):
        P.q[i], P.u[i] = old[i], old[n + i]
    bring_audit_back(P)


@native
def refusal(P: Problem, C: Control, h: float, count: int, hopeless: bool) -> int:
    """Why ``count`` steps are not taken: too short, not stable, or too many; else RUNNING."""
    if hopeless:
        return STEP_TOO_SMALL
    if C.fixed and STABLE * h > C.limit:
        return UNSTABLE
    return would_overspend(P, HUGE if C.fixed else h, count)


@native
def is_time_to_pause(P: Problem, steps: float) -> bool:
    """Whether so many more steps would take longer than the tries after which to pause."""
    most = float(STEPS_PER_TRY * P.settings.pause)
    return most > 0.0 and float(P.count.steps) + steps > most


@native
def choose_step(P: Problem, C: Control, error: float, h: float, wanted: float) -> float:
    """The step to try next: what was before, when these were short for the sake of a pulse, or
    because two stops are near to each other.
    """
    if longest_step(P) < P.settings.h_max:
        return C.wanted
    if C.fixed or error >= 0.5 or h < CUT_OFF * wanted:
        return wanted
    return min(GROW, SAFETY * max(error, LEAST_ERROR) ** (-1.0 / 3.0)) * h


@native
def take_steps(P: Problem, L: Plan, C: Control, t: float, h: float, count: int) -> float:
    """``count`` steps of half a kick, drift, half a kick, where the two half kicks between steps
    are one; returns the largest local error seen against ERROR, 1e300 for a blow-up.  Where a state
    is asked for the steps are left, with ``C.step``.
    """
    if P.lane_runs.size > 0 and P.sizes.watched + P.sizes.zones == 0 and not P.audit.on:
        return take_lane_steps(P, C, t, h, count)
    fixed, n, first = C.fixed, P.sizes.n, begin_steps(P, C, t)
    top, every = C.top, steps_per_estimate(P, C, h)
    hard = P.history[9 * P.sizes.nb + 2 * n :]
    for s in range(first, count + 1):
        if P.settings.stop or (P.block.hold and s > first):
            return leave(P, C, s, top, 0)
        if s > 0:
            put_time(P, t + s * h)
        run_groups(P, LOADS, P.F)
        audit_leap(P, L, t + s * h, h if s > 0 else 0.0)
        if s > 0 and s % every == 1 % every:
            divide_by_mass(P, P.F, P.history, 0.0, P.a)
            error = local_error(P, h)
            if error > top and P.sizes.watched > 0:
                keep_state(P, hard)
            top = max(top, error)
            if not top < HOPELESS and not fixed:
                return top
            C.spent += every * error
        if s % every == 0:
            divide_by_mass(P, P.F, P.history, 0.0, P.ra)
        kick = 0.5 * h if s == 0 or s == count else h
        drift = h if s < count else 0.0
        kick_and_drift(P, kick, drift)
    C.top, C.mean = top, C.spent / count if count > 2.0 * SPIKE else 0.0
    if not accept(P):
        return HUGE
    note_steps(P, C, count)
    return 0.0 if fixed else top


@native
def begin_steps(P: Problem, C: Control, t: float) -> int:
    """The step to begin with; zero unless the try was left."""
    first, C.step = C.step, 0
    if first == 0:
        C.top, C.spent = 0.0, 0.0
        put_free(P, t, P.q, P.u)
        passes_pole(P)
    return first


@native
def keep_state(P: Problem, y: Reals) -> None:
    """Positions and velocities of the workspace into y (2n,)."""
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(3):
            y[i + k], y[P.sizes.n + i + k] = P.W[o + k], P.W[o + 3 + k]


@native
def kick_and_drift(P: Problem, kick: float, drift: float) -> None:
    """u -= kick M^-1 F, q += drift u in the workspace; minus the weights into F."""
    W, F, body = P.W, P.F, P.body
    gx, gy, gz = P.gravity[0], P.gravity[1], P.gravity[2]
    for b in range(P.sizes.nb):
        i, o, m = body[b].first, body[b].at, P.mass[b]
        p = kick / m
        u, v, w = W[o + 3] - p * F[i], W[o + 4] - p * F[i + 1], W[o + 5] - p * F[i + 2]
        W[o + 3], W[o + 4], W[o + 5] = u, v, w
        W[o], W[o + 1], W[o + 2] = W[o] + drift * u, W[o + 1] + drift * v, W[o + 2] + drift * w
        F[i], F[i + 1], F[i + 2] = -m * gx, -m * gy, -m * gz


@native
def accept(P: Problem) -> bool:
    """Positions and velocities of the workspace into q and u; False when they are not numbers."""
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(3):
            P.q[i + k], P.u[i + k] = P.W[o + k], P.W[o + 3 + k]
            if not abs(P.W[o + k]) + abs(P.W[o + 3 + k]) < LARGE:
                return False
    return True

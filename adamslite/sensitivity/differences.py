"""Sensitivities by backward differences on the steps of the run.

The formula of GSTIFF (:mod:`adamslite.integrators.bdf.method`) is applied to the derivatives of the
equations: with differences of the sensitivities y on the same steps and orders

    y' = (psi + d) cu,    F_q dq + F_u du + F_a da + F_z dz + F_s' ds' + F_p = 0

is a linear system for each number (:mod:`adamslite.sensitivity.corrector`).  Turns are rates of
theta' = dw + w x theta.

Reference: Caracotsios, Stewart, Comput. Chem. Eng. 9 (1985) 359 (staggered direct method).
"""

from __future__ import annotations

from adamslite.integrators.accelerations import factor_accelerations
from adamslite.integrators.audit_record import (
    AT_STEP,
    TAPE_HEAD,
    TAPE_KIND,
    TAPE_ORDER,
    TAPE_RESTARTS,
    TAPE_STEP,
    TAPE_TIME,
)
from adamslite.integrators.bdf.dense_output import interpolate
from adamslite.integrators.bdf.differences import change_step, extend_history, extrapolate, gamma
from adamslite.integrators.bdf.state import tests_velocities
from adamslite.integrators.contract import DONE, SINGULAR_MASS, Problem
from adamslite.integrators.linalg.norms import largest_of
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import track
from adamslite.integrators.stepping.output import WITHIN
from adamslite.native.translate import Reals, copy, native
from adamslite.sensitivity.begin import begin_history
from adamslite.sensitivity.contract import Forward, Tangents
from adamslite.sensitivity.corrector import (
    MOST,
    continued,
    corrected,
    forgotten,
    grown_older,
    kept_at,
    outdated,
    renewed,
)
from adamslite.sensitivity.start import at_start, jump, reset_states
from adamslite.sensitivity.tangents import write_outputs


@native
def by_differences(P: Problem, L: Plan, D: Tangents, S: Forward) -> int:
    """Follow the tape; the record of derivatives is filled."""
    T = P.tape
    if not at_start(P, L, D, S):
        return SINGULAR_MASS
    fresh = True
    for row in range(1, T.rows):
        here, before = T.data[row * T.width :], T.data[(row - 1) * T.width + TAPE_HEAD :]
        if here[TAPE_KIND] != AT_STEP:
            jump(P, L, D, S, before, here[TAPE_HEAD:], here[TAPE_STEP])
            copy(P.W, here[TAPE_HEAD:], P.W.size)
            forgotten(S)
            if row + 1 < T.rows:
                fresh = restarts(T.data[(row - 1) * T.width :], T.data[(row + 1) * T.width :])
            continue
        reset_states(P, D, S, before, here[TAPE_HEAD:])
        if fresh and not begin_history(P, L, D, S, here[TAPE_STEP], int(here[TAPE_ORDER])):
            return SINGULAR_MASS
        if fresh:
            forgotten(S)
        fresh = False
        copy(P.W, here[TAPE_HEAD:], P.W.size)
        if not step(P, L, D, S, here):
            return SINGULAR_MASS
        written = S.row
        if not record(P, L, D, S, here):
            return SINGULAR_MASS
        if S.row > written:
            copy(P.W, here[TAPE_HEAD:], P.W.size)
        track(P)
    return DONE


@native
def restarts(before: Reals, behind: Reals) -> bool:
    """Whether the history began anew between two steps."""
    return before[TAPE_RESTARTS] != behind[TAPE_RESTARTS]


@native
def step(P: Problem, L: Plan, D: Tangents, S: Forward, here: Reals) -> bool:
    """Sensitivities at the end of a step, whose state is in the workspace."""
    h, order = here[TAPE_STEP], int(here[TAPE_ORDER])
    cu, extra = gamma(order) / h, 0
    for number in range(D.count if h != S.h else 0):
        change_step(S.history[number * S.room :], S.width, order, h / S.h)
    if outdated(S, cu) and not renewed(P, L, S, cu):
        return False
    continued(S, here[TAPE_TIME])
    for number in range(D.count):
        predict(S, number, order)
        turns = corrected(P, L, D, S, number, cu, order, here)
        if turns > MOST:
            if not renewed(P, L, S, cu):
                return False
            turns, extra = corrected(P, L, D, S, number, cu, order, here), 0
        accept(P, S, number, order)
        extra += turns - 1
    kept_at(S, here[TAPE_TIME])
    grown_older(S, extra)
    S.h, S.order = h, order
    return True


@native
def predict(S: Forward, number: int, order: int) -> None:
    """Predicted sensitivities by a number and psi, into ``S.y``."""
    H, w, yp = S.history[number * S.room :], S.width, S.y[0:]
    extrapolate(H, w, order, yp, S.y[w:])
    for i in range(w):
        yp[i] += H[i]


@native
def accept(P: Problem, S: Forward, number: int, order: int) -> None:
    """Extend the history by the sensitivities in ``S.y``."""
    w, n = S.width, P.sizes.n
    yp, change, y = S.y[0:], S.y[w:], S.y[2 * w :]
    for i in range(n, w):
        change[i] = y[i] - yp[i]
    for i in range(n):
        change[i] = S.v[i]  # y - y_p has round-off of y, which longer steps enlarge
    note_error(P, S, number, y, change, order)
    extend_history(S.history[number * S.room :], change, w, order)


@native
def note_error(P: Problem, S: Forward, number: int, y: Reals, change: Reals, order: int) -> None:
    """Add the error estimate of the formula, d/(k + 1), of places and of velocities, the latter
    where that of the run is tested.
    """
    n = P.sizes.n
    for part in range(2 if tests_velocities(P) else 1):
        at = 2 * number + part
        S.spent[at] += largest_of(change[part * n :], n) / (order + 1)
        S.top[at] = max(S.top[at], largest_of(y[part * n :], n))


@native
def record(P: Problem, L: Plan, D: Tangents, S: Forward, here: Reals) -> bool:
    """Every output time of the step; the record of the run has its states."""
    t, h, size = here[TAPE_TIME], here[TAPE_STEP], P.sizes.nw + P.sizes.n_out
    while S.row < P.times.size and P.times[S.row] <= t + WITHIN * h:
        copy(P.W, P.record[S.row * size :], P.sizes.nw)
        if not factor_accelerations(P, L):
            return False
        for number in range(D.count):
            H = S.history[number * S.room :]
            interpolate(H, S.width, S.order, t, h, P.times[S.row], S.y)
            write_outputs(P, L, D, S, number, S.y)
        S.row += 1
    return True

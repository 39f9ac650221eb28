"""Newton on the three stages of the Radau formula.

Iterations stop when rate/(1 - rate) times the last increment is a small share of ERROR, and fail
when what is left cannot come below that within MAXIT iterations.
Reference: Hairer, Wanner, Solving ODE II, 1996, section IV.8 (stopping criterion).
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.implicit.tolerance import TINY
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.newton import ROUND_OFF, SHRINKING, renews, serves, weigh_residuals
from adamslite.integrators.radau.coefficients import REAL
from adamslite.integrators.radau.control import ORIGIN, Control
from adamslite.integrators.radau.stages import (
    move_stages,
    radau_jacobian,
    radau_matrices,
    separate_increments,
    stage_increments,
    stage_residuals,
)
from adamslite.integrators.stepping.outcome import OVERFLOW
from adamslite.native.translate import maximum, native, rare

# Newton stops when the estimated remaining error is this share of ERROR.
CORRECTOR_SHARE = 0.002
# The derivatives are kept for the next step when increments shrank by this, but not for ever.
QUICK, KEEP_STEPS = 0.01, 20.0
# The second increment may exceed the first by this, which moves one stage for the sake of another
# where constraints are nearly dependent.
DIVERGING = 3.0
# What RATE/(1 - RATE) is not believed to be below.
LEAST_RATE = 0.01
# Power by which the rate of the step before is trusted less.
AGED = 0.8
# Increments that shrink by less than this do not converge; what 1 - RATE counts at least.
STALLED, LEAST_REST = 0.99, 0.01
# Increments of this many times the round-off of positions, over the step, cannot be improved.
NOISE = 10.0
# With new matrices at every iterate increments that shrink by less than the first are round-off,
# which a posture near the loss of rank amplifies, where they are below the second share of ERROR.
NOISY, NOISE_SHARE = 0.3, 0.2
# Factors made for a step that differs by this share serve.
SAME_STEP = 1e-6


@native
def ready(P: Problem, L: Plan, C: Control, turn: int) -> bool:
    """Derivatives and factors for the present step and iteration."""
    if not C.known or renews(P, turn, C.age < KEEP_STEPS or turn > 0):
        radau_jacobian(P, 2, C.h)
        C.known, C.fresh, C.age, C.factored, C.made = True, True, 0, 0.0, turn
    if not abs(C.h - C.factored) <= SAME_STEP * C.h:
        C.factored = C.h if radau_matrices(P, L, C.h) else 0.0
    return C.factored != 0.0


@native
def correct(P: Problem, L: Plan, C: Control) -> bool:
    """Newton from the prediction; True when converged."""
    if C.separate:
        return correct_separately(P, L, C)
    h, last, felt, small = C.h, 0.0, 0.0, False
    tolerance, most = CORRECTOR_SHARE * P.settings.error, P.settings.max_it
    C.rate, C.theta, C.made = max(C.rate, LEAST_RATE) ** AGED, 0.0, -1
    weigh_residuals(P, 0.5 * h * h, h)
    for turn in range(most):
        if not ready(P, L, C, turn):
            return False
        before, felt = felt, stage_residuals(P, h)
        if small and serves(felt, before, P.settings.error, CORRECTOR_SHARE):
            return True
        stage_increments(P, L)
        size = move_stages(P, h)
        P.count.newton += 1
        C.turns = turn + 1
        if not size < OVERFLOW:
            return False
        good = C.made == turn or serves(felt, before, P.settings.error, CORRECTOR_SHARE)
        hopeless = C.made == turn and turn > 0
        if C.made < turn and last > 0.0:
            C.theta = size / last
            rest = max(LEAST_REST, 1.0 - C.theta)
            C.rate = max(LEAST_RATE, C.theta / rest)
            hopeless = C.theta > (DIVERGING if turn == 1 else STALLED) or (
                turn > 1 and C.theta ** (most - 1.0 - turn) / rest * size > tolerance
            )
            if hopeless and size > NOISE * round_off(P, C):
                return False
        small = C.rate * size <= tolerance or (hopeless and size <= NOISE * round_off(P, C))
        if small:
            if good:
                return True
            C.known = turn == 0 or felt <= SHRINKING * before
        last = size
    return False


@native
@rare
def correct_separately(P: Problem, L: Plan, C: Control) -> bool:
    """Newton in turns with one matrix for all stages and with new ones of each; True when
    converged.

    No matrix serves stages on both sides of a posture in which constraints lose rank: what the
    first leaves of it the second removes, which in turn couples inertia of the stages too loosely.
    """
    h, last, size, tolerance = C.h, 0.0, 0.0, CORRECTOR_SHARE * P.settings.error
    noise = max(NOISE_SHARE * P.settings.error, min(TINY, NOISE * round_off(P, C)))
    C.theta, C.known = 1.0, False
    if C.factored != h:
        radau_jacobian(P, 2, h)
        if not radau_matrices(P, L, h):
            return False
    C.factored = 0.0
    for turn in range(P.settings.max_it):
        C.turns, last = turn + 1, size
        stage_residuals(P, h)
        stage_increments(P, L)
        size = move_stages(P, h)
        stage_residuals(P, h)
        if not separate_increments(P, L, h):
            return False
        size = maximum(size, move_stages(P, h))
        P.count.newton += 1
        rate = size / last if turn > 0 else 1.0
        allowed = noise if turn > 0 and rate > NOISY else tolerance
        if min(1.0, rate / max(LEAST_REST, 1.0 - rate)) * size <= allowed:
            return True
        if not size < OVERFLOW or (turn > 1 and rate > 1.0):
            return False
    return False


@native
def round_off(P: Problem, C: Control) -> float:
    """Changes of velocities that come from the last digits of positions."""
    w, reach = 2 * P.sizes.n + P.sizes.ns, 1.0
    for i in range(P.sizes.n):
        reach = max(reach, abs(P.history[ORIGIN * w + i]))
    return ROUND_OFF * reach * P.tableau[REAL] / C.h

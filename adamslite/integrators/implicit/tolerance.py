"""The error test of a step: its tolerance, and the sizes against which it is measured."""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.linalg.norms import largest_of, largest_share, place_of
from adamslite.integrators.stepping.outcome import OVERFLOW
from adamslite.native.translate import Reals, maximum, native, seldom

# Fixed steps have no error test: a corrector looser than this would be all that errs.
LOOSEST = 1e-3
# Round-off of positions as a share of the largest; what counts instead of an error of that size:
# steps grow, because round-off over the step falls.
ROUND_OFF, CALM = 2e-15, 0.01
# So many ERRORs at most: the round-off of tiny steps would pass for any error.  Where a shorter
# step has more than this share of the error of the longer one, up to so much whatever ERROR is.
MOST, KEPT, TINY = 4.0, 0.5, 1e-10


@native
def error_limit(P: Problem, fixed: float) -> float:
    """ERROR; with ``fixed`` steps at most LOOSEST."""
    return min(P.settings.error, LOOSEST) if fixed > 0.0 else P.settings.error


@native
def is_allowed(norm: float, fixed: float) -> bool:
    """Whether a step with this error over ERROR is accepted; ``fixed`` steps have no error test."""
    return norm <= 1.0 or (fixed > 0.0 and norm < OVERFLOW)


@native
def weighted(d: Reals, y: Reals, n: int, ns: int, si2: bool) -> float:
    """Largest |d| against max(1, |y|) over the tested variables."""
    count = 2 * n if si2 else n
    return maximum(largest_share(d, y, count), largest_share(d[2 * n :], y[2 * n :], ns))


@native
def most_wrong(top: float, d: Reals, y: Reals, n: int, ns: int, si2: bool) -> int:
    """The tested variable of which :func:`weighted` is ``top``."""
    found = place_of(top, d, y, 2 * n if si2 else n)
    if found < 0:
        found = 2 * n + place_of(top, d[2 * n :], y[2 * n :], ns)
    return max(found, 0)


@native
@seldom
def beyond_round_off(P: Problem, norm: float, last: float, q: Reals, cu: float) -> float:
    """The error ``norm`` of a step over ERROR; CALM where it is below the round-off of positions
    ``q`` that constraints hand on to velocities, of which a shorter step has more.  ``last``: that
    of the same step when it was longer, 0 for none.
    """
    noise = ROUND_OFF * max(1.0, largest_of(q, P.sizes.n)) * cu
    most = MOST
    if last > 0.0 and norm > KEPT * last:
        most = max(MOST, TINY / P.settings.error)
    if P.sizes.holonomic == 0 or norm > most or not norm * P.settings.error <= noise:
        return norm
    P.report.floor = max(P.report.floor, norm * P.settings.error)
    return CALM

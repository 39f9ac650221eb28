"""Second runs, with which a run is compared: their ERROR, within some hundredths of a second."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from adamslite.analyses.findings.accuracy_notes import LEAST_PART, is_of_order_1

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.dynamic import Settings
    from adamslite.analyses.dynamics.history import History
    from adamslite.integrators import contract
    from adamslite.results.results import Results

# The second run is at ERROR over this, over its square where that is not too long: both may err
# alike where they damp a vibration or pass a narrow force. Its difference from the first falls
# short of the error by as much as it errs itself. Its longest step is that share of what limits
# those of the first.
FINER, SHORT, SHORTER = 10.0, 1.2, 0.55
# Where ERROR is close to round-off, or most of such a run would take too long, it is coarser:
# by that, or its square where that takes too long as well; steps grow by that power of it.
FINEST, COARSER, COARSEST, STRETCH = 1e-10, 100.0, 1e-3, 0.13
# Residuals times size of the model that a second run may take (30 ms), or this share of the first.
LOOK, SHARE = 1_250_000.0, 0.03
# A finer run takes more steps by this root of FINER, or more.
STEEPEST = 5.0
# What has to be allowed, in first runs, for most of a finer one, and for all of a coarser one.
DEARER, CHEAPER = 1.45, 0.5
# Numbers that are compared at most.
MOST_NUMBERS = 2**21
# A coarser run that takes more than this share of the steps is limited as the first one is, by
# expressions of TIME or zones, and errs alike.
ALIKE = 0.8
Again: TypeAlias = "Callable[..., Results | None]"


def second_runs(
    settings: Settings, counts: contract.Counts, size: int, history: History, again: Again
) -> tuple[list[Results], float]:
    """Second runs, as many as do not take too long, and the error of the first over the difference
    from them.  Two runs may err alike by chance: where a finer one is short there is a third.
    """
    for finer in (False, True):
        options, factor = _second_run(settings, counts, size, history, finer)
        found = again(**options) if options else None
        if not found:
            break
        takes = found.summary["steps"]
        if options["error"] > settings.error:
            if takes > ALIKE * counts.steps:
                continue
        elif 3 * takes < options["max_steps"] and options["error"] < settings.error / FINER:
            third = again(**{**options, "error": settings.error / FINER})
            return [found, *([third] if third else ())], factor
        return [found], factor
    return [], 0.0


def _second_run(
    settings: Settings, counts: contract.Counts, size: int, history: History, finer: bool
) -> tuple[dict[str, Any], float]:
    """The options of a second run, none where it would take too long, and the factor; ``finer``: it
    must not be coarser.
    """
    takes = max(float(counts.residuals) * size, 1.0)
    part = max(LOOK, SHARE * takes) / takes
    if part < LEAST_PART or not 1 < history.numbers < MOST_NUMBERS:
        return {}, 0.0
    apart = np.diff(history.whole.times)
    usual = float(np.median(apart[apart > 0.0])) if apart.any() else inf
    longest = min(settings.hmax or inf, usual)
    # Steps may be limited by expressions of TIME: to their mean.
    hmax = SHORTER * min(longest, float(apart.sum()) / max(1, int(counts.steps)) or inf)
    order, factor = settings.formula.order, SHORT
    much = part ** (2.0 if is_of_order_1(settings) else min(order + 1.0, STEEPEST)) > FINER**2
    error = settings.error / (FINER**2 if much else FINER)
    coarser = min(COARSER if part > CHEAPER else COARSER**2, COARSEST / settings.error)
    if not finer and coarser >= FINER and (part < DEARER or settings.error < FINEST):
        error, stretch = settings.error * coarser, coarser**STRETCH
        hmax = stretch * longest
        factor = 1.0 / (min(coarser ** (order / (order + 1.0)), stretch**order) - 1.0)
    options = {
        "integrator": settings.method, "formulation": settings.form, "error": error,
        "hmax": hmax if hmax < inf else None, "max_steps": int(part * int(counts.steps)) + 1,
    }  # fmt: skip
    return options, factor

"""The effect of each argument of INTEGRATOR with each method.

The same table answers `check`, the comments of a run and the page docs/integrators.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

BACKWARD, FIXED, SECOND, STAGES = (
    ("GSTIFF", "WSTIFF"),
    ("CONSTANT_BDF",),
    ("HHT", "NEWMARK"),
    ("RADAU",),
)
RUNGE_KUTTA, LEAPFROG = ("ABAM", "RKF45"), ("VERLET",)
FAMILIES = (BACKWARD, FIXED, SECOND, STAGES, RUNGE_KUTTA, LEAPFROG)

ONE_ERROR = "its coordinates have one tolerance"
NO_CORRECTOR = "an explicit formula has no corrector"
# argument -> family -> what it does; a reason after "-" says why it does nothing.
USES: dict[str, dict[tuple[str, ...], str]] = {
    "ERROR": {
        BACKWARD: "local error of q, states and, with SI2, u; above 1 in relation to the value",
        FIXED: "tolerance of the corrector; there is no error test",
        SECOND: "local error of q and states; NEWMARK of order 1: of u too",
        STAGES: "local error of q, u and states",
        RUNGE_KUTTA: "local error of q, u and states",
        LEAPFROG: "local error of q, unless HINIT is given",
    },
    "HMAX": {
        BACKWARD: "largest step",
        FIXED: "the step, unless HINIT is given",
        SECOND: "largest step",
        STAGES: "largest step",
        RUNGE_KUTTA: "largest step",
        LEAPFROG: "largest step",
    },
    "HMIN": {
        BACKWARD: "steps that fail are cut down to it; if one of that size fails, the run ends",
        FIXED: "-its steps are fixed",
        SECOND: "as with GSTIFF; with HINIT = HMAX = HMIN all steps are of that size",
        STAGES: "as with GSTIFF",
        RUNGE_KUTTA: "as with GSTIFF",
        LEAPFROG: "the run ends when steps have to be smaller",
    },
    "HINIT": {
        BACKWARD: "first step, also after a jump",
        FIXED: "the step",
        SECOND: "first step of the run",
        STAGES: "first step, also after a jump",
        RUNGE_KUTTA: "first step, also after a jump",
        LEAPFROG: "the step, shortened to fit between output times; no error test",
    },
    "KMAX": {
        BACKWARD: "highest order, at most 5",
        FIXED: "the order, at most 5",
        SECOND: "-its order is 2",
        STAGES: "-its order is 5",
        RUNGE_KUTTA: "-its order is 8",
        LEAPFROG: "-its order is 2",
    },
    "MAXIT": {
        BACKWARD: "iterations until the corrector has failed",
        FIXED: "iterations until the corrector has failed, which ends the run",
        SECOND: "iterations until the corrector has failed",
        STAGES: "iterations until the corrector has failed",
        RUNGE_KUTTA: "-" + NO_CORRECTOR,
        LEAPFROG: "-" + NO_CORRECTOR,
    },
    "PATTERN": {
        BACKWARD: "iterations that renew the matrix, as a new step size does",
        FIXED: "as with GSTIFF",
        SECOND: "as with GSTIFF; a matrix that converges slowly is renewed all the same",
        STAGES: "as with GSTIFF; iterations of the three stages together",
        RUNGE_KUTTA: "-" + NO_CORRECTOR,
        LEAPFROG: "-" + NO_CORRECTOR,
    },
    "INTERPOLATE": {
        BACKWARD: "OFF: equal steps onto every output time; unless given, ON",
        FIXED: "-its steps are fixed, and values between them are interpolated",
        SECOND: "OFF: equal steps onto every output time; unless given, ON",
        STAGES: "ON: steps pass output times, a cubic in between; unless given, OFF",
        RUNGE_KUTTA: "OFF: equal steps onto every output time; unless given, ON",
        LEAPFROG: "-its equal steps end at output times",
    },
    "ADAPTIVITY": {
        BACKWARD: "over the step, added to the tolerance of the corrector",
        FIXED: "over the step, added to the tolerance of the corrector",
        SECOND: "-it loosens the corrector of backward differences only",
        STAGES: "-it loosens the corrector of backward differences only",
        RUNGE_KUTTA: "-" + NO_CORRECTOR,
        LEAPFROG: "-" + NO_CORRECTOR,
    },
    "CORRECTOR": {
        BACKWARD: "ORIGINAL, ORIG_CONSTANT: multipliers must converge too; unless given, MODIFIED",
        FIXED: "as with GSTIFF",
        SECOND: "as with GSTIFF",
        STAGES: "as with GSTIFF",
        RUNGE_KUTTA: "-" + NO_CORRECTOR,
        LEAPFROG: "-" + NO_CORRECTOR,
    },
    "SCALE": {
        BACKWARD: "-" + ONE_ERROR,
        FIXED: "-there is no error test",
        SECOND: "-" + ONE_ERROR,
        STAGES: "-" + ONE_ERROR,
        RUNGE_KUTTA: "factors of ERROR for displacements, angles, modal coordinates, their rates",
        LEAPFROG: "-" + ONE_ERROR,
    },
    "ALPHA": {
        family: "numerical damping of HHT" if family is SECOND else "-it belongs to HHT"
        for family in FAMILIES
    },
    **{
        word: {
            family: "coefficient of NEWMARK" if family is SECOND else "-it belongs to NEWMARK"
            for family in FAMILIES
        }
        for word in ("BETA", "GAMMA")
    },
}


def without_effect(method: str, words: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Those of the arguments that do nothing with ``method``, each with the reason."""
    for word in words:
        for family, use in USES.get(word, {}).items():
            if method in family and use.startswith("-"):
                yield word, use[1:]
    for word, owner in (("ALPHA", "HHT"), ("BETA", "NEWMARK"), ("GAMMA", "NEWMARK")):
        if word in words and method in SECOND and method != owner:
            yield word, f"it belongs to {owner}"

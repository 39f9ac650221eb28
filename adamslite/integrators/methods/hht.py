"""HHT, NEWMARK: formulas of second order for structures, with numerical damping."""

from __future__ import annotations

from dataclasses import replace

from adamslite.language.method import Equations, Method, Settings, register

# Share of an error across a constraint that may be left after a step.  HHT: ALPHA of -0.016; with
# -0.01 the ringing costs a pendulum twenty times the steps of -0.05.
LOUDEST = 0.97


def damping_of_hht(settings: Settings) -> tuple[float, float, float]:
    """alpha, and beta and gamma that make the formula of order 2."""
    alpha = settings.alpha
    return alpha, (1.0 - alpha) ** 2 / 4.0, 0.5 - alpha


def damping_of_newmark(settings: Settings) -> tuple[float, float, float]:
    """No alpha, beta and gamma as given."""
    return 0.0, settings.beta, settings.gamma


def prepare(system: Equations, settings: Settings) -> None:
    """Room for the numbers of the method and what it remembers of accepted states."""
    from adamslite.integrators.hht.control import Control

    system.make_room(control=Control.slots, history=3 * system.n + 4 * system.ns)


def ringing(settings: Settings, tied: str) -> str:
    """Why constraints make a formula with little damping unusable."""
    _, beta, gamma = settings.damping
    if not tied or echo(beta, gamma) <= LOUDEST:
        return ""
    return (
        f"{tied}, and with so little damping (GAMMA={gamma:g}) its reactions ring, louder with "
        "every step. Use HHT with ALPHA=-0.05 or below, or GSTIFF."
    )


def echo(beta: float, gamma: float) -> float:
    """What is left after a step of an error in the acceleration across a constraint.

    The constraint fixes q, so that beta b+ + (1/2 + gamma - 2 beta) b + (1/2 - gamma + beta) b- is
    given; the largest root of that.  1 is the trapezoidal rule.
    """
    import numpy as np

    return float(np.abs(np.roots([beta, 0.5 + gamma - 2.0 * beta, 0.5 - gamma + beta])).max())


HHT = Method(
    names=("HHT",),
    what="the method of Hilber, Hughes and Taylor: order 2 with variable step, numerical damping "
    "ALPHA",
    suited="stiff structures whose fast vibrations are to be damped, with ERROR of 1E-4 and above",
    entry="adamslite.integrators.hht.method.hht",
    order=2,
    family="Newmark",
    explicit=False,
    tests_velocities=False,
    pauses=True,
    damping=damping_of_hht,
    unfit=ringing,
    in_blocks=True,
    prepare=prepare,
    arguments={
        "ERROR": "local error of q and states",
        "HMAX": "largest step",
        "HMIN": "as with GSTIFF; with HINIT = HMAX = HMIN all steps are of that size",
        "HINIT": "first step of the run",
        "KMAX": "-its order is 2",
        "MAXIT": "iterations until the corrector has failed",
        "PATTERN": "as with GSTIFF; a matrix that converges slowly is renewed all the same",
        "INTERPOLATE": "OFF: equal steps onto every output time; unless given, ON",
        "ADAPTIVITY": "-it loosens the corrector of backward differences only",
        "CORRECTOR": "as with GSTIFF",
        "SCALE": "-its coordinates have one tolerance",
        "ALPHA": "numerical damping, from -1/3 to 0",
        "BETA": "-it belongs to NEWMARK",
        "GAMMA": "-it belongs to NEWMARK",
    },
)
register(HHT)
register(
    replace(
        HHT,
        names=("NEWMARK",),
        what="Newmark's formula with variable step: order 2 with GAMMA = 1/2, else order 1, "
        "numerical damping by GAMMA",
        suited="comparison with other programs that use this formula",
        damping=damping_of_newmark,
        arguments={
            **HHT.arguments,
            "ERROR": "local error of q and states; where it is of order 1: of u too",
            "ALPHA": "-it belongs to HHT",
            "BETA": "coefficient of the formula",
            "GAMMA": "coefficient of the formula; numerical damping above 1/2",
        },
    )
)

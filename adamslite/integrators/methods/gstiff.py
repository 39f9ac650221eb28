"""GSTIFF, WSTIFF, CONSTANT_BDF: backward differentiation formulas."""

from dataclasses import replace

from adamslite.language.method import FIXED, Equations, Method, Settings, register


def prepare(system: Equations, settings: Settings) -> None:
    """Room for the numbers of the method and the differences."""
    from adamslite.integrators.bdf.control import Control
    from adamslite.integrators.bdf.history import room

    system.make_room(control=Control.slots, history=room(2 * system.n + system.ns))


GSTIFF = Method(
    names=("GSTIFF", "WSTIFF"),
    what="backward differentiation formulas of order 1 to 5 with variable step",
    suited="any scene, and stiff ones with constraints in particular; damps what is faster "
    "than its steps",
    entry="adamslite.integrators.bdf.method.bdf",
    order=5,
    family="differences",
    explicit=False,
    formulations=("SI2", "I3"),
    in_blocks=True,
    prepare=prepare,
    arguments={
        "PATTERN": "iterations that renew the matrix, as a new step size does",
        "ADAPTIVITY": "over the step, added to the tolerance of the corrector",
        "CORRECTOR": "ORIGINAL, ORIG_CONSTANT: multipliers must converge too; unless given, "
        "MODIFIED",
        "ALPHA": "-it belongs to HHT",
        "BETA": "-it belongs to NEWMARK",
        "GAMMA": "-it belongs to NEWMARK",
        "ERROR": "local error of q, states and, with SI2, u; above 1 in relation to the value",
        "HMAX": "largest step",
        "HMIN": "steps that fail are cut down to it; if one of that size fails, the run ends",
        "HINIT": "first step, also after a jump",
        "KMAX": "highest order, at most 5",
        "MAXIT": "iterations until the corrector has failed",
        "INTERPOLATE": "OFF: equal steps onto every output time; unless given, ON",
        "SCALE": "-its coordinates have one tolerance",
    },
)
register(GSTIFF)
register(
    replace(
        GSTIFF,
        names=("CONSTANT_BDF",),
        what="backward differentiation formulas with fixed steps of HINIT, else HMAX, else a 20th "
        "of the output step, without error test",
        suited="runs that must take the same steps whatever happens",
        steps=FIXED,
        arguments={
            **GSTIFF.arguments,
            "ERROR": "tolerance of the corrector; there is no error test",
            "HMAX": "the step, unless HINIT is given",
            "HMIN": "-its steps are fixed",
            "HINIT": "the step",
            "KMAX": "the order, at most 5",
            "MAXIT": "iterations until the corrector has failed, which ends the run",
            "INTERPOLATE": "-its steps are fixed, and values between them are interpolated",
            "PATTERN": "as with GSTIFF",
            "CORRECTOR": "as with GSTIFF",
            "SCALE": "-there is no error test",
        },
    )
)

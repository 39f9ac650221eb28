"""RADAU: an implicit Runge-Kutta formula of order 5."""

from adamslite.language.method import Equations, Method, Settings, register


def prepare(system: Equations, settings: Settings) -> None:
    """Coefficients, and room for the numbers of the method, the stages and the complex factors."""
    from adamslite.integrators.radau.coefficients import coefficients
    from adamslite.integrators.radau.control import Y_ROWS, Z_ROWS, Control

    z = system.m + system.nv + system.ns + system.holonomic
    system.tableau = coefficients()
    system.make_room(
        control=Control.slots,
        history=Y_ROWS * (2 * system.n + system.ns) + Z_ROWS * z + 7 * system.nz + 16,
        parts=3 * system.J.size,
        LC=2 * system.elimination.LV.size,
        pivots_c=system.nz + 1,
        work=2 * system.elimination.room,
    )


register(
    Method(
        names=("RADAU",),
        what="the three-stage Radau IIA formula of order 5 with variable step",
        suited="ERROR below 1E-5, also of stiff scenes with constraints",
        entry="adamslite.integrators.radau.method.radau",
        order=5,
        family="Radau",
        explicit=False,
        formulations=("SI2",),
        in_blocks=True,
        prepare=prepare,
        interpolates=False,  # its polynomial within a step has order 3 only
        arguments={
            "ERROR": "local error of q, u and states",
            "HMAX": "largest step",
            "HMIN": "as with GSTIFF",
            "HINIT": "first step, also after a jump",
            "KMAX": "-its order is 5",
            "MAXIT": "iterations until the corrector has failed",
            "PATTERN": "as with GSTIFF; iterations of the three stages together",
            "INTERPOLATE": "ON: steps pass output times, a cubic in between; unless given, OFF",
            "ADAPTIVITY": "-it loosens the corrector of backward differences only",
            "CORRECTOR": "as with GSTIFF",
            "SCALE": "-its coordinates have one tolerance",
            "ALPHA": "-it belongs to HHT",
            "BETA": "-it belongs to NEWMARK",
            "GAMMA": "-it belongs to NEWMARK",
        },
    )
)

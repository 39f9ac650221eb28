"""VERLET: the leapfrog formula for point masses that nothing ties together."""

from adamslite.language.method import (
    CONSTRAINTS,
    FIXED_BY_HINIT,
    ROTATIONS,
    STATE_JUMPS,
    Equations,
    Method,
    Settings,
    register,
)

# Bodies up to which rows are a few whole vectors; numbers that processors take at once.
SHORT, LINE = 64, 4


def prepare(system: Equations, settings: Settings) -> None:
    """Room for the numbers of the method, inverse inertias, two states, two vectors."""
    from adamslite.integrators.verlet.control import NUMBERS, Control

    bodies = len(system.model.bodies)
    # Long rows are whole lines of the cache, an odd number: those of 4 KB would share places in it.
    row = 8 * ((bodies + 7) // 8 | 1) if bodies > SHORT else LINE * -(-bodies // LINE)
    system.make_room(control=Control.slots, history=(9 + 3 * 6) * bodies, lane=NUMBERS * row)


NO_CORRECTOR = "-an explicit formula has no corrector"

register(
    Method(
        names=("VERLET",),
        what="the explicit leapfrog formula of order 2 with equal steps from one output time to "
        "the next",
        suited="many point masses without constraints, with ERROR of 1E-4 and above",
        entry="adamslite.integrators.verlet.method.verlet",
        order=2,
        family="leap-frog",
        explicit=True,
        cannot=(CONSTRAINTS, ROTATIONS, STATE_JUMPS),
        tests_velocities=False,
        steps=FIXED_BY_HINIT,
        # Near a pole of a force its equal steps would be so many that the run does not end.
        least_step=1e-8,
        by_component=True,
        pauses=True,
        in_blocks=True,
        prepare=prepare,
        arguments={
            "ERROR": "local error of q, unless HINIT is given",
            "HMAX": "largest step",
            "HMIN": "the run ends when steps have to be smaller",
            "HINIT": "the step, shortened to fit between output times; no error test",
            "KMAX": "-its order is 2",
            "MAXIT": NO_CORRECTOR,
            "PATTERN": NO_CORRECTOR,
            "INTERPOLATE": "-its equal steps end at output times",
            "ADAPTIVITY": NO_CORRECTOR,
            "CORRECTOR": NO_CORRECTOR,
            "SCALE": "-its coordinates have one tolerance",
            "ALPHA": "-it belongs to HHT",
            "BETA": "-it belongs to NEWMARK",
            "GAMMA": "-it belongs to NEWMARK",
        },
    )
)

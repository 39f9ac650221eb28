"""SIMULATE: run an analysis from the present time t0.

Equation (output times)::

    t0 + k (END - t0) / STEPS,   k = 0 ... STEPS

with ``END = t0 + DURATION``; for DTOUT ``t0 + k DTOUT`` up to END, and END itself.
"""

from __future__ import annotations

from adamslite.language.statement import Statement, choice, integer, number, statement

STEPS = 100
# A table of the time alone would take gigabytes with more rows.
MOST_STEPS = 10**8


@statement("SIMULATE", singleton=True, repeatable=True, place="both")
class Simulate(Statement):
    """What to simulate, for how long and how often to write.

    Belongs in a command file or, as an extension, in the deck.  Each SIMULATE continues from the
    time that the previous one reached; END is a time and not a duration.  STATICS without END or
    DURATION finds one equilibrium, with it one at every output time.  INITIAL_CONDITIONS finds
    displacements, velocities and accelerations, and writes them.  KINEMATICS is for models without
    degrees of freedom; where they have states (DIFF, LSE, TFSISO) or MOTIONs that give speeds or
    accelerations it integrates them, as DYNAMICS does.  TRANSIENT is KINEMATICS or DYNAMICS.
    """

    kind: str = choice(
        options=("DYNAMICS", "INITIAL_CONDITIONS", "KINEMATICS", "STATICS", "TRANSIENT"),
        required=True, help="a kind of analysis",
    )  # fmt: skip
    level: str | None = choice(
        options=("DISPLACEMENT", "VELOCITY", "ACCELERATION"),
        inert=True,
        help="last of the INITIAL_CONDITIONS to find",
    )
    end: float | None = number("END", unit="time", help="time at which it ends")
    duration: float | None = number("DURATION", unit="time", help="time it lasts")
    dtout: float | None = number("DTOUT", unit="time", help="time between outputs")
    steps: int | None = integer("STEPS", help="number of output steps")

    @property
    def at_once(self) -> bool:
        """Whether it takes no time: initial conditions, or a single equilibrium."""
        if self.kind == "STATICS":
            return self.end is None and self.duration is None
        return self.kind == "INITIAL_CONDITIONS"

    def until(self, start: float) -> float:
        """The time at which it ends [time] when it begins at ``start``."""
        if self.at_once:
            return start
        if self.duration is not None:
            return start + self.duration
        assert self.end is not None  # a rule requires one of the two
        return self.end


def output_steps(span: float, steps: int | None, dtout: float | None) -> float:
    """The number of requested output steps over a span of time [time]."""
    return span / dtout if steps is None and dtout else steps or STEPS

"""SIMULATE: run an analysis.

Equation (output times of a dynamic analysis from ``t0``)::

    t0 + k (END - t0) / STEPS,   k = 0 ... STEPS

with ``END = t0 + DURATION`` and ``STEPS = (END - t0) / DTOUT``.
"""

from __future__ import annotations

from adamslite.statement import Statement, choice, integer, number, statement


@statement("SIMULATE", singleton=True, repeatable=True, place="both")
class Simulate(Statement):
    """How long to simulate and how often to write.

    Stands in a command file; as an extension also in the deck itself.
    """

    kind: str = choice(
        options=("DYNAMICS", "INITIAL_CONDITIONS", "KINEMATICS", "STATICS", "TRANSIENT"),
        supported=("DYNAMICS",), required=True, help="a kind of analysis",
    )  # fmt: skip
    end: float | None = number("END", unit="time", help="time at which it ends")
    duration: float | None = number("DURATION", unit="time", help="time it lasts")
    dtout: float | None = number("DTOUT", unit="time", help="time between outputs")
    steps: int | None = integer("STEPS", help="number of output steps")

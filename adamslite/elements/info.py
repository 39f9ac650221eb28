"""INFO: prints how a marker is, how it moves, or the force on it, at the present time.

Values (I relative to J, along the axes of RM; J and RM are the ground where they are omitted)::

    DISPLACEMENT   DX   DY   DZ   DM     PSI  THETA PHI
    VELOCITY       VX   VY   VZ   VM     WX   WY   WZ   WM
    ACCELERATION   ACCX ACCY ACCZ ACCM   WDTX WDTY WDTZ WDTM
    FORCE          FX   FY   FZ   FM     TX   TY   TZ   TM     on I, of the elements between I and J
"""

from __future__ import annotations

from adamslite.language.statement import Statement, choice, reference, statement


@statement("INFO", singleton=True, repeatable=True, place="command")
class Info(Statement):
    """The summary of the run and the comments of its results have the values."""

    kind: str = choice(
        options=("DISPLACEMENT", "VELOCITY", "ACCELERATION", "FORCE"), required=True,
        help="what is printed",
    )  # fmt: skip
    i: int | str = reference("I", to="MARKER", required=True, help="marker that is measured")
    j: int | str = reference("J", to="MARKER", default=0, help="marker it is measured from")
    rm: int | str = reference("RM", to="MARKER", default=0, help="marker whose axes are used")

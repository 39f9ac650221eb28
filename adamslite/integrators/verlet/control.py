"""What VERLET remembers from one interval to the next."""

from __future__ import annotations

from adamslite.native.translate import Record


class Control(Record):
    """The numbers of VERLET.

    limit                the longest step that is stable, with a margin
    wanted               the step to try in the next interval
    since                steps since the look at the eigenvalues
    spent                sum of the errors of the present try, against ERROR
    row                  the next row of the record
    fixed                whether the step is given by HINIT
    """

    limit: float
    wanted: float
    since: int
    spent: float
    row: int
    fixed: bool

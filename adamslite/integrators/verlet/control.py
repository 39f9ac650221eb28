"""What VERLET remembers from one interval to the next."""

from __future__ import annotations

from adamslite.native.translate import Record

# By component, of a body: place, velocity, force, acceleration before, each of three, and 1/m.
NUMBERS = 13


class Control(Record):
    """The numbers of VERLET.

    limit                the longest step that is stable, with a margin
    longest              the longest stable step of any look
    wanted               the step to try in the next interval
    tried                the step to try in this one, after others were too long; zero before that
    blown                how many of these have ended in numbers without bound
    since                steps since the look at the eigenvalues
    spent                sum of the errors of the present try, against ERROR
    top, mean            the largest local error of the present try, and the mean of all
    row                  the next row of the record
    step, looks          the next step of the present try where it was left to be continued (0: it
                         was not), and steps until accelerations are kept
    fixed                whether the step is given by HINIT
    """

    limit: float
    longest: float
    wanted: float
    tried: float
    since: int
    spent: float
    top: float
    mean: float
    blown: int
    row: int
    fixed: bool
    step: int
    looks: int

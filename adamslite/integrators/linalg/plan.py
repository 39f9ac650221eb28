"""The plan of a block elimination: its blocks, and their order."""

from adamslite.native.translate import Ints, Record, Rows

# Keeps a quotient finite; a size from HUGE on is no number to continue with.
TINY, HUGE = 1e-300, 1e300


# What is asked of elimination by fronts; REAL and COMPLEX number its code in ``Plan.code``.
FACTOR, SOLVE, SIGNATURE = range(3)
REAL, COMPLEX = range(2)


class Front(Record):
    """Unknowns that are eliminated together (:mod:`adamslite.integrators.linalg.fronts`).

    ``size start``: how many and the first in the order of elimination; ``rest``: unknowns behind
    that are coupled to them, in the runs from ``first_run`` to ``last_run``; ``panel lower``: where
    its rows and the columns below them are in the factors; ``before``: the first front of its
    subtree; ``keep``: where it leaves what is added to its parent.
    """

    size: int
    start: int
    rest: int
    panel: int
    lower: int
    first_run: int
    last_run: int
    before: int
    keep: int


class Run(Record):
    """Neighbours among the unknowns of a front: the first in the order of elimination, how many,
    and the first in the front of the parent.
    """

    at: int
    count: int
    to: int


class Plan(Record):
    """The order of elimination (:mod:`adamslite.equations.elimination_order`).

    With ``fronts``, those and their ``runs`` replace the blocks; ``code``: its addresses.
    """

    size: Ints
    start: Ints
    diagonal: Ints
    first: Ints
    node: Ints
    lower: Ints
    upper: Ints
    target: Ints
    place: Ints
    fronts: Rows[Front]
    runs: Rows[Run]
    code: Ints

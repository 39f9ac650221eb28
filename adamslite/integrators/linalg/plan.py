"""The plan of a block elimination: its blocks, and their order."""

from adamslite.native.translate import Ints, Record

# Keeps a quotient finite; a size from HUGE on is no number to continue with.
TINY, HUGE = 1e-300, 1e300


class Plan(Record):
    """The order of elimination (:mod:`adamslite.equations.elimination_order`)."""

    size: Ints
    start: Ints
    diagonal: Ints
    first: Ints
    node: Ints
    lower: Ints
    upper: Ints
    target: Ints
    place: Ints

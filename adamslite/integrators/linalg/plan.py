"""The plan of a block elimination: its blocks, and their order."""

from adamslite.native.translate import Ints, Record


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


TINY = 1e-300

"""What goes with a run: balance of energy, tape, rows, a state to return to, what it may spend."""

from __future__ import annotations

from adamslite.native.translate import Ints, Reals, Record, array

# The head of a row of the tape: time, size and order of the step that ends there, what it is,
# restarts so far.
TAPE_TIME, TAPE_STEP, TAPE_ORDER, TAPE_KIND, TAPE_RESTARTS, TAPE_HEAD = range(6)
# What a row is: the start, the end of a step, the state behind an event.
AT_START, AT_STEP, AT_EVENT = 0.0, 1.0, 2.0


class EnergyBalance(Record):
    """The balance at an accepted state, and what explains its gap.

    t, span                 time of the state; size of the present step
    kinetic, stored         energies of the state; momenta (6,) of all bodies, linear and angular,
                            those at the start
    forces, size            largest sum of squares of weighted loads in the step; what an error of 1
                            in every component does to the energy, with those loads
    budget                  panels that the step may still be divided into
    gap, worst, worst_at    of the balance: now, the largest, when that was
    squares, quadrature     what explains a gap: errors of the steps, of the panels
    largest                 the largest energy
    created ...             what elastic elements delivered and stored, the least and the most
    missed                  points without accelerations
    push, turn              squares of what an error of 1 does to both momenta; their sums
    external                the share of loads that does not add up to nothing
    """

    t: float
    span: float
    kinetic: float
    stored: Reals = array(1)
    forces: float
    size: float
    budget: int
    gap: float
    worst: float
    worst_at: float
    squares: float
    quadrature: float
    largest: float
    created: float
    least_created: float
    most_created: float
    created_at: float
    missed: int
    drift: float
    spin_drift: float
    push: float
    turn: float
    pushes: float
    turns: float
    external: float
    momenta: Reals = array(6)
    first_momenta: Reals = array(6)


class Audit(Record):
    """A balance with what it needs.

    on                   whether the run is audited
    solved, elastic      whether loads depend on what has to be solved for; elements store energy
    now, before          the balance, and the one to which steps may be taken back
    previous, present    (W.size,) workspaces at both ends of the step; ``previous_before``
    curve                (6 n,) coefficients of every unknown of a body
    vectors              (2 n + m + nv + 2 ns,) u, a, z, s'
    points               values at the points of a panel, rows of guards
    moving               (m,) 1 for each constraint row that moves
    matrix, pivots       what integrators continue with: acceleration matrix, its row order
    """

    on: bool
    solved: bool
    elastic: bool
    now: EnergyBalance
    before: EnergyBalance
    previous: Reals
    previous_before: Reals
    present: Reals
    curve: Reals
    vectors: Reals
    points: Reals
    moving: Reals
    matrix: Reals
    pivots: Ints


POINTS, ROWS_OF_GUARDS = 10, 7


class Tape(Record):
    """Rows of ``width`` numbers: the head, the workspace, ``base`` (9 nb,) and of the history the
    first ``kept`` numbers and the first ``more`` from ``further`` on; ``rows``: how many there are,
    ``full``: there was no room for more.

    ``width`` 0: nothing is kept.
    """

    width: int
    rows: int
    kept: int
    further: int
    more: int
    full: bool
    data: Reals


class Budget(Record):
    """What a run may spend, and how it stands.

    ``most``: accepted steps after which it ends (0: no matter how many); ``short``: a step below
    this is no progress [time]; ``crept``: by how many the latest steps are more than steps of that
    length in the time that they took; ``patience``: as many are no reason to end it; ``halved
    covered longest growing``: of those that were no progress the latest, the time that they took,
    the longest mean step of half as many as the patience, whether it was that of the last ones;
    ``seen t``: how many steps were looked at, and where the last of them ended; ``events failures
    rejected``: counts when the first of those that are too many was taken.
    """

    most: int
    short: float
    crept: float
    patience: int
    halved: int
    covered: float
    longest: float
    growing: bool
    seen: int
    t: float
    events: int
    failures: int
    rejected: int


class Block(Record):
    """The rows that ``P.record`` has room for: the number of the ``first``, and how many.

    ``row``: the next one where the method has returned; ``hold``: return ``HELD`` as soon as
    nothing but the arrays says how to go on, also from outside.
    """

    first: int
    room: int
    row: int
    hold: bool


class Undoing(Record):
    """What is known of the state that is kept (:mod:`adamslite.integrators.step_back`).

    Whether one is, how often it was returned to, the time behind which the trouble is over, the
    angle turned since, tries in vain, and how many of them there were when it was kept.
    """

    undoable: bool
    backs: int
    passed: float
    turned: float
    trouble: float
    trouble_then: float

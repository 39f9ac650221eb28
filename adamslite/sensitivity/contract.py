"""What native code needs to differentiate a run: its data as records.

np numbers; w = 2 n + ns: of each the derivatives of places and turns (n,), of velocities (n,) and
of states of DIFF (ns,).  A turn is a vector in ground axes, dR = [theta] R.
"""

from __future__ import annotations

from adamslite.native.translate import Ints, Reals, Record, Rows


class TangentGroup(Record):
    """Addresses of the tangents of a group of kernels: of its residual, and of its guards of the
    clock and of the state (0: none); how many integers and reals an instance has.
    """

    residual: int
    clock: int
    watch: int
    of_ints: int
    of_reals: int


class Piece(Record):
    """What a number does to the reals of some instances of a group: the first of them, how many,
    and the address of their derivatives.
    """

    group: int
    first: int
    count: int
    reals: int


class Tangents(Record):
    """Derivatives of the equations by np numbers.

    count                np
    group                of each group of kernels
    piece, piece_at      the pieces of number j are piece_at[j] .. piece_at[j + 1]
    signals              (np,) whether VARIABLEs of TIME hang on a number
    mass inertia gravity (np nb,), (9 np nb,), (3 np,): derivatives of those of ``Problem``
    none, nothing        a workspace of zeros; the address of as many as a group has reals
    dW                   the workspace's derivative
    top, out             (np,) the largest that acts in the plane of the run, and out of it
    """

    count: int
    group: Rows[TangentGroup]
    piece: Rows[Piece]
    piece_at: Ints
    signals: Ints
    mass: Reals
    inertia: Reals
    gravity: Reals
    none: Reals
    nothing: int
    dW: Reals
    top: Reals
    out: Reals


class Forward(Record):
    """Sensitivities along the tape of a run.

    width, room          w, and numbers of a history
    history              (np, room) backward differences of the sensitivities
    y                    (np, 2 w) sensitivities ahead of a start, their rates
    start                (np, 3 w) first to third derivatives of the sensitivities
    state                (6 w,) the same of the run: rates, second, third; y, rates, workspace
    a, z, sd             derivatives of accelerations, of multipliers and variables, of rates
    guard                (W.size,) derivatives of guards; ``rate``: by the time
    jump                 (n + ns,) accelerations and rates of states behind an event
    speed, kind          of each guard: by the time, whether it leads an event or follows
    shift                (np, guards) derivatives of the times at which guards change
    last, last_t         (np + 1,) derivatives of the time of the last event, its largest jump; that
                         time
    several, coupled     events at one time that a number moves apart, and states that are reset;
                         events whose order matters
    record               (np, nt, nw + n_out) derivatives of the record
    row                  the next row of the record
    h, order             of the last step
    stages               (3 W.size,) workspaces of the stages of a step
    floor                (np,) increments of places that are round-off
    age, factored        steps since matrices were made; the step, or the cu, that they are for
    exact                whether every step has a matrix of its own
    inverted             whether the matrix in place is the inverse
    limit, slope         what iterations may leave, as a share of sensitivities; (2 np,) rates of
                         first and of further iterations over the squared age of a matrix
    matrices             how many were made
    extra, spare, first  iterations beyond one for each number: in the last step, since the matrix
                         was made, in the first step with an old one
    kept, oldest         (np, KEPT, m + nv) multipliers and variables of the last steps; which row
    when, known, share   (KEPT,) times of these rows, how many there are, shares in a later one
    v, mu                increments of places; corrections of velocities
    spent, top           (2 np,) of places and velocities: sums of estimated errors, the largest
    grazed               events whose time has no derivative
    """

    width: int
    room: int
    history: Reals
    y: Reals
    start: Reals
    state: Reals
    a: Reals
    z: Reals
    sd: Reals
    guard: Reals
    rate: Reals
    jump: Reals
    speed: Reals
    kind: Reals
    shift: Reals
    last: Reals
    last_t: float
    several: int
    coupled: int
    record: Reals
    stages: Reals
    row: int
    h: float
    order: int
    floor: Reals
    age: int
    factored: float
    exact: bool
    inverted: bool
    limit: float
    slope: Reals
    matrices: int
    extra: int
    spare: int
    first: float
    kept: Reals
    oldest: int
    when: Reals
    known: int
    share: Reals
    v: Reals
    mu: Reals
    spent: Reals
    top: Reals
    grazed: int

"""The contract between a model and an integrator: the data they share.

An integrator is native code that

1. sees the model only through :mod:`adamslite.integrators.motion_equations` (residual, Jacobian,
workspace);
2. advances from the present time to the end time and writes a record at every output time;
3. accepts a step only when Newton converged and the error test passed;
4. never steps through a singular acceleration matrix, and never returns a state it did not
converge to;
5. ends a step at every stop and after every crossing and restarts there, as
:mod:`adamslite.integrators.events.events` says;
6. counts what it does in ``P.count``;
7. leaves the last accepted state behind, whatever the outcome;
8. returns an outcome, one of ``DONE`` to ``CREEPING``, and keeps within ``P.budget``;
9. where it declares so, pauses after ``settings.pause`` tries of a step, to be called again;
10. where it declares so, returns ``FULL`` when ``P.record`` has no room for the next row, ``HELD``
when ``P.block`` asks for it, to be called again: where and how often changes no number.

Fields of :class:`Problem`; arrays have one dimension; nb bodies, n body unknowns, m multipliers, nv
variables, ns states of DIFF, nw workspace entries:

==============  =================================================================================
sizes settings  :class:`Sizes`, :class:`RunSettings`
count report    :class:`Counts`, :class:`Report`
search          the location of events (:class:`Search`);  undoing: :class:`Undoing`
body            (nb,) of :class:`BodyRow`
mass inertia    (nb,) [mass]; (9 nb,) about the mass centre in part axes
weight          (nb,) of rotations in W G^T mu
mobility ease   (n,) 1/m, 1/least inertia, 0 without; what a residual of 1 may change in a step
gravity         (3,) in ground axes
base            (9 nb,) attitude from which the rotation vector is counted
scalar          workspace offset of each multiplier, variable and DIFF state
group           (ng,) of :class:`KernelGroup`
copies          per block: Jacobian offset, rows, columns, factor offset, leading dimension
product         per block between bodies: Jacobian offset, rows, columns, first row, first column
turning         per block with a rotating column: Jacobian offset, rows, body, live columns (bits)
mixed           per product D W G^T: target, its lead, columns, D, rows, width, G, body
unit            places of the diagonal of mu, one in the acceleration matrix
dead            unknowns left out of the matrix, whose equations are not solved
held loose      those among them that hold a model in its plane, and what they may be off by
times           (nt,) output times
q u a           (n,) positions and rotation vectors, velocities, accelerations
z mu            (m + nv + ns,) multipliers, variables, states; multipliers of velocity rows
ra rz rd pz     accepted accelerations and z, derivatives of the states, z one step earlier
W F             workspace, residual
J D LV LA       Jacobian blocks (all, of velocities); factors (Newton, acceleration)
x work coef     workspace
pivots pivots_a row orders of LV and LA;  pivot0: pivots of the first acceleration matrix
history trial   what the method remembers of accepted states; three vectors (q, u, s)
tableau         coefficients of the Runge-Kutta formula
parts           of the Newton matrix of the Radau formula;  LC pivots_c: its complex factors
control         the integrator's own numbers, its ``Control``
undo            the state before the last accepted one; empty without constraints
record          (room + 1, nw + n_out) workspace and outputs at output times
kind guard      of guards: how they are read; their values, numbered as the workspace
sensors         of :class:`SensorRow`
margin zone     how far guards are from changing; where the state is within zones
reach           how far steps may go in tables (:mod:`adamslite.symbolic.interpolant`)
stops           times at which guards of the clock change
paces           of :class:`Pace`
lane_runs lane  of :class:`LaneRun`: loads that are evaluated by component; numbers of the bodies
                for that, in rows of equal length;  lane_bodies: those with other loads
block           the rows that ``record`` has room for (:class:`Block`)
audit           balance of energy (:class:`Audit`);  uncounted: counts before it was drawn up
tape budget     accepted states of the run (:class:`Tape`); what it may spend (:class:`Budget`)
pattern         per iteration whether it renews the Newton matrix, repeated; empty: as needed
==============  =================================================================================
"""

from __future__ import annotations

from adamslite.integrators.audit_record import Audit, Block, Budget, Tape, Undoing
from adamslite.integrators.event_rows import Search, SensorRow
from adamslite.native.translate import Ints, Reals, Record, Rows

# What the groups of kernels contribute, one bit each.
(
    LOADS,
    REACTIONS,
    POSITION_ROWS,
    VELOCITY_ROWS,
    RATE_ROWS,
    ACCELERATION_ROWS,
    ROWS,
    SIGNALS,
    OUTPUTS,
    STORED_ENERGY,
    ELASTIC,
    ADDED_MASS,
    BY_COMPONENT,
) = (1 << k for k in range(13))
INDEX3 = LOADS | REACTIONS | POSITION_ROWS | RATE_ROWS | ROWS
STABILISED = INDEX3 | VELOCITY_ROWS
STATIC = LOADS | REACTIONS | POSITION_ROWS | ROWS
ACCELERATION = LOADS | REACTIONS | ACCELERATION_ROWS | ROWS

# Coefficients of a Jacobian: of its derivatives by q, u, a, (lam, V) and s'.
COEFFICIENTS = 5
# Steps below this share of the run are round-off of the time.
LEAST_STEP = 1e-14
# The one pace of a run whose steps are not held back.
NO_PACE = (-1e300, 1e300, 1e300)
# Share of the limit of stability that equal steps of VERLET may take: the power iteration comes to
# the eigenvalue from below.
STABLE = 0.93
# A state of DIFF in the workspace: its value, its rate, the value from which it counts.
STATE_SIZE, STATE_ORIGIN = 3, 2
MODE_DYNAMICS = 4.0
# Numbers of the integrator in the workspace: size and order of the step, Jacobians, residuals.
STEP_AT, ORDER_AT, JACOBIANS_AT, RESIDUALS_AT = 2, 3, 4, 5
MODE_STATICS = 5.0

(
    DONE,
    STEP_TOO_SMALL,
    NEWTON_FAILED,
    SINGULAR_MASS,
    NOT_FINITE,
    BROKEN_START,
    INTERRUPTED,
    NOT_SETTLED,
    UNSTABLE,
    CHATTERING,
    PAUSED,
    STEP_LIMIT,
    CREEPING,
    FULL,
    HELD,
) = range(15)

# What is done to equations besides integration: see adamslite.equations.operations.
(
    RESIDUAL,
    JACOBIAN,
    ACCELERATIONS,
    EQUILIBRIUM,
    RECORD,
    SPECTRUM,
    CLOCK,
    AUDIT,
    RECORD_AT_REST,
    RESIDUAL_AT_REST,
    FACTOR,
    SOLVE,
) = range(12)


class Sizes(Record):
    """How many of what a model has.

    ``si2``: the stabilised form; ``implicit_mass``: loads depend on accelerations, as
    ``added_mass`` linearly on those of their own body alone, ``along_axes`` each component on its
    own; ``n_head``: entries of the workspace before those of bodies.
    """

    nb: int
    n: int
    m: int
    nv: int
    ns: int
    nw: int
    ng: int
    si2: bool
    implicit_mass: bool
    added_mass: bool
    along_axes: bool
    n_out: int
    nz: int
    holonomic: int
    n_head: int
    clocks: int
    watched: int
    zones: int


class RunSettings(Record):
    """The settings of a run; ``stop`` ends it, also from outside.

    ``pause``: tries of a step after which a run that can be resumed is ``PAUSED`` (0: none);
    ``begun``: it is resumed.
    """

    t: float
    t_end: float
    error: float
    h_max: float
    h_min: float
    h_init: float
    k_max: int
    max_it: int
    stop: bool
    alpha: float
    beta: float
    gamma: float
    interpolate: bool
    fixed_step: float
    adaptivity: float
    all_converge: bool
    pause: int
    begun: bool


class Report(Record):
    """What a run leaves to be read.

    ``t h order``: of the present try; ``violation``: the largest of a constraint; ``error``: the
    last estimate over ERROR, ``where`` it is largest; ``iteration changed change open_row
    open_by``: of a corrector that failed; ``torn``: a redundant row that opened; ``vibrating
    vibration``: what capped the order, its rate; ``spent``: sum of errors; ``divided``: fixed steps
    that were; ``stable_step``: the longest for equal steps; ``moved``: by a projection; ``stiffness
    damping``: spectral radii of M^-1 K, M^-1 C; ``floor``: the largest accepted error that is
    round-off.
    """

    t: float
    h: float
    order: int
    violation: float
    where: int
    error: float
    order_capped: bool
    vibrating: int
    vibration: float
    ways_to_fall: int
    rough_steps: int
    iteration: int
    changed: int
    change: float
    open_row: int
    open_by: float
    left_plane: bool
    torn: int
    spent: float
    divided: int
    stable_step: float
    moved: float
    stiffness: float
    damping: float
    floor: float


class Counts(Record):
    """How often a run did what; ``tries`` of steps are all of them, those that end at a crossing of
    a branch and are taken again as well.
    """

    steps: int
    rejected: int
    newton: int
    jacobians: int
    factorizations: int
    residuals: int
    failures: int
    records: int
    events: int
    restarts: int
    tries: int

    def add(self, other: Counts) -> None:
        """Count what another run did, too."""
        self._ints += other._ints


class BodyRow(Record):
    """A body: 3 or 6 unknowns, the first of them, its workspace, its block of the Jacobian."""

    width: int
    first: int
    at: int
    block: int


class KernelGroup(Record):
    """Instances of one kernel: in which phases it works, addresses of its functions (0: none), how
    many instances there are, addresses of their integers and reals.
    """

    phases: int
    residual: int
    jacobian: int
    track: int
    count: int
    ints: int
    reals: int
    clock: int
    watch: int


class LaneRun(Record):
    """A run of instances for :mod:`adamslite.kernels.code.lane_writer`: the function, that of added
    mass (0: none), how many, addresses of the integers of the run and of the reals of the shape
    from the first instance on, how many instances the shape has.
    """

    function: int
    mass: int
    count: int
    ints: int
    reals: int
    of: int


class Pace(Record):
    """How long steps may be from a time on, and the time that no step of this pace may pass because
    steps must be shorter behind it.
    """

    since: float
    longest: float
    fence: float


class Problem(Record):
    """The data of a model, as above."""

    sizes: Sizes
    body: Rows[BodyRow]
    mass: Reals
    inertia: Reals
    weight: Reals
    mobility: Reals
    ease: Reals
    gravity: Reals
    base: Reals
    scalar: Ints
    group: Rows[KernelGroup]
    copies: Ints
    product: Ints
    turning: Ints
    mixed: Ints
    unit: Ints
    dead: Ints
    held: Ints
    loose: Reals
    settings: RunSettings
    count: Counts
    times: Reals
    report: Report
    q: Reals
    u: Reals
    a: Reals
    z: Reals
    mu: Reals
    ra: Reals
    rz: Reals
    rd: Reals
    W: Reals
    F: Reals
    J: Reals
    D: Reals
    LV: Reals
    LA: Reals
    x: Reals
    work: Reals
    coef: Reals
    pivots: Ints
    pivots_a: Ints
    pivot0: Reals
    history: Reals
    trial: Reals
    tableau: Reals
    control: Reals
    pz: Reals
    undo: Reals
    record: Reals
    parts: Reals
    LC: Reals
    pivots_c: Ints
    kind: Ints
    guard: Reals
    sensors: Rows[SensorRow]
    margin: Reals
    zone: Reals
    reach: Reals
    stops: Reals
    paces: Rows[Pace]
    search: Search
    undoing: Undoing
    pattern: Ints
    audit: Audit
    uncounted: Counts
    lane_runs: Rows[LaneRun]
    lane: Reals
    lane_bodies: Ints
    tape: Tape
    budget: Budget
    block: Block


# Least length of ``P.work``.
WORK = 54

"""The contract between a model and an integrator: the data they share.

An integrator is native code that

1. sees the model only through :mod:`adamslite.integrators.motion_equations` (residual, Jacobian,
workspace);
2. advances from the present time to the end time and writes a record at every asked time;
3. accepts a step only when Newton converged and the error test passed;
4. never steps through a singular acceleration matrix, and never returns a state it did not
converge to;
5. ends a step at every stop and behind every crossing and starts anew there, as
:mod:`adamslite.integrators.events.events` says;
6. counts what it does in ``P.count`` (names in ``COUNTS``);
7. leaves the last accepted state behind, whatever the outcome;
8. returns one of ``OUTCOMES``.

Fields of :class:`Problem`, all one-dimensional; nb bodies, n body unknowns, m multipliers, nv
variables, ns states of DIFF, nw workspace entries:

==============  =================================================================================
sizes           ``SIZES``
body            per body: kind (3 or 6), first unknown, workspace offset, its own block, spare
mass            (nb,) [mass]
inertia         (9 nb,) about the mass centre in part axes
weight          (nb,) of rotations in W G^T mu
gravity         (3,) in ground axes
base            (9 nb,) attitude from which the rotation vector is counted
scalar          workspace offset of each multiplier, variable and DIFF state
group           per group: phase, addresses of residual, Jacobian and track, number of instances,
                addresses of their integers and reals, addresses of clock and watch
copies          per block: Jacobian offset, rows, columns, factor offset, leading dimension
product         per block between bodies: Jacobian offset, rows, columns, first row, first column
turning         per block with a rotating column: Jacobian offset, rows, body
mixed           per product D W G^T: target, its width, D, rows, columns, G, body
unit            places of the diagonal of mu, one in the acceleration matrix
dead            unknowns left out of the matrix, whose equations are not solved
held loose      those among them that hold a model in its plane, and what they may be off by
settings        ``SETTINGS``;  count: ``COUNTS``;  report: ``REPORT``;  times (nt,) asked times
                spent: sum of the estimated errors over ERROR; divided: fixed steps that were;
                stable: the longest stable step anywhere, for equal steps; moved: by a projection
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
control         the integrator's own numbers
undo            the state before the last accepted one; empty without constraints
record          (nt, nw + n_out) workspace and outputs at the asked times
kind guard      of guards: how they are read; their values, numbered as the workspace
margin zone     how far guards are from changing; where the state is within zones
stops           times at which guards of the clock change
paces           ``PACE``: how long steps may be from when on
search          the location of events (:mod:`adamslite.integrators.events.events`)
audit           balance of energy (:mod:`adamslite.integrators.audit.balance`); empty without
pattern         per iteration whether it renews the Newton matrix, repeated; empty: as needed
==============  =================================================================================
"""

from adamslite.native.translate import Ints, Reals, Record

SIZES = (
    "nb",
    "n",
    "m",
    "nv",
    "ns",
    "nw",
    "ng",
    "si2",
    "implicit_mass",
    "n_out",
    "nz",
    "holonomic",
    "n_head",
    "clocks",
    "watched",
    "zones",
)
(
    NB, N, M, NV, NS, NW, NG, SI2, IMPLICIT_MASS, N_OUT, NZ, HOLONOMIC, N_HEAD, CLOCKS, WATCHED,
    ZONES,
) = range(len(SIZES))  # fmt: skip

SETTINGS = (
    "t", "t_end", "error", "h_max", "h_min", "h_init", "k_max", "max_it", "stop",
    "alpha", "beta", "gamma", "interpolate", "fixed_step", "adaptivity", "all_converge",
)  # fmt: skip
(
    T, T_END, ERROR, H_MAX, H_MIN, H_INIT, K_MAX, MAX_IT, STOP, ALPHA, BETA, GAMMA, INTERPOLATE,
    FIXED_STEP, ADAPTIVITY, ALL_CONVERGE,
) = range(len(SETTINGS))  # fmt: skip

REPORT = (
    "t", "h", "order", "violation", "where", "size", "capped", "ways_to_fall", "rough",
    "iteration", "changed", "change", "open_row", "open_by", "left_plane", "torn",
    "spent", "divided", "stable", "moved",
)  # fmt: skip
(
    AT, STEP, ORDER, VIOLATION, WHERE, HOW_MUCH, ORDER_CAPPED, WAYS_TO_FALL, ROUGH_STEPS,
    ITERATION, CHANGED, CHANGE, OPEN_ROW, OPEN_BY, LEFT_PLANE, TORN,
    SPENT, DIVIDED, STABLE_STEP, MOVED,
) = range(len(REPORT))  # fmt: skip

COUNTS = (
    "steps",
    "rejected",
    "newton",
    "jacobians",
    "factorizations",
    "residuals",
    "failures",
    "records",
    "events",
    "restarts",
)
(
    STEPS, REJECTED, NEWTON, JACOBIANS, FACTORIZATIONS, RESIDUALS, FAILURES, RECORDS, EVENTS,
    RESTARTS,
) = range(len(COUNTS))  # fmt: skip

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
) = (1 << k for k in range(11))
INDEX3 = LOADS | REACTIONS | POSITION_ROWS | RATE_ROWS | ROWS
STABILISED = INDEX3 | VELOCITY_ROWS
STATIC = LOADS | REACTIONS | POSITION_ROWS | ROWS
ACCELERATION = LOADS | REACTIONS | ACCELERATION_ROWS | ROWS

# A pace: from when on it holds, the longest step, and the time that no step of it may pass because
# steps must be shorter behind it.
SINCE_WHEN, LONGEST, FENCE, PACE = range(4)
NO_PACE = (-1e300, 1e300, 1e300)

# Share of the limit of stability that equal steps of VERLET may take: the power iteration comes to
# the eigenvalue from below.
STABLE = 0.93
MODE_DYNAMICS = 4.0
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
) = range(10)

# Columns of P.group.
GROUP = 9


class Problem(Record):
    """The data of a model, as above."""

    sizes: Ints
    body: Ints
    mass: Reals
    inertia: Reals
    weight: Reals
    gravity: Reals
    base: Reals
    scalar: Ints
    group: Ints
    copies: Ints
    product: Ints
    turning: Ints
    mixed: Ints
    unit: Ints
    dead: Ints
    held: Ints
    loose: Reals
    settings: Reals
    count: Ints
    times: Reals
    report: Reals
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
    margin: Reals
    zone: Reals
    stops: Reals
    paces: Reals
    search: Reals
    pattern: Ints
    audit: Reals


(
    RESIDUAL, JACOBIAN, ACCELERATIONS, EQUILIBRIUM, RECORD, BDF, HHT, RADAU, EXPLICIT, VERLET,
    SPECTRUM, CLOCK, AUDIT,
) = range(13)  # fmt: skip

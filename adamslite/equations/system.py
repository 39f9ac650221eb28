"""The numbered equations of a model: the arrays that native code works on.

Unknowns stand in the order bodies, multipliers (holonomic first), variables, states of DIFF and,
in the stabilised form, multipliers of the velocity rows; every equation has the row of its unknown.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from operator import attrgetter, is_
from typing import TYPE_CHECKING

import numpy as np

from adamslite.equations.elimination import Elimination
from adamslite.equations.engine import engine, ints, reals, room
from adamslite.equations.instances import Instances
from adamslite.equations.lanes import Runs, runs
from adamslite.equations.layout import Layout
from adamslite.equations.numbering import Numbering
from adamslite.errors import NoRoom
from adamslite.integrators import contract
from adamslite.integrators.event_rows import MARGIN_ROWS, SensorRow
from adamslite.integrators.linalg.plan import Plan
from adamslite.model.model import PART
from adamslite.model.scaling import mobilities, rotation_weights
from adamslite.native.translate import Rows

if TYPE_CHECKING:  # few runs need sparse matrices
    from scipy.sparse import csr_array

    from adamslite.elements.sensor import Sensor
    from adamslite.equations.broken_motion import Break
    from adamslite.integrators.audit_record import Audit, Block, Budget, Tape, Undoing
    from adamslite.integrators.event_rows import Search
    from adamslite.kernels.groups import Kernels
    from adamslite.language.statement import Statement
    from adamslite.model.model import NodeKey

# Moves of the assembly below this are round-off.
MOVED = 1e-9


#: Arrays of ``Problem`` that a part of the system keeps, by the part.
KEPT_BY = {
    **dict.fromkeys("scalar kind reach".split(), "numbering"),
    **dict.fromkeys("copies product turning mixed unit dead held loose".split(), "elimination"),
    **dict.fromkeys("LV LA work pivots pivots_a".split(), "elimination"),
}

#: All arrays of ``Problem``, in its order.
OF_PROBLEM = attrgetter(
    *(
        f"{KEPT_BY[name]}.{name}" if name in KEPT_BY else name
        for name in contract.Problem.references
    )
)


class System:
    """Arrays of one model in one formulation, and the operations on them.

    Every field of ``Problem`` is an attribute of that name, here or of one of the parts
    (``KEPT_BY``); arrays may be replaced between runs.

    Attributes
    ----------
    numbering : Numbering
    blocks : JacobianBlocks
    instances : Instances
    elimination : Elimination
    n, m, nv, ns, nz : int
        Unknowns of bodies, constraint rows, VARIABLEs that are solved for, states of DIFF, and all.
    holonomic : int
        Constraint rows of positions; they come first.
    nodes, node_at, starts, widths, w_at, nw, guarded
        As in the numbering.
    """

    sizes: contract.Sizes
    settings: contract.RunSettings
    count: contract.Counts
    uncounted: contract.Counts
    report: contract.Report
    search: Search
    undoing: Undoing
    block: Block
    audit: Audit
    budget: Budget
    tape: Tape
    q: np.ndarray
    u: np.ndarray
    a: np.ndarray
    ra: np.ndarray
    rz: np.ndarray
    z: np.ndarray
    pz: np.ndarray

    def __init__(self, kernels: Kernels, stabilised: bool, pivoting: bool = False) -> None:
        """``pivoting``: eliminate the whole matrix with row pivoting, whatever its size."""
        self.kernels, self.model = kernels, kernels.model
        self.numbering = numbering = Numbering(kernels, stabilised)
        layout = kernels.shared.get(stabilised) or Layout(numbering)
        self.layout, self.blocks = layout, layout.blocks
        self.instances = Instances(numbering, layout)
        self.elimination = Elimination(numbering, layout, pivoting)
        kernels.shared[stabilised] = layout
        self.n, self.m, self.nz = numbering.n, numbering.m, numbering.nz
        self.nv, self.ns, self.holonomic = numbering.nv, numbering.ns, numbering.holonomic
        self.nodes, self.node_at = numbering.nodes, numbering.node_at
        self.starts, self.widths = numbering.starts, numbering.widths
        self.w_at, self.nw, self.guarded = numbering.w_at, numbering.nw, numbering.guarded
        self._allocate()
        self._bodies()
        self._scalars()
        self._tables()
        self._referred: tuple[object, ...] = ()

    def drop(self, rows: list[int]) -> None:
        """Leave out redundant constraint rows (counted from the first multiplier): lam = mu = 0."""
        self.z[rows] = 0.0
        self.elimination.drop(rows)

    @property
    def dof(self) -> int:
        """Degrees of freedom: unknowns of the bodies less independent constraint rows."""
        return self.n - self.m + len(self.elimination.dropped)

    def _allocate(self) -> None:
        n, nz = self.n, self.nz
        rest = self.m + self.nv + self.ns
        self.problem, self.order = contract.Problem.zeros(), Plan.zeros()
        for name in contract.Problem.fields.keys() - set(contract.Problem.references):
            setattr(self, name, getattr(self.problem, name))
        w = 2 * n + self.ns
        for name in ("q", "u", "a", "ra", "ease"):
            setattr(self, name, np.zeros(n + 1))
        for name in ("z", "rz", "pz"):
            setattr(self, name, np.zeros(rest + 1))
        self.rd, self.mu = np.zeros(self.ns + 1), np.zeros(self.holonomic + 1)
        self.group = self.instances.groups
        self.J, self.D = np.zeros(self.blocks.size + 1), np.zeros(self.blocks.size + 1)
        self.W, self.F, self.x = np.zeros(self.nw + 1), np.zeros(nz + 1), np.zeros(nz + 1)
        if self.numbering.kind.size:
            self.W = np.zeros(self.nw + self.numbering.kind.size)
        self.guard = np.zeros(self.W.size)
        self.sensors = Rows(SensorRow, len(self.numbering.sensors))
        for k, (_, first, second) in enumerate(self.numbering.sensors):
            self.sensors[k].first, self.sensors[k].second = first, second
        self.margin = np.zeros(MARGIN_ROWS * len(self.guarded["watch"]))
        self.zone = np.zeros(5 * len(self.guarded["zone"]))
        self.stops, self.pattern = np.zeros(1), ints([])
        self.broken: Break | None = None
        self.hurried: list[Statement] = []
        self.paces = Rows(contract.Pace, np.array(contract.NO_PACE))
        self.pivot0 = np.zeros(nz + 1)
        # What equilibria remember; a method makes the room that it needs.
        self.history = np.zeros(self.q.size + 9 * len(self.model.bodies))
        self.trial = np.zeros(3 * w + 3)
        self.control, self.tableau = np.zeros(0), np.zeros(1)
        self.parts, self.LC, self.pivots_c = np.zeros(1), np.zeros(1), ints([0])
        self.coef = np.zeros(contract.COEFFICIENTS)
        self.times, self.record, self.undo = np.zeros(1), np.zeros(1), np.zeros(0)
        self.lane_runs, self.lane = Rows(contract.LaneRun, 0), np.zeros(0)
        self.lane_bodies = ints([])
        self.lanes: Runs | None = None
        self.gravity = np.asarray(self.model.deck.gravity, dtype=float)

    def _bodies(self) -> None:
        bodies = self.model.bodies
        self.mass = reals([b.mass for b in bodies])
        inertia = reals([b.inertia for b in bodies]).reshape(-1, 3, 3)
        self.inertia = inertia.ravel()
        start = [self.model.start_of(b) for b in range(len(bodies))]
        self.base = reals([attitude for _, attitude in start]).ravel()
        model = self.model
        self.weight = model.once_of_bodies("rotation weights", lambda: rotation_weights(model))
        self.mobility = reals(model.once_of_bodies("mobilities", lambda: mobilities(model)))
        if bodies:
            at = self.places
            self.q[at], self.u[at] = [x for x, _ in start], [b.v for b in bodies]
        for b, body in enumerate(bodies):
            if body.width == PART:
                i = self.starts[b]
                self.u[i + 3 : i + 6] = body.w

    @property
    def held_states(self) -> list[int]:
        """Numbers of the unknowns that statics keep: states of DIFF with STATIC_HOLD."""
        states = enumerate(self.model.deck.of("DIFF"), self.n + self.m + self.nv)
        return [k for k, state in states if state.static_hold]

    @property
    def places(self) -> np.ndarray:
        """Numbers of the unknowns of each body that are its place, (bodies, 3)."""
        starts = self.starts[: len(self.model.bodies)]
        return np.array(starts, dtype=int)[:, None] + np.arange(3)

    def _scalars(self) -> None:
        """Start values of variables that are solved for and of DIFF states: their IC."""
        for k, node in enumerate(n for n in self.nodes if n[0] in ("VARIABLE", "DIFF")):
            ic = self.model.element(*node).ic
            self.z[self.m + k] = ic if node[0] == "VARIABLE" else ic[0]
            if node[0] == "DIFF":
                self.rd[k - self.nv] = ic[1] if len(ic) > 1 else 0.0

    def _tables(self) -> None:
        body = []
        for b in range(len(self.model.bodies)):
            body += [self.widths[b], self.starts[b], self.w_at["BODY", b], self.blocks.offset(b, b)]
        self.body = Rows(contract.BodyRow, ints(body))
        forces = [g for g in self.kernels.groups if g.face in ("loads", "equation")]
        massive = [g.meta for g in forces if g.meta["mass"]]
        added = bool(massive) and all(meta["added_mass"] for meta in massive)
        facts = {
            "nb": len(self.model.bodies), "n": self.n, "m": self.m, "nv": self.nv, "ns": self.ns,
            "nw": self.nw, "ng": self.group.size, "si2": self.numbering.stabilised,
            "implicit_mass": bool(massive), "added_mass": added,
            "along_axes": added and all(meta["along_axes"] for meta in massive),
            "n_out": self.instances.n_out, "nz": self.nz,
            "holonomic": self.holonomic, "n_head": self.numbering.n_head,
            "clocks": len(self.guarded["clock"]), "watched": len(self.guarded["watch"]),
            "zones": len(self.guarded["zone"]),
        }  # fmt: skip
        for name in contract.Sizes.fields:
            setattr(self.sizes, name, facts[name])

    def adopt(self, other: System) -> None:
        """Take over the state of another system of (almost) the same model."""
        if self.kernels is other.kernels:
            self.instances.remember(other.instances.memories())
        else:
            self.instances.take_over(other.instances)
        other.count_states_from_here()
        self.count_states_from_here()
        for node, k in self.node_at.items():
            at = other.node_at.get(self._named(node, other))
            if at is None or other.widths[at] != self.widths[k]:
                continue
            i, j, w = self.starts[k], other.starts[at], self.widths[k]
            if node[0] == "BODY":
                for name in ("q", "u", "a"):
                    getattr(self, name)[i : i + w] = getattr(other, name)[j : j + w]
                b, c = 9 * node[1], 9 * other.nodes[at][1]
                self.base[b : b + 9] = other.base[c : c + 9]
            elif node[0] != "MU":
                self.z[i - self.n : i - self.n + w] = other.z[j - other.n : j - other.n + w]

    def count_states_from_here(self) -> None:
        """States whose origin has moved have it at zero again."""
        for k in range(self.ns):
            n = self.m + self.nv + k
            at = self.numbering.scalar[n] + contract.STATE_ORIGIN
            for values in (self.z, self.rz, self.pz):
                values[n] -= self.W[at]
            self.W[at] = 0.0

    def _named(self, node: NodeKey, other: System) -> NodeKey:
        """The node of another system that is the same statement."""
        if node[0] != "BODY":
            return node
        statement = self.model.bodies[node[1]].statement
        return "BODY", other.model.body_index.get((statement.keyword, statement.key), -1)

    def largest_changes(self) -> list[str]:
        """The five largest moves of bodies from where the deck puts them, as text."""
        bodies = self.model.bodies
        if not bodies:
            return []
        shifts = np.abs(self.q[self.places] - [b.x for b in bodies]).max(axis=1)
        turns = _turns_between(reals([b.attitude for b in bodies]), self.base.reshape(-1, 3, 3))
        moved = []
        for b in np.flatnonzero(np.maximum(shifts, turns) > MOVED).tolist():
            shift, turn = float(shifts[b]), float(turns[b])
            text = f"{bodies[b].statement.label} by {shift:.3g}"
            moved.append(
                (max(shift, turn), text + (f" and {turn:.3g} rad" if turn > MOVED else ""))
            )
        return [text for _, text in sorted(moved, reverse=True)[:5]]

    def changed_speeds(self) -> list[str]:
        """The five largest changes of velocities that the deck gives, as text."""
        changed, bodies = [], self.model.bodies
        given_any = np.any([(each.v, each.w) for each in bodies], axis=(1, 2)) if bodies else []
        for b in np.flatnonzero(given_any).tolist():
            body = bodies[b]
            i, given = self.starts[b], np.concatenate([body.v, body.w])[: self.widths[b]]
            change = float(np.abs(self.u[i : i + self.widths[b]] - given).max())
            size = float(np.abs(given).max())
            if size > 0.0 and change > MOVED * max(1.0, size):
                changed.append((change, f"{body.statement.label} by {change:.3g}"))
        return [text for _, text in sorted(changed, reverse=True)[:5]]

    def dense_jacobian(self) -> np.ndarray:
        """The Jacobian blocks as one matrix (nz, nz)."""
        return self.blocks.dense(self.J)

    def sparse_jacobian(self) -> csr_array:
        """The Jacobian blocks as one sparse matrix (nz, nz)."""
        return self.blocks.sparse(self.J)

    @property
    def triggered(self) -> list[Sensor]:
        """Sensors that ended the last run."""
        found = enumerate(self.numbering.sensors)
        return [sensor for k, (sensor, *_) in found if self.sensors[k].triggered]

    def release_guards(self) -> None:
        """Let every expression take the branch of the moment again."""
        self.W[self.nw :] = 0.0

    def lay_lanes(self) -> None:
        """Have loads evaluated by component where that pays, by a method that does."""
        if self.lanes is None and (found := runs(self.instances)):
            self.lanes, self.lane_runs, self.lane_bodies = found, found.rows, found.bodies
            for k in found.groups:
                self.group[k].phases |= contract.BY_COMPONENT

    @property
    def by_component(self) -> bool:
        """Whether loads are evaluated by component, and no expression is watched for a change."""
        return self.lanes is not None and not (self.guarded["watch"] or self.guarded["zone"])

    def make_room(self, **sizes: int) -> None:
        """Have arrays of at least these sizes; one that is replaced begins with zeros."""
        for name, size in sizes.items():
            part = self._keeper(name)
            present = getattr(part, name)
            if present.size < size:
                setattr(part, name, room(size, present.dtype))

    def _keeper(self, name: str) -> object:
        return getattr(self, KEPT_BY[name]) if name in KEPT_BY else self

    def start_record(self, times: np.ndarray, room: int | None = None) -> None:
        """Make room for records at ``times`` (nt,), all of them or so many at a time (one more
        fits behind them), and forget the counts of earlier runs.

        Raises
        ------
        NoRoom
            When there is not so much room.
        """
        self.times = np.ascontiguousarray(times, dtype=float)
        self.numbering.limit_tables(float(self.settings.error))
        block, row = self.block, self.nw + self.sizes.n_out
        block.first, block.row, block.hold = 0, 0, False
        block.room = len(times) if room is None else min(len(times), room)
        try:
            self.record = np.zeros((block.room + 1) * row + 1)
        except MemoryError:
            size = 8e-9 * block.room * row
            raise NoRoom(
                f"The output of {len(times)} times would take {size:.3g} GB of memory, which are "
                "not there: fewer STEPS, a longer DTOUT."
            ) from None
        if self.m:
            kept = (self.history, self.control, self.base, self.ra, self.rz, self.pz)
            self.undo = np.zeros(sum(each.size for each in kept) + self.ns)
        self.count[:] = 0

    @property
    def rows(self) -> np.ndarray:
        """The records of the present block, (made, nw + n_out): from ``block.first`` on."""
        row = self.nw + self.sizes.n_out
        made = max(0, self.count.records - self.block.first)
        return self.record[: made * row].reshape(made, row)

    def run(self, operation: int, phases: int = 0) -> int:
        """Do an operation of native code on the arrays as they are now; returns an outcome."""
        problem, plan = self.records()
        return engine()(problem.address, plan.address, operation, phases)

    def operation(self, operation: int) -> Callable[[], int]:
        """An operation to be done many times on arrays that are not replaced meanwhile."""
        problem, plan = self.records()
        return partial(engine(), problem.address, plan.address, operation, 0)

    def integrate(self, entry: str) -> int:
        """Let the native code of a method run from the present state; returns an outcome."""
        problem, plan = self.records()
        return engine(entry)(problem.address, plan.address)

    def records(self) -> tuple[contract.Problem, Plan]:
        """The arrays as native code takes them; most often they are those of the last time."""
        arrays, plan = OF_PROBLEM(self), self.elimination.plan
        found = (*arrays, *map(plan.__getitem__, Plan.references))
        if not (self._referred and all(map(is_, found, self._referred))):
            self._referred = found
            self.problem.refer(arrays)
            self.order.refer(found[len(arrays) :])
        return self.problem, self.order


def _turns_between(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Angles (n,) of the rotations from attitudes (n, 3, 3) to others [rad]."""
    spin = b @ a.transpose(0, 2, 1)
    axis = [spin[:, i, j] - spin[:, j, i] for i, j in ((2, 1), (0, 2), (1, 0))]
    return np.arctan2(np.linalg.norm(axis, axis=0), np.trace(spin, axis1=1, axis2=2) - 1.0)

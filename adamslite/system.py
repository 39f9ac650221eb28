"""The numbered equations of a model: the arrays that native code works on.

Unknowns stand in the order bodies, multipliers (holonomic first), variables, states of DIFF and,
in the stabilised form, multipliers of the velocity rows; every equation has the row of its unknown.
"""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from adamslite import native
from adamslite.compiled import Group, Kernels, version_of
from adamslite.integrators import base
from adamslite.model import PART, Body
from adamslite.ordering import analyse
from adamslite.shape import Binding
from adamslite.topology import prerequisites

HEAD = 2
# Moves of the assembly below this are round-off.
MOVED = 1e-9
POINT_SIZE, PART_SIZE = 9, 24
PHASES = {
    "loads": base.LOADS,
    "reactions": base.REACTIONS,
    "position": base.POSITION_ROWS,
    "velocity": base.VELOCITY_ROWS,
    "acceleration": base.ACCELERATION_ROWS,
    "equation": base.ROWS,
    "signal": base.SIGNALS,
    "output": base.OUTPUTS,
}
(
    RESIDUAL, JACOBIAN, ACCELERATIONS, EQUILIBRIUM, RECORD, BDF, HHT, RADAU, EXPLICIT, VERLET,
    SPECTRUM, CLOCK,
) = range(12)  # fmt: skip


def engine(progress: Any = None) -> Any:
    """The native entry ``run(P, L, operation, phases)``; built once per version and processor."""
    if not _engine:
        _engine.append(_load_engine(progress))
    return _engine[0]


_engine: list[Any] = []


def _load_engine(progress: Any) -> Any:
    key = "engine" + native.digest(version_of("integrators", "translate", "lowering"))

    def build() -> bytes:
        if progress is not None:
            progress.say("compiling the integrators, once after installing: takes a few seconds")
        from adamslite.integrators.entry import engine_text

        return native.object_code(engine_text())

    address = native.addresses([(native.recall(key, ".o", build), ["run"])])["run"]
    pointer, integer = ctypes.c_void_p, ctypes.c_int64
    return ctypes.CFUNCTYPE(integer, pointer, pointer, integer, integer)(address)


class System:
    """Arrays of one model in one formulation, and the operations on them.

    Every field of ``Problem`` is an attribute of that name.
    """

    def __init__(self, kernels: Kernels, stabilised: bool, pivoting: bool = False) -> None:
        """``pivoting``: eliminate the whole matrix with row pivoting, whatever its size."""
        self.pivoting = pivoting
        self.kernels = kernels
        self.model = kernels.model
        self.stabilised = stabilised
        self._number()
        self._allocate()
        self._bodies()
        self._scalars()
        self._groups()
        self._elimination()
        self._tables()
        self.drop([])

    @property
    def dof(self) -> int:
        """Degrees of freedom: unknowns of the bodies less independent constraint rows."""
        return self.n - self.m + len(self.dropped)

    def drop(self, rows: list[int]) -> None:
        """Leave out redundant constraint rows (counted from the first multiplier): lam = mu = 0."""
        self.dropped = rows
        self.z[rows] = 0.0
        dead = [self.n + r for r in rows]
        if self.stabilised:
            dead += [self.nz - self.holonomic + r for r in rows if r < self.holonomic]
        self.dead = _ints(dead)
        cut: list[int] = []
        for (row, column), (at, lead) in self.places.items():
            inside = range(self.widths[row]), range(self.widths[column])
            r0, c0 = self.starts[row], self.starts[column]
            for d in dead:
                if d - r0 in inside[0]:
                    cut += [at + (d - r0) * lead + c for c in inside[1]]
                if d - c0 in inside[1]:
                    cut += [at + r * lead + d - c0 for r in inside[0]]
        self.cut = _ints(cut)
        self.ones = _ints([self._diagonal(d) for d in dead])

    def _diagonal(self, unknown: int) -> int:
        """Place of a diagonal entry in the factor arrays."""
        node = max(k for k, start in enumerate(self.starts) if start <= unknown)
        at, lead = self.places[node, node]
        return at + (unknown - self.starts[node]) * (lead + 1)

    def _number(self) -> None:
        """Nodes, first unknowns and workspace offsets."""
        model = self.model
        self.nodes: list[tuple[str, Any]] = [("BODY", b) for b in range(len(model.bodies))]
        self.widths = [body.width for body in model.bodies]
        self.n = sum(self.widths)
        constraints = [(c.keyword, c.key) for c in model.constraints]
        loops = [v for v in model.deck.of("VARIABLE") if model.variable_kind(v.key) == "loop"]
        states = model.deck.of("DIFF")
        scalars = constraints + [("VARIABLE", v.key) for v in loops]
        scalars += [("DIFF", d.key) for d in states]
        self.nodes += scalars
        self.widths += [model.node_width(node) for node in scalars]
        self.m = sum(c.n_rows for c in model.constraints)
        self.nv, self.ns = len(loops), len(states)
        self.holonomic = sum(c.n_rows for c in model.constraints if not c.is_rate(model))
        if self.stabilised:
            with_mu = [c for c in model.constraints if not c.is_rate(model)]
            self.nodes += [("MU", (c.keyword, c.key)) for c in with_mu]
            self.widths += [c.n_rows for c in with_mu]
        self.starts = np.concatenate([[0], np.cumsum(self.widths)]).astype(int)[:-1].tolist()
        self.nz = sum(self.widths)
        self.node_at = {node: k for k, node in enumerate(self.nodes)}
        self._workspace(scalars)

    def _workspace(self, scalars: list[tuple[str, Any]]) -> None:
        model = self.model
        at = HEAD
        self.w_at: dict[Any, int] = {}
        for variable in model.deck.of("VARIABLE"):
            if model.variable_kind(variable.key) == "signal":
                self.w_at["SIGNAL", variable.key] = at
                at += 3
        self.n_head = at
        for b, body in enumerate(model.bodies):
            self.w_at["BODY", b] = at
            at += PART_SIZE if body.width == PART else POINT_SIZE
        offsets = []
        for node in scalars:
            self.w_at[node] = at
            width = model.node_width(node)
            offsets += range(at, at + width)
            at += 2 if node[0] == "DIFF" else width
        self.nw = at
        self.scalar = _ints(offsets)
        self._branches()

    def _branches(self) -> None:
        """Guards of all instances; their branches stand behind the workspace."""
        self.guarded: dict[str, list[tuple[Any, int]]] = {"clock": [], "watch": []}
        self.first_branch: dict[tuple[str, str], int] = {}
        at = self.nw
        for place, found in self.guarded.items():
            for group in self.kernels.groups:
                self.first_branch[place, group.name] = at + len(found)
                for statement, _ in group.instances:
                    found += [(statement, kind) for kind in group.meta["guards"][place]]
            at += len(found)
        self.kind = _ints([kind for found in self.guarded.values() for _, kind in found])

    def _allocate(self) -> None:
        n, nz = self.n, self.nz
        rest = self.m + self.nv + self.ns
        w = 2 * n + self.ns
        for name in ("q", "u", "a", "ra"):
            setattr(self, name, np.zeros(n + 1))
        for name in ("z", "rz", "pz"):
            setattr(self, name, np.zeros(rest + 1))
        self.rd, self.mu = np.zeros(self.ns + 1), np.zeros(self.holonomic + 1)
        self.W, self.F, self.x = np.zeros(self.nw + 1), np.zeros(nz + 1), np.zeros(nz + 1)
        if self.kind.size:
            self.W = np.zeros(self.nw + self.kind.size)
        self.guard = np.zeros(self.W.size)
        self.margin = np.zeros(9 * len(self.guarded["watch"]))
        self.stops, self.search = np.zeros(1), np.zeros(19)
        self.pivot0 = np.zeros(nz + 1)
        self.history, self.trial = np.zeros(8 * w + 160), np.zeros(3 * w + 3)
        self.control, self.tableau = np.zeros(48), np.zeros(1)
        self.parts, self.LC, self.pivots_c = np.zeros(1), np.zeros(1), _ints([0])
        self.coef, self.report = np.zeros(16), np.zeros(len(base.REPORT))
        self.settings, self.count = np.zeros(len(base.SETTINGS)), _ints([0] * len(base.COUNTS))
        self.times, self.record, self.undo = np.zeros(1), np.zeros(1), np.zeros(0)
        self.gravity = np.asarray(self.model.deck.gravity, dtype=float)

    def _bodies(self) -> None:
        bodies = self.model.bodies
        self.mass = _reals([b.mass for b in bodies])
        self.inertia = _reals([v for b in bodies for v in b.inertia.ravel()])
        self.base = _reals([v for b in bodies for v in b.attitude.ravel()])
        self.weight = _reals([_rotation_weight(b) for b in bodies])
        for b, body in enumerate(bodies):
            i = self.starts[b]
            self.q[i : i + 3], self.u[i : i + 3] = body.x, body.v
            if body.width == PART:
                self.u[i + 3 : i + 6] = body.w

    def _scalars(self) -> None:
        """Start values of variables that are solved for and of DIFF states: their IC."""
        for k, node in enumerate(n for n in self.nodes if n[0] in ("VARIABLE", "DIFF")):
            ic = self.model.element(*node).ic
            self.z[self.m + k] = ic if node[0] == "VARIABLE" else ic[0]
            if node[0] == "DIFF":
                self.rd[k - self.nv] = ic[1] if len(ic) > 1 else 0.0

    def _groups(self) -> None:
        """Instances as integers and reals, and the Jacobian blocks they write."""
        self.blocks: dict[tuple[int, int], int] = {}
        self.size_j = 0
        for b in range(len(self.model.bodies)):
            self.block(b, b)
        rows, self.keep = [], []
        self.out_at: dict[Any, int] = {}
        for statement, names in self.kernels.outputs:
            self.out_at[statement] = self._out_next(names)
        for group in self.kernels.groups:
            rows += self._group(group)
        self.group = _ints(rows)

    def _out_next(self, names: tuple[str, ...]) -> int:
        first = getattr(self, "n_out", 0)
        self.n_out = first + len(names)
        return first

    def _is_rate(self, group: Group) -> bool:
        return group.instances[0][0].is_rate(self.model)

    def _group(self, group: Group) -> list[int]:
        phase = PHASES[group.face]
        if group.face == "velocity" and self._is_rate(group):
            phase = base.RATE_ROWS
        ints = np.array(
            [self._integers(group, b, n) for n, (_, b) in enumerate(group.instances)],
            dtype=np.int64,
        )
        reals = np.array([self._reals(group, b) for _, b in group.instances], dtype=float)
        reals = np.ascontiguousarray(np.append(reals.ravel(), 0.0))
        ints = np.ascontiguousarray(ints.ravel())
        self.keep += [ints, reals]
        at = self.kernels.addresses
        kinds = ("residual", "jacobian", "track", "clock", "watch")
        entry = [at.get(f"{group.name}_{kind}", 0) for kind in kinds]
        data = [len(group.instances), ints.ctypes.data, reals.ctypes.data]
        return [phase, *entry[:3], *data, *entry[3:]]

    def _integers(self, group: Group, binding: Binding, instance: int) -> list[int]:
        nodes = [("BODY", b) for b in binding.bodies] + binding.nodes
        offsets = [self.w_at.get(node, 0) for node in nodes]
        signals = [self.w_at["SIGNAL", s] for s in binding.signals]
        rows = [self._row(group, node) for node in nodes]
        pairs = [
            (self._row_node(group, nodes[r]), self.node_at[nodes[c]])
            for r, c in group.meta["blocks"]
        ]
        guards = group.meta["guards"]
        branches = [
            self.first_branch[place, group.name] + instance * len(found)
            for place, found in guards.items()
            if any(guards.values())
        ]
        return offsets + signals + rows + branches + [self.block(r, c) for r, c in pairs]

    def _row_node(self, group: Group, node: tuple[str, Any]) -> int:
        """Node whose rows an instance writes: velocity rows stand at mu."""
        mu = ("MU", node)
        if group.face == "velocity" and mu in self.node_at:
            return self.node_at[mu]
        return self.node_at[node]

    def _row(self, group: Group, node: tuple[str, Any]) -> int:
        if node[0] == "OUTPUT":
            return self.out_at[node[1]]
        if node[0] == "SIGNAL":
            return self.w_at[node]
        return self.starts[self._row_node(group, node)]

    def _reals(self, group: Group, binding: Binding) -> list[float]:
        values = list(binding.params) + [0.0] * group.meta["angles"]
        for marker_id in binding.markers:
            place = self.model.marker(marker_id)
            if place.offset:
                values += place.p.tolist()
            if place.turned:
                values += place.axes.ravel().tolist()
        return values

    def block(self, row: int, column: int) -> int:
        """Offset of a Jacobian block, made on first use."""
        if (row, column) not in self.blocks:
            self.blocks[row, column] = self.size_j
            self.size_j += self.widths[row] * self.widths[column]
        return self.blocks[row, column]

    def _elimination(self) -> None:
        """Derived blocks, the elimination plan and where blocks are copied to."""
        self.mixed = _ints(self._mixed_products() if self.stabilised else [])
        self.turning = _ints(self._turning_blocks())
        mu = {k for k, node in enumerate(self.nodes) if node[0] == "MU"}
        late = self._late_nodes()
        for k in mu:
            late[k] = {self.node_at[self.nodes[k][1]]}
        pairs = set(self.blocks) | {(k, k) for k in range(len(self.nodes))}
        found = analyse(self.widths, self.starts, pairs, late, self.pivoting)
        self.plan, self.places = found.plan, found.places
        copies = []
        for (row, column), offset in self.blocks.items():
            copies += [offset, self.widths[row], self.widths[column], *found.places[row, column]]
        self.copies = _ints(copies)
        self.product = _ints(
            [
                value
                for (row, column), offset in self.blocks.items()
                if max(row, column) < len(self.model.bodies)
                for value in (
                    offset,
                    self.widths[row],
                    self.widths[column],
                    self.starts[row],
                    self.starts[column],
                )  # fmt: skip
            ]
        )
        self.unit = _ints(
            [
                found.places[k, k][0] + c * (found.places[k, k][1] + 1)
                for k in sorted(mu)
                for c in range(self.widths[k])
            ]
        )
        self.J, self.D = np.zeros(self.size_j + 1), np.zeros(self.size_j + 1)
        self.LV, self.LA = np.zeros(found.size + 1), np.zeros(found.size + 1)
        self.pivots, self.pivots_a = _ints([0] * (self.nz + 1)), _ints([0] * (self.nz + 1))
        self.work = np.zeros(max(80, found.widest**2))

    def _late_nodes(self) -> dict[int, set[int]]:
        """For each constraint's node, what must be eliminated before it."""
        held: dict[int, set[int]] = {}
        for row, column in self.blocks:
            if self._is_multiplier(row) and self.nodes[column][0] == "BODY":
                held.setdefault(row, set()).add(column)
        constraints = [(k, frozenset(b), self.widths[k]) for k, b in sorted(held.items())]
        return prerequisites(constraints, self.widths[: len(self.model.bodies)])

    def _is_multiplier(self, node: int) -> bool:
        return self.nodes[node] in self.model.held

    def _mixed_products(self) -> list[int]:
        """Columns of mu: D[row, body] W G[constraint, body]^T for every block of D."""
        touched: dict[int, list[int]] = {}
        for row, column in self.blocks:
            if self._is_multiplier(row) and ("MU", self.nodes[row]) in self.node_at:
                if self.nodes[column][0] == "BODY":
                    touched.setdefault(column, []).append(row)
        products = []
        for (row, body), offset in list(self.blocks.items()):
            if self.nodes[body][0] != "BODY":
                continue
            for constraint in touched.get(body, ()):
                mu = self.node_at["MU", self.nodes[constraint]]
                target, gradient = self.block(row, mu), self.blocks[constraint, body]
                products += [target, self.widths[mu], offset, self.widths[row]]
                products += [self.widths[body], gradient, body]
        return products

    def _turning_blocks(self) -> list[int]:
        found = []
        for (row, column), offset in self.blocks.items():
            if self.nodes[column][0] == "BODY" and self.widths[column] == PART:
                found += [offset, self.widths[row], column]
        return found

    def _tables(self) -> None:
        body = []
        for b in range(len(self.model.bodies)):
            body += [self.widths[b], self.starts[b], self.w_at["BODY", b], self.blocks[b, b], 0]
        self.body = _ints(body)
        mass = any(g.meta["mass"] for g in self.kernels.groups if g.face in ("loads", "equation"))
        facts = {
            "nb": len(self.model.bodies), "n": self.n, "m": self.m, "nv": self.nv, "ns": self.ns,
            "nw": self.nw, "ng": self.group.size // 9, "si2": int(self.stabilised),
            "implicit_mass": int(mass), "n_out": getattr(self, "n_out", 0), "nz": self.nz,
            "holonomic": self.holonomic, "n_head": self.n_head,
            "clocks": len(self.guarded["clock"]), "watched": len(self.guarded["watch"]),
        }  # fmt: skip
        self.sizes = _ints([facts[name] for name in base.SIZES])

    def adopt(self, other: System) -> None:
        """Take over the state of another system of (almost) the same model."""
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

    def _named(self, node: tuple[str, Any], other: System) -> tuple[str, Any]:
        """The node of another system that is the same statement."""
        if node[0] != "BODY":
            return node
        statement = self.model.bodies[node[1]].statement
        return "BODY", other.model.body_index.get((statement.keyword, statement.key), -1)

    def largest_changes(self) -> list[str]:
        """The five largest moves of bodies from where the deck puts them, as text."""
        moved = []
        for b, body in enumerate(self.model.bodies):
            i = self.starts[b]
            turn = _turn_between(body.attitude, self.base[9 * b : 9 * b + 9].reshape(3, 3))
            shift = float(np.abs(self.q[i : i + 3] - body.x).max())
            if max(shift, turn) > MOVED:
                text = f"{body.statement.label} by {shift:.3g}"
                moved.append(
                    (max(shift, turn), text + (f" and {turn:.3g} rad" if turn > MOVED else ""))
                )
        return [text for _, text in sorted(moved, reverse=True)[:5]]

    def dense_jacobian(self) -> np.ndarray:
        """The Jacobian blocks as one matrix (nz, nz)."""
        full = np.zeros((self.nz, self.nz))
        for (row, column), at in self.blocks.items():
            r, c, h, w = (
                self.starts[row],
                self.starts[column],
                self.widths[row],
                self.widths[column],
            )
            full[r : r + h, c : c + w] = self.J[at : at + h * w].reshape(h, w)
        return full

    def release_guards(self) -> None:
        """Let every expression take the branch of the moment again."""
        self.W[self.nw :] = 0.0

    def prepare_explicit(self) -> None:
        """Coefficients and room for the stages of the explicit formula."""
        from adamslite.integrators.dop853 import tableau
        from adamslite.integrators.explicit_state import HISTORY_ROWS

        room = HISTORY_ROWS * (2 * self.n + self.ns) + 9 * len(self.model.bodies) + 16
        self.tableau = tableau()
        if self.history.size < room:
            self.history = np.zeros(room)

    def prepare_radau(self) -> None:
        """Coefficients and room for the stages and the complex factors of the Radau formula."""
        from adamslite.integrators.radau_coefficients import coefficients
        from adamslite.integrators.radau_stages import Y_ROWS, Z_ROWS

        z = self.m + self.nv + self.ns + self.holonomic
        room = Y_ROWS * (2 * self.n + self.ns) + Z_ROWS * z + 7 * self.nz + 16
        self.tableau = coefficients()
        if self.parts.size == 1:
            self.history = np.zeros(max(room, self.history.size))
            self.parts = np.zeros(3 * self.J.size)
            self.LC, self.pivots_c = np.zeros(2 * self.LV.size), _ints([0] * self.nz)
            self.work = np.zeros(max(self.work.size, 2 * int(self.plan["size"].max()) ** 2))

    def start_record(self, times: np.ndarray) -> None:
        """Make room for a record at each of ``times`` (nt,) and forget the counts of earlier
        runs.
        """
        self.times = np.ascontiguousarray(times, dtype=float)
        self.record = np.zeros(len(times) * (self.nw + int(self.sizes[base.N_OUT])) + 1)
        if self.m:
            kept = (self.history, self.control, self.base, self.ra, self.rz, self.pz)
            self.undo = np.zeros(sum(each.size for each in kept))
        self.count[:] = 0

    def run(self, operation: int, phases: int = 0) -> int:
        """Call native code on the arrays as they are now."""
        problem = _table([getattr(self, name) for name in base.FIELDS])
        plan = _table([self.plan[name] for name in base.Plan.fields])
        return engine()(problem.ctypes.data, plan.ctypes.data, operation, phases)


def _turn_between(a: np.ndarray, b: np.ndarray) -> float:
    """Angle of the rotation from one attitude to another [rad]."""
    spin = b @ a.T
    axis = np.array([spin[2, 1] - spin[1, 2], spin[0, 2] - spin[2, 0], spin[1, 0] - spin[0, 1]])
    return float(np.arctan2(np.linalg.norm(axis), np.trace(spin) - 1.0))


def _table(arrays: list[np.ndarray]) -> np.ndarray:
    return np.array([v for a in arrays for v in (a.ctypes.data, a.size)], dtype=np.int64)


def _ints(values: list[int]) -> np.ndarray:
    return np.array(values, dtype=np.int64)


def _reals(values: list[float]) -> np.ndarray:
    return np.array(values, dtype=float)


def _rotation_weight(body: Body) -> float:
    """1/(radius of gyration)^2: puts rotations on the scale of translations in W G^T mu."""
    trace = float(np.trace(body.inertia))
    return body.mass / trace if trace > 0.0 and body.mass > 0.0 else 1.0

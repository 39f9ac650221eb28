"""The model: bodies, markers and what expressions may take as known.

Frames.  A body's coordinates are the position x of its mass centre and, for a part, the attitude
R of its body frame, both in ground.  A marker on a part is fixed at p from the mass centre, in
body axes.  Masses and inertias are divided by UCF, so that forces keep the deck's unit:
force * UCF = mass * acceleration.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, overload

import numpy as np

from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.marker import Marker
from adamslite.elements.part import Part
from adamslite.elements.point_mass import PointMass
from adamslite.elements.variable import Variable
from adamslite.language.expression import (
    Call,
    Mode,
    Num,
    Op,
    Ref,
    Time,
    calls,
    operate,
    walk,
)
from adamslite.language.interfaces import Key
from adamslite.language.routines import USER
from adamslite.language.statement import class_of, expressions
from adamslite.model.cycles import behind_others, in_loops, of_each_other
from adamslite.model.geometry import IDENTITY, Place, frame_axes, rotated

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.elements.pinput import Pinput
    from adamslite.elements.poutput import Poutput
    from adamslite.language.expression import Node
    from adamslite.language.statement import Statement

POINT, PART = 3, 6
MassCentre = tuple[str, Key]
NodeKey = tuple[str, Any]
"""Keyword and id of a statement with unknowns; ``("OUTPUT", statement)`` of one that writes."""
T = TypeVar("T")
# What most point masses share: thousands of small arrays take their time to make and to keep.
NOTHING, NO_INERTIA = np.zeros(3), np.zeros((3, 3))
NOTHING.flags.writeable = NO_INERTIA.flags.writeable = False


@dataclass(frozen=True)
class Body:
    """A moving body: ``width`` 3 or 6 unknowns, start in ground, inertia in body axes over UCF."""

    statement: Part | PointMass
    width: int
    mass: float
    inertia: np.ndarray
    x: np.ndarray
    attitude: np.ndarray
    v: np.ndarray
    w: np.ndarray


class Model:
    """A deck ready to be compiled.

    Attributes
    ----------
    bodies : list of Body
        Parts and point masses that can move, in deck order.
    constraints : list of Statement
        Statements with constraint rows, holonomic ones first.
    start : list of (place, attitude), optional
        The posture from which turns and travels count, where it is not the one that is drawn.
    without : frozenset of str
        Rules of :mod:`adamslite.model.reduction` that are not applied.
    """

    merges_parts = False
    """Whether parts that are held together are one body."""

    def __init__(self, deck: Deck, without: frozenset[str] = frozenset()) -> None:
        self.deck = deck
        self.without = without
        self.places: dict[Key | MassCentre, Place | None] = {}
        self.folded: dict[Key, float | None] = {}
        self.known: dict[Hashable, Any] = {}
        self.of_bodies: dict[Hashable, Any] = {}
        """What bodies, markers and constraints alone decide; models with the same ones share it."""
        self.start: list[tuple[np.ndarray, np.ndarray]] | None = None
        self.body_index: dict[tuple[str, Key], int] = {}
        self.bodies: list[Body] = []
        for statement in deck.statements:
            if isinstance(statement, PointMass) or (
                isinstance(statement, Part) and not statement.ground
            ):
                self.body_index[statement.keyword, statement.key] = len(self.bodies)
                self.bodies.append(self.body_of(statement))
        found = [s for s in deck.statements if isinstance(s, Constraint) and deck.is_active(s)]
        self.constraints = sorted(found, key=lambda s: s.is_rate(self))
        self.held = {(s.keyword, s.key) for s in self.constraints}

    def once(self, what: Hashable, compute: Callable[[], T]) -> T:
        """Values that are computed for this model when they are first needed."""
        if what not in self.known:
            self.known[what] = compute()
        return self.known[what]

    def once_of_bodies(self, what: Hashable, compute: Callable[[], T]) -> T:
        """The same of values that bodies, markers and constraints alone decide."""
        if what not in self.of_bodies:
            self.of_bodies[what] = compute()
        return self.of_bodies[what]

    # bodies and markers

    def start_of(self, body: int) -> tuple[np.ndarray, np.ndarray]:
        """Place and attitude of a body at the start: as drawn, or where the joints close."""
        if self.start is not None:
            return self.start[body]
        return self.bodies[body].x, self.bodies[body].attitude

    def body_of(self, statement: Part | PointMass) -> Body:
        """A body as its statement has it."""
        origin = np.asarray(statement.qg, dtype=float)
        attitude = frame_axes(statement, origin)
        cm = self.marker_in_body(statement.cm)
        x = origin + attitude @ cm[0]
        mass = (statement.mass or 0.0) / self.deck.ucf
        v = np.array([statement.vx, statement.vy, statement.vz], dtype=float)
        if isinstance(statement, PointMass):
            if "points" in self.without:
                ball = mass * IDENTITY  # nothing turns it, whatever its inertia
                return Body(statement, PART, mass, ball, x, attitude, v, np.zeros(3))
            v = v if v.any() else NOTHING
            return Body(statement, POINT, mass, NO_INERTIA, x, attitude, v, NOTHING)
        if statement.vm is not None:
            v = self._drawn_axes(statement.vm) @ v
        axes = attitude @ cm[1] if statement.wm is None else self._drawn_axes(statement.wm)
        w = axes @ np.array([statement.wx, statement.wy, statement.wz], dtype=float)
        return Body(statement, PART, mass, self._inertia(statement, cm[0], mass), x, attitude, v, w)

    def marker_in_body(self, marker_id: Key | None) -> tuple[np.ndarray, np.ndarray]:
        """Origin and axes of a marker in its body frame."""
        if marker_id is None:
            return np.zeros(3), IDENTITY
        marker = self.deck.get(Marker, marker_id)
        origin = np.asarray(marker.qp, dtype=float)
        axes = frame_axes(marker, origin)
        if marker.rm is None:
            return origin, axes
        start, base = self.marker_in_body(marker.rm)
        return start + rotated(base, origin), rotated(base, axes)

    def _drawn_axes(self, marker_id: Key) -> np.ndarray:
        """Axes of a marker in ground, (3, 3), where the deck has its body."""
        owner = self.deck.get(Marker, marker_id).owner
        assert owner is not None  # a rule requires it
        body = self.deck.find(*owner)
        base = frame_axes(body, np.asarray(body.qg, dtype=float))
        return rotated(base, self.marker_in_body(marker_id)[1])

    def _inertia(self, part: Part, cm: np.ndarray, mass: float) -> np.ndarray:
        """Inertia about the mass centre in body axes (parallel axes from IM)."""
        xx, yy, zz, xy, xz, yz = (*(part.ip or ()), *[0.0] * 6)[:6]
        given = np.array([[xx, -xy, -xz], [-xy, yy, -yz], [-xz, -yz, zz]]) / self.deck.ucf
        origin, axes = self.marker_in_body(part.im if part.im is not None else part.cm)
        d = cm - origin
        return axes @ given @ axes.T - mass * (d @ d * IDENTITY - np.outer(d, d))

    @overload
    def marker(self, marker_id: Key) -> Place: ...
    @overload
    def marker(self, marker_id: MassCentre) -> Place | None: ...
    def marker(self, marker_id: Key | MassCentre) -> Place | None:
        """Where a marker sits; ``("PART", id)`` is a part's mass centre, None for the ground."""
        if marker_id not in self.places:
            self.places[marker_id] = self._place(marker_id)
        return self.places[marker_id]

    def _place(self, marker_id: Key | MassCentre) -> Place | None:
        if isinstance(marker_id, tuple):
            at = self.body_index.get(marker_id)
            return None if at is None else Place("part", at, np.zeros(3), IDENTITY)
        owner = self.deck.get(Marker, marker_id).owner
        assert owner is not None  # a rule asks for it
        body = self.body_index.get(owner)
        origin, axes = self.marker_in_body(marker_id)
        if body is None:
            part = self.deck.find(*owner)
            shift, base = np.asarray(part.qg, dtype=float), frame_axes(part, np.asarray(part.qg))
            return Place("ground", -1, shift + rotated(base, origin), rotated(base, axes))
        statement = self.bodies[body].statement
        own = statement.cm == marker_id
        apart = NOTHING if own else origin - self.marker_in_body(statement.cm)[0]
        if self.bodies[body].width == POINT:
            base = self.bodies[body].attitude
            return Place("point", body, rotated(base, apart), rotated(base, axes))
        return Place("part", body, apart, axes)

    def body_width(self, body: int) -> int:
        return self.bodies[body].width

    @property
    def moving(self) -> list[Part | PointMass]:
        """The statements of all that moves, in deck order."""
        return [body.statement for body in self.bodies]

    # variables and elements

    def merges(self, statement: Statement) -> bool:
        """Whether a constraint holds nothing that is not one body already."""
        return False

    def outputs_of(self, statement: Statement) -> list[Node]:
        """What a statement writes."""
        return statement.outputs(self)

    def written_out(self, call: Call) -> Node | None:
        """A call as an expression of others, where that is what it stands for."""
        from adamslite.model.net_force import written_out

        return written_out(call, self)

    @property
    def folder(self) -> Path:
        """Where the files are that the deck names."""
        return self.deck.folder

    def acts(self, statement: Statement) -> bool:
        """Whether an element is switched on."""
        return self.deck.is_active(statement)

    def element(self, keyword: str, element_id: Key) -> Any:
        """The statement of that kind with that id."""
        return self.deck.find(keyword, element_id)

    def variable(self, variable_id: Key) -> Variable:
        """The VARIABLE of that id."""
        return self.deck.get(Variable, variable_id)

    def has_unknowns(self, node: NodeKey) -> bool:
        """Whether a statement brings unknowns of its own."""
        if node[0] == "VARIABLE":
            return self.variable_kind(node[1]) == "loop"
        return node[0] == "DIFF" or node in self.held

    def node_width(self, node: NodeKey) -> int:
        """Unknowns of a scalar node: (keyword, id)."""
        if node in self.held:
            return self.element(*node).n_rows
        return 1

    def constant(self, node: Node) -> float | None:
        """Value of an expression without anything that changes; None when something does."""
        if type(node) is Num:
            return node.value
        if type(node) is Op:
            values = [value for value in map(self.constant, node.args) if value is not None]
            return folded(node.op, values) if len(values) == len(node.args) else None
        if type(node) is Call and node.name == "VARVAL":
            variable = node.args[0]
            return self.constant_variable(variable.id) if isinstance(variable, Ref) else None
        return None

    def constant_variable(self, variable_id: Key) -> float | None:
        """Value of a VARIABLE that never changes."""
        if variable_id not in self.folded:  # each behind those it is made of: no deep recursion
            found = behind_others([variable_id], self.variables_of, self.folded)
            self.folded.update(dict.fromkeys(found))
            for key in found:
                fixed = key not in self._plant and "variables" not in self.without
                self.folded[key] = self.constant(self.variable(key).function) if fixed else None
        return self.folded[variable_id]

    def variable_kind(self, variable_id: Key) -> str:
        """``signal`` (depends on time only), ``loop`` (solved for) or ``inline``.

        Solved for are those that depend on themselves, those of the plant, and crowded chains.
        """
        return self._kinds[variable_id]

    @cached_property
    def _plant(self) -> set[Key]:
        """VARIABLEs of every PINPUT and POUTPUT."""
        ports: list[Pinput | Poutput] = [*self.deck.of("PINPUT"), *self.deck.of("POUTPUT")]
        return {key for port in ports for key in port.variables}

    @cached_property
    def circular(self) -> set[Key]:
        """VARIABLEs that depend on themselves."""
        return in_loops(self.uses)

    @cached_property
    def uses(self) -> dict[Key, set[Key]]:
        """The VARIABLEs that each one depends on, through the elements it measures too."""
        return {v.key: set(self.used_in(v.function)) for v in self.deck.of(Variable)}

    @cached_property
    def _kinds(self) -> dict[Key, str]:
        from adamslite.model.chains import crowded  # not where kernels were kept

        loops = self._plant | self.circular
        if "variables" in self.without:
            loops |= {v.key for v in self.deck.of(Variable)}
        signals = self._signals(loops)
        loops |= crowded(self, loops, signals)
        return {
            v.key: "loop" if v.key in loops else "signal" if v.key in signals else "inline"
            for v in self.deck.of(Variable)
        }

    @cached_property
    def signals(self) -> list[Variable]:
        """VARIABLEs that depend on time only, each behind those it takes the values of."""
        own = [v.key for v in self.deck.of(Variable) if self.variable_kind(v.key) == "signal"]
        return [self.variable(key) for key in behind_others(own, self.variables_of)]

    def variables_of(self, variable_id: Key) -> list[Key]:
        """The VARIABLEs whose values the FUNCTION of one takes."""
        function = self.variable(variable_id).function
        return self.once(("VARIABLES", variable_id), lambda: list(dict.fromkeys(
            each.id for call in calls(function, "VARVAL") for each in call.args
            if isinstance(each, Ref)
        )))  # fmt: skip

    def used_in(self, node: Node) -> Iterator[Key]:
        """The VARIABLEs in an expression, and in those of the elements it measures."""
        seen: set[Node] = set()
        pending = [node]
        while pending:
            for each in walk(pending.pop()):
                written = self.written_out(each) if isinstance(each, Call) else None
                if written is not None and each not in seen:
                    seen.add(each)
                    pending.append(written)
                if not isinstance(each, Ref) or each in seen:
                    continue
                seen.add(each)
                if each.kind == "VARIABLE":
                    yield each.id
                elif each.kind not in ("MARKER", "DIFF"):
                    pending += expressions(self.element(each.kind, each.id))

    def _signals(self, loops: set[Key]) -> set[Key]:
        """VARIABLEs that depend on time and on nothing else."""
        used = {
            v.key: _taken_by_signal(v.function)
            for v in self.deck.of(Variable)
            if v.key not in loops
        }
        return of_each_other({key: names for key, names in used.items() if names is not None})

    @property
    def dof(self) -> int:
        """Unknowns of the bodies less constraint rows."""
        return sum(b.width for b in self.bodies) - sum(c.n_rows for c in self.constraints)


def _taken_by_signal(node: Node) -> set[Key] | None:
    """The VARIABLEs in an expression of time and of those alone; None for any other."""
    taken: set[Key] = set()
    parts = list(walk(node))
    for each in parts:
        if isinstance(each, Mode) or (isinstance(each, Call) and _has_memory(each)):
            return None
        if isinstance(each, Ref) and not class_of(each.kind).data:
            if each.kind != "VARIABLE":
                return None
            taken.add(each.id)
    return taken if any(isinstance(each, Time | Ref) for each in parts) else None


def _has_memory(call: Call) -> bool:
    """Whether a call gives more than a function of its arguments."""
    from adamslite.language.function import FUNCTIONS  # of a model that is kept all is known

    return call.name == USER or FUNCTIONS[call.name].takes_past


def folded(op: str, values: Sequence[float]) -> float:
    """The value of an operation on numbers; not a number where it has none."""
    value = operate(op, values)
    return float("nan") if value is None else value


def assemble(deck: Deck, without: frozenset[str] = frozenset()) -> Model:
    """Bodies, markers and constraints of a deck without errors, reduced but for some rules."""
    return Model(deck, without)

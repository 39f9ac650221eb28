"""The scope in which functions and elements write expressions of markers and states.

A marker is a *frame*: a small integer, its position in the shape's list of markers, or ``ORIGIN``
for the global frame.  The scope hands out symbols for the local kinematic inputs, always in
ground axes, always as differences, because no deck function depends on anything else:

===========  ===================================================  ==========================
leaf         meaning                                              time derivative
===========  ===================================================  ==========================
d(i,j)       r_i - r_j                                            v(i,j)
v(i,j)       d/dt of it in ground                                 a(i,j)
a(i,j)       second derivative in ground                          (none)
x(k,c)       axis c of marker k                                   w(k) cross x(k,c)
w(i,j)       angular velocity of i less that of j                 al(i,j)
al(i,j)      its derivative in ground                             (none)
===========  ===================================================  ==========================

Forces and constraint rows are written with these symbols; :mod:`adamslite.kernels.code`
differentiates them and chains the result to body coordinates.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import NamedTuple

from adamslite.symbolic import graph
from adamslite.symbolic.derivatives import Derivatives, along
from adamslite.symbolic.formulas import fn, piecewise, root
from adamslite.symbolic.guards import CLOCK_LEAVES, FIXED_LEAVES
from adamslite.symbolic.structure import ordered
from adamslite.symbolic.types import Expr, Frame, Leaf, Measure, Read, Seen, Symbol, Tree

ORIGIN = -1
Vector = tuple[Expr, Expr, Expr]
UNFORESEEN = "unforeseen"
"""The leaf in what a function of Python returns: no bound of it is known before a run."""
# Leaves that stay what they are within a step.
LASTING = ("p", "turn", "kept", "origin", "mode", "run", "nan", UNFORESEEN)
# Leaves that do not change with the unknowns.
GIVEN = (*LASTING, "t", "now", "sig")
ZERO: Vector = (0, 0, 0)


class Load(NamedTuple):
    """A force and a torque on the body of ``frame`` at that marker's origin, in ground axes.

    ``reaction`` names the frame whose body gets the opposite, at its own origin, or at the origin
    of ``frame`` when ``follows`` is true (a floating marker); ``None`` means nothing reacts.
    """

    frame: Frame
    force: Vector
    torque: Vector = ZERO
    reaction: int | None = None
    follows: bool = False


class Slot(NamedTuple):
    """What a kernel must know of a marker; ``kind`` ground, point or part; ``body`` its slot."""

    kind: str
    body: int
    offset: bool
    turned: bool


def cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def dot(a: Vector, b: Vector) -> Expr:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def scale(factor: Expr, a: Vector) -> Vector:
    return (factor * a[0], factor * a[1], factor * a[2])


def plus(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _unbound(tree: Tree) -> Expr:
    raise LookupError("this scope has no statement bound to it")


def towards(d: Vector) -> Vector:
    """The unit vector of d; undefined where d vanishes."""
    return scale(1 / fn.sqrt(dot(d, d)), d)


def along_axes(axes: tuple[Vector, Vector, Vector], components: Vector) -> Vector:
    """Sum of component times axis."""
    x, y, z = (scale(c, a) for c, a in zip(components, axes, strict=True))
    return plus(plus(x, y), z)


class Scope:
    """Symbols for one shape; records which leaves the expressions use."""

    def __init__(self, slots: list[Slot]) -> None:
        self.slots = slots
        self.leaves: dict[Symbol, Leaf] = {}
        self.symbols: dict[Leaf, Symbol] = {}
        self.angles: list[Expr] = []
        self.kept: list[Expr] = []
        self.measures: dict[tuple[str, int], list[Measure]] = {}
        self.origins: dict[int, Expr] = {}
        self.limits: list[Expr] = []
        self.touches: dict[Expr, bool] = {}
        graph.forget()
        self.slope = Derivatives(lambda symbol: self.leaves[symbol][0] in GIVEN)
        self.elements: list[Seen] = []
        self.variables: list[Tree] = []
        self._everything_moves = False
        self._rates: dict[bool, dict[Expr, Expr]] = {}
        """Rates that are known, by ``_everything_moves``."""
        self._rated: dict[bool, set[Expr]] = {False: set(), True: set()}
        """Expressions of whose symbols the rates are."""
        self.read: Callable[[Tree], Read] = _unbound
        self.written: dict[Expr, None] = {}
        """What operations and functions of the deck have given."""

    def symbol(self, *leaf: str | int) -> Symbol:
        """The symbol of one leaf."""
        if leaf not in self.symbols:
            symbol = graph.symbol("_".join(map(str, leaf)))
            self.symbols[leaf] = symbol
            self.leaves[symbol] = leaf
        return self.symbols[leaf]

    def vector(self, *leaf: str | int) -> Vector:
        return (self.symbol(*leaf, 0), self.symbol(*leaf, 1), self.symbol(*leaf, 2))

    def is_ground(self, frame: Frame) -> bool:
        """True when ``frame`` can never move."""
        return frame == ORIGIN or self.slots[frame].kind == "ground"

    def turns(self, frame: Frame) -> bool:
        """True when the axes of ``frame`` can rotate."""
        if frame == ORIGIN:
            return False
        return self._everything_moves or self.slots[frame].kind == "part"

    @contextmanager
    def everything_moves(self) -> Iterator[None]:
        """Meanwhile markers that stand still are symbols as others are.

        Their velocities evaluate to zero, but what depends on them shows what acts on them: the
        reaction at a marker of the ground.
        """
        self._everything_moves = True
        try:
            yield
        finally:
            self._everything_moves = False

    def _pair(self, name: str, i: Frame, j: Frame) -> Vector:
        if i == j:
            return ZERO
        if j == ORIGIN or (i != ORIGIN and i < j):
            return self.vector(name, i, j)
        return scale(-1, self.vector(name, j, i))

    def _moving(self, i: Frame) -> int:
        return ORIGIN if self.is_ground(i) and not self._everything_moves else i

    def _turning(self, i: Frame) -> int:
        return i if self.turns(i) else ORIGIN

    def position(self, i: Frame, j: Frame) -> Vector:
        """r_i - r_j."""
        return self._pair("d", i, j)

    def velocity(self, i: Frame, j: Frame) -> Vector:
        """Derivative of r_i - r_j in ground."""
        return self._pair("v", self._moving(i), self._moving(j))

    def acceleration(self, i: Frame, j: Frame) -> Vector:
        """Second derivative of r_i - r_j in ground."""
        return self._pair("a", self._moving(i), self._moving(j))

    def omega(self, i: Frame, j: Frame = ORIGIN) -> Vector:
        """Angular velocity of i less that of j."""
        return self._pair("w", self._turning(i), self._turning(j))

    def alpha(self, i: Frame, j: Frame = ORIGIN) -> Vector:
        """Derivative of the angular velocity difference in ground."""
        return self._pair("al", self._turning(i), self._turning(j))

    def axes(self, k: Frame) -> tuple[Vector, Vector, Vector]:
        """The x, y and z axes of marker k."""
        if k == ORIGIN or not (self.turns(k) or self.slots[k].turned):
            return ((1, 0, 0), (0, 1, 0), (0, 0, 1))
        return (self.vector("x", k, 0), self.vector("x", k, 1), self.vector("x", k, 2))

    @property
    def time(self) -> Expr:
        return self.symbol("t")

    @property
    def now(self) -> Expr:
        """TIME in what becomes known with the motion only: it is not looked through beforehand."""
        return self.symbol("now")

    @property
    def mode(self) -> Expr:
        return self.symbol("mode")

    def angle(self, sine: Expr, cosine: Expr, of: Measure) -> Expr:
        """atan2 counted over full turns: the branch nearest to the angle at the last accepted step.

        ``of`` names it: whatever else changes, what is counted belongs to its markers.
        The number of turns to add is locally constant, so the derivative is that of atan2.
        """
        wrapped = fn.atan2(sine, cosine)
        if wrapped not in self.angles:
            self.angles.append(wrapped)
        n = self.angles.index(wrapped)
        self._name("angles", n, of)
        return wrapped + self.symbol("turn", n)

    def side(self, normal: Vector, clear: Expr, of: Measure) -> Expr:
        """1 or -1: whether ``normal`` points as it did, taken by its side, at the last accepted
        step, or against that; 1 as long as there is none.

        A normal counts as one where the condition ``clear`` holds.  The side is locally constant.
        """
        first = len(self.kept)
        before: Vector = tuple(self.symbol("kept", first + c) for c in range(3))  # type: ignore
        side = piecewise((1, dot(normal, before) >= 0), otherwise=-1)
        now = scale(side / root(dot(normal, normal)), normal)
        self.kept += [piecewise((n, clear), otherwise=b) for n, b in zip(now, before, strict=True)]
        for c, axis in enumerate("xyz"):
            self._name("kept", first + c, (f"{of[0]} {axis}", *of[1:]))
        return side

    def _name(self, memory: str, n: int, of: Measure) -> None:
        """Name what is remembered under number ``n``: of equal expressions every one."""
        names = self.measures.setdefault((memory, n), [])
        if of not in names:
            names.append(of)

    def counted(self) -> list[tuple[int, Measure]]:
        """Numbers among those remembered of angles, and what each belongs to."""
        first = {"angles": 0, "kept": len(self.angles)}
        found = self.measures.items()
        return [(first[memory] + n, of) for (memory, n), names in found for of in names]

    def of_time(self, expr: Expr) -> bool:
        """Whether an expression depends on TIME alone, or on nothing that changes in a run."""
        kinds = {self.leaves[symbol][0] for symbol in self.slope.symbols(expr)}
        return kinds <= {*CLOCK_LEAVES, *FIXED_LEAVES}

    def origin(self, state: Symbol, within: Expr) -> Expr:
        """The value from which the state of a DIFF counts: what it was at the last accepted step at
        which the condition ``within`` did not hold; 0 as long as there is none.
        """
        node = self.leaves[state][1]
        origin = self.symbol("origin", node)
        self.origins[node] = piecewise((origin, within), otherwise=state, order=-1)
        return origin

    def limit(self, expr: Expr) -> None:
        """The law that is being written means nothing once ``expr`` is below zero; the time of the
        first accepted state where it is will be remembered.
        """
        if expr not in self.limits:
            self.limits.append(expr)

    def touch(self, relation: Expr, in_length: bool = True) -> Expr:
        """A relation that holds where something is touched; its gap is the distance from that, or
        (not ``in_length``) has the sign of it.
        """
        self.touches[relation] = in_length
        return relation

    def statement(self, id: Tree) -> Seen:
        """The statement that an ``id`` argument of a function means, as its physics sees it.

        It has the arguments of the statement and what it derives, as in its own methods. Of a
        VARIABLE it has the ``value`` alone, of a DIFF the ``state`` and its ``rate``.
        """
        return self.read(id)

    def load(self, id: Tree, jflag: int) -> tuple[Vector, Vector]:
        """Force and torque of an element on marker I (``jflag`` 0) or J (1), in ground axes."""
        view = self.statement(id)
        end, against = view.side(jflag)
        force, torque = ZERO, ZERO
        for load in view.own_loads(self):
            if against not in (None, load.frame, load.reaction):
                continue
            sign = (load.frame == end) - (load.reaction == end)
            force = plus(force, scale(sign, load.force))
            torque = plus(torque, scale(sign, load.torque))
        return force, torque

    def derivative(self, expr: Expr) -> Expr:
        """Total time derivative of an expression of these symbols."""
        expr, known = graph.node(expr), self._rated[self._everything_moves]
        parts = ordered([expr], lambda top: () if top in known else top.args)
        rates = self._rates.setdefault(self._everything_moves, {})
        symbols = [each for each in parts if each.kind == "symbol" and each not in rates]
        for each in sorted(symbols, key=str):
            rates[each] = graph.node(self.rate(self.leaves[each]))
        known.update(parts)
        return along(expr, rates)

    def rate(self, leaf: Leaf) -> Expr:
        """Time derivative of one leaf."""
        kind = leaf[0]
        if kind == "d":
            return self.velocity(leaf[1], leaf[2])[leaf[3]]
        if kind == "v":
            return self.acceleration(leaf[1], leaf[2])[leaf[3]]
        if kind == "w":
            return self.alpha(leaf[1], leaf[2])[leaf[3]]
        if kind == "x":
            return cross(self.omega(leaf[1]), self.vector("x", leaf[1], leaf[2]))[leaf[3]]
        if kind in ("t", "now"):
            return 1
        if kind == "sig" and leaf[2] < 2:
            return self.symbol("sig", leaf[1], leaf[2] + 1)
        if kind == "dif":
            return self.symbol("dif1", leaf[1])
        if kind in LASTING:
            return 0
        raise UndefinedRate(leaf)


class UndefinedRate(Exception):
    """A total time derivative is needed of a quantity whose rate is not known.

    ``leaf``: that something.
    """

    def __init__(self, leaf: Leaf) -> None:
        super().__init__(leaf)
        self.leaf = leaf

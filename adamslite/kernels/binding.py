"""From a statement to its shape and its numbers, so that equal statements share one kernel.

:class:`Binder` walks a statement's declared arguments and replaces every id, number and marker by
a slot. What remains, written as text, is the *key* of the shape; what was taken out is the
instance.  The walk writes no expressions, so a deck whose shapes are cached compiles nothing.
:mod:`adamslite.kernels.reader` does the reverse.

A bound tree is one of

    ("p", n) parameter    ("c", value) constant of the shape    ("t",) ("mode",)    ("m", frame)
    ("o", op, args)       ("f", function, args)    ("s", keyword, arguments) another statement
    ("v", trees)          ("z", node, component) unknown
    ("dif", node)         ("dif1", node)         ("sig", n, order) time-only variable
    ("origin", node) value from which a state counts
    ("e", n) element whose load is measured      ("tab", n) table
    ("var", n) variable that is written out: once, however often it is used
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from adamslite.functions.forces import NET
from adamslite.kernels.groups import Binding
from adamslite.language.expression import Call, Mode, Node, Num, Op, Ref, Time
from adamslite.language.function import PRODUCTS, find_function
from adamslite.language.routines import USER
from adamslite.model.model import folded
from adamslite.model.net_force import written_out
from adamslite.model.past import past_of
from adamslite.symbolic.interpolant import Interpolant
from adamslite.symbolic.scope import ORIGIN, Slot

if TYPE_CHECKING:  # few decks call routines
    from adamslite.deck.python_routine import Routine
    from adamslite.language.function import Function
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Argument, Statement
    from adamslite.model.model import MassCentre, Model, NodeKey
    from adamslite.symbolic.types import Tree

IGNORED = ("text", "texts")
# What cannot be switched off.
LASTING = ("MARKER", "VARIABLE", "DIFF", "SENSOR")


class ForceLoop(Exception):
    """An element's force depends on itself without a VARIABLE between."""


class Binder:
    """Binds statements of one model; ``model`` answers what a marker or a variable is.

    Time-only variables are read from the workspace.  What a constraint or d( )/dt takes the rate of
    is written out: variables that are solved for too, unless they depend on themselves.
    """

    def __init__(self, model: Model) -> None:
        self.model = model
        self.takes_rates = False
        self.instance = Binding()
        self.frames: dict[Key | MassCentre, Tree] = {0: ("m", ORIGIN)}
        self.slots: list[Slot] = []
        self.elements: list[tuple[str, Tree, int]] = []
        self.element_at: dict[NodeKey, int] = {}
        self.variables: list[Tree] = []
        self.variable_at: dict[tuple[Key, bool], int] = {}
        self.parts: list[Tree] = []

    def marker(self, marker_id: Key | MassCentre) -> Tree:
        """The frame of a marker, of a part's mass centre for ``("PART", id)``."""
        frame = self.frames.get(marker_id)
        if frame is None:
            frame = self.frames[marker_id] = self._frame(marker_id)
        return frame

    def _frame(self, marker_id: Key | MassCentre) -> Tree:
        place, at = self.model.marker(marker_id), self.instance
        if place is None:
            return ("c", None)
        body = -1
        if place.kind != "ground":
            if place.body not in at.bodies:
                at.bodies.append(place.body)
            body = at.bodies.index(place.body)
        at.markers.append(marker_id)
        self.slots.append(Slot(place.kind, body, place.offset, place.turned))
        return ("m", len(at.markers) - 1)

    def node_slot(self, node: NodeKey) -> int:
        """Slot of a scalar node, counted after the bodies once binding is finished."""
        if node not in self.instance.nodes:
            self.instance.nodes.append(node)
        return self.instance.nodes.index(node)

    def number(self, value: float) -> Tree:
        if value == 0.0:
            return ("c", 0.0)
        self.instance.params.append(value)
        return ("p", len(self.instance.params) - 1)

    def statement(self, statement: Statement) -> Tree:
        """Arguments of a statement, none of data, and what it derives: (("field", tree), ..)."""
        before = self.takes_rates
        self.takes_rates = before or hasattr(statement, "constraints")
        fields = []
        for name, argument in statement.arguments.items():
            if statement.data or argument.inert or argument.kind in IGNORED:
                continue
            fields.append((name, self._argument(argument, getattr(statement, name))))
        for name, value in statement.derived(self.model).items():
            fields.append((name, self._derived(value)))
        self.takes_rates = before
        return tuple(fields)

    def _derived(self, value: object) -> Tree:
        if value is None or isinstance(value, str):
            return ("c", value)
        if isinstance(value, tuple):
            return ("v", tuple(self._derived(v) for v in value))
        if isinstance(value, Ref):
            return self.reference(value)
        if isinstance(value, Interpolant):
            return self.table(value)
        if isinstance(value, Fraction):  # part of the shape
            return ("c", float(value))
        if isinstance(value, float):
            return self.number(value)
        assert isinstance(value, Node)
        return self.expression(value)

    def table(self, value: Interpolant | Routine) -> Tree:
        """Its number among those of the instance; nothing in it shapes the code."""
        tables = self.instance.tables
        if value not in tables:
            tables.append(value)
        return ("tab", tables.index(value))

    def _argument(self, argument: Argument, value: Any) -> Tree:
        if value is None:
            return ("c", None)
        if argument.kind == "expression":
            return self.expression(value)
        if argument.kind == "number":
            return self.number(value)
        if argument.kind == "vector":
            return ("v", tuple(self.number(v) for v in value))
        if argument.kind == "reference":
            return self._referred(argument.to, value)
        if argument.kind == "references":
            return ("v", tuple(self._referred(argument.to, v) for v in value))
        return ("c", value)

    def _referred(self, keyword: str, value: Key) -> Tree:
        """A marker or part as a frame; any other statement with its own arguments."""
        if keyword == "MARKER":
            return self.marker(value)
        if keyword == "PART":
            return self.marker(("PART", value))
        return ("s", keyword, self.statement(self.model.element(keyword, value)))

    def expression(self, node: Node) -> Tree:
        return self._bound(node)[0]

    def _bound(self, node: Node) -> tuple[Tree, float | None]:
        """An expression, with its value if nothing in it changes."""
        if type(node) is Num:
            return self.number(node.value), node.value
        if type(node) is Op:
            return self._operation(node)
        if type(node) is Call:
            constant = self.model.constant(node)
            return (
                (self.call(node), None) if constant is None else (self.number(constant), constant)
            )
        if isinstance(node, Time | Mode):
            return ("t",) if isinstance(node, Time) else ("mode",), None
        raise TypeError(f"not an expression: {node!r}")

    def _operation(self, node: Op) -> tuple[Tree, float | None]:
        """Numbers are parameters, except what they are folded from, and constant exponents."""
        params = self.instance.params
        mark = len(params)
        trees, values = zip(*[self._bound(each) for each in node.args], strict=True)
        if None not in values:
            del params[mark:]
            value = folded(node.op, values)
            return self.number(value), value
        if node.op == "**" and values[1] is not None:
            if trees[1][0] == "p":
                params.pop()
            trees = (trees[0], ("c", values[1]))
        return ("o", node.op, trees), None

    def output(self, node: Node, statement: Statement) -> Tree:
        """A value to write: zero for an element that is switched off."""
        return self.expression(node) if self.model.acts(statement) else ("c", 0.0)

    def call(self, node: Call) -> Tree:
        if node.name in NET:
            return self.expression(written_out(node, self.model))
        for arg in node.args:
            if type(arg) is Ref and arg.kind not in LASTING and self._is_off(arg):
                return ("c", 0.0)
        if node.name == USER:
            return self._routine(node)
        function = find_function(node.name)
        if node.name == "GCON" and node.args[2] == Num(0.0):  # its multiplier
            own = ("s", "GCON", (("multiplier", self._multiplier(node.args[0])),))
            return ("f", "GCON", (own, ("c", 0), ("c", 0), self.marker(0)))
        before = self.takes_rates
        self.takes_rates = before or node.name == "DDT"
        taken = tuple([self._taken(function, n, node) for n in range(len(node.args))])
        self.takes_rates = before
        return ("f", node.name, taken)

    def _routine(self, node: Call) -> Tree:
        """A value of a function of Python: its number, which value, what it reads."""
        number, component, *inputs = node.args
        assert isinstance(number, Num) and isinstance(component, Num)
        called = self.table(self.model.deck.user.made[int(number.value)])
        read = tuple(map(self.expression, inputs))
        return ("f", USER, (called, ("c", int(component.value)), *read))

    def _multiplier(self, gcon: Node) -> Tree:
        assert isinstance(gcon, Ref)
        return ("z", self.node_slot(("GCON", gcon.id)), 0)

    def _is_off(self, ref: Ref) -> bool:
        """A reference to an element that is switched off: whatever it measures is zero."""
        return not self.model.acts(self.model.element(ref.kind, ref.id))

    def _taken(self, function: Function, n: int, call: Call) -> Tree:
        """Argument number ``n`` of a call."""
        node, kind = call.args[n], function.parameter(n).kind
        if kind == "past":
            return self.table(past_of(self.model, call).table)
        if type(node) is Ref:
            return self.reference(node)
        if type(node) is Num and kind == "constant":
            return ("c", int(node.value))
        return self._exponent(node) if kind == "exponent" else self.expression(node)

    def _exponent(self, node: Node) -> Tree:
        """An exponent: part of the shape where it needs no power."""
        tree, value = self._bound(node)
        if value not in PRODUCTS:
            return tree
        self.instance.params.pop()
        return ("c", value)

    def reference(self, ref: Ref) -> Tree:
        if ref.kind == "MARKER":
            return self.marker(ref.id)
        if ref.kind == "VARIABLE":
            return ("s", "VARIABLE", (("value", self.variable(ref.id)),))
        if ref.kind == "DIFF":
            node = self.node_slot(("DIFF", ref.id))
            state: Tree = ("dif", node)
            if self.model.element("DIFF", ref.id).restarts:
                state = ("o", "-", (state, ("origin", node)))
            return ("s", "DIFF", (("state", state), ("rate", ("dif1", node))))
        if ref.kind == "SENSOR":
            kept = self.number(self.model.deck.senvals.get(ref.id, 0.0))
            return ("s", "SENSOR", (("kept", kept),))
        return self.element(ref)

    def variable(self, variable_id: Key) -> Tree:
        if self._is_written_out(variable_id):
            for each in self._below(variable_id):
                self._write_out(each)
            return ("var", self.variable_at[variable_id, self.takes_rates])
        if self.model.variable_kind(variable_id) == "loop":
            return ("z", self.node_slot(("VARIABLE", variable_id)), 0)
        signals = self.instance.signals
        if variable_id not in signals:
            signals.append(variable_id)
        return ("sig", signals.index(variable_id), 0)

    def _is_written_out(self, variable_id: Key) -> bool:
        kind = self.model.variable_kind(variable_id)
        if kind == "loop":
            return self.takes_rates and variable_id not in self.model.circular
        return kind == "inline"

    def _below(self, variable_id: Key) -> list[Key]:
        """A variable behind all that are written out in it and are not yet: no recursion of the
        depth of a chain.
        """
        found: dict[Key, None] = {}
        pending = [(variable_id, False)]
        while pending:
            key, complete = pending.pop()
            if complete:
                found[key] = None
            elif key not in found and (key, self.takes_rates) not in self.variable_at:
                pending.append((key, True))
                used = self.model.variables_of(key)
                pending += [(each, False) for each in used if self._is_written_out(each)]
        return list(found)

    def _write_out(self, variable_id: Key) -> None:
        tree = self.expression(self.model.variable(variable_id).function)
        self.variables.append(tree)
        self.variable_at[variable_id, self.takes_rates] = len(self.variables) - 1
        self.parts.append(("var", len(self.variables) - 1))

    def element(self, ref: Ref) -> Tree:
        """Another element whose load is measured: bound into this shape."""
        key = (ref.kind, ref.id)
        if key not in self.element_at:
            self.element_at[key] = -1
            statement = self.model.element(ref.kind, ref.id)
            tree = (ref.kind, self.statement(statement), self.unknowns(statement))
            self.elements.append(tree)
            self.element_at[key] = len(self.elements) - 1
            self.parts.append(("e", len(self.elements) - 1))
        if self.element_at[key] < 0:
            raise ForceLoop(f"{ref.kind}/{ref.id}")
        return ("e", self.element_at[key])

    def unknowns(self, statement: Statement) -> int:
        """Node slot of a statement's own unknowns (multipliers, V, s), -1 for a force."""
        node = (statement.keyword, statement.key)
        return self.node_slot(node) if self.model.has_unknowns(node) else -1

    def key(self, face: str, body: Tree) -> Tree:
        """Everything that decides the native code.

        Equal constants at the same place are of the same type, which field or parameter decides.
        """
        at = self.instance
        widths = tuple([self.model.body_width(b) for b in at.bodies])
        scalars = tuple([self.model.node_width(n) for n in at.nodes])
        counts = (len(at.params), len(at.signals), len(at.tables))
        shared = (tuple(self.elements), tuple(self.variables), tuple(self.parts))
        return (face, body, *shared, tuple(self.slots), widths, scalars, counts)

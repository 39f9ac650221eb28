"""From a statement to its shape and its numbers, so that equal statements share one kernel.

:class:`Binder` walks a statement's declared arguments and replaces every id, number and marker by
a slot. What remains, written as text, is the *key* of the shape; what was taken out is the
instance.  The walk writes no expressions, so a deck whose shapes are cached compiles nothing.
:mod:`adamslite.kernels.reader` does the reverse.

Many statements are walked at once, as columns of values: thousands of springs take as many steps as
one.  Where they turn out to differ in more than numbers and ids,
:class:`~adamslite.kernels.columns.Split` says which belong together, and each part is walked again
by itself.

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

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from adamslite.kernels.columns import LARGEST, TooLarge, same, slot, transposed
from adamslite.kernels.groups import Binding
from adamslite.language.expression import Call, Mode, Node, Num, Op, Ref, Time
from adamslite.language.function import PRODUCTS, find_function
from adamslite.language.routines import USER
from adamslite.language.statement import Statement
from adamslite.language.traced import Traced, traced, untraced
from adamslite.model.cycles import behind_others
from adamslite.model.model import folded
from adamslite.model.past import past_of
from adamslite.symbolic.interpolant import Interpolant
from adamslite.symbolic.scope import ORIGIN, Slot

if TYPE_CHECKING:  # few decks call routines
    from adamslite.deck.python_routine import Routine
    from adamslite.language.function import Function
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Argument
    from adamslite.model.model import MassCentre, Model, NodeKey
    from adamslite.symbolic.types import Tree

IGNORED = ("text", "texts")
# What cannot be switched off.
LASTING = ("MARKER", "VARIABLE", "DIFF", "SENSOR")


class ForceLoop(Exception):
    """An element's force depends on itself without a VARIABLE between.

    ``number``: of the statement in a bundle.
    """

    number = 0


class Binder:
    """Binds statements of one class and model; ``model`` answers what a marker or a variable is.

    Time-only variables are read from the workspace.  What a constraint or d( )/dt takes the rate of
    is written out: variables that are solved for too, unless they depend on themselves.

    Parameters
    ----------
    model : Model
    count : int
        How many statements are bound.
    """

    def __init__(self, model: Model, count: int) -> None:
        self.model = model
        self.count = count
        self.takes_rates = False
        self.columns = Binding()
        self.size = 0
        self.slots: list[Slot] = []
        self.elements: list[tuple[str, Tree, int]] = []
        self.element_keys: list[Sequence[NodeKey]] = []
        self.element_at: list[int] = []
        """The number of each among ``elements``; -1 while it is bound."""
        self.variables: list[Tree] = []
        self.written: dict[bool, list[dict[Key, int]]] = {
            takes_rates: [{} for _ in range(count)] for takes_rates in (False, True)
        }
        """Numbers of the variables that are written out in each statement, by ``takes_rates``."""
        self.parts: list[Tree] = []
        self.settled: list[Traced] = []
        """Traced numbers that have become part of the shape."""
        self.deriving: list[Statement] = []
        """Statements of which more is seen than their arguments."""

    @property
    def instance(self) -> Binding:
        """The first one."""
        return self.columns.row(0)

    def marker(self, ids: Sequence[Key | MassCentre]) -> Tree:
        """The frame of a marker, of a part's mass centre for ``("PART", id)``."""
        if same([marker == 0 for marker in ids]):
            return ("m", ORIGIN)
        at = self.columns
        number = slot(at.markers, ids)
        if number == len(self.slots):  # a new one
            places = [self.model.marker(marker) for marker in ids]
            found = [place for place in places if place is not None]
            if not same([place is None for place in places]):
                kind, offset, turned = same([(at.kind, at.offset, at.turned) for at in found])
                body = -1 if kind == "ground" else slot(at.bodies, [place.body for place in found])
                self.slots.append(Slot(kind, body, offset, turned))
            else:
                at.markers.pop()
                return ("c", None)
        return ("m", number)

    def node_slot(self, nodes: Sequence[NodeKey]) -> int:
        """Slot of a scalar node, counted after the bodies once binding is finished."""
        return slot(self.columns.nodes, nodes)

    def number(self, values: Sequence[float]) -> Tree:
        if same([value == 0.0 for value in values]):
            self.settled += traced(values)
            return ("c", 0.0)
        self.columns.params.append(values)
        return ("p", len(self.columns.params) - 1)

    def statement(self, statements: Sequence[Statement]) -> Tree:
        """Arguments of statements of one class, none of data, and what they derive: (("field",
        tree), ..).
        """
        cls, before = same([*map(type, statements)]), self.takes_rates
        self.takes_rates = before or hasattr(cls, "constraints")
        fields = []
        for name, argument in cls.arguments.items():
            if cls.data or argument.inert or argument.kind in IGNORED:
                continue
            fields.append((name, self._argument(argument, [getattr(s, name) for s in statements])))
        if cls.derived is not Statement.derived:
            fields += self._further(statements)
        self.takes_rates = before
        return tuple(fields)

    def _further(self, statements: Sequence[Statement]) -> list[tuple[str, Tree]]:
        """What statements derive."""
        self.deriving += statements
        found = [statement.derived(self.model) for statement in statements]
        names = same([(*each,) for each in found])
        return [(name, self._derived([each[name] for each in found])) for name in names]

    def _derived(self, values: Sequence[Any]) -> Tree:
        kind = same([*map(type, untraced(values))])
        if kind is type(None) or issubclass(kind, str):
            return ("c", same(values))
        if issubclass(kind, tuple):
            return ("v", tuple([self._derived(column) for column in transposed(values)]))
        if kind is Ref:
            return self.reference(values)
        if issubclass(kind, Interpolant):
            return self.table(values)
        if issubclass(kind, Fraction):  # part of the shape
            return ("c", float(same(values)))
        if issubclass(kind, float):
            return self.number(values)
        assert issubclass(kind, Node)
        return self.expression(values)

    def table(self, values: Sequence[Interpolant | Routine]) -> Tree:
        """Its number among those of the instance; nothing in it shapes the code."""
        return ("tab", slot(self.columns.tables, values))

    def _argument(self, argument: Argument, values: Sequence[Any]) -> Tree:
        if same([value is None for value in values]):
            return ("c", None)
        if argument.kind == "expression":
            return self.expression(values)
        if argument.kind == "number":
            return self.number(values)
        if argument.kind == "vector":
            return ("v", tuple([self.number(column) for column in transposed(values)]))
        if argument.kind == "reference":
            return self._referred(argument.to, values)
        if argument.kind == "references":
            columns = transposed(values)
            return ("v", tuple([self._referred(argument.to, column) for column in columns]))
        return ("c", same(values))

    def _referred(self, keyword: str, ids: Sequence[Key]) -> Tree:
        """A marker or part as a frame; any other statement with its own arguments."""
        if keyword == "MARKER":
            return self.marker(ids)
        if keyword == "PART":
            return self.marker([("PART", each) for each in ids])
        return ("s", keyword, self.statement([self.model.element(keyword, each) for each in ids]))

    def expression(self, nodes: Sequence[Node]) -> Tree:
        return self._bound(nodes)[0]

    def _bound(self, nodes: Sequence[Any]) -> tuple[Tree, Sequence[float] | None]:
        """An expression, with its values if nothing in it changes."""
        kind = same([*map(type, nodes)])
        self.size += 1
        if self.size > LARGEST:
            raise self.too_large(LARGEST)
        if kind is Num:
            values = [node.value for node in nodes]
            return self.number(values), values
        if kind is Op:
            return self._operation(nodes)
        if kind is Call:
            found = [*map(self.model.constant, nodes)]
            values = [value for value in found if value is not None]
            if same([value is None for value in found]):
                return self.call(nodes), None
            return self.number(values), values
        if issubclass(kind, Time | Mode):
            return ("t",) if issubclass(kind, Time) else ("mode",), None
        raise TypeError(f"not an expression: {nodes[0]!r}")

    def _operation(self, nodes: Sequence[Op]) -> tuple[Tree, Sequence[float] | None]:
        """Numbers are parameters, except what they are folded from, and constant exponents."""
        op, params = same([node.op for node in nodes]), self.columns.params
        mark = len(params)
        columns = transposed([node.args for node in nodes])
        trees, values = zip(*[self._bound(each) for each in columns], strict=True)
        if None not in values:
            del params[mark:]
            found = [folded(op, each) for each in zip(*values, strict=True)]
            return self.number(found), found
        if op == "**" and values[1] is not None:
            self.settled += traced(values[1])
            if trees[1][0] == "p":
                params.pop()
            trees = (trees[0], ("c", same(values[1])))
        return ("o", op, trees), None

    def output(self, nodes: Sequence[Node], statements: Sequence[Statement]) -> Tree:
        """A value to write: zero for an element that is switched off."""
        acts = same([self.model.acts(statement) for statement in statements])
        return self.expression(nodes) if acts else ("c", 0.0)

    def call(self, nodes: Sequence[Call]) -> Tree:
        name = same([node.name for node in nodes])
        written = [self.model.written_out(node) for node in nodes]
        if not same([each is None for each in written]):
            return self.expression([each for each in written if each is not None])
        columns = transposed([node.args for node in nodes])
        if any(map(self._are_off, columns)):
            return ("c", 0.0)
        if name == USER:
            return self._routine(columns)
        function = find_function(name)
        if name == "GCON" and same([each == Num(0.0) for each in columns[2]]):  # its multiplier
            own = ("s", "GCON", (("multiplier", self._multiplier(columns[0])),))
            return ("f", "GCON", (own, ("c", 0), ("c", 0), ("m", ORIGIN)))
        before = self.takes_rates
        self.takes_rates = before or name == "DDT"
        taken = tuple([self._taken(function, n, columns[n], nodes) for n in range(len(columns))])
        self.takes_rates = before
        return ("f", name, taken)

    def _routine(self, columns: Sequence[Sequence[Any]]) -> Tree:
        """A value of a function of Python: its number, which value, what it reads."""
        numbers, components, *inputs = columns
        made = self.model.deck.user.made
        called = self.table([made[int(number.value)] for number in numbers])
        read = tuple([self.expression(column) for column in inputs])
        return ("f", USER, (called, ("c", same([int(each.value) for each in components])), *read))

    def _multiplier(self, gcons: Sequence[Ref]) -> Tree:
        return ("z", self.node_slot([("GCON", gcon.id) for gcon in gcons]), 0)

    def _are_off(self, nodes: Sequence[Node]) -> bool:
        """References to elements that are switched off: whatever is measured of them is zero."""
        others = [type(node) is Ref and node.kind not in LASTING for node in nodes]
        if not same(others):
            return False
        elements = [self.model.element(node.kind, node.id) for node in nodes if type(node) is Ref]
        return not same([*map(self.model.acts, elements)])

    def _taken(self, function: Function, n: int, nodes: Sequence[Any], of: Sequence[Call]) -> Tree:
        """Argument number ``n`` of calls."""
        kind, made_of = function.parameter(n).kind, same([*map(type, nodes)])
        if kind == "past":
            return self.table([past_of(self.model, call).table for call in of])
        if made_of is Ref:
            return self.reference(nodes)
        if made_of is Num and kind == "constant":
            self.settled += traced([node.value for node in nodes])
            return ("c", same([int(node.value) for node in nodes]))
        return self._exponent(nodes) if kind == "exponent" else self.expression(nodes)

    def _exponent(self, nodes: Sequence[Node]) -> Tree:
        """An exponent: part of the shape where it needs no power."""
        tree, values = self._bound(nodes)
        self.settled += traced(values or ())
        if values is None or not same([value in PRODUCTS for value in values]):
            return tree
        self.columns.params.pop()
        return ("c", same(values))

    def reference(self, refs: Sequence[Ref]) -> Tree:
        kind, ids = same([ref.kind for ref in refs]), [ref.id for ref in refs]
        if kind == "MARKER":
            return self.marker(ids)
        if kind == "VARIABLE":
            return ("s", "VARIABLE", (("value", self.variable(ids)),))
        if kind == "DIFF":
            return self._state(ids)
        if kind == "SENSOR":
            kept = [self.model.deck.senvals.get(each, 0.0) for each in ids]
            return ("s", "SENSOR", (("kept", self.number(kept)),))
        return self.element([(kind, each) for each in ids])

    def _state(self, ids: Sequence[Key]) -> Tree:
        node = self.node_slot([("DIFF", each) for each in ids])
        state: Tree = ("dif", node)
        if same([self.model.element("DIFF", each).restarts for each in ids]):
            state = ("o", "-", (state, ("origin", node)))
        return ("s", "DIFF", (("state", state), ("rate", ("dif1", node))))

    def variable(self, ids: Sequence[Key]) -> Tree:
        if same([self._is_written_out(each) for each in ids]):
            return ("var", self._number_of(ids))
        if same([self.model.variable_kind(each) for each in ids]) == "loop":
            return ("z", self.node_slot([("VARIABLE", each) for each in ids]), 0)
        return ("sig", slot(self.columns.signals, ids), 0)

    def _is_written_out(self, variable_id: Key) -> bool:
        kind = self.model.variable_kind(variable_id)
        if kind == "loop":
            return self.takes_rates and variable_id not in self.model.circular
        return kind == "inline"

    def _number_of(self, ids: Sequence[Key]) -> int:
        """The number of a variable that is written out, which is done when it is first needed."""
        rows = self.written[self.takes_rates]
        orders = [
            behind_others([key], self._written_out_in, row)
            for key, row in zip(ids, rows, strict=True)
        ]
        for column in transposed(orders):
            # A force that is measured in one of them may have brought others.
            if same([key not in row for key, row in zip(column, rows, strict=True)]):
                self._write_out(column)
        return same([row[key] for key, row in zip(ids, rows, strict=True)])

    def _written_out_in(self, variable_id: Key) -> list[Key]:
        """The variables that are written out in one of them."""
        return [each for each in self.model.variables_of(variable_id) if self._is_written_out(each)]

    def _write_out(self, ids: Sequence[Key]) -> None:
        tree = self.expression([self.model.variable(each).function for each in ids])
        for key, row in zip(ids, self.written[self.takes_rates], strict=True):
            row[key] = len(self.variables)
        self.parts.append(("var", len(self.variables)))
        self.variables.append(tree)

    def element(self, keys: Sequence[NodeKey]) -> Tree:
        """Another element whose load is measured: bound into this shape."""
        number = slot(self.element_keys, keys)
        if number == len(self.element_at):
            self.element_at.append(-1)
            statements = [self.model.element(*key) for key in keys]
            tree = (keys[0][0], self.statement(statements), self.unknowns(statements))
            self.elements.append(tree)
            self.element_at[number] = len(self.elements) - 1
            self.parts.append(("e", len(self.elements) - 1))
        if self.element_at[number] < 0:
            raise ForceLoop("{}/{}".format(*keys[0]))
        return ("e", self.element_at[number])

    def unknowns(self, statements: Sequence[Statement]) -> int:
        """Node slot of a statement's own unknowns (multipliers, V, s), -1 for a force."""
        nodes = [(statement.keyword, statement.key) for statement in statements]
        return self.node_slot(nodes) if same([*map(self.model.has_unknowns, nodes)]) else -1

    def too_large(self, most: int) -> TooLarge:
        """What is wrong with more than so many operations."""
        return TooLarge(most, [*self.written[False][0], *self.written[True][0]])

    def key(self, face: str, body: Tree) -> Tree:
        """Everything that decides the native code.

        Equal constants at the same place are of the same type, which field or parameter decides.
        """
        at, model = self.columns, self.model
        widths = tuple([same([*map(model.body_width, column)]) for column in at.bodies])
        scalars = tuple([same([*map(model.node_width, column)]) for column in at.nodes])
        counts = (len(at.params), len(at.signals), len(at.tables))
        shared = (tuple(self.elements), tuple(self.variables), tuple(self.parts))
        return (face, body, *shared, tuple(self.slots), widths, scalars, counts)

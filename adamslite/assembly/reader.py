"""Statements and expressions of a deck as numbers of one posture."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from adamslite.assembly.scope import NumberScope, Unmeasured
from adamslite.functions.forces import NET
from adamslite.language.expression import OPERATORS, Call, Mode, Node, Num, Op, Ref, Time
from adamslite.language.function import FUNCTIONS
from adamslite.language.interfaces import Key
from adamslite.language.statement import Argument, Statement
from adamslite.model.cycles import behind_others
from adamslite.symbolic.duals import Dual, Number, power
from adamslite.symbolic.scope import ORIGIN
from adamslite.symbolic.types import Expr


class NumberReader(NumberScope):
    """A scope that knows the statements of its model."""

    def seen(self, statement: Statement) -> SimpleNamespace:
        """A statement as its physics sees it: frames, numbers, values of expressions."""
        fields = {
            name: self._field(argument, getattr(statement, name))
            for name, argument in statement.arguments.items()
            if not argument.inert and not statement.data
        }
        derived = statement.derived(self.model)
        return SimpleNamespace(**fields | {k: self._derived(v) for k, v in derived.items()})

    def _field(self, argument: Argument, value: Any) -> Any:
        if value is None:
            return None
        if argument.kind == "expression":
            return self.value(value)
        if argument.kind == "reference":
            return self._referred(argument.to, value)
        if argument.kind == "references":
            return tuple(self._referred(argument.to, each) for each in value)
        return value

    def _referred(self, keyword: str, key: Any) -> Any:
        if keyword == "MARKER":
            return key
        return self.seen(self.model.element(keyword, key))

    def _derived(self, value: Any) -> Any:
        if isinstance(value, tuple):
            return tuple(map(self._derived, value))
        if isinstance(value, Ref):
            return value.id
        return self.value(value) if isinstance(value, Call | Op | Num | Time | Mode) else value

    # expressions

    def value(self, node: Node) -> Expr:
        """The value of an expression."""
        match node:
            case Num(number):
                return Dual(number)
            case Time():
                return self.time
            case Mode():
                return self.mode
            case Op("**", (base, exponent)):
                return power(self.value(base), self.value(exponent))
            case Op(op, args):
                return OPERATORS[op].function(*map(self.value, args))
            case Call():
                return self._call(node)
        raise TypeError(f"not an expression: {node!r}")

    def _call(self, call: Call) -> Dual:
        """The value of a function; what its body returns as a plain number has no slope."""
        if call.name in NET:
            raise Unmeasured
        found: Number = FUNCTIONS[call.name].body(self, *self.arguments(call))  # type: ignore[arg-type, assignment]
        return found if isinstance(found, Dual) else Dual(float(found))

    def _of_variable(self, key: Key) -> Expr:
        """The value of a VARIABLE; those that it takes are known before, each found once for a
        time, however many take it.
        """
        if self._known_at != self.now:
            self._variables.clear()
            self._known_at = self.now
        for each in behind_others([key], self.model.variables_of, self._variables):
            if each in self.model.circular:
                raise Unmeasured
            self._variables[each] = self.value(self.model.variable(each).function)
        return self._variables[key]

    def arguments(self, call: Call) -> list[Any]:
        """What the body of a function gets: frames, references, whole numbers, values."""
        function = FUNCTIONS[call.name]
        args: list[Any] = []
        for number, arg in enumerate(call.args):
            if isinstance(arg, Ref):
                ground = arg.kind == "MARKER" and arg.id == 0
                args.append(arg if arg.kind != "MARKER" else ORIGIN if ground else arg.id)
            elif isinstance(arg, Num) and function.parameter(number).kind == "constant":
                args.append(int(arg.value))
            else:
                args.append(self.value(arg))
        return args

    def statement(self, id: Ref) -> Any:
        """What functions measure of a VARIABLE, DIFF, SENSOR or SPLINE."""
        found = self.model.element(id.kind, id.id)
        if id.kind == "VARIABLE":
            return SimpleNamespace(value=self._of_variable(id.id))
        if id.kind == "DIFF":
            return SimpleNamespace(state=Dual((*(found.ic or ()), 0.0)[0]), rate=Dual(0.0))
        if id.kind == "SENSOR":
            return SimpleNamespace(kept=Dual(self.model.deck.senvals.get(id.id, 0.0)))
        if found.data:
            return self.seen(found)
        raise Unmeasured

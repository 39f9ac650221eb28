"""Resolves expressions: from the tree of a text to the tree that is compiled.

A resolved expression (:mod:`adamslite.language.expression`) holds numbers, ids and calls with all
their arguments; every name in it was looked up here.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from adamslite.deck.names import RESERVED, Names, to_number
from adamslite.functions.arrays import NUMBERED
from adamslite.functions.vectors import ASSUMED, VECTORS, Components, Value, combined, negated
from adamslite.language.expression import Call, Node, Num, Op, Ref, fold
from adamslite.language.function import FUNCTIONS, Function, Parameter
from adamslite.language.interfaces import Key
from adamslite.language.messages import Log
from adamslite.language.routines import USER, is_user_call
from adamslite.language.spelling import spelled
from adamslite.reading.expression_names import ExpressionNames, Unresolved
from adamslite.syntax.forms import Fault, Tree, expression_form
from adamslite.syntax.syntax_errors import expression_mistake, kinds_of
from adamslite.syntax.tokens import OPERATORS, Tokens

DEEPEST = 100
LONGEST = 100_000
"""Words, numbers and signs of an expression."""
LONGEST_CHAIN = 16
_STAND_IN = Num(0.0)


class _Slot(NamedTuple):
    """What an argument of a function must be: the kind of statement, or None for an expression
    or a vector; and what stands for it where it is left out.
    """

    kind: str | None
    constant: bool
    vector: bool
    default: Node | None


class Resolver(ExpressionNames):
    """Resolves expressions of one deck.

    Parameters
    ----------
    names : Names
    log : Log
    """

    def __init__(self, names: Names, log: Log) -> None:
        super().__init__(names, log)
        self.numbered: dict[tuple[str, Key], Sequence[Node]] = {}
        """Values that statements list, by keyword and id."""
        self.failed = False
        self.calls_user = False
        """Whether one of them is a routine that is no part of the deck."""
        self._slots: dict[str, list[_Slot]] = {}

    # ---- entry points -------------------------------------------------------------------------

    def expression(self, tokens: Tokens) -> Node:
        """The resolved expression; raises :class:`Unresolved` after logging what is wrong."""
        value = self._value(tokens)
        if not isinstance(value, Components):
            return value
        self._refuse("vector-here", tokens[0], tokens[-1])

    def routine(self, tokens: Tokens) -> Node:
        """The same where a routine of the user has to be called."""
        value = self.expression(tokens)
        if is_user_call(value):
            return value
        self._refuse("routine-here", tokens[0], tokens[-1])

    def components(self, tokens: Tokens) -> Components:
        """The same of an expression that is a vector."""
        value = self._value(tokens)
        if not isinstance(value, Components):
            self._refuse("number-here", tokens[0], tokens[-1])
        return value

    def _value(self, tokens: Tokens) -> Value:
        if len(tokens) > LONGEST:
            count = len(tokens)
            self._refuse(
                "expression-too-long", tokens[0], tokens[-1], count=count, most=LONGEST
            )  # fmt: skip
        form = expression_form(kinds_of(tokens))
        if isinstance(form, Fault):
            mistake = expression_mistake(tokens, form)
            self._refuse(mistake.code, tokens[mistake.first], tokens[mistake.last], **mistake.words)
        node = self._whole(form, tokens)
        if self.failed:
            raise Unresolved
        return node

    def constant(self, tokens: Tokens) -> float | None:
        """The value of an expression of numbers only; None for anything else."""
        if len(tokens) > LONGEST:
            return None
        form = expression_form(kinds_of(tokens))
        if isinstance(form, Fault):
            return None
        names = {spelled(t[1]).upper() for t in tokens if t[0] == "NAME"}
        if not all(isinstance(RESERVED.get(name), Num) for name in names):
            return None
        value = self._whole(form, tokens)
        return None if isinstance(value, Components) else fold(value)

    # ---- nodes --------------------------------------------------------------------------------

    def _whole(self, tree: Tree, tokens: Tokens) -> Value:
        self.tokens, self.failed = tokens, False
        return self._node(tree, 0)

    def _node(self, tree: Tree, depth: int) -> Value:
        """One node; after a mistake a stand-in, so that the rest is checked as well."""
        try:
            return self._build(tree, depth)
        except Unresolved:
            self.failed = True
            return _STAND_IN

    def _build(self, tree: Tree, depth: int) -> Value:
        rule, at = tree[0], tree[1]
        if rule == "number":
            return Num(self._number(at))
        if depth > DEEPEST:
            self._refuse("too-deep", self.tokens[at], limit=DEEPEST)
        if rule == "name":
            return self._name(at)
        if rule == "operation":
            return self._operation(tree, depth)
        if rule == "negation":
            inner = self._node(tree[2], depth + 1)
            if type(inner) is Num and tree[2][0] == "number":
                return Num(-inner.value)
            return negated(inner)
        return self._call(tree, depth)

    def _number(self, at: int) -> float:
        value = to_number(self.tokens[at][1])
        if math.isinf(value):
            self._refuse("number-too-large", self.tokens[at], word=self.tokens[at][1])
        return value

    def _operation(self, tree: Tree, depth: int) -> Value:
        op = OPERATORS[self.tokens[tree[1]][0]]
        left, right = tree[2], tree[3]
        if op in "+-" and left[0] == "operation":
            terms = self._terms(tree)
            if len(terms) > LONGEST_CHAIN:
                values = [(op, self._node(term, depth + 1)) for op, term in terms]
                return self._sum(values, tree[1])
        return self._combined(
            op, self._node(left, depth + 1), self._node(right, depth + 1), tree[1]
        )

    def _combined(self, op: str, left: Value, right: Value, at: int) -> Value:
        if not (isinstance(left, Components) or isinstance(right, Components)):
            return Op(op, (left, right))
        value = combined(op, left, right)
        if value is None and self.failed:  # one side is but a stand-in
            raise Unresolved
        if value is None:
            self._refuse("vector-operation", self.tokens[at], word=self.tokens[at][1])
        return value

    def _terms(self, tree: Tree) -> list[tuple[str, Tree]]:
        """The signed terms of a sum, the first one with a plus."""
        terms = []
        while tree[0] == "operation" and self.tokens[tree[1]][0] in ("PLUS", "MINUS"):
            terms.append((OPERATORS[self.tokens[tree[1]][0]], tree[3]))
            tree = tree[2]
        return [("+", tree), *reversed(terms)]

    def _sum(self, terms: list[tuple[str, Value]], at: int) -> Value:
        """A long sum as a balanced tree, so that its depth grows with the logarithm only."""
        if len(terms) == 1:
            return terms[0][1]
        half = len(terms) // 2
        sign = terms[half][0]
        right = [("+" if op == sign else "-", node) for op, node in terms[half:]]
        return self._combined(sign, self._sum(terms[:half], at), self._sum(right, at), at)

    # ---- calls --------------------------------------------------------------------------------

    def _call(self, tree: Tree, depth: int) -> Value:
        at, separators, branches = tree[1], tree[2], tree[3:]
        name = spelled(self.tokens[at][1]).upper()
        function = FUNCTIONS.get(name)
        if function is None:
            self._unknown_function(name, at)
        if name == USER:
            return self._user(at, branches, depth)
        self._count(function, at, separators, branches)
        slots = self._signature(function)
        if branches and slots[0].kind == "VARIABLE" and branches[0][0] == "operation":
            return self._derivative(function, branches[0])
        last = len(slots) - 1
        args = [
            self._argument(function, slots[min(i, last)], branch, depth + 1)
            for i, branch in enumerate(branches)
        ]
        if function.ruled:
            self._rules(function, args, branches)
        if name in NUMBERED:
            return self._numbered(name, args[0], args[1], branches[1])
        args += [slot.default for slot in slots[len(args) :] if slot.default is not None]
        self.names.delays = self.names.delays or function.takes_past
        if name in ASSUMED:
            self._log("assumed-meaning", self.tokens[at], self.tokens[at], word=name)
        return VECTORS[name](*args) if name in VECTORS else Call(name, tuple(args))

    def _user(self, at: int, branches: tuple[Tree, ...], depth: int) -> Node:
        """A routine of the user: the whole expression, of numbers alone."""
        if depth:
            self._refuse("user-within", self.tokens[at])
        self.calls_user = True
        function = FUNCTIONS[USER]
        if len(branches) > (function.maximum or 0):
            self._count(function, at, "", branches)
        return Call(USER, tuple(map(self._parameter, branches)))

    def _parameter(self, branch: Tree) -> Num:
        """A number that goes to a routine of the user."""
        node = self._node(branch, 1)
        value = None if isinstance(node, Components) else fold(node)
        if value is None:
            self._refuse("not-constant", self.tokens[branch[1]], word=USER)
        return Num(value)

    def _signature(self, function: Function) -> list[_Slot]:
        slots = self._slots.get(function.name)
        if slots is None:
            slots = [
                _Slot(p.statement, p.kind == "constant", p.kind == "vector", _default(p))
                for p in function.parameters
            ]
            self._slots[function.name] = slots
        return slots

    def _count(
        self, function: Function, at: int, separators: str, branches: tuple[Tree, ...]
    ) -> None:
        count, most = len(branches), function.maximum
        if count < function.minimum or (most is not None and count > most):
            self._refuse(
                "argument-count", self.tokens[at],
                word=function.name, count=count, limits=function.limits, usage=function.usage,
            )  # fmt: skip
        if separators[:1] == ":" and not function.colon or ":" in separators[1:]:
            self._refuse("wrong-separator", self.tokens[at], usage=function.usage)
        if function.colon and separators[:1] == ",":
            self._refuse("wrong-separator", self.tokens[at], usage=function.usage)

    def _argument(self, function: Function, slot: _Slot, branch: Tree, depth: int) -> Any:
        if slot.kind is not None:
            try:
                return self._reference(function, slot.kind, branch)
            except Unresolved:
                self.failed = True
                return _STAND_IN
        node = self._node(branch, depth)
        if slot.vector or isinstance(node, Components):
            return self._vector_argument(slot, node, branch)
        if slot.constant and fold(node) is None:
            token = self.tokens[branch[1]]
            self._log("not-constant", token, token, word=function.name)
            self.failed = True
        return Num(fold(node) or 0.0) if slot.constant else node

    def _vector_argument(self, slot: _Slot, value: Value, branch: Tree) -> Value:
        if isinstance(value, Components) and slot.vector:
            return value
        code = "number-here" if slot.vector else "vector-here"
        if not self.failed:
            self._log(code, self.tokens[branch[1]], self.tokens[branch[1]])
        self.failed = True
        return Components(_STAND_IN, _STAND_IN, _STAND_IN) if slot.vector else _STAND_IN

    def _derivative(self, function: Function, tree: Tree) -> Node:
        """``VARVAL(d(x)/dt)``: the VARIABLE of that very name, else the rate of VARIABLE x."""
        _, slash, top, bottom = tree
        text = [spelled(token[1]).upper() for token in self.tokens]
        rate = (
            self.tokens[slash][0] == "SLASH"
            and (top[0], text[top[1]], bottom[0], text[bottom[1]]) == ("call", "D", "name", "DT")
            and len(top) == 4
            and top[3][0] in ("name", "number")
        )
        if not rate:
            self._refuse("not-an-id", self.tokens[tree[1]], word=function.name, kind="VARIABLE")
        inner = top[3][1]
        whole = self.names.find("VARIABLE", f"D({text[inner]})/DT")
        if whole is not None and not isinstance(whole, list):
            return Call(function.name, (Ref("VARIABLE", whole),))
        return Call("DDT", (self._reference(function, "VARIABLE", top[3]),))

    def _numbered(self, name: str, ref: Node, number: Node, branch: Tree) -> Node:
        """The value that a statement lists under a number."""
        if not (isinstance(ref, Ref) and isinstance(number, Num)):
            return _STAND_IN
        values = self.numbered.get((ref.kind, ref.id))
        if values is None:  # the statement has mistakes of its own
            return _STAND_IN
        token = self.tokens[branch[1]]
        if number.value not in range(1, len(values) + 1):
            label, wanted = f"{ref.kind}/{ref.id}", f"{number.value:g}"
            self._refuse("no-such-value", token, label=label, number=wanted, count=len(values))
        return values[int(number.value) - 1]

    def _rules(self, function: Function, args: list[Node], branches: tuple[Tree, ...]) -> None:
        if self.failed:
            return
        for index, sentence in function.mistakes([fold(arg) for arg in args]):
            token = self.tokens[branches[index][1]]
            self._log("function-rule", token, token, sentence=sentence)
            self.failed = True


def _default(parameter: Parameter) -> Node | None:
    if parameter.default is None:
        return None
    if parameter.statement:
        return Ref(parameter.statement, int(parameter.default))
    return Num(parameter.default)

"""What runs in place of routines that are no part of a deck, and which of them are missing.

A call ``USER(...)`` becomes what the user has bound to its statement or routine
(:mod:`adamslite.deck.user_bindings`).  Of a REQUEST without a binding nothing is written; every
other routine without one is reported once, with all its calls.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command, Redefinition
from adamslite.deck.statement_diagnostics import diagnose, place_of
from adamslite.deck.user_bindings import INSTALLED, Binding, Bindings, is_installed
from adamslite.elements.bases.traced_curve import line, traced
from adamslite.language.diagnostics import NOWHERE, Diagnostic, Source
from adamslite.language.expression import TIME, Call, Node, Num, to_text
from adamslite.language.interfaces import key_of
from adamslite.language.likeness import did_you_mean
from adamslite.language.messages import Log, compose
from adamslite.language.routines import (
    ARGUMENT,
    USER,
    is_user_call,
    short_name,
    usual_name,
    written,
)
from adamslite.language.statement import Statement
from adamslite.reading.expression_names import Unresolved
from adamslite.reading.resolver import Resolver
from adamslite.syntax.tokens import scan

FIELD = ARGUMENT.lower()
# Left out where its routine is missing: it changes nothing.
LEFT_OUT = "REQUEST"
CURVE = "CURVE"


@dataclass
class UserCall:
    """A statement that calls a routine: the fields that take a value each."""

    command: Command
    fields: tuple[str, ...]
    call: Call
    routine: str

    @property
    def count(self) -> int:
        """How many values the routine returns."""
        fields, command = len(self.fields), self.command
        return command.routine_count(fields) if isinstance(command, Statement) else fields

    @property
    def label(self) -> str:
        return self.command.label

    @property
    def listed(self) -> str:
        """Its place, as text."""
        place = place_of(self.command, FIELD)
        return f"{place.file}:{place.line}: {self.label}, {written(self.call)}"


class RoutineBinder:
    """Binds the calls of one text; ``diagnostics`` is what there is to say."""

    def __init__(self, resolver: Resolver, given: Bindings, deck: Deck | None = None) -> None:
        self.names, self.given, self.deck = resolver.names, given, deck
        self.resolver = resolver
        self.diagnostics: list[Diagnostic] = []
        self.bound: list[UserCall] = []
        self.left_out: list[UserCall] = []
        self.missing: dict[str, list[UserCall]] = {}

    def commands(self, commands: Sequence[Command]) -> tuple[Command, ...]:
        """The statements with their calls bound; those that cannot be are as they were."""
        changed = tuple(map(self._command, commands))
        self.diagnostics += [*self._missing(), *self._notes(), *self._mistaken()]
        return changed

    def _command(self, command: Command) -> Command:
        values = _values(command)
        fields = tuple(name for name, value in values.items() if is_user_call(value))
        if not fields:
            return command
        call = UserCall(command, fields, values[fields[0]], self._routine(command))
        nodes = self._nodes(call)
        if not nodes:
            return command
        if isinstance(command, Redefinition):
            values = {**command.changes, **dict(zip(fields, nodes, strict=True))}
            return replace(command, changes=values)
        changes: dict[str, Any] = command.of_routine(fields, nodes)
        return replace(command, **changes)

    def _routine(self, command: Command) -> str:
        """Name of the routine that a statement calls."""
        values = _values(command)
        own = values.get("routine") or next(iter(values.get("interface") or ()), None)
        if own is None and self.deck and isinstance(command, Redefinition):
            own = getattr(self.deck.find(command.keyword, command.key), "routine", None)
        return str(own or usual_name(command.keyword))

    def _nodes(self, call: UserCall) -> Sequence[Node | None]:
        """What its fields hold; nothing where they cannot be filled."""
        keyword, key = call.command.keyword, call.command.key
        binding = self.given.find(self.names, (keyword, key), call.label, call.routine)
        if binding is not None:
            if keyword == CURVE:
                return self._curve(call, binding)
            if binding.function is not None:
                return self._function(call, binding)
            return self._numbers(call, binding)
        if keyword == LEFT_OUT:
            self.left_out.append(call)
            return (None,) * len(call.fields)
        self.missing.setdefault(call.routine.upper(), []).append(call)
        return ()

    def _curve(self, call: UserCall, binding: Binding) -> Sequence[Node]:
        """The points of a curve: two of a straight line, or those of a function of Python."""
        count = 2 * len("xyz")
        if binding.function is None and len(binding.numbers) != count:
            self._wrong_count(call, binding, count)
            return ()
        self.bound.append(call)
        if binding.function is None:
            return [line(binding.numbers)]
        function, values = binding.function, _values(call.command)
        given = tuple(each.value for each in call.call.args if isinstance(each, Num))
        try:
            found = traced(lambda alpha: function(given, alpha), values["minpar"], values["maxpar"])
        except Exception as fault:
            text = f"alpha from {values['minpar']:g} to {values['maxpar']:g}"
            self._cannot_read(call, binding, text, f"{type(fault).__name__}: {fault}")
            return ()
        return [found]

    def _function(self, call: UserCall, binding: Binding) -> Sequence[Node]:
        """Calls of a function of Python with what it reads, one for each field."""
        from adamslite.deck.python_routine import Routine

        if isinstance(call.command, Statement) and call.command.numbers_only:
            self.diagnostics.append(diagnose(call.command, "discrete-states", FIELD))
            return ()
        said = len(self.diagnostics)
        inputs = [TIME, *self._read(call, binding)]
        if len(self.diagnostics) > said:
            return ()
        label = f"{call.label} ({call.command.span})"
        given = [each.value for each in call.call.args if isinstance(each, Num)]
        count, number = call.count, Num(float(len(self.given.made)))
        assert binding.function is not None
        self.given.made.append(
            Routine(label, binding.text, binding.function, given, len(inputs), count)
        )
        self.bound.append(call)
        return [Call(USER, (number, Num(float(k)), *inputs)) for k in range(count)]

    def _read(self, call: UserCall, binding: Binding) -> Iterator[Node]:
        """What the function declares that it reads, resolved."""
        parameters = [to_text(each) for each in call.call.args]
        values = {n: v for n, v in _values(call.command).items() if isinstance(v, int | str)}
        for text in getattr(binding.function, "reads", ()):
            try:
                filled = text.format("", *parameters, id=call.command.key, **values)
            except (IndexError, KeyError, ValueError) as fault:
                self._cannot_read(call, binding, text, f"{{{fault}}} is not given")
                continue
            node, reason = self._resolved(filled)
            if node is None:
                self._cannot_read(call, binding, filled, reason)
            else:
                yield node

    def _resolved(self, text: str) -> tuple[Node | None, str]:
        """An expression of the deck; what is wrong with it where it is none."""
        log = Log(Source(text))
        resolver = Resolver(self.names, log)
        known = self.resolver
        resolver.constants, resolver.numbered = known.constants, known.numbered
        tokens = [token for stretch in scan(text) for token in stretch]
        try:
            node = resolver.expression(tokens)
        except Unresolved:
            return None, "; ".join(each.message for each in log.finish())
        return node, ""

    def _cannot_read(self, call: UserCall, binding: Binding, text: str, reason: str) -> None:
        self.diagnostics.append(
            diagnose(
                call.command,
                "user-reads",
                FIELD,
                function=binding.text,
                text=text,
                reason=reason,
            )  # fmt: skip
        )

    def _numbers(self, call: UserCall, binding: Binding) -> Sequence[Node]:
        """A number for each field; a single zero is one for all."""
        numbers, count = binding.numbers, call.count
        if numbers == (0.0,):
            numbers *= count
        if len(numbers) != count:
            self._wrong_count(call, binding, count)
            return ()
        self.bound.append(call)
        return [Num(value) for value in numbers]

    def _wrong_count(self, call: UserCall, binding: Binding, count: int) -> None:
        text, given = binding.text, len(binding.numbers)
        self.diagnostics.append(
            diagnose(call.command, "user-values", FIELD, text=text, count=count, given=given)
        )

    # ---- messages ---------------------------------------------------------------------------

    def _missing(self) -> Iterator[Diagnostic]:
        for calls in self.missing.values():
            first, routine = calls[0], calls[0].routine
            known = f"--user {routine}={INSTALLED}, " if is_installed(routine) else ""
            hint = (
                f"bind it, {known}--user {routine}=module:function or --user {first.label}=number; "
                f"called by\n      " + "\n      ".join(each.listed for each in calls)
            )
            yield self._of(calls, "missing-routine", hint, word=routine)

    def _notes(self) -> Iterator[Diagnostic]:
        if self.bound:
            labels = [each.label for each in self.bound]
            yield self._of(self.bound, "user-bound", bound=self.given.summary(labels))
        if self.left_out:
            labels_left = ", ".join(each.label for each in self.left_out)
            routine = self.left_out[0].routine
            yield self._of(self.left_out, "request-left-out", labels=labels_left, word=routine)

    def _of(self, calls: list[UserCall], code: str, hint: str = "", **words: object) -> Diagnostic:
        """A message about several calls, at the first of them."""
        message = diagnose(calls[0].command, code, FIELD, hint, **words)
        return replace(message, places=tuple(place_of(each.command, FIELD) for each in calls))

    def _mistaken(self) -> Iterator[Diagnostic]:
        """Bindings of statements that do not exist; commands have been read when they are."""
        for kind, word in self.given.statements if self.deck is None else ():
            key: int | str = key_of(word)
            if self.names.find(kind, key) is None:
                hint = did_you_mean(word, self.names.known(kind))
                yield _about(f"{kind}/{word}", f"there is no {kind}/{word}", hint)


def unused_bindings(deck: Deck) -> Iterator[Diagnostic]:
    """Bindings that neither the deck nor its commands have a use for."""
    given = deck.user
    for name in given.unused():
        kind, slash, word = name.partition("/")
        if not slash:
            known = {short_name(each).upper() for each in given.called} | given.called
            hint = did_you_mean(name, known)
            yield _about(name, "no statement calls this routine", hint)
        elif deck.names.find(kind, key_of(word)) is not None:
            yield _about(name, f"{name} has no FUNCTION=USER(...)", "")


def _about(option: str, reason: str, hint: str) -> Diagnostic:
    return compose("unknown-user", NOWHERE, hint=hint, option=option, reason=reason)


def _values(command: Command) -> dict[str, Any]:
    if isinstance(command, Redefinition):
        return dict(command.changes)
    assert isinstance(command, Statement)
    return {name: getattr(command, name) for name in command.arguments}

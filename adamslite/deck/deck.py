"""A deck as typed statements, and reading it.

::

    text --parse--> syntax --two passes--> Deck
                    1. ids and names of all statements      2. arguments and expressions
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cached_property
from itertools import count
from pathlib import Path, PureWindowsPath
from typing import TYPE_CHECKING, Any, overload

import adamslite
from adamslite.deck.brought import brought_by
from adamslite.deck.counted_turns import counted
from adamslite.deck.element_switch import Switch
from adamslite.deck.redefinition import Redefinition, settled
from adamslite.deck.user_bindings import Bindings
from adamslite.language.expression import Num, calls, rebuild
from adamslite.language.function import FUNCTIONS
from adamslite.language.statement import STATEMENTS, expressions

if TYPE_CHECKING:
    from adamslite.deck.names import Names
    from adamslite.deck.redefinition import Command
    from adamslite.language.diagnostics import Diagnostic, Source
    from adamslite.language.expression import Call, Node
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import S, Statement

SETTINGS = ("INTEGRATOR", "EQUILIBRIUM", "KINEMATICS")
ANALYSES = ("SIMULATE", "LINEAR")


class Deck:
    """The statements of a deck.

    Parameters
    ----------
    source : Source
    title : str
        The first line, as it stands.
    statements : tuple of Statement
        In the order of the deck.
    names : Names
        Ids and names of all statements.
    path : Path or None
        The file it came from.
    inactive : frozenset
        (keyword, key) of the elements that are switched off: they contribute nothing.
    """

    def __init__(
        self,
        source: Source,
        title: str,
        statements: tuple[Statement, ...],
        names: Names,
        path: Path | None = None,
        inactive: frozenset[tuple[str, Key]] = frozenset(),
    ) -> None:
        self.source = source
        self.title = title
        self.path = path
        statements = tuple(s.loaded(self.folder) if s.data else s for s in statements)
        self.own = statements
        self.names = names
        self.inactive = inactive
        self.warnings: tuple[Diagnostic, ...] = ()
        self.senvals: dict[Key, float] = {}
        """Of sensors that have triggered, the value of their EVALUATE then, by key."""
        self.turns: tuple[Call, ...] = ()
        """Measures whose full turns count before and after commands have them in statements."""
        self.user = Bindings()
        """What runs in place of routines of the user."""
        self.origin = ""
        """What names all that it was read from, where what is made of it may be kept."""
        self.incomplete: set[str] = set()
        """Keywords of statements with mistakes, which are not among the statements."""
        self.base: Deck | None = None
        """The deck as it was read, where this one has other numbers."""
        self.values: Mapping[str, float] = {}
        """These numbers, by name."""
        self.kept: dict[Any, Any] = {}
        """What was made of it, for the next time; no part of it."""
        self._of: dict[str, list[Statement]] = {}
        self._by_key: dict[tuple[str, Key], Statement] = {}
        self._enter(statements)
        groups, self.overfull = brought_by(statements, self)
        brought = tuple(s for each, group in groups for s in (each, *group))
        self.delays: dict[Call, Key] = {}
        self.statements: tuple[Statement, ...] = brought
        if names.delays:  # few decks have any
            self.delays = delayed(brought, names)
            self.statements += tuple(watched(call, key) for call, key in self.delays.items())
        self._acts_for = {
            (s.keyword, s.key): (each.keyword, each.key)
            for each, group in groups
            for s in group
            if hasattr(s, "loads")
        }
        if len(self.statements) > len(statements):
            self._enter(self.statements)

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "kept": {}}

    def _enter(self, statements: Iterable[Statement]) -> None:
        """Make statements, and no others, known to :meth:`of` and :meth:`find`."""
        self._of, self._by_key = {}, {}
        for each in statements:
            self._of.setdefault(each.keyword, []).append(each)
            self._by_key.setdefault((each.keyword, each.key), each)

    @overload
    def of(self, kind: type[S]) -> list[S]: ...
    @overload
    def of(self, kind: str) -> list[Any]: ...
    def of(self, kind: type[Statement] | str) -> list[Any]:
        """All statements of one kind, in the order of the deck.

        A kind is a class or, where the class is not at hand, its keyword: then no type is known.
        """
        return self._of.get(_keyword(kind), [])

    @overload
    def find(self, kind: type[S], id: Key) -> S | None: ...
    @overload
    def find(self, kind: str, id: Key) -> Any: ...
    def find(self, kind: type[Statement] | str, id: Key) -> Any:
        """The statement of that kind with that id or name; None when there is none."""
        keyword = kind if type(kind) is str else _keyword(kind)
        found = self._by_key.get((keyword, id))
        if found is None and isinstance(id, str):
            found = self._by_key.get((keyword, id.upper()))
        if found is None and isinstance(id, str):
            key = self.names.find(keyword, id.upper())
            found = self._by_key.get((keyword, key)) if isinstance(key, int | str) else None
        return found

    def get(self, kind: type[S], id: Key) -> S:
        """The statement that a reference means: readers have found that there is one."""
        found = self.find(kind, id)
        if found is None:
            raise LookupError(f"there is no {kind.keyword}/{id}")
        return found

    @overload
    def single(self, kind: type[S]) -> S: ...
    @overload
    def single(self, kind: str) -> Any: ...
    def single(self, kind: type[Statement] | str) -> Any:
        """The only statement of that kind; with its defaults when the deck has none."""
        found = self.of(_keyword(kind))
        return found[-1] if found else STATEMENTS[_keyword(kind)]()

    def is_active(self, statement: Statement) -> bool:
        """Whether an element acts; everything does that DEACTIVATE has not named."""
        if not self.inactive:
            return True
        own = statement.keyword, statement.key
        if self._acts_for.get(own, own) in self.inactive:
            return False
        field = statement.acts_with
        if not field:
            return True
        other = self.find(statement.arguments[field].to, getattr(statement, field))
        return other is None or self.is_active(other)

    def parts(self, statement: Statement) -> list[Statement]:
        """The forces that a statement is made of, which act where it does."""
        own = statement.keyword, statement.key
        return [self.find(*key) for key, owner in self._acts_for.items() if owner == own]

    @overload
    def settings(self, kind: type[S]) -> S: ...
    @overload
    def settings(self, kind: str) -> Any: ...
    def settings(self, kind: type[Statement] | str) -> Any:
        """INTEGRATOR, EQUILIBRIUM or KINEMATICS after all statements of that kind."""
        keyword = _keyword(kind)
        return settled(STATEMENTS[keyword], self.of(keyword))

    def after(self, command: Command) -> Deck:
        """The deck once a command has been carried out; SIMULATE and LINEAR do not change it."""
        if isinstance(command, Redefinition):
            return self.redefined(command)
        if isinstance(command, Switch):
            return self.with_active(command.kind, command.elements(self.names), command.on)
        if command.keyword in SETTINGS:
            return self._but(own=(*self.own, command))
        return self

    def redefined(self, command: Redefinition[Any]) -> Deck:
        """The deck with one statement changed; what its constants name follows (KGRAV)."""
        old = self.find(command.keyword, command.key)
        if old is None and not command.of.singleton:
            return self  # the statement has mistakes of its own
        new = command.applied_to(old or command.of())
        own = tuple(new if each is old else each for each in self.own)
        own = own if old else (*own, new)
        constants = {name: v for each in own for name, v in each.constants().items()}
        renewed = own if new.constants() else (new,)
        fresh = {id(each): _with_constants(each, constants) for each in renewed}
        deck = self._but(own=tuple(fresh.get(id(each), each) for each in own))
        return deck.counting(counted(old)) if old is not None else deck

    def counting(self, turns: Iterable[Call]) -> Deck:
        """The deck, with measures whose full turns are counted whether it has them or not."""
        found = tuple(dict.fromkeys((*self.turns, *turns)))
        if found == self.turns:
            return self
        deck = self._but()
        deck.turns = found
        return deck

    def with_more(self, extra: Iterable[Statement]) -> Deck:
        """The deck with further statements."""
        return self._but(own=(*self.own, *extra))

    def with_values(self, values: Mapping[str, float] | Iterable[str]) -> Deck:
        """The deck with other numbers, ``{"SPRINGDAMPER/1.K": 90}``, as if its text had them.

        Raises
        ------
        DeckError
            With the mistakes that it then has.
        UsageError
            When there is no number of a name, or a value is no finite number.
        """
        made: Deck = adamslite.with_values(self, values)
        return made

    def with_statements(self, own: tuple[Statement, ...]) -> Deck:
        """The deck with other statements in the places of its own."""
        return self._but(own=own)

    def with_one(self, statement: Statement) -> Deck:
        """The deck with another statement of its text, in its place."""
        own = sorted((*self.own, statement), key=lambda each: each.spans.whole_range[0])
        return self._but(own=tuple(own))

    def with_active(self, keyword: str, ids: Iterable[Key], on: bool) -> Deck:
        """The deck with elements of one kind switched on or off."""
        named = {(keyword, id.upper() if isinstance(id, str) else id) for id in ids}
        return self._but(inactive=self.inactive - named if on else self.inactive | named)

    def _but(
        self,
        own: tuple[Statement, ...] | None = None,
        inactive: frozenset[tuple[str, Key]] | None = None,
    ) -> Deck:
        statements = self.own if own is None else own
        switched_off = self.inactive if inactive is None else inactive
        deck = Deck(self.source, self.title, statements, self.names, self.path, switched_off)
        deck.warnings, deck.incomplete = self.warnings, self.incomplete
        deck.senvals, deck.user, deck.turns = self.senvals, self.user, self.turns
        return deck

    def with_senvals(self, values: dict[Key, float]) -> Deck:
        """The deck after sensors have triggered, with the values of their EVALUATE."""
        deck = self._but()
        deck.senvals = self.senvals | values
        return deck

    @property
    def folder(self) -> Path:
        """Where the files are that the deck names: beside it; of a text, the current folder."""
        return self.path.parent if self.path else Path()

    def is_called(self, model: str) -> bool:
        """Whether a command file means this deck by a name; a text may have any."""
        name = PureWindowsPath(model).name.casefold()
        return not self.path or name.removesuffix(".adm") == self.path.stem.casefold()

    @property
    def gravity(self) -> tuple[float, float, float]:
        """Acceleration of gravity [length/time^2], in ground."""
        accgrav = self.single("ACCGRAV")
        return accgrav.igrav, accgrav.jgrav, accgrav.kgrav

    @property
    def ucf(self) -> float:
        """The factor in force * UCF = mass * acceleration."""
        return self.single("UNITS").factor

    @property
    def lines(self) -> list[str]:
        """The lines of the text."""
        return self.source.text.split("\n")

    @cached_property
    def hash(self) -> str:
        """SHA-256 of the text, in hexadecimal."""
        from hashlib import sha256

        return sha256(self.source.text.encode()).hexdigest()

    def __repr__(self) -> str:
        return f"<Deck {self.title!r}: {len(self.own)} statements>"

    def _repr_html_(self) -> str:
        """Its check, for a notebook."""
        return adamslite.html(self)


def _keyword(kind: type[Statement] | str) -> str:
    return kind if isinstance(kind, str) else kind.keyword


def _with_constants(statement: Statement, constants: dict[str, float]) -> Statement:
    """The statement with its named numbers brought up to date."""

    def renew(node: Node) -> Node:
        if isinstance(node, Num) and node.name in constants:
            return Num(constants[node.name], node.name)
        return node

    changed: dict[str, Any] = {
        field: rebuild(getattr(statement, field), renew)
        for field, argument in statement.arguments.items()
        if argument.kind == "expression" and getattr(statement, field) is not None
    }
    return replace(statement, **changed) if changed else statement


def delayed(statements: Iterable[Statement], names: Names) -> dict[Call, Key]:
    """Different calls of DELAY, each with a name that no VARIABLE of the deck has."""
    taken = names.ids.get("VARIABLE", {})
    names_of_past = [name for name, function in FUNCTIONS.items() if function.takes_past]
    found = (
        call for each in statements for node in expressions(each)
        for call in calls(node, *names_of_past)
    )  # fmt: skip
    free = (name for n in count(1) if (name := f"DELAY_{n}") not in taken)
    return dict(zip(dict.fromkeys(found), free, strict=False))


def watched(call: Call, key: Key) -> Statement:
    """The VARIABLE whose results are the expression that a call delays."""
    return STATEMENTS["VARIABLE"](id=key, function=call.args[0])

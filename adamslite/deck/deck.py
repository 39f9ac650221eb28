"""A deck as typed statements, and reading it.

::

    text --parse--> syntax --two passes--> Deck
                    1. ids and names of all statements      2. arguments and expressions
"""

from __future__ import annotations

from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

from adamslite.deck.element_switch import Switch
from adamslite.deck.redefinition import Redefinition, settled
from adamslite.gc_pause import uncollected
from adamslite.language.diagnostics import DeckError, Diagnostic, Source
from adamslite.language.expression import Node, Num, rebuild
from adamslite.language.statement import STATEMENTS, Statement
from adamslite.reading.resolver import Key, Names
from adamslite.reading.statement_reader import Reading

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
        self.own = statements
        self.names = names
        self.path = path
        self.inactive = inactive
        self.warnings: tuple[Diagnostic, ...] = ()
        self.incomplete: set[str] = set()
        """Keywords of statements with mistakes, which are not among the statements."""
        self._of: dict[str, list[Statement]] = {}
        self._by_key: dict[tuple[str, Key], Statement] = {}
        self._enter(statements)
        groups = [(each, each.companions(self)) for each in statements]
        self.statements = tuple(s for each, group in groups for s in (each, *group))
        if len(self.statements) > len(statements):
            self._enter(self.statements)

    def _enter(self, statements: Iterable[Statement]) -> None:
        """Make statements, and no others, known to :meth:`of` and :meth:`find`."""
        self._of, self._by_key = {}, {}
        for each in statements:
            self._of.setdefault(each.keyword, []).append(each)
            self._by_key.setdefault((each.keyword, each.key), each)

    def of(self, keyword: str) -> list[Statement]:
        """All statements of one kind, in the order of the deck."""
        return self._of.get(keyword, [])

    def find(self, keyword: str, id: Key) -> Statement | None:
        """The statement of that kind with that id or name; None when there is none."""
        wanted = id.upper() if isinstance(id, str) else id
        found = self._by_key.get((keyword, wanted))
        if found is None and isinstance(wanted, str):
            key = self.names.find(keyword, wanted)
            found = None if isinstance(key, list) else self._by_key.get((keyword, key))
        return found

    def single(self, keyword: str) -> Statement:
        """The only statement of that kind; with its defaults when the deck has none."""
        found = self.of(keyword)
        return found[-1] if found else STATEMENTS[keyword]()

    def is_active(self, statement: Statement) -> bool:
        """Whether an element acts; everything does that DEACTIVATE has not named."""
        return (statement.keyword, statement.key) not in self.inactive

    def settings(self, keyword: str) -> Statement:
        """INTEGRATOR, EQUILIBRIUM or KINEMATICS after all statements of that kind."""
        return settled(STATEMENTS[keyword], self.of(keyword))

    def after(self, command: Any) -> Deck:
        """The deck once a command has been carried out; SIMULATE and LINEAR do not change it."""
        if isinstance(command, Redefinition):
            return self.redefined(command)
        if isinstance(command, Switch):
            return self.with_active(command.kind, command.elements(self.names), command.on)
        if command.keyword in SETTINGS:
            return self._but(own=(*self.own, command))
        return self

    def redefined(self, command: Redefinition) -> Deck:
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
        return self._but(own=tuple(fresh.get(id(each), each) for each in own))

    def with_more(self, extra: Iterable[Statement]) -> Deck:
        """The deck with further statements."""
        return self._but(own=(*self.own, *extra))

    def with_active(self, keyword: str, ids: Iterable[Key], on: bool) -> Deck:
        """The deck with elements of one kind switched on or off."""
        named = {(keyword, id.upper() if isinstance(id, str) else id) for id in ids}
        return self._but(inactive=self.inactive - named if on else self.inactive | named)

    def _but(self, **changes: Any) -> Deck:
        facts = {"own": self.own, "inactive": self.inactive} | changes
        deck = Deck(self.source, self.title, facts["own"], self.names, self.path, facts["inactive"])
        deck.warnings, deck.incomplete = self.warnings, self.incomplete
        return deck

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


def _with_constants(statement: Statement, constants: dict[str, float]) -> Statement:
    """The statement with its named numbers brought up to date."""

    def renew(node: Node) -> Node:
        known = type(node) is Num and node.name in constants
        return Num(constants[node.name], node.name) if known else node

    changed = {
        field: rebuild(getattr(statement, field), renew)
        for field, argument in statement.arguments.items()
        if argument.kind == "expression" and getattr(statement, field) is not None
    }
    return replace(statement, **changed) if changed else statement


def read(source: str | Path) -> Deck:
    """Read a deck.

    Parameters
    ----------
    source : str or Path
        A file, or the text of a deck (a string with more than one line).

    Returns
    -------
    Deck
        Its ``warnings`` hold what is legal but looks wrong.

    Raises
    ------
    DeckError
        With every mistake of the deck.
    OSError
        When the file cannot be read.
    """
    from adamslite.checks.bodies_and_elements import RULES

    text, path = _load(source)
    end_of_title = text.find("\n") if "\n" in text else len(text)
    title = text[:end_of_title]
    reading = Reading(Source(text, str(path or "<text>")), Names(), "deck")
    reading.title(title)
    with uncollected():
        statements = reading.statements(end_of_title)
        deck = Deck(reading.log.source, title, statements, reading.names, path)
        deck.warnings = _judged(deck, reading, RULES)
    return deck


class Commands(tuple[Any, ...]):
    """Commands in their order: statements, and :class:`Redefinition` for those that change one."""

    warnings: tuple[Diagnostic, ...] = ()


def read_commands(source: str | Path, deck: Deck) -> Commands:
    """Read a command file (.acf) for a deck; parameters and errors as for :func:`read`.

    The deck is checked as the commands leave it before each analysis and at the end.
    """
    from adamslite.checks.runs import RUN_RULES, inputs_with_rates

    text, path = _load(source)
    reading = Reading(Source(text, str(path or "<commands>")), deck.names, "command", deck)
    commands = Commands(reading.statements(0))
    plain = tuple(each for each in commands if isinstance(each, Statement))
    run = Deck(reading.log.source, "", plain, deck.names, path)
    reading.log.diagnostics += [*_caused(deck, commands), *inputs_with_rates(deck, plain)]
    commands.warnings = _judged(run, reading, RUN_RULES)
    return commands


def _caused(deck: Deck, commands: Iterable[Any]) -> list[Diagnostic]:
    """What is wrong with the deck because of commands."""
    from adamslite.checks.bodies_and_elements import RULES
    from adamslite.checks.rule import apply
    from adamslite.checks.runs import late_start_values

    if not any(isinstance(command, Redefinition) for command in commands):
        return []
    known = set(apply(RULES, deck))
    found: dict[Diagnostic, None] = {}
    unchecked = started = False
    for command in (*commands, None):
        if isinstance(command, Redefinition):
            deck, unchecked = deck.redefined(command), True
            if started:
                found |= dict.fromkeys(late_start_values(command))
        elif unchecked and (command is None or command.keyword in ANALYSES):
            found |= dict.fromkeys(each for each in apply(RULES, deck) if each not in known)
            unchecked = False
        started = started or getattr(command, "keyword", "") == "SIMULATE"
    return list(found)


def _judged(deck: Deck, reading: Reading, rules: Sequence[Any]) -> tuple[Diagnostic, ...]:
    """What reading and rules have to say; raises when there are errors."""
    from adamslite.checks.rule import apply

    deck.incomplete |= reading.broken
    diagnostics = [*reading.log.finish(), *apply(rules, deck)]
    if any(diagnostic.is_error for diagnostic in diagnostics):
        raise DeckError(diagnostics, deck)
    return tuple(diagnostics)


def decoded(data: bytes) -> str:
    """The text of a file: UTF-16 where it begins as such, else UTF-8, else Latin-1."""
    wide = data[:2] in (BOM_UTF16_LE, BOM_UTF16_BE)
    try:
        return data.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _load(source: str | Path) -> tuple[str, Path | None]:
    """Text with ``\\n`` line ends, and the file it came from."""
    path = None
    if isinstance(source, Path) or "\n" not in source:
        path = Path(source)
        source = decoded(path.read_bytes())
    return source.replace("\r\n", "\n").replace("\r", "\n"), path

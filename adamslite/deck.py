"""A deck as typed statements, and reading it.

::

    text --parse--> syntax --two passes--> Deck
                    1. ids and names of all statements      2. arguments and expressions
"""

from __future__ import annotations

import gc
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import Any

from adamslite.diagnostics import DeckError, Diagnostic, Source
from adamslite.reading import Reading
from adamslite.resolve import Key, Names
from adamslite.statement import STATEMENTS, Statement


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
    """

    def __init__(
        self,
        source: Source,
        title: str,
        statements: tuple[Statement, ...],
        names: Names,
        path: Path | None = None,
    ) -> None:
        self.source = source
        self.title = title
        self.statements = statements
        self.names = names
        self.path = path
        self.warnings: tuple[Diagnostic, ...] = ()
        self.incomplete: set[str] = set()
        """Keywords of statements with mistakes, which are not among the statements."""
        self._of: dict[str, list[Statement]] = {}
        self._by_key: dict[tuple[str, Key], Statement] = {}
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
    from adamslite.check import RULES

    text, path = _load(source)
    end_of_title = text.find("\n") if "\n" in text else len(text)
    title = text[:end_of_title]
    reading = Reading(Source(text, str(path or "<text>")), Names(), "deck")
    reading.title(title)
    with _no_collection():
        statements = reading.statements(end_of_title)
        deck = Deck(reading.log.source, title, statements, reading.names, path)
        deck.warnings = _judged(deck, reading, RULES)
    return deck


def read_commands(source: str | Path, deck: Deck) -> tuple[Statement, ...]:
    """Read a command file (.acf) for a deck; parameters and errors as for :func:`read`."""
    from adamslite.check import RUN_RULES

    text, path = _load(source)
    reading = Reading(Source(text, str(path or "<commands>")), deck.names, "command")
    statements = reading.statements(0)
    _judged(Deck(reading.log.source, "", statements, deck.names, path), reading, RUN_RULES)
    return statements


@contextmanager
def _no_collection() -> Iterator[None]:
    """No garbage collection inside: reading only makes things, and it would take a fifth longer."""
    if not gc.isenabled():
        yield
        return
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def _judged(deck: Deck, reading: Reading, rules: Sequence[Any]) -> tuple[Diagnostic, ...]:
    """What reading and rules have to say; raises when there are errors."""
    from adamslite.check import apply

    deck.incomplete = reading.broken
    diagnostics = [*reading.log.finish(), *apply(rules, deck)]
    if any(diagnostic.is_error for diagnostic in diagnostics):
        raise DeckError(diagnostics)
    return tuple(diagnostics)


def _load(source: str | Path) -> tuple[str, Path | None]:
    """Text with ``\\n`` line ends, and the file it came from."""
    path = None
    if isinstance(source, Path) or "\n" not in source:
        path = Path(source)
        data = path.read_bytes()
        try:
            source = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            source = data.decode("latin-1")
    return source.replace("\r\n", "\n").replace("\r", "\n"), path

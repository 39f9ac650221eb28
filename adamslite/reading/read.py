"""From the text of a deck or of a command file to statements, checked."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from adamslite.checks.inert import note_of_inert, untouched
from adamslite.checks.linear_systems import determined_at_rest, late_start_numbers
from adamslite.checks.rule import Rule, apply
from adamslite.checks.rules import RULES
from adamslite.checks.runs import (
    RUN_RULES,
    fixed_lists,
    inputs_with_rates,
    late_start_values,
    names_of_files,
)
from adamslite.deck.commands import Commands
from adamslite.deck.deck import ANALYSES, Deck
from adamslite.deck.named_places import with_named
from adamslite.deck.names import Names
from adamslite.deck.redefinition import Command, Redefinition
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.deck.user_bindings import Bindings, Given, bindings
from adamslite.elements.file import File
from adamslite.gc_pause import without_collection
from adamslite.language.diagnostics import DeckError, Diagnostic, Source
from adamslite.language.file_name import is_file_name
from adamslite.language.messages.ignoring import judged, without_ignored
from adamslite.language.statement import Statement
from adamslite.language.text import MOST, NamedText, contents, decoded, text_of
from adamslite.reading.half_read import further_mistakes
from adamslite.reading.numbers import Given as Values
from adamslite.reading.numbers import edited
from adamslite.reading.statement_reader import Reading
from adamslite.reading.unjudged import bound, unjudged

# Work for finding out what commands make of a deck: so many statements are judged by all rules,
# about.  A change of one statement counts a fifth of the deck.
MOST_JUDGED = 100_000
# What rules take without any statement, as statements.
LEAST_JUDGED = 20


def read(
    source: str | Path,
    user: Mapping[str, Given] | Iterable[str] | None = None,
    values: Values = (),
) -> Deck:
    """Read a deck.

    Parameters
    ----------
    source : str or Path
        A file, or the text of a deck (a string with more than one line).
    user : mapping or list of str
        What is bound to routines that are no part of the deck: ``{"VARIABLE/1": 0.0}``, or texts
        ``"VARIABLE/1=0"``; see :mod:`adamslite.deck.user_bindings`.
    values : mapping or list of str
        Numbers to put into the text: ``{"SPRINGDAMPER/1.K": 90}``, or ``"SPRINGDAMPER/1.K=90"``;
        see :mod:`adamslite.reading.numbers`.

    Returns
    -------
    Deck
        Its ``warnings`` hold what is legal but looks wrong; :func:`adamslite.check` leaves out
        what comments of the deck ignore.

    Raises
    ------
    DeckError
        With every mistake of the deck.
    OSError
        When the file cannot be read.
    UsageError
        When there is no number of a name in ``values``.
    """

    given = bindings(user)
    text, path = _load(source)
    name = source.name if isinstance(source, NamedText) else str(path or "<text>")
    if values:
        text = edited(Source(text, name), path, values, given)
    return read_by(Reading(Source(text, name), Names(), "deck"), path, given)


def read_by(reading: Reading, path: Path | None, given: Bindings) -> Deck:
    """The deck that a reading yields; parameters and errors as for :func:`read`."""
    with without_collection():
        deck = unjudged(reading, path, given)
        deck.warnings = _judged(deck, reading, RULES, deck)
    return deck


def read_commands(source: str | Path, deck: Deck) -> Commands:
    """Read a command file (.acf) for a deck; parameters and errors as for :func:`read`.

    The deck is checked as the commands leave it before each analysis and at the end.
    """

    text, path = _load(source)
    return commands_of(Source(text, str(path or "<commands>")), deck, path)


def commands_of(source: Source, deck: Deck, path: Path | None = None) -> Commands:
    """The commands of a text; see :func:`read_commands`."""
    with without_collection():
        return _commands_of(source, deck, path)


def _commands_of(source: Source, deck: Deck, path: Path | None) -> Commands:
    reading = Reading(source, deck.names, "command", deck)
    read = reading.statements(reading.names_on_top())
    commands = Commands(bound(read, reading, deck.user, deck))
    plain = tuple(each for each in commands if isinstance(each, Statement))
    run = Deck(reading.log.source, "", plain, deck.names, path)
    for each in (
        *without_ignored(deck.source, _caused(deck, commands)),
        *inputs_with_rates(deck, plain),
        *names_of_files(deck, plain),
        *determined_at_rest(deck, plain),
        *note_of_inert(untouched(deck, commands)),
    ):
        reading.log.take(each)
    found = _judged(run, reading, RUN_RULES, deck)
    named = [each.output_prefix or "" for each in plain if isinstance(each, File)]
    commands.source = reading.log.source
    commands.prefix = [reading.prefix, *filter(is_file_name, named)][-1]
    commands.warnings = tuple(judged(run.source, found, complete=True))
    return commands


def _caused(deck: Deck, commands: Iterable[Command]) -> list[Diagnostic]:
    """What is wrong with the deck because of commands."""

    if not any(isinstance(command, Redefinition) for command in commands):
        return []
    known = set(apply(RULES, deck))
    found: dict[Diagnostic, None] = {}
    unchecked = started = False
    left = float(MOST_JUDGED)
    for command in (*commands, None):
        cost = LEAST_JUDGED + len(deck.own)
        if isinstance(command, Redefinition):
            left -= cost / 5
            if left < 0:
                return [*found, diagnose(command, "changes-not-checked")]
            deck, unchecked = deck.redefined(command), True
            found |= dict.fromkeys(fixed_lists(command))
            if started:
                found |= dict.fromkeys(late_start_values(command))
                found |= dict.fromkeys(late_start_numbers(deck, command))
        elif unchecked and (command is None or command.keyword in ANALYSES):
            left -= cost
            found |= dict.fromkeys(each for each in apply(RULES, deck) if each not in known)
            unchecked = False
        started = started or getattr(command, "keyword", "") in ANALYSES
    return list(found)


def _judged(
    deck: Deck, reading: Reading, rules: Sequence[Rule], named: Deck
) -> tuple[Diagnostic, ...]:
    """What reading and rules have to say; raises when there are errors.

    ``named``: the deck that has the statements which messages name.
    """
    deck.incomplete |= reading.broken
    log = reading.log
    for each in apply(rules, deck):
        log.take(each)
    for each in further_mistakes(() if log.full else reading.half_read, rules, deck):
        log.take(each)
    diagnostics = with_named(named, log.finish())
    if any(diagnostic.is_error for diagnostic in diagnostics):
        raise DeckError(judged(deck.source, diagnostics, complete=False), deck)
    return tuple(diagnostics)


def _load(source: str | Path) -> tuple[str, Path | None]:
    """Text with ``\\n`` line ends, and the file it came from."""
    if isinstance(source, Path) or "\n" not in source:
        path = Path(source)
        return text_of(decoded(contents(path, MOST))), path
    return text_of(source), None

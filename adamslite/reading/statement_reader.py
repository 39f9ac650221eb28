"""The two passes that turn a text into statements.

The first finds keyword and id of every statement, so that references may point forward; the second
reads arguments and expressions.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from adamslite.deck.deck import Deck
from adamslite.deck.names import Names
from adamslite.deck.redefinition import Command, Redefinition
from adamslite.elements.part import Part
from adamslite.language.abbreviations import PREFERRED, Ambiguous, match, vocabulary
from adamslite.language.diagnostics import MOST, Source, Spans
from adamslite.language.file_name import is_file_name
from adamslite.language.interfaces import Key
from adamslite.language.messages import Log
from adamslite.language.not_supported import COMMANDS as PLANNED_COMMANDS
from adamslite.language.not_supported import STATEMENTS as PLANNED_STATEMENTS
from adamslite.language.statement import STATEMENTS, Statement
from adamslite.reading.argument_grouping import Read, read_arguments
from adamslite.reading.argument_values import ValueReader, to_id
from adamslite.reading.entries import Body, Entry, canonical, gives_values
from adamslite.reading.half_read import half_read
from adamslite.reading.patterns import Patterns
from adamslite.reading.resolver import Resolver
from adamslite.syntax.lines import join
from adamslite.syntax.syntax_errors import Faults, Syntax, Waiting, statement_syntax
from adamslite.syntax.tokens import Tokens, end_of, scan

# A line that begins as a statement does.
BEGINNING = re.compile(r"^[ \t]*(\w+)[ \t]*/", re.MULTILINE)

# The word that begins a line; the rest of the form where it begins as statements do.
FIRST_WORD = re.compile(r"[ \t]*([A-Za-z]\w*)[ \t]*(/[ \t]*(?:\w+[ \t]*)?(?:[,=!;]|$))?")

# Names at the top of a command file: of the model, of the output.
MOST_NAMES = 2
# What a line with a name has none of.
MARKS = re.compile(r"[/=,;]")


def known_keywords(place: str) -> dict[str, type[Statement] | str]:
    """What may be written in a deck or a command file; those that cannot be read as words."""
    commands = place == "command"
    here = {k: c for k, c in STATEMENTS.items() if commands or c.place != "command"}
    planned = PLANNED_STATEMENTS | PLANNED_COMMANDS if commands else PLANNED_STATEMENTS
    return {name: name for name in planned} | here


class Reading:
    """Reads one text.

    Parameters
    ----------
    source : Source
    names : Names
        Filled by the first pass; those of the deck when commands are read.
    place : str
        ``"deck"`` or ``"command"``.
    deck : Deck
        The deck commands are for.
    """

    def __init__(self, source: Source, names: Names, place: str, deck: Deck | None = None) -> None:
        self.log = Log(source)
        self.names = names
        self.place = place
        self.deck = deck
        self.entries: list[Entry] = []
        self.broken: set[str] = set()
        """Keywords of statements that could not be read, or not wholly."""
        self.half_read: list[Statement] = []
        self.resolver = Resolver(names, self.log)
        self.patterns = Patterns(names, source)
        self.prefix = ""
        """Of output files, at the top of a command file."""
        self._body: Body | None = None
        self._guesses: list[tuple[str, Syntax]] = []
        self._started: dict[str, int] = {}
        self._kinds: dict[tuple[str, ...], tuple[str, ...]] = {}
        self._meanings: dict[str, type[Statement] | str | Ambiguous | None] = {}
        self._table = known_keywords(place)

    def title(self) -> tuple[str, int]:
        """The title, and where it ends.

        It is the first line, or the one after blank lines unless that begins as a statement.  A
        deck whose first line is a statement has none.
        """
        text = self.log.source.text
        first = text.partition("\n")[0]
        blank = 0 if first.strip() else len(text) - len(text.lstrip())
        line = text[blank:].partition("\n")[0] if blank else first
        word = FIRST_WORD.match(line)
        known = word is not None and word[1].upper() in STATEMENTS
        if blank and word and not known and not word[2]:
            return line, blank + len(line)
        if not blank and word and known and word[2]:
            self.log.add("missing-title", *word.span(1), word=word[1])
            return "", 0
        return first, len(first)

    def names_on_top(self) -> int:
        """Where the bare names at the top of a command file end: that of the model, and after it
        the prefix of the output files.

        A first line that is blank says that there is none, so that a keyword below it is a command.
        """
        text, end = self.log.source.text, 0
        blank = not text.partition("\n")[0].strip()
        names = start = 0
        while names < MOST_NAMES and start < len(text):
            line = text[start:].partition("\n")[0]
            word = line.partition("!")[0].strip()
            first, start = start, start + len(line) + 1
            if not word and (line.strip() or not names):
                continue
            if not word or MARKS.search(word) or word.upper() == "STOP":
                break
            if blank and not names and self._means(word.upper()):
                break
            if not names and self.deck and not self.deck.is_called(word):
                at = first + line.index(word)
                self.log.add("other-model", at, at + len(word), word=word)
            if names and is_file_name(word):
                self.prefix = word
            elif names:
                at = first + line.index(word)
                self.log.add("prefix-unused", at, at + len(word), word=word)
            names, end = names + 1, start
        return min(end, len(text))

    def statements(self, start: int) -> tuple[Command, ...]:
        """All statements from offset ``start`` on; those with mistakes are left out."""
        for syntax, found in self._syntax(start):
            cls = self._class(syntax) if syntax else None
            for mistake, tokens in found if not (cls and cls.ignored) else ():
                first, last = tokens[mistake.first], tokens[mistake.last]
                self.log.add(mistake.code, first[2], end_of(last), **mistake.words)
            if syntax and cls is not None:
                listed = self.place == "command" and not cls.ignored
                self._enter(cls, self._without_list(syntax) if listed else syntax)
                if cls.ends:
                    self._behind_end(syntax.range[1])
                    break
            if self.log.overflows:
                self._give_up(syntax.tokens if syntax else found[-1][1])
                break
        for keyword, syntax in self._guesses:
            self._remember(keyword, syntax)
        return self._second_pass()

    def _syntax(self, start: int) -> Iterator[tuple[Syntax | None, Faults]]:
        """The syntax of each statement and the mistakes in it."""
        tokens = scan(self.log.source.text, start)
        return map(statement_syntax, join(tokens, ampersand=self.place == "command"))

    def _without_list(self, syntax: Syntax) -> Syntax:
        """A command without the word LIST, which is passed over as if it were one of its own."""
        bare = [item for item in syntax.items if item.key < 0 and item.end - item.start == 1]
        named = [item for item in bare if syntax.tokens[item.start][1].upper() == "LIST"]
        for item in named:
            word = syntax._replace(tokens=[syntax.tokens[item.start]], items=())
            self.entries.append(Entry(STATEMENTS["LIST"], self._waiting(word), 0, None))
        return syntax._replace(items=tuple(each for each in syntax.items if each not in named))

    def _give_up(self, tokens: Tokens) -> None:
        """Read nothing behind these tokens; any statement may be there."""
        self.log.last_line, _ = self.log.source.place(tokens[-1][2])
        self.broken |= STATEMENTS.keys()

    def _behind_end(self, start: int) -> None:
        """Warn of the first statement behind END; whatever else stands there is no concern."""
        for found in BEGINNING.finditer(self.log.source.text, start):
            if found[1].upper() in STATEMENTS:
                self.log.add("after-end", *found.span(1), word=found[1])
                return

    # ---- first pass ---------------------------------------------------------------------------

    def _class(self, syntax: Syntax) -> type[Statement] | None:
        """The class of a statement; None, with a message, when it cannot be read."""
        token = syntax.tokens[0]
        word = token[1]
        if word not in self._meanings:
            self._meanings[word] = self._means(syntax.keyword)
        found = self._meanings[word]
        place = token[2], end_of(token)
        if isinstance(found, type):
            return found
        if isinstance(found, str):
            self.log.tally("planned-statement", found, *place, word=found)
            self._remember(found, syntax)
        elif isinstance(found, Ambiguous):
            choices = " or ".join(found.choices)
            self.log.add("ambiguous-statement", *place, word=word, choices=choices)
        elif syntax.keyword in STATEMENTS:
            self.log.add("command-in-deck", *place, word=syntax.keyword)
        else:
            self._unknown(syntax, place)
        return None

    def _means(self, keyword: str) -> type[Statement] | str | Ambiguous | None:
        """What a word in capitals is an abbreviation of."""
        return match(PREFERRED.get(keyword, keyword), self._table)

    def _changes(self, cls: type[Statement]) -> bool:
        """Whether a statement of this class changes one of the deck."""
        return self.place == "command" and cls.place == "deck"

    def _unknown(self, syntax: Syntax, place: tuple[int, int]) -> None:
        hint = self.log.guesses.meant(syntax.keyword, "", lambda: self._table)
        self.log.add("unknown-statement", *place, word=syntax.tokens[0][1], hint=hint)
        for keyword in hint.strip("?").split():
            if keyword in STATEMENTS:
                self.broken.add(keyword)
                self._guesses.append((keyword, syntax))
                if STATEMENTS[keyword].body:
                    self._body = (keyword, None)

    def _remember(self, keyword: str, syntax: Syntax) -> None:
        """Note the id of a statement that is not read, so that references to it are no mistakes."""
        self.broken.add(keyword)
        first = syntax.items[0] if syntax.items else None
        id = to_id(syntax.tokens[first.start : first.end]) if first else None
        if id is not None:
            self.names.add(keyword, canonical(id), syntax.name, syntax.tokens[0][2])

    def _enter(self, cls: type[Statement], syntax: Syntax) -> None:
        if self._changes(cls):
            self._enter_change(cls, syntax)
            return
        start = syntax.tokens[0][2]
        if cls.singleton:
            first = self._started.setdefault(cls.keyword, start)
            again = first != start and not cls.repeatable
            if again:
                line, _ = self.log.source.place(first)
                words, end = {"word": cls.keyword, "line": line}, first + len(cls.keyword)
                self.log.say("duplicate-statement", syntax.range, words, first=(first, end))
            self.entries.append(Entry(cls, self._waiting(syntax), 0, None, again))
            return
        id = self._id(cls, syntax)
        if id is None:
            self.broken.add(cls.keyword)
            return
        key = canonical(id)
        again = not self.names.add(cls.keyword, key, syntax.name, start)
        entry = Entry(cls, self._waiting(syntax), id, self._body, again)
        if again:
            line, _ = self.log.source.place(self.names.ids[cls.keyword][key])
            end = end_of(syntax.tokens[syntax.items[0].end - 1])
            self.log.add("duplicate-id", start, end, label=entry.label, line=line)
        if cls.body:
            self._body = (cls.keyword, key)
        self.entries.append(entry)

    def _waiting(self, syntax: Syntax) -> Waiting:
        """The syntax until the second pass."""
        return Waiting.of(syntax, self._kinds)

    def _enter_change(self, cls: type[Statement], syntax: Syntax) -> None:
        """A command that changes the statement of its id, which must exist."""
        id = 0 if cls.singleton else self._id(cls, syntax)
        if id is None:
            return
        found = 0 if cls.singleton else self.names.find(cls.keyword, canonical(id))
        tokens = syntax.tokens
        if isinstance(found, list):
            place = tokens[syntax.items[0].start][2], end_of(tokens[syntax.items[0].end - 1])
            labels = ", ".join(f"{cls.keyword}/{key}" for key in found[:5])
            self.log.add("ambiguous-name", *place, word=id, labels=labels)
        elif found is not None:
            if not cls.singleton:
                first = syntax.items[0]
                place = tokens[first.start][2], end_of(tokens[first.end - 1])
                self.names.used(cls.keyword, found, *place)
            self.entries.append(Entry(cls, self._waiting(syntax), found, None, changes=True))
        elif self.deck and cls.keyword not in self.deck.incomplete:
            end = end_of(tokens[syntax.items[0].end - 1])
            self.log.missing(self.names, cls.keyword, id, tokens[0][2], end)

    def _id(self, cls: type[Statement], syntax: Syntax) -> Key | None:
        """The id of a statement; None, with a message, when there is none."""
        first = syntax.items[0] if syntax.items else None
        if first is None or first.key >= 0:
            if syntax.whole or cls.ignored:
                self.log.add("missing-id", *syntax.range, word=cls.keyword)
            return None
        tokens = syntax.tokens[first.start : first.end]
        id = to_id(tokens)
        if id is None or id == 0:
            start, end = tokens[0][2], end_of(tokens[-1])
            self.log.add("bad-id", start, end, text=self.log.source.text[start:end])
            return None
        return id

    # ---- second pass --------------------------------------------------------------------------

    def _second_pass(self) -> tuple[Command, ...]:
        resolver = self.resolver
        reader = ValueReader(self.names, resolver, self.log, self._ground)
        made: dict[int, Command | None] = {}
        for number, entry in enumerate(self.entries):
            if gives_values(entry.cls):
                made[number] = self._statement(entry, reader)
        for giver in filter(gives_values, STATEMENTS.values()):
            known = self.deck.of(giver) if self.deck else []
            given = [each for each in made.values() if type(each) is giver]
            for each in (giver(), *known, *given) if giver.singleton else (*known, *given):
                resolver.constants |= each.constants()
                resolver.numbered[each.keyword, each.key] = each.numbered()
        for number, entry in enumerate(self.entries):
            if number not in made:
                made[number] = self._statement(entry, reader)
        self.entries.clear()  # their tokens are most of what reading takes
        return tuple(each for _, each in sorted(made.items()) if each is not None)

    def _ground(self) -> Key | None:
        """The id of the ground part, which may stand later in the deck."""
        if self.deck:
            return next((part.key for part in self.deck.of(Part) if part.ground), None)
        for entry in self.entries:
            if entry.cls.body and "ground" in entry.cls.arguments:
                words = vocabulary(entry.cls)
                syntax = entry.syntax.syntax
                for item in syntax.items[1:]:
                    word = syntax.tokens[item.start][1]
                    if item.key < 0 and words.flag(word) == words.bare["GROUND"]:
                        return canonical(entry.id)
        return None

    def _as_written(self, entry: Entry) -> dict[str, object]:
        """The arguments of a statement that only keeps its text."""
        if "written" not in entry.cls.field_names or entry.changes:
            return {}
        start, end = entry.syntax.range
        _, _, written = self.log.source.text[start:end].partition("/")
        return {"written": written.strip()}

    def _statement(self, entry: Entry, reader: ValueReader) -> Command | None:
        """The statement with its arguments; None when something is wrong with it."""
        cls, read = entry.cls, self._arguments(entry, reader)
        if read is None:
            return None
        if entry.changes:
            return Redefinition(of=cls, key=entry.id, changes=read.values, spans=read.spans)
        made = cls(**self._fields(entry, read))
        if read.called is not None:
            made.__dict__["called"] = read.called  # what it would find out by itself
        return made

    def _fields(self, entry: Entry, read: Read) -> dict[str, object]:
        """Everything that a statement is made from."""
        own = {"id": entry.id, "name": entry.syntax.name, "spans": read.spans}
        return {**read.values, **entry.cls.completed(read.values, entry.body), **own}

    def _arguments(self, entry: Entry, reader: ValueReader) -> Read | None:
        """The arguments of a statement and where they are written; None when something is wrong."""
        cls, waiting, patterns = entry.cls, entry.syntax, self.patterns
        if cls.ignored or cls.ends:
            return Read(self._as_written(entry), Spans(self.log.source, waiting.range))
        common = waiting.whole and not entry.again and not entry.changes
        key = patterns.key(waiting, cls.singleton)
        fitted = patterns.fitted(key, waiting) if common else None
        if fitted:
            return fitted
        syntax = waiting.syntax
        errors, messages = self.log.errors, self.log.count
        items = syntax.items if cls.singleton else syntax.items[1:]
        read = read_arguments(cls, syntax, items, reader, entry.label, entry.changes)
        spans = Spans(self.log.source, syntax.range, read.ranges)
        if self.log.errors != errors or entry.again or not syntax.whole:
            self.broken.add(cls.keyword)
            if not (entry.again or entry.changes or len(self.half_read) >= MOST):
                fields = self._fields(entry, Read(read.values, spans))
                self.half_read.append(half_read(cls, fields, read.unread))
            return None
        if common and messages == self.log.count and patterns.wanted(key):
            patterns.learn(key, syntax.tokens, read.found, read.values)
        return Read(read.values, spans)

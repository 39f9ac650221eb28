"""What may be written at the cursor: statements, arguments, options, ids, functions and names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from adamslite.deck.names import RESERVED
from adamslite.editing.document import Content
from adamslite.editing.outline import statements
from adamslite.language.abbreviations import PREFERRED, match, vocabulary
from adamslite.language.function import FUNCTIONS
from adamslite.language.messages import MESSAGES
from adamslite.language.spelling import spelled
from adamslite.language.statement import Argument, Statement
from adamslite.language.text import COMMENT
from adamslite.reading.statement_reader import known_keywords
from adamslite.syntax.syntax_errors import open_brackets
from adamslite.syntax.tokens import CLOSES, Tokens

STATEMENT, ARGUMENT, OPTION, ID, FUNCTION, VARIABLE, MESSAGE = range(7)
"""Kinds of suggestions."""
LISTS = ("references", "ids")


class Suggestion(NamedTuple):
    """A word, its kind, a few words about it, and what is inserted if that is another text."""

    word: str
    kind: int
    detail: str = ""
    inserted: str = ""


def completion(content: Content, offset: int) -> list[Suggestion]:
    """Everything that may be written at an offset; the editor filters it by what is written."""
    line = content.source.line(content.source.place(offset)[0])
    before = line[: content.source.place(offset)[1] - 1]
    if "!" in before:
        return list(_codes()) if COMMENT.search(before) else []
    start, _ = content.stretch(offset)
    written = [*statements(content.text, start, offset, content.place)]
    tokens = written[-1].tokens if written and before.strip() else []
    tokens = _without_word(tokens, offset)
    if len(tokens) < 2:
        return list(_statements(content))
    keyword = spelled(tokens[0][1]).upper()
    cls = match(PREFERRED.get(keyword, keyword), known_keywords(content.place))
    if not isinstance(cls, type):
        return []
    return list(_inside(content, cls, tokens))


def _without_word(tokens: Tokens, offset: int) -> Tokens:
    """The tokens before the word that is being written."""
    if not tokens:
        return tokens
    kind, text, start = tokens[-1]
    return tokens[:-1] if kind in ("NAME", "NUMBER") and start + len(text) >= offset else tokens


def _inside(content: Content, cls: type[Statement], tokens: Tokens) -> Iterator[Suggestion]:
    """Suggestions behind the slash of a statement."""
    if not cls.singleton and len(tokens) == 2:
        if content.place == "command" and cls.place == "deck":
            yield from _ids(content, cls.keyword)
        return
    last = [token[0] for token in tokens[-2:]]
    closed = "BACKSLASH" in last and last[-1] in ("BACKSLASH", "COMMA")
    argument = None if closed else _argument_at(cls, tokens)
    opened = open_brackets(tokens)
    ready = bool(opened) or last[-1] != "COMMA"
    if argument and argument.kind == "expression":
        yield from _expression(content, tokens, opened)
    elif argument and (ready or argument.kind in LISTS):
        yield from _values(content, argument)
    if last[-1] in ("COMMA", "BACKSLASH", "SLASH") and not (argument and ready):
        yield from _arguments(cls, tokens)


def _argument_at(cls: type[Statement], tokens: Tokens) -> Argument | None:
    """The argument whose value the end of the tokens is in."""
    words = vocabulary(cls)
    depth = 0
    for number in range(len(tokens) - 1, 1, -1):
        kind = tokens[number][0]
        depth += (kind in CLOSES.values()) - (kind in CLOSES)
        if kind == "EQUAL" and depth <= 0:
            meaning = words.keyed(tokens[number - 1][1])
            return meaning if isinstance(meaning, Argument) else None
    return None


def _expression(content: Content, tokens: Tokens, opened: list[int]) -> Iterator[Suggestion]:
    """Inside an expression: ids where a function takes one, else functions and names."""
    if opened and (function := FUNCTIONS.get(spelled(tokens[opened[-1] - 1][1]).upper())):
        depth = count = 0
        for kind, _, _ in tokens[opened[-1] + 1 :]:
            depth += (kind in CLOSES) - (kind in CLOSES.values())
            count += depth == 0 and kind in ("COMMA", "COLON")
        if function.parameters and (kind_of_id := function.parameter(count).statement):
            yield from _ids(content, kind_of_id)
            return
    for each in FUNCTIONS.values():
        yield Suggestion(each.name, FUNCTION, each.usage, f"{each.name}(")
    for word in RESERVED:
        yield Suggestion(word, VARIABLE)
    for suggestion in _ids(content, "VARIABLE"):
        if not suggestion.word.isdigit():
            yield suggestion._replace(kind=VARIABLE)


def _values(content: Content, argument: Argument) -> Iterator[Suggestion]:
    for option in argument.supported or argument.options:
        yield Suggestion(option, OPTION)
    if argument.to:
        yield from _ids(content, argument.to)


def _ids(content: Content, kind: str) -> Iterator[Suggestion]:
    """The ids and names of the statements of a kind; names as they are written."""
    names = content.names.views.get(kind, {})
    called = {keys[0]: word for word, keys in names.items() if len(keys) == 1}
    for key in content.names.ids.get(kind, ()):
        statement = content.deck.find(kind, key) if content.deck else None
        place = content.definitions.get((kind, key))
        written = content.text[place.start : place.end] if place else ""
        word = written or str(statement.id if statement else key)
        yield Suggestion(word, ID, f"{kind}/{word} {called.get(key, '')}".rstrip())


def _statements(content: Content) -> Iterator[Suggestion]:
    for keyword, cls in known_keywords(content.place).items():
        if isinstance(cls, type):
            yield Suggestion(keyword, STATEMENT, "", keyword if cls.ends else f"{keyword}/")


def _arguments(cls: type[Statement], tokens: Tokens) -> Iterator[Suggestion]:
    """Arguments that are not given yet."""
    words = vocabulary(cls)
    pairs = zip(tokens, tokens[1:], strict=False)
    given = {id(words.keyed(token[1])) for token, behind in pairs if behind[0] == "EQUAL"}
    for argument in cls.arguments.values():
        if argument.kind == "flag" or argument.bare:
            for option in argument.keys or argument.supported or argument.options:
                yield Suggestion(option, OPTION, argument.help)
        elif id(argument) not in given:
            yield Suggestion(argument.key, ARGUMENT, argument.help, f"{argument.key}=")


def _codes() -> Iterable[Suggestion]:
    for code, entry in MESSAGES.items():
        if entry.severity != "error":
            yield Suggestion(code, MESSAGE, entry.sentence)

"""A diagnostic about a statement, about one of its arguments, or about a call inside one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias

from adamslite.deck.redefinition import Redefinition
from adamslite.language.interfaces import key_of
from adamslite.language.messages import compose
from adamslite.language.messages.fixes import NEEDLESS, left_out
from adamslite.language.spelling import spelled
from adamslite.language.statement import Statement
from adamslite.syntax.tokens import CLOSES, end_of, scan

if TYPE_CHECKING:
    from adamslite.language.diagnostics import Diagnostic, Span, Spans
    from adamslite.language.interfaces import Key
    from adamslite.syntax.tokens import Lexeme

# Labels in a message about several statements.
MOST_LISTED = 6

Owner: TypeAlias = Statement | Redefinition[Any]


def diagnose(
    statement: Owner, code: str, field: str = "", hint: str = "", **words: object
) -> Diagnostic:
    """A message about a statement, or about one of its arguments."""
    return _at(statement, code, field, place_of(statement, field), hint, words)


def diagnose_all(statements: Sequence[Owner], code: str, **words: object) -> Diagnostic:
    """One message about several statements, at the first; all of them are among its places.

    ``listed`` in its text are the labels of the first few of them.
    """
    places = tuple(place_of(each) for each in statements)
    more = f" and {len(places) - MOST_LISTED} more" if len(places) > MOST_LISTED else ""
    words.setdefault("listed", ", ".join(each.label for each in statements[:MOST_LISTED]) + more)
    return replace(_at(statements[0], code, "", places[0], "", words), places=places)


def diagnose_inside(
    statement: Owner, at: Key, code: str, field: str = "", **words: object
) -> Diagnostic:
    """A message about a call inside an expression.

    ``at`` is the name of the function, or a name, an id or a label in the call.  Without a field
    all expressions of the statement are searched.
    """
    word = str(at).rpartition("/")[2].upper()
    given = [field] if field else _expressions(statement)
    places = (_inside(statement.spans.home(each), each, word) for each in given)
    place = next(filter(None, places), place_of(statement, field))
    return _at(statement, code, field, place, "", words)


def diagnose_within(
    statement: Owner, field: str, place: tuple[int, int], code: str, **words: object
) -> Diagnostic:
    """A message about some characters of an argument, counted from its beginning."""
    spans = statement.spans.home(field)
    start, _ = spans.ranges[field]
    span = spans.source.span(start + place[0], start + place[1]) if spans.source else spans.whole
    return _at(statement, code, field, span, "", words)


def _at(
    statement: Owner, code: str, field: str, span: Span, hint: str, words: Mapping[str, object]
) -> Diagnostic:
    spans = statement.spans.home(field)
    message = compose(code, span, spans.quote(span), hint, label=statement.label, **words)
    if code in NEEDLESS and field in spans and spans.source:
        found = left_out(spans.source, *spans.ranges[field])
        return replace(message, fixes=(found,)) if found else message
    return message


def place_of(statement: Owner, field: str = "") -> Span:
    """Where one of the arguments stands, as far as it does; else the whole statement."""
    spans = statement.spans.home(field)
    return spans[field] if field in spans else spans.whole


def _expressions(statement: Owner) -> list[str]:
    """The fields that are given and are expressions."""
    cls = statement.of if isinstance(statement, Redefinition) else type(statement)
    # One that another statement brings with it has the places of that one.
    known = cls.arguments
    return [n for n in statement.spans if n in known and known[n].kind == "expression"]


def _inside(spans: Spans, field: str, word: str) -> Span | None:
    """The first call of a function of that name, or with that id, else the word itself."""
    source, text = spans.source, spans.text(field)
    if not text or source is None:
        return None
    start, _ = spans.ranges[field]
    key, _, _ = text.partition("=")
    tokens = [token for stretch in scan(text) for token in stretch if token[2] > len(key)]
    opened: list[int] = []
    for number, token in enumerate(tokens):
        if token[0] in CLOSES:
            opened.append(number)
        elif token[0] in CLOSES.values() and opened:
            opened.pop()
        elif _is_word(token, word):
            called = number + 1 < len(tokens) and tokens[number + 1][0] in CLOSES
            inner = bool(opened and opened[-1] and tokens[opened[-1] - 1][0] == "NAME")
            first = number if called or not inner else opened[-1] - 1
            last = _closing(tokens, first + 1) if called or inner else number
            return source.span(start + tokens[first][2], start + end_of(tokens[last]))
    return None


def _is_word(token: Lexeme, word: str) -> bool:
    kind, text, _ = token
    if kind == "NUMBER":
        return text.isdecimal() and key_of(text) == key_of(word)
    return kind == "NAME" and spelled(text).upper() == word


def _closing(tokens: list[Lexeme], opening: int) -> int:
    """The number of the bracket that closes the one of that number."""
    depth = 0
    for number in range(opening, len(tokens)):
        depth += (tokens[number][0] in CLOSES) - (tokens[number][0] in CLOSES.values())
        if depth == 0:
            return number
    return len(tokens) - 1

"""The page about the word under the cursor: a statement, an argument, a function, an id."""

from __future__ import annotations

import re

from adamslite.editing.document import Content
from adamslite.editing.outline import Written
from adamslite.language.abbreviations import Ambiguous, vocabulary
from adamslite.language.function import FUNCTIONS
from adamslite.language.messages import MESSAGES
from adamslite.language.spelling import spelled
from adamslite.language.statement import Argument
from adamslite.language.text import COMMENT
from adamslite.manual.functions import function as function_page
from adamslite.manual.messages import message
from adamslite.manual.statements import argument
from adamslite.manual.statements import statement as statement_page
from adamslite.syntax.tokens import CLOSES, Lexeme, end_of

WORD = re.compile(r"[\w-]+")


def hover(content: Content, offset: int) -> tuple[str, int, int] | None:
    """A page in Markdown and the offsets of the word that it is about; None where there is none."""
    line = content.source.line(content.source.place(offset)[0])
    if found := _message(content, offset, line):
        return found
    written = content.statement_at(offset)
    number = (
        next((n for n, t in enumerate(written.tokens) if t[2] <= offset < end_of(t)), None)
        if written
        else None
    )
    if written is None or number is None:
        return None
    token = written.tokens[number]
    page = _page(content, written, number)
    return (page, token[2], end_of(token)) if page else None


def _message(content: Content, offset: int, line: str) -> tuple[str, int, int] | None:
    """The page of the message whose code a comment names."""
    start = offset - content.source.place(offset)[1] + 1
    comment = COMMENT.search(line)
    for word in WORD.finditer(line, comment.start(1)) if comment else ():
        code = word[0].lower()
        if word.start() <= offset - start < word.end() and code in MESSAGES:
            return message(code, MESSAGES[code]), start + word.start(), start + word.end()
    return None


def _page(content: Content, written: Written, number: int) -> str | None:
    token = written.tokens[number]
    behind = written.tokens[number + 1][0] if number + 1 < len(written.tokens) else ""
    if number == 0:
        return statement_page(written.cls) if written.cls else None
    if behind == "EQUAL" and written.cls:
        meaning = vocabulary(written.cls).keyed(token[1])
        return argument(meaning) if isinstance(meaning, Argument) else None
    function = FUNCTIONS.get(spelled(token[1]).upper()) if token[0] == "NAME" else None
    if function and behind in CLOSES:
        return function_page(function)
    return _symbol(content, token) or (_flag(written, token) if written.cls else None)


def _symbol(content: Content, token: Lexeme) -> str | None:
    """The definition of the statement that an id means."""
    use = content.symbol_at(token[2])
    statement = content.deck.find(use.kind, use.key) if use and content.deck else None
    if statement is None or not statement.span.line:
        return None
    start, end = statement.spans.whole_range
    called = (statement.name or "").replace("`", "'")  # its name is no Markdown
    name = f"{statement.label} is called `{called}`\n\n" if called else ""
    assert content.deck
    text = content.deck.source.text[start:end]
    fence = "```"
    while fence in text:
        fence += "`"
    return f"{name}{fence}adams\n{text}\n{fence}\n"


def _flag(written: Written, token: Lexeme) -> str | None:
    assert written.cls
    meaning = vocabulary(written.cls).flag(token[1]) if token[0] == "NAME" else None
    if meaning is None or isinstance(meaning, Ambiguous):
        return None
    return argument(meaning[0])

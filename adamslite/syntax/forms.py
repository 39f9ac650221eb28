"""From text to syntax: tokens, statements, the form of a statement and of an expression.

::

    text --scan--> tokens --join--> statements --statement_form--> items
                                                --expression_form--> tree of token numbers

The grammar files say what tokens and forms are.  A deck holds thousands of statements of few forms,
so the parser sees each sequence of token *kinds* once; the form it returns refers to tokens by
number and serves every statement written the same way.  Tokens carry their offset in the text, so
joining continuation lines moves no column.
"""

from __future__ import annotations

import pickle
import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from functools import cache, lru_cache
from hashlib import sha256
from io import BytesIO
from itertools import accumulate
from pathlib import Path
from sys import intern
from typing import Any, NamedTuple

import lark
from lark import Lark, Token, Transformer
from lark.exceptions import UnexpectedToken
from lark.lexer import Lexer

from adamslite import resources
from adamslite.caching.entries import recall

Lexeme = tuple[str, str, int]
"""Kind, text and offset of a token."""

Tree = tuple
"""An expression: ``(rule, number of its token, branch, branch ...)``."""

CLOSES = {"LPAR": "RPAR", "LSQB": "RSQB"}
OPERATORS = {"PLUS": "+", "MINUS": "-", "STAR": "*", "SLASH": "/", "POWER": "**"}
"""Kinds of tokens that are operators, and what these are called in an expression."""

_JOINTS = {"LINE_END", "SEMICOLON", "AMPERSAND", "COMMENT", *CLOSES, *CLOSES.values()}


class Fault(NamedTuple):
    """Where a form breaks: the number of the first token that does not fit, or of the end."""

    at: int


class Item(NamedTuple):
    """One item of a statement by token numbers: ``key`` (-1: none), value ``start`` to ``end``.

    ``closed`` tells that a backslash follows.
    """

    key: int
    start: int
    end: int
    closed: bool


class Logical(NamedTuple):
    """The tokens of one statement, joined from its lines; ``name`` is its adams_view_name."""

    tokens: list[Lexeme]
    name: str | None


def end_of(token: Lexeme) -> int:
    """Offset one past the last character of a token."""
    return token[2] + len(token[1])


# ---- the parsers ------------------------------------------------------------------------------


class _Replay(Lexer):
    """Hands token kinds to the parser; each token knows its number."""

    def __init__(self, conf: Any) -> None:
        pass

    def lex(self, kinds: Sequence[str]) -> Iterator[Token]:
        for number, kind in enumerate(kinds):
            yield Token(kind, "", start_pos=number)


class _Forms(Transformer):
    """Builds items and trees while parsing."""

    def item(self, tokens: list[Token]) -> Item:
        first, last = tokens[0].start_pos, tokens[-1].start_pos
        if len(tokens) > 1 and tokens[1].type == "EQUAL":
            return Item(first, first + 2, last + 1, False)
        return Item(-1, first, last + 1, False)

    def separator(self, tokens: list[Token]) -> Token:
        return tokens[0]

    def statement(self, children: list[Any]) -> tuple[Item, ...]:
        items: list[Item] = []
        for child in children:
            if isinstance(child, Item):
                items.append(child)
            elif child.type == "BACKSLASH":
                items[-1] = items[-1]._replace(closed=True)
        return tuple(items)

    def operation(self, children: list[Any]) -> Tree:
        left, token, right = children
        return ("operation", token.start_pos, left, right)

    def negation(self, children: list[Any]) -> Tree:
        return ("negation", children[0].start_pos, children[1])

    def same(self, children: list[Any]) -> Tree:
        return children[1]

    def number(self, children: list[Token]) -> Tree:
        return ("number", children[0].start_pos)

    def name(self, children: list[Token]) -> Tree:
        return ("name", children[0].start_pos)

    def arguments(self, children: list[Any]) -> tuple[str, list[Tree]]:
        separators = "".join(":" if c.type == "COLON" else "," for c in children[1::2])
        return separators, children[::2]

    def call(self, children: list[Any]) -> Tree:
        separators, branches = children[2] if len(children) == 4 else ("", [])
        return ("call", children[0].start_pos, separators, *branches)


FORM = {"parser": "lalr", "lexer": _Replay, "keep_all_tokens": True}


@cache
def _parser(grammar: str, start: str) -> Lark:
    """The parser of ``grammar/<grammar>.lark``, built when first needed; its tables are kept."""
    folder = resources.find("grammar")

    def tables() -> bytes:
        found = BytesIO()
        Lark.open(str(folder / f"{grammar}.lark"), start=start, **FORM).save(found)
        return found.getvalue()

    kept = pickle.loads(recall(f"{grammar}{_grammars(folder)}.parser", tables))
    return Lark._load_from_dict(kept["data"], kept["memo"], transformer=_Forms())


@cache
def _grammars(folder: Path) -> str:
    """Digest of what parser tables are made from: the grammars, which import each other, and Lark.

    The tables name classes of this module, so it belongs to them.
    """
    files = sorted(folder.glob("*.lark"))
    texts = [each.read_bytes() for each in (*files, Path(__file__))]
    versions = f"{lark.__version__} {sys.implementation.cache_tag}".encode()
    return sha256(b"\0".join((versions, *texts))).hexdigest()[:32]


def _form(parser: Lark, kinds: tuple[str, ...]) -> Any:
    try:
        return parser.parse(kinds)
    except UnexpectedToken as unexpected:
        at = unexpected.token.start_pos
        return Fault(len(kinds) if unexpected.token.type == "$END" else at)


@lru_cache(maxsize=8192)
def statement_form(kinds: tuple[str, ...]) -> tuple[Item, ...] | Fault:
    """The items of a statement from the kinds of its tokens."""
    return _form(_parser("deck", "statement"), kinds)


@lru_cache(maxsize=8192)
def expression_form(kinds: tuple[str, ...]) -> Tree | Fault:
    """The tree of an expression from the kinds of its tokens."""
    return _form(_parser("expression", "expression"), kinds)


# ---- scanning ---------------------------------------------------------------------------------


STRETCH = 1 << 15
"""Characters that are scanned at once, at least."""

_NEW_STATEMENT = re.compile(r"\n(?=[A-Za-z])")
"""Where a text may be cut: a line that begins with a letter continues no other."""


@cache
def _terminals() -> dict[str, str]:
    """Regular expressions of the terminals of the deck grammar, in the order of the file."""
    found = {t.name: t.pattern.to_regexp() for t in _parser("deck", "statement").terminals}
    return {"BLANK": found.pop("BLANK"), **found}


@cache
def _scanner() -> re.Pattern[str]:
    """All terminals in one pattern, without groups, so that it finds whole tokens."""
    one = "|".join(f"(?:{regexp})" for regexp in _terminals().values())
    return re.compile(re.sub(r"(?<!\\)\((?!\?)", "(?:", one))


@cache
def _teller() -> re.Pattern[str]:
    return re.compile("|".join(f"(?P<{name}>{regexp})" for name, regexp in _terminals().items()))


class _Kinds(dict[str, str]):
    """The kind of each token, which its text decides; found out once for equal texts."""

    def __missing__(self, text: str) -> str:
        kind = self[text] = _teller().match(text).lastgroup
        return kind


def scan(text: str, start: int = 0) -> Iterator[list[Lexeme]]:
    """The tokens of ``text`` from offset ``start``; any character belongs to some token.

    They come in stretches that end where a statement ends, so that they need not all be in memory.
    """
    kinds = _Kinds()
    while start < len(text):
        cut = _NEW_STATEMENT.search(text, start + STRETCH)
        end = cut.end() if cut else len(text)
        words = [*map(intern, _scanner().findall(text, start, end))]
        offsets = accumulate(map(len, words), initial=start)
        tokens = zip(map(kinds.__getitem__, words), words, offsets, strict=False)
        yield [token for token in tokens if token[0] != "BLANK"]
        start = end


# ---- joining lines ----------------------------------------------------------------------------


class _Joiner:
    """Collects the tokens of a statement until it ends."""

    def __init__(self, ampersand: bool) -> None:
        self.ampersand = ampersand
        self.tokens: list[Lexeme] = []
        self.current: list[Lexeme] = []
        self.depth = 0
        self.name: str | None = None

    def statements(self, stretches: Iterable[list[Lexeme]]) -> Iterator[Logical]:
        for self.tokens in stretches:
            yield from self._ended()
        yield from self._finish()

    def _ended(self) -> Iterator[Logical]:
        """The statements that end in the present stretch."""
        tokens, done = self.tokens, 0
        for at in [n for n, token in enumerate(tokens) if token[0] in _JOINTS]:
            if at < done:
                continue
            self.current += tokens[done:at]
            kind, text, _ = tokens[at]
            done = at + 1
            if kind == "LINE_END" and self.current and self._kind(done) == "COMMA":
                self._leading_comma(done)
                done += 1
            elif kind == "LINE_END" or kind == "SEMICOLON":
                yield from self._finish()
                self.name = view_name(text)
            else:
                done = self._joint(tokens[at], done)
        self.current += tokens[done:]

    def _kind(self, position: int) -> str:
        return self.tokens[position][0] if position < len(self.tokens) else ""

    def _joint(self, token: Lexeme, position: int) -> int:
        """A bracket, an ampersand or a last comment; returns where to go on."""
        kind = token[0]
        if kind == "AMPERSAND" and self.ampersand and self._kind(position) == "LINE_END":
            position += 1
            if self.current and self._kind(position) == "COMMA":
                self._leading_comma(position)
                position += 1
        elif kind != "COMMENT":
            self.depth = max(0, self.depth + (kind in CLOSES) - (kind in CLOSES.values()))
            self.current.append(token)
        return position

    def _leading_comma(self, position: int) -> None:
        """The comma that begins a continuation line: a separator, or nothing but a mark."""
        current, last = self.current, self.current[-1]
        argument = self._kind(position + 1) == "NAME" and self._kind(position + 2) == "EQUAL"
        if last[0] == "SLASH" and len(current) > 2 and argument:
            current[-1] = ("BACKSLASH", *last[1:])
        elif last[0] == "COMMA":
            if len(current) > 1 and (current[-2][0] in OPERATORS or current[-2][0] in CLOSES):
                current.pop()
        elif last[0] != "EQUAL" and (self.depth == 0 or argument):
            current.append(self.tokens[position])
        if argument:
            self.depth = 0

    def _finish(self) -> Iterator[Logical]:
        current, name = self.current, self.name
        if len(current) > 2 and current[-1][0] == "SLASH":
            current.pop()
        self.current, self.depth, self.name = [], 0, None
        if current:
            yield Logical(current, name)


def join(stretches: Iterable[list[Lexeme]], ampersand: bool = False) -> Iterator[Logical]:
    """The statements in stretches of tokens.

    A line that begins with a comma continues the statement above it.  In a list of arguments that
    comma separates; inside brackets, and after a comma or an equal sign, it only marks the
    continuation.  A comma at the end of a line vanishes too after an operator or an opening
    bracket.  A slash at the end of a line that an argument or nothing follows is the old form of
    the backslash.

    Parameters
    ----------
    stretches : iterable of list of Lexeme
        As :func:`scan` gives them.
    ampersand : bool
        Whether ``&`` at the end of a line continues it, as in command files.
    """
    return _Joiner(ampersand).statements(stretches)


def view_name(comments: str) -> str | None:
    """The name given by an ``! adams_view_name='...'`` comment on the lines before a statement."""
    if "adams_view_name" not in comments.lower():
        return None
    for line in reversed(comments.splitlines()):
        word, _, rest = line.strip("! \t").partition("=")
        if word.strip().lower() == "adams_view_name" and rest.count("'") >= 2:
            return rest.split("'")[1].strip() or None
        if word and not word.lower().startswith("adams_view"):
            return None
    return None

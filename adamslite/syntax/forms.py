"""The grammars: the form of a statement and of an expression.

::

    kinds of tokens --statement_form--> items        kinds --expression_form--> tree

The grammar files say what tokens and forms are.  A deck holds thousands of statements of few forms,
so the parser sees each sequence of token *kinds* once; the form it returns refers to tokens by
number and serves every statement written the same way.
"""

from __future__ import annotations

import pickle
import re
import sys
from array import array
from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import cache, lru_cache
from hashlib import sha256
from io import BytesIO
from itertools import accumulate, count
from pathlib import Path
from typing import Any, NamedTuple

import lark
from lark import Lark, Transformer
from lark.exceptions import UnexpectedToken
from lark.lexer import Lexer

from adamslite import resources
from adamslite.caching.entries import recall

Tree = tuple[Any, ...]
"""An expression: ``(rule, number of its token, branch, branch ...)``."""


HEAD = ("NAME", "SLASH")
LONG, PIECE = 24, 256
"""Tokens of a statement above which it is parsed piece by piece, and of a piece, at least."""
MOST_OPEN = 1000
"""Brackets inside each other; expressions of so many are rejected in any case."""
BRACKETS = {"LPAR": 1, "LSQB": 1, "RPAR": -1, "RSQB": -1}
CODES = defaultdict(lambda: "x", {
    "LPAR": "(", "LSQB": "[", "RPAR": ")", "RSQB": "]", "COMMA": ",", **dict.fromkeys(
        "NAME NUMBER QUOTED PLUS MINUS POWER STAR SLASH COLON OTHER".split(), "a"
    )
})  # fmt: skip
"""Kinds of tokens as letters: brackets, commas, and values, which may follow each other."""
CUTS = defaultdict(lambda: "a", {"COMMA": ",", "BACKSLASH": ";", **dict.fromkeys(BRACKETS, "|")})
"""The same where a statement may be cut."""
BETWEEN, EITHER = re.compile(r"(?<![,;])[,;](?=[^,])"), re.compile(r"\|")
"""A separator between items, and a bracket."""
CLOSED_BY = {"(": ")", "[": "]"}
TURNS = re.compile(r"[()\[\]]|x+")
"""Brackets, and what may not be inside them."""


def runs(least: int) -> tuple[re.Pattern[str], re.Pattern[str]]:
    """So many values or more: with commas between them, as inside brackets, and without."""
    return re.compile(f"[a,]{{{least},}}+"), re.compile(f"a{{{least},}}+")


RUN, VALUES = runs(8)


class Fault(NamedTuple):
    """Where a form breaks: the number of the first token that does not fit, or of the end."""

    at: int


class Item(NamedTuple):
    """One item of a statement by token numbers: ``key`` (-1: none), value ``start`` to ``end``.

    ``closed``: a backslash follows.
    """

    key: int
    start: int
    end: int
    closed: bool


class Items(Sequence[Item]):
    """The items of a long statement in a tenth of the memory of a tuple; slices have no steps."""

    __slots__ = ("numbers",)

    def __init__(self, numbers: array[int] | None = None) -> None:
        self.numbers = array("i") if numbers is None else numbers

    def add(self, key: int, start: int, end: int, closed: bool) -> None:
        """One more item."""
        self.numbers.extend((key, start, end, closed))

    def __len__(self) -> int:
        return len(self.numbers) // 4

    def __iter__(self) -> Iterator[Item]:
        each = iter(self.numbers)
        for key, start, end, closed in zip(each, each, each, each, strict=True):
            yield Item(key, start, end, bool(closed))

    def __getitem__(self, at: Any) -> Any:
        if isinstance(at, slice):
            start, stop, _ = at.indices(len(self))
            return Items(self.numbers[4 * start : 4 * stop])
        first = 4 * range(len(self))[at]
        key, start, end, closed = self.numbers[first : first + 4]
        return Item(key, start, end, bool(closed))


class _Token:
    """A token as far as the parser looks at it; it is made in a third of the time of Lark's own."""

    __slots__ = ("start_pos", "type")

    line = column = end_line = end_column = end_pos = 0

    def __init__(self, kind: str, number: int) -> None:
        self.type, self.start_pos = kind, number


class _Replay(Lexer):
    """Hands token kinds to the parser; each token knows its number."""

    def __init__(self, conf: object) -> None:
        pass

    # A lexer that parses no text receives what the parser was given, whatever Lark's types say.
    def lex(self, kinds: Sequence[str]) -> Iterator[_Token]:  # type: ignore[override]
        return map(_Token, kinds, count())


class _Forms(Transformer[_Token, Any]):
    """Builds items and trees while parsing."""

    def item(self, tokens: list[_Token]) -> Item:
        first, last = tokens[0].start_pos, tokens[-1].start_pos
        if len(tokens) > 1 and tokens[1].type == "EQUAL":
            return Item(first, first + 2, last + 1, False)
        return Item(-1, first, last + 1, False)

    def separator(self, tokens: list[_Token]) -> _Token:
        return tokens[0]

    def statement(self, children: list[Item | _Token]) -> tuple[Item, ...]:
        items: list[Item] = []
        for child in children:
            if isinstance(child, Item):
                items.append(child)
            elif child.type == "BACKSLASH":
                items[-1] = items[-1]._replace(closed=True)
        return tuple(items)

    def operation(self, children: tuple[Tree, _Token, Tree]) -> Tree:
        left, token, right = children
        return ("operation", token.start_pos, left, right)

    def negation(self, children: tuple[_Token, Tree]) -> Tree:
        return ("negation", children[0].start_pos, children[1])

    def same(self, children: tuple[_Token, Tree, _Token]) -> Tree:
        return children[1]

    def number(self, children: list[_Token]) -> Tree:
        return ("number", children[0].start_pos)

    def name(self, children: list[_Token]) -> Tree:
        return ("name", children[0].start_pos)

    def arguments(self, children: list[Any]) -> tuple[str, list[Tree]]:
        separators = "".join(":" if c.type == "COLON" else "," for c in children[1::2])
        return separators, children[::2]

    def call(self, children: list[Any]) -> Tree:
        separators, branches = children[2] if len(children) == 4 else ("", [])
        return ("call", children[0].start_pos, separators, *branches)


FORM: dict[str, Any] = {"parser": "lalr", "lexer": _Replay, "keep_all_tokens": True}


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
    """What :class:`_Forms` makes of the whole, or where the kinds do not fit."""
    try:
        return parser.parse(kinds)
    except UnexpectedToken as unexpected:
        at = unexpected.token.start_pos
        return Fault(len(kinds) if unexpected.token.type == "$END" else at)


def statement_form(kinds: tuple[str, ...]) -> Sequence[Item] | Fault:
    """The items of a statement from the kinds of its tokens."""
    return _short_form(kinds) if len(kinds) <= LONG else _long_form(kinds)


@lru_cache(maxsize=8192)
def _short_form(kinds: tuple[str, ...]) -> tuple[Item, ...] | Fault:
    """The items of a statement that is parsed as a whole, kept for others like it."""
    return _parsed(kinds)


def _parsed(kinds: tuple[str, ...]) -> tuple[Item, ...] | Fault:
    """The items of a statement that is parsed as a whole."""
    found: tuple[Item, ...] | Fault = _form(_parser("deck", "statement"), kinds)
    return found


def _long_form(kinds: tuple[str, ...]) -> Items | Fault:
    """The items of a statement of any length, parsed piece by piece.

    Between two commas outside of brackets lie items that are those of a shorter statement; of many
    values without a comma between them, which are one item, the parser sees the first and the last.
    """
    if kinds[:2] != HEAD:
        return Fault(int(kinds[0] == HEAD[0]))
    deep = _too_deep(kinds)
    if deep is not None:
        before = statement_form(kinds[:deep])
        return Fault(min(deep, before.at)) if isinstance(before, Fault) else Fault(deep)
    code = "".join(map(CODES.__getitem__, kinds))
    flat = _flat(code)
    seen = _without_runs(flat)
    if len(seen) == len(kinds):
        shorter = kinds
    else:
        shorter = tuple([kinds[n] if flat[n] == code[n] else "NUMBER" for n in seen])
    items = Items()
    start = len(HEAD)
    for end, following in _ends(shorter):
        piece = HEAD + shorter[start:end]
        form = _short_form(piece) if len(piece) <= 2 * PIECE else _parsed(piece)
        shift = start - len(HEAD)
        if isinstance(form, Fault):
            at = form.at + shift
            return Fault(seen[at] if at < len(seen) else len(kinds))
        for key, first, last, closed in form:
            key = key if key < 0 else seen[key + shift]
            items.add(key, seen[first + shift], seen[last + shift - 1] + 1, closed)
        start = following
    return items


def _too_deep(kinds: tuple[str, ...]) -> int | None:
    """The number of the bracket that is one too many inside each other."""
    if kinds.count("LPAR") + kinds.count("LSQB") <= MOST_OPEN:
        return None
    opened = accumulate(BRACKETS.get(kind, 0) for kind in kinds)
    return next((at for at, depth in enumerate(opened) if depth > MOST_OPEN), None)


def _flat(code: str) -> str:
    """Kinds as letters where a bracket with only values in it is a value, however deep it is."""
    opened: list[int] = []
    closed: list[tuple[int, int]] = []
    for turn in TURNS.finditer(code):
        at, sign = turn.start(), turn[0]
        if sign in CLOSED_BY:
            opened.append(at)
        elif opened and CLOSED_BY[code[opened[-1]]] == sign:
            first = opened.pop()
            while closed and closed[-1][0] > first:
                closed.pop()
            closed.append((first, at + 1))
        else:
            opened.clear()
    pieces: list[str] = []
    done = 0
    for first, end in closed:
        pieces += code[done:first], "a" * (end - first)
        done = end
    return "".join([*pieces, code[done:]]) if closed else code


def _without_runs(code: str) -> Sequence[int]:
    """Numbers of the tokens without those inside long runs of values, where each may be any."""
    seen: list[int] = []
    done = counted = depth = 0
    for run in RUN.finditer(code, len(HEAD)):
        start, end = run.span()
        depth += sum(code.count(each, counted, start) for each in "([")
        depth -= sum(code.count(each, counted, start) for each in ")]")
        counted = start
        for inner in (run,) if depth > 0 else VALUES.finditer(code, start, end):
            seen += range(done, inner.start() + 1)
            done = inner.end() - 1
    return [*seen, *range(done, len(code))] if seen else range(len(code))


def _ends(kinds: tuple[str, ...]) -> Iterator[tuple[int, int]]:
    """Where pieces of a statement end and the next ones begin: at separators between items, and
    at its own end.  A backslash belongs to the item before it.
    """
    code = "".join(map(CUTS.__getitem__, kinds))
    depth, least, end = 0, len(HEAD) + PIECE, len(kinds)
    brackets = ((turn.start(), BRACKETS[kinds[turn.start()]]) for turn in EITHER.finditer(code))
    for turn, deeper in (*brackets, (end, 0)):
        # One more letter is seen, which may not be a comma.
        while depth == 0 and (found := BETWEEN.search(code, least, turn + 1)):
            at = found.start()
            yield at + (kinds[at] == "BACKSLASH"), at + 1
            least = at + PIECE
        depth, least = depth + deeper, max(least, turn + 1)
    yield end, end


@lru_cache(maxsize=8192)
def expression_form(kinds: tuple[str, ...]) -> Tree | Fault:
    """The tree of an expression from the kinds of its tokens."""
    return _form(_parser("expression", "expression"), kinds)


@cache
def terminals() -> dict[str, str]:
    """Regular expressions of the terminals of the deck grammar, in the order of the file."""
    found = {t.name: t.pattern.to_regexp() for t in _parser("deck", "statement").terminals}
    return {"BLANK": found.pop("BLANK"), **found}

"""The grammars: the form of a statement and of an expression.

::

    kinds of tokens --statement_form--> items        kinds --expression_form--> tree

The grammar files say what tokens and forms are.  A deck holds thousands of statements of few forms,
so the parser sees each sequence of token *kinds* once; the form it returns refers to tokens by
number and serves every statement written the same way.
"""

from __future__ import annotations

import re
from array import array
from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import cache, lru_cache
from hashlib import sha256
from itertools import accumulate
from pathlib import Path
from typing import Any, NamedTuple

from adamslite import resources
from adamslite.caching.entries import recall
from adamslite.syntax import parser_tables
from adamslite.syntax.parser_tables import Tables, Unexpected, made, parse

Tree = tuple[Any, ...]
"""An expression: ``(rule, number of its token, branch, branch ...)``."""


DECK = "deck", "statement"
"""The grammar of statements and its start."""
HEAD = ("NAME", "SLASH")
LONG, PIECE = 512, 256
"""Tokens of a statement above which it is parsed piece by piece, and of a piece."""
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


RUN, VALUES = runs(99)


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


class _Forms:
    """Builds items and trees of tokens, which are given by their numbers."""

    def __init__(self, kinds: Sequence[str]) -> None:
        self.kinds = kinds

    def item(self, tokens: list[int]) -> Item:
        first, end = tokens[0], tokens[-1] + 1
        if len(tokens) > 1 and self.kinds[tokens[1]] == "EQUAL":
            return Item(first, first + 2, end, False)
        return Item(-1, first, end, False)

    def separator(self, tokens: list[int]) -> int:
        return tokens[0]

    def statement(self, children: list[Item | int]) -> tuple[Item, ...]:
        items: list[Item] = []
        for child in children:
            if isinstance(child, Item):
                items.append(child)
            elif self.kinds[child] == "BACKSLASH":
                items[-1] = items[-1]._replace(closed=True)
        return tuple(items)

    def operation(self, children: tuple[Tree, int, Tree]) -> Tree:
        left, token, right = children
        return ("operation", token, left, right)

    def negation(self, children: tuple[int, Tree]) -> Tree:
        return ("negation", children[0], children[1])

    def same(self, children: tuple[int, Tree, int]) -> Tree:
        return children[1]

    def number(self, children: list[int]) -> Tree:
        return ("number", children[0])

    def name(self, children: list[int]) -> Tree:
        return ("name", children[0])

    def arguments(self, children: list[Any]) -> tuple[str, list[Tree]]:
        separators = "".join(":" if self.kinds[c] == "COLON" else "," for c in children[1::2])
        return separators, children[::2]

    def call(self, children: list[Any]) -> Tree:
        separators, branches = children[2] if len(children) == 4 else ("", [])
        return ("call", children[0], separators, *branches)


@cache
def _parser(grammar: str, start: str) -> Tables:
    """The tables of ``grammar/<grammar>.lark``, made when first needed and kept."""
    folder = resources.find("grammar")
    name = f"{grammar}{_grammars(folder)}.parser"
    return Tables.kept(recall(name, lambda: made(folder / f"{grammar}.lark", start).content))


@cache
def _grammars(folder: Path) -> str:
    """Digest of what parser tables are made from: code and grammars, which import each other."""
    files = [*sorted(folder.glob("*.lark")), Path(parser_tables.__file__)]
    return sha256(b"\0".join(each.read_bytes() for each in files)).hexdigest()[:32]


def _form(parser: Tables, kinds: tuple[str, ...]) -> Any:
    """What :class:`_Forms` makes of the whole, or where the kinds do not fit."""
    try:
        return parse(parser, kinds, _Forms(kinds))
    except Unexpected as unexpected:
        return Fault(unexpected.args[0])


def statement_form(kinds: tuple[str, ...]) -> Sequence[Item] | Fault:
    """The items of a statement from the kinds of its tokens."""
    return _short_form(kinds) if len(kinds) <= LONG else _long_form(kinds)


@lru_cache(maxsize=8192)
def _short_form(kinds: tuple[str, ...]) -> tuple[Item, ...] | Fault:
    """The items of a statement that is parsed as a whole."""
    return _form(_parser(*DECK), kinds)


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
        form = _short_form(piece) if len(piece) <= LONG else _form(_parser(*DECK), piece)
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
    found = dict(_parser(*DECK).terminals)
    return {"BLANK": found.pop("BLANK"), **found}

"""Messages and positions for statements and expressions without a valid form.

A faulty item is cut out of its statement and the rest is read on, so that one slip does not hide
the others.
"""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple, TypeAlias

from adamslite.language.spelling import spelled
from adamslite.syntax.forms import MOST_OPEN, Fault, Item, statement_form
from adamslite.syntax.lines import Logical
from adamslite.syntax.tokens import CLOSES, MANY, OPERATORS, Lexemes, Tokens, end_of, lengthened

MOST_MISTAKES = 20
"""After so many in one statement the rest of it is skipped."""
LONG, FEWER_MISTAKES = 10_000, 3
"""Tokens of a statement that is looked through less often."""

WRITTEN = {
    "^": "a power is written **",
    "÷": "a division is written /",
    ">": "IF(x: a, b, c) is a below, b at and c above x = 0",
    "<": "IF(x: a, b, c) is a below, b at and c above x = 0",
    ";": "arguments are separated by commas",
    "{": "brackets are ( ) and [ ]",
    "$": "LaTeX is read from a $ or $$ as far as the next one",
}
"""What stands for characters that other languages have."""

_SEPARATORS = ("COMMA", "BACKSLASH")


class Mistake(NamedTuple):
    """A message code, the numbers of the first and last token it is about, and its words."""

    code: str
    first: int
    last: int
    words: dict[str, str] = {}


class Syntax(NamedTuple):
    """A statement with its form; ``whole`` is false when faulty items were cut out, ``cut`` are
    their keywords, empty for one that has none.
    """

    tokens: Tokens
    items: Sequence[Item]
    name: str | None
    whole: bool
    cut: tuple[str, ...] = ()

    @property
    def keyword(self) -> str:
        return spelled(self.tokens[0][1]).upper()

    @property
    def range(self) -> tuple[int, int]:
        return self.tokens[0][2], end_of(self.tokens[-1])


class Waiting(NamedTuple):
    """A syntax that waits to be read, its tokens column by column: lists of them would take most of
    the memory of reading.
    """

    kinds: tuple[str, ...]
    texts: tuple[str, ...]
    offsets: array[int]
    rest: tuple[Sequence[Item], str | None, bool, tuple[str, ...]]

    @classmethod
    def of(cls, syntax: Syntax, known: dict[tuple[str, ...], tuple[str, ...]]) -> Waiting:
        """The same syntax, waiting; equal kinds are one object, of those ``known``."""
        tokens = syntax.tokens
        if isinstance(tokens, Lexemes):
            kinds, texts, offsets = (*tokens.kinds,), (*tokens.texts,), tokens.offsets
        else:
            kinds, texts, places = zip(*tokens, strict=True)
            offsets = array("I", places)
        return cls(known.setdefault(kinds, kinds), texts, offsets, syntax[1:])

    @property
    def syntax(self) -> Syntax:
        """The syntax as it was."""
        if len(self.kinds) > MANY:
            tokens: Tokens = Lexemes.of(self.kinds, self.texts, self.offsets)
        else:
            tokens = [*zip(self.kinds, self.texts, self.offsets, strict=True)]
        return Syntax(tokens, *self.rest)

    @property
    def name(self) -> str | None:
        return self.rest[1]

    @property
    def whole(self) -> bool:
        return self.rest[2]

    @property
    def range(self) -> tuple[int, int]:
        return self.offsets[0], self.offsets[-1] + len(self.texts[-1])


Faults: TypeAlias = list[tuple[Mistake, Tokens]]
"""Mistakes, each with the tokens it counts."""


def statement_syntax(logical: Logical) -> tuple[Syntax | None, Faults]:
    """The syntax of a statement and the mistakes in it, each with the tokens it counts.

    The syntax is ``None`` when not even the name of the statement is known.
    """
    tokens = logical.tokens
    found: Faults = []
    cut: list[str] = []
    most = MOST_MISTAKES if len(tokens) <= LONG else FEWER_MISTAKES
    while True:
        form = statement_form(kinds_of(tokens))
        if not isinstance(form, Fault):
            return Syntax(tokens, form, logical.name, not found, tuple(cut)), found
        mistake = _statement_mistake(tokens, form.at)
        found.append((mistake, tokens))
        if form.at < 2 or len(found) == most:
            return None, found
        tokens, item = _without_item(tokens, form.at)
        cut += _keywords(item)


def kinds_of(tokens: Tokens) -> tuple[str, ...]:
    """The kinds of tokens."""
    if isinstance(tokens, Lexemes):
        return (*tokens.kinds,)
    return tuple([token[0] for token in tokens])


def _kind(tokens: Tokens, at: int) -> str:
    return tokens[at][0] if at < len(tokens) else "END"


def open_brackets(tokens: Tokens) -> list[int]:
    """The numbers of the brackets that are open at the end."""
    stack: list[int] = []
    for number, token in enumerate(tokens):
        if token[0] in CLOSES:
            stack.append(number)
        elif token[0] in CLOSES.values() and stack:
            stack.pop()
    return stack


def _statement_mistake(tokens: Tokens, at: int) -> Mistake:
    here = min(at, len(tokens) - 1)
    kind = _kind(tokens, at)
    if at < 2:
        return _header_mistake(tokens, at, kind)
    if mistake := _bracket_mistake(tokens, open_brackets(tokens[:at]), here, kind):
        return mistake
    if tokens[at - 1][0] == "EQUAL":
        return Mistake("missing-value", at - 2, at - 1, {"word": tokens[at - 2][1]})
    if kind == "END":
        return Mistake("trailing-comma", here, here)
    if kind in _SEPARATORS:
        return Mistake("empty-item", at - 1, here)
    if kind == "EQUAL":
        return Mistake("stray-equal", here, here)
    if kind == "AMPERSAND":
        return Mistake("stray-ampersand", here, here)
    return _stray(tokens, here)


def _bracket_mistake(tokens: Tokens, opened: list[int], here: int, kind: str) -> Mistake | None:
    """What is wrong with brackets, of which some are open."""
    if len(opened) >= MOST_OPEN:
        return Mistake("too-deep", opened[-1], opened[-1], {"limit": str(MOST_OPEN)})
    if opened and kind in ("END", "EQUAL", "BACKSLASH"):
        return Mistake("unclosed-bracket", opened[-1], opened[-1], {"word": tokens[opened[-1]][1]})
    if kind in CLOSES.values():
        if not opened:
            return Mistake("unopened-bracket", here, here, {"word": tokens[here][1]})
        words = {"word": tokens[here][1], "other": tokens[opened[-1]][1]}
        return Mistake("wrong-bracket", opened[-1], here, words)
    return None


def _stray(tokens: Tokens, here: int) -> Mistake:
    word = tokens[here][1]
    return Mistake("stray-character", here, here, {"word": word, "hint": WRITTEN.get(word, "")})


def _header_mistake(tokens: Tokens, at: int, kind: str) -> Mistake:
    if at == 0:
        code = "stray-continuation" if kind == "COMMA" else "not-a-statement"
        return Mistake(code, 0, 0, {"word": tokens[0][1]})
    words = {"word": tokens[0][1]}
    if kind == "EQUAL":
        return Mistake("missing-leading-comma", 0, 1, words)
    return Mistake("missing-slash", 0, 0, words)


def _keywords(item: Tokens) -> list[str]:
    """What the tokens of an item give a value; empty where they do not say."""
    return [a[1] for a, b in pairwise(item) if (a[0], b[0]) == ("NAME", "EQUAL")] or [""]


def _without_item(tokens: Tokens, at: int) -> tuple[Tokens, Tokens]:
    """The statement without the item that token number ``at`` spoils, and that item."""
    opened = open_brackets(tokens[:at])
    kind = _kind(tokens, at)
    if opened and kind in ("END", "EQUAL", "BACKSLASH"):
        start = _item_start(tokens, opened[0])
        end = at - 1 if kind == "EQUAL" else at
    else:
        start = _item_start(tokens, at)
        end = at
        while end < len(tokens) and tokens[end][0] not in _SEPARATORS:
            end += 1
    end = max(end, start + 1)
    left, item, right = tokens[:start], tokens[start:end], tokens[end:]
    while len(left) > 2 and left[-1][0] in _SEPARATORS:
        left.pop()
    kinds = enumerate(kinds_of(right))
    right = right[next((n for n, kind in kinds if kind not in _SEPARATORS), None) :]
    if len(left) > 2 and right:
        left.append(("COMMA", "", right[0][2]))
    return lengthened(left, right), item


def _item_start(tokens: Tokens, at: int) -> int:
    """The number of the first token of the item that token number ``at`` is in."""
    start, depth = 2, 0
    for number in range(2, min(at, len(tokens))):
        kind = tokens[number][0]
        depth = max(0, depth + (kind in CLOSES) - (kind in CLOSES.values()))
        if depth == 0 and kind in _SEPARATORS:
            start = number + 1
    return start


def _is_argument(tokens: Tokens, at: int) -> bool:
    """Whether a token is inside the brackets of a function."""
    opened = open_brackets(tokens[:at])
    return bool(opened) and opened[-1] > 0 and tokens[opened[-1] - 1][0] == "NAME"


def expression_mistake(tokens: Tokens, fault: Fault) -> Mistake:
    """What is wrong with an expression whose form breaks at ``fault``."""
    at = fault.at
    here = min(at, len(tokens) - 1)
    kind = _kind(tokens, at)
    before = tokens[at - 1][0] if at else "START"
    if kind in ("NUMBER", "NAME", *CLOSES):
        words = {"word": tokens[at - 1][1], "other": tokens[here][1]}
        if before == "NUMBER" and kind != "NUMBER" and words["other"][0] not in "eE":
            words["hint"] = f"a product is written {words['word']}*{words['other']}"
        elif _is_argument(tokens, at):
            words["hint"] = WRITTEN[";"]
        return Mistake("missing-operator", at - 1, here, words)
    if before == "COMMA" or kind == "COMMA" and before in CLOSES:
        return Mistake("empty-argument", at - 1, here)
    if before in OPERATORS:
        return Mistake("missing-operand", at - 1, here, {"word": tokens[at - 1][1]})
    if kind in OPERATORS:
        return Mistake("missing-operand", here, here, {"word": tokens[here][1]})
    if kind in CLOSES.values():
        return Mistake("empty-brackets", at - 1, here)
    if kind in ("COMMA", "COLON"):
        return Mistake("stray-comma", here, here, {"word": tokens[here][1]})
    return _stray(tokens, here)

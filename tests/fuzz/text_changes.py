"""Random changes of texts: characters, lines, numbers, words, nesting and repetition."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from random import Random

WORD = re.compile(r"[A-Za-z_]\w*")
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d*)?(?:[EeDd][-+]?\d+)?")
VALUE = re.compile(r"(?<![\w.])\d+\.\d+")
NUMBERS = (
    "0", "-1", "1", "2", "3", "1E-300", "1E300", "1E400", "9" * 30, "9" * 400, "0.5", "-0", "1D",
    "90D", "1E5D", "nan", "inf", "1e999999999", "0x10", "1_000", "2147483648",
    "-9223372036854775809",
)  # fmt: skip
PIECES = (
    "", ",", ",,", "=", "/", "\\", "(", ")", "[", "]", ":", ";", "!", "&", "\n", "\n, ", "\t", "\0",
    "*", "**", "-", "+", ".", "E", "D", "'", '"', "é", "Δ", "#", "%", " ", "IF(TIME: 1, 2, 3)",
    "MAX(", "VARVAL(1)", "TIME", "1/0", "0/0", "USER(1)", "FUNCTION=", "\nEND\n", "\\Delta ",
    "\r\n", "\r", "\x1b[2J", "\u2028", "\ufeff", "\U0001f600", "\ud800", "\xa0", "{", "}", "<", ">",
    "%s", "{0}", "../", "/dev/null", "FILE=", "~", "$HOME", "`", "\x85", "²", "٣",
)  # fmt: skip
BRACKETS = (
    ("(", ")"), ("[", "]"), ("SIN(", ")"), ("-(", ")"), ("2**(", ")"), ("MAX(1,", ")"),
    ("IF(TIME:1,2,", ")"), ("+", ""), ("-", ""),
)  # fmt: skip
#: Characters that a change may add: reading takes its time for all of them.
GROWTH = 4000

Change = Callable[[Random, str, Sequence[str]], str]
"""A changed text from a text and texts of the same kind."""


def changed(random: Random, text: str, others: Sequence[str], most: int = 4) -> str:
    """The text after one to ``most`` changes."""
    for _ in range(random.randint(1, most)):
        text = random.choice(CHANGES)(random, text, others)
    return text


def cut(random: Random, text: str, others: Sequence[str]) -> str:
    """Without some characters."""
    at = random.randrange(len(text) + 1)
    return text[:at] + text[at + random.randint(1, 30) :]


def insert(random: Random, text: str, others: Sequence[str]) -> str:
    """With a piece of text somewhere."""
    at = random.randrange(len(text) + 1)
    return text[:at] + random.choice(PIECES) + text[at:]


def any_character(random: Random, text: str, others: Sequence[str]) -> str:
    """With one character exchanged for any other."""
    at = random.randrange(len(text) + 1)
    return text[:at] + chr(random.randrange(32, 256)) + text[at + 1 :]


def _line(random: Random, text: str) -> tuple[list[str], int]:
    lines = text.split("\n")
    return lines, random.randrange(len(lines))


def drop_line(random: Random, text: str, others: Sequence[str]) -> str:
    """Without a line."""
    lines, at = _line(random, text)
    return "\n".join(lines[:at] + lines[at + 1 :])


def double_line(random: Random, text: str, others: Sequence[str]) -> str:
    """With a line twice."""
    lines, at = _line(random, text)
    other = random.randrange(len(lines))
    return "\n".join([*lines[:other], lines[at], *lines[other:]])


def swap_lines(random: Random, text: str, others: Sequence[str]) -> str:
    """With two lines exchanged."""
    lines, at = _line(random, text)
    other = random.randrange(len(lines))
    lines[at], lines[other] = lines[other], lines[at]
    return "\n".join(lines)


def end_early(random: Random, text: str, others: Sequence[str]) -> str:
    """Without its end."""
    return text[: random.randrange(len(text) + 1)]


def _replaced(random: Random, text: str, pattern: re.Pattern[str], by: Callable[[str], str]) -> str:
    """With one match exchanged: that which is nearest after a random position, else the first."""
    found = pattern.search(text, random.randrange(len(text) + 1)) or pattern.search(text)
    return text[: found.start()] + by(found[0]) + text[found.end() :] if found else text


def _any(random: Random, text: str, pattern: re.Pattern[str], otherwise: str) -> str:
    found = pattern.search(text, random.randrange(len(text) + 1)) or pattern.search(text)
    return found[0] if found else otherwise


def other_number(random: Random, text: str, others: Sequence[str]) -> str:
    """With a number exchanged for another."""
    known = random.random() < 0.6
    by = random.choice(NUMBERS) if known else _any(random, text, NUMBER, "1")
    return _replaced(random, text, NUMBER, lambda _: by)


def other_sign(random: Random, text: str, others: Sequence[str]) -> str:
    """With a number of the opposite sign."""
    return _replaced(random, text, NUMBER, lambda number: f"-{number}")


def other_value(random: Random, text: str, others: Sequence[str]) -> str:
    """With a number that has a point, which no id has, exchanged for another or scaled."""
    power = random.randint(-12, 12)
    scaled = random.random() < 0.6
    by = random.choice(NUMBERS)
    return _replaced(random, text, VALUE, lambda number: f"{number}E{power}" if scaled else by)


def scaled_number(random: Random, text: str, others: Sequence[str]) -> str:
    """With a number as many powers of ten larger or smaller."""
    power = random.randint(-12, 12)
    return _replaced(random, text, NUMBER, lambda number: f"{number}E{power}")


def other_word(random: Random, text: str, others: Sequence[str]) -> str:
    """With a word exchanged for another one of the text."""
    by = _any(random, text, WORD, "X")
    return _replaced(random, text, WORD, lambda _: by)


def foreign_word(random: Random, text: str, others: Sequence[str]) -> str:
    """With a word of another text."""
    by = _any(random, random.choice(others), WORD, "X")
    return _replaced(random, text, WORD, lambda _: by)


def foreign_lines(random: Random, text: str, others: Sequence[str]) -> str:
    """With some lines of another text."""
    lines, at = _line(random, text)
    inserted, start = _line(random, random.choice(others))
    return "\n".join(lines[:at] + inserted[start : start + random.randint(1, 5)] + lines[at:])


def nest(random: Random, text: str, others: Sequence[str]) -> str:
    """With a number or word deep inside brackets or calls."""
    opened, closed = random.choice(BRACKETS)
    depth = min(random.choice([2, 10, 100, 1000]), GROWTH // len(opened + closed))
    pattern = random.choice([WORD, NUMBER])
    return _replaced(random, text, pattern, lambda word: opened * depth + word + closed * depth)


def repeat(random: Random, text: str, others: Sequence[str]) -> str:
    """With a piece of it many times over."""
    at = random.randrange(len(text) + 1)
    piece = text[at : at + random.choice([1, 2, 10, 100])]
    times = min(random.choice([2, 10, 100, 1000]), GROWTH // max(len(piece), 1))
    return text[:at] + piece * times + text[at:]


CHANGES: tuple[Change, ...] = (
    cut, insert, insert, any_character, drop_line, double_line, swap_lines, end_early, other_number,
    other_number, other_number, scaled_number, other_sign, other_word, foreign_word, foreign_lines,
    nest, repeat,
)  # fmt: skip
NUMERIC: tuple[Change, ...] = (other_number, scaled_number, other_sign)
"""Changes after which most decks are still without errors."""

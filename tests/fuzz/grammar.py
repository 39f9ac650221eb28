"""Decks from the grammar: statements and expressions of `grammar/*.lark`, and decks of registered
statements (random_decks.py), by hypothesis.
"""

from __future__ import annotations

import re
from functools import cache, lru_cache

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st
from hypothesis.extra.lark import from_lark
from lark import Lark
from random_decks import decks

import adamslite.elements  # noqa: F401  registers the statements
from adamslite.language.function import FUNCTIONS
from adamslite.language.statement import STATEMENTS
from adamslite.resources import find

#: Texts that are drawn together: beginning takes longer than one.
DRAWN = 200
HEAD = """a deck
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1
MARKER/2, PART=2
"""
KEYWORDS = sorted(STATEMENTS)
KEYS = sorted({key for each in STATEMENTS.values() for key in each.arguments})
#: What the grammar ignores, in one form.
BETWEEN = {"LINE_END": "\n", "COMMENT": "! why", "SEMICOLON": ";", "AMPERSAND": "&", "BLANK": " "}
NAMES = st.one_of(
    st.sampled_from([*sorted(FUNCTIONS), "TIME", "PI"]),
    st.sampled_from(KEYWORDS),
    st.sampled_from([key.upper() for key in KEYS]),
    st.from_regex(re.compile(r"[^\W\d]\w{0,5}(\.\w{1,4})?"), fullmatch=True),
)


def _strategy(name: str, start: str) -> st.SearchStrategy[str]:
    """Texts of a rule of a grammar, with the words of the language as names."""
    path = find("grammar") / name
    grammar = Lark.open(str(path), start=start, maybe_placeholders=False)
    words = {"NAME": NAMES, "OTHER": st.sampled_from([*"#%$@?{}<>~^|'`;."])}
    words |= {each: st.just(text) for each, text in BETWEEN.items()}
    there = {each.name for each in grammar.terminals}
    explicit = {each: strategy for each, strategy in words.items() if each in there}
    return from_lark(grammar, start=start, explicit=explicit)


@cache
def expressions() -> st.SearchStrategy[str]:
    """Function expressions."""
    return _strategy("expression.lark", "expression")


@cache
def statements() -> st.SearchStrategy[str]:
    """Statements by their form alone: most are unknown, or have arguments of others."""
    return _strategy("deck.lark", "statement")


@cache
def texts() -> st.SearchStrategy[str]:
    """Whole decks."""
    formulas = expressions().map(lambda text: f"VARIABLE/1, FUNCTION={text}\n")
    forces = expressions().map(
        lambda text: f"SFORCE/1, TRANSLATION, I=2, J=1, FUNCTION={text}\nEND\n"
    )
    others = statements().map(lambda text: f"{text}\n")
    some = st.lists(st.one_of(others, formulas, forces), max_size=4)
    return st.one_of(some.map(lambda each: HEAD + "".join(each)), decks())


@lru_cache(2)
def _batch(number: str) -> tuple[str, ...]:
    found: list[str] = []

    @seed(number)
    @settings(
        max_examples=DRAWN, database=None, deadline=None, phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )  # fmt: skip
    @given(texts())
    def draw(text: str) -> None:
        found.append(text)

    draw()
    return tuple(found)


def drawn(series: int, number: int) -> str:
    """Text ``number`` of a series."""
    batch = _batch(f"{series} {number // DRAWN}")
    return batch[number % len(batch)]

"""Decks drawn at random from the grammar, in any layout that it allows."""

from __future__ import annotations

from hypothesis import strategies as st

import adamslite.elements  # noqa: F401  registers the statements
from adamslite.language.function import FUNCTIONS
from adamslite.language.statement import STATEMENTS, Argument, Statement

CLASSES = [
    cls for cls in STATEMENTS.values() if cls.place == "deck" and not (cls.ends or cls.ignored)
]
NUMBERS = st.sampled_from(["0", "1", "2.5", ".5", "1E-3", "90D", "1.5d0", "1D-3", "007", "12."])
IDS = st.sampled_from(["1", "2", "0030", "cm", "Dm", "L_0", "a.b"])
NAMES = st.sampled_from(["TIME", "pi", "Dm", "L_0", "ea", "Δx", "\\Delta L"])
WORDS = st.sampled_from(["a title", "x", '"quoted, text"', ".\\file.txt", "two  blanks"])
COMMENTS = st.sampled_from(
    ["!", "! a comment", "!no blank", "! adams_view_name='Name_1'", "! a;b, c&"]
)
TAILS = ["\n", "\n", " ! behind\n", "! adamslite: ignore no-inertia\n", " ; "]
BLANK = st.sampled_from(["", "", " ", "  ", "\t"])
INNER_BREAK = st.sampled_from(["\n, ", "\n  ,", " ! why\n, ", "\n! a line\n,", "\n\n, "])


def _operands() -> st.SearchStrategy[list[str]]:
    return st.one_of(NUMBERS, NAMES).map(lambda word: [word])


@st.composite
def _larger(draw: st.DrawFn, inner: st.SearchStrategy[list[str]]) -> list[str]:
    """An expression as tokens, from smaller ones."""
    form = draw(st.integers(0, 4))
    if form == 0:
        operator = draw(st.sampled_from(["+", "-", "*", "/", "**", "−", "·"]))
        return [*draw(inner), operator, *draw(inner)]
    if form == 1:
        opened, closed = draw(st.sampled_from(["()", "[]"]))
        return [opened, *draw(inner), closed]
    if form == 2:
        return [draw(st.sampled_from("-+")), *draw(inner)]
    name = draw(st.sampled_from(["step", "DX", "IF", "VarVal", "SIN", *list(FUNCTIONS)[:9]]))
    found = [name, "("]
    for number, argument in enumerate(draw(st.lists(inner, min_size=1, max_size=4))):
        found += ([":" if name == "IF" and number == 1 else ","] if number else []) + argument
    return [*found, ")"]


EXPRESSIONS = st.recursive(_operands(), _larger, max_leaves=6)


@st.composite
def _values(draw: st.DrawFn, argument: Argument) -> list[list[str]]:
    """The values of an argument, each as tokens."""
    kind = argument.kind
    if kind in ("vector", "vectors"):
        numbers = draw(st.lists(NUMBERS, min_size=1, max_size=4))
        return [[*draw(st.sampled_from([(), ("-",)])), each] for each in numbers]
    if kind in ("reference", "references", "ids"):
        return [[each] for each in draw(st.lists(IDS, min_size=1, max_size=2))]
    if kind in ("choice", "words"):
        return [[draw(st.sampled_from([*argument.options]))]]
    if kind in ("text", "texts"):
        return [[draw(WORDS)]]
    if kind == "expression":
        return [draw(EXPRESSIONS)]
    return [[*draw(st.sampled_from([(), ("-",)])), draw(NUMBERS)]]


@st.composite
def _argument(draw: st.DrawFn, argument: Argument) -> list[str]:
    if argument.kind == "flag" or argument.bare:
        word = draw(st.sampled_from([*(argument.keys or argument.options)]))
        return [draw(st.sampled_from([word, word.lower(), word[:5]]))]
    key = draw(st.sampled_from([*argument.keys]))
    found = [draw(st.sampled_from([key, key.lower(), key[:4]])), "="]
    for number, value in enumerate(draw(_values(argument))):
        found += ([","] if number else []) + value
    closed = argument.kind == "expression" or (argument.kind == "text" and draw(st.booleans()))
    return found + (["\\"] if closed else [])


@st.composite
def statements(draw: st.DrawFn) -> str:
    """One statement in some layout, with what may stand before and behind it."""
    cls: type[Statement] = draw(st.sampled_from(CLASSES))
    tokens = [draw(st.sampled_from([cls.keyword, cls.keyword.lower()])), "/"]
    if not cls.singleton:
        tokens.append(draw(IDS))
    chosen = [*cls.arguments.values()]
    for argument in draw(st.lists(st.sampled_from(chosen), max_size=4)) if chosen else ():
        bare = tokens[-1] in "/\\"
        tokens += ([] if bare else [","]) + draw(_argument(argument))
    head = draw(st.lists(st.one_of(COMMENTS, st.just("")), max_size=2))
    tail = draw(st.sampled_from(TAILS))
    return "".join(f"{line}\n" for line in head) + draw(_spread(tokens)) + tail


@st.composite
def _spread(draw: st.DrawFn, tokens: list[str]) -> str:
    """The tokens with blanks and line breaks between them."""
    text, depth = tokens[0], 0
    for before, token in zip(tokens, tokens[1:], strict=False):
        depth += (before in "([") - (token in ")]")
        space = draw(BLANK)
        if _is_word(before) and _is_word(token):
            space = space or " "
        if draw(st.integers(0, 9)) == 0 and before in ("(", ",", "\\", "=", "+"):
            space = draw(INNER_BREAK)
        text += space + token
    return text


def _is_word(token: str) -> bool:
    return token[0].isalnum() or token[0] in '."\\'


@st.composite
def decks(draw: st.DrawFn) -> str:
    """A deck of some statements, most of them with mistakes of meaning but not of form."""
    body = "".join(draw(st.lists(statements(), max_size=5)))
    end = draw(st.sampled_from(["", "END", "end\nwhat is behind it  \n"]))
    return f"a title\nPART/1, GROUND\n{body}{end}"

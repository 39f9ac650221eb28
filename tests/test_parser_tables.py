"""What is parsed by the tables that Lark makes is what Lark parses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from random import Random
from typing import Any

import pytest
from lark import Lark, Token, Transformer
from lark.exceptions import UnexpectedToken
from lark.lexer import Lexer

from adamslite.resources import find
from adamslite.syntax import forms
from adamslite.syntax.tokens import scan

EXPRESSIONS = (
    "1", "-a**-2**3", "+(a)", "a-b-c*d/e", "2*-x", "MAX(1, 2: 3)", "F()", "F[a](", "((a+[b]))",
    "IF(TIME: 1, 2, IF(x-1: 0, SIN(y)*2, -z**2))", "-+-1", "a/b/c+d*-e**f", "G(((1)), H(2)[",
)  # fmt: skip
STATEMENTS = (
    "A/1", "A", "A/, B=1", "A/1, B=1, C, 2, 3\\ D=(1, 2, [3 4])\\", "A/ B=1 2 3 \\, C=F(1:2)*3",
    'A/1, B="text"\\ C=-1, D=a-(b), E=()', "A/1, ((1)), [], B=x[1]", "A/x/y, 1*2**3",
)  # fmt: skip
TEXTS = {"expression": EXPRESSIONS, "deck": STATEMENTS}
STARTS = {"expression": "expression", "deck": "statement"}


class Numbers(Lexer):
    """Tokens of given kinds, which know their number."""

    def __init__(self, conf: object) -> None:
        pass

    def lex(self, kinds: Sequence[str]) -> Iterator[Token]:  # type: ignore[override]
        for number, kind in enumerate(kinds):
            yield Token(kind, "", start_pos=number)


def by_lark(grammar: str, kinds: tuple[str, ...]) -> Any:
    """What Lark makes of the kinds with the same builder."""
    builder = forms._Forms(kinds)

    class Builder(Transformer[Token, Any]):
        def __getattr__(self, name: str) -> Any:
            method = getattr(builder, name)
            return lambda children: method(
                [each.start_pos if isinstance(each, Token) else each for each in children]
            )

    options: dict[str, Any] = {"parser": "lalr", "lexer": Numbers, "keep_all_tokens": True}
    path = str(find("grammar") / f"{grammar}.lark")
    parser = Lark.open(path, start=STARTS[grammar], transformer=Builder(), **options)
    try:
        return parser.parse(kinds)  # type: ignore[arg-type]
    except UnexpectedToken as fault:
        at = fault.token.start_pos
        return forms.Fault(len(kinds) if fault.token.type == "$END" or at is None else at)


def changed(kinds: list[str], random: Random) -> tuple[str, ...]:
    """The kinds with up to two of them taken out, put in or replaced."""
    every = ["NAME", "NUMBER", "PLUS", "MINUS", "STAR", "POWER", "COMMA", "COLON", "EQUAL"]
    every += ["LPAR", "RPAR", "LSQB", "RSQB", "BACKSLASH", "SLASH"]
    for _ in range(random.randint(0, 2)):
        at = random.randrange(len(kinds) + 1)
        kinds[at : at + random.randint(0, 1)] = random.choices(every, k=random.randint(0, 1))
    return tuple(kinds)


@pytest.mark.parametrize("grammar", TEXTS)
def test_tables_give_what_lark_gives(grammar: str) -> None:
    random, right = Random(7), 0
    for _ in range(150):
        text = random.choice(TEXTS[grammar])
        kinds = changed([token[0] for part in scan(text) for token in part], random)
        found = forms._form(forms._parser(grammar, STARTS[grammar]), kinds)
        expected = by_lark(grammar, kinds)
        assert found == expected and type(found) is type(expected), kinds
        right += not isinstance(found, forms.Fault)
    assert 30 < right < 120

"""The rule about D between a number and a sign: an exponent, or degrees and a sum."""

from __future__ import annotations

import re
from collections.abc import Iterator

from adamslite.deck.deck import Deck
from adamslite.deck.names import to_number
from adamslite.deck.statement_diagnostics import diagnose_inside
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.statement import Statement
from adamslite.syntax.tokens import scan

SIGNED = re.compile(r"[\d.][Dd][+-]\d")


def exponents_or_degrees(deck: Deck) -> Iterator[Diagnostic]:
    """Powers of ten with D in expressions, where 90D+2 may be meant as degrees and a sum."""
    sources = {id(each.spans.source): each.spans.source for each in deck.statements}
    if not any(source and SIGNED.search(source.text) for source in sources.values()):
        return
    for each in deck.own:  # what a statement brings along has its places
        for field in each.spans:
            if each.arguments[field].kind == "expression":
                yield from _inside(each, field)


def _inside(statement: Statement, field: str) -> Iterator[Diagnostic]:
    text = statement.spans.home(field).text(field)
    if not SIGNED.search(text):
        return
    for kind, word, _ in (token for stretch in scan(text) for token in stretch):
        if kind == "NUMBER" and SIGNED.search(word):
            power = word.upper().replace("D", "E")
            words = {"text": word, "value": to_number(word), "power": power}
            yield diagnose_inside(statement, word, "exponent-or-degrees", field, **words)
            return

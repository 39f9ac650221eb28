"""The rule about D between a number and a sign: an exponent, or degrees and a sum."""

from __future__ import annotations

import re
from collections.abc import Iterator

from adamslite.deck.deck import Deck
from adamslite.deck.names import to_number
from adamslite.deck.statement_diagnostics import diagnose_within
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.statement import Statement
from adamslite.syntax.tokens import scan

# The letter comes first: few texts have many of them, and all have digits.
SIGNED = re.compile(r"[Dd][+-](?<=[\d.][Dd][+-])\d")


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
    for kind, word, at in (token for stretch in scan(text) for token in stretch):
        if kind == "NUMBER" and SIGNED.search(word):
            power = word.upper().replace("D", "E")
            words = {"text": word, "value": to_number(word), "power": power}
            place = at, at + len(word)
            yield diagnose_within(statement, field, place, "exponent-or-degrees", **words)
            return

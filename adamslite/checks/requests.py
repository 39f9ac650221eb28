"""Rules about REQUEST and MREQUEST."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from adamslite.checks.rule import Rule
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose, diagnose_inside
from adamslite.elements.mrequest import ALL, KINDS, Mrequest
from adamslite.elements.request import Request
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import calls
from adamslite.language.likeness import Guesses
from adamslite.language.method import NUMBERS


def requests(deck: Deck) -> Iterator[Diagnostic]:
    for request in deck.of(Request):
        written = any(function is not None for function in request.functions)
        ways = {
            request.kind or "": request.kind is not None,
            "VARIABLES": bool(request.variables),
            "expressions": written,
        }
        found = [word for word, is_there in ways.items() if is_there]
        if len(found) > 1:
            yield diagnose(request, "two-requests", word=found[0], other=found[1])
        elif request.kind and request.i is None or not found and not request.given("function"):
            yield diagnose(request, "empty-request")


def _known(deck: Deck, kinds: Sequence[str]) -> list[str]:
    """Names and ids of statements of some kinds."""
    return [word for kind in kinds for word in deck.names.known(kind)]


def many_requests(deck: Deck) -> Iterator[Diagnostic]:
    guesses = Guesses()
    for each in deck.of(Mrequest):
        if not list(each.asked()):
            hint = "give PARTS=, JOINTS=, JPRIMS= or FORCES= with ids or ALL, or just ALL"
            yield diagnose(each, "empty-request", hint=hint)
        for field, key in each.asked():
            kinds = KINDS[field]
            if key != ALL and not each.named(deck, field, key) and not deck.incomplete & {*kinds}:
                names = partial(_known, deck, kinds)
                yield diagnose(
                    each, "missing-reference", field,
                    kind=kinds[0] if len(kinds) < 3 else "force", key=key,
                    hint=guesses.meant(str(key), field, names),
                )  # fmt: skip


def numbers_of_the_run(deck: Deck) -> Iterator[Diagnostic]:
    """Numbers of the integrator, where they are more than an output."""
    for each in deck.statements:
        if isinstance(each, Request) or each.called.isdisjoint(NUMBERS):
            continue
        for field, argument in each.arguments.items():
            node = getattr(each, field) if argument.kind == "expression" else None
            for call in calls(node, *NUMBERS) if node is not None else ():
                yield diagnose_inside(each, call.name, "only-an-output", field, word=call.name)


REQUEST_RULES: list[Rule] = [requests, many_requests, numbers_of_the_run]

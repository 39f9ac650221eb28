"""What a deck delays: every call of DELAY, with the VARIABLE that follows its expression."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import count
from typing import TYPE_CHECKING

from adamslite.language.expression import calls
from adamslite.language.function import FUNCTIONS
from adamslite.language.statement import STATEMENTS, expressions

if TYPE_CHECKING:
    from adamslite.deck.names import Names
    from adamslite.language.expression import Call
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Statement


def delayed(statements: Iterable[Statement], names: Names) -> dict[Call, Key]:
    """Different calls of DELAY, each with a name that no VARIABLE of the deck has."""
    taken = names.ids.get("VARIABLE", {})
    names_of_past = [name for name, function in FUNCTIONS.items() if function.takes_past]
    found = (
        call for each in statements for node in expressions(each)
        for call in calls(node, *names_of_past)
    )  # fmt: skip
    free = (name for n in count(1) if (name := f"DELAY_{n}") not in taken)
    return dict(zip(dict.fromkeys(found), free, strict=False))


def watched(call: Call, key: Key) -> Statement:
    """The VARIABLE whose results are the expression that a call delays."""
    return STATEMENTS["VARIABLE"](id=key, function=call.args[0])

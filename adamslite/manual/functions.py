"""Pages of the functions of expressions."""

from __future__ import annotations

import sys

from adamslite import functions  # noqa: F401  register what there is to describe
from adamslite.deck.names import MEANINGS
from adamslite.language.function import FUNCTIONS, Function, Parameter, listed
from adamslite.language.not_supported import FUNCTIONS as MISSING
from adamslite.manual.markdown import HEAD, heading, not_supported, table

INTRO = """# Functions

The functions of expressions. Arguments in brackets may be left out: an omitted marker is the ground
frame, an omitted number its default. `adamslite help NAME` prints a single entry.
"""


def deck_functions() -> str:
    """The page of all functions by family: docs/reference/functions.md."""
    parts, family = [HEAD, INTRO], ""
    for each in FUNCTIONS.values():
        if each.body.__module__ != family:
            family = each.body.__module__
            parts.append(f"## {heading(sys.modules[family].__doc__)}\n")
        parts.append(function(each))
    constants = table(("name", "value"), [(f"`{name}`", text) for name, text in MEANINGS.items()])
    parts += [f"## Constants\n\n{constants}", not_supported("function", MISSING)]
    return "\n".join(parts)


def function(each: Function) -> str:
    """One function: how it is called, what it is, what its arguments are."""
    lines = [*each.doc.splitlines(), "", *map(_parameter, each.parameters)]
    # A block of code, because ** in it means a power.
    body = "".join(f"    {line}".rstrip() + "\n" for line in lines)
    return f"### `{each.usage}`\n\n{body}"


def _parameter(p: Parameter) -> str:
    kinds = {"constant": "number written in the deck"} | dict.fromkeys(
        ("number", "exponent"), "number"
    )
    text = f"  {p.name:10}{kinds.get(p.kind, p.statement)}"
    if p.allowed:
        text += f", {listed(p.allowed)}"
    if p.counts:
        low, high = p.counts
        text += f", {low} to {high} of them" if high else f", {low} or more"
    if p.default is not None:
        text += f" (default {'ground' if p.statement else f'{p.default:g}'})"
    return text

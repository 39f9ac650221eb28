"""Pages of the methods of integration."""

from __future__ import annotations

from adamslite.language.method import ARGUMENTS, Method, declared
from adamslite.manual.markdown import HEAD, code_list, sentence, table

INTRO = """# Integrators

The methods of INTEGRATOR, and what each of its arguments does with each of them.
"""
ARGUMENTS_INTRO = """## Arguments of INTEGRATOR

Where an argument has no effect, `check` and the comments of the results report that; the reason is
given in brackets.
"""


def integrators() -> str:
    """The page of methods and arguments: docs/reference/integrators.md."""
    found = declared()
    head = ("argument", *(code_list(each.names) for each in found))
    rows = [(f"`{word}`", *(_use(each.use(word)) for each in found)) for word in ARGUMENTS]
    pages = (integrator(each) for each in found)
    return "\n".join([HEAD, INTRO, *pages, ARGUMENTS_INTRO, table(head, rows)])


def integrator(method: Method) -> str:
    """One method: its formula, what it is meant for, what it can do, its arguments."""
    names = ", ".join(method.names)
    facts = [
        f"{'explicit' if method.explicit else 'implicit'}, of order {_up_to(method)}",
        f"formulation {' or '.join(method.formulations)}",
        f"steps: {method.steps}",
    ]
    if method.cannot:
        facts.append(f"unable to follow {', '.join(method.cannot)}")
    lines = (sentence([method.what]), f"Suited to {method.suited}.", sentence(facts))
    return f"## {names}\n\n" + "\n\n".join(lines) + "\n"


def _up_to(method: Method) -> str:
    """The order of a method, the highest where KMAX may lower it."""
    return f"1 to {method.order}" if method.uses("KMAX") else f"{method.order}"


def integrator_page(method: Method) -> str:
    """A method with its arguments, for the terminal."""
    rows = [(f"`{word}`", _use(method.use(word))) for word in ARGUMENTS]
    return f"{integrator(method)}\n{table(('argument', 'effect'), rows)}"


def _use(text: str) -> str:
    return f"({text[1:]})" if text.startswith("-") else text

"""What `adamslite help` prints: everything of a name, or all names."""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple

from adamslite.deck.names import MEANINGS
from adamslite.errors import UsageError
from adamslite.language.function import FUNCTIONS
from adamslite.language.likeness import did_you_mean
from adamslite.language.messages import MESSAGES
from adamslite.language.method import declared, methods
from adamslite.language.not_supported import COMMANDS as MISSING_COMMANDS
from adamslite.language.not_supported import FUNCTIONS as MISSING_FUNCTIONS
from adamslite.language.not_supported import INSTEAD
from adamslite.language.not_supported import STATEMENTS as MISSING_STATEMENTS
from adamslite.language.statement import STATEMENTS
from adamslite.manual.api import NAMES, python_name
from adamslite.manual.commands import command
from adamslite.manual.functions import function
from adamslite.manual.integrators import integrator_page, integrators
from adamslite.manual.markdown import HEAD, heading, markdown, table
from adamslite.manual.messages import message
from adamslite.manual.statements import argument_names, argument_page, statement, title_of
from adamslite.notation import FUNCTIONS as IN_PYTHON
from adamslite.results import run_texts
from adamslite.results.formats import Format, formats
from adamslite.results.outcomes import Outcome

INTRO = """# Formats of result files

The suffix of a name decides: `adamslite solve DECK -o NAME.csv`. What can be read can be compared:
`adamslite diff A B`. A failed write leaves an earlier file as it was.
"""
LISTED = "`adamslite help` lists them"
MISSING = MISSING_STATEMENTS | MISSING_FUNCTIONS | MISSING_COMMANDS
Commands = Mapping[str, ArgumentParser]


def result_formats() -> str:
    """The page of the formats of result files: docs/reference/formats.md."""
    rows = [
        (f"`{suffix}`", each.what, "written, read" if each.read else "written")
        for suffix, each in sorted(formats().items())
    ]
    parts = [HEAD, INTRO, table(("suffix", "content", "can be"), rows)]
    parts.append(f"## Texts of a run\n\n{markdown(run_texts.__doc__)}")
    return "\n".join([*parts, *(_layout(*each) for each in sorted(formats().items()))])


def _layout(suffix: str, format: Format) -> str:
    """What such a file holds, in detail: the documentation of its module."""
    return f"## `{suffix}`\n\n{markdown(sys.modules[format.write.__module__].__doc__)}"


#: Pages of registers that are looked up as a whole.
TOPICS = {"INTEGRATORS": integrators, "FORMATS": result_formats}


class Chapter(NamedTuple):
    """Names of one kind, and what writes the page of one of them."""

    names: Iterable[str]
    page: Callable[[str], str]


def pages(name: str, commands: Commands | None = None) -> str:
    """Everything of this name, in capitals or not: a statement, a function, a command, ...

    Of a name that is not supported it is what to write instead; of a command, where there are none,
    the function of Python that does the same.

    Raises
    ------
    UsageError
        When there is none.
    """
    known = [(each, chapter) for chapter in chapters(commands or {}) for each in chapter.names]
    wanted = name.partition("/")[0].strip().casefold()  # of VFORCE/2, too
    found = [chapter.page(each) for each, chapter in known if each.casefold() == wanted]
    if not found:
        names = [*{each.casefold(): each for each, _ in reversed(known)}.values()]
        longer = [each for each in names if each.casefold().startswith(wanted)]
        hint = did_you_mean(name, names) if len(longer) != 1 else f"did you mean {longer[0]}?"
        raise UsageError(f"nothing here is called '{name}'; {hint or LISTED}")
    return "\n".join(found)


def chapters(commands: Commands) -> tuple[Chapter, ...]:
    """The kinds of names, in the order in which their pages are printed."""
    return (
        Chapter(STATEMENTS, lambda name: statement(STATEMENTS[name])),
        Chapter(argument_names(), argument_page),
        Chapter(FUNCTIONS, lambda name: function(FUNCTIONS[name])),
        Chapter(methods(), lambda name: integrator_page(methods()[name])),
        Chapter(commands, lambda name: command(commands[name])),
        Chapter(NAMES, python_name),
        Chapter({} if commands else IN_PYTHON, lambda name: python_name(IN_PYTHON[name])),
        Chapter(MESSAGES, lambda name: message(name, MESSAGES[name])),
        Chapter(Outcome.__members__, lambda name: f"## {name}\n\n{Outcome[name].value}\n"),
        Chapter(TOPICS, lambda name: TOPICS[name]().removeprefix(HEAD).lstrip()),
        Chapter(MEANINGS, lambda name: f"## {name}: {MEANINGS[name]}\n"),
        Chapter(MISSING, lambda name: f"## {name}: not supported\n\nInstead: {INSTEAD[name]}.\n"),
    )


def contents(commands: Commands | None = None) -> str:
    """All names with their meaning in a line each; arguments are left out."""
    titles = [heading(title_of(cls)) for cls in STATEMENTS.values()]
    usages = [f"{each.usage}: {heading(each.doc)}" for each in FUNCTIONS.values()]
    listed = {
        "Statements": sorted(titles),
        "Functions": usages,
        "Integrators": [f"{', '.join(each.names)}: {each.what}" for each in declared()],
        "Commands": [f"{name}: {_summary(each)}" for name, each in (commands or {}).items()],
        "Python": NAMES,
        "Topics": TOPICS,
        "Also": ("arguments (QP, REULER, HMAX), messages by their code, outcomes of a run",),
    }
    parts = ("\n".join([head, *(f"  {line}" for line in lines)]) for head, lines in listed.items())
    return "\n\n".join(parts) + "\n"


def _summary(command: ArgumentParser) -> str:
    return heading(command.description)

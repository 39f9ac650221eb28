"""Pages of the commands of the command line, from the parsers of their arguments."""

from __future__ import annotations

from argparse import Action, ArgumentParser
from collections.abc import Mapping

from adamslite.manual.markdown import HEAD, sentence, table

INTRO = """# Commands

The commands of `adamslite`; `adamslite COMMAND --help` prints one of them in short. The flags of a
run win over the command file, and that over the deck.
"""
#: Flags that every command has.
SHARED = ("--help", "--debug")


def commands(parsers: Mapping[str, ArgumentParser]) -> str:
    """The page of all commands: docs/reference/commands.md."""
    return "\n".join([HEAD, INTRO, *map(command, parsers.values())])


def command(parser: ArgumentParser) -> str:
    """One command: how it is called, what it does, its arguments and flags."""
    summary, _, rest = (parser.description or "").partition("\n")
    own = [each for each in parser._actions if not {*SHARED} & {*each.option_strings}]
    flags = [each for each in own if each.option_strings]
    places = [each for each in own if not each.option_strings]
    usage = " ".join([parser.prog, *map(_place, places), *(["[flags]"] if flags else [])])
    parts = [f"## {parser.prog}\n", sentence([summary.strip()]), f"\n    {usage}\n"]
    parts += [rest.strip() + "\n"] if rest.strip() else []
    for head, found in (("argument", places), ("flag", flags)):
        rows = [(f"`{_spelling(each)}`", _meaning(each)) for each in found]
        parts += [table((head, "meaning"), rows)] if rows else []
    return "\n".join(parts)


def _place(action: Action) -> str:
    """An argument without a name, in the usage."""
    name = str(action.metavar or action.dest)
    forms = {"?": "[{}]", "*": "[{} ...]", "+": "{} ..."}
    return forms.get(str(action.nargs), "{}").format(name)


def _spelling(action: Action) -> str:
    """A flag with its value."""
    if not action.option_strings:
        return str(action.metavar or action.dest)
    names = ", ".join(action.option_strings)
    if action.nargs == 0:
        return names
    value = action.metavar or "|".join(map(str, action.choices or ())) or action.dest.upper()
    return f"{names} {value}{' ...' if action.nargs in ('+', '*') else ''}"


def _meaning(action: Action) -> str:
    return (action.help or "").replace("%%", "%")

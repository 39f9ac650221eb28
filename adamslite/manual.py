"""The manual, written by the registers that it describes.

They hold statements, functions, messages, outcomes, integrators and formats of result files. A page
is Markdown that reads as well in a terminal. `adamslite help NAME` prints one; the files in docs/
are all of them together.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from inspect import cleandoc, getattr_static

from adamslite import elements, functions  # noqa: F401  register what there is to describe
from adamslite.deck.names import MEANINGS
from adamslite.errors import UsageError
from adamslite.language.expression import Node, to_text
from adamslite.language.function import FUNCTIONS, Function, Parameter, listed
from adamslite.language.messages import MESSAGES, did_you_mean
from adamslite.language.messages.entry import Message
from adamslite.language.method import ARGUMENTS, Method, declared, methods
from adamslite.language.not_supported import COMMANDS as MISSING_COMMANDS
from adamslite.language.not_supported import FUNCTIONS as MISSING_FUNCTIONS
from adamslite.language.not_supported import INSTEAD
from adamslite.language.not_supported import STATEMENTS as MISSING_STATEMENTS
from adamslite.language.statement import STATEMENTS, Argument, Statement
from adamslite.results.formats import formats
from adamslite.results.outcomes import Outcome

HEAD = "<!-- Written by docs/generate.py from the program itself: do not edit. -->\n"
STATEMENTS_INTRO = """# Statements

The statements of a deck, their equations and arguments. Keywords may be shortened to any
unambiguous beginning; `adamslite help NAME` prints a single page.
"""
FUNCTIONS_INTRO = """# Functions

The functions of expressions. Arguments in brackets may be left out: an omitted marker is the ground
frame, an omitted number its default. `adamslite help NAME` prints a single entry.
"""
MESSAGES_INTRO = """# Messages

Every message about a deck, each with the smallest deck that causes it: statements added to a
correct deck, or a whole deck where they begin with a title. Words in braces are filled in.
"""
INTEGRATORS_INTRO = """# Integrators

The methods of INTEGRATOR, and what each of its arguments does with each of them.
"""
ARGUMENTS_INTRO = """## Arguments of INTEGRATOR

Where an argument has no effect, `check` and the comments of the results report that; the reason is
given in brackets.
"""
FORMATS_INTRO = """# Formats of result files

The suffix of a name decides: `adamslite solve DECK -o NAME.csv`. What can be read can be compared:
`adamslite diff A B`.
"""
OUTCOMES_INTRO = """## How a run can end

The summary and the result file contain the name of the outcome; the message contains its sentence.
"""
LISTED = "`adamslite help` lists them"
# Longer cells of a table stick out instead of widening their column.
WIDEST = 44
Row = Sequence[str]


def statements() -> str:
    """The page of all statements: docs/reference/statements.md."""
    pages = (statement(STATEMENTS[keyword]) for keyword in sorted(STATEMENTS))
    missing = _missing("statement or command", MISSING_STATEMENTS | MISSING_COMMANDS)
    return "\n".join([HEAD, STATEMENTS_INTRO, *pages, missing])


def _missing(kind: str, names: Iterable[str]) -> str:
    """What is not supported of a kind, and what to write instead."""
    rows = [(f"`{name}`", INSTEAD[name]) for name in sorted(names)]
    return f"## Not supported\n\n{table((kind, 'instead'), rows)}"


def deck_functions() -> str:
    """The page of all functions by family: docs/reference/functions.md."""
    parts, family = [HEAD, FUNCTIONS_INTRO], ""
    for each in FUNCTIONS.values():
        if each.body.__module__ != family:
            family = each.body.__module__
            parts.append(f"## {_heading(sys.modules[family].__doc__)}\n")
        parts.append(function(each))
    constants = table(("name", "value"), [(f"`{name}`", text) for name, text in MEANINGS.items()])
    parts += [f"## Constants\n\n{constants}", _missing("function", MISSING_FUNCTIONS)]
    return "\n".join(parts)


def messages() -> str:
    """The page of all messages and outcomes: docs/reference/messages.md."""
    entries = (message(code, each) for code, each in MESSAGES.items())
    outcomes = table(("outcome", "sentence"), [(f"`{o.name}`", o.value) for o in Outcome])
    return "\n".join([HEAD, MESSAGES_INTRO, *entries, OUTCOMES_INTRO, outcomes])


def integrators() -> str:
    """The page of methods and arguments: docs/reference/integrators.md."""
    found = declared()
    head = ("argument", *(_listed(each.names) for each in found))
    rows = [(f"`{word}`", *(_use(each.use(word)) for each in found)) for word in ARGUMENTS]
    pages = (integrator(each) for each in found)
    return "\n".join([HEAD, INTEGRATORS_INTRO, *pages, ARGUMENTS_INTRO, table(head, rows)])


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
    lines = (_sentence([method.what]), f"Suited to {method.suited}.", _sentence(facts))
    return f"## {names}\n\n" + "\n\n".join(lines) + "\n"


def _up_to(method: Method) -> str:
    """The order of a method, the highest where KMAX may lower it."""
    return f"1 to {method.order}" if method.uses("KMAX") else f"{method.order}"


def _sentence(facts: Iterable[str]) -> str:
    text = "; ".join(facts)
    return f"{text[:1].upper()}{text[1:]}."


def _integrator_page(method: Method) -> str:
    """A method with its arguments, for the terminal."""
    rows = [(f"`{word}`", _use(method.use(word))) for word in ARGUMENTS]
    return f"{integrator(method)}\n{table(('argument', 'effect'), rows)}"


def result_formats() -> str:
    """The page of the formats of result files: docs/reference/formats.md."""
    rows = [
        (f"`{suffix}`", each.what, "written, read" if each.read else "written")
        for suffix, each in sorted(formats().items())
    ]
    return "\n".join([HEAD, FORMATS_INTRO, table(("suffix", "content", "can be"), rows)])


#: Pages of registers that are looked up as a whole.
TOPICS = {"INTEGRATORS": integrators, "FORMATS": result_formats}


def _use(text: str) -> str:
    return f"({text[1:]})" if text.startswith("-") else text


def pages(name: str) -> str:
    """Everything of this name: a statement, a function, an integrator, a message, a topic.

    Of a name that is not supported it is what to write instead.

    Raises
    ------
    UsageError
        When there is none.
    """
    upper, lower, found = name.upper(), name.lower(), []
    if upper in STATEMENTS:
        found.append(statement(STATEMENTS[upper]))
    if upper in FUNCTIONS:
        found.append(function(FUNCTIONS[upper]))
    if upper in methods():
        found.append(_integrator_page(methods()[upper]))
    if lower in MESSAGES:
        found.append(message(lower, MESSAGES[lower]))
    if upper in TOPICS:
        found.append(TOPICS[upper]().removeprefix(HEAD).lstrip())
    if upper in MEANINGS:
        found.append(f"## {upper}: {MEANINGS[upper]}\n")
    if upper in MISSING_STATEMENTS | MISSING_FUNCTIONS | MISSING_COMMANDS:
        found.append(f"## {upper}: not supported\n\nInstead: {INSTEAD[upper]}.\n")
    if not found:
        names = [*STATEMENTS, *FUNCTIONS, *methods(), *MESSAGES, *TOPICS]
        longer = [each for each in names if each.startswith(name.upper())]
        hint = did_you_mean(name, names) if len(longer) != 1 else f"did you mean {longer[0]}?"
        raise UsageError(f"nothing here is called '{name}'; {hint or LISTED}")
    return "\n".join(found)


def contents() -> str:
    """All names with their meaning in a line each."""
    titles = [_module_doc(cls) for cls in STATEMENTS.values()]
    lines = ["Statements", *(f"  {_heading(title)}" for title in sorted(titles)), "", "Functions"]
    lines += [f"  {each.usage}: {_heading(each.doc)}" for each in FUNCTIONS.values()]
    lines += ["", "Integrators", *(f"  {', '.join(m.names)}: {m.what}" for m in declared())]
    lines += ["", "Topics", *(f"  {name}" for name in TOPICS)]
    return "\n".join(lines) + "\n"


def _module_doc(cls: type[Statement]) -> str:
    return getattr(cls, "heading", "") or sys.modules[cls.__module__].__doc__ or ""


def statement(cls: type[Statement]) -> str:
    """One statement: equation and sign from its module, its meaning, its arguments."""
    title, _, equation = _module_doc(cls).partition("\n\n")
    parts = [f"## {title}\n", _markdown(cls.__doc__)]
    parts += [_markdown(equation)] if equation else []
    if cls.arguments:
        head = ("argument", "value", "unit", "default", "meaning")
        parts.append(table(head, [_argument_row(each) for each in cls.arguments.values()]))
    if known := getattr(cls, "known", ()):
        rows = [(_listed(names.split(", ")), meaning) for names, meaning in known]
        parts.append(table(("argument", "meaning"), rows))
    names = getattr_static(cls, "result_names")
    if names is not getattr_static(Statement, "result_names"):
        parts.append(f"Results: {_lower_first(_heading(names.__doc__))}.\n")
    if cls.planned:
        rows = [(f"`{word}`", INSTEAD[f"{cls.keyword} {word}"]) for word in cls.planned]
        parts.append(table(("not supported", "instead"), rows))
    return "\n".join(parts)


def function(each: Function) -> str:
    """One function: how it is called, what it is, what its arguments are."""
    lines = [*each.doc.splitlines(), "", *map(_parameter, each.parameters)]
    # A block of code, because ** in it means a power.
    body = "".join(f"    {line}".rstrip() + "\n" for line in lines)
    return f"### `{each.usage}`\n\n{body}"


def message(code: str, each: Message) -> str:
    """One message: sentence, hint and example."""
    text = f"{each.severity}: {each.sentence}"
    if each.hint:
        text += f"  \nhint: {each.hint}"
    example = each.deck + (each.broken or each.commands)[0].rstrip("\n")
    bound = f'\n\nwith `--user "{each.user[0]}"`' if each.user else ""
    return f"## `{code}`\n\n{text}\n\n```\n{example}\n```{bound}\n"


def table(head: Row, rows: Iterable[Row]) -> str:
    """A Markdown table with its columns lined up."""
    lines = [head, *([cell.replace("|", "\\|") for cell in row] for row in rows)]
    widths = [min(WIDEST, max(map(len, column))) for column in zip(*lines, strict=True)]
    lines.insert(1, ["-" * width for width in widths])
    return "".join(
        f"| {' | '.join(c.ljust(w) for c, w in zip(line, widths, strict=True))} |\n"
        for line in lines
    )


def argument(each: Argument) -> str:
    """One argument by itself."""
    key, value, unit, default, meaning = _argument_row(each)
    omitted = default if each.required else default and f"default {default}"
    facts = [value, unit and f"in {unit}", omitted]
    return f"{key}: {meaning}\n\n{'; '.join(filter(None, facts))}\n"


def _argument_row(each: Argument) -> Row:
    key = "(a word)" if each.bare else f"`{each.key}`"
    aliases = f" ({_listed(each.keys[1:])})" if each.keys[1:] else ""
    passed = "; passed over" if each.inert else ""
    return (key + aliases, _value(each), each.unit, _default(each), each.help + passed)


def _value(each: Argument) -> str:
    """What stands behind the equal sign, or instead of it."""
    if each.kind == "choice":
        ready = each.supported or each.options
        gone = [option for option, _ in each.discontinued]
        later = [option for option in each.options if option not in (*ready, *gone)]
        notes = [("not yet", later), ("discontinued", gone)]
        return "; ".join([_listed(ready), *(f"{why} {_listed(w)}" for why, w in notes if w)])
    if each.kind == "vector":
        low, high = each.sizes
        return f"{low} numbers" if low == high else f"{low} to {high} numbers"
    if each.kind == "vectors":
        return f"{each.sizes[0]} to {each.sizes[1]} numbers, once or more"
    kinds = {
        "reference": f"{'an' if each.to[:1] in 'AEIO' else 'a'} {each.to}",
        "references": f"several {each.to}",
        "words": f"{_listed(each.options)}, joined by `:`",
        "flag": "(no value)",
    }
    return kinds.get(each.kind, each.kind)


def _default(each: Argument) -> str:
    if each.required:
        return "required"
    if each.default is None or each.kind in ("flag", "texts", "words", "references", "vectors"):
        return ""
    if each.kind == "reference":
        return "ground"
    if isinstance(each.default, Node):
        return to_text(each.default)
    if isinstance(each.default, tuple):
        return ", ".join(f"{number:g}" for number in each.default)
    return f"`{each.default}`" if isinstance(each.default, str) else f"{each.default:g}"


def _parameter(p: Parameter) -> str:
    kinds = {"number": "number", "constant": "number written in the deck"}
    text = f"  {p.name:10}{kinds.get(p.kind, p.statement)}"
    if p.allowed:
        text += f", {listed(p.allowed)}"
    if p.counts:
        low, high = p.counts
        text += f", {low} to {high} of them" if high else f", {low} or more"
    if p.default is not None:
        text += f" (default {'ground' if p.statement else f'{p.default:g}'})"
    return text


def _markdown(doc: str | None) -> str:
    lines = cleandoc(doc or "").replace("``", "`").splitlines()
    return "\n".join(line[:-1] if line.endswith("::") else line for line in lines) + "\n"


def _heading(doc: str | None) -> str:
    return (doc or "").strip().partition("\n")[0].rstrip(".")


def _lower_first(text: str) -> str:
    return text if text[:2].isupper() else text[:1].lower() + text[1:]


def _listed(words: Iterable[str]) -> str:
    return ", ".join(f"`{word}`" for word in words)

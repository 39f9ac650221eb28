"""Pages of statements and of their arguments."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from inspect import cleandoc, getattr_static

from adamslite.language.expression import Node, to_text
from adamslite.language.not_supported import COMMANDS, INSTEAD
from adamslite.language.not_supported import STATEMENTS as MISSING
from adamslite.language.statement import STATEMENTS, Argument, Statement
from adamslite.manual.markdown import (
    HEAD,
    Row,
    code_list,
    heading,
    lower_first,
    markdown,
    markdown_of_clean,
    not_supported,
    table,
)

INTRO = """# Statements

The statements of a deck, their equations and arguments. Keywords may be shortened to any
unambiguous beginning; `adamslite help NAME` prints a single page.
"""


def statements() -> str:
    """The page of all statements: docs/reference/statements.md."""
    pages = (statement(STATEMENTS[keyword]) for keyword in sorted(STATEMENTS))
    missing = not_supported("statement or command", MISSING | COMMANDS)
    return "\n".join([HEAD, INTRO, *pages, missing])


def statement(cls: type[Statement]) -> str:
    """One statement: equation and sign from its module, its meaning, its arguments."""
    title, _, equation = cleandoc(title_of(cls)).partition("\n\n")
    parts = [f"## {heading(title)}\n", markdown(cls.__doc__)]
    parts += [markdown_of_clean(equation)] if equation else []
    if cls.arguments:
        head = ("argument", "value", "unit", "default", "meaning")
        parts.append(table(head, [argument_row(each) for each in cls.arguments.values()]))
    if known := getattr(cls, "known", ()):
        rows = [(code_list(names.split(", ")), meaning) for names, meaning in known]
        parts.append(table(("argument", "meaning"), rows))
    names = getattr_static(cls, "result_names")
    if names is not getattr_static(Statement, "result_names"):
        parts.append(f"Results: {lower_first(heading(names.__doc__))}.\n")
    if cls.planned:
        rows = [(f"`{word}`", INSTEAD[f"{cls.keyword} {word}"]) for word in cls.planned]
        parts.append(table(("not supported", "instead"), rows))
    return "\n".join(parts)


def title_of(cls: type[Statement]) -> str:
    return getattr(cls, "heading", "") or sys.modules[cls.__module__].__doc__ or ""


def argument(each: Argument) -> str:
    """One argument by itself."""
    key, value, unit, default, meaning = argument_row(each)
    omitted = default if each.required else default and f"default {default}"
    facts = [value, unit and f"in {unit}", omitted]
    return f"{key}: {meaning}\n\n{'; '.join(filter(None, facts))}\n"


def argument_row(each: Argument) -> Row:
    """Keyword, kind of value, unit, default, meaning."""
    key = "(a word)" if each.bare else f"`{each.key}`"
    aliases = f" ({code_list(each.keys[1:])})" if each.keys[1:] else ""
    passed = "; passed over" if each.inert else ""
    return (key + aliases, _value(each), each.unit, _default(each), each.help + passed)


def _value(each: Argument) -> str:
    """What stands behind the equal sign, or instead of it."""
    if each.kind == "choice":
        ready = each.supported or each.options
        gone = [option for option, _ in each.discontinued]
        later = [option for option in each.options if option not in (*ready, *gone)]
        notes = [("not yet", later), ("discontinued", gone)]
        return "; ".join([code_list(ready), *(f"{why} {code_list(w)}" for why, w in notes if w)])
    if each.kind == "vector":
        low, high = each.sizes
        return f"{low} numbers" if low == high else f"{low} to {high} numbers"
    if each.kind == "vectors":
        return f"{each.sizes[0]} to {each.sizes[1]} numbers, once or more"
    kinds = {
        "reference": f"{'an' if each.to[:1] in 'AEIO' else 'a'} {each.to}",
        "references": f"several {each.to}",
        "words": f"{code_list(each.options)}, joined by `:`",
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


def keywords_of(keyword: str) -> list[str]:
    """The arguments of a statement that have a keyword, with their other spellings."""
    cls = STATEMENTS[keyword]
    known = (name for names, _ in getattr(cls, "known", ()) for name in names.split(", "))
    own = (key for each in cls.arguments.values() if not each.bare for key in each.keys)
    return [*own, *known]


USES = ("statement", "argument", "value", "unit", "default", "meaning")


def argument_names() -> list[str]:
    """Every keyword of an argument, once."""
    return [*dict.fromkeys(key for keyword in STATEMENTS for key in keywords_of(keyword))]


def argument_page(name: str) -> str:
    """One argument: the statements that have it, those with the same meaning in one row."""
    found: dict[tuple[str, ...], list[str]] = {}
    for keyword, row in _rows(name):
        found.setdefault(tuple(row), []).append(keyword)
    rows = ((", ".join(keywords), *row) for row, keywords in found.items())
    return f"## {name}: an argument\n\n{table(USES, rows)}"


def _rows(name: str) -> Iterator[tuple[str, Row]]:
    """Keyword of a statement and the row of the argument in its table."""
    for keyword, cls in sorted(STATEMENTS.items()):
        for each in cls.arguments.values():
            if name in each.keys and not each.bare:
                yield keyword, argument_row(each)
        for names, meaning in getattr(cls, "known", ()):
            if name in names.split(", "):
                yield keyword, (f"`{name}`", "", "", "", f"{meaning}; passed over")

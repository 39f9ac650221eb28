"""Pieces of Markdown: headings, tables, lists of names."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from inspect import cleandoc

from adamslite.language.not_supported import INSTEAD

HEAD = "<!-- Written by docs/generate.py from the program itself: do not edit. -->\n"
# Longer cells of a table stick out instead of widening their column.
WIDEST = 44
Row = Sequence[str]


def table(head: Row, rows: Iterable[Row]) -> str:
    """A Markdown table with its columns lined up."""
    lines = [head, *([cell.replace("|", "\\|") for cell in row] for row in rows)]
    widths = [min(WIDEST, max(map(len, column))) for column in zip(*lines, strict=True)]
    lines.insert(1, ["-" * width for width in widths])
    return "".join(
        f"| {' | '.join(c.ljust(w) for c, w in zip(line, widths, strict=True))} |\n"
        for line in lines
    )


def heading(doc: str | None) -> str:
    return (doc or "").strip().partition("\n")[0].rstrip(".")


def sentence(facts: Iterable[str]) -> str:
    text = "; ".join(facts)
    return f"{text[:1].upper()}{text[1:]}."


def markdown(doc: str | None) -> str:
    """A docstring; what it indents remains indented, as code."""
    return markdown_of_clean(cleandoc(doc or ""))


def markdown_of_clean(text: str) -> str:
    """The same of a piece of a docstring whose margin is at its left edge already."""
    lines = text.replace("``", "`").splitlines()
    return "\n".join(line[:-1] if line.endswith("::") else line for line in lines) + "\n"


def code_list(words: Iterable[str]) -> str:
    return ", ".join(f"`{word}`" for word in words)


def lower_first(text: str) -> str:
    return text if text[:2].isupper() else text[:1].lower() + text[1:]


def not_supported(kind: str, names: Iterable[str]) -> str:
    """What is not supported of a kind, and what to write instead."""
    rows = [(f"`{name}`", INSTEAD[name]) for name in sorted(names)]
    return f"## Not supported\n\n{table((kind, 'instead'), rows)}"

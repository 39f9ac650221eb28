"""Diagnostics for other programs: lines as compilers print them, JSON, and SARIF 2.1.0.

SARIF: Static Analysis Results Interchange Format, OASIS Standard, version 2.1.0 (2020).
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

from adamslite import __version__
from adamslite.language.diagnostics import Diagnostic, Edit, Span
from adamslite.language.messages import MESSAGES

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"


def as_gcc(diagnostics: Sequence[Diagnostic]) -> str:
    """One line ``file:line:column: severity: message [code]`` for each place."""
    return "".join(
        f"{f'{place}: ' if place.line else ''}{each.severity}: {each.message} [{each.code}]\n"
        for each in diagnostics
        for place in each.everywhere
    )


def as_json(diagnostics: Sequence[Diagnostic]) -> str:
    """A list of objects; ``span`` and ``places`` count lines and columns from 1."""
    return _written([_data(each) for each in diagnostics])


def as_sarif(diagnostics: Sequence[Diagnostic]) -> str:
    """One run with a rule for each code that occurs."""
    codes = list(dict.fromkeys(each.code for each in diagnostics))
    driver = {
        "name": "adamslite",
        "version": __version__,
        "rules": [_rule(code) for code in codes],
    }
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "results": [_result(each, codes.index(each.code)) for each in diagnostics],
    }
    return _written({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]})


FORMATS: dict[str, Callable[[Sequence[Diagnostic]], str]] = {
    "json": as_json, "sarif": as_sarif, "gcc": as_gcc,
}  # fmt: skip


def _written(data: object) -> str:
    return json.dumps(data, indent=2) + "\n"


def _data(each: Diagnostic) -> dict[str, Any]:
    return {
        "code": each.code,
        "severity": each.severity,
        "message": each.message,
        "hint": each.hint,
        "file": each.span.file,
        "span": _span(each.span),
        "source_line": each.source_line,
        "source_column": each.source_column,
        "places": [_place(place) for place in each.everywhere],
        "related": [{"message": text} | _place(place) for place, text in each.related],
        "fixes": [
            {"title": title, "edits": [_place(span) | {"text": text} for span, text in edits]}
            for title, edits in each.fixes
        ],
    }


def _place(span: Span) -> dict[str, Any]:
    return {"file": span.file} | _span(span)


def _span(span: Span) -> dict[str, int]:
    return _ends(span, "line", "column", "end_line", "end_column")


def _rule(code: str) -> dict[str, Any]:
    """What a message is about, with the words of the table that are filled in as ``<word>``."""
    rule: dict[str, Any] = {"id": code}
    if entry := MESSAGES.get(code):
        sentence, hint = (re.sub(r"\{(\w+)\}", r"<\1>", x) for x in (entry.sentence, entry.hint))
        rule["shortDescription"] = {"text": sentence}
        rule["help"] = {"text": hint or f"adamslite help {code}"}
        rule["defaultConfiguration"] = {"level": entry.severity}
    return rule


def _result(each: Diagnostic, rule: int) -> dict[str, Any]:
    text = f"{each.message}\n{each.hint}" if each.hint else each.message
    result: dict[str, Any] = {
        "ruleId": each.code,
        "ruleIndex": rule,
        "level": each.severity,
        "message": {"text": text},
    }
    if each.span.line:
        result["locations"] = [_location(each.span)]
    others = dict.fromkeys([*((place, "and here") for place in each.places[1:]), *each.related])
    if others:
        result["relatedLocations"] = [
            _location(place) | {"message": {"text": text}} for place, text in others
        ]
    if each.fixes:
        result["fixes"] = [_fix(title, edits) for title, edits in each.fixes]
    return result


def _fix(title: str, edits: Sequence[Edit]) -> dict[str, Any]:
    """A correction; its edits are in one file."""
    changes = [
        {"deletedRegion": _region(span), "insertedContent": {"text": text}} for span, text in edits
    ]
    place = {"artifactLocation": {"uri": _uri(edits[0].span)}, "replacements": changes}
    return {"description": {"text": title}, "artifactChanges": [place]}


def _location(span: Span) -> dict[str, Any]:
    place = {"artifactLocation": {"uri": _uri(span)}, "region": _region(span)}
    return {"physicalLocation": place}


def _uri(span: Span) -> str:
    path = Path(span.file)
    return path.as_uri() if path.is_absolute() else quote(path.as_posix())


def _region(span: Span) -> dict[str, int]:
    return _ends(span, "startLine", "startColumn", "endLine", "endColumn")


def _ends(span: Span, *names: str) -> dict[str, int]:
    """First and last place of a span under the names that a format has for them."""
    ends = (span.line, span.column, span.end_line, span.end_column)
    return dict(zip(names, ends, strict=True))

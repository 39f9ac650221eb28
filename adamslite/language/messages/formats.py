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
from adamslite.language.diagnostics import Diagnostic, Span
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
        "places": [{"file": place.file} | _span(place) for place in each.everywhere],
    }


def _span(span: Span) -> dict[str, int]:
    return {
        "line": span.line,
        "column": span.column,
        "end_line": span.end_line,
        "end_column": span.end_column,
    }


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
    if each.places[1:]:
        result["relatedLocations"] = [
            _location(place) | {"message": {"text": "and here"}} for place in each.places[1:]
        ]
    return result


def _location(span: Span) -> dict[str, Any]:
    path = Path(span.file)
    uri = path.as_uri() if path.is_absolute() else quote(path.as_posix())
    region = {
        "startLine": span.line,
        "startColumn": span.column,
        "endLine": span.end_line,
        "endColumn": span.end_column,
    }
    return {"physicalLocation": {"artifactLocation": {"uri": uri}, "region": region}}

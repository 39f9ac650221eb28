"""TextMate grammars of decks and command files: what editors colour, from the registers."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from adamslite.deck.names import RESERVED
from adamslite.language.abbreviations import PREFERRED, match
from adamslite.language.function import FUNCTIONS
from adamslite.language.statement import STATEMENTS
from adamslite.reading.statement_reader import known_keywords
from adamslite.syntax.forms import terminals

DECK, COMMANDS = "source.adams", "source.adams.command"
ID = r"(?:[ \t]*([\w.]+(?=[ \t]*(?:[,!;]|$))))"
"""What stands behind the slash, where it is followed by an argument or by nothing."""
Grammar = dict[str, Any]


def deck_grammar() -> Grammar:
    """The grammar of decks: a title, then statements."""
    title = {"name": "markup.heading.title.adams", "match": r"\A[^\n]*$"}
    return {
        "name": "ADAMS deck",
        "scopeName": DECK,
        "fileTypes": ["adm"],
        "patterns": [title, {"include": "#body"}],
        "repository": {
            "body": {"patterns": [{"include": f"#{name}"} for name in _rules()]},
            **_rules(),
        },
    }


def command_grammar() -> Grammar:
    """The grammar of command files: statements only."""
    return {
        "name": "ADAMS commands",
        "scopeName": COMMANDS,
        "fileTypes": ["acf"],
        "patterns": [{"include": f"{DECK}#body"}],
    }


def _rules() -> dict[str, Grammar]:
    """The rules by name; where several fit, the first counts."""
    number = terminals()["NUMBER"]
    ends = [keyword for keyword, cls in STATEMENTS.items() if cls.ends]
    return {
        "ignored": _rule("(?i)(!.*adamslite:[ \\t]*)(ignore\\b[^\\n]*)$", {
            "1": "comment.line.adams", "2": "keyword.control.directive.adams",
        }),
        "called": _rule("(?i)(![ \\t]*adams_view_name[ \\t]*=[ \\t]*)('[^']*')", {
            "1": "comment.line.adams", "2": "entity.name.tag.adams",
        }),
        "comment": _rule("![^\\n]*$", {"0": "comment.line.adams"}),
        "text": _rule('"[^"\\n]*"', {"0": "string.quoted.double.adams"}),
        "statement": _rule(f"(?i)(?:^|;)[ \\t]*({_abbreviated(False)})[ \\t]*(/){ID}?", {
            "1": "keyword.control.statement.adams",
            "2": "punctuation.separator.adams",
            "3": "entity.name.id.adams",
        }),
        "setting": _rule(f"(?i)(?:^|;)[ \\t]*({_abbreviated(True)})[ \\t]*(/)", {
            "1": "keyword.control.statement.adams", "2": "punctuation.separator.adams",
        }),
        "end": _rule(f"(?i)^[ \\t]*({_words(ends)})[ \\t]*$", {
            "1": "keyword.control.statement.adams",
        }),
        "function": _rule(f"(?i)\\b({_words(FUNCTIONS)})(?=[ \\t]*[\\(\\[])", {
            "1": "support.function.adams",
        }),
        "constant": _rule(f"(?i)\\b({_words(RESERVED)})\\b(?![ \\t]*=)", {
            "1": "constant.language.adams",
        }),
        "argument": _rule("(?i)\\b([a-z]\\w*)[ \\t]*(=)", {
            "1": "variable.parameter.adams", "2": "keyword.operator.assignment.adams",
        }),
        "option": _rule(f"(?i)\\b({_words(_options())})\\b", {
            "1": "constant.other.option.adams",
        }),
        "number": _rule(f"(?<![\\w.]){number}", {"0": "constant.numeric.adams"}),
        "operator": _rule("\\*\\*|[-+*/]", {"0": "keyword.operator.arithmetic.adams"}),
        "continuation": _rule("^[ \\t]*,|&[ \\t]*$|\\\\", {"0": "punctuation.separator.adams"}),
    }  # fmt: skip


def _rule(pattern: str, scopes: dict[str, str]) -> Grammar:
    return {
        "match": pattern,
        "captures": {number: {"name": scope} for number, scope in scopes.items()},
    }


def _words(words: Iterable[str]) -> str:
    """Any of the words, the longest first."""
    return "|".join(map(re.escape, sorted(words, key=lambda word: (-len(word), word))))


def _options() -> set[str]:
    """Flags and options of all statements, as words."""
    return {
        option
        for cls in STATEMENTS.values()
        for each in cls.arguments.values()
        for option in (each.keys if each.kind == "flag" else each.options)
        if len(option) > 1
    }


def _abbreviated(singleton: bool) -> str:
    """Every beginning of a statement's name that a deck or a command file may have.

    ``singleton``: of those without an id, or of all others.
    """
    tables = known_keywords("deck"), known_keywords("command")
    found = {}
    for keyword, meant in tables[1].items():
        if singleton != getattr(meant, "singleton", False):
            continue
        beginnings = (keyword[:length] for length in range(1, len(keyword) + 1))
        shortest = next(word for word in beginnings if any(_is(word, keyword, t) for t in tables))
        tail = ""
        for letter in reversed(keyword[len(shortest) :]):
            tail = f"(?:{letter}{tail})?"
        found[keyword] = shortest + tail
    return "|".join(found[word] for word in sorted(found, key=lambda word: (-len(word), word)))


def _is(word: str, keyword: str, table: Mapping[str, object]) -> bool:
    """Whether a word is read as a keyword."""
    return keyword in table and match(PREFERRED.get(word, word), table) == table[keyword]

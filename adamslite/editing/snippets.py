"""Snippets: a statement with its required arguments, a function with all of its arguments."""

from __future__ import annotations

from adamslite.language.expression import Node
from adamslite.language.function import FUNCTIONS, Function
from adamslite.language.statement import STATEMENTS, Argument, Statement

Snippet = dict[str, str | list[str]]


def snippets(place: str) -> dict[str, Snippet]:
    """The snippets of a deck or of a command file, by title."""
    found = {}
    for keyword, cls in sorted(STATEMENTS.items()):
        if cls.place in (place, "both"):
            found[keyword] = _snippet(keyword, statement(cls), _heading(cls))
    for name, function in FUNCTIONS.items():
        about = function.doc.partition("\n")[0]
        found[f"{name} (function)"] = _snippet(name, call(function), about)
    return found


def statement(cls: type[Statement]) -> str:
    """A statement with its required arguments, the values as places to fill in."""
    if cls.ends:
        return cls.keyword
    texts = [] if cls.singleton else ["${1:1}"]
    number = len(texts) + 1
    for argument in cls.arguments.values():
        if argument.required:
            texts.append(_argument(argument, number))
            number += 1
    return f"{cls.keyword}/{', '.join(texts)}$0"


def call(function: Function) -> str:
    """A call with the arguments that it needs."""
    names = [
        each.name
        for each in function.parameters
        for _ in range(each.counts[0] if each.counts else each.default is None)
    ]
    places = [f"${{{number}:{name}}}" for number, name in enumerate(names, 1)]
    if function.colon and len(places) > 1:
        places[:2] = [f"{places[0]}: {places[1]}"]
    return f"{function.name}({','.join(places)})$0"


def _argument(argument: Argument, number: int) -> str:
    options = argument.supported or argument.options
    if options:
        value = f"${{{number}|{','.join(options)}|}}"
    else:
        value = f"${{{number}:{_value(argument)}}}"
    return value if argument.bare else f"{argument.key}={value}"


def _value(argument: Argument) -> str:
    """A value that may stand for the argument until there is another one."""
    kind = argument.kind
    if kind in ("vector", "vectors"):
        return ",".join(["0"] * argument.sizes[0])
    if kind == "expression":
        return "0"
    if kind in ("text", "texts"):
        return argument.key.lower()
    default = argument.default
    return "1" if default is None or isinstance(default, Node | tuple | bool) else str(default)


def _heading(cls: type[Statement]) -> str:
    return (cls.__doc__ or "").strip().partition("\n")[0]


def _snippet(prefix: str, body: str, description: str) -> Snippet:
    return {"prefix": prefix, "body": [body], "description": description}

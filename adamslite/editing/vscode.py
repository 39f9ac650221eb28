"""A folder for VS Code: colours, snippets, and a client of the language server."""

from __future__ import annotations

import json
from pathlib import Path

from adamslite import __version__
from adamslite.editing.textmate import COMMANDS, DECK, command_grammar, deck_grammar
from adamslite.language.expression import Node
from adamslite.language.function import FUNCTIONS, Function
from adamslite.language.statement import STATEMENTS, Argument, Statement
from adamslite.outputs.whole_files import whole_file

LANGUAGES = {"adams": (DECK, "adm", "deck"), "adams-command": (COMMANDS, "acf", "command")}
"""Names of the languages; of each its grammar, suffix and place of statements."""
CLIENT = Path(__file__).with_name("extension.js")


def files() -> dict[str, str]:
    """Contents of all files by their names within a folder."""
    grammars = {"adams": deck_grammar(), "adams-command": command_grammar()}
    found = {}
    for language, (_, _, place) in LANGUAGES.items():
        for folder in ("", "vscode/"):
            found[f"{folder}{language}.tmLanguage.json"] = _json(grammars[language])
            found[f"{folder}{language}.snippets.json"] = _json(snippets(place))
    found["vscode/package.json"] = _json(package())
    found["vscode/language-configuration.json"] = _json(configuration())
    found["vscode/extension.js"] = CLIENT.read_text(encoding="utf-8")
    return found


def write(folder: Path) -> None:
    """Write all files, each whole or not at all."""
    for name, text in files().items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with whole_file(path) as stream:
            stream.write(text)


def package() -> dict[str, object]:
    """The manifest of the extension."""
    languages, grammars, texts = [], [], []
    for language, (scope, suffix, place) in LANGUAGES.items():
        languages.append({
            "id": language,
            "aliases": [f"ADAMS {place}"],
            "extensions": [f".{suffix}", f".{suffix.upper()}"],
            "configuration": "./language-configuration.json",
        })  # fmt: skip
        path = f"./{language}.tmLanguage.json"
        grammars.append({"language": language, "scopeName": scope, "path": path})
        texts.append({"language": language, "path": f"./{language}.snippets.json"})
    command = {
        "type": "array",
        "items": {"type": "string"},
        "default": ["adamslite", "lsp"],
        "markdownDescription": "The command that starts the language server.",
        "scope": "machine",
    }
    return {
        "name": "adamslite",
        "displayName": "ADAMS decks (adamslite)",
        "description": "Checks, explains and lays out ADAMS/Solver decks",
        "publisher": "adamslite",
        "version": __version__,
        "engines": {"vscode": "^1.75.0"},
        "categories": ["Programming Languages", "Linters", "Formatters", "Snippets"],
        "main": "./extension.js",
        "capabilities": {"untrustedWorkspaces": {"supported": True}},
        "contributes": {
            "languages": languages,
            "grammars": grammars,
            "snippets": texts,
            "configuration": {
                "title": "adamslite",
                "properties": {"adamslite.command": command},
            },
        },
    }


def configuration() -> dict[str, object]:
    """Comments, brackets and words."""
    pairs = [["(", ")"], ["[", "]"]]
    return {
        "comments": {"lineComment": "!"},
        "brackets": pairs,
        "autoClosingPairs": [*pairs, ['"', '"']],
        "surroundingPairs": [*pairs, ['"', '"']],
        "wordPattern": r"[^\s,=!;:/\\()\[\]+*&\"'-]+",
    }


def _json(data: object) -> str:
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"


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

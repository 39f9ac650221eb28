"""A folder for VS Code: colours, snippets, and a client of the language server."""

from __future__ import annotations

import json
from pathlib import Path

from adamslite import __version__
from adamslite.editing.snippets import snippets
from adamslite.editing.textmate import COMMANDS, DECK, command_grammar, deck_grammar
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

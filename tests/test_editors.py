"""What editors are given: `adamslite editors`."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from decklets import told

from adamslite.cli.main import main
from adamslite.editing.textmate import deck_grammar
from adamslite.editing.vscode import call, files, statement
from adamslite.language.abbreviations import PREFERRED, match
from adamslite.language.function import FUNCTIONS
from adamslite.language.messages import START
from adamslite.language.statement import STATEMENTS
from adamslite.reading.statement_reader import known_keywords

RULES: dict[str, dict[str, Any]] = deck_grammar()["repository"]
PATTERNS = {name: re.compile(rule["match"]) for name, rule in RULES.items() if name != "body"}
HOST = Path(__file__).with_name("vscode_host.js")
PLACE = re.compile(r"\$\{\d+[:|]([^}|,]*)(?:,[^}|]*)?[}|]+")


def scopes(line: str) -> list[tuple[str, str]]:
    """The words of a line with their scopes, as an editor applies the rules."""
    found, at = [], 0
    while at < len(line):
        hits = [(hit.start(), n, hit, name) for n, (name, p) in enumerate(PATTERNS.items())
                if (hit := p.search(line, at)) and hit.end() > at]  # fmt: skip
        if not hits:
            break
        _, _, hit, name = min(hits, key=lambda each: each[:2])
        for number, capture in RULES[name]["captures"].items():
            if hit[int(number)]:
                found.append((hit[int(number)], capture["name"].rpartition(".adams")[0]))
        at = hit.end()
    return found


def test_every_file_of_the_folder_is_there_and_valid(tmp_path: Path, capsys) -> None:
    assert main(["editors", str(tmp_path / "new")]) == 0
    listed = [Path(line) for line in capsys.readouterr().out.splitlines()]
    assert sorted(listed) == sorted(p for p in (tmp_path / "new").rglob("*") if p.is_file())
    for path in listed:
        if path.suffix == ".json":
            json.loads(path.read_text(encoding="utf-8"))
    package = json.loads((tmp_path / "new/vscode/package.json").read_text(encoding="utf-8"))
    made = package["contributes"]
    named = [each["path"] for each in (*made["grammars"], *made["snippets"])]
    named += [each["configuration"] for each in made["languages"]] + [package["main"]]
    assert all((tmp_path / "new/vscode" / name).is_file() for name in named)


@pytest.mark.parametrize("keyword", STATEMENTS)
def test_every_statement_is_coloured(keyword: str) -> None:
    for word in (keyword, keyword.lower()):
        text = f"{word}/1, A=1"
        (found,) = [w for w, scope in scopes(text) if scope == "keyword.control.statement"]
        assert found == word


def test_every_abbreviation_is_coloured() -> None:
    table = known_keywords("deck")
    for keyword, meant in table.items():
        for length in range(1, len(keyword)):
            word = keyword[:length]
            if match(PREFERRED.get(word, word), table) == meant:
                line = f"{word}/1"
                assert PATTERNS["statement"].fullmatch(line) or PATTERNS["setting"].match(line)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_is_coloured(name: str) -> None:
    assert (name, "support.function") in scopes(f", FUNCTION=2*{name}(1,2)")


def test_the_colours_of_some_lines() -> None:
    assert scopes("JOINT/12, REVOLUTE, I=3 ! why") == [
        ("JOINT", "keyword.control.statement"),
        ("/", "punctuation.separator"),
        ("12", "entity.name.id"),
        ("REVOLUTE", "constant.other.option"),
        ("I", "variable.parameter"),
        ("=", "keyword.operator.assignment"),
        ("3", "constant.numeric"),
        ("! why", "comment.line"),
    ]
    assert scopes("!   adams_view_name='cm'")[1] == ("'cm'", "entity.name.tag")
    assert scopes("! reason # adamslite: ignore no-mass")[1][1] == "keyword.control.directive"
    assert scopes(", FX=-1.5E3*90D\\")[-3:] == [
        ("*", "keyword.operator.arithmetic"),
        ("90D", "constant.numeric"),
        ("\\", "punctuation.separator"),
    ]
    assert scopes("INTEGRATOR/GSTIFF, SI2")[2] == ("GSTIFF", "constant.other.option")
    assert scopes("END") == [("END", "keyword.control.statement")]


FORM = frozenset(
    """unknown-argument ambiguous-argument unknown-choice value-count not-a-number
    not-an-integer argument-count wrong-separator unexpected-value bad-id missing-id""".split()
)


def inserted(body: str) -> str:
    """A snippet as it is inserted: every place has its value, of a choice the first."""
    return PLACE.sub(r"\1", body).replace("$0", "")


@pytest.mark.parametrize("keyword", [k for k, cls in STATEMENTS.items() if cls.place != "command"])
def test_a_snippet_of_a_statement_has_its_form(keyword: str) -> None:
    text = inserted(statement(STATEMENTS[keyword]))
    assert not {each.code for each in told(f"{START}{text}\n")} & FORM


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_snippet_of_a_function_has_its_form(name: str) -> None:
    text = re.sub(r"\$\{\d+:\w+\}", "1", call(FUNCTIONS[name])).replace("$0", "")
    found = {each.code for each in told(f"{START}REQUEST/1, F2={text}\n")}
    assert not found & FORM - {"function-rule"}


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("node"), reason="needs node")
def test_the_extension_drives_the_server(tmp_path: Path) -> None:
    """In a stand-in for VS Code, which sees what a user of the editor would see."""
    pytest.importorskip("pygls.lsp.server", reason="the extra [lsp] is not installed")
    extension = tmp_path / "extension.js"
    extension.write_text(files()["vscode/extension.js"], encoding="utf-8")
    command = ["node", str(HOST), str(extension), sys.executable, "-m", "adamslite", "lsp"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.stderr == "" and done.returncode == 0
    first, second = map(json.loads, done.stdout.splitlines())
    assert first["told"] == [["unknown-argument", 0, 2]]
    assert first["hover"] == "## MARKER"
    assert "QP" in first["labels"]
    assert first["actions"] == [["write PART", "PART"]]
    assert "PART/1" in first["symbols"]
    assert second == {"told": []}


@pytest.mark.skipif(not shutil.which("node"), reason="needs node")
def test_the_extension_tells_that_there_is_no_server(tmp_path: Path) -> None:
    extension = tmp_path / "extension.js"
    extension.write_text(files()["vscode/extension.js"], encoding="utf-8")
    missing = str(tmp_path / "missing")
    command = ["node", str(HOST), str(extension), missing]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert missing in json.loads(done.stdout.splitlines()[0])["error"]

"""`check --format`: the same messages as lines of a compiler, as JSON and as SARIF."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from decklets import told
from test_messages import whole

from adamslite.cli.main import main
from adamslite.language.messages import MESSAGES
from adamslite.language.messages.formats import as_gcc, as_json, as_sarif

DECK = """\
two springs too many
PART/1, GROUND
MARKER/1, PART=1, QP=1,0,0
PART/2, MASS=1, CM=2
MARKER/2, PART=2
SFORCE/1, I=2, J=1, TRANSLATION, FUNCTION=1+INVPSD(1, 0)
SFORCE/2, I=2, J=1, TRANSLATION, FUNCTION=INVPSD(2, 0)
SIMULATE/DYNAMICS, DURATION=1, STEPS=1
END
"""
HEALTHY = DECK.replace("1+INVPSD(1, 0)", "1").replace("INVPSD(2, 0)", "2")
SILENT = HEALTHY.replace("CM=2", "CM=2, IP=1,1,1")


@pytest.fixture
def check(tmp_path: Path, monkeypatch, capsys):
    """Check a text as `a deck.adm` in a format: exit code and what is printed."""
    monkeypatch.chdir(tmp_path)

    def run(form: str, text: str, name: str = "a deck.adm") -> tuple[int, str]:
        Path(name).write_text(text, encoding="utf-8")
        return main(["check", name, "--format", form]), capsys.readouterr().out

    return run


def test_gcc_has_a_line_for_each_place(check) -> None:
    code, out = check("gcc", DECK)
    assert code == 3
    lines = out.splitlines()
    assert lines[0] == "a deck.adm:4:1: warning: PART/2 has no inertia IP [no-inertia]"
    assert [line.partition(": error: ")[0] for line in lines[1:]] == [
        "a deck.adm:6:45",
        "a deck.adm:7:43",
    ]
    assert all(line.endswith("[planned-function]") for line in lines[1:])


def test_json_has_every_field_and_every_place(check) -> None:
    code, out = check("json", DECK)
    assert code == 3
    warning, error = json.loads(out)
    line = DECK.splitlines()[3]
    assert warning == {
        "code": "no-inertia",
        "severity": "warning",
        "message": "PART/2 has no inertia IP",
        "hint": "a body that does not rotate is a POINT_MASS; else give IP=xx,yy,zz",
        "file": "a deck.adm",
        "span": (span := {"line": 4, "column": 1, "end_line": 4, "end_column": 1 + len(line)}),
        "source_line": line,
        "places": [{"file": "a deck.adm"} | span],
    }
    assert error["code"] == "planned-function" and "2 times" in error["message"]
    lines = DECK.splitlines()
    for place in error["places"]:
        written = lines[place["line"] - 1][place["column"] - 1 : place["end_column"] - 1]
        assert written == "INVPSD"
    assert [place["line"] for place in error["places"]] == [6, 7]


def test_a_note_of_what_is_passed_over_has_its_places(check) -> None:
    text = SILENT.replace("END", "STRING/1, STRING=a\nSTRING/2, STRING=b\nEND")
    code, out = check("json", text)
    (note,) = json.loads(out)
    assert code == 0 and (note["code"], note["severity"]) == ("passed-over", "note")
    assert [(place["line"], place["column"]) for place in note["places"]] == [(9, 1), (10, 1)]


def test_sarif_has_rules_and_regions(check) -> None:
    code, out = check("sarif", DECK)
    log: dict[str, Any] = json.loads(out)
    assert code == 3 and log["version"] == "2.1.0" and "sarif-2.1.0" in log["$schema"]
    (run,) = log["runs"]
    rules = run["tool"]["driver"]["rules"]
    assert [rule["id"] for rule in rules] == ["no-inertia", "planned-function"]
    assert rules[0]["shortDescription"]["text"] == "<label> has no inertia IP"
    assert rules[0]["defaultConfiguration"] == {"level": "warning"}
    assert all(rule["help"]["text"] for rule in rules)
    error = run["results"][1]
    assert (error["ruleIndex"], error["level"]) == (1, "error")
    (location,) = error["locations"]
    assert location["physicalLocation"] == {
        "artifactLocation": {"uri": "a%20deck.adm"},
        "region": {"startLine": 6, "startColumn": 45, "endLine": 6, "endColumn": 51},
    }
    (related,) = error["relatedLocations"]
    assert related["physicalLocation"]["region"]["startLine"] == 7


@pytest.mark.parametrize(("form", "empty"), [("gcc", ""), ("json", "[]\n")])
def test_nothing_to_say(check, form: str, empty: str) -> None:
    assert check(form, SILENT) == (0, empty)


def test_sarif_with_nothing_to_say_has_a_run(check) -> None:
    code, out = check("sarif", SILENT)
    (run,) = json.loads(out)["runs"]
    assert code == 0 and run["results"] == run["tool"]["driver"]["rules"] == []


def test_text_is_the_default(check, capsys) -> None:
    code, out = check("text", HEALTHY)
    assert main(["check", "a deck.adm"]) == code == 0
    assert capsys.readouterr().out == out
    assert "a deck.adm: 1 warning" in out


@pytest.mark.parametrize("code", MESSAGES)
def test_every_message_has_places_within_its_deck(code: str) -> None:
    for broken in MESSAGES[code].broken:
        text = whole(code, broken)
        lines = text.split("\n")
        found = told(text)
        data = json.loads(as_json(found))
        assert as_gcc(found).count("\n") == sum(len(each["places"]) for each in data)
        assert len(json.loads(as_sarif(found))["runs"][0]["results"]) == len(data)
        for place in (place for each in data for place in each["places"]):
            assert 1 <= place["line"] <= place["end_line"] <= len(lines)
            assert 1 <= place["column"] <= len(lines[place["line"] - 1]) + 1
            assert 1 <= place["end_column"] <= len(lines[place["end_line"] - 1]) + 1

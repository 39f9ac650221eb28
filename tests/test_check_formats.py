"""`check --format`: the same messages as lines of a compiler, as JSON and as SARIF."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from decklets import told
from test_messages import whole

from adamslite.cli.main import main
from adamslite.language.diagnostics import Fix, Source
from adamslite.language.messages import MESSAGES, START
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
        "source_column": 1,
        "places": [{"file": "a deck.adm"} | span],
        "related": [],
        "fixes": [],
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


@pytest.mark.parametrize(
    ("added", "code"),
    [
        ("MARKER/4, PART=2, QP=1,0,0\nMARKER/5, PART=2, QP=2,0,0\n", "unused"),
        ("MARKER/4, PART=2, FLOATING\nMARKER/5, PART=2, FLOATING\n", "floating-unused"),
    ],
)
def test_a_message_about_several_statements_has_all_of_them(added: str, code: str) -> None:
    text = START + added
    (found,) = [each for each in told(text) if each.code == code]
    first = START.count("\n") + 1
    assert [place.line for place in found.everywhere] == [first, first + 1]


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


def applied(text: str, fix: Fix) -> str:
    """The text once a correction has been accepted; its edits do not overlap."""
    source = Source(text)
    for span, new in sorted(fix.edits, key=lambda edit: edit.span.line, reverse=True):
        start, end = (
            source.starts[line - 1] + column - 1
            for line, column in ((span.line, span.column), (span.end_line, span.end_column))
        )
        text = text[:start] + new + text[end:]
    return text


SUGGESTED = [
    ("SFORSE/1, I=1, J=2, FUNCTION=1", "SFORCE/1, I=1, J=2, FUNCTION=1"),
    ("SFORCE/1, I=1, J=2, FUNCION=1", "SFORCE/1, I=1, J=2, FUNCTION=1"),
    ("VARIABLE/1, FUNCTION=SQR(2)", "VARIABLE/1, FUNCTION=SQRT(2)"),
    ("VARIABLE/1, FUNCTION=2TIME", "VARIABLE/1, FUNCTION=2*TIME"),
    ("VARIABLE/1, FUNCTION=2^3", "VARIABLE/1, FUNCTION=2**3"),
    ("PART/4, MASS=1, CM=2,", "PART/4, MASS=1, CM=2"),
    ("REQUEST/1, F2=TIME\n, F3=TIME", "REQUEST/1, F2=TIME\\\n, F3=TIME"),
    ("UNITS/SYSTEM=MKSA", "UNITS/SYSTEM=MKS"),
    ("MARKER/wheel, PART=1\nVARIABLE/1, FUNCTION=DX(weel)",
     "MARKER/wheel, PART=1\nVARIABLE/1, FUNCTION=DX(WHEEL)"),
]  # fmt: skip


@pytest.mark.parametrize(("broken", "correct"), SUGGESTED)
def test_a_hint_is_a_correction(broken: str, correct: str) -> None:
    text = START + broken + "\n"
    (fix,) = next(each.fixes for each in told(text) if each.fixes)
    assert applied(text, fix) == START + correct + "\n"


def test_corrections_do_away_with_their_messages() -> None:
    """Those of the broken decks in the table of messages."""
    corrected = 0
    for code, entry in MESSAGES.items():
        for broken in entry.broken:
            text = whole(code, broken)
            before = [each for each in told(text) if each.code == code]
            for each in before:
                for fix in each.fixes:
                    left = [other for other in told(applied(text, fix)) if other.code == code]
                    assert each.span not in [other.span for other in left], (code, text)
                    assert len(left) < len(before), (code, text)
                    corrected += 1
    assert corrected > 30


LEFT_OUT = [
    ("PART/9, GROUND,\n, VX=1\n, VY=2", "PART/9, GROUND\n, VY=2"),
    ("PART/9, GROUND, VX=1, MATERIAL=a", "PART/9, GROUND, MATERIAL=a"),
    ("PART/9, GROUND ! b\n, VX=1, MATERIAL=a", "PART/9, GROUND ! b\n, MATERIAL=a"),
    ("PART/9, GROUND, ! b\n, VX=1, MATERIAL=a", None),
    ("PART/9, VX=1, GROUND", "PART/9, GROUND"),
]


@pytest.mark.parametrize(("written", "left"), LEFT_OUT)
def test_what_has_no_effect_may_be_left_out(written: str, left: str | None) -> None:
    """Without breaking the lines round it."""
    text = f"title\n{written}\n"
    found = next(each for each in told(text) if each.code == "ground-with-data")
    assert [applied(text, fix) for fix in found.fixes] == [f"title\n{left}\n"] * bool(left)


RELATED = {
    "the first definition": ("MARKER/2, PART=1", "duplicate-id", ["MARKER/2"]),
    "the first argument": ("MARKER/4, PART=1, PART=1", "duplicate-argument", ["PART=1"]),
    "the other ground": ("PART/7, GROUND", "two-grounds", ["PART/1, GROUND"]),
    "both markers": (
        "MARKER/4, PART=1, QP=9,9,9\nJOINT/1, SPHERICAL, I=2, J=4",
        "starts-apart",
        ["MARKER/2", "MARKER/4"],
    ),
    "who drives it already": (
        "JOINT/1, REVOLUTE, I=2, J=1\nMOTION/1, JOINT=1, FUNCTION=1\n"
        "MOTION/2, JOINT=1, FUNCTION=TIME",
        "motion-twice",
        ["MOTION/1"],
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", RELATED)
def test_related_places(what: str) -> None:
    broken, code, expected = RELATED[what]
    text = START + broken + "\n"
    lines = text.split("\n")
    found = next(each for each in told(text) if each.code == code)
    places = [span for span, _ in found.related]
    assert [lines[p.line - 1][p.column - 1 : p.end_column - 1] for p in places] == expected


INSIDE = [
    ("JOINT/1, REVOLUTE, I=2, J=1\nMOTION/1, JOINT=1, FUNCTION=TIME+2*DX( 2, 1 )**2", "DX( 2, 1 )"),
    ("MARKER/9, PART=2, FLOATING\nVARIABLE/1, FUNCTION=DX(2,1)+(DM(9, 1)-1)", "DM(9, 1)"),
    ("SPLINE/1, X=1,2,3,4, Y=1,2,3,4\nVARIABLE/1, FUNCTION=1+AKISPL(TIME,1,1)", "AKISPL(TIME,1,1)"),
    ("VARIABLE/v, FUNCTION=DX(2)\nJOINT/1, REVOLUTE, I=2, J=1\n"
     "MOTION/1, JOINT=1, FUNCTION=1+SIN(v)", "SIN(v)"),
]  # fmt: skip


@pytest.mark.parametrize(("broken", "place"), INSIDE)
def test_a_place_is_inside_the_expression(broken: str, place: str) -> None:
    text = START + broken + "\n"
    spans = [each.span for each in told(text) if each.is_error]
    lines = text.split("\n")
    assert place in [lines[s.line - 1][s.column - 1 : s.end_column - 1] for s in spans]


REQUIRED = {
    "log": {"version", "runs"},
    "run": {"tool"},
    "result": {"message", "ruleId", "level"},
    "fix": {"artifactChanges"},
    "change": {"artifactLocation", "replacements"},
    "replacement": {"deletedRegion"},
    "rule": {"id"},
}
"""Properties that SARIF 2.1.0 requires of its objects, and what viewers need besides."""


def assert_valid_sarif(log: dict[str, Any]) -> None:
    """The required properties and the ranges of section 3 of the standard."""
    assert REQUIRED["log"] <= log.keys() and log["version"] == "2.1.0"
    for run in log["runs"]:
        assert REQUIRED["run"] <= run.keys() and run["tool"]["driver"]["name"]
        rules = run["tool"]["driver"]["rules"]
        assert all(REQUIRED["rule"] <= rule.keys() for rule in rules)
        assert len({rule["id"] for rule in rules}) == len(rules)
        for result in run["results"]:
            assert REQUIRED["result"] <= result.keys() and result["message"]["text"]
            assert result["level"] in ("none", "note", "warning", "error")
            assert rules[result["ruleIndex"]]["id"] == result["ruleId"]
            for place in [*result.get("locations", ()), *result.get("relatedLocations", ())]:
                assert_valid_region(place["physicalLocation"]["region"])
                assert place["physicalLocation"]["artifactLocation"]["uri"]
            for fix in result.get("fixes", ()):
                assert REQUIRED["fix"] <= fix.keys() and fix["artifactChanges"]
                for change in fix["artifactChanges"]:
                    assert REQUIRED["change"] <= change.keys() and change["replacements"]
                    for replacement in change["replacements"]:
                        assert REQUIRED["replacement"] <= replacement.keys()
                        assert_valid_region(replacement["deletedRegion"])


def assert_valid_region(region: dict[str, int]) -> None:
    start = region["startLine"], region["startColumn"]
    assert (1, 1) <= start <= (region["endLine"], region["endColumn"])
    assert region["startColumn"] >= 1 and region["endColumn"] >= 1


@pytest.mark.parametrize("code", MESSAGES)
def test_sarif_has_what_the_standard_requires(code: str) -> None:
    for broken in MESSAGES[code].broken:
        found = told(whole(code, broken))
        log = json.loads(as_sarif(found))
        assert_valid_sarif(log)
        results = log["runs"][0]["results"]
        assert [len(each.get("fixes", ())) for each in results] == [len(d.fixes) for d in found]

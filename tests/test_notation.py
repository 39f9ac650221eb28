"""Messages speak of `--end` on the command line and of `end=` in Python."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import RunFailed, UsageError
from adamslite.notation import COMMAND_LINE, PYTHON, current, in_python, notation, shown
from adamslite.outputs.whole_files import need_writable

PACKAGE = Path(al.__file__).parent
FLAG = re.compile(r"(?<![\w-])--[a-z]|`adamslite [a-z]|-o [A-Z]|give -o")

FALL = """A mass that falls
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2
MARKER/2, POINT_MASS=2
"""


@pytest.mark.parametrize(
    ("written", "python"),
    [
        ("use the flags --end T --steps N.", "use the arguments end=T, steps=N."),
        ("--integrator EULER: there are", "integrator='EULER': there are"),
        ("--error -1: it must", "error=-1: it must"),
        ("--error nan: it must", "error=nan: it must"),
        ("--rm 9: there is no MARKER/9", "rm=9: there is no MARKER/9"),
        ("--no-reduction, or", "no_reduction=, or"),
        ("(a shorter --end shows)", "(a shorter end= shows)"),
        ("give `solve` --end and --steps", "give `simulate` end= and steps="),
        ("--user VARIABLE/1=0 binds", "user={'VARIABLE/1': 0} binds"),
        ("--user VARIABLE/1: it is bound twice", "user={'VARIABLE/1': ...}: it is bound twice"),
        ("--user VARSUB=a.b:c: there is no c", "user={'VARSUB': 'a.b:c'}: there is no c"),
        ("--user VARSUB=module:function or", "user={'VARSUB': function} or"),
        ("that --user binds", "that user= binds"),
        ("(`adamslite check` prints it)", "(`adamslite.check` prints it)"),
        ("`adamslite help STEP` says", "`adamslite.help('STEP')` says"),
        ("`adamslite linear` gives", "`adamslite.linearize` gives"),
        ("a - b, 1--end and x--y --- or -- so", "a - b, 1--end and x--y --- or -- so"),
    ],
)
def test_options_become_arguments(written: str, python: str) -> None:
    assert in_python(written) == python == in_python(python)


def test_the_command_line_is_one_of_two_notations() -> None:
    assert current() == PYTHON
    with notation(COMMAND_LINE):
        assert shown("--end T") == "--end T"
        assert str(UsageError("--end T")) == "--end T"
    assert current() == PYTHON
    assert str(UsageError("--end T")) == "end=T"


def texts() -> list[tuple[str, str]]:
    """Texts of the package, with X for what is filled in, but for those of the command line."""
    found = []
    for file in sorted(PACKAGE.rglob("*.py")):
        parts = file.relative_to(PACKAGE).parts
        if parts[0] in ("cli", "manual", "decks") or parts[-1] in ("run_flags.py", "notation.py"):
            continue
        tree = ast.parse(file.read_text(encoding="utf-8"))
        documented = {
            id(node.body[0].value)
            for node in ast.walk(tree)
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef)
            and node.body
            and isinstance(node.body[0], ast.Expr)
        }
        for node in ast.walk(tree):
            if isinstance(node, ast.JoinedStr):
                pieces = [getattr(each, "value", "X") for each in node.values]
                text = "".join(each if isinstance(each, str) else "X" for each in pieces)
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                text = "" if id(node) in documented else node.value
            else:
                continue
            if FLAG.search(text):
                found.append((f"{'/'.join(parts)}:{node.lineno}", text))
    return found


@pytest.mark.slow
def test_no_text_of_the_package_shows_flags_to_python() -> None:
    """Help texts of arguments are pages of the manual, which name commands."""
    found = [(place, text) for place, text in texts() if not place.startswith("elements/")]
    assert len(found) > 10
    for place, text in found:
        assert not FLAG.search(in_python(text)), f"{place}: {in_python(text)}"


@pytest.mark.slow
def test_no_fault_of_a_file_speaks_of_flags() -> None:
    """What a file holds is quoted as it is; so only these messages are shown untranslated."""
    for file in sorted(PACKAGE.rglob("*.py")):
        if "cli" in file.relative_to(PACKAGE).parts:
            continue
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            raised = getattr(getattr(node, "exc", None), "func", None)
            if getattr(raised, "id", "") in ("FormatError", "Mismatch"):
                assert not FLAG.search(ast.unparse(node)), f"{file}:{node.lineno}"


def test_every_outcome_speaks_both() -> None:
    for outcome in al.Outcome:
        assert not FLAG.search(outcome.sentence)
        with notation(COMMAND_LINE):
            assert outcome.sentence == outcome.value
            assert "end=T" not in outcome.sentence


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    path = tmp_path / "fall.adm"
    path.write_text(FALL + "END\n")
    return path


def both(capsys, command: list[str], call) -> tuple[str, str]:
    """What the command line prints, and what Python raises."""
    assert main(command) != 0
    with pytest.raises((UsageError, RunFailed, al.DeckError)) as caught:
        call()
    return capsys.readouterr().err, str(caught.value)


def test_a_run_without_an_end(deck: Path, capsys) -> None:
    shell, python = both(capsys, ["solve", str(deck)], lambda: al.simulate(deck))
    assert "in a command file (second argument, or" in shell
    assert "or use the flags --end T --steps N" in shell
    assert "in a command file (commands=, or a .acf" in python
    assert "or use the arguments end=T, steps=N" in python


def test_a_method_that_there_is_not(deck: Path, capsys) -> None:
    command = ["solve", str(deck), "--end", "1", "--integrator", "GSTIF"]
    shell, python = both(capsys, command, lambda: al.simulate(deck, end=1, integrator="gstif"))
    assert "--integrator GSTIF: there are" in shell and "did you mean GSTIFF?" in shell
    assert python.startswith("integrator='gstif': there are")
    assert python.endswith("did you mean GSTIFF?")


def test_an_observer_that_there_is_not(deck: Path, capsys) -> None:
    command = ["linear", str(deck), "--rm", "9"]
    shell, python = both(capsys, command, lambda: al.linearize(deck, rm=9))
    assert "--rm 9: there is no MARKER/9" in shell
    assert python == "rm=9: there is no MARKER/9"


def test_a_routine_that_is_missing(deck: Path, capsys) -> None:
    deck.write_text(FALL + "VARIABLE/1, FUNCTION=USER(1)\nEND\n")
    shell, python = both(capsys, ["solve", str(deck)], lambda: al.simulate(deck))
    assert "bind it, --user VARSUB=module:function or --user VARIABLE/1=number" in shell
    assert "bind it, user={'VARSUB': function} or user={'VARIABLE/1': number}" in python
    assert "--" not in python


def test_a_binding_without_a_use(deck: Path, capsys) -> None:
    shell, python = both(
        capsys,
        ["solve", str(deck), "--user", "VARIABLE/7=1"],
        lambda: al.simulate(deck, user={"VARIABLE/7": 1}),
    )
    assert "--user VARIABLE/7" in shell
    assert "user={'VARIABLE/7': ...}" in python


def test_a_function_that_fails_during_the_run(deck: Path, capsys, monkeypatch) -> None:
    monkeypatch.chdir(deck.parent)
    deck.write_text(FALL + "VARIABLE/1, FUNCTION=USER(1)\nREQUEST/1, F1=VARVAL(1)\nEND\n")
    Path("broken_routine.py").write_text(
        "def fails(parameters, time):\n    return 1 / (time - time)\n"
    )
    command = ["solve", "fall.adm", "--end", "1", "--user", "VARSUB=broken_routine:fails"]
    assert main(command) == 4
    assert "that --user binds to a routine of the deck" in capsys.readouterr().err
    with pytest.warns(al.DeckWarning, match="by user=: VARIABLE/1 = "):
        results = al.simulate("fall.adm", end=1.0, user={"VARSUB": lambda parameters, time: 1 / 0})
    assert "that user= binds to a routine of the deck" in results.message
    assert "that user= binds" in results.outcome.sentence


def test_a_remedy_that_names_a_command(capsys, monkeypatch, tmp_path: Path) -> None:
    """The effective mass vanishes: `check` would have shown it."""
    monkeypatch.chdir(tmp_path)
    text = FALL + "VFORCE/1, I=2, J_PART=1, FX=2*ACCX(2)+1\\FY=0\\FZ=0\n"
    Path("massless.adm").write_text(f"{text}SIMULATE/DYNAMIC, END=1, STEPS=4\nEND\n")
    assert main(["solve", "massless.adm"]) == 4
    assert "(`adamslite check` prints the effective mass)" in capsys.readouterr().err
    with pytest.warns(al.DeckWarning, match="effective mass"):
        results = al.simulate("massless.adm")
    assert "(`adamslite.check` prints the effective mass)" in results.message


def test_a_file_that_may_not_be_written(deck: Path) -> None:
    with pytest.raises(UsageError, match="choose another name"):
        need_writable(deck, [deck], True)
    with notation(COMMAND_LINE), pytest.raises(UsageError) as caught:
        need_writable(deck, [deck], True)
    with notation(COMMAND_LINE):
        assert "give -o another name" in str(caught.value)

"""The command line: what it prints, where, and with which exit code."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from pkgutil import iter_modules

import numpy as np
import pytest
from fakes import ERROR, SIMULATE, fall, install, stopped

import adamslite
from adamslite.analyses.session.session import Session
from adamslite.cli import commands
from adamslite.cli.main import ALL_THREADS, COMMANDS, THREADS, command_parsers, main
from adamslite.elements.joint import Joint
from adamslite.elements.part import Part
from adamslite.errors import UsageError
from adamslite.language.diagnostics import Diagnostic, Span
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

WARNING = Diagnostic(
    "W1", "warning", "the effective mass is m0 - Dm", Span("cable.adm", 3, 1, 3, 7), "use minus"
)
FALLING = """\
a falling mass
PART/1, GROUND
POINT_MASS/2, MASS=1
ACCGRAV/JGRAV=-9.81
END
"""


def test_results_go_to_the_decks_name_in_the_current_directory(pipeline, capsys) -> None:
    Path("decks").mkdir()
    Path("cable.adm").rename("decks/cable.adm")
    assert main(["solve", "decks/cable.adm"]) == 0
    out, err = capsys.readouterr()
    assert out == "" and "cable.csv" in err and "degrees of freedom   6" in err
    assert np.array_equal(Results.load("cable.csv").values, fall().values)
    assert sorted(os.listdir()) == ["cable.csv", "decks"]


def test_the_same_run_gives_the_same_bytes(pipeline) -> None:
    main(["solve", "cable.adm", "-o", "a.csv"])
    main(["solve", "cable.adm", "-o", "b.csv"])
    assert Path("a.csv").read_bytes() == Path("b.csv").read_bytes()


def test_flags_reach_simulate(pipeline) -> None:
    flags = "--end 2 --steps 50 --integrator gstiff --formulation i3 --error 1e-7 --hmax 0.1"
    assert main(["solve", "cable.adm", *flags.split()]) == 0
    (call,) = pipeline.calls
    call.pop("progress")
    assert call == {
        "commands": (),
        "end": 2.0,
        "steps": 50,
        "integrator": "GSTIFF",
        "formulation": "I3",
        "error": 1e-7,
        "hmax": 0.1,
        "strict": None,
    }


@pytest.mark.parametrize(
    "flags",
    [
        ["--end", "-1"],
        ["--end", "soon"],
        ["--steps", "0"],
        ["--error", "inf"],
        ["--formulation", "I4"],
        ["--bogus"],
        ["-o", "-", "--summary", "json"],
    ],
)
def test_wrong_flags_are_usage(pipeline, capsys, flags: list[str]) -> None:
    assert main(["solve", "cable.adm", *flags]) == 2
    assert "Traceback" not in capsys.readouterr().err
    assert pipeline.calls == []


@pytest.mark.parametrize(
    "argv",
    [
        ["solve", "cable.adm", "-o", "cable.adm"],
        ["solve", "cable.adm", "-o", "./cable.acf"],
        ["solve", "cable.adm", "other.acf", "-o", "other.acf"],
        ["linear", "deck.csv", "-o", "deck.csv"],
        ["cable", "cable.toml", "-o", "cable.toml"],
    ],
)
def test_nothing_that_is_read_is_written_over(pipeline, capsys, argv: list[str]) -> None:
    names = ("cable.adm", "cable.acf", "other.acf", "deck.csv", "cable.toml")
    for name in names:
        Path(name).write_text("mine\n")
    assert main(argv) == 2
    assert "would be written over; give -o another name" in capsys.readouterr().err
    assert all(Path(name).read_text() == "mine\n" for name in names)


def test_more_output_than_there_is_memory_for_is_no_fault(tmp_path, monkeypatch, capsys) -> None:
    """1e15 steps are too many for any table, 1e8 of 9 numbers each for this one."""
    monkeypatch.chdir(tmp_path)
    Path("cable.adm").write_text(FALLING)
    assert main(["solve", "cable.adm", "--end", "1", "--steps", "1000000000000000"]) == 2
    assert "output steps: fewer STEPS, a longer DTOUT" in capsys.readouterr().err

    def no_room(shape: int) -> None:
        raise MemoryError

    system = Session(adamslite.read(Path("cable.adm")), None, {}).system
    with monkeypatch.context() as without_memory:
        without_memory.setattr(np, "zeros", no_room)
        with pytest.raises(UsageError, match="would take .* GB of memory"):
            system.start_record(np.linspace(0.0, 1.0, 10))


def test_a_reference_that_is_no_text_cannot_be_read(pipeline, capsys) -> None:
    fall().save("a.csv")
    Path("b.csv").write_bytes(b"\xff\xfe\x00")
    assert main(["diff", "a.csv", "b.csv"]) == 5
    assert "b.csv is not a table in UTF-8" in capsys.readouterr().err


def test_without_an_end_time_the_three_ways_are_told(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("cable.adm").write_text(FALLING)
    assert main(["solve", "cable.adm"]) == 2
    err = capsys.readouterr().err
    assert all(way in err for way in ("command file", "in the deck itself", "--end"))
    assert not Path("cable.csv").exists()
    assert main(["solve", "cable.adm", "--end", "1"]) == 0


def test_the_command_file_given_wins_over_the_one_beside_the_deck(pipeline) -> None:
    pipeline.statements = ()
    Path("cable.acf").write_text("SIMULATE/DYNAMIC, END=1, STEPS=10\n")
    assert main(["solve", "cable.adm"]) == 0
    assert main(["solve", "cable.adm", "other.acf"]) == 0
    assert [path.name for path in pipeline.commands_read] == ["cable.acf", "other.acf"]
    assert [call["commands"] for call in pipeline.calls] == [(SIMULATE,), (SIMULATE,)]


def test_an_early_end_writes_what_there_is(pipeline, capsys) -> None:
    pipeline.results = stopped(Outcome.SINGULAR_ACCELERATION, message="VFORCE/2, line 9: no mass")
    assert main(["solve", "cable.adm", "--quiet"]) == 4
    assert "VFORCE/2, line 9: no mass" in capsys.readouterr().err
    assert Results.load("cable.csv").time.size == 11


def test_the_summary_as_json(pipeline, capsys) -> None:
    pipeline.results = fall(summary={**fall().summary, "max_violation": float("nan")})
    assert main(["solve", "cable.adm", "--summary", "json", "--quiet"]) == 0
    out, err = capsys.readouterr()
    summary = json.loads(out)
    assert err == ""
    assert list(summary) == [*fall().summary, "deck", "commands", "output", "notes"]
    assert summary["output"] == "cable.csv" and summary["max_violation"] is None


def test_errors_of_the_results_are_told_in_every_summary(pipeline, capsys) -> None:
    """As JSON among its notes; quietly on standard error where the motion is lost."""
    found = fall()
    off = "from t = 3.2 on the result is not determined at this ERROR"
    pipeline.results = replace(found, meta={**found.meta, "accuracy": off})
    assert main(["solve", "cable.adm", "--summary", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["notes"]["accuracy"] == off
    assert main(["solve", "cable.adm", "--quiet"]) == 0
    assert off in capsys.readouterr().err
    pipeline.results = replace(
        found, meta={**found.meta, "accuracy": "estimated global error 1e-3"}
    )
    assert main(["solve", "cable.adm", "--quiet"]) == 0
    assert capsys.readouterr().err == ""


def test_the_table_on_standard_output(pipeline, capsys) -> None:
    assert main(["solve", "cable.adm", "-o", "-"]) == 0
    out, err = capsys.readouterr()
    assert "time,PART/2.x" in out and "steps" in err
    assert not Path("-").exists() and not Path("cable.csv").exists()


def test_warnings_are_told_on_standard_error(pipeline, capsys) -> None:
    pipeline.diagnostics = (WARNING,)
    assert main(["solve", "cable.adm"]) == 0
    out, err = capsys.readouterr()
    assert "cable.adm:3:1: warning: the effective mass" in err and out == ""
    assert main(["solve", "cable.adm", "--quiet"]) == 0
    assert capsys.readouterr().err == ""


def test_errors_of_the_deck(pipeline, capsys) -> None:
    pipeline.diagnostics = (WARNING, ERROR)
    assert main(["solve", "cable.adm"]) == 3
    assert "cable.adm:2:4: error: there is no MARKER/7" in capsys.readouterr().err
    assert pipeline.calls == []
    assert main(["check", "cable.adm"]) == 3
    assert capsys.readouterr().out.endswith("\n\n1 error, 1 warning\n")


def test_check_tells_warnings_and_contents(pipeline, capsys) -> None:
    pipeline.diagnostics = (WARNING,)
    assert main(["check", "cable.adm"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("cable.adm:3:1: warning:")
    assert "cable.adm: 1 warning\n  3 statements: 2 PART, 1 SIMULATE\n" in out
    joint = Joint(id=1, kind="REVOLUTE", i=1, j=2)

    pipeline.statements = (Part(id=1, ground=True), Part(id=2), joint, SIMULATE)
    assert main(["check", "cable.adm"]) == 0
    out = capsys.readouterr().out
    assert "  1 degree of freedom: 1 moving part, 0 point masses, 5 constraint rows\n" in out


@pytest.mark.parametrize(
    ("argv", "said"),
    [
        (["diff", "no.csv", "cable.adm"], "'no.csv': No such file"),
        (
            ["diff", "-", "cable.adm"],
            "'-': No such file or directory; here that is no standard input",
        ),
        (["diff", "cable.adm", "cable.adm"], "results cannot be read from cable.adm"),
        (["solve", "cable.adm", "-o", "no/out.csv"], "no such folder"),
        (["solve", "cable.adm", "-o", "."], "it is a folder"),
        (["verify", "nowhere"], "'nowhere': no such deck or folder"),
    ],
)
def test_what_cannot_be_read_or_written(pipeline, capsys, argv: list[str], said: str) -> None:
    assert main(argv) == 5
    assert said in capsys.readouterr().err
    assert pipeline.calls == []


def test_a_fault_of_the_program_is_one_sentence(pipeline, capsys, monkeypatch) -> None:
    def broken(deck, **options):
        raise ZeroDivisionError("the\nslip")

    monkeypatch.setattr(pipeline, "simulate", broken)
    install(monkeypatch, pipeline)
    assert main(["solve", "cable.adm"]) == 70
    err = capsys.readouterr().err
    assert "ZeroDivisionError: the slip" in err and "report it" in err and "Traceback" not in err
    with pytest.raises(ZeroDivisionError):
        main(["solve", "cable.adm", "--debug"])


def test_an_interruption_before_there_are_results(pipeline, capsys, monkeypatch) -> None:
    def interrupted(deck, **options):
        raise KeyboardInterrupt

    monkeypatch.setattr(pipeline, "simulate", interrupted)
    install(monkeypatch, pipeline)
    assert main(["solve", "cable.adm"]) == 4
    assert capsys.readouterr().err == "adamslite: interrupted\n"


def test_help_needs_nothing_heavy() -> None:
    program = (
        "import sys\n"
        "from adamslite.cli.main import main\n"
        "main(['--help'])\n"
        "heavy = {'numpy', 'scipy', 'sympy', 'llvmlite', 'lark'} & set(sys.modules)\n"
        "assert not heavy, heavy\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True, stdout=subprocess.DEVNULL)


def test_the_list_of_commands_has_the_first_lines_of_their_modules() -> None:
    for name, parser in command_parsers().items():
        assert (parser.description or "").partition("\n")[0] == COMMANDS[name]
    there = {module.name for module in iter_modules(commands.__path__)}
    assert there - {"codes", "results_given", "run_journal", "unfinished"} == {*COMMANDS}


def test_a_command_imports_no_other_command() -> None:
    program = (
        "import sys\n"
        "from adamslite.cli.main import main\n"
        "main(['diff', '--help'])\n"
        "names = {n.rpartition('.')[2] for n in sys.modules if n.startswith('adamslite.cli.c')}\n"
        "assert names == {'commands', 'codes', 'diff'}, names\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True, stdout=subprocess.DEVNULL)


@pytest.mark.parametrize(
    ("given", "seen"),
    [
        ({}, "None 1"),
        ({"OMP_NUM_THREADS": "3"}, "3 None"),
        ({"OPENBLAS_NUM_THREADS": "2"}, "None 2"),
    ],
)
def test_the_command_line_takes_one_thread_unless_told(given: dict[str, str], seen: str) -> None:
    """Set for the process of the command; a caller of `main` with arguments keeps his own.  What he
    has printed comes before what the command prints, whether or not Python gathers output.
    """
    program = (
        "import os, sys\n"
        "from adamslite.cli.main import main\n"
        "shown = lambda: print(*map(os.environ.get, ('OMP_NUM_THREADS', 'OPENBLAS_NUM_THREADS')))\n"
        "sys.argv = ['adamslite', '--version']\n"
        "main(sys.argv[1:])\n"
        "shown()\n"
        "main()\n"
        "shown()\n"
    )
    left_out = (*THREADS, ALL_THREADS, "PYTHONUNBUFFERED")
    clean = {name: text for name, text in os.environ.items() if name not in left_out}
    run = subprocess.run(
        [sys.executable, "-c", program], env=clean | given, capture_output=True, text=True
    )
    before = " ".join(str(given.get(n)) for n in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"))
    assert run.stdout.splitlines()[1::2] == [before, seen]


@pytest.mark.parametrize(
    ("given", "shown"), [({}, "ΔL"), ({"PYTHONIOENCODING": "cp1252"}, r"\u0394L")]
)
def test_letters_that_the_system_has_no_code_for(
    tmp_path: Path, given: dict[str, str], shown: str
) -> None:
    """Standard output to a file is UTF-8, also where the system writes in another code, unless the
    user has chosen that one; no letter is a fault of the program.
    """
    deck = tmp_path / "a.adm"
    deck.write_text("a cable\nPART/1, GROUND\nVARIABLE/ΔL, FUNCTION=TIME(\nEND\n", encoding="utf-8")
    program = (
        "import sys\n"
        "from io import TextIOWrapper\n"
        "from adamslite.cli.main import main\n"
        "sys.stdout, sys.stderr = (TextIOWrapper(s.detach(), encoding='cp1252')\n"
        "                          for s in (sys.stdout, sys.stderr))\n"
        f"sys.argv = ['adamslite', 'check', {str(deck)!r}]\n"
        "sys.exit(main())\n"
    )
    clean = {name: text for name, text in os.environ.items() if name != "PYTHONIOENCODING"}
    run = subprocess.run([sys.executable, "-c", program], env=clean | given, capture_output=True)
    assert run.returncode == 3
    assert f"VARIABLE/{shown}" in (run.stdout + run.stderr).decode("utf-8")


def test_a_reader_that_goes_away_is_no_fault(tmp_path: Path) -> None:
    fall(2000).save(tmp_path / "a.csv")
    file = tmp_path / "a.csv"
    command = f"{sys.executable} -m adamslite diff {file} {file} | true"
    run = subprocess.run(["bash", "-c", command], capture_output=True, text=True)
    assert run.stderr == ""


def test_ctrl_c_writes_what_is_computed(tmp_path: Path) -> None:
    deck, output = tmp_path / "fall.adm", tmp_path / "fall.csv"
    deck.write_text(FALLING)
    flags = "--end 1000 --steps 1000 --hmax 1e-6"  # a thousand million steps: never done by itself
    # Interrupts itself at the first report of progress; a shell may have told it to ignore SIGINT.
    program = (
        "import signal, sys\n"
        "from adamslite import progress\n"
        "from adamslite.cli import main as cli\n"
        "def interrupt(self, state):\n"
        "    signal.raise_signal(signal.SIGINT)\n"
        "progress.TalkingProgress.watch = interrupt\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "sys.exit(cli.main(sys.argv[1:]))\n"
    )
    command = [sys.executable, "-c", program, "solve", str(deck), "-o", str(output)]
    run = subprocess.run([*command, *flags.split()], capture_output=True, text=True)
    assert run.returncode == 4, run.stderr
    assert "# outcome: INTERRUPTED" in output.read_text() and "Traceback" not in run.stderr


def test_an_interrupt_while_commands_are_loaded_is_told(monkeypatch, capsys) -> None:
    def interrupted(words: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("adamslite.cli.main._with_commands", interrupted)
    assert main(["solve", "deck.adm"]) == 4
    assert capsys.readouterr().err == "adamslite: interrupted\n"

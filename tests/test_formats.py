"""Formats of result files: what each must keep, and a new one in one file."""

from __future__ import annotations

import json
from collections.abc import Iterator
from copy import deepcopy
from pathlib import Path

import numpy as np
import pytest
from fakes import fall

from adamslite.cli.main import main
from adamslite.errors import FormatError, UsageError
from adamslite.manual.lookup import result_formats
from adamslite.outputs.whole_files import whole_file
from adamslite.results import formats
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results


def results(time, names, values) -> Results:
    values = np.asarray(values, dtype=float)
    return Results(time=np.asarray(time, dtype=float), names=names, values=values)


ODD = np.array([[0.1 + 0.2, -0.0], [5e-324, 1.7976931348623157e308], [-1e-17, 3.0]])
SAMPLES = {
    "a run": fall(meta={"deck": "cable.adm", "units": "newton meter"}),
    "an early end": fall(outcome=Outcome.STEP_TOO_SMALL, message="at SFORCE/5"),
    "odd names": results(np.zeros(1), ('VARIABLE/a,"b"', "REQUEST/\u00e4 1.x"), np.ones((1, 2))),
    "odd numbers": results(np.array([0.0, 1e-300, 1.0]), ("a", "b"), ODD),
    "no times": results(np.empty(0), ("a",), np.empty((0, 1))),
    "no columns": results(np.arange(3), (), np.empty((3, 0))),
    "one time": fall(steps=0),
    "no numbers": results(np.arange(2), ("PART/2.x", "b"), [[np.nan, np.inf], [-np.inf, np.nan]]),
    "a few columns of bodies": results(
        np.arange(2), ("PART/7.y", "REQUEST/1.F2", "POINT_MASS/a.vx", "REQUEST 1 F2"), np.eye(2, 4)
    ),
}


def write_read(format: formats.Format, written: Results, path: Path) -> None:
    """A format keeps times, names and numbers to the bit, and does not change what it writes."""
    before = deepcopy(vars(written))
    written.save(path)
    after = vars(written)
    assert all(after[name].tobytes() == before[name].tobytes() for name in ("time", "values"))
    assert all(after[name] == before[name] for name in before if name not in ("time", "values"))
    assert path.stat().st_size > 0
    if format.read:
        again = Results.load(path)
        assert again.names == written.names
        assert again.time.tobytes() == written.time.tobytes()
        assert again.values.tobytes() == written.values.tobytes()
        assert again.values.shape == written.values.shape


EXACT = sorted(suffix for suffix, each in formats.formats().items() if each.exact)


@pytest.mark.parametrize("sample", SAMPLES)
@pytest.mark.parametrize("suffix", EXACT)
def test_every_exact_format_keeps_what_it_writes(suffix: str, sample: str, tmp_path: Path) -> None:
    write_read(formats.formats()[suffix], SAMPLES[sample], tmp_path / f"a{suffix}")


@pytest.mark.parametrize("suffix", EXACT)
def test_files_of_a_run_have_the_same_bytes_each_time(
    suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its CPU seconds are in none of them, and neither is the time of day."""
    files = []
    for cpu in (0.1, 0.2):
        monkeypatch.setattr("time.asctime", lambda *_, day=cpu: f"day {day}")
        path = tmp_path / f"run{suffix}"
        fall(summary={"steps": 7, "setup_cpu_s": cpu, "solve_cpu_s": 2 * cpu}).save(path)
        files.append(path.read_bytes())
    assert files[0] == files[1]


@pytest.mark.parametrize("suffix", sorted(formats.formats()))
def test_a_failed_write_leaves_the_file_as_it_was(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"a{suffix}"
    path.write_text("good")
    torn = results(np.zeros(2), ("a",), np.zeros((1, 1)))
    with pytest.raises(Exception):  # noqa: B017  two times and one row of values
        torn.save(path)
    assert [(each.name, each.read_text()) for each in tmp_path.iterdir()] == [(path.name, "good")]


def write_lines(results: Results, path: str | Path) -> None:
    """One line of JSON per name: all that a new format needs, with the next function and a call."""
    with whole_file(path) as stream:
        for name in ("time", *results.names):
            stream.write(json.dumps([name, results[name].tolist()]) + "\n")


def read_lines(path: str | Path) -> Results:
    """What :func:`write_lines` wrote."""
    lines = [json.loads(line) for line in Path(path).read_text(encoding="utf-8").splitlines()]
    (_, time), *rest = lines
    values = np.array([column for _, column in rest]).T.reshape(len(time), len(rest))
    return results(time, tuple(name for name, _ in rest), values)


@pytest.fixture
def lines() -> Iterator[formats.Format]:
    """The format .lines, registered as a module of ``outputs`` does at its end."""
    formats.register_format(".lines", "a line of JSON per result", write_lines, read_lines)
    yield formats.formats()[".lines"]
    del formats.formats()[".lines"]


@pytest.mark.parametrize("sample", SAMPLES)
def test_a_new_format_keeps_what_it_writes(lines, sample: str, tmp_path: Path) -> None:
    write_read(lines, SAMPLES[sample], tmp_path / "a.lines")


DECK = """\
a free fall
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
MARKER/2, POINT_MASS=2
ACCGRAV/KGRAV=-9.81
REQUEST/1, DISPLACEMENT, I=2
END
"""


def test_a_new_format_is_solved_into_and_compared(lines, tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.adm").write_text(DECK)
    for name in ("a.csv", "a.LINES"):
        run = ["solve", "a.adm", "--end", "1", "--steps", "5", "--quiet", "-o", name]
        assert main(run) == 0
    assert main(["diff", "a.csv", "a.LINES", "--tol", "0"]) == 0
    assert main(["diff", "a.LINES", "a.csv", "--tol", "0"]) == 0
    assert "all within their tolerances" in capsys.readouterr().out
    assert main(["help", "formats"]) == 0
    page = " ".join(capsys.readouterr().out.split())
    assert "| `.lines` | a line of JSON per result" in page
    assert "`.lines`" in result_formats()


def test_a_wrong_suffix_is_answered_with_those_there_are(lines, tmp_path, capsys) -> None:
    known = r"a\.png: '\.png' is none of \.csv, \.lines, "
    with pytest.raises(UsageError, match=f"results cannot be written to .*{known}"):
        fall().save(tmp_path / "a.png")
    with pytest.raises(FormatError, match=f"results cannot be read from .*{known}"):
        Results.load(tmp_path / "a.png")
    deck = tmp_path / "a.adm"
    deck.write_text(DECK)
    assert main(["solve", str(deck), "--end", "1", "-o", str(tmp_path / "a.png")]) == 2
    assert ".csv, .lines" in capsys.readouterr().err
    assert not (tmp_path / "a.png").exists()


def test_a_suffix_has_one_format(lines) -> None:
    with pytest.raises(ValueError, match=r"\.lines is registered twice"):
        formats.register_format(".lines", "", write_lines)


def test_a_file_without_its_folder(tmp_path: Path) -> None:
    """The fault of the system names the file that was asked for, and nothing else."""
    path = tmp_path / "none" / "x.csv"
    with pytest.raises(FileNotFoundError) as caught:
        Results(time=np.zeros(1), names=("a",), values=np.zeros((1, 1))).save(path)
    assert str(caught.value) == f"[Errno 2] No such file or directory: '{path}'"

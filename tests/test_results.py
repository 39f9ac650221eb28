"""Results by name, and the way to a file and back."""

import os
from pathlib import Path

import numpy as np
import pytest
from fakes import fall
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from adamslite.errors import FormatError
from adamslite.outputs import csv
from adamslite.outputs.whole_files import whole_file
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results, UnknownChannel


def test_a_channel_is_found_in_any_case() -> None:
    results = fall()
    assert results["part/2.X"] is not None
    assert np.array_equal(results["PART/2.vx"], results.time)
    assert np.array_equal(results["time"], results.time)
    assert "PART/2.X" in results and "PART/3.x" not in results
    assert list(results) == ["PART/2.x", "PART/2.vx"]


def test_a_wrong_name_is_answered_with_the_nearest() -> None:
    with pytest.raises(UnknownChannel, match="did you mean PART/2.vx"):
        fall()["PART/2.vy"]
    with pytest.raises(KeyError, match="there are PART/2.x"):
        fall()["?"]
    with pytest.raises(KeyError, match="the results are empty"):
        Results(time=np.empty(0), names=(), values=np.empty((0, 0)))["x"]


@given(
    arrays.arrays(float, (3, 3), elements=st.floats(allow_nan=False, allow_subnormal=True)),
)
def test_every_number_reads_back_exactly(tmp_path_factory, numbers) -> None:
    path = tmp_path_factory.mktemp("csv") / "a.csv"
    written = Results(time=numbers[:, 0], names=("a", "b"), values=numbers[:, 1:])
    written.save(path)
    read = Results.load(path)
    assert np.array_equal(read.time, written.time)
    assert np.array_equal(read.values, written.values)
    assert np.array_equal(np.signbit(read.values), np.signbit(written.values))


def test_comment_lines_come_back_as_meta(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    fall(meta={"deck": "cable.adm", "units": "newton\nmeter"}).save(path)
    assert path.read_text().splitlines()[3] == "time,PART/2.x,PART/2.vx"
    assert Results.load(path).meta == {"deck": "cable.adm", "units": "newton meter"}


def test_an_early_end_is_written_down(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    fall(outcome=Outcome.STEP_TOO_SMALL, message="at SFORCE/5\nline 7").save(path)
    assert "# outcome: STEP_TOO_SMALL at SFORCE/5 line 7\n" in path.read_text()


def test_names_with_commas_are_quoted(tmp_path: Path) -> None:
    odd = Results(time=np.zeros(1), names=('VARIABLE/a,"b"',), values=np.ones((1, 1)))
    odd.save(tmp_path / "a.csv")
    assert Results.load(tmp_path / "a.csv").names == odd.names


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("t,a\n0,1\n", ":1: the header row must start with 'time', not 't'"),
        ("time;a\n0;1,5\n", "not 'time;a'; commas separate columns, and decimals have points"),
        ("time\ta\n0\t1\n", "; commas separate columns"),
        ('time,"' + "a" * 200_000 + "\n0,1\n", ":1: field larger than field limit"),
        ("# c\ntime,a,A\n0,1,2\n", ":2: the column 'a' is there twice"),
        ("time,a\n0,1\n1\n", ":3: 1 values where the header has 2 columns"),
        ("time,a\n0,1,2\n", ":2: 3 values where the header has 2 columns"),
        ("time,a\n0,1\n1,x\n", ":3: 'x' is not a number"),
        ("time,a\n0,\n", ":2: a cell is empty; write nan where there is no number"),
    ],
)
def test_a_file_that_is_no_table_is_explained(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "a.csv"
    path.write_text(text)
    with pytest.raises(FormatError) as fault:
        csv.read_table(path)
    assert message in str(fault.value)


def test_a_failed_write_leaves_the_earlier_file(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("good")
    with pytest.raises(RuntimeError), whole_file(path) as stream:
        stream.write("half of it")
        raise RuntimeError
    assert path.read_text() == "good"
    assert os.listdir(tmp_path) == ["a.csv"]


def test_a_link_stays_a_link_and_a_device_a_device(tmp_path: Path) -> None:
    (tmp_path / "real.csv").write_text("old")
    link = tmp_path / "link.csv"
    link.symlink_to("real.csv")
    fall().save(link)
    assert link.is_symlink() and "PART/2.x" in (tmp_path / "real.csv").read_text()
    fall().save(os.devnull)
    assert Path(os.devnull).is_char_device()

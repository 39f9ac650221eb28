"""Result files of other programs' formats: what they hold, and what is said of bad ones."""

from __future__ import annotations

import struct
import sys
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
import xarray
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from scipy.io import loadmat, netcdf_file, savemat
from scipy.sparse import csc_array

import adamslite
from adamslite.cli.main import main
from adamslite.errors import FormatError, UsageError
from adamslite.outputs import number_text
from adamslite.outputs.mat_file import variables
from adamslite.results.formats import formats
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.results.run_texts import CLOCKED

DECK = """\
Ein Seil \u00fcber Rollen
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND
ACCGRAV/JGRAV=-9810
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=2, IP=1,1,1, VX=3
MARKER/2, PART=2
POINT_MASS/3, MASS=1, CM=3, QG=5,0,0
MARKER/3, POINT_MASS=3
REQUEST/1, F2=DY(2,1)\\ F3=TIME, CUNITS="","V","V", COMMENT=height
VARIABLE/h, FUNCTION=2*TIME
SIMULATE/DYNAMIC, END=1, STEPS=4
END
"""
BINARY = [".nc", ".mat", ".parquet"]


@pytest.fixture(scope="module")
def run() -> Results:
    return adamslite.simulate(adamslite.read(DECK))


@pytest.mark.parametrize("suffix", BINARY)
def test_a_file_knows_its_run(run: Results, suffix: str, tmp_path: Path) -> None:
    """Deck, settings, counters, comments and units come back; so it can be solved again."""
    run.save(tmp_path / f"a{suffix}")
    again = Results.load(tmp_path / f"a{suffix}")
    assert again.source == run.source and again.source and again.source.deck == DECK
    counters = {name: each for name, each in run.summary.items() if name not in CLOCKED}
    assert again.meta == run.meta and again.summary == counters
    assert again.channel("PART/2.vx").unit == "mm/s"
    assert again.channel("REQUEST/1.F3").unit == "V"
    assert again.channel("REQUEST/1.F2").long_name == "displacement F2 of REQUEST/1 (height)"
    repeated = adamslite.simulate(again.source.read()[0])
    assert repeated.values.tobytes() == run.values.tobytes()


LINEAR = """\
a mass on a spring, linearised twice
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=2, IP=1,2,3, QG=0,-1,0
MARKER/2, PART=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=200, C=2, LENGTH=1
VARIABLE/1, FUNCTION=0
PINPUT/1, VARIABLES=1
POUTPUT/1, VARIABLES=1
END
"""


@pytest.mark.parametrize("suffix", [*BINARY, ".res"])
def test_what_linear_found_is_kept(suffix: str, tmp_path: Path) -> None:
    """Modes can be drawn from a file; every number is the same to the bit."""
    deck = adamslite.read(LINEAR)
    commands = "SIMULATE/DYNAMIC, END=0.1, STEPS=1\nLINEAR/EIGENSOL, COORDS=1,2\n"
    commands += "LINEAR/STATEMAT, PINPUT=1, POUTPUT=1, FILE=a\nLINEAR/MKB, FILE=b\n"
    run = adamslite.simulate(deck, commands=commands)
    run.save(tmp_path / f"a{suffix}")
    again = Results.load(tmp_path / f"a{suffix}").linearizations
    assert len(again) == len(run.linearizations) == 3
    for one, other in zip(again, run.linearizations, strict=True):
        assert one._replace(model=other.model) == other
        for name, value in vars(other.model).items():
            kept = getattr(one.model, name)
            if isinstance(value, np.ndarray):
                assert kept.tobytes() == value.tobytes() and kept.shape == value.shape
                assert kept.dtype == value.dtype
            elif name == "second_order" and value:
                assert all(map(np.array_equal, kept, value))
            else:
                assert kept == value


@pytest.mark.parametrize("suffix", [*BINARY, ".csv"])
def test_an_early_end_is_kept(suffix: str, tmp_path: Path) -> None:
    names, values = ("a",), np.zeros((1, 1))
    early = Results(time=np.zeros(1), names=names, values=values,
                    outcome=Outcome.NOT_FINITE, message="SFORCE/5\nline 7")  # fmt: skip
    early.save(tmp_path / f"a{suffix}")
    again = Results.load(tmp_path / f"a{suffix}")
    told = "SFORCE/5 line 7" if suffix == ".csv" else "SFORCE/5\nline 7"
    assert (again.outcome, again.message) == (Outcome.NOT_FINITE, told)
    again.save(tmp_path / f"b{suffix}")
    assert (tmp_path / f"b{suffix}").read_bytes() == (tmp_path / f"a{suffix}").read_bytes()


def test_xarray_opens_netcdf(run: Results, tmp_path: Path) -> None:
    run.save(tmp_path / "a.nc")
    with xarray.open_dataset(tmp_path / "a.nc") as data:
        assert dict(data.sizes) == {"time": 5, "body": 2, "axis": 3, "angle": 3}
        assert data["position"].dims == ("time", "body", "axis")
        height = data["position"].sel(body="PART/2", axis="y")
        assert height.values == pytest.approx(run["PART/2.y"])
        assert data["velocity"].attrs == {
            "units": "mm/s", "long_name": "velocity, ground axes",
        }  # fmt: skip
        assert np.isnan(data["orientation"].sel(body="POINT_MASS/3")).all()
        assert data["REQUEST_1_F3"].attrs["units"] == "V"
        assert data["VARIABLE_h"].attrs["channel"] == "VARIABLE/h"
        assert data.attrs["deck"] == DECK and data.attrs["title"] == "Ein Seil \u00fcber Rollen"
        assert data.time.attrs["units"] == "s"


def test_netcdf_that_xarray_has_written_is_read(run: Results, tmp_path: Path) -> None:
    run.save(tmp_path / "a.nc")
    with xarray.open_dataset(tmp_path / "a.nc") as data:
        data.load().to_netcdf(tmp_path / "b.nc", engine="scipy", format="NETCDF3_64BIT")
    again = Results.load(tmp_path / "b.nc")
    assert again.names == run.names and again.source == run.source
    assert np.array_equal(again.values, run.values)


def test_netcdf_of_another_program_has_its_variables_as_columns(tmp_path: Path) -> None:
    with netcdf_file(tmp_path / "a.nc", "w") as file:
        file.createDimension("time", 3)
        for name in ("time", "height"):
            file.createVariable(name, "f", ("time",))[:] = [0, 1, 2]
    found = Results.load(tmp_path / "a.nc")
    assert found.names == ("height",) and found["height"].tolist() == [0.0, 1.0, 2.0]


def test_matlab_sees_columns_names_and_units(run: Results, tmp_path: Path) -> None:
    run.save(tmp_path / "a.mat")
    found = loadmat(tmp_path / "a.mat", squeeze_me=True)
    assert found["time"].tolist() == run.time.tolist()
    assert found["values"].shape == run.values.shape
    assert found["names"].tolist() == list(run.names)
    assert found["units"][run.names.index("PART/2.ax")] == "mm/s^2"
    assert str(found["run"]["deck"]) == DECK


def test_matlab_without_units_is_read(tmp_path: Path) -> None:
    names = np.array(["x", "\u00e4"], dtype=object)
    savemat(tmp_path / "a.mat", {"time": [0.0, 1.0], "values": np.eye(2), "names": names})
    assert Results.load(tmp_path / "a.mat").names == ("x", "\u00e4")


def test_matlab_texts_of_every_kind_are_read(tmp_path: Path) -> None:
    """Cells of texts and of cells, texts in other letters, rows of characters of equal length."""
    times, numbers = np.arange(2), np.array([[1, 2, 3], [-4, 5, 6]], dtype=np.int8)
    inner = np.array(["\u4e09"], dtype=object)
    for names in (
        np.array(["\u00e4", "x y", inner], dtype=object),
        np.array(["\u00e4", "x y", "z"]),
    ):
        savemat(tmp_path / "a.mat", {"time": times, "values": numbers, "names": names})
        found = Results.load(tmp_path / "a.mat")
        assert found.names[:2] == ("\u00e4", "x y") and found.names[2] in ("\u4e09", "z")
        assert found.values.tolist() == numbers.tolist() and found.values.dtype == float


@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from(["<f8", ">f8", "<f4", "<i8", "<u8", "<i4", ">u2", "<i2", "u1", "i1", "bool"]),
    st.integers(0, 3), st.integers(0, 4), st.booleans(),
)  # fmt: skip
def test_matlab_files_are_read_as_scipy_reads_them(
    kind: str, rows: int, columns: int, packed: bool
) -> None:
    values = np.random.default_rng(rows).integers(0, 100, (rows, columns)).astype(kind)
    memory = BytesIO()
    savemat(memory, {"other": np.eye(3), "a": values, "s": {"b": "text"}}, do_compression=packed)
    found, theirs = variables(memory.getvalue()), loadmat(BytesIO(memory.getvalue()))
    assert set(found) == {"other", "a", "s"} and found["a"].shape == values.shape
    mine = found["a"].numbers().reshape(values.shape, order="F")
    assert mine.tolist() == theirs["a"].tolist() == values.tolist()
    assert found["s"].fields()["b"].text() == "text"


@pytest.mark.parametrize(
    ("values", "said"),
    [
        (np.eye(2) * 1j, "no full matrix of real numbers"),
        (csc_array(np.eye(2)), "no full matrix of real numbers"),
        (np.array([["a", "b"]], dtype=object), "no full matrix of real numbers"),
    ],
    ids=["complex", "sparse", "cells"],
)
def test_matlab_numbers_that_are_no_results_are_named(values, said: str, tmp_path: Path) -> None:
    names = np.array(["x", "y"], dtype=object)
    savemat(tmp_path / "a.mat", {"time": [0.0, 1.0], "values": values, "names": names})
    with pytest.raises(FormatError, match=f"'values' is {said}"):
        Results.load(tmp_path / "a.mat")


# ---- bad files -----------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", BINARY)
@pytest.mark.parametrize("share", [0.0, 0.01, 0.1, 0.3, 0.6, 0.9, 0.99])
def test_a_file_that_is_cut_off_is_named(
    run: Results, suffix: str, share: float, tmp_path: Path
) -> None:
    path = tmp_path / f"a{suffix}"
    run.save(path)
    data = path.read_bytes()
    path.write_bytes(data[: int(share * len(data))])
    with pytest.raises(FormatError, match=f"a{suffix}"):
        Results.load(path)


BAD = {
    "a text": b"time,x\n0,1\n",
    "nothing": b"",
    "HDF5": b"\x89HDF\r\n\x1a\n" + bytes(100),
    "zeros": bytes(1000),
    "MATLAB 4": struct.pack("<5i", 0, 1, 1, 0, 5) + b"time\0" + bytes(200),
    "MATLAB 7.3": b"MATLAB 7.3 MAT-file, Platform" + bytes(1000),
}


@pytest.mark.parametrize("content", BAD)
@pytest.mark.parametrize("suffix", BINARY)
def test_a_file_that_is_no_result_is_one_sentence(
    suffix: str, content: str, tmp_path: Path, capsys
) -> None:
    path = tmp_path / f"a{suffix}"
    path.write_bytes(BAD[content])
    assert main(["diff", str(path), str(path)]) == 5
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and f"a{suffix}" in said


def test_what_can_be_converted_is_said(tmp_path: Path) -> None:
    (tmp_path / "a.nc").write_bytes(BAD["HDF5"])
    with pytest.raises(FormatError, match="NetCDF-4 .*nccopy"):
        Results.load(tmp_path / "a.nc")
    (tmp_path / "a.mat").write_bytes(BAD["MATLAB 7.3"])
    with pytest.raises(FormatError, match="save -v7"):
        Results.load(tmp_path / "a.mat")


def test_without_pyarrow_a_sentence_says_what_to_install(
    run: Results, tmp_path: Path, monkeypatch, capsys
) -> None:
    """Before the run."""
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(UsageError, match=r"pip install 'adamslite\[parquet\]'"):
        run.save(tmp_path / "a.parquet")
    (tmp_path / "a.adm").write_text(DECK)
    monkeypatch.setattr(adamslite, "simulate", lambda *_, **__: pytest.fail("a run began"))
    assert main(["solve", str(tmp_path / "a.adm"), "-o", str(tmp_path / "a.parquet")]) == 2
    said = capsys.readouterr().err
    assert "pyarrow" in said and said.count("\n") == 1
    assert not (tmp_path / "a.parquet").exists()


# ---- numbers as text -----------------------------------------------------------------------------


@given(arrays.arrays(float, (4, 3), elements=st.floats(allow_nan=False, allow_infinity=False)))
def test_orjson_spells_numbers_as_python_does(numbers: np.ndarray) -> None:
    import orjson

    assert number_text._by_orjson(orjson, numbers) == number_text._by_python(numbers)


@pytest.mark.parametrize("power", range(-12, 24))
def test_every_power_of_ten_is_spelled_alike(power: int) -> None:
    import orjson

    numbers = np.random.default_rng(power + 12).standard_normal((20, 5)) * 10.0**power
    numbers = np.vstack([numbers, np.round(numbers, 3), np.full((1, 5), 10.0**power)])
    assert number_text._by_orjson(orjson, numbers) == number_text._by_python(numbers)


def test_a_table_has_the_same_bytes_without_orjson(tmp_path: Path, monkeypatch) -> None:
    """Long enough that orjson is used, with rows that hold no numbers."""
    values = np.random.default_rng(1).standard_normal((300, 100)) * 1e-4
    values[17, 3], values[200, 0] = np.nan, -np.inf
    names = tuple(f"VARIABLE/{n}" for n in range(100))
    table = Results(time=np.linspace(0, 1e-4, 300), names=names, values=values)
    table.save(tmp_path / "a.csv")
    monkeypatch.setattr(number_text, "_orjson", lambda: None)
    table.save(tmp_path / "b.csv")
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()
    assert number_text.MANY < values.size and set(BINARY) < set(formats())

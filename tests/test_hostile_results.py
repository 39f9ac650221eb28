"""Attacks on the promises of docs/security.md: files of results and saved states of others neither
run code nor take the machine, and end in a sentence.
"""

from __future__ import annotations

import base64
import json
import os
import pickle
import struct
import tracemalloc
import zlib
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from subprocess import Popen
from threading import Thread
from time import process_time
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from scenes import SPRING
from scipy.io import netcdf_file, savemat

import adamslite as al
from adamslite.errors import FormatError, UsageError
from adamslite.language import text
from adamslite.outputs.saved_files import SavedFiles
from adamslite.results import untrusted
from adamslite.results.results import Results

# A block that ends before it begins: read again and again, with more memory each time.
BACKWARDS = b"FILE TYPE AND SOURCE".ljust(40) + b"1\n!\n" + b"TITLE".ljust(40) + b"-1\n"
SPACE = 'xmlns="http://www.mscsoftware.com/:xrf10"'
LAUGHS = "<!DOCTYPE r [<!ENTITY a 'ha'>" + "".join(
    f"<!ENTITY {chr(98 + k)} '{f'&{chr(97 + k)};' * 10}'>" for k in range(9)
)
BOMB = f"{LAUGHS}]><Results {SPACE}><Step>&j;</Step></Results>"
ELSEWHERE = f"<!DOCTYPE r [<!ENTITY j SYSTEM 'file:///etc/passwd'>]><Results {SPACE}>&j;</Results>"


def own_texts(content: bytes) -> bytes:
    """A .res with the comment by which this program reads back its texts."""
    packed = base64.b64encode(zlib.compress(content)).decode()
    return f"<Results {SPACE}><!-- adamslite texts of the run: {packed} --></Results>".encode()


def netcdf(**attributes: str) -> bytes:
    """A small file of results with attributes of our choice."""
    memory = BytesIO()
    file = netcdf_file(memory, "w", version=2)
    file.createDimension("time", 3)
    file.createVariable("time", "d", ("time",))[:] = [0.0, 1.0, 2.0]
    for name, value in attributes.items():
        setattr(file, name, value.encode())
    file.flush()
    return memory.getvalue()


def array(kind: str, count: int) -> str:
    """Zeros as results of LINEAR commands keep them."""
    packed = base64.b64encode(zlib.compress(bytes(8 * count))).decode()
    return json.dumps([{"shape": [count], "type": kind, "data": packed}])


def matlab(count: int, kind: type = float) -> bytes:
    """Zeros, a thousand times smaller as a file."""
    memory = BytesIO()
    names = np.array([["x"]], dtype=object)
    table = {"time": np.zeros((count, 1), kind), "values": np.zeros((count, 1), kind)}
    savemat(memory, {**table, "names": names}, do_compression=True)
    return memory.getvalue()


def packed_matlab(size: int) -> bytes:
    """A file of MATLAB with so many zeros in one compressed element."""
    packed = zlib.compress(bytes(size))
    return bytes(124) + b"\0\1IM" + struct.pack("<II", 15, len(packed)) + packed


def parquet(count: int) -> bytes:
    """Zeros, far smaller as a file."""
    arrow = pytest.importorskip("pyarrow")
    import pyarrow.parquet

    memory = BytesIO()
    zeros = arrow.array(np.zeros(count))
    pyarrow.parquet.write_table(arrow.table({"time": zeros, "x": zeros}), memory)
    return memory.getvalue()


CASES: dict[str, tuple[str, Callable[[], bytes], str]] = {
    "laughs": (".res", lambda: BOMB.encode(), "declares a document type"),
    "laughs behind a comment": (
        ".res", lambda: f"<!--{'x' * 9000}-->{BOMB}".encode(), "declares a document type"),
    "laughs in UTF-16": (".res", lambda: BOMB.encode("utf-16-le"), "declares a document type"),
    "another file": (".res", lambda: ELSEWHERE.encode(), "declares a document type"),
    "deep elements": (
        ".res", lambda: f"<Results {SPACE}>{'<a>' * 100_000}".encode(), "deep in each other"),
    "compressed text": (".res", lambda: own_texts(bytes(20_000_000)), "compressed in it is larger"),
    "deep text": (".res", lambda: own_texts(b"[" * 1_000_000), "JSON in it is too deep"),
    "deep attribute": (".nc", lambda: netcdf(comments="[" * 100_000), "not those of adamslite"),
    "array of objects": (".nc", lambda: netcdf(linear=array("O", 1)), "not those of adamslite"),
    "long array": (".nc", lambda: netcdf(linear=array("<f8", 2_500_000)), "not those of adamslite"),
    "zeros of MATLAB": (".mat", lambda: matlab(3_000_000), "in it is larger"),
    "bytes of MATLAB": (".mat", lambda: matlab(1_300_000, np.int8), "not that much alike"),
    "packed zeros of MATLAB": (".mat", lambda: packed_matlab(20_000_000), "in it is larger"),
    "zeros of Parquet": (".parquet", lambda: parquet(3_000_000), "results are not that much alike"),
    "less than no lines": (".res", lambda: BACKWARDS, "damaged or cut off: the block in line 3"),
    "many requests": (".req", lambda: b"A.R3 d\nt\n999999999 u\n1 2 3\n", "damaged or cut off"),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_a_small_file_does_not_become_a_large_one(case: str, tmp_path: Path, monkeypatch) -> None:
    """With bounds a tenth as high as those of the program, so that the test takes little itself."""
    suffix, made, said = CASES[case]
    monkeypatch.setattr(untrusted, "MOST", 10_000_000)
    path = tmp_path / f"a{suffix}"
    path.write_bytes(made())
    with pytest.raises(FormatError, match=said):
        Results.load(path)


class Trap:
    """An object whose unpickling creates a file."""

    def __init__(self, mark: Path) -> None:
        self.mark = mark

    def __reduce__(self) -> tuple[Any, ...]:
        return open, (str(self.mark), "w")


READABLE, OTHERS = ("csv", "nc", "mat", "parquet", "res", "req"), ("npz", "npy", "pkl", "kept")


@pytest.mark.parametrize("suffix", [*READABLE, *OTHERS])
def test_nothing_is_unpickled(suffix: str, tmp_path: Path) -> None:
    """By whatever name, alone or as an array of objects of numpy."""
    mark = tmp_path / "ran"
    array = BytesIO()
    np.save(array, np.array([Trap(mark)], dtype=object), allow_pickle=True)
    for content in (pickle.dumps(Trap(mark)), array.getvalue()):
        mark.unlink(missing_ok=True)
        path = tmp_path / f"a.{suffix}"
        path.write_bytes(content)
        with pytest.raises((FormatError, UsageError)):
            Results.load(path)
        with pytest.raises(FormatError):
            al.load_sweep(path)
        assert not mark.exists()


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="a device of Unix")
def test_what_has_no_end_is_not_read(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """No further than to where it is too much."""
    tracemalloc.start()
    try:
        with pytest.raises(OSError, match="more than 17 MB are not read"):
            text.contents("/dev/zero")
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert text.OF_DEVICE < most < text.OF_DEVICE + 4 * text.PIECE
    monkeypatch.setattr(text, "OF_PIPE", 1_000_000)
    pipe = tmp_path / "a.csv"
    os.mkfifo(pipe)
    with Popen(["cat", "/dev/zero"], stdout=os.open(pipe, os.O_RDWR)) as endless:
        with pytest.raises(OSError, match="more than 1 MB are not read"):
            text.contents(pipe)
        endless.kill()


def test_a_pipe_is_read_to_its_end(tmp_path: Path) -> None:
    """As `diff <(...)` names one."""
    table, pipe = b"time,x\n" + b"0,1\n" * 100_000, tmp_path / "a.csv"
    os.mkfifo(pipe)
    writer = Thread(target=pipe.write_bytes, args=(table,))
    writer.start()
    assert text.contents(pipe) == table
    writer.join()


def test_a_long_comment_of_a_results_file_is_read_once(tmp_path: Path) -> None:
    """By a parser that begins again with each piece it is given it was read 600 times, in 19 s."""
    path = tmp_path / "a.res"
    path.write_text(f"<Results {SPACE}><!--{'a' * 10_000_000}--></Results>")
    start = process_time()
    ElementTree.fromstring(path.read_text())
    plain, start = process_time() - start, process_time()
    with pytest.raises(FormatError, match="it names no TIME"):
        Results.load(path)
    assert process_time() - start < 40.0 * max(plain, 0.1)


@pytest.mark.slow
def test_elements_that_are_no_results_are_not_kept(tmp_path: Path) -> None:
    path = tmp_path / "a.res"
    path.write_text(f"<Results {SPACE}>{'<a><b/></a>' * 200_000}</Results>")
    tracemalloc.start()
    with pytest.raises(FormatError, match="it names no TIME"):
        Results.load(path)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 12 * path.stat().st_size


def test_what_is_larger_than_memory_is_not_read(tmp_path: Path) -> None:
    """A file without blocks, as an archive may hold it: it takes no room on the disk."""
    place = tmp_path / "long.adm"
    place.touch()
    os.truncate(place, 1 << 42)
    for read in (al.read, al.check, al.cable, al.names, text.contents):
        with pytest.raises(OSError, match="MB are not read"):
            read(place)


# ---- states that SAVE has written ---------------------------------------------------------------

COMMANDS = "SIMULATE/DYNAMIC, END=0.1, STEPS=2\nSAVE/SYSTEM, FILE=a.sav\n"
AGAIN = "RELOAD/SYSTEM, FILE=a.sav\nSIMULATE/DYNAMIC, END=0.2, STEPS=2\n"
FORGED = {
    "rows far behind the last": ("dropped", [10**9]),
    "rows that no constraint has": ("dropped", [0, 1, 2]),
    "a row before the first": ("dropped", [-1]),
    "a row with more digits than an integer": ("dropped", [2**70]),
    "no time": ("time", float("nan")),
    "an endless time": ("time", float("inf")),
    "settings.kmax": ("kmax", 10**30),
    "settings.error": ("error", -1.0),
    "settings.hmax": ("hmax", 0),
    "settings.method": ("method", "../x"),
    "settings.scale": ("scale", ["x"]),
    "settings.maxit": ("maxit", 1.5),
    "statics.maxit": ("maxit", "many"),
    "arrays.q": ("q", [1.0] * 1000),
    "arrays.u": ("u", [[1.0, 2.0]] * 4),
    "arrays.z": ("z", [float("nan")]),
    "deep": ("", "[" * 1_000_000),
    "version": ("saved by adamslite", int("9" * 4000)),
}


@pytest.mark.parametrize("case", FORGED)
def test_a_forged_state_is_refused(case: str, tmp_path: Path) -> None:
    """Native code takes sizes and rows as they are: one that is out of range ended the process."""
    deck = al.read(SPRING)
    al.simulate(deck, commands=COMMANDS, files=SavedFiles(tmp_path))
    place = tmp_path / "a.sav"
    whole = json.loads(place.read_text(encoding="utf-8"))
    name, value = FORGED[case]
    part = whole[case.partition(".")[0]] if "." in case else whole
    part[name] = value
    place.write_text(value if case == "deep" else json.dumps(whole), encoding="utf-8")
    with pytest.raises(UsageError, match="RELOAD|There is no integrator"):
        al.simulate(deck, commands=AGAIN, files=SavedFiles(tmp_path))


@pytest.mark.skipif(os.name == "nt", reason="links of Unix")
def test_a_state_elsewhere_is_not_read(tmp_path: Path) -> None:
    deck, folder = al.read(SPRING), tmp_path / "run"
    folder.mkdir()
    al.simulate(deck, commands=COMMANDS, files=SavedFiles(tmp_path))
    (folder / "a.sav").symlink_to(tmp_path / "a.sav")
    with pytest.raises(UsageError, match="a link that leads out of its folder"):
        al.simulate(deck, commands=AGAIN, files=SavedFiles(folder))

"""Deck, model, kernels and results as other processes get them."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import adamslite as al
from adamslite.caching import entries

ROOT = Path(__file__).parent.parent
SCENES = ("hanging-mass", "four-bar", "delayed-brake", "replay/pendulum")
RUN = """
import pickle, sys
import adamslite as al
thing, found = pickle.load(open(sys.argv[1], "rb")), sys.argv[2]
pickle.dump(al.simulate(thing, end=0.1, steps=4), open(found, "wb"))
"""


def decks() -> list[Path]:
    return [
        ROOT / "decks" / name.partition("/")[0] / f"{name.rpartition('/')[2]}.adm"
        for name in SCENES
    ]


def in_another_process(pickled: bytes, folder: Path) -> al.Results:
    """The results of a run there, which come back pickled, too."""
    (folder / "thing").write_bytes(pickled)
    command = [sys.executable, "-c", RUN, str(folder / "thing"), str(folder / "found")]
    subprocess.run(command, check=True)
    found: al.Results = pickle.loads((folder / "found").read_bytes())
    return found


@pytest.mark.parametrize("path", decks(), ids=lambda path: path.stem)
def test_deck_model_and_kernels_run_alike_when_they_come_back(path: Path) -> None:
    deck = al.read(path)
    model = al.assemble(deck)
    kernels = al.compile_model(model)
    here = al.simulate(kernels, end=0.1, steps=4)
    for each in (deck, model, kernels):
        there = al.simulate(pickle.loads(pickle.dumps(each)), end=0.1, steps=4)
        assert np.array_equal(there.values, here.values, equal_nan=True)
        assert (there.names, there.meta) == (here.names, here.meta)


def test_kernels_run_alike_in_another_process(tmp_path: Path) -> None:
    """Their addresses are those of one process alone."""
    kernels = al.compile_model(al.assemble(al.read(decks()[0])))
    here = al.simulate(kernels, end=0.1, steps=4)
    there = in_another_process(pickle.dumps(kernels), tmp_path)
    assert np.array_equal(there.values, here.values)
    assert (there.names, there.meta, there.outcome) == (here.names, here.meta, here.outcome)


def test_kernels_for_another_processor_are_compiled_again(tmp_path: Path, monkeypatch) -> None:
    """Code for AVX would stop a process without it."""
    kernels = al.compile_model(al.assemble(al.read(decks()[0])))
    here = al.simulate(kernels, end=0.1, steps=4)
    for group in kernels.groups:
        group.code = b"code of another processor"
    with monkeypatch.context() as patch:
        patch.setattr("adamslite.native.processor.identity", lambda: "another")
        pickled = pickle.dumps(kernels)
    there = in_another_process(pickled, tmp_path)
    assert np.array_equal(there.values, here.values)


def test_kernels_that_came_back_take_other_numbers() -> None:
    kernels = al.compile_model(al.assemble(al.read(decks()[0])))
    back = pickle.loads(pickle.dumps(kernels))
    one, two = (
        al.simulate(each.with_values({"POINT_MASS/2.MASS": 3}), end=0.1, steps=4)
        for each in (kernels, back)
    )
    assert np.array_equal(one.values, two.values)


def test_results_come_back_with_what_they_were_made_from() -> None:
    results = al.simulate(decks()[0], end=0.1, steps=4)
    back = pickle.loads(pickle.dumps(results))
    assert np.array_equal(back.values, results.values)
    assert (back.names, back.meta, back.summary) == (results.names, results.meta, results.summary)
    assert back.source == results.source


def makes_an_entry(name: str, log: str) -> None:
    def made() -> bytes:
        with open(log, "a") as file:
            file.write("made\n")
        import time

        time.sleep(0.2)
        return b"content"

    assert entries.recall(name, made) == b"content"


@pytest.mark.skipif(sys.platform == "win32", reason="files are not locked there")
def test_of_several_processes_one_makes_an_entry(tmp_path: Path, monkeypatch) -> None:
    from multiprocessing import get_context

    monkeypatch.setenv("ADAMSLITE_CACHE", str(tmp_path / "cache"))
    context, log = get_context("fork"), tmp_path / "log"
    arguments = (f"test{'0' * 32}.o", str(log))
    workers = [context.Process(target=makes_an_entry, args=arguments) for _ in range(4)]
    for each in workers:
        each.start()
    for each in workers:
        each.join()
        assert each.exitcode == 0
    assert log.read_text() == "made\n"
    assert [each.name for each in (tmp_path / "cache").iterdir()] == [arguments[0]]

"""The comment on the accuracy of a run, whose second run waits until somebody looks at it."""

from __future__ import annotations

import copy
import json
import pickle
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import adamslite as al
from adamslite.analyses import simulation
from adamslite.analyses.setup.run_options import Budget

#: A pendulum of a point mass on a stiff spring at a large ERROR, which is off by more than is felt.
DECK = """\
a mass on a spring
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=1,0.5,0
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=-{k}*DX(2)\\, FY=-AKISPL(DY(2),0,7)
SPLINE/7, FILE=law.csv
ACCGRAV/JGRAV=-1
END
"""
FOLDER = Path(__file__).parent.parent / "decks"


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """What second runs were requested."""
    found: list[Any] = []
    inner = simulation._attempted

    def counted(*arguments: Any, **options: Any) -> Any:
        found.append(options)
        return inner(*arguments, **options)

    monkeypatch.setattr(simulation, "_attempted", counted)
    return found


def deck(k: float = 700.0) -> al.Deck:
    return al.read(DECK.format(k=k).replace("SPLINE/7, FILE=law.csv", SPLINE))


SPLINE = "SPLINE/7, X=-3,-2,-1,0,1,2,3, Y=-9,-5,-2,0,2,5,9"
CHANGE = (
    "SIMULATE/DYNAMICS, END=2, STEPS=20\nPOINT_MASS/2, MASS=2\nSIMULATE/DYNAMICS, END=4, STEPS=40"
)


def run(subject: Any, **options: Any) -> al.Results:
    span = {} if "commands" in options else {"end": 5.0, "steps": 50}
    return al.simulate(subject, **span, integrator="GSTIFF", error=1e-4, **options)


def test_columns_need_no_second_run_and_the_comment_needs_one(runs: list[Any]) -> None:
    results = run(deck())
    for name in results:
        assert np.isfinite(results[name]).all()
    assert results.meta["integrator"] and results.meta.get("units") and "energy" not in results.meta
    assert results.select("POINT_MASS/2").by_row().success and repr(results)
    assert not runs
    assert "estimated global error" in results.meta["accuracy"]
    assert "accuracy" in results.meta and len([*results.meta]) == len(results.meta)
    assert len(runs) == 2  # a second, and a third since both are short


LOOKS: dict[str, Callable[[al.Results], Any]] = {
    "names": lambda results: {key: results.meta[key] for key in results.meta},
    "unpacked": lambda results: {**results.meta},
    "dict": lambda results: dict(results.meta),
    "updated": lambda results: _updated(results.meta),
    "items": lambda results: dict(results.meta.items()),
    "or": lambda results: {} | results.meta,
    "copy": lambda results: copy.copy(results.meta),
    "deepcopy": lambda results: copy.deepcopy(results).meta,
    "json": lambda results: json.loads(json.dumps(results.meta)),
    "pickled": lambda results: pickle.loads(pickle.dumps(results)).meta,
    "pickled of old": lambda results: pickle.loads(pickle.dumps(results, protocol=2)).meta,
    "printed": lambda results: eval(repr(results.meta)),
    "selected": lambda results: results.select("POINT_MASS/2.x").meta,
}


def _updated(meta: Any) -> dict[str, str]:
    found: dict[str, str] = {}
    found.update(meta)
    return found


@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS.keys())
def test_whoever_looks_at_all_comments_sees_it(look: Callable[[al.Results], Any]) -> None:
    at_once = dict(run(deck(), memory_limit="100GB").meta)
    assert "estimated global error" in at_once["accuracy"]
    found = look(run(deck()))
    assert found == at_once and [*found] == [*at_once]


def test_files_have_it(tmp_path: Path, runs: list[Any]) -> None:
    results = run(deck())
    results.save(tmp_path / "one.csv")
    assert al.Results.load(tmp_path / "one.csv").meta["accuracy"] == results.meta["accuracy"]
    assert len(runs) == 2


def test_it_is_made_at_once_where_it_may_be_different_later(
    tmp_path: Path, runs: list[Any]
) -> None:
    """Files of SAVE may be gone, a limit of memory is one of the run."""
    for k, options in enumerate(({"files": tmp_path}, {"memory_limit": "100GB"}), 1):
        results = run(deck(), **options)
        assert len(runs) == 2 * k
        assert "accuracy" in results.meta and len(runs) == 2 * k


@pytest.mark.parametrize("filed", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_it_is_of_the_run_whatever_happened_since(tmp_path: Path, seed: int, filed: bool) -> None:
    """Other numbers of the same kernels, changed values and a file that is gone."""
    rates = np.random.default_rng(seed).uniform(500.0, 900.0, 4)
    law = tmp_path / "law.csv"
    x = np.arange(-3.0, 4.0)
    law.write_text("x,y\n" + "".join(f"{a},{b}\n" for a, b in zip(x, 2 * x + x**3, strict=True)))
    path = tmp_path / "deck.adm"
    text = DECK.format(k=rates[0])
    path.write_text(text if filed else text.replace("SPLINE/7, FILE=law.csv", SPLINE))
    kernels = al.compile_model(al.assemble(al.read(path)))
    stretched = kernels.with_values({"POINT_MASS/2.MASS": 1.7})
    now = [dict(run(each, memory_limit="100GB").meta) for each in (kernels, stretched)]
    later = [run(each) for each in (kernels, stretched)]
    at_once = dict(run(kernels, commands=CHANGE, memory_limit="100GB").meta)
    others = [kernels.with_values({"POINT_MASS/2.MASS": each / 500.0}) for each in rates]
    changed = run(kernels, commands=CHANGE)
    law.unlink()
    path.unlink()
    for each in others:
        run(each)
    for each in later:
        each.values[:] *= 1e3
    assert [each.meta for each in later] == now
    assert now[0]["accuracy"] != now[1]["accuracy"]
    assert changed.meta == at_once


def test_threads_look_at_their_own_and_at_the_same() -> None:
    kernels = al.compile_model(al.assemble(deck()))
    masses = [1.0 + k / 10 for k in range(6)]
    varied = [kernels.with_values({"POINT_MASS/2.MASS": mass}) for mass in masses]
    now = [run(each, memory_limit="100GB").meta["accuracy"] for each in varied]
    later = [run(each) for each in varied]
    with ThreadPoolExecutor(4) as pool:
        found = [*pool.map(lambda each: dict(each.meta)["accuracy"], [*later, *later])]
    assert found == [*now, *now]


def test_what_a_caller_writes_stays() -> None:
    results = run(deck())
    results.meta["accuracy"] = "mine"
    assert results.meta["accuracy"] == "mine" == dict(results.meta)["accuracy"]


@pytest.mark.parametrize(
    "name", ["hanging-mass", "andrews", "slider-crank", "delayed-brake", "heavy-top"]
)
def test_decks_have_the_same_comments_later_and_at_once(name: str) -> None:
    path = FOLDER / name / f"{name}.adm"
    at_once = al.simulate(path, memory_limit="100GB", strict=None)
    later = al.simulate(path, strict=None)
    assert dict(later.meta) == dict(at_once.meta)


def test_the_note_is_that_of_a_run_without_a_limit_of_cpu(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a run that is resumed ends with does not depend on how much of its limit is left."""
    monkeypatch.setattr(Budget, "cpu_left", property(lambda budget: 1e-9))
    assert run(deck(), cpu_limit=600.0).meta["accuracy"] == run(deck()).meta["accuracy"]

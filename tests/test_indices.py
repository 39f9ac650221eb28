"""Sobol indices of sweeps, against closed forms.

Ishigami: y = sin a + 7 sin^2 b + 0.1 c^4 sin a, numbers from -pi to pi. First indices 0.3139,
0.4424, 0; totals 0.5576, 0.4424, 0.2437 (T. Ishigami, T. Homma, 1990).
"""

from __future__ import annotations

import csv
from math import log
from pathlib import Path

import numpy as np
import pytest
from sweep_tables import design, made

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import UsageError

ISHIGAMI = """numbers alone
UNITS/SYSTEM=MKS
PART/1, GROUND
POINT_MASS/2, MASS=2, CM=2, QG=0,5,0
MARKER/2, POINT_MASS=2
VARIABLE/a, FUNCTION=0
VARIABLE/b, FUNCTION=0
VARIABLE/c, FUNCTION=0
REQUEST/1, F2=SIN(VARVAL(a)) + 7*SIN(VARVAL(b))**2 + 0.1*VARVAL(c)**4*SIN(VARVAL(a))
SIMULATE/DYNAMIC, END=0.01, STEPS=1
END
"""
HANGING = """a mass that hangs on a spring: y = -m g/k at rest
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=0,-1,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=100, LENGTH=0
SIMULATE/STATIC
END
"""
FULL = [f"{name}={-np.pi!r}:{np.pi!r}" for name in "abc"]
FIRST, TOTAL = [0.3139, 0.4424, 0.0], [0.5576, 0.4424, 0.2437]


def ishigami(values: np.ndarray) -> np.ndarray:
    a, b, c = values.T
    return np.sin(a) + 7 * np.sin(b) ** 2 + 0.1 * c**4 * np.sin(a)


def test_the_design_takes_one_number_after_the_other_from_b() -> None:
    a, b, *mixed = np.split(design("saltelli:8", "a=0:1", "b=10:20", "c=-1:0"), 5)
    assert len(a) == 8 and not (a == b).any()
    for k, page in enumerate(mixed):
        assert (page[:, k] == b[:, k]).all()
        others = [n for n in range(3) if n != k]
        assert (page[:, others] == a[:, others]).all()
    again = design("saltelli:8", "a=0:1", "b=10:20", "c=-1:0")
    assert (again[:8] == a).all()
    assert (design("saltelli:8", "a=0:1", "b=10:20", "c=-1:0", seed=1)[:8] != a).any()


def test_indices_of_ishigami_are_those_of_its_closed_form() -> None:
    values = design("saltelli:4096", *FULL)
    found = made("saltelli:4096 seed 0", {"y": ishigami(values)}, values).indices()
    assert found.first[0] == pytest.approx(FIRST, abs=0.01)
    assert found.total[0] == pytest.approx(TOTAL, abs=0.01)
    for exact, interval in ((FIRST, found.first_interval), (TOTAL, found.total_interval)):
        assert (interval[0, :, 0] < exact).all() and (exact < interval[0, :, 1]).all()
        assert (np.diff(interval[0]) < 0.12).all()
    assert found.mean[0] == pytest.approx(3.5, abs=0.01)


def test_indices_are_those_of_scipy_and_do_not_depend_on_scale_or_company() -> None:
    from scipy.stats import sobol_indices, uniform

    span = uniform(-np.pi, 2 * np.pi)
    theirs = sobol_indices(
        func=lambda x: ishigami(x.T), n=64, dists=[span] * 3, rng=np.random.default_rng(0)
    )
    values = design("saltelli:64", *FULL)
    y = ishigami(values)
    measures = {"y": y, "scaled": 1e-9 * y - 5, "c alone": values[:, 2], "still": np.ones(len(y))}
    found = made("saltelli:64 seed 0", measures, values).indices()
    for row in (0, 1):
        assert found.first[row] == pytest.approx(theirs.first_order, rel=1e-6)
        assert found.total[row] == pytest.approx(theirs.total_order, rel=1e-6)
    assert found.total[2] == pytest.approx([0, 0, 1], abs=0.1) and (found.total[2, :2] == 0).all()
    assert np.isnan(found.first[3]).all()
    assert "still: 1, does not vary" in str(found)
    alone = made("saltelli:64 seed 0", measures, values).indices(["c*"])
    assert alone.measures == ("c alone",) and (alone.first == found.first[2]).all()


def test_a_deck_gives_the_indices_of_the_function_that_it_computes() -> None:
    sweep = al.sweep(ISHIGAMI, FULL, sample="saltelli:32", measures=["max REQUEST/1.F2"])
    assert sweep["max REQUEST/1.F2"] == pytest.approx(ishigami(sweep.values), rel=1e-12)
    found = al.indices(sweep)
    values = sweep.values
    exact = made("saltelli:32 seed 0", {"y": ishigami(values)}, values).indices()
    assert found.first == pytest.approx(exact.first, rel=1e-9)
    assert found.total_interval == pytest.approx(exact.total_interval, rel=1e-9)


@pytest.mark.parametrize(
    ("mass", "stiffness"), [((1.0, 3.0), (80.0, 120.0)), ((9.0, 10.0), (10.0, 40.0))]
)
def test_mass_and_stiffness_behind_a_deflection(
    mass: tuple[float, float], stiffness: tuple[float, float]
) -> None:
    """y = -g m/k with m, k from a to b: E[1/k] = ln(b/a)/(b - a), E[1/k^2] = 1/(a b), so that with
    u = m, v = 1/k the first indices are V[u] E[v]^2 and E[u]^2 V[v], parts of V[u v].
    """
    (m, n), (a, b) = mass, stiffness
    u, uu = (m + n) / 2, (m * m + m * n + n * n) / 3
    v, vv = log(b / a) / (b - a), 1 / (a * b)
    variance = uu * vv - (u * v) ** 2
    first = [(uu - u * u) * v * v / variance, u * u * (vv - v * v) / variance]
    sweep = al.sweep(
        HANGING, {"POINT_MASS/2.MASS": f"{m}:{n}", "SPRINGDAMPER/1.K": f"{a}:{b}"},
        sample="saltelli:128", measures="final POINT_MASS/2.y",
    )  # fmt: skip
    assert sweep.measures[:, 0] == pytest.approx(-10 * sweep.values[:, 0] / sweep.values[:, 1])
    found = sweep.indices()
    assert found.first[0] == pytest.approx(first, abs=0.03)
    assert found.total[0] == pytest.approx([1 - first[1], 1 - first[0]], abs=0.03)
    assert found.mean[0] == pytest.approx(-10 * u * v, rel=2e-3)
    assert found.deviation[0] == pytest.approx(10 * variance**0.5, rel=2e-2)


# ---- the command ------------------------------------------------------------------------------


@pytest.fixture
def deck(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    Path("hanging.adm").write_text(HANGING)
    return "hanging.adm"


VARIED = ["POINT_MASS/2.MASS=1:3", "SPRINGDAMPER/1.K=80:120"]
MEASURE = ["--measure", "final POINT_MASS/2.y", "-o", "runs.nc", "--quiet"]


def test_the_command_prints_and_writes_a_table(deck: str, capsys) -> None:
    assert main(["sweep", deck, *VARIED, "--sample", "saltelli:16", *MEASURE]) == 0
    assert main(["indices", "runs.nc", "-o", "indices.csv"]) == 0
    told = capsys.readouterr().out
    assert told == str(al.indices("runs.nc"))
    assert "Sobol indices of 64 runs (16 points)" in told
    assert "final POINT_MASS/2.y: mean -0.2" in told
    with open("indices.csv", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["number"] for row in rows] == ["POINT_MASS/2.MASS", "SPRINGDAMPER/1.K"]
    assert float(rows[0]["total"]) == al.indices("runs.nc").total[0, 0]


@pytest.mark.parametrize(
    ("varied", "sample", "told"),
    [
        (["POINT_MASS/2.MASS=1:3"], "saltelli:16", "all comes from a single one"),
        (VARIED, "saltelli:15", "saltelli:8 or saltelli:16"),
        (VARIED, "saltelli:524288", "saltelli:524288 has 2097152 runs"),
        (VARIED, "saltelli", "say how many runs, as saltelli:256"),
    ],
)
def test_what_is_no_design_is_told(
    deck: str, capsys, varied: list[str], sample: str, told: str
) -> None:
    assert main(["sweep", deck, *varied, "--sample", sample, *MEASURE]) == 2
    assert told in capsys.readouterr().err


@pytest.mark.parametrize(
    ("varied", "sample", "told"),
    [
        (["POINT_MASS/2.MASS=-1:3", VARIED[1]], "saltelli:8", "of 32 runs failed (run "),
        (VARIED, "lhs:8", "these runs (lhs:8 seed 0) have no Sobol indices"),
        (["SPRINGDAMPER/1.K=80,90"], "grid", "these runs (grid) have no Sobol indices"),
    ],
)
def test_runs_without_indices_are_told(
    deck: str, capsys, varied: list[str], sample: str, told: str
) -> None:
    main(["sweep", deck, *varied, "--sample", sample, *MEASURE])
    capsys.readouterr()
    assert main(["indices", "runs.nc"]) == 2
    said = capsys.readouterr()
    assert told in said.err and len(said.err.splitlines()) == 1 and not said.out


def test_runs_that_are_ahead_damaged_or_no_number_are_told(deck: str, capsys) -> None:
    values = design("saltelli:8", *FULL)
    sweep = made("saltelli:8 seed 0", {"y": ishigami(values)}, values)
    sweep.outcomes[7] = ""
    with pytest.raises(UsageError, match="1 of 40 runs are ahead, from run 7 on"):
        sweep.indices()
    sweep.outcomes[7], sweep.measures[3, 0] = "DONE", np.nan
    with pytest.raises(UsageError, match="y of run 3 is not a number"):
        sweep.indices()
    for other in (values[::-1], values[:-1]):
        with pytest.raises(UsageError, match="not those of their sample"):
            made("saltelli:8 seed 0", {"y": ishigami(other)}, other).indices()
    sweep.measures[3, 0] = 0.0
    with pytest.raises(UsageError, match="no result is called 'z'"):
        sweep.indices("z")
    assert main(["indices", "none.nc"]) == 5
    sweep.save("made.nc")
    assert main(["indices", "made.nc", "-o", "made.txt"]) == 2
    assert main(["indices", "made.nc"]) == 0

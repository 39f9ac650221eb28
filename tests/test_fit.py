"""Fits: numbers, standard errors and correlations against linear regression in closed form, what a
measurement cannot tell, and what is refused.

A mass is thrown: y = y0 + v0 t + g t^2/2, linear in all three numbers. A mass on a spring and a
damper swings: its motion depends on k/m and c/m alone.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import FormatError, RunFailed, UsageError
from adamslite.fitting.parameters import Parameter

THROWN = """a mass that is thrown
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-8
PART/1, GROUND
POINT_MASS/2, MASS=2, CM=2, QG=0,5,0, VY=3
MARKER/2, POINT_MASS=2
INTEGRATOR/GSTIFF, SI2, ERROR=1E-10
SIMULATE/DYNAMIC, END=1, STEPS=40
END
"""
SWINGS = """a mass on a spring and a damper
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=1.2,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=200, C=2, LENGTH=1
INTEGRATOR/GSTIFF, SI2, ERROR=1E-9
SIMULATE/DYNAMIC, END=2, STEPS=100
END
"""
K, C, MASS = "SPRINGDAMPER/1.K", "SPRINGDAMPER/1.C", "POINT_MASS/2.MASS"
LINEAR = ("ACCGRAV.JGRAV", "POINT_MASS/2.VY", "POINT_MASS/2.QG[1]")
Y, VY, X = "POINT_MASS/2.y", "POINT_MASS/2.vy", "POINT_MASS/2.x"


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "thrown.adm").write_text(THROWN)
    (tmp_path / "swings.adm").write_text(SWINGS)
    return tmp_path


def table(time: np.ndarray, *lines: str, **columns: np.ndarray) -> Path:
    """Write a measurement; names of columns in the order of Y, VY, X by ``y``, ``vy``, ``x``."""
    named = {"y": Y, "vy": VY, "x": X}
    rows = np.column_stack([time, *columns.values()])
    header = ",".join(["time", *(named.get(each, each) for each in columns)])
    text = [*lines, header, *(",".join(map(repr, row)) for row in rows.tolist())]
    Path("measured.csv").write_text("\n".join(text) + "\n")
    return Path("measured.csv")


def swinging(time: np.ndarray, k: float = 200.0, c: float = 2.0, m: float = 2.0) -> np.ndarray:
    """x = 1 + 0.2 exp(-d t) (cos w t + d/w sin w t),  d = c/2m,  w^2 = k/m - d^2."""
    d = c / (2.0 * m)
    w = np.sqrt(k / m - d * d)
    return 1.0 + 0.2 * np.exp(-d * time) * (np.cos(w * time) + d / w * np.sin(w * time))


TIMES = np.linspace(0.0, 1.0, 41)
LONG = np.linspace(0.0, 2.0, 101)


def noisy(size: int, sigma: float, seed: int = 3) -> np.ndarray:
    return sigma * np.random.default_rng(seed).normal(size=size)


# ---- values and standard errors ----------------------------------------------------------------


@pytest.mark.parametrize(("sigma_y", "sigma_v"), [(0.01, 0.5), (0.2, 0.02)])
def test_a_linear_fit_is_the_regression_in_closed_form(sigma_y: float, sigma_v: float) -> None:
    y = 4.8 + 3.2 * TIMES - 9.81 / 2 * TIMES**2 + noisy(41, sigma_y)
    v = 3.2 - 9.81 * TIMES + noisy(41, sigma_v, 4)
    file = table(
        TIMES, f"# tolerance {Y}: abs {sigma_y}", f"# tolerance {VY}: abs {sigma_v}", y=y, vy=v
    )
    found = al.fit("thrown.adm", file, by=LINEAR)
    ones, zeros = np.ones(41), np.zeros(41)
    rows = np.vstack([
        np.column_stack([TIMES**2 / 2, TIMES, ones]) / sigma_y,
        np.column_stack([TIMES, ones, zeros]) / sigma_v,
    ])  # fmt: skip
    data = np.concatenate([y / sigma_y, v / sigma_v])
    values, squares, *_ = np.linalg.lstsq(rows, data, rcond=None)
    covariance = squares[0] / (82 - 3) * np.linalg.inv(rows.T @ rows)
    errors = np.sqrt(np.diag(covariance))
    assert found.values == pytest.approx(values, abs=1e-4 * errors.min())
    assert found.errors == pytest.approx(errors, rel=1e-4)
    assert found.covariance == pytest.approx(covariance, rel=1e-3, abs=1e-4 * errors.min() ** 2)
    assert found.correlation == pytest.approx(covariance / np.outer(errors, errors), abs=1e-4)
    assert found.is_told and not found.stopped


def test_bands_count_beside_each_other_and_not_by_their_size() -> None:
    y = 5 + 3 * TIMES - 4 * TIMES**2 + noisy(41, 0.1)
    fits = [
        al.fit("thrown.adm", table(TIMES, f"# tolerance: abs {band}", y=y), by=LINEAR)
        for band in (1e-3, 10.0)
    ]
    assert fits[0].values == pytest.approx(fits[1].values, rel=1e-6)
    assert fits[0].errors == pytest.approx(fits[1].errors, rel=1e-6)
    assert fits[0].residuals[0].share == pytest.approx(1e4 * fits[1].residuals[0].share, rel=1e-6)


def test_noise_that_no_band_names_is_found() -> None:
    """As with bands of the right size, where the two channels differ by a factor of a hundred."""
    y = 5 + 3 * TIMES - 4 * TIMES**2 + noisy(41, 0.002)
    v = 3 - 8 * TIMES + noisy(41, 0.5, 4)
    free = al.fit("thrown.adm", table(TIMES, y=y, vy=v), by=LINEAR)
    sizes = [each.rms for each in free.residuals]
    assert sizes == pytest.approx([0.002, 0.5], rel=0.3)
    bands = [f"# tolerance {name}: abs {size}" for name, size in zip((Y, VY), sizes, strict=True)]
    held = al.fit("thrown.adm", table(TIMES, *bands, y=y, vy=v), by=LINEAR)
    assert free.values == pytest.approx(held.values, abs=0.02 * held.errors.min())
    assert free.errors == pytest.approx(held.errors, rel=0.02)


@pytest.mark.parametrize("factors", [(3, 3), (3, 1 / 3), (1 / 3, 3), (1 / 3, 1 / 3)])
def test_a_start_that_is_off_by_three_comes_back(factors: tuple[float, float]) -> None:
    deck = al.read("swings.adm", values={K: 200 * factors[0], C: 2 * factors[1]})
    found = al.fit(deck, table(LONG, x=swinging(LONG)), by=[K, C])
    assert found.values == pytest.approx([200, 2], rel=1e-5)
    assert not found.stopped


def test_many_periods_are_taken_in_little_by_little() -> None:
    """Twenty periods: all at once the fit ends in the mean of the oscillation."""
    time = np.linspace(0.0, 12.0, 601)
    deck = al.read("swings.adm", values={K: 80, C: 0.2, "SIMULATE.END": 12, "SIMULATE.STEPS": 600})
    found = al.fit(deck, table(time, x=swinging(time, c=0.3)), by=[K, C])
    assert found.values == pytest.approx([200, 0.3], rel=1e-4)


def test_times_that_no_output_meets_are_interpolated() -> None:
    time = np.sort(np.random.default_rng(0).uniform(0.01, 1.99, 80))
    deck = al.read("swings.adm", values={K: 150, "SIMULATE.STEPS": 400})
    found = al.fit(deck, table(time, x=swinging(time)), by=[K, C])
    assert found.values == pytest.approx([200, 2], rel=1e-4)
    assert any("interpolated" in note for note in found.notes)


def test_output_steps_are_chosen_that_meet_the_measured_times() -> None:
    time = np.linspace(0.0, 2.0, 161)[5:120]
    found = al.fit("swings.adm", table(time, x=swinging(time)), by=[K, C])
    assert found.values == pytest.approx([200, 2], rel=1e-6)
    assert any("160 steps" in note for note in found.notes)


def test_the_share_of_a_band_does_not_depend_on_units() -> None:
    x = swinging(LONG) + noisy(101, 1e-3)
    found = al.fit("swings.adm", table(LONG, f"# tolerance {X}: abs 1e-3", x=x), by=[K, C])
    named = {"POINT_MASS/2.x [mm]": 1e3 * x}
    other = al.fit("swings.adm", table(LONG, f"# tolerance {X}: abs 1", **named), by=[K, C])
    assert found.residuals[0].share == pytest.approx(1.0, abs=0.2)
    assert other.residuals[0].share == pytest.approx(found.residuals[0].share, rel=1e-6)


@pytest.mark.parametrize("given", [(3.0, -np.inf, np.inf), (-3.0, -5.0, 1.0), (0.0, -2.0, 2.0)])
def test_slopes_of_coordinates_are_their_derivatives(given: tuple[float, float, float]) -> None:
    parameter = Parameter("a", *given)
    for x in (-0.2, 0.0, 0.3):
        value = parameter.value(x)
        slope = (parameter.value(x + 1e-6) - parameter.value(x - 1e-6)) / 2e-6
        assert parameter.slope(x) == pytest.approx(slope, rel=1e-8)
        assert parameter.coordinate(value) == pytest.approx(x, abs=1e-12)
    assert parameter.coordinate(parameter.low) < 0 < parameter.coordinate(parameter.high)


# ---- what the measurement cannot tell ----------------------------------------------------------


def test_a_free_oscillation_tells_ratios_alone() -> None:
    x = swinging(LONG) + noisy(101, 1e-3)
    deck = al.read("swings.adm", values={K: 150, C: 1})
    found = al.fit(deck, table(LONG, x=x), by=[K, C, MASS])
    (untold,) = found.certainty.untold
    assert untold.is_untold and set(untold.parts) == {K, C, MASS}
    assert [*untold.parts.values()] == pytest.approx([1, 1, 1], abs=0.02)
    assert np.isnan(found.errors).all()
    k, c, m = found.values
    two = al.fit(deck, table(LONG, x=x), by=[K, C])
    assert [k / m, c / m] == pytest.approx(two.values / 2, abs=0.1 * two.errors.min())
    assert "K, SPRINGDAMPER/1.C and POINT_MASS/2.MASS apart" in str(found)


def test_a_number_without_influence_is_named_and_the_others_are_told() -> None:
    x = swinging(LONG) + noisy(101, 1e-3)
    found = al.fit("swings.adm", table(LONG, x=x), by=[K, C])
    other = al.fit(
        "swings.adm", table(LONG, x=x), by=[K, C, "POINT_MASS/2.QG[1]"],
        bounds={"POINT_MASS/2.QG[1]": (-1, 1)},
    )  # fmt: skip
    (untold,) = other.certainty.untold
    assert [*untold.parts] == ["POINT_MASS/2.QG[1]"]
    assert other.errors[:2] == pytest.approx(found.errors, rel=1e-3)


def test_a_number_at_its_bound_has_no_standard_error() -> None:
    file = table(LONG, x=swinging(LONG) + noisy(101, 1e-3))
    deck = al.read("swings.adm", values={K: 150})
    found = al.fit(deck, file, by=[K, C], bounds=[f"{K}=:180"])
    assert found[K] == pytest.approx(180, rel=1e-5)
    assert np.isnan(found.errors[0]) and np.isfinite(found.errors[1])
    assert "at its bound" in str(found)
    assert any("alike" in note for note in found.notes)


def test_a_large_error_of_the_runs_is_told() -> None:
    file = table(LONG, x=swinging(LONG) + noisy(101, 1e-6))
    found = al.fit("swings.adm", file, by=[K, C], error=1e-4)
    assert any(note.startswith("ERROR=0.0001 moves") for note in found.notes)


# ---- runs that fail -----------------------------------------------------------------------------


def test_runs_that_fail_on_the_way_are_passed_by() -> None:
    """Bounds let the mass become negative, which no deck may have."""
    deck = al.read("swings.adm", values={MASS: 30})
    found = al.fit(deck, table(LONG, x=swinging(LONG)), by=[MASS, C], bounds={MASS: (-50, 50)})
    assert found[MASS] == pytest.approx(2, rel=1e-4)


def test_a_fit_that_cannot_start_says_why() -> None:
    deck = al.read("swings.adm", values={"SIMULATE.END": 1e-30})
    with pytest.raises((RunFailed, UsageError)):
        al.fit(deck, table(LONG, x=swinging(LONG)), by=[K])


# ---- the measured file ---------------------------------------------------------------------------


def test_units_are_those_of_the_header() -> None:
    named = {"POINT_MASS/2.x [mm]": 1e3 * swinging(LONG)}
    file = table(1e3 * LONG, **named)
    file.write_text(file.read_text().replace("time", "time [ms]"))
    found = al.fit("swings.adm", file, by=[K, C], bounds={K: (1, None)})
    assert found.values == pytest.approx([200, 2], rel=1e-5)
    assert any("mm to m" in note and "ms to s" in note for note in found.notes)


def test_values_that_are_missing_are_left_out_and_told() -> None:
    x = swinging(LONG)
    x[[3, 40, 41]] = np.nan
    whole = table(np.delete(LONG, range(60, 80)), x=np.delete(x, range(60, 80)))
    found = al.fit("swings.adm", whole, by=[K, C])
    assert found.values == pytest.approx([200, 2], rel=1e-5)
    assert any("3 of 81 values are no number" in note for note in found.notes)
    assert any("nothing was measured from t = 1.18 to 1.6" in note for note in found.notes)


BAD: list[tuple[dict[str, Any], str]] = [
    ({"by": ["SPRINGDAMPER/1.D"]}, "there is no number SPRINGDAMPER/1.D; SPRINGDAMPER/1 has K"),
    ({"by": []}, "nothing is fitted"),
    ({"by": [K, K]}, "twice"),
    ({"by": [K], "bounds": {K: (300, 400)}}, "starts at 200, outside of its bounds 300 to 400"),
    ({"by": [K], "bounds": [f"{K}=5"]}, "write NAME=LOW:HIGH"),
    ({"by": [K], "bounds": {K: (3, 2)}}, "nothing is between"),
    ({"by": [K], "bounds": {C: (0, 9)}}, "it is not fitted"),
    ({"by": ["POINT_MASS/2.QG[1]"]}, "starts at zero"),
    ({"by": [K], "of": ["PART/*"]}, "no result is called 'PART/\\*'"),
    ({"by": [K], "start": 5}, "nothing was measured from t = 5"),
    ({"by": [K], "end": 1}, "measured from t = 0 to 2, and the run goes from 0 to 1"),
    ({"by": [K, C], "until": 0.01}, "1 values do not determine 2 numbers"),
]


@pytest.mark.parametrize(("given", "message"), BAD)
def test_what_cannot_be_fitted_is_a_sentence(given: dict[str, Any], message: str) -> None:
    with pytest.raises(UsageError, match=message):
        al.fit("swings.adm", table(LONG, x=swinging(LONG)), **given)


FILES: list[tuple[str, str]] = [
    ("time,POINT_MASS/3.x\n0,1\n", "no result 'POINT_MASS/3.x'; did you mean POINT_MASS/2"),
    (f"time,{X} [N]\n0,1\n", f"'{X}' is in N, in the deck it is in m"),
    (f"time [m],{X}\n0,1\n", "'time' is in m, in the deck it is in s"),
    (f"time,{X}\n0,1\n0.5,1\n0.5,1\n", "t = 0.5 is there twice"),
    (f"time,{X}\n0,1\n0.5,1\n0.4,1\n", "t = 0.4 follows 0.5"),
    (f"time,{X}\n0,nan\n1,nan\n", "has no number at any time"),
    (f"time,{X}\nnan,1\n1,1\n", "row 1 has no time"),
    (f"# tolerance: rel 0.1\ntime,{X}\n0,1\n1,0\n", "is zero at t = 1; add 'abs A'"),
    (f"time,{X}\n", "nothing was measured"),
]


@pytest.mark.parametrize(("text", "message"), FILES)
def test_a_measurement_that_does_not_go_with_the_deck_is_a_sentence(
    text: str, message: str
) -> None:
    Path("measured.csv").write_text(text)
    with pytest.raises(UsageError, match=message):
        al.fit("swings.adm", "measured.csv", by=[K])


def test_an_empty_cell_is_named_with_its_line() -> None:
    Path("measured.csv").write_text(f"time,{X}\n0,1\n1,\n")
    with pytest.raises(FormatError, match="csv:3: a cell is empty; write nan"):
        al.fit("swings.adm", "measured.csv", by=[K])


# ---- the fitted deck ----------------------------------------------------------------------------


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "utf-16"])
@pytest.mark.parametrize("ending", ["\n", "\r\n"])
def test_of_the_fitted_deck_only_numbers_and_the_comment_differ(encoding: str, ending: str) -> None:
    table(LONG, x=swinging(LONG) + noisy(101, 1e-3))
    text = SWINGS.replace("K=200, C=2", "K=1.5E2 , C=+2").replace("damper\n", "d\u00e4mper \n")
    data = text.replace("\n", ending).encode(encoding)
    Path("guess.adm").write_bytes(data)
    assert main(["fit", "guess.adm", "measured.csv", "--by", K, C, "--quiet"]) == 0
    made = Path("guess.fitted.adm").read_bytes()
    fit = al.fit("guess.adm", "measured.csv", by=[K, C])
    lines = made.decode(encoding).split(ending)
    comments = [line for line in lines[1:4] if line.startswith("!")]
    assert len(comments) == 3 and "measured.csv" in comments[0] and "+-" in comments[1]
    rest = ending.join([lines[0], *lines[4:]])
    own = data.decode(encoding).replace("1.5E2", repr(fit[K])).replace("+2", repr(fit[C]))
    assert rest == own
    assert al.read("guess.fitted.adm").statements[5].k == fit[K]
    assert np.array_equal(al.simulate("guess.fitted.adm")[X], fit.results[X])


def test_the_command_says_what_it_found(capsys: Any) -> None:
    table(LONG, "# tolerance: abs 1e-3", x=swinging(LONG) + noisy(101, 1e-3))
    command = ["fit", "swings.adm", "measured.csv", "--quiet", "--by"]
    assert main([*command, K, C, MASS, "-o", "out.adm"]) == 1
    said = capsys.readouterr()
    assert "cannot tell" in said.out and "out.adm" in said.err
    assert "cannot tell" in Path("out.adm").read_text()
    assert main([*command, K, "--set", f"{K}=250", "--plot", "fit.svg"]) == 0
    assert "250" in capsys.readouterr().out and Path("fit.svg").stat().st_size > 1000
    for wrong in (["-o", "swings.adm"], ["-o", "measured.csv"], ["--plot", "fit.doc"]):
        assert main([*command, K, *wrong]) == 2
    assert Path("swings.adm").read_text() == SWINGS
    assert main([*command, "K"]) == 2
    assert not [*Path().glob("*.part")]

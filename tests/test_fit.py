"""Fits: numbers, standard errors and correlations against regression in closed form, and what a
measurement does not determine.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fit_scenes import (
    LINEAR,
    LONG,
    MASS,
    SWINGS,
    THROWN,
    TIMES,
    VY,
    C,
    K,
    X,
    Y,
    noisy,
    swinging,
    table,
)

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import RunFailed
from adamslite.fitting import derivatives
from adamslite.fitting.certainty import certainty
from adamslite.fitting.parameters import Parameter


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "thrown.adm").write_text(THROWN)
    (tmp_path / "swings.adm").write_text(SWINGS)
    return tmp_path


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
    assert found.is_identifiable and not found.stopped


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
    few = al.fit(al.read("swings.adm", values={"SIMULATE.STEPS": 20}),
                 table(time, x=swinging(time) + noisy(80, 1e-4)), by=[K, C])  # fmt: skip
    assert any("interpolation between output times is off" in note for note in few.notes)
    exact = al.fit(deck, table(time, x=swinging(time) + noisy(80, 1e-4)), by=[K, C])
    assert not any("is off by" in note for note in exact.notes)


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


# ---- what the measurement does not determine --------------------------------------------------


def test_a_free_oscillation_tells_ratios_alone() -> None:
    x = swinging(LONG) + noisy(101, 1e-3)
    deck = al.read("swings.adm", values={K: 150, C: 1})
    found = al.fit(deck, table(LONG, x=x), by=[K, C, MASS])
    (unidentifiable,) = found.certainty.unidentifiable
    assert unidentifiable.is_silent and set(unidentifiable.parts) == {K, C, MASS}
    assert [*unidentifiable.parts.values()] == pytest.approx([1, 1, 1], abs=0.02)
    assert np.isnan(found.errors).all()
    k, c, m = found.values
    two = al.fit(deck, table(LONG, x=x), by=[K, C])
    assert [k / m, c / m] == pytest.approx(two.values / 2, abs=0.1 * two.errors.min())
    assert "K, SPRINGDAMPER/1.C and POINT_MASS/2.MASS: changes" in str(found)


def test_a_number_without_influence_is_named_and_the_others_are_told() -> None:
    x = swinging(LONG) + noisy(101, 1e-3)
    found = al.fit("swings.adm", table(LONG, x=x), by=[K, C])
    other = al.fit(
        "swings.adm", table(LONG, x=x), by=[K, C, "POINT_MASS/2.QG[1]"],
        bounds={"POINT_MASS/2.QG[1]": (-1, 1)},
    )  # fmt: skip
    (unidentifiable,) = other.certainty.unidentifiable
    assert [*unidentifiable.parts] == ["POINT_MASS/2.QG[1]"]
    assert other.errors[:2] == pytest.approx(found.errors, rel=1e-3)


def test_numbers_that_are_told_only_poorly_apart_are_named() -> None:
    """S = [[1, 1], [0, e]] n times: of p1 + p2 the variance is s^2/n, of p2 alone s^2/(n e^2)."""
    n, e = 400, 0.02
    jacobian = np.tile([[1.0, 1.0], [0.0, e]], (n, 1))
    residuals = np.tile([1.0, -1.0, -1.0, 1.0], n // 2)
    nothing, free = np.zeros_like(jacobian), np.array([True, True])
    found = certainty(jacobian, nothing, residuals, ["a", "b"], free)
    s2 = 2 * n / (2 * n - 2)
    expected = s2 / n * np.array([[1 + e**-2, -(e**-2)], [-(e**-2), e**-2]])
    assert found.covariance == pytest.approx(expected, rel=1e-9)
    (weak,) = found.unidentifiable
    assert not weak.is_silent and weak.parts == pytest.approx({"a": 1.0, "b": -1.0}, rel=1e-3)
    assert weak.error == pytest.approx(np.sqrt(np.linalg.eigvalsh(expected)[-1]))
    assert "cannot separate a and b" in str(weak)
    # where the Jacobian is off by as much as the second number differs from the first
    off = np.tile([[0.0, 0.0], [0.0, e]], (n, 1))
    (lost,) = certainty(jacobian, off, residuals, ["a", "b"], free).unidentifiable
    assert lost.is_silent and lost.parts == pytest.approx({"a": 1.0, "b": -1.0}, rel=1e-3)
    held = certainty(jacobian, off, residuals, ["a", "b"], np.array([True, False]))
    assert held.covariance[0, 0] == pytest.approx(2 * n / (2 * n - 1) / n)
    assert not held.unidentifiable


@pytest.mark.filterwarnings("error")
def test_the_correlation_of_a_perfect_fit_is_that_of_its_derivatives() -> None:
    """Without any residual the standard errors are zero, and the correlation is not 0/0."""
    run = al.simulate("swings.adm")
    own = al.Results(time=run.time, names=(X,), values=run[X][:, None])
    perfect = al.fit("swings.adm", own, by=[K, C])
    assert perfect.errors.tolist() == [0.0, 0.0]
    rough = al.fit("swings.adm", table(LONG, x=swinging(LONG) + noisy(101, 1e-3)), by=[K, C])
    assert perfect.correlation == pytest.approx(rough.correlation, abs=0.01)


def test_a_number_at_its_bound_has_no_standard_error() -> None:
    file = table(LONG, x=swinging(LONG) + noisy(101, 1e-3))
    deck = al.read("swings.adm", values={K: 150})
    found = al.fit(deck, file, by=[K, C], bounds=[f"{K}=:180"])
    assert found[K] == pytest.approx(180, rel=1e-5)
    assert np.isnan(found.errors[0]) and np.isfinite(found.errors[1])
    assert "at its bound" in str(found)
    assert not any("times its band" in note for note in found.notes)
    narrow = table(LONG, "# tolerance: abs 1e-3", x=swinging(LONG) + noisy(101, 1e-3))
    banded = al.fit(deck, narrow, by=[K, C], bounds=[f"{K}=:180"])
    assert any("times its band: the deck does not do what" in note for note in banded.notes)
    bare = al.fit(deck, table(LONG, x=swinging(LONG)), by=[C])
    assert any("of its spread" in note for note in bare.notes)
    assert any("alike" in note for note in found.notes)


def test_a_large_error_of_the_runs_is_told() -> None:
    file = table(LONG, x=swinging(LONG) + noisy(101, 1e-6))
    found = al.fit("swings.adm", file, by=[K, C], error=1e-4)
    assert any(note.startswith("ERROR=0.0001 moves") for note in found.notes)


def test_sensitivities_that_differences_do_not_confirm_are_not_taken(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Those by c are made three per cent too large."""
    real = derivatives.sensitivities

    def wrong(deck: Any, by: Any, *given: Any, **options: Any) -> Any:
        found = real(deck, by, *given, **options)
        found.curves[[name == C for name in by]] *= 1.03
        return found

    file = table(LONG, x=swinging(LONG) + noisy(101, 1e-3))
    right = al.fit("swings.adm", file, by=[K, C])
    monkeypatch.setattr(derivatives, "sensitivities", wrong)
    found = al.fit("swings.adm", file, by=[K, C])
    assert f"by {C} (0.03 apart) differences" in found.derivatives
    assert found.values == pytest.approx(right.values, abs=1e-2 * right.errors.min())
    assert found.errors == pytest.approx(right.errors, rel=1e-3)


@pytest.mark.parametrize("method", ["GSTIFF", "RKF45", "HHT"])
def test_methods_without_sensitivities_take_differences(method: str) -> None:
    file = table(LONG, x=swinging(LONG) + noisy(101, 1e-3))
    found = al.fit("swings.adm", file, by=[K, C], integrator=method, error=1e-8)
    kind = "sensitivities" if method == "GSTIFF" else "central differences"
    assert found.derivatives.startswith(kind)
    assert np.abs(found.values - [200, 2]) == pytest.approx([0, 0], abs=4 * found.errors.max())


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1])
def test_a_hoist_comes_to_the_bound_of_cramer_and_rao(seed: int) -> None:
    """EA, damping and inertia of the drum from a noisy tension: the scatter of 40 fits."""
    guide = Path(al.__file__).parent.parent / "docs" / "how-to" / "hoist-brake.adm"
    names, truth, sigma = ["EA", "damping", "PART/10.IP[2]"], np.array([4e5, 4e3, 12.0]), 20.0
    deck, channel = al.read(guide), "REQUEST/1.F2"

    def curve(values: np.ndarray) -> np.ndarray:
        numbers = dict(zip(names, values.tolist(), strict=True))
        return al.simulate(deck.with_values(numbers), error=1e-10)[channel]

    clean, time = curve(truth), np.linspace(0.0, 2.0, 201)
    steps = 1e-3 * np.diag(truth)
    rows = [(curve(truth + h) - curve(truth - h)) / (2 * h.sum()) for h in steps]
    bound = sigma * np.sqrt(np.diag(np.linalg.inv(np.array(rows) @ np.array(rows).T)))
    rng = np.random.default_rng(seed)
    found = []
    for _ in range(40):
        values = (clean + sigma * rng.normal(size=201))[:, None]
        start = dict(zip(names, (truth * 3 ** rng.uniform(-1, 1, 3)).tolist(), strict=True))
        measured = al.Results(time=time, names=(channel,), values=values)
        fit = al.fit(deck.with_values(start), measured, by=names)
        found.append(fit.values)
        assert fit.errors == pytest.approx(bound, rel=0.2)
    rms = np.sqrt(np.mean((np.array(found) - truth) ** 2, axis=0))
    assert rms == pytest.approx(bound, rel=0.35)  # of 40, three times what chance makes of it


# ---- runs that fail -----------------------------------------------------------------------------


def test_runs_that_fail_on_the_way_are_passed_by() -> None:
    """Bounds let the mass become negative, which no deck may have."""
    deck = al.read("swings.adm", values={MASS: 30})
    found = al.fit(deck, table(LONG, x=swinging(LONG)), by=[MASS, C], bounds={MASS: (-50, 50)})
    assert found[MASS] == pytest.approx(2, rel=1e-4)
    assert not found.stopped


FALLS = """a mass that is pulled; the pull has no value below one
UNITS/SYSTEM=MKS
PART/1, GROUND
POINT_MASS/2, MASS=1, CM=2
MARKER/2, POINT_MASS=2
VARIABLE/a, FUNCTION=4
VARIABLE/b, FUNCTION=1
VFORCE/1, I=2, J_PART=1, FX=a+b-1+1E-9*SQRT(a-1)*TIME\\ FY=0\\ FZ=0
INTEGRATOR/GSTIFF, SI2, ERROR=1E-8
SIMULATE/DYNAMIC, END=1, STEPS=40
END
"""


def test_a_fit_that_comes_to_runs_that_fail_ends_by_name(capsys: Any) -> None:
    """The least squares are at a = 0.5, and runs end at a = 1."""
    Path("falls.adm").write_text(FALLS)
    table(TIMES, x=0.25 * TIMES**2)
    assert main(["fit", "falls.adm", "measured.csv", "--by", "a", "--quiet"]) == 4
    said = capsys.readouterr().out
    assert "where runs fail" in said
    assert 1.0 <= al.fit("falls.adm", "measured.csv", by=["a"])["a"] < 1.05


def test_a_fit_that_cannot_start_says_why() -> None:
    Path("falls.adm").write_text(FALLS)
    deck = al.read("falls.adm", values={"a": 0.5})
    with pytest.raises(RunFailed, match="the fit cannot start, its first run fails: "):
        al.fit(deck, table(TIMES, x=TIMES), by=["b"])

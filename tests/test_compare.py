"""How far results are from a reference."""

import numpy as np
import pytest
from fakes import fall

from adamslite import compare
from adamslite.results.comparison import Mismatch, Tolerance, fits
from adamslite.results.results import Results


def moved(by: float, start: int = 0, **facts) -> Results:
    """Return `fall` with x moved by `by` from row `start` on."""
    results = fall(**facts)
    results.values[start:, 0] += by
    return results


def test_equal_results_are_inside_every_tolerance() -> None:
    comparison = compare(fall(), fall(), Tolerance())
    assert comparison.inside
    assert [difference.worst for difference in comparison] == [0.0, 0.0]


def test_the_worst_difference_its_time_and_when_it_leaves() -> None:
    results = moved(2e-3, start=3)
    results.values[7, 0] += 1e-3
    x, vx = compare(results, fall(), Tolerance(abs=1e-3))
    assert not x.inside and vx.inside
    assert x.worst == pytest.approx(3e-3) and x.allowed == 1e-3
    assert x.time == pytest.approx(0.7) and x.leaves == pytest.approx(0.3)
    assert vx.leaves is None


@pytest.mark.parametrize(
    ("tolerance", "inside"),
    [
        (Tolerance(abs=1.1e-3), True),
        (Tolerance(peak=3e-3), True),  # x grows to 0.5
        (Tolerance(peak=1e-3), False),
        (Tolerance(rel=0.1), False),  # x starts at 0
        (Tolerance(), False),
    ],
)
def test_the_three_kinds_of_tolerance(tolerance: Tolerance, inside: bool) -> None:
    assert compare(moved(1e-3), fall(), tolerance).inside is inside


@pytest.mark.parametrize(
    ("value", "printed", "off"),
    [
        (1.7517049, 1.7517, 0.0),
        (1.751704, 1.7517, 0.0),
        (1.751707, 1.7517, 2e-6),  # the sixth digit of 1.75170 counts 1e-5
        (-17.51696, -17.5170, 0.0),
        (-17.51690, -17.5170, 5e-5),
        (1e-9, 0.0, 1e-9),  # nothing is hidden by a printed zero
        (0.0, 1e-3, 1e-3 - 5e-9),
        (np.nan, 1.0, np.nan),
    ],
)
def test_what_rounding_to_six_digits_hides_is_no_difference(
    value: float, printed: float, off: float
) -> None:
    tolerance = Tolerance(abs=1e-6, digits=6)
    found = tolerance.off(np.array([value]), np.array([printed]))
    assert found == pytest.approx(off, rel=1e-6, abs=1e-15, nan_ok=True)
    assert str(tolerance) == "abs 1e-06 digits 6"


def test_a_value_that_is_no_number_is_outside() -> None:
    for bad in (np.nan, np.inf):
        comparison = compare(moved(bad, start=4), fall(), Tolerance(abs=1e9))
        assert not comparison.inside
        assert comparison.worst.name == "PART/2.x" and comparison.worst.leaves == 0.4
    assert not compare(moved(np.nan), moved(np.nan), Tolerance(abs=1)).inside


def test_the_worst_of_all_is_the_one_that_uses_up_its_tolerance() -> None:
    results = moved(1e-3)
    results.values[:, 1] += 1e-2
    allowed = {"PART/2.x": Tolerance(abs=1e-3 / 0.9), "PART/2.vx": Tolerance(abs=1e-1)}
    assert compare(results, fall(), allowed.__getitem__).worst.name == "PART/2.x"


def test_reference_columns_may_be_a_subset_but_not_more() -> None:
    reference = Results(time=fall().time, names=("part/2.VX",), values=fall().values[:, 1:])
    assert compare(fall(), reference).inside
    with pytest.raises(Mismatch, match="no channel 'PART/2.x' and 1 more"):
        compare(Results(time=fall().time, names=(), values=np.empty((11, 0))), fall())


def test_times_must_match_unless_interpolation_is_stated() -> None:
    coarse, fine = fall(10), fall(40)
    assert compare(fine, coarse).inside
    with pytest.raises(Mismatch, match="t = 0.025 is not an output time"):
        compare(coarse, fine)
    assert compare(coarse, fine, interpolate="cubic").inside
    linear = compare(coarse, fine, interpolate="linear")
    assert linear.worst.worst == pytest.approx(0.1**2 / 8, rel=0.01)


def test_times_match_as_printed() -> None:
    third = fall(3)
    printed = Results(time=third.time.round(10), names=third.names, values=third.values)
    assert compare(third, printed).inside


def test_a_reference_that_goes_further_than_the_results_is_refused() -> None:
    short = Results(time=fall().time[:5], names=fall().names, values=fall().values[:5])
    for interpolate in (None, "cubic"):
        with pytest.raises(Mismatch, match="the results only from 0 to 0.4"):
            compare(short, fall(), interpolate=interpolate)
    with pytest.raises(Mismatch, match="no output time"):
        compare(Results(time=np.empty(0), names=fall().names, values=np.empty((0, 2))), fall())


def test_patterns() -> None:
    assert fits("PART/*.x", "part/12.X") and not fits("PART/*.x", "PART/12.vx")
    assert fits("*", "anything")


def test_angles_of_a_part_are_compared_without_whole_turns() -> None:
    """Half a turn is pi or -pi; of other columns a number of that size is a difference."""
    names = ("PART/2.psi", "PART/2.phi", "PART/2.x", "VARIABLE/psi")
    one = Results(time=np.zeros(1), names=names, values=np.array([[np.pi - 1e-9, -3.0, 0.0, 0.0]]))
    turned = one.values + 2 * np.pi * np.array([[-1.0, 2.0, 1.0, 1.0]])
    other = Results(time=np.zeros(1), names=names, values=turned)
    found = compare(one, other, Tolerance(abs=1e-6))
    assert [each.inside for each in found] == [True, True, False, False]


@pytest.mark.parametrize("how", ["linear", "cubic"])
def test_an_angle_that_passes_half_a_turn_is_interpolated(how: str) -> None:
    """psi = 3 + t goes on below pi as 3 + t - 2 pi."""
    time = np.linspace(0.0, 1.0, 21)
    psi = (3.0 + time + np.pi) % (2 * np.pi) - np.pi
    run = Results(time=time, names=("PART/2.psi",), values=psi[:, None])
    at = np.array([0.13, 0.1416, 0.16, 0.9])
    reference = Results(time=at, names=("PART/2.psi",), values=3.0 + at[:, None])
    assert compare(run, reference, Tolerance(abs=1e-9), interpolate=how).inside


@pytest.mark.parametrize("how", ["linear", "cubic"])
def test_nothing_is_interpolated_where_a_run_went_back(how: str) -> None:
    """RELOAD returns to an earlier time; two records at one time are those of two analyses."""
    time = np.array([0.0, 1.0, 2.0, 1.0, 2.0, 3.0])
    back = Results(time=time, names=("x",), values=time[:, None] ** 2)
    once = Results(time=np.array([0.0, 1.5]), names=("x",), values=np.array([[0.0], [2.25]]))
    with pytest.raises(Mismatch, match="go back from t = 2 to 1"):
        compare(back, once, interpolate=how)
    twice = Results(time=np.sort(time), names=("x",), values=np.sort(time)[:, None] ** 2)
    assert compare(twice, once, Tolerance(abs=0.3), interpolate=how).inside


def table(times: list[float], values: list[float]) -> Results:
    return Results(time=np.array(times), names=("x",), values=np.array(values)[:, None])


@pytest.mark.parametrize("how", [None, "linear", "cubic"])
def test_rows_of_a_run_that_went_back_belong_to_those_in_their_places(how: str | None) -> None:
    """Each of the two rows at t = 1 meets its own."""
    times = [0.0, 1.0, 2.0, 1.0, 2.0]
    run = table(times, [0.0, 1.0, 2.0, 7.0, 8.0])
    assert compare(run, run, interpolate=how).inside
    other = table(times, [0.0, 1.0, 2.0, 7.5, 8.0])
    worst = compare(run, other, interpolate=how).worst
    assert worst is not None and (worst.worst, worst.time) == (0.5, 1.0)
    with pytest.raises(Mismatch, match="go back from t = 2 to 1.*the same output times"):
        compare(run, table([0.0, 1.0], [0.0, 1.0]), interpolate=how)


@pytest.mark.parametrize("how", [None, "linear", "cubic"])
@pytest.mark.parametrize("time", [np.nan, np.inf])
def test_a_row_without_a_time_is_compared_with_none(how: str | None, time: float) -> None:
    whole, lacking = table([0.0, 1.0, 2.0], [1.0, 2.0, 3.0]), table([0.0, 1.0, time], [1.0, 2.0, 3])
    with pytest.raises(Mismatch, match=f"row 3 of the reference has the time {time:g}"):
        compare(whole, lacking, interpolate=how)
    with pytest.raises(Mismatch, match=f"row 3 of the results has the time {time:g}"):
        compare(lacking, whole, interpolate=how)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_spline_through_what_is_not_a_number_is_inside_nothing(value: float) -> None:
    run = table([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, value, 3.0])
    found = compare(run, table([0.5], [0.5]), Tolerance(abs=10.0), interpolate="cubic")
    assert not found.inside


def test_a_spline_whose_slopes_are_larger_than_any_number_is_inside_nothing() -> None:
    run = table([0.0, 1e-300, 2.0, 3.0], [0.0, 1e300, 2.0, 3.0])
    found = compare(run, table([0.5], [0.5]), Tolerance(abs=10.0), interpolate="cubic")
    assert not found.inside


def test_one_row_is_a_constant() -> None:
    run = table([1.0, 1.0], [2.0, 3.0])
    assert compare(run, table([1.0], [3.0]), interpolate="cubic").inside
    assert not compare(run, table([1.0], [2.0]), interpolate="cubic").inside

"""Plateau, arrival and moving average against signals whose answers are known."""

import numpy as np
import pytest

from adamslite.verification.measures import arrival, moving_average, plateau


def front(times: np.ndarray, at: float = 0.5, wide: float = 0.02) -> np.ndarray:
    """Rise from 1 to 3, symmetric about `at`."""
    return 2 + np.tanh((times - at) / wide)


def samples(n: int) -> np.ndarray:
    """Times from 0 to 1, uneven as an integrator writes them."""
    even = np.linspace(0, 1, n)
    return even + 0.3 / n * np.sin(9 * even) * even * (1 - even)


def test_the_mean_of_a_straight_line_needs_no_sample_at_the_ends_of_the_window() -> None:
    times = samples(20)
    assert plateau(times, 3 * times, 0.123, 0.777) == pytest.approx(3 * (0.123 + 0.777) / 2)


def test_the_mean_of_a_decayed_ringing_is_the_plateau() -> None:
    """1 + exp(-20 t) cos(200 t): the mean over [0.2, 1] is 1 + Re of the integral / 0.8."""
    times = np.linspace(0, 1, 4001)
    rate = -20 + 200j
    integral = ((np.exp(rate) - np.exp(0.2 * rate)) / rate).real
    ringing = 1 + (np.exp(rate * times)).real
    assert plateau(times, ringing, 0.2, 1.0) == pytest.approx(1 + integral / 0.8, abs=1e-6)


def test_an_empty_window_gives_the_value_there() -> None:
    assert plateau(np.array([0.0, 1.0]), np.array([0.0, 2.0]), 0.25, 0.25) == 0.5


@pytest.mark.parametrize("at", [0.3, 0.5012, 0.7])
def test_half_rise_is_the_middle_of_a_symmetric_front(at: float) -> None:
    """Straight lines through samples 2e-3 apart err by less than the square of the spacing."""
    times = samples(500)
    assert arrival(times, front(times, at), 2.0, 0.1, 0.9) == pytest.approx(at, abs=2e-5)


def test_arrival_is_the_first_passage_from_above_too() -> None:
    times = np.linspace(0, 1, 1001)
    wave = np.cos(2 * np.pi * 3 * times)
    assert arrival(times, wave, 0.0, 0.0, 1.0) == pytest.approx(1 / 12, abs=1e-6)
    assert arrival(times, wave, 0.0, 0.1, 1.0) == pytest.approx(3 / 12, abs=1e-6)


def test_arrival_of_what_never_comes_and_of_what_is_there() -> None:
    times = np.linspace(0, 1, 11)
    assert arrival(times, times, 2.0, 0.0, 1.0) is None
    assert arrival(times, times, 0.9, 0.0, 0.85) is None
    assert arrival(times, times, 0.25, 0.25, 1.0) == 0.25


def test_moving_average_removes_a_ripple_of_its_width() -> None:
    """Away from the ends; h^2/12 w^2 = 3e-5 of the ripple is the trapezoidal rule's error."""
    times = np.linspace(0, 1, 2001)
    rippled = 5 + 3 * times + np.sin(2 * np.pi * times / 0.05)
    inner = (times > 0.03) & (times < 0.97)
    smooth = moving_average(times, rippled, 0.05)
    assert np.abs(smooth - 5 - 3 * times)[inner].max() < 1e-4


def test_moving_average_shifts_no_phase() -> None:
    """sin stays in phase: amplitude sin(w a/2)/(w a/2)."""
    times = np.linspace(0, 1, 4001)
    omega, width = 40.0, 0.05
    smooth = moving_average(times, np.sin(omega * times), width)
    share = np.sin(omega * width / 2) / (omega * width / 2)
    inner = (times > width) & (times < 1 - width)
    assert np.abs(smooth - share * np.sin(omega * times))[inner].max() < 1e-5
    stepped = moving_average(times, front(times), width)
    assert arrival(times, stepped, 2.0, 0.1, 0.9) == pytest.approx(0.5, abs=1e-6)


def test_moving_average_keeps_a_straight_line_on_uneven_samples_and_to_the_ends() -> None:
    times = samples(50)
    assert moving_average(times, 4 * times - 1, 0.3) == pytest.approx(4 * times - 1, abs=1e-12)


def test_moving_average_of_no_width_or_one_sample_changes_nothing() -> None:
    times = samples(50)
    assert (moving_average(times, front(times), 0.0) == front(times)).all()
    assert moving_average(np.array([1.0]), np.array([2.0]), 0.5) == [2.0]


def test_moving_average_of_an_overshooting_front_has_less_overshoot() -> None:
    """A ringing behind the front averages out: the peak comes near the plateau."""
    times = np.linspace(0, 1, 4001)
    late = np.maximum(times - 0.5, 0)
    ringing = np.where(times > 0.5, 1 - np.exp(-10 * late) * np.cos(200 * late), 0.0)
    assert ringing.max() > 1.8
    assert abs(moving_average(times, ringing, 2 * np.pi / 200).max() - 1) < 0.05

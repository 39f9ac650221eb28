"""Levels 2 and 3 of `adamslite cable`: what moves the ends of an elastic cable."""

import numpy as np
import pytest
from descriptions import G, solve


@pytest.mark.parametrize(("form", "error"), [("paper", 0.5), ("ale", 0.0)])
def test_a_weight_is_lowered(form: str, error: float) -> None:
    """Steadily at U the winch carries (M + rho l) g; the paper's element errs by -rho U^2/2."""
    speed, rho, mass = 10.0, 4.0, 1000.0
    law = "10*(TIME-0.6*(3-(3+2*TIME/0.6+TIME**2/0.72)*EXP(-TIME/0.6)))"
    results = solve(
        f"""
        end = 12
        steps = 240
        [cable]
        EA = 2e7
        rho = {rho}
        damping = 0.2
        [[route]]
        kind = "winch"
        at = [-0.5, 0, 0]
        radius = 0.5
        inertia = 25
        turn = -1
        payout = "{law}"
        [[route]]
        kind = "mass"
        at = [0, -20, 0]
        mass = {mass}
        [model]
        form = "{form}"
        level = 3
        elements = 20
        """,
        warns=form == "paper",
    )
    late = results.time > 10
    length = 20 + results["REQUEST/10.F2"][late]
    exact = (mass + rho * length) * G
    found = results["REQUEST/1.F2"][late]
    # Nothing accelerates any more: the winch holds what the cable pulls with.
    np.testing.assert_allclose(results["REQUEST/10.F6"][late], found, rtol=1e-4)
    assert np.mean(found - exact) == pytest.approx(-error * rho * speed**2, abs=0.02 * rho * 100)


def test_a_mass_that_runs_into_a_long_run() -> None:
    """m v' = -rho c v: v = v0 exp(-t sqrt(EA rho)/m); ERROR = 1e-8 m a step, some hundred steps:
    1e-5 m."""
    results = solve(
        """
        gravity = [0, 0, 0]
        end = 0.5
        steps = 50
        error = 1e-8
        [cable]
        EA = 1e6
        rho = 0.01
        [[route]]
        kind = "run"
        at = [-3, 0, 0]
        [[route]]
        kind = "mass"
        at = [0, 0, 0]
        mass = 20
        velocity = [4, 0, 0]
        """
    )
    rate = np.sqrt(1e6 * 0.01) / 20
    np.testing.assert_allclose(
        results["POINT_MASS/20.x"], 4 / rate * (1 - np.exp(-rate * results.time)), atol=1e-5
    )


def test_an_end_that_a_law_moves() -> None:
    """A mass on one section, its other end at a t^2/2: x = a t^2/2 - a/w^2 (1 - cos w t)."""
    results = solve(
        """
        gravity = [0, 0, 0]
        end = 1
        steps = 100
        error = 1e-8
        [cable]
        EA = 2e4
        rho = 1e-4
        [[route]]
        kind = "fixed"
        at = [2, 0, 0]
        motion = ["1.5*TIME**2", 0, 0]
        [[route]]
        kind = "mass"
        at = [0, 0, 0]
        mass = 10
        [model]
        level = 2
        elements = 1
        """
    )
    w2, t = 2e4 / 2 / (10 + 1e-4), results.time
    expected = 1.5 * t**2 - 3 / w2 * (1 - np.cos(np.sqrt(w2) * t))
    np.testing.assert_allclose(results["POINT_MASS/20.x"], expected, atol=1e-5)


@pytest.mark.parametrize("elements", [1, 3])
@pytest.mark.parametrize("support", ["fixed", "winch"])
def test_both_ends_of_a_hanging_cable_have_its_tension(elements: int, support: str) -> None:
    """M g at the weight and (M + rho l) g above, with any number of sections."""
    drum = 'radius = 0.5\ninertia = 25\nturn = -1\npayout = "0*TIME"'
    place = "at = [-0.5, 0, 0]" if support == "winch" else "at = [0, 0, 0]"
    results = solve(
        f"""
        end = 0.1
        steps = 4
        [cable]
        EA = 1e7
        rho = 2
        [[route]]
        kind = "{support}"
        {place}
        {drum if support == "winch" else ""}
        [[route]]
        kind = "mass"
        at = [0, -20, 0]
        mass = 10
        [model]
        level = {2 if support == "fixed" else 3}
        elements = {elements}
        """
    )
    np.testing.assert_allclose(results["REQUEST/1.F3"], 10 * G, rtol=1e-4)
    np.testing.assert_allclose(results["REQUEST/1.F2"], 50 * G, rtol=1e-4)


@pytest.mark.parametrize("speed", [-40.0, 25.0])
def test_a_wheel_takes_stretched_cable_from_a_long_run(speed: float) -> None:
    """A weightless wheel that a winch pulls at U of unstretched cable: U (1 + e) = c (e - e0), so
    that T = (T0 + rho c U)/(1 - U/c); with 1 + e0 in its place it is U^2 rho off, 1.3 %."""
    stiffness, rho, tension = 1e6, 1.0, 6e4
    results = solve(
        f"""
        end = 0.1
        steps = 50
        gravity = [0, 0, 0]
        [cable]
        EA = {stiffness}
        rho = {rho}
        pretension = {tension}
        damping_time = 5e-3
        [[route]]
        kind = "winch"
        at = [0, 0, 0]
        radius = 0.5
        turn = 1
        payout = "{speed}*TIME"
        [[route]]
        kind = "pulley"
        at = [4, 0, 0]
        radius = 0.5
        inertia = 1e-4
        turn = 1
        [[route]]
        kind = "run"
        at = [4.5, -3, 0]
        [model]
        level = 3
        form = "ale"
        elements = 2
        """
    )
    c, taken = np.sqrt(stiffness / rho), -speed
    wanted = (tension + rho * c * taken) / (1 - taken / c)
    assert results["REQUEST/2.F2"][-1] == pytest.approx(wanted, rel=1e-4)

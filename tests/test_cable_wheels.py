"""Cable over wheels as `adamslite cable` writes them: impact, slip, axles of any direction."""

from pathlib import Path

import numpy as np
import pytest
from descriptions import BLOCK, solve
from formulas import Cable, Impact
from tiers import slow

import adamslite
from adamslite.cables.deck.scene import deck


@pytest.mark.parametrize("form", ["brute", "ale"])
def test_a_kink_meets_a_free_running_sheave(form: str) -> None:
    """T1 and T2 of the impact to the accuracy that was asked for, 1 %, with elements of its own.

    The sheave is light: a wheel of 0.6 kg (J/R^2) as a section, or a rim without friction.
    """
    impact = Impact(Cable(6.0e7, 5.536, 13345.0), 65.0)
    results = solve(
        f"""
        gravity = [0, 0, 0]
        end = 0.089
        steps = 890
        [cable]
        EA = 6e7
        rho = 5.536
        pretension = 13345
        [[route]]
        kind = "mass"
        at = [-15, 0, 0]
        mass = 1e9
        velocity = [0, 65, 0]
        [[route]]
        kind = "pulley"
        at = [0, 0.5, 0]
        radius = 0.5
        inertia = 0.17
        turn = 1
        {"mu = 0" if form == "brute" else ""}
        [[route]]
        kind = "run"
        at = [4, 0, 0]
        [model]
        level = 3
        form = "{form}"
        """
    )
    t, tension = results.time, results["REQUEST/1.F3" if form == "brute" else "REQUEST/1.F2"]
    come, echo = 15 / impact.kink, 30 / impact.cable.speed
    before = (t > 0.3 * come) & (t < 0.9 * come)
    behind = (t > come + 0.35 * echo) & (t < come + 0.9 * echo)
    assert np.mean(tension[before]) == pytest.approx(impact.tension, rel=0.01)
    assert np.mean(tension[behind]) == pytest.approx(impact.free_running, rel=0.01)


@pytest.mark.parametrize("level", [2, slow(3)])
def test_a_cable_slips_on_a_locked_pulley(level: int) -> None:
    """T1/T2 = exp(mu pi); the tensions at the wheel differ from it by the friction's full value,
    reached to 1e-12 once the sliding speed is above 1e-3 m/s, and by the mass of the half sections
    and of the wrap, which the deck has on the wheel: (T1 - T2 - F) = m a.

    m = rho (R pi + 3 m/7) = 0.021 kg, a = 1.84 m/s^2: 0.04 N of T2 = 90 N, 5e-4 of the ratio.
    """
    results = solve(
        f"""
        end = 0.6
        steps = 60
        [cable]
        EA = 1e6
        rho = 0.02
        damping = 0.3
        [[route]]
        kind = "mass"
        at = [-0.2, -3, 0]
        mass = 30
        [[route]]
        kind = "pulley"
        at = [0, 0, 0]
        radius = 0.2
        inertia = 1e5
        mu = 0.3
        [[route]]
        kind = "mass"
        at = [0.2, -3, 0]
        mass = 8
        [model]
        level = {level}
        elements = 7
        form = "{"ale" if level == 3 else "auto"}"
        """,
        warns=level == 2,
    )
    late = results.time > 0.3
    ratio = np.mean(results["REQUEST/1.F2"][late]) / np.mean(results["REQUEST/2.F2"][late])
    assert ratio == pytest.approx(np.exp(0.3 * np.pi), rel=1e-3)
    assert np.all(results["REQUEST/20.F3"][late] < 0)


@pytest.mark.parametrize("level", [1, 2, slow(3)])
def test_an_axle_may_lie_anywhere(level: int) -> None:
    """Atwood's machine with the axle along x: the same numbers as along z.

    Both decks are one problem in other axes: they differ by rounding and by what the error control
    makes of it, some ERROR = 1e-8 m, and those times EA/H = 2e5 N/m in a tension.
    """

    def run(axis: str, left: str, right: str) -> adamslite.Results:
        return solve(
            f"""
            end = 0.3
            steps = 10
            error = 1e-8
            [cable]
            EA = 1e5
            rho = 0.1
            damping = 0.2
            [[route]]
            kind = "mass"
            at = {left}
            mass = 5
            [[route]]
            kind = "pulley"
            at = [0, 0, 0]
            radius = 0.2
            axis = {axis}
            inertia = 0.04
            friction = 0.1
            [[route]]
            kind = "mass"
            at = {right}
            mass = 3
            [model]
            level = {level}
            form = "{"ale" if level == 3 else "auto"}"
            elements = 4
            """
        )

    flat = run("[0, 0, 1]", "[-0.2, -2, 0]", "[0.2, -2, 0]")
    side = run("[1, 0, 0]", "[0, -2, 0.2]", "[0, -2, -0.2]")
    np.testing.assert_allclose(side["POINT_MASS/30.y"], flat["POINT_MASS/30.y"], atol=1e-7)
    np.testing.assert_allclose(side["REQUEST/20.F3"], flat["REQUEST/20.F3"], atol=1e-5)
    if level > 1:
        np.testing.assert_allclose(side["REQUEST/1.F2"], flat["REQUEST/1.F2"], atol=0.02)


def test_a_block_starts_at_rest_under_the_weight_of_its_wheel_too() -> None:
    """50 kg and a wheel of J/R^2 = 2 kg on two legs: T = 52 g/2, and it stays where it is."""
    results = solve(
        f"""
        end = 0.1
        steps = 20
        [cable]
        EA = 2e6
        rho = 0.05
{BLOCK}
        [[route]]
        kind = "fixed"
        at = [0.1, 0, 0]
        [model]
        level = 3
        form = "ale"
        elements = 4
        """
    )
    assert results["REQUEST/1.F2"] == pytest.approx(52 * 9.81 / 2, rel=4e-3)
    assert results["PART/20.y"] == pytest.approx(-2.0, abs=2e-6)


@pytest.mark.parametrize("name", ["hoists/late", "described/drum", "described/ring"])
def test_a_deck_has_no_constants_that_nothing_uses(name: str) -> None:
    """One section has its length in its law, a rope that hangs nowhere no friction at low speed."""
    text, _ = deck(Path(f"decks/cables/{name}.toml").read_text(encoding="utf-8"))
    assert "unused" not in {each.code for each in adamslite.check(text)}

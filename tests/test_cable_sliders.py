"""`adamslite cable`: weights that slide along their cable without a wheel."""

import numpy as np
import pytest
from descriptions import WIRE

import adamslite
from adamslite.cables.deck.scene import deck

G = 9.81


def solve(spec: str) -> tuple[str, adamslite.Results]:
    """The deck, and its run, reached to the end."""
    text, warnings = deck(spec)
    assert not warnings
    results = adamslite.simulate(adamslite.read(text))
    assert results.outcome.name == "DONE"
    return text, results


KINDS = {"mass": '"mass"', "body": '"body"\ninertia = 0.3'}


@pytest.mark.parametrize("kind", KINDS)
def test_a_weight_slides_down_a_straight_wire(kind: str) -> None:
    """s = v t - g t^2 3/10, side force m g 4/5: a point on an INLINE, or a part held upright.

    A parabola is exact for the formula: what is left is rounding of the constraint, ERROR = 1e-8.
    """
    text, results = solve(WIRE.format(kind=KINDS[kind], haul=""))
    body = {"mass": "POINT_MASS/20", "body": "PART/20"}[kind]
    assert ("ORIENTATION" in text) == (kind == "body")
    t = results.time
    way = 2 + t - 0.3 * G * t**2
    np.testing.assert_allclose(results[f"{body}.x"], 0.8 * way, atol=1e-6)
    np.testing.assert_allclose(results[f"{body}.y"], 0.6 * way, atol=1e-6)
    side = np.hypot(results["JPRIM/1.fx"], results["JPRIM/1.fy"])
    np.testing.assert_allclose(side, 20 * G * 0.8, rtol=1e-6)


def test_a_weight_is_hauled_along_its_wire() -> None:
    """s = t + t^2/2 up a slope of 3 : 4 takes m (s" + g 3/5)."""
    _, results = solve(WIRE.format(kind=KINDS["mass"], haul='haul = "TIME+0.5*TIME**2"'))
    t = results.time
    np.testing.assert_allclose(results["POINT_MASS/20.x"], 0.8 * (2 + t + t**2 / 2), atol=1e-6)
    np.testing.assert_allclose(results["GCON/20.f"], 20 * (1 + 0.6 * G), rtol=1e-6)


ROPE = """
gravity = [0, {gravity}, 0]
end = {end}
steps = 50
error = 1e-8
[cable]
EA = 1e5
rho = {density}
pretension = 500
[[route]]
kind = "fixed"
at = [0, 0, 0]
[[route]]
kind = "mass"
at = [{at}]
mass = 3
velocity = [{speed}, 0, 0]
slides = true
[[route]]
kind = "fixed"
at = [10, 0, 0]
[model]
level = {level}
elements = 6
"""


def test_a_weight_that_nothing_pulls_slides_on_and_leaves_the_rope_at_rest() -> None:
    """x = x0 + v t, T = T0: nodes move with the weight, cable runs through them and stands still.

    ERROR = 1e-8 m a step over 0.2 m, times EA/H in a tension; H is 0.5 m at least.
    """
    spec = ROPE.format(gravity=0, end=1, density=0.4, at="3, 0, 0", speed=4, level=3)
    text, results = solve(spec)
    assert "form ale" in text
    t = results.time
    np.testing.assert_allclose(results["POINT_MASS/20.x"], 3 + 4 * t, atol=1e-5)
    np.testing.assert_allclose(-results["REQUEST/20.F2"] * (1 + 500 / 1e5), 4 * t, atol=1e-5)
    for span in (1, 2):
        np.testing.assert_allclose(results[f"REQUEST/{span}.F2"], 500, atol=1e5 / 0.5 * 1e-5)


@pytest.mark.slow
def test_a_light_rope_is_an_ellipse() -> None:
    """Level 3 against level 1, DM + DM = l, for a rope of rho l/M = 3 %.

    Half of its weight draws the weight on and does not go along: rho l/(2 M) = 1.7 % of the way, 45
    mm.  T = 30 N more stretch it by 3 mm, l/(4 y) times as much in height: 1 cm at 0.74 m.
    """
    rigid, elastic = (
        solve(
            ROPE.format(gravity=-G, end=2.5, density=0.01, at="2, -0.6, 0", speed=0, level=level)
            .replace("pretension = 500", "damping = 0.2")
            .replace("1e-8", "1e-6")
        )[1]
        for level in (1, 3)
    )
    assert np.ptp(rigid["POINT_MASS/20.x"]) > 2.5
    np.testing.assert_allclose(elastic["POINT_MASS/20.x"], rigid["POINT_MASS/20.x"], atol=4.8e-2)
    np.testing.assert_allclose(elastic["POINT_MASS/20.y"], rigid["POINT_MASS/20.y"], atol=1e-2)


def test_a_span_starts_hanging_in_its_sag() -> None:
    """rho g l^2/(8 T) = 31 mm, and it stays there: T is (rho g l/2 T)^2/2 = 8e-5 higher at
    the ends than in the middle, a third of which lengthens it by 5e-7 m and the sag by
    3 l/(16 f) times as much, 3e-5 m; it swings by twice that."""
    _, results = solve(
        f"""
        end = 0.5
        steps = 50
        gravity = [0, {-G}, 0]
        [cable]
        EA = 1e6
        rho = 0.5
        pretension = 2000
        [[route]]
        kind = "fixed"
        at = [0, 0, 0]
        [[route]]
        kind = "fixed"
        at = [10, 0, 0]
        [model]
        level = 2
        elements = 10
        """
    )
    height = results["POINT_MASS/1005.y"]
    assert height[0] == pytest.approx(-0.5 * G * 10**2 / (8 * 2000), rel=1e-2)
    assert np.ptp(height) < 6e-5

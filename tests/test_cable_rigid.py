"""Level 1 of `adamslite cable`: a rigid cable without mass, against equations of motion."""

import numpy as np
from descriptions import ATWOOD, BLOCK, G, solve


def test_two_weights_over_two_pulleys() -> None:
    """a = (m1 - m2) g/(m1 + m2 + 2 J/R^2); T1 = m1 (g - a), T2 = T1 - J a/R^2, T3 = m2 (g + a)."""
    results = solve("steps = 50\nerror = 1e-8\n" + ATWOOD)
    a = (5 - 3) * G / (5 + 3 + 2 * 0.04 / 0.2**2)
    np.testing.assert_allclose(results["POINT_MASS/40.ay"], a, rtol=1e-8)
    np.testing.assert_allclose(results["POINT_MASS/40.y"], -5 + a * results.time**2 / 2, atol=1e-6)
    pulls = [5 * (G - a), 5 * (G - a) - a, 3 * (G + a)]
    for p, pull in enumerate(pulls, 1):
        np.testing.assert_allclose(np.abs(results[f"GCON/{p}.f"]), pull, rtol=1e-7)


def test_two_winches_place_a_weight() -> None:
    """A weight on two ropes is where the circles of their lengths meet."""
    results = solve(
        """
        end = 2
        steps = 40
        error = 1e-7
        [cable]
        EA = 1e8
        rho = 0.1
        [[route]]
        kind = "winch"
        at = [-4, 0.2, 0]
        radius = 0.2
        inertia = 1
        turn = -1
        payout = "STEP5(TIME,0,0,2,1.5)"
        [[route]]
        kind = "mass"
        at = [0, -3, 0]
        mass = 400
        [[route]]
        kind = "winch"
        at = [4, 0.2, 0]
        radius = 0.2
        inertia = 1
        turn = -1
        payout = "STEP5(TIME,0,0,2,-1)"
        [model]
        level = 1
        """
    )
    x, y = results["POINT_MASS/20.x"], results["POINT_MASS/20.y"]
    # The cable leaves from fixed points; those at the start.
    span = np.hypot(4, 3.2)
    lean = np.arctan2(3.2, 4) + np.arcsin(0.2 / span)
    foot = np.array([-4 + 0.2 * np.sin(lean), 0.2 + 0.2 * np.cos(lean)])
    u = results.time / 2
    rise = u**3 * (10 - 15 * u + 6 * u * u)
    straight = np.sqrt(span**2 - 0.2**2)
    np.testing.assert_allclose(np.hypot(x - foot[0], y - foot[1]), straight + 1.5 * rise, atol=1e-6)
    np.testing.assert_allclose(np.hypot(x + foot[0], y - foot[1]), straight - rise, atol=1e-6)


def test_wheels_of_moved_blocks_and_weights() -> None:
    """A block of 50 kg on a slide, 30 kg on the free end: 2 a = 2 (M - 2 m) g/(M + J1 + 4 J2 + 4 m)
    with M = 50 + the wheel's 2 kg and J1 = 2 kg, J2 = 0.5 kg (J/R^2).  Level 1 is exact: what is
    left is ERROR = 1e-8 a step."""
    results = solve(
        f"""
        end = 1
        steps = 50
        error = 1e-8
        [cable]
        EA = 1e6
        rho = 0.05
{BLOCK}
        [[route]]
        kind = "pulley"
        at = [0.2, 0, 0]
        radius = 0.1
        inertia = 0.005
        [[route]]
        kind = "mass"
        at = [0.3, -1.5, 0]
        mass = 30
        [model]
        level = 1
        """
    )
    a = (52 - 60) * G / (52 + 2 + 4 * 0.5 + 4 * 30)
    np.testing.assert_allclose(results["POINT_MASS/40.ay"], 2 * a, rtol=1e-6)
    np.testing.assert_allclose(results["PART/22.ay"], -a, rtol=1e-6)

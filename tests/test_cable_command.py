"""`adamslite cable`: its decks against closed forms."""

import numpy as np
import pytest

import adamslite
from adamslite.cables.scene import deck

ATWOOD = """
end = 0.5
steps = 50
error = 1e-8
[cable]
EA = 1e7
rho = 0.01
[[route]]
kind = "mass"
at = [0, -5, 0]
mass = 5
[[route]]
kind = "pulley"
at = [0.2, 0, 0]
radius = 0.2
inertia = 0.04
[[route]]
kind = "pulley"
at = [1.8, 0, 0]
radius = 0.2
inertia = 0.04
[[route]]
kind = "mass"
at = [2, -5, 0]
mass = 3
[model]
level = 1
"""


def solve(spec: str) -> adamslite.Results:
    """The run of the deck, which is reached to the end."""
    text, _ = deck(spec)
    results = adamslite.simulate(adamslite.read(text))
    assert results.outcome.name == "DONE"
    return results


def test_level_1_two_weights_over_two_pulleys() -> None:
    """a = (m1 - m2) g/(m1 + m2 + 2 J/R^2); T1 = m1 (g - a), T2 = T1 - J a/R^2, T3 = m2 (g + a)."""
    results = solve(ATWOOD)
    a = (5 - 3) * 9.81 / (5 + 3 + 2 * 0.04 / 0.2**2)
    np.testing.assert_allclose(results["POINT_MASS/40.ay"], a, rtol=1e-8)
    np.testing.assert_allclose(results["POINT_MASS/40.y"], -5 + a * results.time**2 / 2, atol=1e-6)
    pulls = [5 * (9.81 - a), 5 * (9.81 - a) - a, 3 * (9.81 + a)]
    for p, pull in enumerate(pulls, 1):
        np.testing.assert_allclose(np.abs(results[f"GCON/{p}.f"]), pull, rtol=1e-7)


@pytest.mark.parametrize(("form", "error"), [("paper", 0.5), ("ale", 0.0)])
def test_level_3_a_weight_is_lowered(form: str, error: float) -> None:
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
        """
    )
    late = results.time > 10
    length = 20 + results["REQUEST/10.F2"][late]
    exact = (mass + rho * length) * 9.81
    found = results["REQUEST/1.F2"][late]
    # Nothing accelerates any more: the winch holds what the cable pulls with.
    np.testing.assert_allclose(results["REQUEST/10.F6"][late], found, rtol=1e-4)
    assert np.mean(found - exact) == pytest.approx(-error * rho * speed**2, abs=0.02 * rho * 100)

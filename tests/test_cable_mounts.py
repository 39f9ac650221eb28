"""`adamslite cable`: wheels that the cable may leave in any direction, and what they stand on."""

import numpy as np
import pytest
from tiers import slow

import adamslite
from adamslite.cables.deck.scene import deck

G = 9.81
# Two weights over a wheel of 0.1/0.2^2 = 2.5 kg on a bracket of 20 kg.
SHEAVE = """
end = {end}
steps = 50
error = 1e-8
[cable]
EA = 1e6
rho = 0.001
[[route]]
kind = "mass"
at = [-0.2, -1.5, 0]
mass = 5
[[route]]
kind = "pulley"
at = [0, 0, 0]
radius = 0.2
inertia = 0.1
leans = true
mount = {{ foot = [0.3, -1.5, 0], mass = 20{gives} }}
[[route]]
kind = "mass"
at = [0.2, -1.2, 0]
mass = {mass}
velocity = {velocity}
[model]
{model}
"""


def solve(gives: str = "", model: str = "level = 1", mass: float = 5, velocity: str = "[0, 0, 0]",
          end: float = 0.5) -> adamslite.Results:  # fmt: skip
    """The run of the deck, reached to the end."""
    text, _ = deck(SHEAVE.format(gives=gives, model=model, mass=mass, velocity=velocity, end=end))
    results = adamslite.simulate(adamslite.read(text))
    assert results.outcome.name == "DONE"
    return results


FORMS = ["level = 1", "level = 2\nelements = 2", 'level = 3\nelements = 2\nform = "ale"']


@pytest.mark.slow
@pytest.mark.parametrize("model", FORMS)
def test_a_mount_carries_what_hangs_on_its_wheel(model: str) -> None:
    """Two equal weights at rest: 32.5 g on the ground, and 30 g about a foot 0.3 m to the right.

    The wheel and the bracket at the axle turn by 22.5 g 0.3 against the clock, the weights 0.5 m
    to the left of the foot and 0.1 m by 5 g each: 9.75 g in all.  The cable adds 2.7 g at most:
    0.03 N.
    """
    results = solve(model=model, end=0.1)
    np.testing.assert_allclose(results["REQUEST/21.F3"], -32.5 * G, atol=0.03)
    np.testing.assert_allclose(results["REQUEST/21.F2"], 0, atol=0.03)
    np.testing.assert_allclose(results["REQUEST/21.F8"], 9.75 * G, atol=0.03)
    np.testing.assert_allclose(results["REQUEST/20.F4"], 12.5 * G, atol=0.03)
    np.testing.assert_allclose(results["REQUEST/20.F7"], np.pi, atol=1e-6)


@pytest.mark.parametrize("model", [FORMS[0], slow(FORMS[-1])])
def test_a_mount_gives_way(model: str) -> None:
    """The whole weight of 32.5 kg bounces on 5e4 N/m: y = -(m g/k) (1 - cos w t), w^2 = k/m.

    Nothing turns, for both weights are alike.  Cables of 1.2 and 1.5 m make 10 of the 32.5 kg
    follow through a spring of 2 EA/1.35 m = 30 k: w is (10/32.5)^2/30/2 = 0.16 % low, 0.0125 at
    the angle w t = 7.8 of the end, which is 8e-5 m of 6.4 mm; and the weights swing on it by m g/K
    = 6.6e-5 m, the mount by 10/32.5 of twice that.
    """
    results = solve(gives=", stiffness = 5e4", model=model, end=0.2)
    sag, w = 32.5 * G / 5e4, np.sqrt(5e4 / 32.5)
    y = -sag * (1 - np.cos(w * results.time))
    off = 1e-7 if model == "level = 1" else 1.3e-4
    np.testing.assert_allclose(results["PART/22.y"], y, atol=off)
    np.testing.assert_allclose(results["REQUEST/21.F3"], 5e4 * y, atol=5e4 * off)


def test_a_swinging_weight_keeps_its_energy() -> None:
    """Weights that swing in all directions on an elastic mount: energy of all, and spring.

    The method is of second order or more; ERROR = 1e-8 m of displacements that speeds of 2 m/s
    and weights of 50 N work on, over some 1000 steps: 5e-4 J of 118 J if all errors add up.
    """
    results = solve(gives=", stiffness = 2e4", mass=4, velocity="[0.9, 0, 0.7]")
    energy = 0.05 * results["PART/20.wz"] ** 2
    for name, mass in (
        ("POINT_MASS/10", 5),
        ("POINT_MASS/30", 4),
        ("PART/22", 20),
        ("PART/20", 2.5),
    ):
        place, speed = (np.array([results[f"{name}.{v}{x}"] for x in "xyz"]) for v in ("", "v"))
        energy = energy + mass * (np.sum(speed**2, axis=0) / 2 + G * place[1])
        if name == "PART/22":
            energy = energy + 2e4 * np.sum(place**2, axis=0) / 2
    np.testing.assert_allclose(energy, energy[0], atol=5e-4)


@pytest.mark.slow
def test_cable_that_runs_presses_less() -> None:
    """A weight is hoisted at U = 12 m/s over a pulley on a mount: load 2 (M + rho l) g - 2 rho U^2.

    And the weight of 14 kg of wheel and bracket; the cable on the wheel has none.  rho U^2 = 144 N
    is a sixth of the tension.  The run-up leaves the weight swinging by 3 N at sqrt(EA/(l M)) =
    80 1/s, of which a mean over one second has 2 3/80 = 0.08 N; 2 mm of stretch are 0.04 N.
    """
    text, _ = deck(
        """
        end = 3
        steps = 300
        [cable]
        EA = 2e7
        rho = 1
        damping_time = 8e-4
        [[route]]
        kind = "mass"
        at = [-0.2, -60, 0]
        mass = 60
        [[route]]
        kind = "pulley"
        at = [0, 0, 0]
        radius = 0.2
        inertia = 0.16
        leans = true
        mount = { foot = [0, -2, 0], mass = 10 }
        [[route]]
        kind = "winch"
        at = [0.3, -20, 0]
        radius = 0.1
        inertia = 1
        turn = -1
        leans = true
        payout = "-12*IF(TIME-1:TIME**4*(2.5-TIME*(3-TIME)),0.5,TIME-0.5)"
        [model]
        level = 3
        form = "ale"
        elements = 10
        """
    )
    results = adamslite.simulate(adamslite.read(text))
    assert results.outcome.name == "DONE"
    late = results.time > 2
    length = -results["POINT_MASS/10.y"][late]
    exact = 2 * (60 + length) * G - 2 * 12**2 + 14 * G
    assert np.mean(-results["REQUEST/21.F3"][late] - exact) == pytest.approx(0, abs=0.12)

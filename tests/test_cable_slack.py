"""Ropes that go slack and become taut again, as `adamslite cable` writes them: energy is kept."""

import numpy as np
import pytest

import adamslite
from adamslite.cables.deck.scene import deck

G = 9.81
THROWN = """\
end = {end}
steps = 2000
error = 1e-8
[cable]
EA = {ea}
rho = 1e-4
pulls_only = true
[[route]]
kind = "fixed"
at = [0, 0, 0]
[[route]]
kind = "mass"
at = [0, -{length}, 0]
mass = {mass}
velocity = [0, {speed}, 0]
[model]
level = 2
elements = 1
"""


@pytest.mark.parametrize(
    ("ea", "length", "mass", "speed"), [(1e5, 10, 80, 2.0), (4e4, 5, 15, -3.0)]
)
def test_a_thrown_weight_snatches_with_the_same_force_again_and_again(
    ea: float, length: float, mass: float, speed: float
) -> None:
    """From rest at T = m g it swings with v/w; free flight brings back the speed with which the
    rope went slack: T = m g + v sqrt(k m) every time, and nothing between."""
    stiffness = ea / length * (1 + mass * G / ea)
    spec = THROWN.format(end=4, ea=ea, length=length, mass=mass, speed=speed)
    found = adamslite.simulate(adamslite.read(deck(spec)[0]))
    pull = found["REQUEST/1.F3"]
    inner = pull[1:-1]
    tops = inner[(inner > pull[:-2]) & (inner >= pull[2:]) & (inner > mass * G)]
    exact = mass * G + abs(speed) * np.sqrt(stiffness * mass)
    assert len(tops) >= 3
    assert tops == pytest.approx(exact, rel=1e-3)
    assert min(pull) > -1e-3 * exact

"""The damping of the material of a cable is that of its description, whatever the mesh."""

import re
from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from scipy.optimize import brentq, curve_fit

import adamslite as al
from adamslite.cables.deck.scene import chosen, deck, setting

EA, RHO, L, M = 2e6, 0.5, 40.0, 400.0
HANGING = """
end = 2
steps = 400
error = 1e-6
[cable]
EA = 2e6
rho = 0.5
{damping}
{route}
[[route]]
kind = "mass"
at = [0, -40, 0]
mass = 400
velocity = [0, -0.3, 0]
[model]
{model}
"""
FIXED = '[[route]]\nkind = "fixed"\nat = [0, 0, 0]\n'
# 20 m of the cable on the other side of a wheel without much inertia.
OVER_A_WHEEL = """
[[route]]
kind = "winch"
at = [-20.5, 0, 0]
radius = 0.5
inertia = 1
turn = -1
payout = "0*TIME"
[[route]]
kind = "pulley"
at = [-0.5, 0, 0]
radius = 0.5
inertia = 1e-4
turn = -1
"""


def rate(length: float) -> float:
    """Of the first axial mode of a rod with the weight: x tan x = rho l/M."""
    x = brentq(lambda x: x * sin(x) - RHO * length / M * cos(x), 1e-6, pi / 2)
    return float(x * sqrt(EA / RHO) / length)


def decay(damping: str, route: str, model: str) -> tuple[float, float]:
    """Share of the critical damping, and rate, of the weight as it swings."""
    text, messages = deck(HANGING.format(damping=damping, route=route, model=model))
    assert not messages
    results = al.simulate(al.read(text))
    weight = next(name for name in results if re.fullmatch(r"POINT_MASS/\d0\.y", name))

    def swing(t, rest, a, b, w, s):
        return rest + np.exp(-s * t) * (a * np.cos(w * t) + b * np.sin(w * t))

    y = results[weight]
    (*_, w, s), _ = curve_fit(swing, results.time, y, [y[-1], 0.0, -0.03, 11.0, 1.0])
    return s / np.hypot(w, s), np.hypot(w, s)


def test_a_share_is_that_of_a_section_of_the_mesh_that_is_asked_for() -> None:
    """On every mesh the same, where a section's own share of 0.2 had 4.5, 1.2 and 0.3 %."""
    model = "level = 2\nelements = "
    asked = setting(HANGING.format(damping="", route=FIXED, model="level = 2"))
    count = chosen(asked, asked.faults).elements
    tau = 2 * 0.2 * L / count / sqrt(EA / RHO)
    for elements in (1, 4, 16):
        share, found = decay("damping = 0.2", FIXED, f"{model}{elements}")
        assert share == pytest.approx(tau * found / 2, rel=0.01)
        assert found == pytest.approx(rate(L), rel=0.01)


@pytest.mark.parametrize("tau", [4e-3, 2e-2])
@pytest.mark.parametrize("elements", [1, 6])
def test_a_time_damps_by_half_of_it_times_the_rate(tau: float, elements: int) -> None:
    share, found = decay(f"damping_time = {tau}", FIXED, f"level = 2\nelements = {elements}")
    assert share == pytest.approx(tau * found / 2, rel=0.01)


@pytest.mark.parametrize("elements", [1, 5])
def test_spans_between_wheels_damp_as_those_to_a_weight(elements: int) -> None:
    """60 m of cable, 20 of them between two wheels."""
    length = 60.0
    model = f'level = 3\nform = "ale"\nelements = {elements}'
    share, found = decay("damping_time = 0.01", OVER_A_WHEEL, model)
    assert found == pytest.approx(rate(length), rel=0.02)
    assert share == pytest.approx(0.01 * rate(60.0) / 2, rel=0.03)

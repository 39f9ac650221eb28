"""Spans between two wheels have mass: weight, inertia, fronts that run along them."""

from __future__ import annotations

import numpy as np
import pytest
from descriptions import solve

from adamslite.cables.deck.scene import deck
from adamslite.language.diagnostics import DeckError

G = 9.81


@pytest.mark.parametrize("elements", (1, 3, 4))
@pytest.mark.parametrize("leans", (False, True))
def test_a_winch_holds_the_rope_below_it(elements: int, leans: bool) -> None:
    """Two legs of 100 m under a block: at the top W/2 + rho g L, W/2 was said before."""
    results = solve(
        f"""
        end = 1
        statics = true
        [cable]
        EA = 2e7
        rho = 2.0
        damping = 0.5
        [[route]]
        kind = "fixed"
        at = [-0.3, 0, 0]
        [[route]]
        kind = "pulley"
        at = [0, -100, 0]
        radius = 0.3
        inertia = 0.09
        mass = 499
        slide = [0, 1, 0]
        leans = {str(leans).lower()}
        [[route]]
        kind = "winch"
        at = [0.6, 0, 0]
        radius = 0.3
        inertia = 1
        turn = -1
        payout = "0*TIME"
        [model]
        level = 3
        form = "ale"
        elements = {elements}
        """
    )
    assert results["REQUEST/30.F6"] == pytest.approx(500 * G / 2 + 2 * G * 100, rel=1e-4)
    assert results["REQUEST/1.F3"] == pytest.approx(500 * G / 2 + 2 * G * 100, rel=1e-4)
    assert results["REQUEST/2.F2"] == pytest.approx(500 * G / 2, rel=1e-4)
    assert "DIFF" not in results.meta.get("accuracy", "")  # speeds of 1e-12 are round-off


@pytest.mark.parametrize("mass", (1.0, 100.0))
def test_a_front_passes_a_wheel_and_arrives_with_the_speed_of_sound(mass: float) -> None:
    """Of rho c V behind a wheel of J/R^2 = m, 1 - exp(-2 Z t/m) passes; a winch that stands doubles
    it l/c later.  One spring had it there at once.
    """
    stiffness, rho, speed, length = 1e7, 1.0, 1.0, 100.0
    c = np.sqrt(stiffness / rho)
    front = rho * c * speed
    results = solve(
        f"""
        end = 0.075
        steps = 750
        gravity = [0, 0, 0]
        [cable]
        EA = {stiffness}
        rho = {rho}
        damping_time = {0.2 * length / 60 / c}
        pretension = 2e4
        [[route]]
        kind = "winch"
        at = [-{length}, 0, 0]
        radius = 0.5
        inertia = 10
        turn = 1
        payout = "-{speed}*IF(TIME-0.002: 250*TIME**2, 0.001, TIME-0.001)"
        [[route]]
        kind = "pulley"
        at = [0, 0, 0]
        radius = 0.5
        inertia = {mass / 4}
        turn = 1
        [[route]]
        kind = "winch"
        at = [0, -{length}, 0]
        radius = 0.5
        inertia = 10
        turn = 1
        payout = "0*TIME"
        [model]
        level = 3
        form = "ale"
        elements = 60
        """
    )
    passed = results.time - length / c - 1e-3  # since the middle of the rise came to the wheel
    behind = (passed > 4e-3) & (passed < 0.028)
    over = front * (1 - np.exp(-2 * rho * c * passed / mass))[behind]
    rest = results["REQUEST/2.F2"][0]
    off = results["REQUEST/2.F2"][behind] - rest - over
    assert abs(off.mean()) < 0.01 * front and np.abs(off).max() < 0.06 * front
    off = results["REQUEST/1.F3"][behind] - rest - (2 * front - over)
    assert abs(off.mean()) < 0.015 * front and np.abs(off).max() < 0.06 * front
    end = results["REQUEST/2.F3"] - rest
    # Sections smear a front over N^(1/3) of them, 2.6 ms here.
    assert np.abs(end[results.time < 2 * length / c - 4e-3]).max() < 0.1 * front
    if mass == 1.0:
        arrived = results.time[np.argmax(end > front)]
        assert arrived == pytest.approx(2 * length / c + 1e-3, rel=0.01)
        late = results.time > 2 * length / c + 6e-3
        assert end[late].mean() == pytest.approx(2 * front, rel=0.01)


@pytest.mark.parametrize("elements", (1, 2, 5))
def test_a_run_between_winches_is_sped_up(elements: int) -> None:
    """The tensions of a rope that both winches speed up by a differ by rho L a."""
    results = solve(
        f"""
        end = 2
        steps = 100
        gravity = [0, 0, 0]
        [cable]
        EA = 1e7
        rho = 3.0
        damping_time = {0.06 / elements}
        pretension = 2e4
        [[route]]
        kind = "winch"
        at = [0, 0, 0]
        radius = 0.5
        inertia = 10
        turn = 1
        payout = "5*STEP5(TIME,0,0,0.5,1)*TIME**2/2"
        [[route]]
        kind = "winch"
        at = [60, 0, 0]
        radius = 0.5
        inertia = 10
        turn = 1
        payout = "-5*STEP5(TIME,0,0,0.5,1)*TIME**2/2"
        [model]
        level = 3
        form = "ale"
        elements = {elements}
        """
    )
    late = results.time > 1.2
    strain = results["REQUEST/1.F2"][0] / 1e7
    wanted = 3.0 * 60 / (1 + strain) * 5
    pull = (results["REQUEST/1.F3"] - results["REQUEST/1.F2"])[late]
    assert pull == pytest.approx(wanted, rel=3e-3)


def test_a_block_on_heavy_falls_keeps_the_balance_of_momentum() -> None:
    """5 t on two falls of 100 m of 10 kg/m that a winch hauls: at the top both falls hold what is
    below them, with the acceleration of the rope; it starts in balance.
    """
    results = solve(
        """
        end = 6
        steps = 300
        [cable]
        EA = 8e7
        rho = 10
        damping = 0.3
        [[route]]
        kind = "winch"
        at = [-0.8, 100, 0]
        radius = 0.4
        inertia = 40
        turn = -1
        payout = "-40*STEP5(TIME,0,0,6,1)"
        [[route]]
        kind = "pulley"
        at = [0, 0, 0]
        radius = 0.4
        inertia = 2
        mass = 5000
        slide = [0, 1, 0]
        [[route]]
        kind = "fixed"
        at = [0.4, 100, 0]
        [model]
        level = 3
        form = "ale"
        elements = 8
        """
    )
    block = {k: results[f"PART/22.{k}"] for k in ("y", "vy", "ay")}
    held = results["REQUEST/1.F2"] + results["REQUEST/2.F3"]
    rope = 10 * (100 - block["y"])
    wheel = 2 / 0.4**2
    # The fall of the winch runs at 2 v, and gets shorter by v; the other one is at rest.
    momentum = 2 * rope * block["ay"] - 2 * 10 * block["vy"] ** 2
    whole = (5000 + wheel + 2 * rope) * G + (5000 + wheel) * block["ay"] + momentum
    whole += 10 * (2 * block["vy"]) ** 2  # what the winch takes up leaves with its momentum
    assert held == pytest.approx(whole, rel=5e-3)
    assert held[100:] == pytest.approx(whole[100:], rel=3e-3)  # less, waves in the falls
    assert held[0] == pytest.approx((5000 + wheel + 2000) * G, rel=1e-3)
    assert block["ay"][0] == pytest.approx(0.0, abs=0.01)


HOIST = """
end = 2
statics = true
[cable]
EA = 5e7
rho = 5.0
[[route]]
kind = "mass"
at = [2, -100, 0]
mass = 1000
[[route]]
kind = "pulley"
at = [1, 50, 0]
motion = ["0", "0.0*TIME", "0"]
radius = 1
inertia = 100
[[route]]
kind = "winch"
at = [-30, 0, 0]
radius = 1
inertia = 1000
turn = -1
payout = "0*TIME"
[model]
elements = 20
"""
TACKLE = """
end = 8
[cable]
EA = 2e6
rho = 0.5
damping = 0.1
[[load]]
at = [0.1, -5, 0]
mass = 500
name = "block"
inertia = [5, 5, 5]
[[route]]
kind = "hook"
at = [-0.1, -5, 0]
[[route]]
kind = "pulley"
at = [0, 0, 0]
radius = 0.1
inertia = 0.01
[[route]]
kind = "pulley"
at = [0.2, -5, 0]
radius = 0.1
inertia = 0.01
load = "block"
[[route]]
kind = "winch"
at = [0.5, 0, 0]
radius = 0.2
inertia = 2
turn = -1
payout = "-STEP5(TIME,1,0,6,6)"
"""
ELEVATOR = """
end = 20
steps = 1000
statics = true
[[cable]]
name = "hoist"
EA = 2.2e7
rho = 2.9
damping = 0.1
fall = "carhook drive cwthook"
[[cable]]
name = "comp"
EA = 2.2e7
rho = 2.9
damping = 0.1
pretension = 3000
fall = "carlow idler cwtlow"
[[load]]
name = "car"
at = [-0.4, -80, 0]
mass = 2400
[[load]]
name = "cwt"
at = [0.4, -10, 0]
mass = 3200
[[route]]
name = "carhook"
kind = "hook"
load = "car"
at = [-0.4, -80, 0]
[[route]]
name = "drive"
kind = "winch"
at = [0, 0, 0]
radius = 0.4
inertia = 60
payout = "60*STEP5(TIME,1,0,19,1)"
[[route]]
name = "cwthook"
kind = "hook"
load = "cwt"
at = [0.4, -10, 0]
[[route]]
name = "carlow"
kind = "hook"
load = "car"
at = [-0.4, -80, 0]
[[route]]
name = "idler"
kind = "pulley"
at = [0, -90, 0]
radius = 0.4
inertia = 20
[[route]]
name = "cwtlow"
kind = "hook"
load = "cwt"
at = [0.4, -10, 0]
"""


def test_sections_that_are_longer_than_a_wheel_are_named() -> None:
    """It was said that the tension stretches the cable by half."""
    with pytest.raises(DeckError) as caught:
        deck(HOIST)
    assert [each.code for each in caught.value.diagnostics] == ["bend-too-tight"]


def test_a_tackle_takes_its_payout_from_all_falls() -> None:
    """6 m of cable are more than a span has, and lift what hangs on three falls by 2 m."""
    results = solve(TACKLE, warns=True)
    assert results["PART/50.y"][-1] + 5 == pytest.approx(2.0, abs=5e-3)
    assert results["REQUEST/1.F2"][-1] == pytest.approx(500 * G / 3, rel=0.02)


def test_a_rope_that_another_one_moves_has_its_mass_where_it_hangs() -> None:
    """A car between hoist and compensation rope: what pulls at it accelerates it, everywhere."""
    results = solve(ELEVATOR)
    pull = results["REQUEST/1.F3"] - 2400 * G - results["REQUEST/3.F3"]
    off = pull - 2400 * results["POINT_MASS/70.ay"]
    travels = np.abs(results["REQUEST/20.F3"]) > 0.01
    # The paper's form leaves out half of rho v^2 at the car.
    assert np.abs(off[~travels]).max() < 1e-3 * 2400 * G
    assert np.abs(off[travels]).max() < 2.5e-3 * 2400 * G

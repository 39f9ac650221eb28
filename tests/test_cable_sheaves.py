"""Ropes over many sheaves as `adamslite cable` writes them: capstan's law, mass, stick-slip."""

import re
from math import exp

import numpy as np
import pytest
from descriptions import ATWOOD
from scipy.integrate import solve_ivp

import adamslite
from adamslite.cables.deck.scene import deck

G = 9.81


def bars(count: int, law: str, more: str = "", end: float = 40) -> str:
    """A rope that is fixed at one end lies over and under bars; a winch at the other."""
    return f"""\
end = {end}
error = 1e-7
gravity = [0, 0, 0]
[cable]
EA = 1e6
rho = 0.5
pretension = 1000
[[route]]
kind = "fixed"
at = [-3, 0, 0]
[[route]]
kind = "pulley"
at = [0, 0.1, 0]
count = {count}
pitch = [0.8, 0, 0]
stagger = [0, -0.3, 0]
radius = 0.1
held = true
mu = 0.2
grip = 2e-5
{more}
[[route]]
kind = "winch"
at = [{0.8 * count}, 0, 0]
radius = 0.2
inertia = 10
payout = "{law}"
[model]
level = 3
elements = 1
"""


@pytest.mark.parametrize("way", [-1, 1])
@pytest.mark.parametrize("count", [3, 6])
def test_the_ratio_over_every_bar_is_that_of_euler_and_eytelwein(count: int, way: int) -> None:
    """Pulled by 8 cm, and let back by as much: all bars slip one way, then the other.

    Slipping for 4 cm and more is thousands of times the displacement at which a rope grips.
    """
    law = "-0.08*STEP5(TIME,0,0,20,1)+0.075*STEP5(TIME,20,0,40,1)"
    text, _ = deck(bars(count, law))
    found = adamslite.simulate(adamslite.read(text))
    row = len(found.time) // 2 if way < 0 else -1
    halves = re.findall(r"VARIABLE/h_\d+, FUNCTION=TANH\(([\d.]+)\*", text)
    assert len(halves) == count
    for i, half in enumerate(halves):
        ratio = found[f"REQUEST/{10 * (i + 2)}.F8"][row]
        assert ratio == pytest.approx(exp(-way * 2 * float(half)), rel=2e-6)


def test_every_second_bar_of_a_staggered_row_turns_the_other_way() -> None:
    """As the side on which the rope touches it says, too."""
    given, found = (
        [line for line in deck(bars(4, "-0.01*TIME", more))[0].splitlines() if line[:1] != "!"]
        for more in ("turn = -1", "")
    )
    assert given == found


def test_statements_of_a_hundred_stations_have_numbers_of_their_own() -> None:
    text, _ = deck(bars(120, "-0.01*TIME", end=0.01))
    assert not any(each.is_error for each in adamslite.check(adamslite.read(text)))
    assert "REQUEST/2000," in text and "MARKER/1210," in text


def test_spans_between_wheels_have_mass() -> None:
    """Atwood's machine over two pulleys with 1.6 m of heavy rope between: the rope as one mass."""
    text = ATWOOD.replace("rho = 0.01", "rho = 1").replace("level = 1", "level = 3\nelements = 12")
    found = adamslite.simulate(adamslite.read(deck(text)[0]))
    # Hanging rope, weights, wheels J/R^2 = 1 kg, and 1.6 m; the arcs have no mass.
    moving = 5 + 3 + 5 + 5 + 2 * 0.04 / 0.2**2 + 1.6
    a = (5 - 3) * G / moving
    t = found.time
    assert found["REQUEST/20.F2"] == pytest.approx(-a * t**2 / 2, abs=0.02 * a * t[-1] ** 2)


def test_a_rope_sticks_and_slips_where_friction_is_greater_at_rest() -> None:
    """The same equations of one bar, integrated by scipy."""
    law = "-0.002*TIME"
    spec = bars(1, law, "mu_static = 0.5", end=0.25)
    text, _ = deck(spec.replace("error = 1e-7", "error = 1e-9"))
    found = adamslite.simulate(adamslite.read(text))
    half = float(re.search(r"FUNCTION=TANH\(([\d.]+)\*", text)[1])
    wrap = half / 0.1
    spans = re.findall(r"VARIABLE/LT\d, FUNCTION=([\d.]+)", text)
    free = [float(x) for x in spans]
    long = [1.001 * x for x in free]

    def rates(t: float, y: np.ndarray) -> list[float]:
        s, v, z = y
        # The rope comes off the first span; what the winch takes comes off the second.
        l1, l2 = free[0] - s, free[1] + s - 0.002 * t
        t1, t2 = (1e6 * (x / now - 1) for x, now in zip(long, (l1, l2), strict=True))
        k = z / 2e-5
        h = np.tanh(half * k)
        full = 1 + 1.5 * np.exp(-((v / 1e-3) ** 2))
        m1, m2, rim = 0.5 * l1 / 2, 0.5 * l2 / 2, 0.5 * 0.1 * wrap
        a = (t2 - t1 - h * (t1 + t2 - v**2)) / (rim + m1 + m2 + h * (m1 - m2))
        return [v, a, v * (1 - np.tanh(v / 1e-8) * k / full)]

    exact = solve_ivp(rates, (0, 0.25), [0, 0, 0], "Radau", found.time, rtol=1e-6, atol=1e-10)
    assert found["REQUEST/20.F2"] == pytest.approx(exact.y[0], abs=2e-5)
    assert found["REQUEST/20.F8"].max() > exp(2 * half) * 1.02  # it sticks above mu


@pytest.mark.parametrize(("near", "far"), [(5, 3), (2, 6)])
def test_a_wheel_that_a_cable_grips_is_its_angle(near: float, far: float) -> None:
    """Light rope over a heavy wheel, which it slips on: T2/T1 = exp(mu pi), J w' = r (T2 - T1).

    J is far more than the friction can speed up as fast as the rope.
    """
    text = f"""\
end = 0.2
error = 1e-9
[cable]
EA = 1e6
rho = 1e-4
damping_time = 3e-5
pulls_only = true
[[route]]
kind = "mass"
at = [-0.2, -3, 0]
mass = {near}
[[route]]
kind = "pulley"
at = [0, 0, 0]
radius = 0.2
inertia = 9
mu = 0.1
grip = 1e-6
[[route]]
kind = "mass"
at = [0.2, -3, 0]
mass = {far}
[model]
level = 3
elements = 1
"""
    written, _ = deck(text)
    assert "PART/20" not in written
    found = adamslite.simulate(adamslite.read(written))
    ratio = exp(0.1 * np.pi * (1 if far > near else -1))
    # m1 (g + a) and m2 (g - a), a the way over the wheel.
    a = (far - ratio * near) * G / (far + ratio * near)
    torque = 0.2 * (far * (G - a) - near * (G + a))
    late = found.time > 0.1
    spin = found["REQUEST/20.F6"][late]
    rate = np.diff(spin) / np.diff(found.time[late])
    assert np.mean(rate) == pytest.approx(-torque / 9, rel=2e-3)
    assert np.mean(found["REQUEST/20.F8"][late]) == pytest.approx(ratio, rel=1e-4)

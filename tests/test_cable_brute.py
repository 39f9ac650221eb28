"""Form brute of `adamslite cable`: cable that lies, slides and is stored on rims."""

import numpy as np
import pytest
from descriptions import ATWOOD, G, solve
from formulas import Winch, sliding_ratio

import adamslite
from adamslite.cables.deck.scene import deck

WINCH = Winch(1.0, 0.2, 5)


def test_a_drum_lets_a_weight_down() -> None:
    """Way of the weight s (1 - 0.0542 (h/R)^2) - M s" L/EA, tension M g when the payout is steady.

    L = 5.37 m is all of the cable: nothing holds it on the drum.  A section h on a node radius r =
    R - h^2/(80 R) turns the drum by 2 asin(h/(2 r)), the rim by h (1 + (1/24 + 1/80) (h/R)^2).
    While a section leaves, the arm of the cable goes through h^2/(8 R): the place of the weight
    ripples by a = h^3/(4 pi^3 R^2) = 1.3 um at w = 2 pi U/h.  On the way up w goes through w0 =
    sqrt(EA/(M L)) = 68 1/s at the rate w' = 2 pi s"/h = 149 1/s^2 and leaves a swing of
    w0 a sqrt(pi/(2 w')) EA/L = 9 N, 10 um.  Its mean over the last second is below 2 9/68 = 0.3 N.
    The place has that, and h^2/(80 R) = 30 um of the nodes that sink in: 4e-5 m.
    """
    h, radius, law = 2 / 58, 0.5, WINCH.text.replace("\n, ", "")
    results = solve(
        f"""
        end = 3
        steps = 300
        error = 1e-5
        [cable]
        EA = 5e6
        rho = 1.0
        damping = 0.2
        [[route]]
        kind = "winch"
        at = [-0.5, 0, 0]
        radius = {radius}
        inertia = 20
        turn = -1
        mu = 0
        payout = "{law}"
        [[route]]
        kind = "mass"
        at = [0, -2, 0]
        mass = 200
        [model]
        form = "brute"
        elements = 58
        """
    )
    paid = results["REQUEST/10.F2"]
    way = -2 - results["POINT_MASS/20.y"]
    relief = 200 * WINCH(results.time)[2]
    length = 2 + paid[-1] + np.pi * radius
    expected = paid * (1 - 0.0542 * (h / radius) ** 2) - relief * length / 5e6
    np.testing.assert_allclose(way, expected, atol=4e-5)
    late = results.time > 2
    steady = np.mean(results["REQUEST/1.F3"][late] + relief[late])
    assert steady == pytest.approx(200 * G, abs=0.3)
    assert np.all(results["REQUEST/10.F6"][late] > 0)  # the winch holds back


@pytest.mark.parametrize("elements", [40, 80])
def test_lumps_and_ends_weigh_what_the_cable_does(elements: int) -> None:
    """Two weights, two spans of 5 m, one of 1.6 m and two quarters of a wheel between; chords of h
    on a rim are (h/R)^2/24 shorter than their arcs: 0.026 (h/R)^2 m, and as much again where
    sections lie half on it.
    """
    spec = ATWOOD.replace("rho = 0.01", "rho = 2").replace(
        "level = 1", f'form = "brute"\nelements = {elements}'
    )
    text, _ = deck(spec)
    masses = [each.mass for each in adamslite.read(text).of("POINT_MASS")]
    flat = 2 * 0.052 * (5 / elements / 0.2) ** 2
    assert sum(masses) == pytest.approx(5 + 3 + 2 * (11.6 + np.pi * 0.2), abs=2 * flat)
    assert len(masses) > 2 * elements


@pytest.mark.slow
def test_a_belt_slides_on_its_driven_pulley() -> None:
    """tau1/tau2 of a lumped belt that slides: g(x d) g(d)^m g(y d) with x + m + y = pi/d.

    g(a) = (1 + mu tan(a/2))/(1 - mu tan(a/2)), mean over 0 < x < 1.  With the load of the axle
    F = tau1 + tau2 and the pull at the rim P = (tau1 - tau2) r sin(d/2)/(d/2)/R.

    d follows from the tension, 307 to 1080 N of EA = 20 kN: +-2 % of a correction d^2/12 = 1.6 % of
    the ratio's logarithm.  F and P swing by 10 N while a lump passes, 4 lumps in the window: means
    to 10/(4 pi) N, 0.1 % of P, 0.17 % of the ratio.  The contact gives way by T h/(R K): the belt
    lies on a spiral, 0.23 mm over the half turn, of the slope 7e-4, which is as much of mu: 0.23 %
    of the ratio.  ERROR=1e-4 leaves 0.2 %: 3.570 to 3.584 at 1e-4 to 1e-6.  Together 0.7 %;
    without lumps the ratio would be exp(mu pi), 2.3 % away.
    """
    text = """
        gravity = [0, 0, 0]
        end = 0.16
        steps = 320
        error = 1e-4
        closed = true
        [cable]
        EA = 2e4
        rho = 0.2
        pretension = 650
        damping = 0.1
        [[route]]
        kind = "winch"
        at = [0, 0, 0]
        radius = 0.1
        inertia = 0.1
        mu = 0.4
        payout = "2*TIME"
        [[route]]
        kind = "winch"
        at = [0.26, 0, 0]
        radius = 0.1
        inertia = 0.1
        mu = 0.4
        payout = "1.6*TIME"
        [model]
        elements = 6
        """
    results = solve(text)
    late = results.time > 0.06
    load, pull = (np.mean(results[f"REQUEST/20.{f}"][late]) for f in ("F4", "F6"))
    free = (4 * 0.13 + 2 * np.pi * 0.1) / 26 / (1 + 650 / 2e4)
    stretched = free * (1 + load / 2 / 2e4)
    r = 0.1 - (0.26 / 6) ** 2 / 80 / 0.1
    d = 2 * np.arcsin(stretched / 2 / r)
    expected = sliding_ratio(0.4, np.pi, d)
    difference = pull * 0.1 / (r * np.sin(d / 2) / (d / 2))
    assert (load + difference) / (load - difference) == pytest.approx(expected, rel=7e-3)


@pytest.mark.slow
def test_a_chain_keeps_its_teeth() -> None:
    """Sprockets of z1 = 8 and z2 = 12 teeth: z2 of one and z1 of the other turn together.

    On top of the mean, a strand on a polygon of z corners is ahead by up to R a^3/(9 sqrt 3), a =
    pi/z: 0.005 of a pitch at 8 teeth, 0.002 at 12.  Pins give way along their seat by 4 e R^2/(H
    z^2) times what goes along the rim over their push (8 % of a link's pull), shared by five: 0.1
    mm = 0.002 of a pitch, and ring as they arrive by as much again.  Together a hundredth of a
    tooth; a tooth that is jumped would be a whole one.
    """
    results = solve(
        """
        gravity = [0, 0, 0]
        end = 0.3
        steps = 300
        closed = true
        [cable]
        EA = 1e6
        rho = 0.4
        pretension = 500
        damping = 0.2
        [[route]]
        kind = "winch"
        at = [0, 0, 0]
        radius = 0.0653281482
        inertia = 5e-4
        teeth = 8
        payout = "0.65*TIME"
        [[route]]
        kind = "winch"
        at = [0.5, 0, 0]
        radius = 0.0965925826
        inertia = 5e-4
        teeth = 12
        mass = 2
        slide = [1, 0, 0]
        pull = "1000-300*SD"
        force = "200+30*SD"
        """
    )
    turns = [
        z * results[f"REQUEST/{i}.F2"] / radius / (2 * np.pi)
        for i, z, radius in ((10, 8, 0.0653281482), (20, 12, 0.0965925826))
    ]
    assert turns[0][-1] > 3.5
    np.testing.assert_allclose(turns[1], turns[0], atol=0.012)

"""`adamslite cable`: brute force, slip, movement, long runs, two winches, against closed forms."""

import sys

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import adamslite
from adamslite.cables.scene import deck
from adamslite.places import find

G = 9.81


def solve(spec: str) -> adamslite.Results:
    """The run of the deck, in which `check` finds no mistake, reached to the end."""
    text, _ = deck(spec)
    results = adamslite.simulate(adamslite.read(text))
    assert results.outcome.name == "DONE"
    return results


def formulas():
    """The closed forms of decks/cables/formulas.py."""
    sys.path.insert(0, str(find("decks") / "cables"))
    import formulas as found

    sys.path.pop(0)
    return found


WINCH = (
    "TIME-0.2*(6-(6+25*TIME+50*TIME**2+62.5*TIME**3+52.083333333*TIME**4"
    "+26.041666667*TIME**5)*EXP(-TIME/0.2))"
)


def test_brute_force_a_drum_lets_a_weight_down() -> None:
    """Way of the weight s (1 - 0.0542 (h/R)^2) - M s" L/EA, tension M g when the payout is steady.

    L = 5.37 m is all of the cable: nothing holds it on the drum.  A section h on a node radius r =
    R - h^2/(80 R) turns the drum by 2 asin(h/(2 r)), the rim by h (1 + (1/24 + 1/80) (h/R)^2).
    While a section leaves, the arm of the cable goes through h^2/(8 R): the place of the weight
    ripples by a = h^3/(4 pi^3 R^2) = 1.3 um at w = 2 pi U/h.  On the way up w goes through w0 =
    sqrt(EA/(M L)) = 68 1/s at the rate w' = 2 pi s"/h = 149 1/s^2 and leaves a swing of
    w0 a sqrt(pi/(2 w')) EA/L = 9 N, 10 um.  Its mean over the last second is below 2 9/68 = 0.3 N.
    The place has that, and h^2/(80 R) = 30 um of the nodes that sink in: 4e-5 m.
    """
    h, radius = 2 / 58, 0.5
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
        payout = "{WINCH}"
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
    x = results.time / 0.2
    relief = 200 * x**5 / 120 * np.exp(-x) / 0.2
    length = 2 + paid[-1] + np.pi * radius
    expected = paid * (1 - 0.0542 * (h / radius) ** 2) - relief * length / 5e6
    np.testing.assert_allclose(way, expected, atol=4e-5)
    late = results.time > 2
    steady = np.mean(results["REQUEST/1.F3"][late] + relief[late])
    assert steady == pytest.approx(200 * G, abs=0.3)
    assert np.all(results["REQUEST/10.F6"][late] > 0)  # the winch holds back


def test_brute_force_a_belt_slides_on_its_driven_pulley() -> None:
    """tau1/tau2 of a lumped belt that slides: g(x d) g(d)^m g(y d) with x + m + y = pi/d.

    g(a) = (1 + mu tan(a/2))/(1 - mu tan(a/2)), mean over 0 < x < 1.  With the load of the axle
    F = tau1 + tau2 and the pull at the rim P = (tau1 - tau2) r sin(d/2)/(d/2)/R.

    d follows from the tension, 307 to 1080 N of EA = 20 kN: +-2 % of a correction d^2/12 = 1.6 % of
    the ratio's logarithm.  F and P swing by 10 N while a lump passes, 4 lumps in the window: means
    to 10/(4 pi) N, 0.1 % of P, 0.17 % of the ratio.  The contact gives way by T h/(R K): the belt
    lies on a spiral, 0.23 mm over the half turn, of the slope 7e-4, which is as much of mu: 0.23 %
    of the ratio.  Together 0.5 %; without lumps the ratio would be exp(mu pi), 2.3 % away.
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
    x = (np.arange(1000) + 0.5) / 1000
    m, y = np.divmod(np.pi / d - x, 1)

    def log_g(a):
        return np.log((1 + 0.4 * np.tan(a / 2)) / (1 - 0.4 * np.tan(a / 2)))

    expected = np.exp(log_g(x * d) + m * log_g(d) + log_g(y * d)).mean()
    difference = pull * 0.1 / (r * np.sin(d / 2) / (d / 2))
    assert (load + difference) / (load - difference) == pytest.approx(expected, rel=5e-3)


def test_brute_force_a_chain_keeps_its_teeth() -> None:
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


@pytest.mark.parametrize("form", ["brute", "ale"])
def test_a_kink_meets_a_free_running_sheave(form: str) -> None:
    """T1 and T2 of the impact to the accuracy that was asked for, 1 %, with elements of its own.

    The sheave is light: a wheel of 0.6 kg (J/R^2) as a section, or a rim without friction.
    """
    found = formulas()
    impact = found.Impact(found.Cable(6.0e7, 5.536, 13345.0), 65.0)
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


def test_a_mass_that_runs_into_a_long_run() -> None:
    """m v' = -rho c v: v = v0 exp(-t sqrt(EA rho)/m); ERROR = 1e-8 m a step, some hundred steps:
    1e-5 m."""
    results = solve(
        """
        gravity = [0, 0, 0]
        end = 0.5
        steps = 50
        error = 1e-8
        [cable]
        EA = 1e6
        rho = 0.01
        [[route]]
        kind = "run"
        at = [-3, 0, 0]
        [[route]]
        kind = "mass"
        at = [0, 0, 0]
        mass = 20
        velocity = [4, 0, 0]
        """
    )
    rate = np.sqrt(1e6 * 0.01) / 20
    np.testing.assert_allclose(
        results["POINT_MASS/20.x"], 4 / rate * (1 - np.exp(-rate * results.time)), atol=1e-5
    )


def test_an_end_that_a_law_moves() -> None:
    """A mass on one section, its other end at a t^2/2: x = a t^2/2 - a/w^2 (1 - cos w t)."""
    results = solve(
        """
        gravity = [0, 0, 0]
        end = 1
        steps = 100
        error = 1e-8
        [cable]
        EA = 2e4
        rho = 1e-4
        [[route]]
        kind = "fixed"
        at = [2, 0, 0]
        motion = ["1.5*TIME**2", 0, 0]
        [[route]]
        kind = "mass"
        at = [0, 0, 0]
        mass = 10
        [model]
        level = 2
        elements = 1
        """
    )
    w2, t = 2e4 / 2 / (10 + 1e-4), results.time
    expected = 1.5 * t**2 - 3 / w2 * (1 - np.cos(np.sqrt(w2) * t))
    np.testing.assert_allclose(results["POINT_MASS/20.x"], expected, atol=1e-5)


def test_level_1_two_winches_place_a_weight() -> None:
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
        """
        end = 1
        steps = 50
        error = 1e-8
        [cable]
        EA = 1e6
        rho = 0.05
        [[route]]
        kind = "fixed"
        at = [-0.1, 0, 0]
        [[route]]
        kind = "pulley"
        at = [0, -2, 0]
        radius = 0.1
        inertia = 0.02
        mass = 50
        slide = [0, 1, 0]
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


def test_level_1_a_crane_runs_and_lowers() -> None:
    """Trolley X(t), rope l(t): l q" + 2 l' q' + g sin q + X" cos q = 0, q the angle of the rope.

    ERROR = 1e-7 m over 120 m s of accumulated steps is below 1e-4 m in the place of the load.
    """
    results = solve(
        """
        end = 6
        steps = 60
        error = 1e-7
        [cable]
        EA = 2e7
        rho = 2
        [[route]]
        kind = "winch"
        at = [-0.3, 0, 0]
        radius = 0.3
        inertia = 9
        turn = -1
        payout = "STEP5(TIME,1,0,5,4)"
        motion = ["STEP5(TIME,0,0,4,6)", 0, 0]
        [[route]]
        kind = "mass"
        at = [0, -8, 0]
        mass = 2000
        [model]
        level = 1
        """
    )

    def step(t, start, end, height):
        """STEP5, its first and its second derivative."""
        x = np.clip((t - start) / (end - start), 0, 1)
        w = end - start
        return (
            height * x**3 * (10 - 15 * x + 6 * x * x),
            height * 30 * x**2 * (1 - x) ** 2 / w,
            height * 60 * x * (1 - x) * (1 - 2 * x) / w**2,
        )

    def rates(t, y):
        paid, speed, _ = step(t, 1, 5, 4)
        _, _, a = step(t, 0, 4, 6)
        return [y[1], -(2 * speed * y[1] + G * np.sin(y[0]) + a * np.cos(y[0])) / (8 + paid)]

    t = results.time
    q = solve_ivp(rates, (0, 6), [0, 0], t_eval=t, rtol=1e-10, atol=1e-12).y[0]
    rope = 8 + step(t, 1, 5, 4)[0]
    np.testing.assert_allclose(
        results["POINT_MASS/20.x"], step(t, 0, 4, 6)[0] + rope * np.sin(q), atol=1e-4
    )
    np.testing.assert_allclose(results["POINT_MASS/20.y"], -rope * np.cos(q), atol=1e-4)


@pytest.mark.parametrize("level", [2, 3])
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
        """
    )
    late = results.time > 0.3
    ratio = np.mean(results["REQUEST/1.F2"][late]) / np.mean(results["REQUEST/2.F2"][late])
    assert ratio == pytest.approx(np.exp(0.3 * np.pi), rel=1e-3)
    assert np.all(results["REQUEST/20.F3"][late] < 0)


@pytest.mark.parametrize("level", [1, 2, 3])
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

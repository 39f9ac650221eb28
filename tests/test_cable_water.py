"""Cables in water, on a bed and with bending, as `adamslite cable` writes them."""

import re
from math import pi, sqrt

import numpy as np
import pytest
from descriptions import HOIST, solve

from adamslite.cables.deck.scene import deck

G = 9.81
#: A rope without tension, 10 m level, between two free ends.
ADRIFT = """\
end = 1
error = 1e-8
[cable]
EA = 1e5
rho = 2
diameter = 0.04
{more}
[[route]]
kind = "free"
at = [0, {height}, 0]
[[route]]
kind = "free"
at = [10, {height}, 0]
[model]
level = 2
elements = 10
"""
#: A cantilever of 1 m that starts straight and level, EI = 10 N m2, 0.5 kg/m.
CANTILEVER = """\
end = {end}
steps = 800
error = 1e-9
gravity = [0, {gravity}, 0]
[cable]
EA = 1e5
rho = 0.5
bending = 10
bending_damping = {damping}
[[route]]
kind = "fixed"
at = [0, 0, 0]
clamped = [1, 0, 0]
[[route]]
kind = "free"
at = [1, 0, 0]
[model]
level = 2
elements = 20
"""


def test_a_cantilever_swings_about_its_sag_with_its_first_frequency() -> None:
    """w1 = 1.8751^2 sqrt(EI/(rho l^4)), about rho g l^4/(8 EI)."""
    period = 2 * pi / (1.8751041**2 * sqrt(10 / 0.5))
    run = solve(CANTILEVER.format(end=10 * period, gravity=-0.1, damping=0))
    y = run["POINT_MASS/20.y"]
    rising = np.flatnonzero((y[:-1] < y.mean()) & (y[1:] >= y.mean()))
    assert (run.time[rising[-1]] - run.time[rising[0]]) / (len(rising) - 1) == pytest.approx(
        period, rel=5e-3
    )
    assert y.mean() == pytest.approx(-0.5 * 0.1 / 80, rel=2e-2)


def test_a_damped_cantilever_comes_to_rest_at_its_sag() -> None:
    """rho g l^4/(8 EI) and, clamped, rho g l on the support."""
    run = solve(CANTILEVER.format(end=5, gravity=-0.1, damping=0.05))
    assert run["POINT_MASS/20.y"][-1] == pytest.approx(-0.5 * 0.1 / 80, rel=3e-3)
    assert run["REQUEST/10.F3"][-1] == pytest.approx(-0.5 * 0.1, rel=1e-6)


def test_a_straight_rope_that_resists_bending_falls_as_one() -> None:
    run = solve(ADRIFT.format(more="bending = 50", height=0))
    assert run["POINT_MASS/1005.y"][-1] == pytest.approx(-G / 2, rel=1e-7)
    assert run["POINT_MASS/10.y"][-1] == pytest.approx(-G / 2, rel=1e-7)


def test_a_rope_that_enters_water_is_carried_by_what_is_below_the_surface() -> None:
    """In the air it falls by g, deep below by g (rho - displaced)/rho."""
    displaced = 1000 * pi / 4 * 0.04**2
    for height, share in ((1e3, 0), (-1e3, 1)):
        run = solve(ADRIFT.format(more="[water]\ndensity = 1000\nlevel = 0", height=height))
        fall = run["POINT_MASS/1005.y"][-1] - height
        assert fall == pytest.approx(-G / 2 * (1 - share * displaced / 2), rel=1e-6)


def test_a_current_carries_a_rope_along_until_it_goes_with_it() -> None:
    """(rho + m) v' = k (U - v)^2: 1/(U - v) grows by k t/(rho + m), along z."""
    displaced = 1000 * pi / 4 * 0.04**2
    more = "[water]\ndensity = 1000\nbuoyancy = false\nadded_mass = 0.5\ncurrent = [0, 0, 2]\n"
    text = ADRIFT.format(more=more + "drag = { normal = 1 }", height=0)
    run = solve(text.replace("error", "gravity = [0, 0, 0]\nerror"))
    rate = 1000 * 0.04 / 2 / (2 + 0.5 * displaced)
    assert run["POINT_MASS/1003.vz"][-1] == pytest.approx(2 - 1 / (0.5 + rate), rel=1e-6)


def test_tangential_drag_stops_a_rope_that_runs_along_itself() -> None:
    """rho v' = -pi Ct rho_w D/2 v^2."""
    more = "[water]\ndensity = 1000\nbuoyancy = false\ncurrent = [2, 0, 0]\n"
    more += "drag = { normal = 1, tangential = 0.01 }"
    run = solve(ADRIFT.format(more=more, height=0).replace("error", "gravity = [0, 0, 0]\nerror"))
    rate = pi * 0.01 * 1000 * 0.04 / 2 / 2
    assert run["POINT_MASS/1003.vx"][-1] == pytest.approx(2 - 1 / (0.5 + rate), rel=1e-6)


def test_friction_of_the_bed_holds_a_rope_against_the_current() -> None:
    """It slides where drag is more than mu times its weight: mu w = k (U - v)^2 at last."""
    more = "[water]\ndensity = 1000\nbuoyancy = false\ncurrent = [0, 0, 2]\n"
    more += "drag = { normal = 1 }\n[bed]\nlevel = -0.02\nstiffness = 2e4\ndamping = 400\n"
    text = ADRIFT.format(more=more + "friction = 0.5", height=0).replace("end = 1", "end = 8")
    run = solve(text)
    weight, drag = 2 * G, 1000 * 0.04 / 2
    assert run["POINT_MASS/1003.vz"][-1] == pytest.approx(2 - sqrt(0.5 * weight / drag), rel=1e-4)
    assert run["POINT_MASS/1003.y"][-1] == pytest.approx(-weight / 2e4, rel=1e-4)


TAUT = """\
end = 1
[cable]
EA = 1e6
rho = 0.5
pretension = 10000
bending = {bending}
[[route]]
kind = "fixed"
at = [0, 0, 0]
[[route]]
kind = "mass"
at = [5, 0, 0]
mass = 3
[[route]]
kind = "fixed"
at = [10, 0, 0]
"""


def head(spec: str) -> str:
    """The comment at the top of the deck, in one line."""
    return " ".join(deck(spec)[0].replace("! ", "").split())


@pytest.mark.parametrize(("bending", "size"), [(10, "0.00032"), (1000, "0.032"), (1e5, "0.79")])
def test_bending_is_kept_where_more_than_the_accuracy_is_lost_without_it(
    bending: float, size: str
) -> None:
    """8 EI/(T l^2) (1 - 1/cosh(l/(2 b))) of the sag of a span of l = 5 m, b = sqrt(EI/T): 1e-2 is
    asked for.
    """
    words = head(TAUT.format(bending=bending))
    assert f"without it its sag is {size} off" in words
    assert ("bending kept" in words) == ("VFORCE/bend" in words) == (bending > 10)


def test_bending_counts_more_at_a_clamp_and_over_a_wheel() -> None:
    """4 b/l = 4 sqrt(1e-3)/5 of the sag; EI/(2 T R^2) = 2000/(2 9810 0.5^2) of the tension."""
    clamped = TAUT.format(bending=10).replace("[0, 0, 0]\n", "[0, 0, 0]\nclamped = [1, 0, 0]\n")
    assert "without it its sag beside a clamp is 0.025 off" in head(clamped)
    hoist = HOIST.replace("rho = 4", "rho = 4\nbending = 2000")
    assert "without it tension over wheels is 0.41 off" in head(hoist)


def test_bending_keeps_the_energy_of_a_cantilever() -> None:
    """Kinetic energy, EI/2 of the squares of the curvatures, weight, stretch: their sum stays."""
    run = solve(CANTILEVER.format(end=1, gravity=-5, damping=0))
    n, h = 20, 0.05
    names = [f"POINT_MASS/{1000 + k}" for k in range(1, n)] + ["POINT_MASS/20"]
    x, y, vx, vy = (
        np.array([run[f"{name}.{c}"] for name in names]) for c in ("x", "y", "vx", "vy")
    )
    masses = np.full(n, 0.5 * h)
    masses[-1] /= 2
    still = np.zeros_like(run.time)
    xs, ys = np.vstack([still, x]), np.vstack([still, y])
    bent = np.diff(xs, 2, axis=0) ** 2 + np.diff(ys, 2, axis=0) ** 2
    stretched = np.hypot(np.diff(xs, axis=0), np.diff(ys, axis=0)) - h
    stored = 10 / (2 * h**3) * (bent.sum(0) + 2 * y[0] ** 2) + 1e5 / h / 2 * (stretched**2).sum(0)
    kinetic = masses @ (vx**2 + vy**2) / 2
    weight = 5 * masses @ y
    assert np.ptp(kinetic + stored + weight) < 1e-4 * np.max(kinetic)


def test_a_weight_bends_a_cantilever_to_the_elastica() -> None:
    """P l^2/EI = 1: 0.30172 l down, 0.05643 l back (K. Mattiasson, Int. J. Numer. Methods Eng. 17
    (1981) 145); its own weight is a thousandth of P and adds 3/8 of that."""
    text = CANTILEVER.format(end=12, gravity=-10, damping=0.15).replace("rho = 0.5", "rho = 1e-3")
    text = text.replace('kind = "free"', 'kind = "mass"\nmass = 1').replace("steps = 800\n", "")
    run = solve(text.replace("elements = 20", "elements = 40").replace("error = 1e-9\n", ""))
    assert run["POINT_MASS/20.y"][-1] == pytest.approx(-0.30172, rel=2e-3)
    assert 1 - run["POINT_MASS/20.x"][-1] == pytest.approx(0.05643, rel=3e-3)


#: A rope of 10 sections that hangs from a hook 2 m above the water or the ground.
HANGING = """\
end = 40
error = 1e-8
[cable]
EA = 1e6
rho = 2
diameter = 0.04
damping = 0.5
{more}
[[route]]
kind = "fixed"
at = [0, 2, 0]
[[route]]
kind = "{kind}"
at = [{end}]
[model]
level = 2
elements = 10
"""


def test_the_surface_crosses_a_section_that_stands_upright() -> None:
    """The hook carries rho g l less rho_w A g of what is below, l a quarter of a section apart from
    a node; the step of the share is 0.094 of a section off there.
    """
    level = 2 - 5.25
    more = f"[water]\ndensity = 1000\nlevel = {level}"
    run = solve(HANGING.format(more=more, kind="free", end="0, -8, 0"))
    lifted = 1000 * pi / 4 * 0.04**2 * G
    load = 2 * 10 * G - lifted * (10 - 5.25)
    assert run["REQUEST/10.F3"][-1] == pytest.approx(-load, abs=0.11 * lifted)


def test_the_half_section_at_a_hook_in_the_air_has_its_whole_weight() -> None:
    more = "[water]\ndensity = 1000\nlevel = -90"
    run = solve(HANGING.format(more=more, kind="free", end="0, -8, 0"))
    assert run["REQUEST/10.F3"][-1] == pytest.approx(-2 * 10 * G, rel=1e-3)


def test_a_cable_that_is_too_short_starts_with_its_tension() -> None:
    """EA (10/9.99 - 1) = 1001 N at every point, without weight; its waves are those of it."""
    text = HANGING.format(more="length = 9.99", kind="fixed", end="10, 2, 0")
    text = text.replace("end = 40", "end = 0.1\ngravity = [0, 0, 0]")
    assert "at 1001 N" in head(text)
    run = solve(text)
    assert run["REQUEST/1.F2"] == pytest.approx(1e6 * (10 / 9.99 - 1), rel=1e-6)


def test_a_cable_that_hangs_through_starts_on_the_ground() -> None:
    """14 m between points 10 m apart, the ground 3 m below them: no node starts below it."""
    more = "length = 14\n[bed]\nlevel = -1\nstiffness = 1e4"
    text, _ = deck(HANGING.format(more=more, kind="fixed", end="10, 2, 0"))
    heights = [float(y) for y in re.findall(r"POINT_MASS/\d+.*QG=[^,]+,([^,]+),", text)]
    assert len(heights) == 9
    assert min(heights) == pytest.approx(-1 + 0.02, abs=1e-9)


def test_bending_damps_a_cantilever_at_its_clamp_too() -> None:
    """x" + w^2 c x' + w^2 x = 0 falls by exp(-w^2 c t/2), with w = 1.8751^2 sqrt(EI/(rho l^4))."""
    damping, w = 2e-3, 1.8751041**2 * sqrt(10 / 0.5)
    run = solve(CANTILEVER.format(end=3, gravity=-0.1, damping=damping))
    y = run["POINT_MASS/20.y"] + 0.5 * 0.1 / 80
    peaks = np.flatnonzero((y[1:-1] > y[:-2]) & (y[1:-1] > y[2:])) + 1
    rates = np.diff(np.log(y[peaks])) / np.diff(run.time[peaks])
    assert np.mean(rates) == pytest.approx(-(w**2) * damping / 2, rel=0.03)


#: A rope that hangs from an end which is raised out of the water, 0.3 m/s at most.
RAISED = """\
end = 12
steps = 240
statics = true
error = 1e-7
[cable]
EA = 1e6
rho = 2
diameter = 0.04
damping = 0.5
[water]
density = 1000
level = 0
[[route]]
kind = "fixed"
at = [0, -1, 0]
motion = ["0", "3*STEP5(TIME,0,0,10,1)", "0"]
[[route]]
kind = "free"
at = [0, -11, 0]
[model]
level = 2
elements = 10
"""


def test_an_end_that_leaves_the_water_loses_what_the_water_carried_there() -> None:
    """rho g l less the buoyancy of what is below the surface: all at first, 8 of 10 m at last."""
    run = solve(RAISED)
    carried = 1000 * pi / 4 * 0.04**2 * G
    for name in ("REQUEST/1.F2", "REQUEST/10.F6"):
        assert run[name][0] == pytest.approx(2 * G * 10 - carried * 10, rel=1e-4)
        rest = run[name][run.time > 11].mean()
        assert rest == pytest.approx(2 * G * 10 - carried * 8, rel=3e-3)

"""Events between the ends of a step: windows, thin layers, dead zones, zones of smooth steps.

Closed forms: a force F over the length d changes the energy by F d; a mass between contacts keeps
it.  Where there is none, RK4 with steps of 2e-6 (contacts) or DOP853 over the branches one by one.
"""

from __future__ import annotations

from math import acos, log, pi, sqrt

import numpy as np
import pytest
from pytest import approx
from scenes import GROUND, done, options, system
from tiers import every

from adamslite.errors import UsageError
from adamslite.results.results import Results

FORMULAS = ("GSTIFF", "GSTIFF I3", "HHT", "NEWMARK", "RADAU", "ABAM", "RKF45")
# What a test of velocities holds to ERROR per step.
ACCURATE = ("GSTIFF", "GSTIFF I3", "RADAU", "ABAM", "RKF45")
DECK = (
    GROUND
    + "{gravity}POINT_MASS/2, MASS=1, CM=2, QG={x},{y},0, VX={v}\nMARKER/2, POINT_MASS=2\n"
    + "VFORCE/1, I=2, J_PART=1, {force}\nEND\n"
)


def ended(
    formula: str, force: str, end: float, steps: int, error: float, **start: float
) -> Results:
    """The results of a point mass of 1 kg on which a force acts."""
    gravity = "ACCGRAV/JGRAV=-9.81\n" if "FY" in force else ""
    deck = DECK.format(**{"x": 0, "y": 0, "v": 0} | start, force=force, gravity=gravity)
    return done(deck, end, steps, **options(formula, error))


# ---- windows: v^2 = v0^2 - 2 F d -----------------------------------------------------------------

JUMPS = [
    ("FX=IF(ABS(DX(2)-5)-.01:-1000,0,0)", 10.0, sqrt(100.0 - 2 * 1000 * 0.02)),
    ("FX=IF(ABS(DX(2)+3)-.02:400,0,0)", -7.0, -sqrt(49.0 - 2 * 400 * 0.04)),
]
SMOOTH = [
    ("FX=-1000*(STEP(DX(2),4.99,0,4.995,1)-STEP(DX(2),5.005,0,5.01,1))", 10.0, sqrt(70.0)),
    ("FX=400*(STEP(DX(2),-3.02,0,-3.01,1)-STEP5(DX(2),-2.99,0,-2.98,1))", -7.0, -5.0),
    ("FX=-1000*(HAVSIN(DX(2),4.99,0,4.995,1)-HAVSIN(DX(2),5.005,0,5.01,1))", 10.0, sqrt(70.0)),
]


@pytest.mark.parametrize("steps", every(3, [10, 100, 1000]))
@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize(("force", "v", "exact"), JUMPS)
def test_a_force_window_narrower_than_a_step(formula, steps, force, v, exact):
    """|x - 5| < 0.01 is passed at 10 m/s; steps are up to 1 s long."""
    last = ended(formula, force, 10.0, steps, 1e-6, v=v)
    assert last["POINT_MASS/2.vx"][-1] == approx(exact, abs=1e-4)
    assert last.summary["events"] == 3


@pytest.mark.parametrize("formula", ("GSTIFF", "GSTIFF I3", "HHT", "RADAU", "ABAM"))
@pytest.mark.parametrize(("half", "v"), [(10.0, 10e3), (3.0, -10e3)])
def test_a_window_in_millimetres(formula, half, v):
    """20 J are taken away within 20 mm or 6 mm, 5 m from the origin; without constraints nothing
    hands round-off of these 5000 on to the velocities, and first steps may be short.
    """
    force = f"FX=IF(ABS(ABS(DX(2))-5000)-{half}:{-np.sign(v) * 1e4 / half},0,0)"
    units = "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n"
    deck = DECK.format(x=0, y=0, v=v, force=force, gravity=units)
    last = done(deck, 1.0, 10, **options(formula))
    assert last["POINT_MASS/2.vx"][-1] / 1000 == approx(np.sign(v) * sqrt(60.0), abs=1e-4)


@pytest.mark.parametrize("aside", every(2, [0.0, 40.0]))
@pytest.mark.parametrize(("unit", "length"), [(1.0, "METER"), (1000.0, "MILLIMETER")])
@pytest.mark.parametrize("formula", ("GSTIFF", "HHT", "RADAU", "ABAM"))
@pytest.mark.parametrize(("half", "v"), [(0.01, 10.0), (0.003, -10.0)])
def test_a_window_on_a_rail(formula, half, v, unit, length, aside):
    """The same on a rail, whose constraint hands round-off of places on to velocities: 5 m along it
    and up to 40 m beside it, in metres and in millimetres.
    """
    deck = f"""Rail
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={length}, TIME=SECOND
PART/1, GROUND
MARKER/1, PART=1, QP=0,{aside * unit},0, REULER=90D,90D,0
MARKER/4, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1, QG=0,{aside * unit},0, VX={v * unit}
MARKER/2, PART=2, REULER=90D,90D,0
JOINT/1, TRANSLATIONAL, I=2, J=1
VFORCE/1, I=2, J_PART=1, RM=4
, FX=IF(ABS(ABS(DX(2,4,4))-{5 * unit})-{half * unit}:{-np.sign(v) * 10 / half},0,0)
END
"""
    last = done(deck, 1.0, 10, integrator=formula, error=1e-6)
    assert last["PART/2.vx"][-1] / unit == approx(np.sign(v) * sqrt(60.0), abs=1e-4)


@pytest.mark.parametrize("steps", every(3, [10, 100, 1000]))
@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize(("force", "v", "exact"), SMOOTH)
def test_a_smooth_window_narrower_than_a_step(formula, steps, force, v, exact):
    """Zones of 5 mm passed at 10 m/s.  NEWMARK with its usual GAMMA is of order 1: some 500
    steps of ERROR, all of one sign; the summary says so.
    """
    last = ended(formula, force, 10.0, steps, 1e-6, v=v)
    assert last["POINT_MASS/2.vx"][-1] == approx(exact, abs=5e-4 if formula == "NEWMARK" else 1e-4)


@pytest.mark.parametrize("steps", [3, 10])
@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize(("radius", "beside", "v"), [(0.01, 0.003, 9.0), (0.05, -0.02, -15.0)])
def test_a_ball_that_is_passed_closely(formula, steps, radius, beside, v):
    """A pull of 0.3 m v^2/2 over the chord of a ball 5 m away, which is met in long steps.

    The distance falls and rises again with almost a kink, which no cubic through its ends has.
    """
    chord = 2.0 * sqrt(radius**2 - beside**2)
    force = f"FX=IF(DM(2,9)-{radius}:{-0.15 * v * abs(v) / chord},0,0)"
    marker = f"MARKER/9, PART=1, QP={np.sign(v) * 5.0},0,0\n"
    deck = DECK.format(x=0, y=beside, v=v, force=force, gravity=marker)
    last = done(deck, 1.3, steps, **options(formula))
    assert last["POINT_MASS/2.vx"][-1] == approx(v * sqrt(0.7), abs=2e-4)


NARROW = [
    ("FX=IF(SIN(DX(2))-.9999:0,0,-1000)", 0, 10.0, -1000 * 2 * acos(0.9999)),
    ("FX=IF(.9998-SIN(-DX(2)):700,0,0)", 0, -10.0, -700 * 2 * acos(0.9998)),
    ("FX=IF((DX(2)-1.3)**4-1E-7:-1000,0,0)", 0, 10.0, -1000 * 2 * 1e-7**0.25),
    ("FX=IF((DX(2)+2.1)**4-3E-7:300,0,0)", -0.4, -8.0, -300 * 2 * 3e-7**0.25),
    ("FX=IF(EXP(-(DX(2)-1.3)**2*4)-.999:0,0,-1000)", 0, 10.0, -1000 * sqrt(-log(0.999))),
    ("FX=IF(EXP(-(DX(2)+1.7)**2*2)-.998:0,0,400)", 0.2, -9.0, -400 * sqrt(-2 * log(0.998))),
    ("FX=IF((DX(2)-5)**2-.012907**2:-2231.14,0,0)", 0.692148, 11.5466, -2231.14 * 2 * 0.012907),
    ("FX=IF((DX(2)+4)**2-.02**2:1500,0,0)", -0.5, -12.0, -1500 * 2 * 0.02),
]


@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize(("force", "x", "v", "work"), NARROW)
def test_a_window_of_a_guard_that_is_no_cubic(formula, force, x, v, work):
    """Windows of some centimetres in functions of order 4 and more, met at 10 m/s in steps of up
    to 0.2 s; v^2 = v0^2 + 2 W.

    With the force of the inside held a step can also lead out at the far side and back in again.
    """
    exact = np.sign(v) * sqrt(v * v + 2 * work)
    for steps in (2, 4, 20, 50):
        last = ended(formula, force, 0.465888, steps, 1e-6, x=x, v=v)
        assert last["POINT_MASS/2.vx"][-1] == approx(exact, abs=1e-4)
        assert last.summary["events"] == 2


@pytest.mark.parametrize("formula", ("GSTIFF", "HHT", "RADAU", "ABAM"))
def test_a_window_that_is_entered_and_left_on_the_same_side(formula):
    """Thrown up at 10 m/s, the mass reaches 5.09684 m; above 5 m another 20 m/s^2 pull it down.

    The time above is 2 u/(g + 20) in place of 2 u/g, u^2 = 100 - 2 g 5.
    """
    u = sqrt(100.0 - 2 * 9.81 * 5.0)
    landed = 2 * (10.0 - u) / 9.81 + 2 * u / 29.81
    deck = DECK.format(
        x=0, y=0, v="0, VY=10", force="FY=IF(DY(2)-5:0,0,-20)", gravity="ACCGRAV/JGRAV=-9.81\n"
    )
    last = done(deck, landed, 2, integrator=formula, error=1e-6)
    assert last["POINT_MASS/2.y"][-1] == approx(0.0, abs=1e-4)
    assert last.summary["events"] == 2


@pytest.mark.parametrize(("force", "v", "_"), [*JUMPS, *SMOOTH])
def test_equal_steps_refuse_windows_by_name(force, v, _):
    with pytest.raises(UsageError, match=r"cannot run this scene: VFORCE/1 (may jump|rises)"):
        ended("VERLET", force, 10.0, 10, 1e-6, v=v)


# ---- contacts ------------------------------------------------------------------------------------


@pytest.mark.parametrize("error", [1e-8, 1e-10])
@pytest.mark.parametrize("formula", ("GSTIFF", "GSTIFF I3", "HHT", "RADAU", "ABAM"))
@pytest.mark.parametrize(
    ("contact", "y", "exact"),
    [("0,1E5,1,100,1E-3", 0.5, 0.0160004), ("0,4E4,1.5,60,2E-3", 0.3, -0.003918074)],
)
def test_a_damped_contact_pushes_again_before_release(formula, error, contact, y, exact):
    """While the damping goes to zero towards the surface the force comes back in a layer of 0.1 mm,
    after a time in which it was clipped: y at t = 1, by RK4 with steps of 2e-6.  HHT, of order 2,
    adds up 11 000 steps of ERROR.
    """
    force = f"FY=IMPACT(DY(2),VY(2),{contact})"
    last = ended(formula, force, 1.0, 10, error, y=y)
    allowed = 1e-4 if error == 1e-8 and formula == "HHT" else 1e-5
    assert last["POINT_MASS/2.y"][-1] == approx(exact, abs=allowed)


@pytest.mark.parametrize("formula", ACCURATE)
def test_a_dead_zone_turned_over_while_it_holds_the_force_at_zero(formula):
    """Springs of 7000 N/m behind a gap of 0.07 m on both sides, let go at 0.4 m; x at t = 2."""
    gap, reach, w = 0.07, 0.33, sqrt(7000.0)
    half = pi / w + 2 * gap / (w * reach)
    left = 2.0 % (2 * half)
    assert abs(left - half) < 0.5 * pi / w
    exact = -(gap + reach * np.cos(w * (left - half)))
    assert exact == approx(-0.388718, abs=1e-6)
    force = "FX=-7000*MAX(ABS(DX(2))-0.07,0)*SIGN(1,DX(2))"
    error = 1e-8 if formula.startswith("GSTIFF") else 1e-6
    last = ended(formula, force, 2.0, 10, error, x=0.4)
    assert last["POINT_MASS/2.x"][-1] == approx(exact, abs=1e-4)
    depth = np.maximum(np.abs(last["POINT_MASS/2.x"]) - gap, 0.0)
    energy = last["POINT_MASS/2.vx"] ** 2 / 2 + 3500 * depth**2
    assert energy == approx(3500 * reach**2, rel=5e-5 if error == 1e-8 else 1e-5)


@pytest.mark.parametrize("formula", ("GSTIFF", "RADAU", "ABAM"))
def test_events_at_tight_error_converge(formula):
    """Eight bounces with damping of a ball that falls 0.5 m; y at t = 3 by its closed branches."""
    force = "FY=IF(DY(2):-1E5*DY(2)-30*VY(2),0,0)"
    off = []
    for error in (1e-6, 1e-8, 1e-10, 1e-12):
        last = ended(formula, force, 3.0, 10, error, y=0.5)
        off.append(abs(last["POINT_MASS/2.y"][-1] - bounced(3.0)))
        assert last.summary["events"] == 16
    assert off[0] < 1e-4 and off[1] < 1e-5 and max(off[2:]) < 1e-7
    assert off[2] <= max(off[0], 1e-9) and off[3] <= max(off[1], 1e-9)


def bounced(end: float, k: float = 1e5, c: float = 30.0, g: float = 9.81) -> float:
    """Height of a ball of 1 kg dropped from 0.5 m onto k, c, which may pull while it is below 0."""
    from scipy.integrate import solve_ivp

    def below(t, y):
        return [y[1], -g - k * y[0] - c * y[1]]

    def surface(t, y):
        return y[0]

    t, state = sqrt(2 * 0.5 / g), [0.0, -sqrt(2 * 0.5 * g)]
    surface.terminal, surface.direction = True, 1
    while True:
        path = solve_ivp(below, (t, t + 1), state, "DOP853", events=surface, rtol=1e-13, atol=1e-15)
        t, u = path.t_events[0][0], path.y_events[0][0][1]
        if t + 2 * u / g > end:
            return u * (end - t) - g * (end - t) ** 2 / 2
        t, state = t + 2 * u / g, [0.0, -u]


@pytest.mark.parametrize("formula", ACCURATE)
@pytest.mark.parametrize(("stiffness", "v"), [("1E8,1.1", 33.3), ("2E7,1.5", -12.0)])
def test_elastic_stops_keep_the_speed(formula, stiffness, v):
    """330 contacts of 0.5 ms between stops two metres apart."""
    last = ended(formula, f"FX=BISTOP(DX(2),VX(2),-1,1,{stiffness},0,1E-3)", 10.0, 10, 1e-6, v=v)
    assert abs(last["POINT_MASS/2.vx"][-1]) == approx(abs(v), rel=0.01)


# ---- what is watched -----------------------------------------------------------------------------


def test_zones_are_those_of_smooth_steps_of_the_state():
    deck = DECK.format(x=0, y=0, v=0, gravity="", force="FX={}")
    found = {
        force: [len(each) for each in system(deck.format(force)).guarded.values()]
        for force in ("STEP(DX(2),0,0,1,1)", "STEP(TIME,0,0,1,1)", "IMPACT(DX(2),VX(2),0,1,1,1,1)")
    }
    assert list(found.values()) == [[0, 0, 1], [2, 0, 0], [0, 2, 1]]


# ---- zones are expected --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("force", "start", "end", "iterations"),
    [
        ("FX=-9*DX(2)-0.5*STEP(VX(2),-0.01,-1,0.01,1)", {"x": 2}, 6.0, 1200),
        ("FX=-DX(2)+5*(STEP(DX(2),0.3,0,0.31,1)-STEP(DX(2),0.33,0,0.34,1))", {"v": 1}, 12.0, 1300),
    ],
)
def test_few_steps_are_tried_in_vain_at_zones(force, start, end, iterations):
    """Friction that turns over in six zones of the speed, and a window with smooth edges: when
    steps met zones only once they had been made, GSTIFF took 2549 and 1821 iterations.
    """
    run = ended("GSTIFF", force, end, 60, 1e-6, **start)
    exact = ended("RADAU", force, end, 60, 1e-10, **start)
    assert run["POINT_MASS/2.x"] == approx(exact["POINT_MASS/2.x"], abs=1e-4)
    assert run.summary["newton"] <= iterations

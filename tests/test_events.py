"""Events: edges in time are stops, changes of branch with the state are located."""

from __future__ import annotations

from math import asin, pi, sqrt

import numpy as np
import pytest
from pytest import approx
from scenes import DAMPER, GROUND, PENDULUM, TEETER, carriage, done, options, run, system

from adamslite.analyses.clock import changes
from adamslite.analyses.clock import stops as stops_module
from adamslite.analyses.clock.clock import Clock
from adamslite.analyses.clock.stops import stops
from adamslite.results.outcomes import Outcome

MASS = GROUND + "POINT_MASS/2, MASS={mass}, CM=2, QG={x},0,0, VX={v}\nMARKER/2, POINT_MASS=2\n"
ERRORS = (1e-3, 1e-5, 1e-7)
FORMULAS = ("GSTIFF", "GSTIFF I3", "HHT", "NEWMARK", "RADAU", "RKF45")


def moved_by(force: str, mass: float = 1.0, x: float = 0.0, v: float = 0.0) -> str:
    """A point mass on which a force acts along x."""
    return MASS.format(mass=mass, x=x, v=v) + f"VFORCE/1, I=2, J_PART=1, FX={force}\nEND\n"


def stops_of(force: str, end: float, steps: int) -> list[float]:
    return stops(system(moved_by(force)), np.linspace(0.0, end, steps + 1)).tolist()


# ---- edges in time -------------------------------------------------------------------------------


def test_changes_that_are_too_many_are_reported_and_not_all_found(monkeypatch) -> None:
    """A square wave changes 20 times a second; searched for a while, it is given up."""
    monkeypatch.setattr(changes, "MOST", 64)
    monkeypatch.setattr(stops_module, "MOST", 64)
    run_of = system(moved_by("IF(MOD(TIME,0.1)-0.05: 1,-1,-1)"))
    found, overfull = stops_module.edges(run_of, Clock(run_of.kernels), np.array([0.0, 1e3]))
    assert len(found) < 2000 and {each.label for each in overfull} == {"VFORCE/1"}


@pytest.mark.parametrize("error", ERRORS)
@pytest.mark.parametrize("formula", (*FORMULAS, "VERLET"))
def test_a_pulse_of_a_hundredth_between_output_times_is_seen(formula, error):
    """1000 N on 1 kg for 10 ms: v = 10, x = 10 (1 - 0.505); outputs are 0.1 apart."""
    force = "IF(TIME-0.503: 0, 0, IF(TIME-0.513: 1000, 0, 0))"
    last = done(moved_by(force), 1.0, **options(formula, error))
    assert last["POINT_MASS/2.vx"][-1] == approx(10.0, rel=1e-4)
    assert last["POINT_MASS/2.x"][-1] == approx(10.0 * (1.0 - 0.508), rel=1e-4)
    assert last.summary["events"] == 2


@pytest.mark.parametrize("formula", (*FORMULAS, "VERLET"))
def test_a_square_wave_of_ten_hertz(formula):
    """+-10 N on 1 kg: every period adds 10 (0.05)^2 = 0.025; at the end it rests."""
    deck = moved_by("10*SIGN(1,VARVAL(7))").replace(
        "END", "VARIABLE/7, FUNCTION=SIN(20*PI*TIME)\nEND"
    )
    last = done(deck, 1.0, **options(formula, 1e-5))
    assert last["POINT_MASS/2.x"][-1] == approx(0.25, abs=1e-5 * 0.25)
    assert last["POINT_MASS/2.vx"][-1] == approx(0.0, abs=1e-5)
    assert last.summary["events"] == 19


@pytest.mark.parametrize("formula", ("GSTIFF", "GSTIFF I3", "HHT", "RADAU", "RKF45", "VERLET"))
def test_a_saw_tooth(formula):
    """10 MOD(TIME, 0.1) on 1 kg: v = 0.5 after ten teeth, each adds 0.05 and 1/600 to x."""
    last = done(moved_by("10*MOD(TIME,0.1)"), 1.0, **options(formula, 1e-8))
    assert last["POINT_MASS/2.vx"][-1] == approx(0.5, rel=1e-3)
    assert last["POINT_MASS/2.x"][-1] == approx(10 / 600 + 0.05 * 0.1 * 45, rel=1e-3)


def test_stops_are_the_zeros_of_guards_of_time():
    assert stops_of("IF(TIME-0.5: 1, 2, 3)", 1.0, 10) == [0.5, 1.0]
    assert stops_of("STEP(TIME,0.2,0,0.3,1)+MAX(0,TIME-0.3)", 1.0, 10) == approx([0.2, 0.3, 1.0])
    assert stops_of("SIGN(1,SIN(2*PI*TIME)-0.5)", 1.0, 4) == approx([1 / 12, 5 / 12, 1.0])
    assert stops_of("MOD(TIME,0.25)", 1.0, 4) == [0.25, 0.5, 0.75, 1.0]
    assert stops_of("INT(4*TIME)", 1.0, 4) == [0.25, 0.5, 0.75, 1.0]
    assert stops_of("NINT(4*TIME)", 1.0, 4) == approx([0.125, 0.375, 0.625, 0.875, 1.0])
    assert stops_of("ABS(TIME)+IF(TIME-1: 0, 1, 1)+MAX(TIME,-1)", 1.0, 4) == [1.0]
    assert stops_of("STEP(DX(2),0,0,1,1)", 1.0, 4) == [1.0]


def test_stops_are_found_where_the_grid_is_coarse():
    """2000 changes between 5 output times; a peak above zero for a 3000th of the run."""
    assert len(stops_of("SIGN(1,COS(2000*PI*TIME))", 1.0, 4)) == 2001
    narrow = stops_of("MAX(0,COS(2*PI*(TIME-0.7123))-0.9999995)", 1.0, 4)
    assert narrow == approx([0.7123 - 1.5915e-4, 0.7123 + 1.5915e-4, 1.0], abs=1e-7)


@pytest.mark.parametrize("formula", (*FORMULAS, "VERLET"))
def test_an_edge_at_the_start_an_output_time_and_the_end(formula):
    """v = t until 0.5, then 2 (t - 0.5) + 0.5; the edges at 0 and 1 are none inside the run."""
    force = "IF(TIME: 9, 9, IF(TIME-0.5: 1, 1, IF(TIME-1: 2, 2, 9)))"
    last = done(moved_by(force), 1.0, **options(formula, 1e-6))
    assert last["POINT_MASS/2.vx"][[5, 10]] == approx([0.5, 1.5], rel=1e-5)
    assert last.summary["events"] == 1


def test_accelerations_written_at_an_edge_are_those_before_it():
    last = done(moved_by("IF(TIME-0.5: 1, 1, 3)"), 1.0)
    assert last["POINT_MASS/2.ax"][4:7] == approx([1.0, 1.0, 3.0], rel=1e-9)


def test_the_end_of_a_step_is_a_stop_without_a_new_start():
    last = done(moved_by("STEP(TIME,0.2,0,0.3,1)"), 1.0)
    assert last.summary["events"] == 2
    assert last.summary["restarts"] == 0


def test_a_motion_that_bends():
    """A carriage moved by STEP: it stands, and no step passes over the ramp of 1 ms."""
    free = "PART/3, MASS=1, CM=4, IP=1,1,1\nMARKER/4, PART=3\n"
    last = done(carriage("STEP(TIME,0.5,0,0.501,0.1)", free), 1.0)
    assert last["PART/2.x"][-1] == approx(0.1, abs=1e-6)
    assert last["PART/2.vx"][-1] == approx(0.0, abs=1e-4)


# ---- changes with the state ----------------------------------------------------------------------

M, K, DROP, G = 100.0, 1e6, 0.5, 9.81
SLACK = {
    "MAX": "MAX(0,-1E6*DX(2))",
    "IF": "IF(DX(2): -1E6*DX(2), 0, 0)",
    "IMPACT": "IMPACT(DX(2),VX(2),0,1E6,1,0,0.001)",
}


def snatch(force: str) -> str:
    """A mass that falls into a line which pulls only when it is taut, x upwards from taut."""
    lines = moved_by(force, mass=M, x=DROP).replace("END", f"ACCGRAV/IGRAV={-G}\n")
    energy = f"{M / 2}*VX(2)**2+{M * G}*DX(2)+{K / 2}*MIN(0,DX(2))**2"
    return lines + f"REQUEST/1, F2={energy}\\F3={force}\nEND\n"


@pytest.mark.parametrize(
    ("formula", "error"), [("GSTIFF", 1e-6), ("HHT", 1e-8), ("RADAU", 1e-6), ("RKF45", 1e-5)]
)
@pytest.mark.parametrize("law", SLACK)
def test_ten_bounces_on_a_slack_line(law, formula, error):
    """T_max = M g (1 + sqrt(1 + 2 k H/(M g))) = 32317.28, period 0.67059300."""
    w, sag = sqrt(K / M), M * G / K
    depth = sqrt(sag**2 + 2.0 * DROP * sag)
    period = (pi + 2.0 * asin(sag / depth)) / w + 2.0 * sqrt(2.0 * DROP / G)
    assert period == approx(0.670593, rel=1e-6)
    last = done(snatch(SLACK[law]), 10 * period, 1000, **options(formula, error))
    energy = last["REQUEST/1.F2"]
    assert np.abs(energy / energy[0] - 1.0).max() < 1e-3
    assert last["POINT_MASS/2.x"][-1] == approx(DROP, abs=1e-3 * DROP)
    peak = max(done(snatch(SLACK[law]), 0.35, 3500, **options(formula, error))["REQUEST/1.F3"])
    assert peak == approx(32317.28, rel=1e-3)
    assert last.summary["events"] == 20


def test_an_elastic_contact():
    """k x^1.5, which has no value on the other side, gives back the energy of the fall."""
    last = done(
        moved_by("1E7*MAX(0,-DX(2))**1.5", x=0.1).replace("END", f"ACCGRAV/IGRAV={-G}\nEND"),
        0.25, 25, error=1e-7,
    )  # fmt: skip
    energy = last["POINT_MASS/2.vx"] ** 2 / 2 + G * last["POINT_MASS/2.x"]
    assert energy[-1] == approx(G * 0.1, rel=1e-4)


@pytest.mark.parametrize("error", [1e-3, 1e-5])
@pytest.mark.parametrize("stiffness", [1e6, 1e8, 1e10])
@pytest.mark.parametrize("formula", ["GSTIFF", "RADAU", "RKF45", "VERLET"])
def test_a_hard_wall_that_is_met_at_an_output_time(formula, stiffness, error):
    """2 m/s there at t = 0.15, within round-off, and back after 4 ms to 40 us: pi sqrt(m/k)."""
    wall = moved_by(f"IMPACT(DX(2),VX(2),0,{stiffness},1,0,1E-4)", mass=1.5, x=0.3, v=-2)
    last = done(wall, 0.3, 2, **options(formula, error))
    assert last["POINT_MASS/2.vx"][-1] == approx(2.0, rel=0.03)


@pytest.mark.parametrize("beside", ["", "DIFF/1, FUNCTION=DX(2)**3\n"])
@pytest.mark.parametrize("steps", [1, 7])
@pytest.mark.parametrize("formula", ["GSTIFF", "RADAU", "RKF45"])
def test_a_step_far_into_a_cubic_wall_is_none(formula, steps, beside):
    """1.61 kg at 5.55 m/s: stages of a long first step would be beyond all numbers.

    Alone, and where accelerations are solved for.
    """
    wall = moved_by("IMPACT(DX(2),VX(2),0,7.53E11,3,0,1E-4)", mass=1.61, x=1.3, v=-5.55)
    last = done(wall.replace("END", f"{beside}END"), 0.468, steps, **options(formula, 1e-3))
    assert last["POINT_MASS/2.vx"][-1] == approx(5.55, rel=0.02)


@pytest.mark.parametrize("law", ["{k}*MAX(0,-{x})**1.5", "IMPACT({x},WZ(2,1),0,{k},2.2,0,1E-4)"])
@pytest.mark.parametrize("formula", ["GSTIFF", "RADAU", "RKF45"])
def test_a_part_that_turns_against_a_stop(formula, law):
    """7.8 rad/s against a stop of 1e9 N m at 67 degrees, met at an output time, and back."""
    scene = GROUND + (
        "PART/2, MASS=3.6, CM=20, IP=0.01,0.02,0.03, WZ=-7.8, VY=-10.92\nMARKER/2, PART=2\n"
        "MARKER/20, PART=2, QP=1.4,0,0\nJOINT/1, REVOLUTE, I=2, J=1\n"
        f"SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION={law.format(k='1.069E9', x='(AZ(2,1)+1.17)')}\n"
        "END\n"
    )
    last = done(scene, 1.0, 20, **options(formula, 1e-3))
    assert last["PART/2.wz"][-1] == approx(7.8, rel=0.03)


@pytest.mark.parametrize("beside", ["", "DIFF/1, FUNCTION=DX(2)\n"])
@pytest.mark.parametrize("law", ["1E6*MAX(0,-DX(2))**1.5", "IF(DX(2): 1E6*ABS(DX(2))**2.2, 0, 0)"])
@pytest.mark.parametrize("formula", ["GSTIFF", "HHT", "RADAU", "RKF45"])
def test_a_power_that_has_no_value_before_the_change(formula, law, beside):
    """Met at an output time, within round-off, on the side where a root is that of less than 0."""
    scene = moved_by(law, x=0.2, v=-2).replace("END", f"{beside}END")
    for steps in (2, 4):
        last = done(scene, 0.2, steps, **options(formula, 1e-4))
        assert last["POINT_MASS/2.vx"][-1] == approx(2, rel=0.07)


@pytest.mark.parametrize(("stiffness", "mass"), [(2.1e9, 0.322), (6.2e8, 0.297)])
def test_equal_steps_that_leave_a_wall_have_felt_it(stiffness, mass):
    """18 m/s there and back: contacts of 40 to 70 us, where ERROR allows steps of 200 us."""
    wall = moved_by(f"{stiffness}*DIM(0,DX(2))", mass=mass, x=1.5, v=-18)
    for steps in (1, 4, 9):
        last = done(wall, 3 / 18, steps, **options("VERLET", 1e-3))
        assert last["POINT_MASS/2.vx"][-1] == approx(18, rel=0.03)


@pytest.mark.parametrize(
    ("place", "speed", "contact"),
    [(10, 18, 5e-5), (30, 18, 5e-5), (300, 50, 1e-6), (10, 2e-4, 1.0), (300, 0.08, 4e-3)],
)
def test_equal_steps_that_leave_a_wall_far_away_or_slowly_have_felt_it(place, speed, contact):
    """1.5 there and back, in contact for a time that is far shorter than what ERROR allows.  The
    step that leaves the wall has the largest error against the place, and ends out of contact.
    """
    stiffness, way = (pi / contact) ** 2, 3 / speed
    wall = moved_by(f"-{stiffness}*DIM(DX(2),{place})", x=place - 1.5, v=speed)
    for steps in (1, 4, 9):
        last = done(wall, way + contact, steps, **options("VERLET", 1e-3))
        assert last["POINT_MASS/2.vx"][-1] == approx(-speed, rel=0.03)


@pytest.mark.parametrize(
    ("formula", "error"), [("GSTIFF", 1e-7), ("HHT", 1e-8), ("RADAU", 1e-6), ("RKF45", 1e-5)]
)
def test_a_spring_that_is_stiffer_on_one_side(formula, error):
    """k = 100 and 400: half periods pi/10 and pi/20, ten of each bring x = 0, v = 1 back."""
    last = done(
        moved_by("-IF(DX(2): 100, 100, 400)*DX(2)", v=1.0),
        10 * (pi / 10 + pi / 20), **options(formula, error),
    )  # fmt: skip
    assert last["POINT_MASS/2.x"][-1] == approx(0.0, abs=2e-4)
    assert last["POINT_MASS/2.vx"][-1] == approx(1.0, abs=1e-3)


@pytest.mark.parametrize("formula", FORMULAS)
def test_a_force_that_always_points_to_the_middle(formula):
    """-8 SIGN(x): parabolas; from x = 1 it returns after 4 sqrt(2/8) = 2."""
    last = done(moved_by("-8*SIGN(1,DX(2))", x=1.0), 8.0, **options(formula, 1e-7))
    assert last["POINT_MASS/2.x"][-1] == approx(1.0, abs=1e-4)
    assert last.summary["events"] == 8


@pytest.mark.parametrize(
    ("formula", "error"), [("GSTIFF", 1e-7), ("HHT", 1e-8), ("RADAU", 1e-6), ("RKF45", 1e-6)]
)
def test_a_pendulum_that_swings_into_a_spring(formula, error):
    """Released level, with a torsion spring of 200 N m/rad from the lowest posture on; of the
    energy m g y + (m L^2 + I) w^2/2 + k a^2/2 = 0 less than 1e-3 of m g L may get lost.  It turns
    round at m g L cos a = k a^2/2, a = 0.4230.
    """
    past = "MAX(0,-PI/2-AZ(3,1))"
    energy = f"19.62*DY(2)+1.15*WZ(2)**2+100*{past}**2"
    deck = PENDULUM.replace(
        "END",
        f"SFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION=200*{past}\n"
        f"REQUEST/1, F2={energy}\\F3={past}\nEND",
    )
    last = done(deck, 3.0, 300, **options(formula, error))
    assert np.abs(last["REQUEST/1.F2"]).max() < 1e-3 * 19.62
    assert last["REQUEST/1.F3"].max() == approx(0.4230, abs=1e-3)
    assert last.summary["events"] == 4


def test_max_and_min_at_zero_in_both_directions():
    """-100 MAX(x, 0) - 100 MIN(x, 0) is a plain spring."""
    last = done(moved_by("-100*MAX(DX(2),0)-100*MIN(DX(2),0)", v=1.0), pi / 5, error=1e-7)
    assert last["POINT_MASS/2.x"][-1] == approx(0.0, abs=1e-5)


def test_two_at_once():
    """Two guards that change together, one of them the other way."""
    force = "IF(DX(2)-0.5: 1, 1, -1)+IF(0.5-DX(2): 2, 1, 1)"
    last = done(moved_by(force, v=1.0), 1.0, error=1e-7)
    reached = sqrt(2.0) - 1.0
    v = sqrt(1.0 + 2.0 * 2.0 * 0.5)
    left = 1.0 - (v - 1.0) / 2.0
    assert last.summary["events"] == 1
    assert last["POINT_MASS/2.vx"][-1] == approx(v + left, rel=1e-5)
    assert reached < 1.0


def test_one_that_begins_on_the_edge():
    """x = 0 at the start, the other branch from the first moment on."""
    last = done(moved_by("IF(DX(2): 0, 0, -2)", v=1.0), 0.5, error=1e-6)
    assert last["POINT_MASS/2.vx"][-1] == approx(0.0, abs=1e-5)


def test_in_and_out_within_one_step():
    """A wall of 2 mm that pushes: entered and left between two output times, v^2 += 2 f d."""
    force = "IF(DX(2)-0.5: 0, 0, IF(DX(2)-0.502: 100, 0, 0))"
    for formula in FORMULAS:
        last = done(moved_by(force, v=1.0), 1.0, 10, **options(formula, 1e-6))
        v = sqrt(1.0 + 2.0 * 100.0 * 0.002)
        assert last["POINT_MASS/2.vx"][-1] == approx(v, rel=1e-4), formula


@pytest.mark.parametrize("error", (1e-5, 1e-6, 1e-9))
@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize("way", (1, -1))
def test_a_force_that_ends_at_zero_where_a_step_does(formula, error, way):
    """x" = 5 (x - 1) (3 - x) from x = 1 on, with x' = 1: in free flight the run ends at x = 3,
    where the force is zero again.  And mirrored.
    """
    x, sign = ("DX(2)", "") if way > 0 else ("(-DX(2))", "-")
    force = f"{sign}IF({x}-1: 0, 0, 5*({x}-1)*(3-{x}))"
    last = done(moved_by(force, v=float(way)), 3.0, 1, **options(formula, error))
    # Methods of order 2 are off by the power 2/3 of ERROR, NEWMARK with its damping by the half.
    power = {"HHT": 2 / 3, "NEWMARK": 1 / 2}.get(formula, 1)
    band = 1e-8 + 200 * error if power == 1 else 5 * error**power
    assert last["POINT_MASS/2.x"][-1] * way == approx(2.11474552568, abs=band)


@pytest.mark.parametrize("formula", ["GSTIFF", "RADAU", "RKF45"])
def test_floors_of_the_state(formula):
    """x climbs stairs of AINT, v' = -AINT(10 x), and falls down them again: v^2/2 + U = 1/2 with
    U = m (m - 1)/20 + m (x - m/10) on stair m.
    """
    results = done(moved_by("-AINT(10*DX(2))", v=1.0), 1.0, **options(formula, 1e-7))
    x, v = results["POINT_MASS/2.x"], results["POINT_MASS/2.vx"]
    stair = np.floor(10 * x)
    assert stair.max() == 3 and stair[-1] < 3
    energy = v**2 / 2 + stair * (stair - 1) / 20 + stair * (x - stair / 10)
    np.testing.assert_allclose(energy, 0.5, atol=1e-5)
    assert results.summary["events"] > 3


SLIDER = (
    GROUND
    + """PART/2, MASS=1, CM=2, IP=1,1,1, VX=1
MARKER/2, PART=2, REULER=90D,90D,0
MARKER/3, PART=1, REULER=90D,90D,0
JOINT/1, TRANSLATIONAL, I=2, J=3
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=3, FUNCTION={push}
END
"""
)


@pytest.mark.parametrize("error", [1e-4, 1e-7])
@pytest.mark.parametrize("formula", [*FORMULAS, "ABAM"])
@pytest.mark.parametrize(
    ("push", "rest"),
    [("-2*SIGN(1,{v})", 1 / 4), ("8*SIN(2*TIME)-10*SIGN(1,{v})", 0.05304)],
)
def test_dry_friction_written_with_sign_is_never_wrong_in_silence(formula, error, push, rest):
    """It comes to rest, at x = 1/4 where nothing else pushes; then both branches lead back to the
    change.  Free and on a joint, by every method and formulation.
    """
    free = moved_by(push.format(v="VX(2)"), v=1.0)
    guided = SLIDER.format(push=push.format(v="VZ(2,3,3)"))
    for deck, guilty, x in ((free, "VFORCE/1", "POINT_MASS/2.x"), (guided, "SFORCE/1", "PART/2.x")):
        last = run(deck, 1.0, 50, **options(formula, error))
        assert last.outcome is Outcome.CHATTERING
        assert f"{guilty} (" in last.message
        assert last.summary["steps"] < 500 or formula == "NEWMARK"
        assert last[x][-1] == approx(rest, abs=0.02)


def test_a_smooth_scene_has_no_guards_but_a_zone():
    scene = system(moved_by("-STEP(DX(2),0,0,1,1)"))
    assert [len(found) for found in scene.guarded.values()] == [0, 0, 1]
    assert system(moved_by("-SIN(DX(2))")).numbering.kind.size == 0


# ---- branches that decide nothing ----------------------------------------------------------------


@pytest.mark.parametrize("formula", ("GSTIFF", "GSTIFF I3", "HHT", "RADAU", "RKF45"))
def test_a_branch_that_round_off_decides_is_no_chatter(formula):
    """A hinge that a MOTION keeps at zero: the damper behind the IF has nothing to damp.

    The body turns about z; with theta = 0 only the sum of psi and phi is known, and but for turns.
    """
    runs = [
        done(GROUND + TEETER + law + "END\n", 0.5, **options(formula, 1e-3)) for law in ("", DAMPER)
    ]
    free, damped = (np.exp(1j * (run["PART/3.psi"] + run["PART/3.phi"])) for run in runs)
    assert np.abs(damped - free).max() < 5e-3

"""CONTACT in motion: impacts, however short; what holds, slides and rolls; commands."""

from __future__ import annotations

import numpy as np
import pytest
from decklets import codes

import adamslite as al
from adamslite.reading.read import read, read_commands

METHODS = ("GSTIFF, SI2", "GSTIFF, I3", "WSTIFF", "HHT", "NEWMARK", "RADAU", "ABAM", "RKF45")
BALLS = """Two balls in a space without gravity; the first one flies along x
UNITS/SYSTEM={system}
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS={m}, CM=2, IP=1,1,1, QG={x},{y},0, VX={v}
MARKER/2, PART=2
GRAPHICS/2, ELLIPSOID, CM=2, XS={d}, YS={d}, ZS={d}
PART/3, MASS={big}, CM=3, IP=1,1,1
MARKER/3, PART=3
GRAPHICS/3, ELLIPSOID, CM=3, XS={d}, YS={d}, ZS={d}
CONTACT/1, IGEOM=2, JGEOM=3, POISSON, PENALTY={p}, RESTITUTION={e}
INTEGRATOR/{method}, ERROR={error}
END
"""


def balls(method: str, error: float = 1e-6, **other: object) -> str:
    numbers = {"system": "MKS", "m": 0.1, "big": 0.3, "x": -50, "y": 0, "v": 100, "d": 0.02}
    return BALLS.format(**numbers | {"p": "1E9", "e": 0.6} | other, method=method, error=error)


@pytest.mark.parametrize("e", [0.0, 0.6, 1.0])
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "RKF45"])
def test_an_impact_has_the_stated_restitution(method: str, e: float) -> None:
    """Central, of 0.1 and 0.3 kg at 100 m/s; it lasts 30 microseconds in a second of flight.

    v2 = (m - e M)/(m + M) v,  v3 = (1 + e) m/(m + M) v;  for e = 0 it ends with a 1/1000 of v.
    """
    results = al.simulate(read(balls(method, 1e-8, e=e)), end=1, steps=2)
    close = 0.2 if e == 0 else 1e-3
    assert results["PART/2.vx"][-1] == pytest.approx(25 - 75 * e, abs=close)
    assert results["PART/3.vx"][-1] == pytest.approx(25 * (1 + e), abs=close)


@pytest.mark.parametrize("error", [1e-4, 1e-6, 1e-7, 1e-9])
@pytest.mark.parametrize("x", [-50, -50.003])
def test_centres_that_would_meet_where_a_step_ends(error: float, x: float) -> None:
    """In free flight both centres are in one place at t = 0.5, an output: there is no normal."""
    results = al.simulate(read(balls("RADAU", error, e=0, x=x)), end=1, steps=2)
    assert results["PART/2.vx"][-1] == pytest.approx(25, abs=0.2)


@pytest.mark.parametrize("penalty", ["1E6", "1E8", "1E9"])
@pytest.mark.parametrize("method", ["GSTIFF", "HHT", "RADAU", "RKF45", "ABAM"])
def test_a_contact_gives_no_energy(method: str, penalty: str) -> None:
    """1 and 3 kg, e = 0.6, ERROR larger than the depth: v2 = (m - e M)/(m + M) v = -0.6 m/s.

    A long step leads far out of a stiff contact. HHT tests no velocities: within a tenth of v.
    """
    scene = balls(method, 1e-3, m=1, big=3, x=-0.4, v=3, d=0.2, p=penalty)
    results = al.simulate(read(scene), end=0.5, steps=50)
    close = 0.3 if method == "HHT" else 0.05
    assert results["PART/2.vx"][-1] == pytest.approx(-0.6, abs=close)


@pytest.mark.parametrize("system", ["MKS", "CGS", "IPS"])
def test_restitution_in_any_units(system: str) -> None:
    results = al.simulate(read(balls("RADAU", 1e-8, system=system, e=0.5)), end=1, steps=2)
    assert results["PART/2.vx"][-1] == pytest.approx(-12.5, abs=1e-3)


def test_momentum_is_conserved_however_the_balls_meet() -> None:
    """Beside the middle, with friction: of both momenta, and about the origin."""
    rough = ", COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.2"
    rough += ", STICTION_TRANSITION_VELOCITY=0.1, FRICTION_TRANSITION_VELOCITY=1"
    deck = balls("RADAU", 1e-8, y=0.013).replace("\nINTEGRATOR", f"{rough}\nINTEGRATOR")
    got = al.simulate(read(deck.replace("IP=1,1,1", "IP=1E-5,1E-5,1E-5")), end=1, steps=2)
    ends = [
        [sum(m * got[f"PART/{n}.v{axis}"][k] for n, m in ((2, 0.1), (3, 0.3))) for axis in "xyz"]
        for k in (0, -1)
    ]
    assert ends[1] == pytest.approx(ends[0], abs=1e-9)
    spins = [
        sum(
            m * (got[f"PART/{n}.x"][k] * got[f"PART/{n}.vy"][k]
                 - got[f"PART/{n}.y"][k] * got[f"PART/{n}.vx"][k])
            + 1e-5 * got[f"PART/{n}.wz"][k]
            for n, m in ((2, 0.1), (3, 0.3))
        )
        for k in (0, -1)
    ]  # fmt: skip
    assert spins[1] == pytest.approx(spins[0], abs=1e-9)
    assert abs(got["PART/2.wz"][-1]) > 1


@pytest.mark.parametrize("method", METHODS)
def test_no_contact_is_too_short_to_be_seen(method: str) -> None:
    """Balls that graze each other by 10 um to 1 mm between outputs."""
    rng = np.random.default_rng(2)
    for _ in range(20):
        overlap, speed = 10 ** rng.uniform(-5, -3), 10 ** rng.uniform(0.5, 2.5)
        start, steps = -speed * rng.uniform(0.05, 0.9), int(rng.choice([1, 2, 7]))
        error = 10 ** rng.uniform(-8, -5)
        deck = balls(method, error, x=start, y=0.02 - overlap, v=speed)
        results = al.simulate(read(deck), end=1, steps=steps)
        assert results["PART/2.vy"][-1] > 0, (overlap, speed, start, steps, error)


# --------------------------------------------------------------------------------------- at rest

LYING = """A ball on the floor
UNITS/SYSTEM=MKS
ACCGRAV/KGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
GRAPHICS/1, {floor}
PART/2, MASS=1, CM=2, IP=0.004,0.004,0.004, QG=0,0,{z}
MARKER/2, PART=2
GRAPHICS/2, ELLIPSOID, CM=2, XS=0.2, YS=0.2, ZS=0.2
CONTACT/1, IGEOM={i}, JGEOM={j}, {law}
INTEGRATOR/{method}, ERROR=1E-6
END
"""
IMPACT = "IMPACT, STIFFNESS=1E5, EXPONENT=2.2, DAMPING=100, DMAX=1E-4"
POISSON = "POISSON, PENALTY=1E5, RESTITUTION_COEFFICIENT=0.5"
DEPTH = {IMPACT: (9.81e-5) ** (1 / 2.2), POISSON: 9.81e-5}
FLOORS = {
    "PLANE, RM=1": 0.0,
    "BOX, CORNER=1, X=1, Y=1, Z=-1": 0.0,
    "BOX, CORNER=1, X=-1, Y=-1, Z=0.2": 0.2,
    "CYLINDER, CM=1, LENGTH=0.3, RADIUS=0.5": 0.3,
    "CYLINDER, CM=1, LENGTH=-0.3, RADIUS=0.5": 0.0,
    "ELLIPSOID, CM=1, XS=2, YS=2, ZS=2": 1.0,
}


@pytest.mark.parametrize("law", [IMPACT, POISSON])
@pytest.mark.parametrize("floor", FLOORS)
def test_a_ball_comes_to_rest(floor: str, law: str) -> None:
    """From a height of 1 cm, both ways to write it, in dynamics and in statics."""
    top = FLOORS[floor] + 0.1
    for i, j, sign in ((2, 1, 1), (1, 2, -1)):
        deck = LYING.format(floor=floor, i=i, j=j, law=law, method="GSTIFF", z=top + 0.01)
        got = al.simulate(read(deck), end=5, steps=3)
        assert got["PART/2.z"][-1] == pytest.approx(top - DEPTH[law], abs=1e-6)
        assert got["CONTACT/1.fz"][-1] == pytest.approx(9.81 * sign, rel=1e-3)
        lying = top - 0.9 * DEPTH[law]
        deck = LYING.format(floor=floor, i=i, j=j, law=law, method="GSTIFF", z=lying)
        still = al.simulate(read(deck.replace("END\n", "SIMULATE/STATIC\nEND\n")))
        assert still["PART/2.z"][-1] == pytest.approx(top - DEPTH[law], abs=1e-6)


# -------------------------------------------------------------------------------------- commands


def test_a_contact_is_switched_and_changed() -> None:
    """It falls through while the contact is off; a stiffer contact lets it sink in less."""
    deck = read(LYING.format(floor="PLANE, RM=1", i=2, j=1, law=POISSON, method="GSTIFF", z=0.1))
    off = "DEACTIVATE/CONTACT, ID=1\nSIMULATE/DYNAMIC, END=0.1, STEPS=1\n"
    got = al.simulate(deck, commands=read_commands(off, deck))
    assert got["PART/2.z"][-1] == pytest.approx(0.1 - 9.81 * 0.01 / 2, abs=1e-6)
    assert got["CONTACT/1.fz"][-1] == 0
    stiffer = "CONTACT/1, PENALTY=1E6\nSIMULATE/STATIC\n"
    got = al.simulate(deck, commands=read_commands(stiffer, deck))
    assert got["CONTACT/1.depth"][-1] == pytest.approx(9.81e-6, rel=1e-3)
    moved = "GRAPHICS/2, XS=0.3, YS=0.3, ZS=0.3\nSIMULATE/STATIC\n"
    commands = read_commands(moved, deck)
    assert commands.warnings == ()
    got = al.simulate(deck, commands=commands)
    assert got["PART/2.z"][-1] == pytest.approx(0.15 - 9.81e-5, rel=1e-6)


# --------------------------------------------------------------------------------------- warnings


@pytest.mark.parametrize(
    ("words", "listed"),
    [
        ("IMPACT, STIFFNESS=1, EXPONENT=1, DAMPING=0, DMAX=1, PENALTY=2", ["no-effect"]),
        ("POISSON, PENALTY=1, RESTITUTION=1, MU_STATIC=1", ["no-effect"]),
        ("POISSON, PENALTY=1, RESTITUTION=1, STICTION=OFF", []),
        ("POISSON, PENALTY=1, RESTITUTION=2", ["out-of-range"]),
        ("POISSON, PENALTY=-1, RESTITUTION=1", ["not-positive"]),
        ("IMPACT, STIFFNESS=1, EXPONENT=1, DAMPING=-1, DMAX=1", ["negative"]),
        ("POISSON, PENALTY=1, RESTITUTION=1, TYPE=SOLID_TO_SOLID", ["passed-over"]),
    ],
)
def test_what_is_said_of_a_contact(words: str, listed: list[str]) -> None:
    shapes = "GRAPHICS/1, POINT, RM=2\nGRAPHICS/2, PLANE, RM=1"
    assert codes(f"{shapes}\nCONTACT/1, IGEOM=1, JGEOM=2, {words}") == listed


def test_a_point_mass_can_be_a_smooth_ball() -> None:
    ball = "GRAPHICS/1, ELLIPSOID, CM=3, XS=1, YS=1, ZS=1\nGRAPHICS/2, PLANE, RM=1"
    smooth = f"{ball}\nCONTACT/1, IGEOM=1, JGEOM=2, POISSON, PENALTY=1, RESTITUTION=1"
    rough = ", COULOMB_FRICTION=ON, MU_STATIC=2, MU_DYNAMIC=1, STICTION_TRANSITION_VELOCITY=1"
    assert codes(smooth) == []
    assert codes(f"{smooth}{rough}, FRICTION_TRANSITION_VELOCITY=2") == ["torque-on-point"]

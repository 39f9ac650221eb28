"""Elements that a run carries beyond the range of their law are reported once, with the time."""

from __future__ import annotations

import re
from math import acos, pi

import numpy as np
import pytest
from scenes import GROUND, run

from adamslite import read, simulate
from adamslite.reading.read import read_commands

TUMBLING = GROUND + (
    "PART/2, MASS=1, CM=2, IP=1,1,1, {spin}\nMARKER/2, PART=2\n"
    "JOINT/1, SPHERICAL, I=2, J=1\n{element}\nEND\n"
)
BUSHING = "BUSHING/1, I=2, J=1, KT={k},{k},{k}"
FIELD = "FIELD/1, I=2, J=1, KMATRIX=" + ",".join(
    "{k}" if r == c and r > 2 else "0" for r in range(6) for c in range(6)
)
INTEGRATORS = ("GSTIFF", "RADAU", "HHT", "ABAM")


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize(("element", "k", "w"), ((BUSHING, 4.0, 5.0), (FIELD, 1.0, -3.0)))
def test_a_bushing_past_a_quarter_turn_is_told_at_the_time(element, k, w, integrator):
    """theta = w/omega sin(omega t), omega**2 = k: 90 degrees at sin(omega t) = pi/2 omega/w.

    About x of J; the first accepted step past it is reported.
    """
    deck = TUMBLING.format(spin=f"WX={w}", element=element.format(k=k))
    results = run(deck, 1.2, 400, integrator=integrator, error=1e-7)
    told = results.meta["out of its law"]
    label = element.split(",")[0]
    assert told.count(label) == 1
    found = float(re.fullmatch(rf"{label} turned past 90 degrees .*, first at t = (.*)", told)[1])
    omega = k**0.5
    exact = (pi / 2 - acos(pi / 2 * omega / abs(w))) / omega
    assert exact <= found < exact + 0.1


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_what_stays_within_its_law_is_not_told(integrator):
    """A small swing about x; any turn about z; a turn about x where nothing resists one."""
    for spin, element in (
        ("WX=0.5", BUSHING.format(k=1)),
        ("WZ=9", BUSHING.format(k=1)),
        ("WX=9", "BUSHING/1, I=2, J=1, K=1,1,1, KT=0,0,5"),
    ):
        deck = TUMBLING.format(spin=spin, element=element)
        assert "out of its law" not in run(deck, 1.0, 2, integrator=integrator).meta


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_run_that_begins_again_in_space_forgets_the_turns_of_the_first_try(integrator):
    """In the plane of its spin the bushing passes 90 degrees, AY jumps and the plane is left: the
    second run starts with AY = 0 and follows (w/omega) sin(omega t) up to there.
    """
    deck = TUMBLING.format(spin="WX=5", element=BUSHING.format(k=4))
    deck = deck.replace("END\n", "REQUEST/1, F1=AX(2,1)\\F2=AY(2,1)\nEND\n")
    results = run(deck, 1.2, 12, integrator=integrator, error=1e-8)
    early = results.time < 0.33
    exact = 2.5 * np.sin(2 * results.time[early])
    assert results["REQUEST/1.F1"][early] == pytest.approx(exact, abs=1e-5)
    assert results["REQUEST/1.F2"][early] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("element", ("SPRINGDAMPER/1, ROTATIONAL, I=2, J=1, KT=1", "SFORCE/1,"))
def test_turns_are_kept_when_an_element_is_switched(element):
    """Wound up by 4 rad/s for 2 s: AZ goes on from 8 rad when another element is switched off."""
    if element == "SFORCE/1,":
        element = "SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=-AZ(2,1)"
    deck = read(
        GROUND + "PART/2, MASS=1, CM=2, IP=1E6,1E6,1E6, WZ=4\nMARKER/2, PART=2\n"
        f"JOINT/1, REVOLUTE, I=2, J=1\n{element}\nVFORCE/9, I=2, J_PART=1, FX=0\n"
        f"REQUEST/1, F1=AZ(2,1)\\F2={element[: element.index('/')].replace('SPRINGDAMPER', 'SPDP')}"
        "(1,0,8)\nEND\n"
    )
    commands = "SIMULATE/DYNAMIC, END=2, STEPS=2\nDEACTIVATE/VFORCE, ID=9\n"
    commands += "SIMULATE/DYNAMIC, END=3, STEPS=1\n"
    results = simulate(deck, commands=read_commands(commands, deck), error=1e-8)
    assert results["REQUEST/1.F1"][-1] == pytest.approx(12.0, abs=1e-3)
    assert results["REQUEST/1.F2"][-1] == pytest.approx(-12.0, abs=1e-3)


WINCH = (
    "title\nPART/1, GROUND\nMARKER/1, PART=1\nACCGRAV/JGRAV=-9.81\n"
    "VARIABLE/L, FUNCTION=(1+{a}*TIME**2/2)/4\n"
    + "".join(
        f"POINT_MASS/{k}, MASS={5 if k == 5 else 0.5}, CM={k}, QG=0,{-(k - 1) / 4},0\n"
        f"MARKER/{k}, POINT_MASS={k}\n"
        f"SFORCE/{k}, I={k}, J={k - 1}, FUNCTION=-{{only}}1E5*(DM({k},{k - 1})/L-1)"
        f"+20*VR({k},{k - 1}))\n"
        for k in range(2, 6)
    )
    + "END\n"
)


@pytest.mark.parametrize("integrator", ("GSTIFF", "RADAU", "HHT", "ABAM", "VERLET"))
@pytest.mark.parametrize(("a", "pulls_only"), ((15.0, False), (15.0, True), (3.0, False)))
def test_a_cable_paid_out_faster_than_free_fall_is_told_to_push(a, pulls_only, integrator):
    """Four sections of a hanging cable grow with a: above g the masses are pushed down."""
    deck = WINCH.format(a=a, only="MAX(0," if pulls_only else "(")
    results = run(deck, 0.3, 60, integrator=integrator, error=1e-5)
    told = results.meta.get("out of its law", "")
    assert ("sections of a cable pushed" in told) == (a > 9.81 and not pulls_only)
    assert ("MAX(0, pull)" in told) == bool(told)

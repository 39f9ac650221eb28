"""FRICTION at rest: what holds, what creeps, and what commands change about it."""

from __future__ import annotations

import pytest
from decklets import codes

from adamslite.analyses.simulation import simulate
from adamslite.checks.rules import check
from adamslite.deck.deck import Deck
from adamslite.model.model import assemble
from adamslite.reading.read import read, read_commands
from adamslite.results.results import Results

# A slope of tan = 0.4 for a coefficient of 0.8: half of what friction can hold.
SLOPE = """a block on a slope, g = (4, 0, -10)
UNITS/SYSTEM=MKS
ACCGRAV/IGRAV=4, KGRAV=-10
PART/1, GROUND
MARKER/1, PART=1, REULER=90D,90D,0
PART/2, MASS=2, CM=2, IP=0.01,0.01,0.01
MARKER/2, PART=2, REULER=90D,90D,0
JOINT/1, TRANSLATIONAL, I=2, J=1
FRICTION/1, JOINT=1, MU_STATIC=0.8, MU_DYNAMIC=0.6{}
"""
GIVE = ", MAX_STICTION_DEFORMATION=1e-4"


def slope(arguments: str) -> Deck:
    return read(SLOPE.format(arguments))


def run(deck: Deck, end: float = 1.0) -> Results:
    return simulate(assemble(deck), end=end, steps=50, error=1e-7)


def test_a_block_at_rest_stays_with_a_bristle_and_creeps_without() -> None:
    """x = D tan/MU_STATIC for good; else speed u vs with tan/MU_STATIC = u (3 - u^2)/2."""
    x = run(slope(GIVE))["PART/2.x"]
    assert x[25:] == pytest.approx(0.5e-4, abs=2e-8)
    speed = run(slope(""))["PART/2.vx"][-1]
    assert speed == pytest.approx(0.0347296355334, abs=1e-6)


def test_friction_at_rest_is_what_the_load_asks_for() -> None:
    found = run(slope(GIVE))
    assert found["FRICTION/1.fx"][-1] == pytest.approx(-8.0, abs=1e-3)
    assert found["DIFF/FRICTION_1"][-1] == pytest.approx(0.5, abs=1e-4)


@pytest.mark.parametrize("kind", ["CYLINDRICAL", "SPHERICAL"])
def test_joints_that_cannot_hold_are_told(kind: str) -> None:
    joint = f"JOINT/1, {kind}, I=2, J=1\nFRICTION/1, JOINT=1"
    assert codes(joint) == ["friction-creeps"]
    assert codes(joint + GIVE) == ["no-effect"]
    assert codes(joint + ", EFFECT=SLIDING") == []


def test_nothing_is_told_of_a_joint_that_holds() -> None:
    assert check(slope(GIVE)) == []
    assert [each.code for each in check(slope(""))] == ["friction-creeps"]


def test_a_command_lets_a_joint_hold() -> None:
    """The state comes with the argument, and goes with the friction."""
    deck = slope("")
    (command,) = read_commands("FRICTION/1, MAX_STICTION_DEFORMATION=1e-4\n", deck)
    held = deck.after(command)
    assert [each.key for each in held.of("DIFF")] == ["FRICTION_1"]
    assert run(held)["PART/2.x"][-1] == pytest.approx(0.5e-4, abs=2e-8)
    released = run(held.with_active("FRICTION", [1], False), end=0.5)
    assert released["PART/2.x"][-1] == pytest.approx(4 * 0.5**2 / 2, abs=1e-6)


def test_nothing_rubs_in_statics() -> None:
    """A block that the bristle held settles on its spring at m g/k, and b = 0."""
    deck = slope(GIVE + "\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=-100*DX(2,1)")
    run_ = "SIM/DYN, END=1, STEPS=2\nSIM/STATICS\nSIM/DYN, END=2, STEPS=2\n"
    found = simulate(deck, commands=read_commands(run_, deck), error=1e-7)
    assert found["PART/2.x"][2] == pytest.approx(0.5e-4, abs=2e-7)
    assert found["PART/2.x"][3:] == pytest.approx(0.08, abs=1e-9)
    assert found.time == pytest.approx([0.0, 0.5, 1.0, 1.0, 1.5, 2.0])
    at_rest = simulate(deck, commands=read_commands(run_.partition("SIM/DYN, END=2")[0], deck))
    assert at_rest.time == pytest.approx([0.0, 0.5, 1.0, 1.0])
    assert at_rest["PART/2.x"][-1] == pytest.approx(0.08, abs=1e-9)
    assert found["DIFF/FRICTION_1"][3:] == pytest.approx(0.0, abs=1e-6)


def test_mode_is_5_in_statics() -> None:
    """A push of 10 N everywhere but in statics: x = m g/k there."""
    push = (
        "\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=-100*DX(2,1)+IF(MODE-5: 10,0,10)"
    )
    deck = slope(push)
    found = simulate(deck, commands=read_commands("SIM/STATICS\n", deck))
    assert found["PART/2.x"][-1] == pytest.approx(0.08, abs=1e-9)

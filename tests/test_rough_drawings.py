"""Machines that are drawn apart: they assemble, and come to the rest of what is meant."""

from __future__ import annotations

from math import pi
from pathlib import Path
from runpy import run_path
from types import SimpleNamespace

import pytest
from scenes import GROUND, run

import adamslite as al
from adamslite import Outcome

TACKLE = Path(__file__).parents[1] / "decks" / "tackle" / "make_reference.py"


@pytest.fixture(scope="module")
def tackle() -> SimpleNamespace:
    """What writes the decks of the tackle."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(TACKLE.parent)
        return SimpleNamespace(**run_path(str(TACKLE)))


def at_rest(tackle, sloppy: tuple[float, float], seed: int) -> float:
    """How far the rope forces of three stages are from 400, 200 and 100 N."""
    results = al.simulate(al.read(tackle.drawn(3, sloppy, seed)))
    assert results.outcome is Outcome.DONE, (sloppy, seed)
    return max(abs(results[name][-1] - force) for name, force in tackle.strands(3).items())


@pytest.mark.parametrize("seed", range(1, 9))
def test_a_tackle_drawn_apart_by_a_tenth_of_its_size_and_20_degrees(tackle, seed: int) -> None:
    assert at_rest(tackle, tackle.ROUGH, seed) < 1e-8


@pytest.mark.slow
def test_a_hundred_drawings_of_the_tackle(tackle) -> None:
    off = {seed: at_rest(tackle, tackle.ROUGH, seed) for seed in range(1, 101)}
    assert max(off.values()) < 1e-8, off


RACK = """PART/2, MASS=1, CM=3, IP=1,1,1, QG={pinion}
MARKER/3, PART=2
MARKER/4, PART=1, QP=0,0,0
JOINT/1, REVOLUTE, I=3, J=4
PART/5, MASS=1, CM=6, IP=1,1,1, QG={rack}
MARKER/6, PART=5, REULER=90D,90D,0
MARKER/7, PART=1, QP=0,-0.1,0, REULER=90D,90D,0
JOINT/2, TRANSLATIONAL, I=6, J=7
JOINT/3, RACKPIN, I=3, J=6, PD=0.2
MOTION/1, JOINT=1, FUNCTION={turn}*TIME
REQUEST/1, F1=DX(6,1)\\F2=AZ(3,4)
END
"""


@pytest.mark.parametrize("turn", (2.0, -0.7))
@pytest.mark.parametrize("apart", ("0,0,0", "0.02,0.3,-0.2", "0.4,-0.8,0.9", "3,2,1"))
def test_a_rack_counts_from_where_the_other_joints_close(apart: str, turn: float) -> None:
    """A rack under a pinion of radius 0.1, both drawn ``apart`` from where they are held: it has
    travelled 0.1 times what the pinion has turned, from where they were put together.

    The rack is drawn at x = 0.05 on its guide, and no joint moves it along.
    """
    x = [float(each) for each in apart.split(",")]
    rack = f"0.05,{-0.1 + x[1]},{x[2]}"
    deck = GROUND + RACK.format(pinion=apart, rack=rack, turn=turn)
    results = run(deck, 1.0, 4, error=1e-8)
    assert results.outcome is Outcome.DONE
    travel = results["REQUEST/1.F1"] - results["REQUEST/1.F1"][0]
    assert travel == pytest.approx([0.1 * turn * t for t in (0, 0.25, 0.5, 0.75, 1)], abs=1e-9)
    assert results["REQUEST/1.F1"][0] == pytest.approx(0.05, abs=1e-9)
    assert results["REQUEST/1.F2"][-1] % (2 * pi) == pytest.approx(turn % (2 * pi), abs=1e-8)


SCREW = """PART/2, MASS=1, CM=3, IP=1,1,1, QG={place}, REULER={turned},0,0
MARKER/3, PART=2
MARKER/4, PART=1
JOINT/1, CYLINDRICAL, I=3, J=4
JOINT/2, SCREW, I=3, J=4, PITCH=0.01
REQUEST/1, F1=DZ(3,4)\\F2=AZ(3,4)
END
"""


@pytest.mark.parametrize("turned", ("0D", "170D", "-100D"))
def test_a_nut_drawn_beside_its_screw_is_put_on_it_without_a_turn(turned: str) -> None:
    """It is 0.3 off the axis and 5 turns up: it goes to the axis, no way along or round it."""
    deck = GROUND + SCREW.format(place="0.3,0,0.05", turned=turned)
    results = run(deck, 0.1, 1, error=1e-8)
    assert results["REQUEST/1.F1"][0] == pytest.approx(0.05, abs=1e-12)
    assert results["REQUEST/1.F2"][0] == pytest.approx(float(turned[:-1]) * pi / 180, abs=1e-9)


def test_what_cannot_be_closed_is_named(tackle) -> None:
    """The block of stage 1 is fixed in two places, 3 m apart."""
    fixed = "".join(
        f"MARKER/{n}, PART=1, QP=0,{y},0\nJOINT/{n}, FIXED, I=100, J={n}\n"
        for n, y in ((98, -3), (99, 0))
    )
    text = tackle.drawn(3, tackle.ROUGH, 2).replace("EQUILIBRIUM", f"{fixed}EQUILIBRIUM")
    results = al.simulate(al.read(text))
    assert results.outcome is Outcome.INITIAL_CONDITIONS_FAILED
    assert results.message.startswith(("JOINT/98 ", "JOINT/99 "))

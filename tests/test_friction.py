"""FRICTION at rest: what holds, and what commands change about it."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
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
LAW = Path(__file__).parents[1] / "decks" / "friction" / "stick_slip.py"
GIVE = ", MAX_STICTION_DEFORMATION=1e-4"
# (15 x - 10 x^3 + 3 x^5)/8 = 1/2
HALF = 0.28112767042070575


def slope(arguments: str) -> Deck:
    return read(SLOPE.format(arguments))


def run(deck: Deck, end: float = 1.0) -> Results:
    return simulate(assemble(deck), end=end, steps=50, error=1e-7)


@pytest.mark.parametrize(("arguments", "give"), [(GIVE, 1e-4), ("", 0.01)])
def test_a_block_at_rest_has_crept_as_far_as_its_load_needs(arguments: str, give: float) -> None:
    """STEP5(x, -1, -1, 1, 1) = tan/MU_STATIC, x = creep/MAX_STICTION_DEFORMATION (default 0.01)."""
    found = run(slope(arguments), end=3.0)
    assert found["PART/2.x"][-1] == pytest.approx(HALF * give, abs=1e-9)
    assert found["FRICTION/1.creep_z"][-1] == pytest.approx(HALF * give, abs=1e-9)
    assert found["FRICTION/1.fz"][-1] == pytest.approx(-8.0, abs=1e-5)
    assert found["FRICTION/1.muz"][-1] == pytest.approx(-0.4, abs=1e-6)
    assert found["FRICTION/1.mu1"][-1] == pytest.approx(0.4, abs=1e-6)


@pytest.mark.parametrize("pull", [-1, 1])
def test_it_breaks_away_where_the_load_exceeds_what_friction_holds(pull: float) -> None:
    """16 N hold 8 N of weight and 8 + pull N more, or not."""
    force = f"\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=STEP(TIME,0,0,1,{8 + pull})"
    found = run(slope(GIVE + force), end=2.0)
    if pull < 0:
        assert found["PART/2.vx"][-1] == pytest.approx(0, abs=1e-6)
        assert found["PART/2.x"][-1] < 1e-4
    else:
        acceleration = np.diff(found["PART/2.vx"][-2:]) / 0.04
        assert acceleration == pytest.approx((8 + 9 - 12) / 2, abs=1e-6)
        assert found["FRICTION/1.creep_z"][-1] == 0
        assert found["FRICTION/1.beta"][-1] == 1


def test_without_stiction_it_slides_on() -> None:
    """Speed u vs with STEP5(u, -1, -1, 1, 1) = 4/(10 MU_DYNAMIC)."""
    found = run(slope(", EFFECT=SLIDING"), end=3.0)
    u = found["PART/2.vx"][-1] / 0.1
    assert (15 * u - 10 * u**3 + 3 * u**5) / 8 == pytest.approx(4 / 6, abs=1e-6)


def test_a_preload_holds_without_a_load() -> None:
    """Only the preload counts: 8 N of weight, 16 N can be held."""
    more = GIVE + ", FRICTION_FORCE_PRELOAD=16, INPUTS=PRELOAD"
    x = run(slope(more))["PART/2.x"][-1]
    assert x == pytest.approx(HALF * 1e-4, abs=1e-9)


@pytest.mark.parametrize(("word", "turn"), [("INCREASE", 1), ("DECREASE", -1), ("CONSTANT", 0)])
def test_the_overlap_changes_with_the_travel(word: str, turn: int) -> None:
    """A weight of 20 N and a torque of 3 Nm across the slide: N = 20 + 3/(1 + turn x)."""
    more = f", INITIAL_OVERLAP=1, OVERLAP_DELTA={word}"
    torque = "\nVTORQUE/1, I=2, JFLOAT=9, RM=1, TX=3\nMARKER/9, PART=1, FLOATING"
    push = "\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=20"
    found = run(slope(more + torque + push), end=0.3)
    load = 20 + 3 / (1 + turn * found["PART/2.x"])
    held = found["FRICTION/1.fz"][1:] / found["FRICTION/1.muz"][1:]
    assert held == pytest.approx(load[1:], rel=1e-9)
    assert found["PART/2.x"][-1] > 0.2


def test_nothing_is_reported_of_a_joint_that_holds() -> None:
    assert check(slope(GIVE)) == check(slope("")) == []
    deck = "JOINT/1, SPHERICAL, I=2, J=1\nFRICTION/1, JOINT=1, EFFECT=SLIDING"
    assert codes(deck) == []
    assert codes(deck + GIVE) == ["no-effect"]


def test_commands_change_a_friction() -> None:
    """The state goes with the friction, and comes again with none of its past."""
    deck = slope("")
    (command,) = read_commands("FRICTION/1, MAX_STICTION_DEFORMATION=1e-4\n", deck)
    held = deck.after(command)
    assert run(held)["PART/2.x"][-1] == pytest.approx(HALF * 1e-4, abs=1e-9)
    released = run(held.with_active("FRICTION", [1], False), end=0.5)
    assert released["PART/2.x"][-1] == pytest.approx(4 * 0.5**2 / 2, abs=1e-6)


TO_AND_FRO = """a block pulled to and fro: it sticks, breaks away, slides and is caught again
UNITS/SYSTEM=MKS
ACCGRAV/KGRAV=-10
PART/1, GROUND
MARKER/1, PART=1, REULER=90D,90D,0
PART/2, MASS=2, CM=2, IP=0.01,0.01,0.01, VX={v0}
MARKER/2, PART=2, REULER=90D,90D,0
JOINT/1, TRANSLATIONAL, I=2, J=1
FRICTION/1, JOINT=1, MU_STATIC={rest}, MU_DYNAMIC={moving}, MAX_STICTION_DEFORMATION={give}
, STICTION_TRANSITION_VELOCITY={vs}, FRICTION_FORCE_PRELOAD={own}
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION={pull}*SIN({w}*TIME)
"""
# The last one creeps to MAX_STICTION_DEFORMATION and back in every half period.
SETS = (
    {"rest": 0.5, "moving": 0.3, "vs": 0.1, "give": 0.01, "pull": 14, "w": 6, "own": 0, "v0": 0},
    {
        "rest": 0.4, "moving": 0.25, "vs": 0.02, "give": 1e-3, "pull": -11, "w": 3, "own": 0.7,
        "v0": -1,
    },
    {"rest": 0.5, "moving": 0.3, "vs": 0.1, "give": 2e-3, "pull": 9.9, "w": 20, "own": 0, "v0": 0},
)  # fmt: skip
# Largest error of position and creep at ERROR = 1e-7; ten times that of the velocity.
BANDS = {"GSTIFF": 1e-5, "RADAU": 1e-6, "ABAM": 1e-5, "HHT": 3e-3}


@pytest.fixture(scope="module")
def piecewise_solutions() -> list[tuple[np.ndarray, np.ndarray]]:
    """The same scalar equations by DOP853, which begins again wherever the regime changes."""
    module = runpy.run_path(str(LAW))
    times = np.linspace(0, 1.5, 31)

    def solved(p: dict[str, float]) -> tuple[np.ndarray, np.ndarray]:
        law = module["Law"](p["rest"], p["moving"], p["vs"], p["give"])

        def rates(t: float, y: np.ndarray, mu: np.ndarray, along: np.ndarray) -> list[float]:
            push = p["pull"] * np.sin(p["w"] * t) - 20 * mu[0] - p["own"] * along[0]
            return [y[1], push / 2]

        return module["solve"](law, lambda y: y[1:], rates, [0, p["v0"]], times, longest=4e-3)

    return [solved(p) for p in SETS]


@pytest.mark.parametrize("method", BANDS)
@pytest.mark.parametrize("n", range(len(SETS)))
def test_to_and_fro(method: str, n: int, piecewise_solutions: list) -> None:
    (x, v), (creep,) = piecewise_solutions[n]
    deck = read(TO_AND_FRO.format(**SETS[n]))
    found = simulate(assemble(deck), end=1.5, steps=30, error=1e-7, integrator=method)
    assert found.outcome.name == "DONE"
    assert found["PART/2.x"] == pytest.approx(x, abs=BANDS[method])
    assert found["PART/2.vx"] == pytest.approx(v, abs=10 * BANDS[method])
    assert found["FRICTION/1.creep_z"] == pytest.approx(creep, abs=BANDS[method])


SPRING = "\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=-100*DX(2,1)"


def test_statics_keep_what_friction_holds() -> None:
    """A block that friction holds is in equilibrium already."""
    deck = slope(GIVE + SPRING)
    run_ = "SIM/DYN, END=1, STEPS=2\nSIM/STATICS\nSIM/DYN, END=2, STEPS=2\n"
    found = simulate(deck, commands=read_commands(run_, deck), error=1e-7)
    assert found.time == pytest.approx([0.0, 0.5, 1.0, 1.0, 1.5, 2.0])
    assert found["PART/2.x"][2:] == pytest.approx(found["PART/2.x"][2], abs=1e-10)
    assert found["FRICTION/1.creep_z"][2:] == pytest.approx(found["PART/2.x"][2], abs=1e-10)


def test_an_inactive_friction_is_absent_in_statics() -> None:
    """The spring alone carries the weight: x = m g/k."""
    deck = slope(GIVE + ", INACTIVE=STATIC" + SPRING)
    run_ = "SIM/DYN, END=1, STEPS=2\nSIM/STATICS\n"
    found = simulate(deck, commands=read_commands(run_, deck), error=1e-7)
    assert found["PART/2.x"][2:] == pytest.approx([HALF * 1e-4, 0.08], abs=1e-7)
    assert found["FRICTION/1.fz"][3] == 0


def test_mode_is_5_in_statics() -> None:
    """A push of 10 N everywhere but in statics: x = m g/k there."""
    push = (
        "\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=-100*DX(2,1)+IF(MODE-5: 10,0,10)"
    )
    deck = slope(push)
    found = simulate(deck, commands=read_commands("SIM/STATICS\n", deck))
    assert found["PART/2.x"][-1] == pytest.approx(0.08, abs=1e-9)


@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "ABAM"])
def test_small_motions_of_a_joint_at_rest(method: str) -> None:
    """m x" = -c v - k D, D' = v about D* with s(D*/Dm) = 1/2: c = 15/8 mu N/vs is the mean of both
    directions, k = 15/8 mu N (1 - (D*/Dm)^2)^2/Dm; the block may rest anywhere.  ERROR is what is
    left of its speed: with 1e-8 m/s one direction counts for more.
    """
    deck = slope("")
    commands = read_commands("SIM/DYN, END=4, STEPS=2\nLINEAR/EIGENSOL\n", deck)
    found = simulate(deck, commands=commands, error=1e-10, integrator=method)
    c, k = 15 / 8 * 16 / 0.1, 15 / 8 * 16 * (1 - HALF**2) ** 2 / 0.01
    slow, fast = np.sort(np.abs(np.roots([2, c, k])))
    modes = np.sort(np.abs(found.linearizations[0].model.eigenvalues))
    assert modes == pytest.approx([0, slow, fast], rel=1e-3, abs=1e-9)


CYCLES = "\nSFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=20*SIN(9*TIME)"


def test_a_state_that_was_saved_continues_as_before() -> None:
    """The creep counts from where sliding ended, also after RELOAD."""
    deck = slope(CYCLES)
    run_ = "SIM/DYN, END=1.3, STEPS=13\n{}SIM/DYN, END=2, STEPS=7\n"
    away = "SAVE/STATES, BUFFER=1\nSIM/DYN, END=1.6, STEPS=5\nRELOAD/STATES, BUFFER=1\n"
    plain, again = (
        simulate(deck, commands=read_commands(run_.format(more), deck), error=1e-8)
        for more in ("", away)
    )
    for name in ("PART/2.x", "PART/2.vx", "FRICTION/1.creep_z"):
        assert again[name][-7:] == pytest.approx(plain[name][-7:], abs=2e-6)
    assert plain["FRICTION/1.creep_z"][13] < -1e-3


def test_a_joint_that_is_switched_off_has_no_friction() -> None:
    """Free fall along the slope and off it, with a preload that would brake it."""
    deck = slope(", FRICTION_FORCE_PRELOAD=6").with_active("JOINT", [1], False)
    found = run(deck, end=0.5)
    assert found["PART/2.x"][-1] == pytest.approx(4 * 0.5**2 / 2, abs=1e-6)
    assert found["FRICTION/1.fz"] == pytest.approx(0.0, abs=0)


@pytest.mark.parametrize("name", ["top", "top-stops"])
@pytest.mark.parametrize(("method", "band"), [("HHT", 5e-4), ("RADAU", 1e-6), ("ABAM", 1e-5)])
def test_a_top_in_a_cup(name: str, method: str, band: float) -> None:
    """The references of decks/friction-ball by other methods; HHT once left by 3 per cent."""
    folder = LAW.parents[1] / "friction-ball"
    reference = Results.load(folder / f"{name}.reference.csv")
    deck = read((folder / f"{name}.adm").read_text(encoding="utf-8"))
    found = simulate(assemble(deck), end=2, steps=40, error=1e-8, integrator=method)
    for axis in "xyz":
        assert found[f"PART/2.w{axis}"] == pytest.approx(reference[f"PART/2.w{axis}"], abs=band)

"""FRICTION, FORMULATION=LUGRE, and the largest friction of either law, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from adamslite.analyses.simulation import simulate
from adamslite.model.model import assemble
from adamslite.reading.read import read, read_commands
from adamslite.results.results import Results

# A block of 2 kg on a slide along x, pressed on it by 20 N.
BLOCK = """a block on a slide with bristles
UNITS/SYSTEM=MKS
ACCGRAV/IGRAV={along}, KGRAV=-10
PART/1, GROUND
MARKER/1, PART=1, REULER=90D,90D,0
PART/2, MASS=2, CM=2, IP=0.01,0.01,0.01, VX={v}
MARKER/2, PART=2, REULER=90D,90D,0
JOINT/1, TRANSLATIONAL, I=2, J=1
FRICTION/1, JOINT=1, {law}
{more}
"""
LUGRE = (
    "FORMULATION=LUGRE, MU_STATIC={rest}, MU_DYNAMIC={moving}, BRISTLE_STIFFNESS={k}"
    ", DAMPING={c}, VISCOUS={f}, VELOCITY_THRESHOLD={w}, DECAY={p}"
)
SETS = (
    {"rest": 0.5, "moving": 0.3, "k": 1000.0, "c": 3.0, "f": 0.4, "w": 0.02, "p": 1.5},
    {"rest": 0.6, "moving": 0.2, "k": 300.0, "c": 0.0, "f": 0.0, "w": 0.05, "p": 2.0},
    {"rest": 0.4, "moving": 0.3, "k": 500.0, "c": 1.0, "f": 0.1, "w": 0.01, "p": 0.5},
)


def block(law: str, more: str = "", v: float = 0.0, along: float = 0.0) -> str:
    return BLOCK.format(law=law, more=more, v=v, along=along)


def run(deck: str, end: float, steps: int = 20, method: str = "GSTIFF") -> Results:
    found = simulate(assemble(read(deck)), end=end, steps=steps, error=1e-8, integrator=method)
    assert found.outcome.name == "DONE"
    return found


def level(s: dict[str, float], speed: float) -> float:
    """g, the coefficient at a constant slip without f."""
    return float(s["moving"] + (s["rest"] - s["moving"]) * np.exp(-((speed / s["w"]) ** s["p"])))


def bent(s: dict[str, float], v: float, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """z and dz/dt after a time t of slip at the speed v."""
    left, end = np.exp(-s["k"] * v * t / level(s, v)), level(s, v) / s["k"]
    return end * (1 - left), v * left


@pytest.mark.parametrize("s", SETS, ids=("fast", "plain", "root"))
@pytest.mark.parametrize("v", [0.01, -0.03])
def test_bristles_bend_at_a_constant_slip(s: dict[str, float], v: float) -> None:
    """z = g/k (1 - exp(-k |v| t/g)) along v, and the force of it."""
    found = run(block(LUGRE.format(**s), f"MOTION/1, JOINT=1, VELOCITY, FUNCTION={v}", v), 0.1)
    z, rate = bent(s, abs(v), found.time)
    mu = np.sign(v) * (s["k"] * z + s["c"] * rate + s["f"] * abs(v))
    assert found["FRICTION/1.creep_z"] == pytest.approx(np.sign(v) * z, abs=1e-9)
    assert found["FRICTION/1.muz"] == pytest.approx(-mu, abs=1e-6)
    assert found["FRICTION/1.mu1"] == pytest.approx(s["k"] * z, abs=1e-6)
    assert found["FRICTION/1.fz"] == pytest.approx(-20 * mu, abs=2e-5)


def test_a_slip_along_and_about_the_axis_is_a_vector() -> None:
    """A sleeve of radius 0.1 at 0.03 along and -0.4 about z: the slip is 0.05, as (3, -4)."""
    s = SETS[0]
    deck = f"""a sleeve on a pin
UNITS/SYSTEM=MKS
ACCGRAV/IGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=2, IP=0.01,0.01,0.01, VZ=0.03, WZ=-0.4
MARKER/2, PART=2
JOINT/1, CYLINDRICAL, I=2, J=1
MOTION/1, JOINT=1, TRANSLATIONAL, VELOCITY, FUNCTION=0.03
MOTION/2, JOINT=1, ROTATIONAL, VELOCITY, FUNCTION=-0.4
FRICTION/1, JOINT=1, PIN_RADIUS=0.1, {LUGRE.format(**s)}
, FRICTION_FORCE_PRELOAD=3, INPUTS=(PRELOAD:REACTION_FORCE)
"""
    found = run(deck, 0.05)
    z, rate = bent(s, 0.05, found.time)
    mu = s["k"] * z + s["c"] * rate + s["f"] * 0.05
    own = 3 * s["k"] * z / level(s, 0.05)
    assert found["FRICTION/1.fz"] == pytest.approx(-0.6 * (20 * mu + own), abs=1e-5)
    assert found["FRICTION/1.tz"] == pytest.approx(0.8 * 0.1 * 20 * mu, abs=1e-6)
    assert found["FRICTION/1.creep_az"] == pytest.approx(-0.8 * z, abs=1e-9)


@pytest.mark.parametrize("pull", [4.0, -4.0])
def test_a_block_on_a_slope_yields_before_it_holds(pull: float) -> None:
    """Creeping one way only, dz = (1 - k |z|/mu) dx: x = -mu/k ln(1 - 0.4/mu) for mu = 0.6."""
    law = LUGRE.format(rest=0.6, moving=0.6, k=100.0, c=20.0, f=0.0, w=0.1, p=2.0)
    found = run(block(law, along=pull), 12.0)
    assert found["PART/2.x"][-1] == pytest.approx(np.sign(pull) * 0.006 * np.log(3), abs=1e-7)
    assert found["FRICTION/1.fz"][-1] == pytest.approx(-2 * pull, abs=1e-5)


@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "ABAM", "HHT"])
def test_to_and_fro(method: str) -> None:
    """The three scalar equations by another program."""
    s, band = SETS[1], {"HHT": 3e-4}.get(method, 2e-6)

    def rates(t: float, y: np.ndarray) -> list[float]:
        bend = y[1] - s["k"] * abs(y[1]) * y[2] / level(s, abs(y[1]))
        mu = s["k"] * y[2] + s["c"] * bend + s["f"] * y[1]
        return [y[1], (14 * np.sin(6 * t) - 20 * mu) / 2, bend]

    times = np.linspace(0, 1, 21)
    expected = solve_ivp(rates, (0, 1), [0, 0, 0], "DOP853", times, rtol=1e-10, atol=1e-12,
                         max_step=1e-3).y  # fmt: skip
    force = "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=14*SIN(6*TIME)"
    found = run(block(LUGRE.format(**s), force), 1.0, method=method)
    assert found["PART/2.x"] == pytest.approx(expected[0], abs=band)
    assert found["FRICTION/1.creep_z"] == pytest.approx(expected[2], abs=band)


def test_statics_keep_what_bristles_hold() -> None:
    law = LUGRE.format(rest=0.6, moving=0.6, k=100.0, c=20.0, f=0.0, w=0.1, p=2.0)
    spring = "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=-100*DX(2,1)"
    deck = read(block(law, spring, along=4.0))
    done = simulate(deck, commands=read_commands("SIM/DYN, END=9, STEPS=2\nSIM/STATICS\n", deck))
    x = done["PART/2.x"]
    assert x[3] == pytest.approx(x[2], abs=1e-7)
    assert x[2] > 1e-3


@pytest.mark.parametrize("law", ["MU_STATIC=0.5, MU_DYNAMIC=0.3", LUGRE.format(**SETS[0])])
@pytest.mark.parametrize("v", [2.0, -2.0])
def test_the_largest_friction(law: str, v: float) -> None:
    """2.5 N where 6 N and more would act: a deceleration of 1.25."""
    found = run(block(law + ", MAX_FRICTION_FORCE=2.5", v=v), 1.0)
    turn = np.sign(v)
    assert found["FRICTION/1.fz"][-1] == pytest.approx(-2.5 * turn, abs=1e-9)
    assert abs(found["PART/2.vx"][-1] - turn * 0.75) < 0.02  # less until the bristles are bent
    loose = run(block(law + ", MAX_FRICTION_FORCE=1000", v=v), 0.2)
    free = run(block(law, v=v), 0.2)
    assert loose["PART/2.vx"] == pytest.approx(free["PART/2.vx"], abs=1e-7)


@pytest.mark.parametrize("w", [9.0, -9.0])
def test_the_largest_torque_of_a_ball(w: float) -> None:
    """0.3 N m about any axis where 0.04 * 0.2 * 20 would be less, 0.05 where it would be more."""
    deck = """a ball in its cup
UNITS/SYSTEM=MKS
ACCGRAV/KGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=2, IP=0.01,0.01,0.01, WX={w}, WY={w}
MARKER/2, PART=2
JOINT/1, SPHERICAL, I=2, J=1
FRICTION/1, JOINT=1, MU_STATIC=0.2, MU_DYNAMIC=0.2, BALL_RADIUS=0.04, MAX_FRICTION_TORQUE={most}
"""
    for most, torque in ((0.3, 0.16), (0.05, 0.05)):
        found = run(deck.format(w=w, most=most), 0.2)
        share = torque / np.sqrt(2)
        assert found["PART/2.wx"] == pytest.approx(
            w - np.sign(w) * share / 0.01 * found.time, abs=1e-5
        )

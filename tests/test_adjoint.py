"""Gradients by a sweep back, against closed forms and against sensitivities that go forwards."""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scenes import BALL_ON_A_FLOOR

import adamslite as al
from adamslite.analyses.session.session import Session
from adamslite.equations.engine import address_of
from adamslite.errors import UsageError
from adamslite.integrators.contract import ACCELERATION as EQUATIONS
from adamslite.integrators.contract import ACCELERATIONS, JACOBIAN
from adamslite.sensitivity import study, taped
from adamslite.sensitivity.transposed import ENTRY, FACTOR_RATES, SOLVE_RATES

DECKS = Path(__file__).parents[1] / "decks"

SPRING = """m x'' = -k (x - 1) - c x', let go at x = 2 at rest
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=2,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=8, C=0.4, LENGTH=1
REQUEST/1, F2=DX(2,1)**2
END
"""

BOUNCE = """a ball on a floor that pushes back at once, and a push that begins at t = 0.31
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
MARKER/3, PART=1, REULER=0,-90D,0
POINT_MASS/2, MASS=2, CM=2, QG=0,1,0, VX=0.5
MARKER/2, POINT_MASS=2
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=3,
, FUNCTION=IF(DY(2,1)-0.1: 40-5000*(DY(2,1)-0.1)-10*VY(2,1), 0, 0)
SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=IF(TIME-0.31: 0, 3, 3)
END
"""

FOUR_BAR = """a four-bar of revolutes in space: three rows are redundant
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=0.4,0,0
PART/2, MASS=1, CM=22, IP=1E-4,8E-4,8E-4, REULER=90D,0,0
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.1,0,0
MARKER/22, PART=2, QP=0.05,0,0
PART/3, MASS=2, CM=32, IP=1E-4,0.02,0.02, QG=0,0.1,0, REULER=32.3D,0,0
MARKER/30, PART=3
MARKER/31, PART=3, QP=0.35,0,0
MARKER/32, PART=3, QP=0.175,0,0
PART/4, MASS=1.5, CM=42, IP=1E-4,0.011,0.011, QG=0.4,0,0, REULER=109.9D,0,0
MARKER/40, PART=4
MARKER/41, PART=4, QP=0.3,0,0
MARKER/42, PART=4, QP=0.15,0,0
JOINT/1, REVOLUTE, I=20, J=1, IC=90D,-8
JOINT/2, REVOLUTE, I=30, J=21
JOINT/3, REVOLUTE, I=31, J=41
JOINT/4, REVOLUTE, I=40, J=2
VARIABLE/rocker, FUNCTION=AZ(40,2)
END
"""

DOUBLE = """a double pendulum of rods, as OpenModelica's: revolutes about z, damped, with a state
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=22, IP=0.01,0.09,0.09
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.5,0,0
MARKER/22, PART=2, QP=0.25,0,0
PART/3, MASS=0.8, CM=32, IP=0.01,0.08,0.08, QG=0.5,0,0
MARKER/30, PART=3
MARKER/32, PART=3, QP=0.25,0,0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, REVOLUTE, I=30, J=21
SFORCE/1, ROTATION, I=20, J=1, FUNCTION=0-0.1*WZ(20,1)
DIFF/1, FUNCTION=WZ(20,1)**2-0.5*DIF(1), IC=0.1
END
"""


@pytest.fixture(autouse=True)
def in_space(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sensitivities along the same steps, whose systems are solved to round-off: a sweep back is in
    space, and has matrices of all steps.
    """
    monkeypatch.setattr(study, "PLANAR", False)
    monkeypatch.setattr(taped, "EXACT", True)


def compare(
    text: str, of: list[str], by: list[str], tolerance: float = 1e-9, **options: Any
) -> None:
    """Both directions along the same steps, in relation to the largest effect of a number."""
    deck = al.read(text)
    forwards, back = al.sensitivities(deck, by, of, **options), al.gradient(deck, of, by, **options)
    effects = np.abs(forwards.gradient * np.where(forwards.at, forwards.at, 1.0))
    gap = np.abs(back.gradient - forwards.gradient) * np.where(forwards.at, abs(forwards.at), 1.0)
    assert back.by == forwards.by and back.measures == forwards.measures
    assert back.values == pytest.approx(forwards.values, rel=1e-7)
    assert (gap <= tolerance * effects.max(axis=1, keepdims=True)).all(), gap / effects.max()
    assert effects.max(axis=1).min() > 0.0


def test_a_damped_vibration_by_mass_stiffness_and_damping() -> None:
    """x(t) = 1 + exp(-d t) (cos w t + d/w sin w t), d = c/2m, w^2 = k/m - d^2."""

    def end(m: complex, k: complex, c: complex, t: float = 3.0) -> complex:
        d = c / (2 * m)
        w = np.sqrt(k / m - d * d)
        return 1 + np.exp(-d * t) * (np.cos(w * t) + d / w * np.sin(w * t))

    by = ["POINT_MASS/2.MASS", "SPRINGDAMPER/1.K", "SPRINGDAMPER/1.C"]
    found = al.gradient(SPRING, ["POINT_MASS/2.x@end"], by, end=3.0, steps=60, error=1e-10)
    given = np.array([2.0, 8.0, 0.4], dtype=complex)
    for k, name in enumerate(by):
        moved = given.copy()
        moved[k] += 1e-30j
        expected = end(*moved).imag / 1e-30
        assert found["POINT_MASS/2.x@end", name] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("integrator", ["GSTIFF", "RADAU"])
def test_measures_of_a_vibration(integrator: str) -> None:
    of = ["max POINT_MASS/2.ax", "mean REQUEST/1.F2", "rms POINT_MASS/2.x", "min POINT_MASS/2.x"]
    of += ["absmax POINT_MASS/2.vx", "range POINT_MASS/2.x", "first POINT_MASS/2.ax"]
    of += ["POINT_MASS/2.x@0.77"]
    by = ["POINT_MASS/2.MASS", "POINT_MASS/2.QG[0]", "SPRINGDAMPER/1.K", "SPRINGDAMPER/1.LENGTH"]
    compare(SPRING, of, by, end=1.0, steps=20, error=1e-7, integrator=integrator)


@pytest.mark.parametrize("integrator", ["GSTIFF", "RADAU"])
def test_events_where_accelerations_jump(integrator: str) -> None:
    names = [f"SFORCE/1.FUNCTION[{k}]" for k in (0, 1, 2, 3, 4)] + ["SFORCE/2.FUNCTION[0]"]
    by = ["POINT_MASS/2.MASS", "POINT_MASS/2.QG[1]", "ACCGRAV.JGRAV", *names]
    compare(BOUNCE, ["POINT_MASS/2.y@end", "mean POINT_MASS/2.x"], by,
            end=1.2, steps=60, error=1e-8, integrator=integrator)  # fmt: skip


@pytest.mark.parametrize("integrator", ["GSTIFF", "RADAU"])
def test_redundant_constraints_and_an_assembled_start(integrator: str) -> None:
    by = ["PART/2.MASS", "PART/3.IP[2]", "MARKER/21.QP[0]", "MARKER/2.QP[0]", "JOINT/1.IC[1]"]
    compare(FOUR_BAR, ["PART/2.wz@end", "mean VARIABLE/rocker", "max PART/3.ax"], by,
            end=0.1, steps=10, error=1e-7, integrator=integrator)  # fmt: skip


@pytest.mark.parametrize("integrator", ["GSTIFF", "RADAU"])
def test_a_double_pendulum_with_a_state(integrator: str) -> None:
    by = ["PART/2.MASS", "PART/3.IP[2]", "MARKER/21.QP[0]", "SFORCE/1.FUNCTION[1]", "DIFF/1.IC[0]",
          "DIFF/1.FUNCTION[1]", "ACCGRAV.JGRAV"]  # fmt: skip
    compare(DOUBLE, ["PART/3.y@end", "DIFF/1@end", "mean PART/3.wz"], by,
            end=0.5, steps=25, error=1e-7, integrator=integrator)  # fmt: skip


def test_index_3_and_angles() -> None:
    compare(DOUBLE, ["PART/3.psi@0.4", "max PART/2.alz"], ["PART/2.MASS", "PART/3.MASS"],
            end=0.5, steps=25, formulation="I3", error=1e-6)  # fmt: skip


@pytest.mark.parametrize("integrator", ["GSTIFF", "RADAU"])
@pytest.mark.parametrize(
    ("name", "of", "by", "end"),
    [
        ("bricard", "PART/5.x@end", ["MARKER/40.QP[1]", "PART/3.MASS"], 0.1),
        ("growing-mass-spring", "PART/2.x@end", ["PART/2.MASS", "VARIABLE/Dm.FUNCTION"], 0.5),
    ],
)
@pytest.mark.filterwarnings("ignore::adamslite.DeckWarning")
def test_both_directions_agree_to_round_off(
    name: str, of: str, by: list[str], end: float, integrator: str
) -> None:
    """Redundant constraints; forces that hang on accelerations."""
    deck = (DECKS / name / f"{name}.adm").read_text(encoding="utf-8")
    compare(deck, [of], by, 1e-10, end=end, steps=10, error=1e-7, integrator=integrator)


@pytest.mark.parametrize(("integrator", "tolerance"), [("GSTIFF", 1e-10), ("RADAU", 1e-9)])
def test_steps_that_grow_behind_a_bounce(integrator: str, tolerance: float) -> None:
    """From microseconds to tenths of a second: weights of differences are powers of that."""
    by = ["POINT_MASS/2.QG[1]", "POINT_MASS/2.MASS", "VFORCE/1.FY[0]", "VFORCE/1.FY[3]"]
    compare(BALL_ON_A_FLOOR, ["POINT_MASS/2.y@end"], by, tolerance,
            end=1.0, steps=10, error=1e-9, integrator=integrator)  # fmt: skip


def chain(sections: int) -> str:
    """A rope of point masses between two hooks."""
    text = "a rope\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1\n"
    text += "MARKER/2, PART=1, QP=9,0,0\n"
    ends = [1, *range(11, 10 + sections), 2]
    for k, marker in enumerate(ends[1:-1], 1):
        text += f"POINT_MASS/{k}, MASS={0.5 + 0.01 * (k % 7)}, CM={marker}, "
        text += (
            f"QG={9 * k / sections},0,{-0.01 - 0.02 * (k % 3)}\nMARKER/{marker}, POINT_MASS={k}\n"
        )
    for k, (i, j) in enumerate(zip(ends[1:], ends[:-1], strict=True), 1):
        text += f"SPRINGDAMPER/{k}, TRANSLATIONAL, I={i}, J={j}, K={2e4 + 100 * (k % 5)}, "
        text += f"C={20 + 0.1 * k}, LENGTH={9 / sections}\n"
    return text + f"REQUEST/1, F3=DZ({10 + sections // 2},1)\nEND\n"


@pytest.mark.parametrize("integrator", ["GSTIFF", "RADAU"])
def test_every_number_of_a_rope_at_once(integrator: str) -> None:
    """The whole gradient, some of it against sensitivities forwards."""
    run = {"end": 0.2, "steps": 10, "error": 1e-5, "integrator": integrator}
    deck = al.read(chain(40))
    found = al.gradient(deck, ["max REQUEST/1.F3", "REQUEST/1.F3@end"], **run)
    assert len(found.by) == 40 * 3 + 39 * 3 + 2
    by = ["SPRINGDAMPER/7.K", "SPRINGDAMPER/20.C", "POINT_MASS/12.MASS", "POINT_MASS/5.QG[2]"]
    forwards = al.sensitivities(deck, by, ["max REQUEST/1.F3", "REQUEST/1.F3@end"], **run)
    for measure in found.measures:
        for name in by:
            assert found[measure, name] == pytest.approx(forwards[measure, name], rel=1e-9)


def net(side: int) -> str:
    """Point masses in a square, each tied to its neighbours: eliminated by fronts."""
    text = "a net\nACCGRAV/KGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1, QP=-1,0,0\n"
    pairs = [(1, 10)]
    for k in range(side * side):
        text += f"POINT_MASS/{k + 2}, MASS=1, CM={k + 10}, QG={k // side},{k % side},0\n"
        text += f"MARKER/{k + 10}, POINT_MASS={k + 2}\n"
        pairs += [(k + 10, k + 11)] * ((k + 1) % side > 0)
        pairs += [(k + 10, k + 10 + side)] * (k + side < side * side)
    for k, (i, j) in enumerate(pairs, 1):
        share = 0.1 + 2.5 * (-1) ** k  # off the diagonal, so that rows are swapped
        law = f"FUNCTION=({share})*ACC{'XY'[j == i + 1]}({i},{j})-DM({i},{j})"
        text += f"SFORCE/{k}, TRANSLATIONAL, I={i}, J={j}, {law}\n"
    return text + "END\n"


@pytest.mark.slow
@pytest.mark.parametrize("side", [3, 16])
def test_a_net_by_stages(side: int) -> None:
    """Complex systems transposed, dense and in fronts, with rows that are swapped."""
    by = ["POINT_MASS/4.MASS", "POINT_MASS/5.QG[0]"]
    compare(net(side), ["POINT_MASS/5.x@end", "mean POINT_MASS/4.vy"], by, 1e-7,
            end=0.1, steps=2, error=1e-6, integrator="RADAU")  # fmt: skip


@pytest.mark.parametrize("text", [FOUR_BAR, DOUBLE, net(3), net(16)])
def test_transposed_solutions(text: str) -> None:
    """K^T x = b with the factors that the elimination leaves: dense, in blocks, in fronts."""
    session = Session(al.read(text), None, {}, frozenset({"merged"}))
    session.prepare()
    system, some = session.system, np.random.default_rng(3)
    assert system.run(ACCELERATIONS) == 0
    problem, plan = system.records()
    given = (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_double)
    native = ctypes.CFUNCTYPE(ctypes.c_int64, *given)(address_of(ENTRY))
    assert native(problem.address, plan.address, FACTOR_RATES, 0.0) == 0
    system.coef[:] = (0.0, 0.0, 1.0, 1.0, 1.0)
    system.run(JACOBIAN, EQUATIONS)
    live = np.setdiff1d(np.arange(system.n + system.m + system.nv + system.ns),
                        system.elimination.dead)  # fmt: skip
    b = np.zeros(system.nz)
    b[live] = some.standard_normal(live.size)
    system.F[: system.nz] = b
    native(problem.address, plan.address, SOLVE_RATES, 0.0)
    K = system.dense_jacobian()[np.ix_(live, live)]
    x = system.F[live]
    rest = K.T @ x - b[live]
    assert np.abs(rest).max() <= 1e-11 * (1.0 + (np.abs(K.T) @ np.abs(x)).max())


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"of": ["max POINT_MASS/2.x"], "integrator": "HHT"}, "HHT is none of them"),
        ({"of": ["POINT_MASS/2.x"]}, "a gradient is that of a measure"),
        ({"of": ["maxtime POINT_MASS/2.x"]}, "has no derivative"),
        ({"of": ["max POINT_MASS/2.x"], "by": []}, "by what"),
        ({"of": ["max POINT_MASS/2.x"], "by": ["SPRINGDAMPER/1.Q"]}, "SPRINGDAMPER/1.Q"),
    ],
)
def test_what_has_no_gradient_is_told(options: dict[str, Any], words: str) -> None:
    with pytest.raises(UsageError, match=words):
        al.gradient(SPRING, **options, end=1.0, steps=10)


def test_a_tape_that_is_too_short_is_laid_again(monkeypatch: pytest.MonkeyPatch) -> None:
    run: dict[str, Any] = {"end": 1.0, "steps": 10, "error": 1e-7}
    whole = al.gradient(SPRING, ["POINT_MASS/2.x@end"], **run)
    monkeypatch.setattr(taped, "FIRST_ROWS", 5)
    monkeypatch.setattr(taped, "FIRST_BYTES", 0)
    assert (al.gradient(SPRING, ["POINT_MASS/2.x@end"], **run).gradient == whole.gradient).all()
    monkeypatch.setattr(taped, "MOST_BYTES", 5_000)
    with pytest.raises(UsageError, match="take more than 5e-06 GB"):
        al.gradient(SPRING, ["POINT_MASS/2.x@end"], **run)


def test_the_room_of_a_tape_serves_again() -> None:
    """Runs of other lengths and methods between two of one leave no trace in it."""
    of, by = ["POINT_MASS/2.x@end"], ["SPRINGDAMPER/1.K"]
    first = al.gradient(SPRING, of, by, end=1.0, steps=10, error=1e-7)
    rooms = [id(each) for each in taped._spare]
    al.gradient(SPRING, of, by, end=2.0, steps=10, error=1e-9, integrator="RADAU")
    again = al.gradient(SPRING, of, by, end=1.0, steps=10, error=1e-7)
    assert len(rooms) == 1
    assert (again.gradient == first.gradient).all()
    assert (again.values == first.values).all()


def test_an_equilibrium_before_moves_with_every_number() -> None:
    """At rest the mass is where the spring is as long as it is unloaded, whatever was known of the
    deck before.
    """
    analyses = "SIMULATE/STATICS\nSIMULATE/DYNAMIC, END=0.5, STEPS=5\nEND\n"
    deck, by = al.read(SPRING.replace("END\n", analyses)), ["SPRINGDAMPER/1.LENGTH"]
    for _ in range(3):
        forwards = al.sensitivities(deck, by, ["max POINT_MASS/2.x"]).gradient
        back = al.gradient(deck, ["max POINT_MASS/2.x"], by).gradient
        assert forwards == pytest.approx(1.0, rel=1e-9)
        assert back == pytest.approx(1.0, rel=1e-9)


def test_numbers_that_are_zero_and_numbers_that_were_put_in() -> None:
    run: dict[str, Any] = {"end": 1.0, "steps": 10, "error": 1e-8}
    by = ["POINT_MASS/2.QG[1]", "POINT_MASS/2.QG[0]", "SPRINGDAMPER/1.K"]
    deck = al.with_values(al.read(SPRING), {"SPRINGDAMPER/1.K": 9.0})
    forwards = al.sensitivities(deck, by, ["POINT_MASS/2.x@end"], **run)
    back = al.gradient(deck, ["POINT_MASS/2.x@end"], by, **run)
    assert back.gradient == pytest.approx(forwards.gradient, rel=1e-8, abs=1e-12)
    assert list(back.at) == list(forwards.at)

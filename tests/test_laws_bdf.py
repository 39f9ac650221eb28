"""Laws of the variable-order BDF: accuracy, conservation, constraints, rotations, sameness."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scenes import (
    GROUND,
    LENGTH,
    PENDULUM,
    PERIOD,
    RATE,
    SPRING,
    added_mass,
    done,
    spring_energy,
)
from scipy.integrate import solve_ivp

from adamslite.integrators.bdf import differences as past
from adamslite.integrators.bdf.dense_output import interpolate

FORMULATIONS = ("SI2", "I3")


def swing(error: float, formulation: str = "SI2", **options) -> float:
    """Largest error of the height of the pendulum over a period."""
    results = done(PENDULUM, PERIOD, 40, error=error, formulation=formulation, **options)
    truth = solve_ivp(
        lambda t, y: (y[1], -RATE * math.cos(y[0])),
        (0.0, PERIOD), (0.0, 0.0), t_eval=results.time, method="DOP853", rtol=1e-12, atol=1e-12,
    )  # fmt: skip
    return float(np.abs(results["PART/2.y"] - np.sin(truth.y[0])).max())


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_the_error_falls_with_the_tolerance(formulation):
    """By ten from ERROR 1e-4 to 1e-6, by five more to 1e-8 (index 3, which tests q only: less)."""
    coarse, middle, fine = (swing(e, formulation) for e in (1e-4, 1e-6, 1e-8))
    first, second = (10, 5) if formulation == "SI2" else (3, 2)
    assert coarse > first * middle > first * second * fine
    assert fine < (1e-6 if formulation == "SI2" else 1e-3)


POLYNOMIALS = [np.polynomial.Polynomial([0.3, -1, 2, 0.7, -0.4, 0.2][: k + 1]) for k in range(6)]


def history(k: int, h: float, t: float) -> np.ndarray:
    """Backward differences of the polynomial of degree k, followed by workspace."""
    values = POLYNOMIALS[k](t - h * np.arange(past.ROWS))
    differences = []
    while values.size:
        differences.append(values[0])
        values = values[:-1] - values[1:]
    return np.concatenate([differences, np.zeros(200)])


@pytest.mark.parametrize("k", range(1, 6))
def test_the_formula_of_order_k_is_exact_for_polynomials_of_degree_k(k):
    """Predictor, corrector, change of the step and interpolation."""
    p, h, t = POLYNOMIALS[k], 0.1, 0.7
    d, yp, psi = history(k, h, t), np.zeros(1), np.zeros(1)
    for factor in (1.0, 0.37, 1.9):
        past.change_step(d, 1, k, factor)
        h *= factor
        past.extrapolate(d, 1, k, yp, psi)
        assert d[0] + yp[0] == pytest.approx(p(t + h), abs=1e-12)
        assert psi[0] * past.gamma(k) / h == pytest.approx(p.deriv()(t + h), abs=1e-10)
        interpolate(d, 1, k, t, h, t - 0.3 * h, yp)
        assert yp[0] == pytest.approx(p(t - 0.3 * h), abs=1e-12)


@pytest.mark.parametrize("order", (1, 2))
def test_the_order_of_convergence_is_that_of_the_formula(order):
    """A spring with a fixed step: halving it divides the error by 2^order.

    The tolerance is so loose that HMAX alone decides, and KMAX holds the order.
    """
    deck = (
        GROUND
        + "POINT_MASS/2, MASS=1, CM=2, QG=2,0,0\nMARKER/2, POINT_MASS=2\n"
        + "SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-(DM(2,1)-1)\n"
        + f"INTEGRATOR/GSTIFF, KMAX={order}\nEND\n"
    )
    errors = []
    for count in (200, 400):
        results = done(deck, 4.0, count, error=1e-2)
        assert results.summary["rejected"] == 0
        late = results.time > 1.0
        errors.append(np.abs(results["POINT_MASS/2.x"] - 1 - np.cos(results.time))[late].max())
    assert errors[0] / errors[1] == pytest.approx(2.0**order, rel=0.25)


def test_an_undamped_spring_keeps_its_energy():
    """m x'' = -k x with m = 2, k = 8: energy 4 x^2 + v^2 over ten periods."""
    results = done(SPRING, 10 * math.pi, 100, error=1e-7)
    assert np.abs(spring_energy(results) / 4 - 1).max() < 1e-4


TWO_BODIES = (
    GROUND
    + """PART/2, MASS=2, CM=2, IP=0.3,0.4,0.5, QG=1,0,0, VX=0.5, WZ=1, WX=0.3
MARKER/2, PART=2
MARKER/21, PART=2, QP=0.3,0.1,0.2
PART/3, MASS=3, CM=3, IP=0.6,0.4,0.5, QG=-1,0.2,0, VY=1, VX=-0.2
MARKER/3, PART=3
MARKER/31, PART=3, QP=0.1,-0.2,0.4, REULER=0.3,0.4,0.5
SFORCE/1, TRANSLATIONAL, I=21, J=31, FUNCTION=-20*(DM(21,31)-1)-0.5*VR(21,31)
SFORCE/2, ROTATIONAL, I=21, J=31, FUNCTION=0.3*SIN(5*TIME)
MARKER/32, PART=3, FLOATING
VFORCE/1, I=2, JFLOAT=32, RM=31, FX=SIN(TIME)\\FY=0.5\\FZ=DX(2,3)
END
"""
)


def test_free_bodies_keep_their_momentum():
    """Internal forces of every kind: m v and x cross m v + J w stay."""
    results = done(TWO_BODIES, 2.0, 20, error=1e-7)
    total, moment = 0.0, 0.0
    for body, mass, inertia in ((2, 2.0, (0.3, 0.4, 0.5)), (3, 3.0, (0.6, 0.4, 0.5))):
        x, v, w, angles = (vectors(results, f"PART/{body}", c) for c in ("", "v", "w", "angles"))
        r = np.array([attitude(*a) for a in angles])
        spin = np.einsum("tij,j,tkj,tk->ti", r, inertia, r, w)
        total = total + mass * v
        moment = moment + mass * np.cross(x, v) + spin
    assert np.abs(total - total[0]).max() < 1e-6
    assert np.abs(moment - moment[0]).max() < 1e-5


def vectors(results, label: str, kind: str) -> np.ndarray:
    """(nt, 3) history of one vector of a body."""
    names = ("psi", "theta", "phi") if kind == "angles" else [kind + c for c in "xyz"]
    return np.column_stack([results[f"{label}.{name}"] for name in names])


def attitude(psi: float, theta: float, phi: float) -> np.ndarray:
    """Rz(psi) Rx(theta) Rz(phi)."""
    return about("z", psi) @ about("x", theta) @ about("z", phi)


def about(axis: str, angle: float) -> np.ndarray:
    """A turn about a coordinate axis."""
    return exponential(angle * np.eye(3)["xyz".index(axis)])


def exponential(c: np.ndarray) -> np.ndarray:
    """exp([c]) by Rodrigues."""
    angle = np.linalg.norm(c)
    if angle == 0.0:
        return np.eye(3)
    k = np.cross(np.eye(3), c / angle)
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_constraints_do_not_drift(formulation):
    """The pendulum for 100 s at ERROR 1e-6: hinge to 1e-8 (index 3: to ERROR), no growth."""
    results = done(PENDULUM, 100.0, 1000, error=1e-6, formulation=formulation)
    gap = np.abs(np.hypot(results["PART/2.x"], results["PART/2.y"]) - LENGTH)
    limit = 1e-8 if formulation == "SI2" else 1e-6
    assert results.summary["max_violation"] < limit
    assert gap.max() < 5 * limit  # outputs between two steps are interpolated
    assert gap[-100:].max() <= 10 * max(gap[:100].max(), 1e-12)


def test_a_torque_free_body_turns_through_gimbal_lock():
    """Turned 90 deg about x, spinning at constant w through theta = 0: R = exp([w] t) R0."""
    w = np.array([-1.5, 0.0, 0.4])
    start = about("x", math.pi / 2)
    local = start.T @ w
    deck = (
        GROUND
        + "PART/2, MASS=1, CM=2, IP=2,2,2, REULER=0,90D,0, "
        + "WX={:.17g}, WY={:.17g}, WZ={:.17g}\nMARKER/2, PART=2\nEND\n".format(*local)
    )
    error = 1e-10
    results = done(deck, 12.0, 120, error=error)
    found = [attitude(*a) for a in vectors(results, "PART/2", "angles")]
    gaps = [
        np.abs(r - exponential(w * t) @ start).max()
        for r, t in zip(found, results.time, strict=True)
    ]
    assert max(gaps) < error * results.summary["steps"]  # at a constant speed step errors add up


def test_the_intermediate_axis_flips_on_time():
    """I = 1, 2, 3 with w = (0.01, 5, 0.01): w2 returns after 10.0518583 s, is -5 halfway."""
    deck = (
        GROUND
        + "PART/2, MASS=1, CM=2, IP=1,2,3, WX=0.01, WY=5, WZ=0.01\nMARKER/2, PART=2\n"
        + "REQUEST/1, F2=WY(2,1,2)\\\nEND\n"
    )
    period = 10.0518583
    results = done(deck, period, 400, error=1e-10)
    w2 = results["REQUEST/1.F2"]
    assert w2[200] == pytest.approx(-5.0, abs=1e-3)
    falls = crossing(results.time, w2, 0, 200)
    rises = crossing(results.time, w2, 200, 400)
    assert 2 * (rises - falls) == pytest.approx(period, abs=1e-3)


def crossing(time: np.ndarray, values: np.ndarray, first: int, last: int) -> float:
    """When the values pass zero between two samples."""
    k = first + int(np.flatnonzero(np.diff(np.sign(values[first : last + 1])))[0])
    return time[k] - values[k] * (time[k + 1] - time[k]) / (values[k + 1] - values[k])


def turned(deck: str, matrix: np.ndarray, shift: np.ndarray) -> str:
    """A double pendulum placed and hung in other axes."""
    angles = angles_of(matrix)
    places = [shift + matrix @ np.array(p) for p in ((0.5, 0, 0), (1.5, 0, 0), (0, 0, 0))]
    gravity = matrix @ np.array([0.0, -9.81, 0.0])
    words = {"turn": angles, "p1": places[0], "p2": places[1], "p0": places[2]}
    text = {k: ",".join(f"{v:.17g}" for v in value) for k, value in words.items()}
    pull = {c + "GRAV": f"{v:.17g}" for c, v in zip("IJK", gravity, strict=True)}
    return deck.format(**text, **pull)


def angles_of(r: np.ndarray) -> tuple[float, float, float]:
    """3-1-3 angles of an attitude."""
    if r[2, 2] == 1.0:
        return (math.atan2(r[1, 0], r[0, 0]), 0.0, 0.0)
    return (
        math.atan2(r[0, 2], -r[1, 2]), math.acos(min(1.0, max(-1.0, r[2, 2]))),
        math.atan2(r[2, 0], r[2, 1]),
    )  # fmt: skip


DOUBLE = """a double pendulum in any axes
PART/1, GROUND
MARKER/1, PART=1, QP={p0}, REULER={turn}
ACCGRAV/IGRAV={IGRAV}, JGRAV={JGRAV}, KGRAV={KGRAV}
PART/2, MASS=1, CM=20, IP=0.1,0.2,0.3, QG={p1}, REULER={turn}, WX=0.3
MARKER/20, PART=2
MARKER/21, PART=2, QP=-0.5,0,0
MARKER/22, PART=2, QP=0.5,0,0
PART/3, MASS=2, CM=30, IP=0.1,0.2,0.1, QG={p2}, REULER={turn}
MARKER/30, PART=3
MARKER/31, PART=3, QP=-0.5,0,0
JOINT/1, SPHERICAL, I=21, J=1
JOINT/2, REVOLUTE, I=31, J=22
REQUEST/1, F2=DX(30,1,1)\\F3=DY(30,1,1)\\F4=WZ(30,1,30)\\F6=JOINT(1,0,3,1)\\
END
"""


def test_the_axes_of_the_deck_do_not_matter():
    """The same scene turned and moved as a whole gives the same measures."""
    turn = attitude(0.7, 1.1, -0.4)
    there = done(turned(DOUBLE, np.eye(3), np.zeros(3)), 1.0, 10, error=1e-8)
    away = done(turned(DOUBLE, turn, np.array([2.0, -1.0, 3.0])), 1.0, 10, error=1e-8)
    for name in ("F2", "F3", "F4"):
        np.testing.assert_allclose(away[f"REQUEST/1.{name}"], there[f"REQUEST/1.{name}"], atol=1e-5)
    np.testing.assert_allclose(away["REQUEST/1.F6"], there["REQUEST/1.F6"], atol=1e-3)


@pytest.mark.parametrize("axis", "XYZ")
def test_angles_count_full_turns(axis):
    """A body spinning at 7 rad/s for 10 s has turned by 70 rad, in both directions."""
    for rate in (7.0, -7.0):
        deck = (
            GROUND
            + f"PART/2, MASS=1, CM=2, IP=1,1,1, W{axis}={rate}\nMARKER/2, PART=2\n"
            + f"VARIABLE/1, FUNCTION=A{axis}(2,1)\nEND\n"
        )
        results = done(deck, 10.0, 100, error=1e-8)
        np.testing.assert_allclose(results["VARIABLE/1"], rate * results.time, atol=1e-6)


def test_both_formulations_agree():
    """Positions and reactions of the pendulum."""
    one, other = (done(PENDULUM, 1.0, 20, error=1e-8, formulation=f) for f in FORMULATIONS)
    np.testing.assert_allclose(one["PART/2.y"], other["PART/2.y"], atol=1e-4)
    np.testing.assert_allclose(one["JOINT/1.fy"], other["JOINT/1.fy"], atol=1e-2)


def test_the_largest_step_is_the_output_step():
    """A force pulse of 10 ms is not stepped over, because output is asked every 5 ms."""
    deck = (
        GROUND
        + "POINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\n"
        + "VFORCE/1, I=2, J_PART=1, FX=STEP(TIME,0.5,0,0.502,100)"
        + "-STEP(TIME,0.508,0,0.51,100)\nEND\n"
    )
    results = done(deck, 1.0, 200)
    assert results["POINT_MASS/2.vx"][-1] == pytest.approx(0.8, rel=0.02)
    assert results.summary["steps"] >= 200
    # Left to itself the method takes some 25 steps a ramp, which is paced, and few between them.
    assert done(deck, 1.0, 200, hmax=0.5).summary["steps"] < 130


def test_a_run_repeated_gives_the_same_bytes():
    first, second = (done(TWO_BODIES, 0.5, 10).values.tobytes() for _ in range(2))
    assert first == second


def test_a_differential_equation_in_both_forms():
    """y' = -3 y and y y' + 3 y^2 = 0 from 2: y = 2 exp(-3 t)."""
    deck = (
        GROUND
        + "DIFF/1, IC=2, FUNCTION=-3*DIF(1)\n"
        + "DIFF/2, IC=2,-6, IMPLICIT, FUNCTION=DIF(2)*DIF1(2)+3*DIF(2)**2\nEND\n"
    )
    results = done(deck, 1.0, 10, error=1e-8)
    for name in ("DIFF/1", "DIFF/2"):
        np.testing.assert_allclose(results[name], 2 * np.exp(-3 * results.time), atol=1e-6)


def test_a_loop_of_variables_is_solved():
    """V = cos(V) + t/10 at every output time, from a first guess."""
    deck = GROUND + "VARIABLE/1, IC=1, FUNCTION=COS(VARVAL(1))+TIME/10\nEND\n"
    results = done(deck, 1.0, 10)
    v = results["VARIABLE/1"]
    np.testing.assert_allclose(v, np.cos(v) + results.time / 10, atol=1e-9)


def test_a_force_that_depends_on_a_reaction_is_solved_with_it():
    """Friction 0.3 N on a slider pulled by 10 N: a = (10 - 0.3 m g)/m."""
    deck = """a slider with friction
PART/1, GROUND
MARKER/1, PART=1, REULER=90D,90D,0
ACCGRAV/JGRAV=-9.81
PART/2, MASS=2, CM=2, IP=1,1,1
MARKER/2, PART=2, REULER=90D,90D,0
JOINT/1, TRANSLATIONAL, I=2, J=1
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=10-0.3*JOINT(1,0,3,0)
END
"""
    results = done(deck, 1.0, 10, error=1e-6)
    np.testing.assert_allclose(results["PART/2.ax"], 10 / 2 - 0.3 * 9.81, atol=1e-6)
    np.testing.assert_allclose(results["JOINT/1.fy"], 2 * 9.81, atol=1e-6)


@pytest.mark.parametrize("share", (0.5, 0.9, 1.0, 1.1, 2.0, 10.0))
def test_added_mass_is_implicit(share):
    """F = -dm (a - g): (m0 + dm) a = (m0 + dm) g + 3, whatever dm against m0."""
    results = done(added_mass(share), 1.0, 10, error=1e-6)
    np.testing.assert_allclose(results["POINT_MASS/2.ay"], -9.81, rtol=1e-9)
    np.testing.assert_allclose(results["POINT_MASS/2.y"], -4.905 * results.time**2, atol=1e-5)
    np.testing.assert_allclose(results["POINT_MASS/2.ax"], 1.5, rtol=1e-9)


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("error", (1e-6, 1e-8, 1e-10))
def test_a_fast_start_far_from_the_origin(error, formulation):
    """F = 1e5 t on 1 kg at x = 100 m: v = 5e4 t^2, x - 100 = 5e4 t^3/3.

    The first steps take nanoseconds, in which the mass moves less than the round-off of 100 m
    (1.4e-14 m); an error of each of a few dozen steps within ERROR may add up to 100 ERROR. Index 3
    tests positions only: a step with j h^3 = ERROR, j = 1e5 m/s^3, has an error ERROR/h of the
    velocity; ten of them last until the end.
    """
    deck = (
        GROUND
        + "POINT_MASS/2, MASS=1, CM=2, QG=100,0,0\nMARKER/2, POINT_MASS=2\n"
        + "VFORCE/1, I=2, J_PART=1, FX=1E5*TIME\\FY=0\\FZ=0\nEND\n"
    )
    results = done(deck, 0.01, 1, error=error, formulation=formulation)
    assert results.summary["steps"] < 200
    moved = results["POINT_MASS/2.x"][-1] - 100.0
    allowed = 100.0 * error if formulation == "SI2" else 0.1 * 1e5 ** (1 / 3) * error ** (2 / 3)
    assert moved == pytest.approx(5e4 * 0.01**3 / 3.0, abs=allowed)
    if formulation == "SI2":
        speed = results["POINT_MASS/2.vx"][-1]
        assert speed == pytest.approx(5e4 * 0.01**2, abs=500.0 * error)

"""Laws of RADAU: coefficients, complex elimination, order, stiffness, constraints, rotations."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scenes import (
    GRAVITY,
    GROUND,
    LENGTH,
    MASS,
    PENDULUM,
    PERIOD,
    RATE,
    SPRING,
    added_mass,
    done,
    run,
    spring_energy,
)
from scipy.integrate import solve_ivp

import adamslite as al
from adamslite.equations.elimination_order import analyse
from adamslite.integrators.linalg import complex_blocks
from adamslite.integrators.radau import coefficients
from adamslite.results.outcomes import Outcome


def radau(deck: str, end: float, steps: int = 10, **options):
    """A run with RADAU that must reach its end."""
    return done(deck, end, steps, integrator="RADAU", **options)


def test_the_coefficients_are_those_of_the_collocation_of_order_five():
    """sum_j b_j c_j^k = 1/(k+1) for k < 5, b the last row of A; the modes belong to A^-1."""
    table = coefficients.coefficients()
    c, inverse = table[:3], table[3:12].reshape(3, 3)
    b = np.linalg.inv(inverse)[2]
    for k in range(5):
        assert b @ c**k == pytest.approx(1 / (k + 1), abs=1e-13)
    assert abs(b @ c**5 - 1 / 6) > 1e-3
    to_stages, to_modes = table[12:21].reshape(3, 3), table[21:30].reshape(3, 3)
    real, alpha, beta = table[30:33]
    modes = [[real, 0, 0], [0, alpha, -beta], [0, beta, alpha]]
    np.testing.assert_allclose(to_modes @ inverse @ to_stages, modes, atol=1e-12)


@pytest.mark.parametrize("pivoting", [False, True], ids=["blocks", "dense"])
def test_the_complex_elimination_solves(pivoting):
    """A tree of blocks of 3, 6 and 1 unknowns against numpy's solution."""
    some = np.random.default_rng(4)
    widths, links = [3, 3, 6, 1, 3], [(0, 1), (1, 2), (2, 3), (2, 4)]
    starts = np.concatenate([[0], np.cumsum(widths)])[:-1].tolist()
    pairs = {(k, k) for k in range(5)} | set(links) | {(b, a) for a, b in links}
    both = np.array(sorted(pairs)).T
    found = analyse(widths, both, {}, pivoting)
    n, factors = sum(widths), np.zeros(2 * found.size)
    full = np.zeros((n, n), dtype=complex)
    for row, column, at, lead in zip(*both, *found.places.locate(*both), strict=True):
        block = some.standard_normal((widths[row], widths[column], 2)) @ (1, 1j)
        full[starts[row] :, starts[column] :][: widths[row], : widths[column]] = block
        for i in range(widths[row]):
            for j in range(widths[column]):
                k = 2 * (at + i * lead + j)
                factors[k : k + 2] = block[i, j].real, block[i, j].imag
    plan = type("Plan", (), found.plan)
    pivots, work, x = np.zeros(n, dtype=int), np.zeros(2 * n * n), np.zeros(2 * n)
    assert complex_blocks.factor_complex(plan, factors, pivots, work)
    b = some.standard_normal(2 * n)
    truth = np.linalg.solve(full, b.view(complex))
    complex_blocks.solve_complex(plan, factors, pivots, b, x, work)
    np.testing.assert_allclose(b.view(complex), truth, rtol=1e-10)
    assert not complex_blocks.factor_complex(plan, np.zeros_like(factors), pivots, work)


def test_the_formula_is_of_order_five():
    """A linear spring with steps of HMAX: half the step, a 32nd of the error.

    The tolerance is so loose that HMAX alone decides; a linear equation is solved exactly in one
    iteration all the same.
    """
    deck = (
        GROUND
        + "POINT_MASS/2, MASS=1, CM=2, QG=2,0,0\nMARKER/2, POINT_MASS=2\n"
        + "SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-(DX(2,1)-1)\nINTEGRATOR/HINIT=1\nEND\n"
    )
    errors = []
    for count in (10, 20):
        results = radau(deck, 4.0, count, error=1e-2)
        assert results.summary["steps"] == count
        errors.append(abs(results["POINT_MASS/2.x"][-1] - 1 - math.cos(4.0)))
    assert errors[0] / errors[1] == pytest.approx(2.0**5, rel=0.1)


def swing(error: float) -> tuple[float, np.ndarray]:
    """Steps of a period of the pendulum, and the largest errors of height, speed and reaction."""
    results = radau(PENDULUM, PERIOD, 8, error=error, hmax=1.0)
    truth = solve_ivp(
        lambda t, y: (y[1], -RATE * math.cos(y[0])),
        (0.0, PERIOD), (0.0, 0.0), t_eval=results.time, method="DOP853", rtol=1e-13, atol=1e-13,
    )  # fmt: skip
    angle, speed = truth.y
    turning = -RATE * np.cos(angle)
    up = -(speed**2) * np.sin(angle) + turning * np.cos(angle)
    exact = {
        "PART/2.y": np.sin(angle), "PART/2.wz": speed, "PART/2.ay": up,
        "JOINT/1.fy": MASS * (up + GRAVITY),
    }  # fmt: skip
    gaps = [np.abs(results[name] - value).max() for name, value in exact.items()]
    return results.summary["steps"], np.array(gaps)


def test_positions_velocities_and_reactions_converge_alike():
    """Error against mean step between ERROR = 1e-4 and 1e-8: order 4.5 at least, all of them."""
    (coarse, gaps), (fine, less) = swing(1e-4), swing(1e-8)
    orders = np.log(gaps / less) / math.log(fine / coarse)
    assert (orders > 4.5).all(), orders
    assert (less < 5e-9).all(), less


def test_a_stiff_oscillator_costs_a_few_steps_a_cycle():
    """Van der Pol with epsilon = 1e-6: y(2) = 1.706167732170483 (Hairer, Wanner, p. 144 f.)."""
    deck = (
        GROUND
        + "DIFF/1, IC=2, FUNCTION=DIF(2)\n"
        + "DIFF/2, IC=-0.66, FUNCTION=((1-DIF(1)**2)*DIF(2)-DIF(1))/1E-6\nEND\n"
    )
    results = radau(deck, 2.0, 1, error=1e-6, hmax=2.0)
    assert results["DIFF/1"][-1] == pytest.approx(1.706167732170483, abs=1e-6)
    assert results["DIFF/2"][-1] == pytest.approx(-0.8928097010247975, abs=1e-6)
    assert results.summary["steps"] < 1000


def test_what_is_stiff_and_settled_is_not_followed():
    """s' = -1e8 (s - cos t): one step covers 1e7 time constants, the error stays below ERROR."""
    deck = GROUND + "DIFF/1, IC=1, FUNCTION=-1E8*(DIF(1)-COS(TIME))\nEND\n"
    results = radau(deck, 5.0, 10, error=1e-5, hmax=5.0)
    np.testing.assert_allclose(results["DIFF/1"], np.cos(results.time), atol=1e-5)
    assert results.summary["steps"] < 60


def test_energy_is_kept_where_steps_resolve_the_oscillation():
    """m x'' = -k x with m = 2, k = 8, over ten periods: 4 x^2 + v^2 to 1e-6."""
    results = radau(SPRING, 10 * math.pi, 100, error=1e-7)
    np.testing.assert_allclose(spring_energy(results), 4.0, rtol=1e-6)


def test_constraints_do_not_drift():
    """The pendulum for 100 s: hinge to round-off, its speed to a hundredth of ERROR."""
    results = radau(PENDULUM, 100.0, 500, error=1e-4)
    x, y = results["PART/2.x"], results["PART/2.y"]
    np.testing.assert_allclose(np.hypot(x, y), LENGTH, atol=1e-11)
    along = x * results["PART/2.vx"] + y * results["PART/2.vy"]
    np.testing.assert_allclose(along, 0.0, atol=1e-6)
    assert results.summary["max_violation"] < 1e-8


def test_a_fast_spin_is_followed_through_full_turns():
    """A free body with equal inertias at 40 rad/s about a slanted axis: a steady turn for 2 s."""
    w = 40.0 / math.sqrt(3.0)
    deck = (
        GROUND
        + f"PART/2, MASS=1, CM=2, IP=2,2,2, WX={w:.17g}, WY={w:.17g}, WZ={w:.17g}\n"
        + "MARKER/2, PART=2\nEND\n"
    )
    results = radau(deck, 2.0, 20, error=1e-9)
    theta = results["PART/2.theta"]
    # R_33 = cos(theta) of a turn by an angle about (1, 1, 1): 1/3 + 2/3 cos(angle).
    np.testing.assert_allclose(np.cos(theta), (1 + 2 * np.cos(40.0 * results.time)) / 3, atol=1e-6)


@pytest.mark.parametrize("share", (0.5, 1.1, 10.0))
def test_added_mass_is_implicit(share):
    """F = -dm (a - g): (m0 + dm) a = (m0 + dm) g + 3, whatever dm against m0."""
    results = radau(added_mass(share), 1.0, 10, error=1e-6)
    np.testing.assert_allclose(results["POINT_MASS/2.ay"], -9.81, rtol=1e-9)
    np.testing.assert_allclose(results["POINT_MASS/2.y"], -4.905 * results.time**2, atol=1e-9)


def test_a_vanishing_effective_mass_stops_the_run():
    """F = 10 t a on a mass of 2: (2 - 10 t) a = -x, singular at 0.2 s."""
    deck = (
        GROUND
        + "POINT_MASS/2, MASS=2, CM=2, QG=1,0,0\nMARKER/2, POINT_MASS=2\n"
        + "VFORCE/1, I=2, J_PART=1, FX=10*TIME*ACCX(2)-DX(2)\\FY=0\\FZ=0\nEND\n"
    )
    results = run(deck, 1.0, 100, integrator="RADAU", error=1e-6)
    assert results.outcome is al.Outcome.SINGULAR_ACCELERATION
    assert results.summary["t_end"] == pytest.approx(0.2, abs=1e-3)


def test_redundant_rows_are_left_out():
    """Two hinges on one axis: five of ten rows are redundant, the motion is the pendulum's."""
    twice = PENDULUM.replace("END", "JOINT/2, REVOLUTE, I=3, J=1\nEND")
    one, two = (radau(deck, 1.0, 10, error=1e-8) for deck in (PENDULUM, twice))
    np.testing.assert_allclose(two["PART/2.y"], one["PART/2.y"], atol=1e-8)


# ---- crossings that lie just behind the end of a step --------------------------------------------


@pytest.fixture(scope="module")
def swing_with_stops():
    """A pendulum with added mass between a spring that pushes and one that holds from below."""
    deck = """Swing with stops
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
MARKER/4, PART=1
PART/2, MASS=1, CM=2, IP=.1,.1,.1, QG=1,0,0
MARKER/2, PART=2
MARKER/3, PART=2, QP=-1,0,0
JOINT/1, REVOLUTE, I=3, J=1
VFORCE/1, I=2, J_PART=1, RM=4, FX=0.3*ACCX(2)-MAX(0,DX(2)-.3)*500
, FY=0.3*ACCY(2)+IF(DY(2)+.5:-2000*(DY(2)+.5),0,0)
END
"""
    return al.compile_model(al.assemble(al.read(deck)))


@pytest.mark.parametrize("error", [k * 1e-10 for k in range(100, 140, 3)])
def test_no_step_to_a_crossing_is_lost_in_round_off(swing_with_stops, error):
    """Steps to a crossing end 1e-9 of their size before it, rarely or often, as ERROR has it."""
    exact = al.simulate(swing_with_stops, integrator="ABAM", error=1e-12, end=1.5, steps=5)
    last = al.simulate(swing_with_stops, integrator="RADAU", error=error, end=1.5, steps=5)
    assert last.outcome is Outcome.DONE, last.message
    for name in ("PART/2.x", "PART/2.vx"):
        assert last[name][-1] == pytest.approx(exact[name][-1], abs=1e-5)


@pytest.mark.parametrize(("unit", "length"), [(1.0, "METER"), (1000.0, "MILLIMETER")])
@pytest.mark.parametrize("far", [10.0, 1e3, 1e5])
def test_crossings_far_from_the_origin(far, unit, length):
    """A push that begins at a place: round-off of places as long as ``far``, over a step as short
    as what is lacking to the crossing, must not show in the velocities.
    """
    deck = f"""Two arms
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={length}, TIME=SECOND
ACCGRAV/JGRAV={-9.81 * unit}
PART/1, GROUND
MARKER/1, PART=1, QP={far * unit},{far * unit},0
MARKER/9, PART=1
PART/2, MASS=1, CM=2, IP={3 * (f"{0.1 * unit**2},")} QG={(far + 0.5) * unit},{far * unit},0
MARKER/2, PART=2
MARKER/3, PART=2, QP={-0.5 * unit},0,0
JOINT/1, REVOLUTE, I=3, J=1
VFORCE/1, I=2, J_PART=1, RM=9, FY=IF(DX(2)-{(far + 0.3) * unit}:20,0,0)
END
"""
    compiled = al.compile_model(al.assemble(al.read(deck)))
    exact = al.simulate(compiled, integrator="ABAM", error=1e-10, end=1.0, steps=10)
    last = al.simulate(compiled, integrator="RADAU", error=1e-6, end=1.0, steps=10)
    assert last.outcome is Outcome.DONE, last.message
    assert last["PART/2.vx"][-1] / unit == pytest.approx(exact["PART/2.vx"][-1] / unit, abs=1e-6)

"""The coefficients of every method, so sharply that one off by 1e-4 is noticed.

What a run writes in equal steps must obey the formula as the literature prints it; coefficients of
Runge-Kutta formulas must meet all conditions of their order.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scenes import GROUND, done

from adamslite.integrators.explicit import dop853
from adamslite.integrators.radau import coefficients

Tree = tuple["Tree", ...]


def trees(order: int) -> list[Tree]:
    """Rooted trees of an order (Butcher): the root's branches, sorted."""
    if order == 1:
        return [()]
    return sorted({branches for branches in forests(order - 1)})


def forests(order: int, highest: Tree | None = None) -> list[Tree]:
    """Sorted tuples of trees with together so many vertices."""
    if order == 0:
        return [()]
    found = []
    for size in range(1, order + 1):
        for first in trees(size):
            if highest is None or (size_of(first), first) <= (size_of(highest), highest):
                found += [(first, *rest) for rest in forests(order - size, first)]
    return found


def size_of(tree: Tree) -> int:
    """Vertices of a tree."""
    return 1 + sum(map(size_of, tree))


def density(tree: Tree) -> int:
    """gamma(t): the product of the sizes of all subtrees."""
    return size_of(tree) * math.prod(map(density, tree))


def elementary(tree: Tree, a: np.ndarray) -> np.ndarray:
    """Phi_i(t) of the stages: the product over the branches of sum_j a_ij Phi_j."""
    weights = np.ones(len(a))
    for branch in tree:
        weights = weights * (a @ elementary(branch, a))
    return weights


def defect(b: np.ndarray, a: np.ndarray, order: int, whole: float = 1.0) -> float:
    """Largest |sum b_i Phi_i(t) - whole/gamma(t)| over all trees up to an order."""
    return max(
        abs(b @ elementary(tree, a) - whole / density(tree))
        for size in range(1, order + 1)
        for tree in trees(size)
    )


STAGES, ALL = 12, 16
SHARP = 1e-12


def rows(*terms: dict[int, float], width: int = ALL) -> np.ndarray:
    """Rows {stage: weight} of a table as arrays."""
    found = np.zeros((len(terms), width))
    for row, weights in zip(found, terms, strict=True):
        row[list(weights)] = list(weights.values())
    return found


def dop853_defects(stages, fifth, third, nodes) -> list[float]:
    """What is left of the conditions: order 8, sums of rows, errors of order 5 and 3."""
    a = np.vstack([np.zeros(ALL), rows(*stages)])
    b = a[STAGES]
    low = rows(third)[0]
    return [
        defect(b, a, 8), np.abs(a.sum(axis=1) - nodes).max(),
        defect(rows(fifth)[0], a, 5, 0.0), defect(low, a, 3),
    ]  # fmt: skip


def test_there_are_two_hundred_conditions_of_order_eight():
    assert [len(trees(n)) for n in range(1, 9)] == [1, 1, 2, 4, 9, 20, 48, 115]


def test_dop853_meets_all_conditions_of_its_order():
    """Result of order 8; the error weights vanish up to order 5; the low result is of order 3."""
    found = dop853_defects(dop853.STAGES, dop853.FIFTH, dop853.THIRD, dop853.NODES)
    assert max(found) < SHARP


def test_a_coefficient_of_dop853_off_by_1e_4_is_noticed():
    """Each one of the stages, of the result and of both errors, by itself."""
    tables = [*(dict(row) for row in dop853.STAGES), dict(dop853.FIFTH), dict(dop853.THIRD)]
    for table in tables:
        for stage, weight in list(table.items()):
            table[stage] = weight + 1e-4
            found = dop853_defects(tables[:-2], tables[-2], tables[-1], dop853.NODES)
            assert max(found) > 1e3 * SHARP
            table[stage] = weight


def test_the_interpolation_of_dop853_is_of_order_seven():
    """sum b_i(x) Phi_i(t) = x^|t|/gamma(t) for all trees up to order 7, at four places x.

    b(x) is the Hermite cubic of both ends and x^2 z^2 (d_0 + x (d_1 + z (d_2 + x d_3))), z = 1 - x.
    """
    a = np.vstack([np.zeros(ALL), rows(*dop853.STAGES)])
    dense, start, end = rows(*dop853.DENSE), np.eye(ALL)[0], np.eye(ALL)[STAGES]
    for x in (0.2, 0.45, 0.7, 0.9):
        z = 1.0 - x
        b = (3 - 2 * x) * x**2 * a[STAGES] + x * z**2 * start - x**2 * z * end
        b = b + (x * z) ** 2 * (dense[0] + x * (dense[1] + z * (dense[2] + x * dense[3])))
        found = max(
            abs(b @ elementary(tree, a) - x**size / density(tree))
            for size in range(1, 8)
            for tree in trees(size)
        )
        assert found < SHARP


def test_the_error_weights_of_radau_belong_to_a_formula_of_order_three():
    """Hairer and Wanner (8.19): e_i z_i of t^k is -1 for k = 1, and 0 for k = 2, 3."""
    table = coefficients.coefficients()
    weights = table[coefficients.WEIGHT :][:3]
    found = [weights @ table[:3] ** k for k in (1, 2, 3)]
    np.testing.assert_allclose(found, [-1.0, 0.0, 0.0], atol=1e-13)


STIFFNESS, STEP = 40.0, 0.01
SPRING = (
    GROUND
    + "POINT_MASS/2, MASS=1, CM=2, QG=1,0,0, VX=2\nMARKER/2, POINT_MASS=2\n"
    + f"VFORCE/1, I=2, J_PART=1, FX=-{STIFFNESS}*DX(2)\nINTEGRATOR/{{}}\nEND\n"
)


def steps(method: str, count: int = 60, **options) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x, x', x" (count + 1,) of x" = -k x from x = 1, x' = 2 in equal steps, every one written."""
    results = done(SPRING.format(method), count * STEP, count, **options)
    return tuple(results[f"POINT_MASS/2.{name}"] for name in ("x", "vx", "ax"))


@pytest.mark.parametrize(
    ("method", "alpha", "beta", "gamma"),
    [
        ("HHT", -0.3, 1.3**2 / 4, 0.8),
        ("HHT, ALPHA=-0.05", -0.05, 1.05**2 / 4, 0.55),
        ("NEWMARK", 0.0, 0.36, 0.7),
        ("NEWMARK, BETA=0.25, GAMMA=0.5", 0.0, 0.25, 0.5),
    ],
)
def test_hht_and_newmark_step_by_step(method, alpha, beta, gamma):
    """Hilber, Hughes, Taylor (1977): b+ + (1 + alpha) k x+ - alpha k x = 0 and Newmark's rule."""
    every = f"{method}, HINIT={STEP}, HMIN={STEP}, HMAX={STEP}"
    x, v, _ = steps(every, error=1e-9)
    places, b = [1.0], -STIFFNESS
    speed, k, h = 2.0, STIFFNESS, STEP
    for _ in range(len(x) - 1):
        here = places[-1]
        known = here + h * speed + h * h * (0.5 - beta) * b
        after = (known + h * h * beta * alpha * k * here) / (1 + h * h * beta * (1 + alpha) * k)
        new = alpha * k * here - (1 + alpha) * k * after
        speed, b = speed + h * ((1 - gamma) * b + gamma * new), new
        places.append(after)
    np.testing.assert_allclose(x, places, atol=1e-9)
    assert v[-1] == pytest.approx(speed, abs=1e-3)  # written from the cubic between two steps


@pytest.mark.parametrize("method", ["HHT", "HHT, ALPHA=-0.05", "NEWMARK"])
def test_hht_turns_about_one_axis_as_it_slides(method: str):
    """J z" = -k z of the angle z about one axis is m x" = -k x, and both have one rule."""
    deck = SPRING.format(f"{method}, HINIT={STEP}, HMIN={STEP}, HMAX={STEP}").replace(
        "END\n",
        "PART/3, MASS=1, CM=3, IP=1,1,1, REULER=1,0,0, WZ=2\nMARKER/3, PART=3\n"
        f"VTORQUE/1, I=3, J_PART=1, TZ=-{STIFFNESS}*AZ(3)\nREQUEST/1, F1=AZ(3)\nEND\n",
    )
    results = done(deck, 60 * STEP, 60, error=1e-9)
    np.testing.assert_allclose(results["REQUEST/1.F1"], results["POINT_MASS/2.x"], atol=1e-9)


def test_verlet_step_by_step():
    """Stoermer: x+ - 2 x + x- = -h^2 k x."""
    x, _, _ = steps(f"VERLET, HINIT={STEP}")
    np.testing.assert_allclose(np.diff(x, 2), -(STEP**2) * STIFFNESS * x[1:-1], atol=1e-12)


def test_radau_step_by_step():
    """y+ = R(h A) y, R the Pade approximation (2, 3) of the exponential."""
    x, v, _ = steps(f"RADAU, HINIT={STEP}, HMAX={STEP}", error=1e-2)
    z = STEP * np.array([[0.0, 1.0], [-STIFFNESS, 0.0]])
    one, two, three = np.eye(2), z @ z, z @ z @ z
    grown = np.linalg.solve(one - 0.6 * z + 0.15 * two - three / 60, one + 0.4 * z + 0.05 * two)
    state = np.array([1.0, 2.0])
    for here in zip(x, v, strict=True):
        np.testing.assert_allclose(here, state, atol=1e-10)
        state = grown @ state


@pytest.mark.parametrize("order", range(1, 6))
@pytest.mark.parametrize("form", ["SI2", "I3"])
def test_the_bdf_step_by_step(order: int, form: str):
    """sum_{j <= k} nabla^j x/j = h x', and the same of x' and x", once the order is reached.

    The last step is cut to the end of the run.
    """
    written = steps(f"CONSTANT_BDF, {form}, HINIT={STEP}, KMAX={order}", 120, error=1e-9)
    x, v, a = (column[:-1] for column in written)
    for value, rate in ((x, v), (v, a)):
        late = slice(len(x) - 40, None)
        sums = sum(np.diff(value, j)[-40:] / j for j in range(1, order + 1))
        np.testing.assert_allclose(sums, STEP * rate[late], atol=1e-9)


@pytest.mark.parametrize("method", ["ABAM", "RKF45"])
def test_dop853_step_by_step(method: str):
    """Half the step, 1/2^8 of the error: 2e-7 and 1e-9, far above round-off."""
    errors = []
    for count in (8, 16):
        h = 1.2 / count
        deck = SPRING.format(f"{method}, HINIT={h}, HMAX={h}")
        results = done(deck, 1.2, count, error=1.0)
        assert results.summary["steps"] == count
        w = math.sqrt(STIFFNESS)
        truth = math.cos(1.2 * w) + 2.0 / w * math.sin(1.2 * w)
        errors.append(abs(results["POINT_MASS/2.x"][-1] - truth))
    assert math.log2(errors[0] / errors[1]) > 7.5


@pytest.mark.parametrize(
    ("method", "h", "off"),
    [
        ("ABAM, HINIT=0.1, HMAX=0.1", 0.1, 1e-6),
        ("RADAU, HINIT=0.02, HMAX=0.02, INTERPOLATE=ON", 0.02, 1e-6),
        ("HHT, ALPHA=0, HINIT=0.001, HMAX=0.001, HMIN=0.001", 0.001, 1e-4),
    ],
)
def test_what_is_written_within_a_step(method: str, h: float, off: float):
    """Five times in every step, with z = w h: z^8/8! of a polynomial of order 7, 6e-7; z^4/4!/32 of
    a cubic, 3e-7; z^2/24 w t of HHT's own phase, 1e-5 and the amplitude 1.05.
    """
    count = round(0.8 / h)
    results = done(SPRING.format(method), count * h, 5 * count, error=1e-2)
    assert results.summary["steps"] <= count + 2
    w, t = math.sqrt(STIFFNESS), results.time
    truth = np.cos(w * t) + 2.0 / w * np.sin(w * t)
    np.testing.assert_allclose(results["POINT_MASS/2.x"], truth, atol=off)
    rate = 2.0 * np.cos(w * t) - w * np.sin(w * t)
    np.testing.assert_allclose(results["POINT_MASS/2.vx"], rate, atol=20 * w * off)


@pytest.mark.parametrize("fast", [1.0, 1e4])
@pytest.mark.parametrize("method", ["RKF45", "ABAM", "RADAU", "GSTIFF"])
def test_error_is_kept_whatever_the_unit_of_time(method: str, fast: float):
    """Five periods of x = cos(w t), x' of size 1 to w, by steps that ERROR alone decides."""
    w, tolerance = 1.0 * fast, 1e-7
    deck = (
        GROUND
        + "POINT_MASS/2, MASS=1, CM=2, QG=1,0,0\nMARKER/2, POINT_MASS=2\n"
        + f"VFORCE/1, I=2, J_PART=1, FX=-{w * w}*DX(2)\nEND\n"
    )
    end = 10 * math.pi / w
    results = done(deck, end, 10, integrator=method, error=tolerance, hmax=end)
    off = np.abs(results["POINT_MASS/2.x"] - np.cos(w * results.time)).max()
    assert off < 1e3 * tolerance

"""SPLINE with AKISPL, CUBSPL and INTERP: values against scipy, derivatives, ends, families."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scenes import GROUND, assert_derivatives, done, random_state, system
from scipy.interpolate import Akima1DInterpolator, CubicSpline
from test_lookup import BODIES

from adamslite.integrators import contract

RANDOM = np.random.default_rng(3)
X = np.cumsum(RANDOM.uniform(0.1, 1.0, 12)) - 1.0
Y = RANDOM.normal(size=(3, 12))
Z = np.array([-0.5, 1.0, 1.5])
POINT = GROUND + "POINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\n"


def listed(values: np.ndarray) -> str:
    return ",".join(f"{value:.17g}" for value in values)


CURVE = f"SPLINE/1, X={listed(X)}, Y={listed(Y[0])}\n"
FAMILY = f"SPLINE/2, X={listed(X)}" + "".join(
    f"\n, Y={z:.17g}, {listed(y)}" for z, y in zip(Z, Y, strict=True)
)


def values(statements: str, function: str, end: float) -> tuple[np.ndarray, np.ndarray]:
    """Times and values of a function of TIME."""
    deck = POINT + f"{statements}\nVARIABLE/9, FUNCTION={function}\nEND\n"
    results = done(deck, end, 200)
    return results.time, results["VARIABLE/9"]


INSIDE = float(X[-1] - X[0])
SCIPY: dict[str, Callable] = {
    "AKISPL": lambda y: Akima1DInterpolator(X, y),
    "CUBSPL": lambda y: CubicSpline(X, y, bc_type="natural"),
}


@pytest.mark.parametrize("order", range(3))
@pytest.mark.parametrize("name", SCIPY)
def test_values_and_derivatives_are_those_of_scipy(name: str, order: int) -> None:
    """At all times but the first and the last, which are the ends of the table."""
    t, found = values(CURVE, f"{name}(TIME+({X[0]:.17g}),0,1,{order})", INSIDE)
    expected = SCIPY[name](Y[0])(t + X[0], nu=order)
    size = np.abs(expected[1:-1]).max()
    assert found[1:-1] == pytest.approx(expected[1:-1], abs=1e-11 * size)


@pytest.mark.parametrize(("method", "order"), [(1, 0), (1, 1), (3, 0), (3, 1), (3, 2)])
def test_interp_is_linear_or_cubic(method: int, order: int) -> None:
    t, found = values(CURVE, f"INTERP(TIME+({X[0]:.17g}),{method},1,{order})", INSIDE)
    x = t + X[0]
    if method == 3:
        expected = SCIPY["CUBSPL"](Y[0])(x, nu=order)
    elif order == 0:
        expected = np.interp(x, X, Y[0])
    else:
        expected = (np.diff(Y[0]) / np.diff(X))[np.searchsorted(X[1:-1], x, side="right")]
    assert found[1:-1] == pytest.approx(expected[1:-1], abs=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("name", SCIPY)
@pytest.mark.parametrize("side", [-1, 1])
def test_beyond_its_ends_a_curve_is_a_parabola_or_its_tangent(name: str, side: int) -> None:
    end, three = (X[-1], slice(-3, None)) if side > 0 else (X[0], slice(0, 3))
    call = f"{name}({side}*TIME+({end:.17g}),0,1)"
    t, found = values(CURVE, call, 2.0)
    parabola = np.polyval(np.polyfit(X[three] - end, Y[0][three], 2), side * t)
    assert found == pytest.approx(parabola, abs=1e-10 * np.abs(parabola).max())
    t, found = values(CURVE.replace(", X", ", LINEAR_EXTRAPOLATE, X"), call, 2.0)
    inner = SCIPY[name](Y[0])
    tangent = inner(end) + inner(end, nu=1) * side * t
    assert found == pytest.approx(tangent, abs=1e-10 * np.abs(tangent).max())


@pytest.mark.parametrize("name", SCIPY)
def test_a_family_is_linear_between_its_curves_and_beyond(name: str) -> None:
    """z from -1 to 2: before the first of three curves, between them, and after the last."""
    t, found = values(FAMILY, f"{name}({X[0]:.17g}+TIME*{INSIDE / 3:.17g},TIME-1,2)", 3.0)
    x, z = X[0] + t * INSIDE / 3, t - 1
    curves = np.array([SCIPY[name](y)(np.minimum(x, X[-1])) for y in Y])
    k = np.where(z < Z[1], 0, 1)
    share = (z - Z[k]) / (Z[k + 1] - Z[k])
    low, high = (np.take_along_axis(curves, each[None], 0)[0] for each in (k, k + 1))
    expected = low + share * (high - low)
    assert found[1:-1] == pytest.approx(expected[1:-1], abs=1e-10 * np.abs(curves).max())


def test_derivatives_by_the_state_are_exact() -> None:
    text = f"""{BODIES}{CURVE}{FAMILY}
DIFF/1, FUNCTION=AKISPL(DX(21),0,1)*CUBSPL(SIN(VX(21)),0,1,1)
DIFF/2, FUNCTION=AKISPL(DY(21),0.7*SIN(DZ(21)),2)+INTERP(DX(21),3,1,2)
VARIABLE/3, FUNCTION=CUBSPL(SIN(DX(21)),COS(DY(21)),2)
DIFF/3, FUNCTION=DDT(3)
END
"""
    scene = system(text)
    random_state(scene)
    assert_derivatives(scene, contract.ROWS)


@pytest.mark.parametrize("name", ["AKISPL(TIME,0,1)", "INTERP(TIME,1,1)", "CUBSPL(TIME,0,1)"])
def test_a_run_may_end_where_its_table_ends(name: str) -> None:
    """A table of a straight line with a bend just before its end: its parabola leaves steeply."""
    spline = "SPLINE/1, X=0,1,2,2.5,3, Y=0,1,2,2.5,4\n"
    deck = POINT + spline + f"VFORCE/1, I=2, J_PART=1, FX={name}\\FY=0\\FZ=0\nEND\n"
    results = done(deck, 3.0, 3, error=1e-8)
    assert results["POINT_MASS/2.ax"] == pytest.approx([0.0, 1.0, 2.0, 4.0], abs=1e-9)


def test_a_motion_may_end_where_its_table_ends() -> None:
    """The slope of the natural spline at its last point, not that of the parabola beyond."""
    spline = "SPLINE/1, X=0,1,2,2.5,3, Y=0,1,2,2.5,4\n"
    deck = BODIES + spline + "MOTION/1, I=20, J=1, X, FUNCTION=CUBSPL(TIME,0,1)\nEND\n"
    results = done(deck, 3.0, 3, error=1e-6)
    slope = CubicSpline([0, 1, 2, 2.5, 3], [0, 1, 2, 2.5, 4], bc_type="natural")(3.0, nu=1)
    assert results["PART/2.vx"][-1] == pytest.approx(slope, abs=1e-6)


def test_a_command_changes_the_points() -> None:
    from adamslite.reading.read import read, read_commands

    deck = read("title\nPART/1, GROUND\nSPLINE/1, X=0,1,2,3, Y=0,0,0,0, LINEAR_EXTRAPOLATE\nEND\n")
    (command,) = read_commands("SPLINE/1, X=0,1,2,3,4, Y=0,1,2,3,4\n", deck)
    spline = deck.after(command).find("SPLINE", 1)
    assert spline.x == (0, 1, 2, 3, 4) and spline.y == ((0, 1, 2, 3, 4),)
    assert spline.linear_extrapolate


def oscillator(force: str, statements: str = "") -> str:
    """1 kg that starts from rest at 0.9."""
    start = GROUND + "POINT_MASS/2, MASS=1, CM=2, QG=0.9,0,0\nMARKER/2, POINT_MASS=2\n"
    return start + statements + f"VFORCE/1, I=2, J_PART=1, FX={force}\\FY=0\\FZ=0\nEND\n"


@pytest.mark.parametrize("formula", ["GSTIFF", "RADAU", "HHT", "ABAM"])
def test_the_corners_of_straight_lines_are_events(formula: str) -> None:
    """10 N/m on one side, 4 N/m on the other: the run is that of an IF; without events ABAM is off
    by 7e-3 after ten periods, with them by 4e-6.
    """
    table = "SPLINE/1, X=-2,-1,0,1,2, Y=40,10,0,-4,-30\n"
    end = 10 * (np.pi / 2 + np.pi / np.sqrt(10))
    both = [
        done(deck, end, 10, integrator=formula)["POINT_MASS/2.x"]
        for deck in (
            oscillator("INTERP(DX(2),1,1)", table),
            oscillator("IF(DX(2): -10*DX(2), 0, -4*DX(2))"),
        )
    ]
    assert both[0] == pytest.approx(both[1], abs=1e-9)
    if formula == "ABAM":
        assert both[0][-1] == pytest.approx(0.9, abs=1e-4)


def test_beyond_all_corners_and_on_the_way_back() -> None:
    """No force up to 2, -3 (x - 2) from there on, also beyond the table: 1 kg comes with 3 m/s,
    turns at 2 + 3/sqrt(3) and is back with -3 m/s after half a period of the spring.
    """
    table = "SPLINE/1, X=-2,0,1,2,2.5, Y=0,0,0,0,-1.5, LINEAR_EXTRAPOLATE\n"
    deck = oscillator("INTERP(DX(2),1,1)", table).replace("QG=0.9,0,0", "QG=0.9,0,0, VX=3")
    swing = np.pi / np.sqrt(3)
    results = done(deck, 2 * 1.1 / 3 + swing, 400, error=1e-7)
    assert results["POINT_MASS/2.x"].max() == pytest.approx(2 + np.sqrt(3), abs=1e-4)
    assert results["POINT_MASS/2.x"][-1] == pytest.approx(0.9, abs=1e-5)
    assert results["POINT_MASS/2.vx"][-1] == pytest.approx(-3.0, abs=1e-5)


@pytest.mark.parametrize("formula", ["GSTIFF", "RADAU", "HHT", "ABAM"])
def test_a_family_meets_its_curves_in_events(formula: str) -> None:
    """Stiffness 4 N/m for z = x > 0, 4 - 6 z below, the last two curves being alike.

    Without events the runs differ by their errors, 1e-4 and more; with them by round-off.
    """
    rows = [(z, 2 * k, k, 0, -k, -2 * k) for z, k in ((-1, 10), (0, 4), (2, 4))]
    curves = "".join(f"\n, Y={','.join(map(str, row))}" for row in rows)
    table = f"SPLINE/1, X=-2,-1,0,1,2{curves}\n"
    both = [
        done(deck, 20.0, 10, integrator=formula)["POINT_MASS/2.x"]
        for deck in (
            oscillator("CUBSPL(DX(2),DX(2),1)", table),
            oscillator("IF(DX(2): -(4-6*DX(2))*DX(2), 0, -4*DX(2))"),
        )
    ]
    assert both[0] == pytest.approx(both[1], abs=1e-7)

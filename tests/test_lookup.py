"""Values and derivatives of tables: in native code, in plain Python, in a kernel."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator

import numpy as np
import pytest
from scenes import GROUND, assert_derivatives, done, random_state, run, system
from scipy.interpolate import Akima1DInterpolator, CubicSpline
from scipy.special import ellipk
from tiers import every

import adamslite as al
from adamslite.integrators import contract
from adamslite.kernels.code.lookup import lookup as in_python
from adamslite.kernels.code.lookup import on_piece, piece_at
from adamslite.language.function import FUNCTIONS, function
from adamslite.language.statement import STATEMENTS, Statement, choice, statement, vector
from adamslite.native import compiler
from adamslite.native.translate import symbol
from adamslite.native.translate.modules import method_text
from adamslite.results.outcomes import Outcome
from adamslite.symbolic.formulas import lookup, lookup_between
from adamslite.symbolic.interpolant import BEYOND, Interpolant, interpolant

RANDOM = np.random.default_rng(7)
X = np.cumsum(RANDOM.uniform(0.05, 1.0, 40)) - 3.0
Y = RANDOM.normal(size=40)
RING = np.append(Y[:-1], Y[0])
REFERENCES = {
    "akima": lambda: Akima1DInterpolator(X, Y, extrapolate=True),
    "natural": lambda: CubicSpline(X, Y, bc_type="natural"),
    "not-a-knot": lambda: CubicSpline(X, Y),
    "periodic": lambda: CubicSpline(X, RING, bc_type="periodic", extrapolate=True),
}
INSIDE = np.concatenate([X, RANDOM.uniform(X[0], X[-1], 300)])
OUTSIDE = np.concatenate([X[0] - RANDOM.uniform(0, 2, 20), X[-1] + RANDOM.uniform(0, 2, 20)])


def values(kind: str) -> np.ndarray:
    return RING if kind == "periodic" else Y


def table(kind: str, beyond: str = "parabola") -> Interpolant:
    return interpolant(X, values(kind)[:, None], kind, beyond)


@pytest.fixture(scope="module")
def in_native_code() -> Callable[..., float]:
    """``lookup`` compiled: f(T, x, z, order, z_order)."""
    code = compiler.object_code(method_text(in_python))
    name = symbol(in_python)
    address = compiler.addresses([(code, [name])])[name]
    real, whole = ctypes.c_double, ctypes.c_int64
    call = ctypes.CFUNCTYPE(real, ctypes.c_void_p, real, real, whole, whole)(address)
    return lambda T, *given: call(T.ctypes.data, *given)


@pytest.mark.numerical
@pytest.mark.parametrize("kind", REFERENCES)
@pytest.mark.parametrize("order", every(2, range(5)))
def test_between_its_points_a_table_is_what_scipy_makes_of_them(
    kind: str, order: int, in_native_code: Callable[..., float]
) -> None:
    made, reference = table(kind, "piece"), REFERENCES[kind]()
    expected = reference(np.append(INSIDE, OUTSIDE), nu=order)
    found = [in_native_code(made.data, x, 0.0, order, 0) for x in (*INSIDE, *OUTSIDE)]
    size = np.abs(expected).max() + 1.0
    assert np.array(found) == pytest.approx(expected, abs=1e-12 * size)
    assert made.at(np.append(INSIDE, OUTSIDE), order)[:, 0] == pytest.approx(
        found, abs=1e-13 * size
    )
    plain = [in_python(made.data, x, 0.0, order, 0) for x in (*INSIDE, *OUTSIDE)]
    assert plain == pytest.approx(found, abs=1e-13 * size)


@pytest.mark.parametrize("kind", ["natural", "not-a-knot", "periodic"])
def test_few_points_and_uneven_ones_are_those_of_scipy_too(kind: str) -> None:
    """Distances up to 1000 times as long as others."""
    random = np.random.default_rng(5)
    for n in (3, 4, 5, 8, 13, 500):
        x, y = np.cumsum(10.0 ** random.uniform(-3.0, 0.0, n)), random.normal(size=(n, 2))
        y[-1] = y[0]
        at = np.linspace(x[0], x[-1], 200)
        expected = CubicSpline(x, y, bc_type=kind)(at)
        found = interpolant(x, y, kind).at(at)
        assert found == pytest.approx(expected, abs=1e-9 * np.abs(expected).max()), n


def test_straight_lines_lead_from_point_to_point() -> None:
    made = table("linear", "constant")
    everywhere = np.append(INSIDE, OUTSIDE)
    assert made.at(everywhere)[:, 0] == pytest.approx(np.interp(everywhere, X, Y), abs=1e-13)
    piece = np.searchsorted(X[1:-1], INSIDE, side="right")
    slope = (np.diff(Y) / np.diff(X))[piece]
    assert made.at(INSIDE, 1)[:, 0] == pytest.approx(slope)
    assert not made.at(everywhere, 2).any()


@pytest.mark.parametrize("kind", ["linear", *REFERENCES])
@pytest.mark.parametrize("side", [0, 1])
def test_beyond_its_ends_a_table_follows_the_rule_it_was_given(kind: str, side: int) -> None:
    """Parabola through three points by Lagrange; the others from value and slope at the end."""
    y, end = values(kind), (X[0], X[-1])[side]
    x = OUTSIDE[OUTSIDE > end] if side else OUTSIDE[OUTSIDE < end]
    three = slice(-3, None) if side else slice(0, 3)
    hairs = np.array([end - 1e-12] if side else [end])
    slope = table(kind, "piece").at(hairs, 1)[0, 0]
    lines = {
        "parabola": np.polyfit(X[three] - end, y[three], 2),
        "tangent": [slope, y[three][-side]],
        "constant": [y[three][-side]],
    }
    for beyond, line in lines.items():
        for order in range(3):
            expected = np.polyval(np.polyder(np.poly1d(line), order), x - end)
            found = table(kind, beyond).at(x, order)[:, 0]
            assert found == pytest.approx(expected, rel=1e-9, abs=1e-10), (beyond, order)


@pytest.mark.parametrize("kind", ["linear", *REFERENCES])
def test_the_last_point_belongs_to_the_last_piece(
    kind: str, in_native_code: Callable[..., float]
) -> None:
    """Whatever the table is beyond it: slope and curvature are those from inside."""
    inside = table(kind, "piece")
    for beyond in BEYOND:
        made = table(kind, beyond)
        for order in range(4):
            expected = inside.at(X[-1:] - 1e-13, order)[0, 0]
            for code in (in_native_code, in_python):
                found = code(made.data, X[-1], 0.0, order, 0)
                assert found == pytest.approx(expected, rel=1e-9, abs=1e-9), (beyond, order)


@pytest.mark.parametrize("beyond", BEYOND)
def test_two_points_are_a_straight_line_to_every_kind(beyond: str) -> None:
    for kind in ("linear", "akima", "natural", "not-a-knot"):
        made = interpolant([1.0, 3.0], [[2.0], [8.0]], kind, beyond)
        found = made.at(np.array([0.0, 1.0, 2.0, 3.0, 5.0]))[:, 0]
        ends = (2.0, 8.0) if beyond == "constant" else (-1.0, 14.0)
        assert found == pytest.approx([ends[0], 2.0, 5.0, 8.0, ends[1]]), kind


def test_the_derivative_on_a_piece_agrees_with_a_complex_step() -> None:
    made = table("akima").data
    for x in (*INSIDE, *OUTSIDE):
        piece = piece_at(made, x)
        for order in range(4):
            step = on_piece(made, piece, 0, x + 1e-30j, order)
            slope = step.imag / 1e-30 if isinstance(step, complex) else 0.0
            assert on_piece(made, piece, 0, x, order + 1) == pytest.approx(slope, rel=1e-13)


PLACES = np.array([-1.0, 0.5, 2.0])
CURVES = RANDOM.normal(size=(40, 3))


@pytest.mark.numerical
@pytest.mark.parametrize("z", [-2.0, -1.0, 0.0, 0.5, 1.7, 2.0, 3.0])
def test_two_arguments_are_curves_with_straight_lines_between(
    z: float, in_native_code: Callable[..., float]
) -> None:
    made = interpolant(X, CURVES, "akima", places=PLACES)
    k = 0 if z < 0.5 else 1
    low, high = (Akima1DInterpolator(X, CURVES[:, c]) for c in (k, k + 1))
    share = (z - PLACES[k]) / (PLACES[k + 1] - PLACES[k])
    for x in INSIDE[40:80]:
        for order in range(3):
            a, b = low(x, nu=order), high(x, nu=order)
            slope = (b - a) / (PLACES[k + 1] - PLACES[k])
            expected = [a + share * (b - a), slope, 0.0]
            for z_order in range(3):
                found = in_native_code(made.data, x, z, order, z_order)
                assert found == pytest.approx(expected[z_order], rel=1e-11, abs=1e-11)


def test_a_table_of_one_curve_is_the_same_at_every_z(in_native_code: Callable[..., float]) -> None:
    made = table("akima").data
    assert in_native_code(made, 0.3, 9.0, 1, 0) == in_native_code(made, 0.3, 0.0, 1, 0)
    assert in_native_code(made, 0.3, 9.0, 0, 1) == 0.0


def test_what_is_not_a_number_stays_so(in_native_code: Callable[..., float]) -> None:
    made = interpolant(X, CURVES, "natural", places=PLACES).data
    for given in ((np.nan, 0.0), (0.0, np.nan)):
        assert np.isnan(in_native_code(made, *given, 0, 0))


@pytest.fixture
def tables() -> Iterator[None]:
    """A statement TABLE and the functions TABLE1(x, id) and TABLE2(x, z, id)."""

    @statement("TABLE", data=True)
    class Table(Statement):
        """Curves over common knots."""

        kind: str = choice("KIND", options=("LINEAR", "AKIMA", "NATURAL"), default="AKIMA", help="")
        x: tuple[float, ...] = vector("X", size=2, most=10**6, unit="", help="")
        y: tuple[float, ...] = vector("Y", size=2, most=10**6, unit="", help="")
        places: tuple[float, ...] = vector("Z", size=1, most=99, unit="", help="")

        def derived(self, model: object) -> dict:
            curves = np.reshape(self.y, (len(self.places), len(self.x))).T
            return {"values": interpolant(self.x, curves, self.kind.lower(), places=self.places)}

    @function("TABLE1", "x:number id:table")
    def one(scope, x, id):
        return lookup(scope.statement(id).values, x)

    @function("TABLE2", "x:number z:number id:table")
    def two(scope, x, z, id):
        return lookup_between(scope.statement(id).values, x, z)

    yield
    for name in ("TABLE1", "TABLE2"):
        del FUNCTIONS[name]
    del STATEMENTS["TABLE"]


def written(name: int, kind: str, n: int, places: tuple[float, ...] = (-1.0, 0.0, 1.0)) -> str:
    """A statement TABLE of n points: sin(x) cos(z)."""
    x, z = np.linspace(-3.0, 3.0, n), np.array(places)
    y = np.sin(x) * np.cos(z)[:, None]
    rows = (",".join(f"{v:.17g}" for v in each.ravel()) for each in (x, y, z))
    return "TABLE/{}, KIND={}, X={}, Y={}, Z={}\n".format(name, kind, *rows)


BODIES = (
    GROUND
    + """PART/2, MASS=2, CM=20, IP=1,2,3,0.1,0.2,0.3, QG=1,2,3, REULER=0.5,0.6,0.7
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.2,0.4,-0.3, REULER=0.9,0.4,0.2
"""
)


@pytest.mark.usefixtures("tables")
@pytest.mark.parametrize("kind", ["AKIMA", "NATURAL"])
def test_an_expression_of_a_table_has_exact_derivatives(kind: str) -> None:
    """Also where it is differentiated by time: DDT of a VARIABLE."""
    text = BODIES + written(1, kind, 9) + written(2, "AKIMA", 7)
    text += """DIFF/1, FUNCTION=TABLE1(DX(21), 1)*TABLE1(SIN(VX(21)), 2)
DIFF/2, FUNCTION=TABLE2(DY(21), 0.7*SIN(DZ(21)), 1)
VARIABLE/3, FUNCTION=TABLE2(SIN(DX(21)), COS(DY(21)), 2)
DIFF/3, FUNCTION=DDT(3)
END
"""
    scene = system(text)
    random_state(scene)
    assert_derivatives(scene, contract.ROWS)


@pytest.mark.usefixtures("tables")
def test_tables_of_any_length_share_their_code() -> None:
    """x'' = -f(x) with f = sin from a table: after the period of a pendulum x is 1 again."""

    def deck(n: int) -> str:
        text = GROUND + written(1, "NATURAL", n, (0.0,)) + "POINT_MASS/4, MASS=1, CM=40, QG=1,0,0\n"
        text += "MARKER/40, POINT_MASS=4\n"
        return text + "VFORCE/1, I=40, J_PART=1, FX=-TABLE1(DX(40),1)\\FY=0\\FZ=0\nEND\n"

    few, many = (al.compile_model(al.assemble(al.read(deck(n)))) for n in (60, 3000))
    assert many.compiled == 0
    assert [g.name for g in few.groups] == [g.name for g in many.groups]
    results = al.simulate(many, end=4.0 * ellipk(np.sin(0.5) ** 2), steps=1, error=1e-8)
    assert results["POINT_MASS/4.x"][-1] == pytest.approx(1.0, abs=1e-6)


@pytest.mark.usefixtures("tables")
@pytest.mark.parametrize("formula", ["GSTIFF", "HHT", "RADAU", "ABAM"])
def test_a_brief_pulse_in_a_table_of_time_gives_its_impulse(formula: str) -> None:
    """Two triangles of 2 ms within 10 s, of 3 N s and -1 N s, with zeros between."""
    places = [0.0, 2.0, 2.001, 2.002, 5.0, 7.7, 7.701, 7.702, 10.0]
    heights = [0.0, 0.0, 3000.0, 0.0, 0.0, 0.0, -1000.0, 0.0, 0.0]
    values = ",".join(map(repr, places)), ",".join(map(repr, heights))
    text = GROUND + "TABLE/1, KIND=LINEAR, X={}, Y={}, Z=0\n".format(*values)
    text += "POINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\n"
    text += "VARIABLE/1, FUNCTION=TABLE1(TIME,1)\n"
    for force in ("TABLE1(TIME,1)", "TABLE2(TIME,0.3*TIME,1)", "VARVAL(1)"):
        deck = text + f"VFORCE/1, I=2, J_PART=1, FX={force}\\FY=0\\FZ=0\nEND\n"
        results = done(deck, 10.0, 10, integrator=formula, error=1e-5)
        assert results["POINT_MASS/2.vx"][-1] == pytest.approx(2.0, abs=4e-4), force


@pytest.mark.usefixtures("tables")
def test_a_motion_can_follow_a_table() -> None:
    """sin(t) from a table of 60 points: the spline is off by 1e-6, its bend by 1e-3."""
    motion = "MOTION/1, I=20, J=1, X, FUNCTION=TABLE1(TIME, 1)\nREQUEST/1, F1=DX(20)\\F2=ACCX(20)\n"
    results = done(BODIES + written(1, "NATURAL", 60, (0.0,)) + motion + "END\n", 2.0, error=1e-6)
    start = results["REQUEST/1.F1"][0]
    assert start == pytest.approx(0.0, abs=1e-6)
    assert results["REQUEST/1.F1"] == pytest.approx(np.sin(results.time), abs=5e-6)
    assert results["REQUEST/1.F2"] == pytest.approx(-np.sin(results.time), abs=2e-3)


@pytest.mark.usefixtures("tables")
def test_a_motion_cannot_follow_the_corners_of_a_table() -> None:
    """Straight lines between points of sin(t): the velocity jumps at the first of them."""
    motion = "MOTION/1, I=20, J=1, X, FUNCTION=TABLE1(TIME+0.1, 1)\n"
    results = run(BODIES + written(1, "LINEAR", 61, (0.0,)) + motion + "END\n", 2.0)
    assert results.outcome is Outcome.BROKEN_MOTION


@pytest.mark.parametrize(
    ("formula", "most"), [("GSTIFF", 1.1), ("RADAU", 1.1), ("HHT", 1.1), ("ABAM", 2.1)]
)
@pytest.mark.parametrize("lines", [100, 1000])
def test_straight_lines_of_time_take_a_step_or_two_each(
    formula: str, most: float, lines: int
) -> None:
    """A mass is pushed by chords of 10 sin 2t, whose integral is exact, or by that sine itself.

    The errors are of one size: v = 5 (1 - cos 2t) of the sine.
    """
    times = np.linspace(0.0, 10.0, lines + 1)
    force = 10.0 * np.sin(2.0 * times)
    chords = np.concatenate([[0.0], np.cumsum(np.diff(times) * (force[1:] + force[:-1]) / 2)])
    listed = ",".join(map(repr, times.tolist())), ",".join(map(repr, force.tolist()))
    deck = (
        "chords\nPART/1, GROUND\nMARKER/1, PART=1\nPOINT_MASS/2, MASS=1, CM=2\n"
        f"MARKER/2, POINT_MASS=2\nSPLINE/1, X={listed[0]}, Y={listed[1]}\n"
        "VFORCE/1, I=2, J_PART=1, FX={}\\FY=0\\FZ=0\nEND\n"
    )
    chord, sine = (
        done(deck.format(law), 10.0, 10, integrator=formula, error=1e-3)
        for law in ("INTERP(TIME,1,1)", "10*SIN(2*TIME)")
    )
    assert chord.summary["steps"] <= most * max(lines, 300)
    left = np.abs(sine["POINT_MASS/2.vx"] - 5.0 * (1.0 - np.cos(2.0 * sine.time))).max()
    exact = np.interp(chord.time, times, chords)
    assert np.abs(chord["POINT_MASS/2.vx"] - exact).max() <= 2.0 * left

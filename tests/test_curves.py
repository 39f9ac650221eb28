"""CURVE and PTCV: points that are many, given twice, or few."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import GROUND, done, run

import adamslite as al
from adamslite.elements.bases.spline_curve import guided, through


def bead(points: np.ndarray, form: str, start: np.ndarray) -> str:
    """A mass of 2 on a curve, drawn at ``start`` with the velocity (0, 3, 0)."""
    values = "\n,".join(",".join(f"{v:.15g}" for v in point) + "," for point in points)
    return f"""{GROUND}MATRIX/1, ROWS={len(points)}, COLUMNS=3, VALUES=
,{values.rstrip(",")}
CURVE/1, {form}, MATRIX=1, CURVE_POINTS
POINT_MASS/4, MASS=2, CM=40, QG={",".join(f"{v:.15g}" for v in start)}, VY=3
MARKER/40, POINT_MASS=4
PTCV/1, I=40, CURVE=1, RM=1
REQUEST/1, F1=DM(40)\\F2=VM(40)\\F3=PTCV(1,0,1,0)
END
"""


def circle(n: int) -> np.ndarray:
    angle = np.linspace(0.0, 2.0 * np.pi, n + 1)
    ring = np.column_stack([np.cos(angle), np.sin(angle), 0.0 * angle])
    ring[-1] = ring[0]
    return ring


def test_curves_of_ten_and_of_thousands_of_points_share_their_code() -> None:
    decks = (al.read(bead(circle(n), "CLOSED", np.array([1.0, 0.0, 0.0]))) for n in (10, 5000))
    few, many = (al.compile_model(al.assemble(deck)) for deck in decks)
    assert many.compiled == 0
    assert [g.name for g in few.groups] == [g.name for g in many.groups]


def test_a_bead_on_a_fine_circle_keeps_radius_speed_and_reaction() -> None:
    """Reaction m v^2/r = 18; of 2000 points the spline's curvature is off by 1e-6 of it."""
    deck = bead(circle(2000), "CLOSED", np.array([1.0, 0.0, 0.0]))
    results = done(deck, end=3.0, error=1e-9)
    assert results["REQUEST/1.F1"] == pytest.approx(1.0, abs=1e-7)
    assert results["REQUEST/1.F2"] == pytest.approx(3.0, abs=1e-6)
    assert results["REQUEST/1.F3"] == pytest.approx(18.0, rel=2e-6)


def test_a_point_given_twice_counts_once() -> None:
    points = np.array([[0.0, 0, 0], [1, 1, 0], [2, 0, 1], [3, 0, 0], [4, 2, 0]])
    once, twice = (through(p, False) for p in (points, points[[0, 1, 1, 2, 3, 4, 4]]))
    s = np.linspace(-0.1, 1.1, 50)
    assert twice.length == once.length
    assert np.array_equal(once.table.at(s), twice.table.at(s))


def test_three_points_are_a_parabola_and_two_a_straight_line() -> None:
    line = through([[0, 0, 0], [2, 4, 4]], False)
    assert line.table.at(np.array([0.5]))[0] == pytest.approx([1.0, 2.0, 2.0])
    bow = through([[0, 0, 0], [1, 1, 0], [2, 0, 0]], False)
    assert bow.table.at(np.array([0.25]))[0] == pytest.approx([0.5, 0.75, 0.0])


def test_the_nearest_point_is_found_on_long_and_short_pieces() -> None:
    """Between points very unevenly apart, and beyond an end, where the curve goes on."""
    x = np.array([0.0, 1e-3, 2e-3, 1.0, 5.0, 5.001, 9.0])
    curve = through(np.column_stack([x, 0 * x, 0 * x]), False)
    for at in (0.0005, 0.7, 3.0, 8.9, 9.5, -0.2):
        assert curve.nearest(np.array([at, 0.3, 0.0])) == pytest.approx(at / 9.0, abs=1e-12)


def test_a_seam_is_closed_where_the_points_leave_it_open_by_round_off() -> None:
    points = circle(12)
    points[-1] = [1.0, 1e-8, 0.0]
    s = np.array([0.0, 1.0])
    first, last = through(points, True).table.at(s)
    assert np.array_equal(first, [1.0, 0.0, 0.0])
    assert last == pytest.approx(first, abs=1e-15)


@pytest.mark.parametrize("closed", [False, True])
def test_no_point_of_a_curve_is_nearer_than_the_nearest(closed: bool) -> None:
    """Also across the seam, and where the squared distance is not convex."""
    random = np.random.default_rng(3)
    grid = np.linspace(0.0, 1.0, 5001)
    for n in (4, 7, 40):
        for _ in range(20):
            points = random.normal(size=(n, 3)).cumsum(axis=0)
            points[-1] = points[0] if closed else points[-1]
            curve, point = through(points, closed), 3.0 * random.normal(size=3)
            found = np.linalg.norm(curve.at(np.array([curve.nearest(point)])) - point)
            assert found <= np.linalg.norm(curve.at(grid) - point, axis=1).min() + 1e-9


@pytest.mark.parametrize("form", ["OPEN", "CLOSED"])
def test_the_function_goes_through_the_points(form: str) -> None:
    """On equal chords alpha = -1 + 2 t/5 meets a point at each whole t, with the spline's slope."""
    points = np.array([[0, 0, 1], [3, 4, 1], [6, 8, 1], [9, 4, 1], [6, 0, 1], [3, -4, 1]], float)
    points[-1] = points[0] if form == "CLOSED" else points[-1]
    values = ",".join(f"{v:g}" for v in points.ravel())
    shape = through(points, form == "CLOSED")
    names = [f"{'xyz'[comp - 1]}{order}" for order in range(3) for comp in (1, 2, 3)]
    lines = [
        f"VARIABLE/{name}, FUNCTION=CURVE(0.4*TIME-1, {name[1]}, {'xyz'.index(name[0]) + 1}, 1)"
        for name in names
    ]
    found = done(
        f"{GROUND}MATRIX/1, ROWS=6, COLUMNS=3, VALUES={values}\nCURVE/1, {form}, MATRIX=1\n"
        + "\n".join(lines)
        + "\nVARIABLE/more, FUNCTION=CURVE(0.4*TIME+1, 0, 2, 1)\nEND\n",
        end=5,
        steps=25,
    )
    s = np.cumsum(np.append(0, np.linalg.norm(np.diff(points, axis=0), axis=1))) / shape.length
    for order in range(3):
        table = np.array([found[f"VARIABLE/{axis}{order}"] for axis in "xyz"]).T
        assert table == pytest.approx(shape.at(found.time / 5, order) / 2**order, abs=1e-9)
    if np.ptp(np.diff(s)) < 1e-12:
        table = np.array([found[f"VARIABLE/{axis}0"] for axis in "xyz"]).T
        assert table[::5] == pytest.approx(points, abs=1e-12)
    around = found["VARIABLE/more"] - found["VARIABLE/y0"]
    assert (np.abs(around).max() < 1e-12) == (form == "CLOSED")


def ring(n: int, radius: float, centre: tuple[float, float] = (0.0, 0.0)) -> str:
    """The values of a circle."""
    return ",".join(f"{v:.15g}" for v in (circle(n) * radius + [*centre, 0.0]).ravel())


DISC = f"""{GROUND}ACCGRAV/JGRAV=-9.81
MATRIX/1, ROWS=81, COLUMNS=3, VALUES={ring(80, 0.7)}
MATRIX/2, ROWS=81, COLUMNS=3, VALUES={ring(80, 0.3, (0.1, -0.2))}
CURVE/1, CLOSED, MATRIX=1
CURVE/2, CLOSED, MATRIX=2
PART/4, MASS=2, CM=4, IP=1,1,0.1, QG=0.6,-0.8,0, WZ=0.7
MARKER/4, PART=4
MARKER/5, PART=4, QP=-0.1,0.2,0
JPRIM/1, INPLANE, I=4, J=1
JPRIM/2, PARALLEL_AXES, I=4, J=1
"""


def test_a_disc_slides_below_another_one_as_a_pendulum() -> None:
    """Centres 1 m apart: a pendulum of this length; nothing changes the disc's turning.

    The curvature of the spline through 80 points is off by (2 pi/80)^2/12 = 5e-4 at most, its
    normal by 1e-6, its radius by 1e-7.
    """
    text = f"{DISC}CVCV/1, ICURVE=2, JCURVE=1, IRM=5, JRM=1\nVARIABLE/1, FUNCTION=CVCV(1,0,1,0)\n"
    found = done(text + "VARIABLE/2, FUNCTION=CVCV(1,0,8,0)\nEND\n", end=1.0, error=1e-8)
    x, y = found["PART/4.x"], found["PART/4.y"]
    assert np.hypot(x, y) == pytest.approx(1.0, abs=1e-6)
    assert found["PART/4.wz"] == pytest.approx(0.7, abs=1e-5)
    speed = 2 * 9.81 * (-0.8 - y)
    assert found["PART/4.vx"] ** 2 + found["PART/4.vy"] ** 2 == pytest.approx(speed, abs=2e-5)
    assert found["VARIABLE/1"] == pytest.approx(2 * (9.81 * -y + speed), rel=1e-3)


@pytest.mark.slow
def test_knots_of_a_curve_hold_hardly_any_run() -> None:
    """Third derivatives jump at knots, where steps get as short as a small ERROR demands.  When
    what the first iteration of such a step leaves open of velocities is taken for noise, because it
    is less than the round-off of positions over the step, one run in ten ends there.
    """
    text = f"{DISC}CVCV/1, ICURVE=2, JCURVE=1, IRM=5, JRM=1\nEND\n"
    turning = (f"WZ={0.7 + k * 1e-7!r}" for k in range(100))
    ended = [run(text.replace("WZ=0.7", wz), 1.0, error=3e-9).outcome for wz in turning]
    assert ended.count(al.Outcome.DONE) >= 98


@pytest.mark.parametrize(
    ("more", "at"),
    [
        ("", (0.352416, 0.852416)),
        (", IDISP=0.1,-0.5,0", (0.75, None)),
        (", JDISP=0,-0.7,0", (None, 0.75)),
    ],
)
def test_curves_start_where_they_are_closest_or_where_the_deck_has_it(
    more: str, at: tuple[float | None, float | None]
) -> None:
    """The centre of the disc is at (0.6, -0.8): the contact is 53.13 degrees below the x axis."""
    deck = al.read(f"{DISC}CVCV/1, ICURVE=2, JCURVE=1, IRM=5, JRM=1{more}\nEND\n")
    starts = deck.find("CVCV", 1).derived(al.assemble(deck))["starts"]
    for found, expected in zip(starts, at, strict=True):
        assert expected is None or found == pytest.approx(expected, abs=1e-6)


def test_curves_that_cross_start_where_their_normals_are_one_line() -> None:
    """The disc drawn 5 cm too deep: the places where the circles cross are nearer, but no contact.

    Its centre and the other one are on a line 53.13 degrees below the x axis, as if it touched.
    """
    deep = DISC.replace("QG=0.6,-0.8,0", "QG=0.57,-0.76,0")
    deck = al.read(f"{deep}CVCV/1, ICURVE=2, JCURVE=1, IRM=5, JRM=1\nEND\n")
    starts = deck.find("CVCV", 1).derived(al.assemble(deck))["starts"]
    assert starts == pytest.approx((0.352416, 0.852416), abs=1e-6)


def test_a_point_starts_at_the_place_that_the_deck_gives() -> None:
    """A bead drawn off a circle is put on its top, in the axes of a marker turned by 90 degrees."""
    deck = bead(circle(60), "CLOSED", np.array([0.9, 0.3, 0.1]))
    deck = deck.replace("RM=1\n", "RM=1, DISP=1,0,0, ICM=8\nMARKER/8, PART=1, REULER=90D,0,0\n")
    found = done(deck.replace("VY=3", "VX=-3"), end=0.01)
    start = [found[f"POINT_MASS/4.{axis}"][0] for axis in "xyz"]
    assert start == pytest.approx([0.0, 1.0, 0.0], abs=1e-7)
    assert found["POINT_MASS/4.vx"][0] == pytest.approx(-3.0, rel=1e-7)


def test_four_control_points_are_a_bezier_curve() -> None:
    """(1-s)^3 P0 + 3 (1-s)^2 s P1 + 3 (1-s) s^2 P2 + s^3 P3, also a little beyond its ends."""
    points = np.array([[0, 0, 1], [1, 3, 0], [2, -1, 4], [5, 2, 2]], float)
    s = np.linspace(-0.1, 1.1, 13)
    share = np.array([(1 - s) ** 3, 3 * (1 - s) ** 2 * s, 3 * (1 - s) * s**2, s**3])
    assert guided(points, False).at(s) == pytest.approx(share.T @ points, abs=1e-13)


def test_a_ring_of_control_points_closes_smoothly() -> None:
    """At a whole step it is (P0 + 4 P1 + P2)/6, and through the seam its bend is continuous."""
    points = np.random.default_rng(2).normal(size=(7, 3))
    points[-1] = points[0]
    ring = guided(points, True)
    steps = np.arange(6) / 6
    turned = [np.roll(points[:-1], -n, axis=0) for n in range(3)]
    expected = (turned[0] + 4 * turned[1] + turned[2]) / 6
    assert ring.at(steps) == pytest.approx(expected, abs=1e-13)
    for order in range(3):
        near = ring.at(np.array([1e-9, 1 - 1e-9]), order)
        assert near[0] == pytest.approx(near[1], abs=1e-5)


def test_a_deck_may_give_control_points() -> None:
    found = done(
        f"{GROUND}MATRIX/1, ROWS=4, COLUMNS=3, VALUES=0,0,0, 1,3,0, 2,-1,0, 5,2,0\n"
        "CURVE/1, OPEN, MATRIX=1, CONTROL_POINTS\n"
        "VARIABLE/1, FUNCTION=CURVE(2*TIME-1,0,2,1)\nEND\n",
        end=1,
    )
    s = found.time
    expected = 9 * (1 - s) ** 2 * s - 3 * (1 - s) * s**2 + 2 * s**3
    assert found["VARIABLE/1"] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("speed", [3.0, -2.0])
def test_a_bead_starts_at_its_velocity_along_the_curve(speed: float) -> None:
    """On a circle drawn from angle 0 upwards: y' = speed at the right, and it stays."""
    deck = bead(circle(400), "CLOSED", np.array([1.0, 0.0, 0.0]))
    deck = deck.replace("VY=3", "VY=0").replace("RM=1\n", f"RM=1, VELOCITY={speed}\n")
    results = done(deck, end=0.5, error=1e-9)
    assert results["POINT_MASS/4.vy"][0] == pytest.approx(speed, rel=1e-9)
    assert results["REQUEST/1.F2"] == pytest.approx(abs(speed), abs=1e-6)
    assert results["POINT_MASS/4.y"][-1] == pytest.approx(np.sin(0.5 * speed), abs=1e-5)


def test_its_velocity_holds_where_the_posture_closes() -> None:
    """Drawn beside a parabola with unequal chords, and free to move onto it."""
    x = np.array([0.0, 0.3, 1.0, 2.0, 2.5])
    rows = np.column_stack([x, x**2, 0.0 * x])
    deck = bead(rows, "OPEN", np.array([1.3, 1.5, 0.2])).replace("VY=3", "VY=0")
    results = done(deck.replace("RM=1\n", "RM=1, VELOCITY=-1.5\n"), end=0.2, error=1e-9)
    assert results["REQUEST/1.F2"] == pytest.approx(1.5, abs=1e-6)
    assert results["POINT_MASS/4.vx"][0] < 0

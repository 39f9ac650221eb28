"""What is drawn of a deck and its results: numbers of bodies, shapes, joints and channels."""

from __future__ import annotations

import re
from math import cos, pi, sin
from pathlib import Path

import numpy as np
import pytest
from page_scenes import decoded, named, plain_list
from scipy.spatial.transform import Rotation

import adamslite as al
from adamslite.drawing.arrays import Block
from adamslite.drawing.decimation import frames, points
from adamslite.drawing.derived_shapes import tree
from adamslite.drawing.frames import continuous, from_313, from_axes
from adamslite.drawing.scene import Scene, scene
from adamslite.results.results import Results

PENDULUM = """A pendulum in millimetres
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND
ACCGRAV/KGRAV=-9806.65
PART/1, GROUND
MARKER/1, PART=1, QP=10,0,500
! adams_view_name='rod'
PART/2, MASS=2, CM=20, IP=800,800,20, QG=10,0,500, REULER=30D,90D,70D
MARKER/20, PART=2, QP=0,-250,0, REULER=0,90D,0
MARKER/21, PART=2
JOINT/1, REVOLUTE, I=21, J=11
MARKER/11, PART=1, QP=10,0,500, REULER=30D,90D,0D
SIMULATE/DYNAMIC, END=1, STEPS=100
END
"""


def still(text: str, **columns: float) -> Scene:
    """A scene of a deck at one time, with some columns."""
    deck = al.read(text)
    names = tuple(name.replace("_", "/", 1).replace("__", ".") for name in columns)
    values = np.array([list(columns.values())], dtype=float).reshape(1, -1)
    return scene(deck, Results(time=np.zeros(1), names=names, values=values))


# ---- arrays ----------------------------------------------------------------------------------


def test_sixteen_bits_keep_the_range_to_half_a_step() -> None:
    """Values come back to half of 1/65535 of the range of their component; a constant exactly."""
    rng = np.random.default_rng(1)
    values = np.cumsum(rng.normal(size=(400, 3)), axis=0) * [1.0, 1e6, 0.0] + [0.0, 5.0, 0.7]
    block = Block()
    block.f32(np.zeros(3))
    reference = block.i16(values)
    found = decoded(Scene({}, block.text()), reference)
    assert (np.abs(found - values) <= np.ptp(values, axis=0) / 65535 * 0.5001).all()
    assert (found[:, 2] == 0.7).all()


def test_thirty_two_bits_keep_seven_digits_and_what_is_no_number() -> None:
    values = np.array([1.23456789e-12, -7.6e300, np.nan, 1e-60, np.inf])
    block = Block()
    found = decoded(Scene({}, block.text() if (reference := block.f32(values)) else ""), reference)
    assert found[0] == pytest.approx(values[0], rel=1e-7)
    assert found[1] < -3e38 and np.isnan(found[2]) and found[3] == 0.0 and found[4] > 3e38


# ---- attitudes -------------------------------------------------------------------------------


def test_angles_and_axes_give_the_rotation_of_scipy() -> None:
    """Rz(psi) Rx(theta) Rz(phi) against scipy's intrinsic ZXZ, also near its singular postures."""
    rng = np.random.default_rng(2)
    angles = rng.uniform(-pi, pi, (50, 3)) * [1, 0.5, 1] + [0, pi / 2, 0]
    angles[:3, 1] = 0.0, pi, 1e-9
    expected = Rotation.from_euler("ZXZ", angles)
    assert (Rotation.from_quat(from_313(angles)) * expected.inv()).magnitude().max() < 1e-14
    for matrix in expected.as_matrix():
        turned = Rotation.from_matrix(matrix).inv() * Rotation.from_quat(from_axes(matrix))
        assert turned.magnitude() < 1e-14


def test_quaternions_of_full_turns_do_not_jump() -> None:
    """Two turns in steps of 10 degrees: no component changes by more than sin(5 degrees)."""
    angles = np.zeros((73, 3))
    angles[:, 0] = (np.linspace(0, 4 * pi, 73) + pi) % (2 * pi) - pi
    found = continuous(from_313(angles))
    assert np.abs(np.diff(found, axis=0)).max() < sin(np.radians(5)) + 1e-12


# ---- fewer rows ------------------------------------------------------------------------------


def test_frames_are_spread_over_time_and_keep_both_ends() -> None:
    """100 000 rows, most of them in the last hundredth of the time."""
    time = np.concatenate([np.linspace(0, 0.99, 1000), np.linspace(0.99, 1, 99_000)])
    kept = time[frames(time, 6)]
    assert 500 < len(kept) <= 900 and kept[0] == 0 and kept[-1] == 1
    assert np.diff(kept).max() < 2.5 / 900


def test_fewer_points_keep_every_peak() -> None:
    """50 000 rows of noise with one peak each way in every channel."""
    rng = np.random.default_rng(3)
    time = np.linspace(0, 1, 50_000)
    values = rng.normal(size=(50_000, 4))
    values[12_345], values[40_001] = 1000 + np.arange(4), -2000.0
    kept_time, kept = points(time, values)
    assert len(kept_time) == len(kept) <= 2000
    assert (kept.max(axis=0) == values.max(axis=0)).all()
    assert (kept.min(axis=0) == -2000).all()
    assert abs(kept_time[np.argmax(kept[:, 0])] - time[12_345]) < 2e-3
    assert (np.diff(kept_time) >= 0).all()


# ---- bodies ----------------------------------------------------------------------------------


def test_bodies_move_as_the_results_say() -> None:
    """The place of the pin, a marker of the part, stays at the pin in every frame; the mass centre
    is where the result has it.  It swings through less than 500 mm: 16 bits are 4e-3 mm.
    """
    deck = al.read(PENDULUM)
    results = al.simulate(deck)
    drawn = scene(deck, results)
    assert drawn.plain["units"]["length"] == "mm" and drawn.plain["up"] == "z"
    body = named(drawn.plain["bodies"], "PART/2")
    assert body["label"] == "rod" and body["kind"] == "part" and body["mass"] == 2
    position = decoded(drawn, body["position"])
    named_in_results = [results[f"PART/2.{x}"] for x in "xyz"]
    assert np.abs(position - np.stack(named_in_results, axis=1)).max() < 4e-3
    joint = named(drawn.plain["joints"], "JOINT/1", "statement")
    number, *offset = joint["i"][:4]
    attitude = Rotation.from_quat(decoded(drawn, body["attitude"]))
    pin = position + attitude.apply(offset)
    assert drawn.plain["bodies"][int(number)] is body
    assert np.abs(pin - [10, 0, 500]).max() < 0.03
    axis = attitude.apply(Rotation.from_quat(joint["i"][4:]).apply([0, 0, 1]))
    fixed = Rotation.from_quat(joint["j"][4:]).apply([0, 0, 1])
    assert np.abs(axis - fixed).max() < 1e-4


def test_a_part_that_the_results_lack_stays_and_is_named() -> None:
    drawn = still(PENDULUM)
    body = named(drawn.plain["bodies"], "PART/2")
    down = Rotation.from_euler("ZXZ", [30, 90, 70], degrees=True).apply([0, -250, 0])
    assert decoded(drawn, body["position"]) == pytest.approx([10, 0, 500] + down)
    assert drawn.plain["notes"] == ["not in the results, drawn where the deck has it: PART/2"]


def test_a_position_without_a_value_waits_at_the_last_one() -> None:
    deck = al.read(PENDULUM)
    results = al.simulate(deck)
    results.values[50:, 0] = np.nan
    drawn = scene(deck, results)
    position = decoded(drawn, named(drawn.plain["bodies"], "PART/2")["position"])
    assert np.isfinite(position).all()
    assert (position[50:] == position[49]).all() and np.ptp(position[:, 2]) > 1
    assert drawn.plain["notes"] == ["no position at some times, drawn at the last one: PART/2"]


def test_a_run_that_goes_back_in_time_is_drawn_once() -> None:
    """A RELOAD from t = 3 back to t = 1: the later rows count, and one without a time does not."""
    deck = al.read(PENDULUM)
    time = np.array([0.0, 1.0, 2.0, 3.0, 1.0, 2.0, np.nan, 4.0])
    names = ("PART/2.x", "PART/2.y", "PART/2.z")
    values = np.arange(8.0)[:, None] * [1.0, 0.0, 0.0]
    drawn = scene(deck, Results(time=time, names=names, values=values))
    assert decoded(drawn, drawn.plain["times"]).tolist() == [0, 1, 1, 2, 4]
    position = decoded(drawn, named(drawn.plain["bodies"], "PART/2")["position"])
    assert position[:, 0] == pytest.approx([0, 1, 4, 5, 7], abs=1e-3)
    assert "the times go back" in drawn.plain["notes"][0]


def test_places_beyond_all_numbers_are_none() -> None:
    """Of a run that blew up: the part waits at its last place."""
    deck = al.read(PENDULUM)
    values = np.array([[1.0, 2.0, 3.0], [1e300, 2.0, 3.0], [np.inf, 2.0, 3.0]])
    names = ("PART/2.x", "PART/2.y", "PART/2.z")
    drawn = scene(deck, Results(time=np.arange(3.0), names=names, values=values))
    assert named(drawn.plain["bodies"], "PART/2")["position"] == [1, 2, 3]


@pytest.mark.slow
def test_many_channels_are_kept_to_a_share_of_their_range() -> None:
    """300 000 numbers: to half of 1/8191 of the range each, beside one that has gaps."""
    deck = al.read(PENDULUM)
    rng = np.random.default_rng(4)
    values = np.cumsum(rng.normal(size=(1000, 301)), axis=0) * 10.0 ** rng.integers(-9, 9, 301)
    values[3, 300] = np.nan
    names = tuple(f"VARIABLE/{k}" for k in range(301))
    drawn = scene(deck, Results(time=np.arange(1000.0), names=names, values=values))
    listed = plain_list(drawn, drawn.plain["channels"]["list"])
    assert [each["name"] for each in listed] == list(names)
    for k, each in enumerate(listed):
        found = decoded(drawn, each["values"])
        allowed = np.nanmax(values[:, k]) - np.nanmin(values[:, k])
        assert np.nanmax(np.abs(found - values[:, k])) <= allowed / 8191 * 0.51
    assert np.isnan(found[3]) and np.isfinite(found[4:]).all()


# ---- shapes ----------------------------------------------------------------------------------


def shape_of(line: str) -> dict:
    """The first shape of a part with one GRAPHICS statement."""
    deck = PENDULUM.replace("SIMULATE", f"{line}\nSIMULATE")
    return still(deck).plain["shapes"][0]


@pytest.mark.parametrize(
    ("line", "sizes"),
    [
        (
            "CYLINDER, CM=20, LENGTH=-30, RADIUS=4",
            {"length": -30, "radius": 4, "angle": pytest.approx(2 * pi)},
        ),
        (
            "CYLINDER, CM=20, LENGTH=30, RM=21",
            # The pin is 250 mm along y of the part from CM, whose z is -y of the part: on its axis.
            {"length": 30, "radius": pytest.approx(0, abs=1e-12), "angle": pytest.approx(2 * pi)},
        ),
        (
            "FRUSTUM, CM=20, LENGTH=5, BOTTOM=1, TOP=2, RANGLE=90D",
            {"length": 5, "bottom": 1, "top": 2, "angle": pytest.approx(pi / 2)},
        ),
        ("BOX, CORNER=20, X=1, Y=-2, Z=3", {"x": 1, "y": -2, "z": 3}),
        ("ELLIPSOID, CM=20, XSCALE=2, YSCALE=4, ZSCALE=6", {"x": 2, "y": 4, "z": 6}),
        ("TORUS, CM=20, MAJOR_RADIUS=5, MINOR_RADIUS=1", {"major": 5, "minor": 1}),
        ("CIRCLE, CM=20, RADIUS=5", {"radius": 5}),
        ("ARC, CM=20, RADIUS=5, RANGLE=60D", {"radius": 5, "angle": pytest.approx(pi / 3)}),
        (
            "PLANE, RM=20, XMIN=-1, XMAX=1, YMIN=-2, YMAX=2",
            {"xmin": -1, "xmax": 1, "ymin": -2, "ymax": 2},
        ),
        ("POINT, RM=20", {}),
    ],
)
def test_shapes_have_the_sizes_of_their_statement(line: str, sizes: dict) -> None:
    """In the frame of their marker: at the mass centre, turned by 90 degrees about x."""
    shape = shape_of(f"GRAPHICS/7, {line}")
    kind = line.partition(",")[0].lower()
    frame = [0, 0, 0, sin(pi / 4), 0, 0, cos(pi / 4)]
    assert (shape["kind"], shape["statement"], shape["body"]) == (kind, "GRAPHICS/7", 1)
    assert shape["frame"] == pytest.approx(frame, abs=1e-12)
    rest = {k: v for k, v in shape.items() if k not in ("kind", "statement", "body", "frame")}
    assert rest == sizes


def test_a_cylinder_through_a_marker_has_its_distance_from_the_axis() -> None:
    """The pin is 250 mm along y from a marker with the axes of the part: RM gives that radius."""
    deck = PENDULUM.replace("QP=0,-250,0, REULER=0,90D,0", "QP=0,-250,0")
    text = deck.replace("SIMULATE", "GRAPHICS/7, CYLINDER, CM=20, LENGTH=30, RM=21\nSIMULATE")
    assert still(text).plain["shapes"][0]["radius"] == pytest.approx(250)


def test_outlines_close_where_the_first_marker_comes_again() -> None:
    line = "GRAPHICS/1, OUTLINE=1,20,21,1\nGRAPHICS/2, OUTLINE=1,20\nSIMULATE"
    lines = still(PENDULUM.replace("SIMULATE", line)).plain["outlines"]
    assert [(len(each["points"]), each["closed"]) for each in lines] == [(3, True), (2, False)]
    assert lines[1]["points"] == [[0, 10, 0, 500], [1, 0, 0, 0]]


def test_what_cannot_be_drawn_is_named() -> None:
    line = "GRAPHICS/1, EXTERNAL, RM=20, FILE=body.xmt_txt\nSIMULATE"
    notes = still(PENDULUM.replace("SIMULATE", line)).plain["notes"]
    assert "GRAPHICS/1: not drawn, its shape is in a Parasolid file, which is not read" in notes


def test_a_shape_beyond_all_numbers_of_a_screen_is_named() -> None:
    line = "GRAPHICS/1, CYLINDER, CM=20, LENGTH=1, RADIUS=1E300\nSIMULATE"
    plain = still(PENDULUM.replace("SIMULATE", line)).plain
    assert "GRAPHICS/1: not drawn, it is beyond all pictures" in plain["notes"]
    assert not [each for each in plain["shapes"] if each["statement"]]


def test_a_deck_without_graphics_has_rods_and_a_ball() -> None:
    """From the mass centre to the pin, 250 mm along y of the part; the ball is of 2 kg of steel,
    39 mm, or the largest share of the scene if that is less.
    """
    rod, ball = still(PENDULUM).plain["shapes"]
    assert rod["kind"] == "rod" and rod["to"] == pytest.approx([0, 250, 0])
    assert ball["kind"] == "sphere" and 1 < ball["radius"] < 39.4


def test_a_body_without_extent_is_a_box_with_its_inertia() -> None:
    """m = 12, sides 2, 3, 4: I = (b^2 + c^2) m/12 = 25, 20, 13; the scene is 100 m wide."""
    text = """A box
PART/1, GROUND
MARKER/1, PART=1, QP=100,0,0
PART/2, MASS=12, CM=2, IP=25,20,13
MARKER/2, PART=2
SIMULATE/DYNAMIC, END=1
END
"""
    (box,) = still(text).plain["shapes"]
    sides = Rotation.from_quat(box["frame"][3:]).apply([box[axis] for axis in "xyz"])
    assert box["kind"] == "inertia_box" and np.abs(sides) == pytest.approx([2, 3, 4])


def test_rods_are_the_shortest_tree() -> None:
    """Five points along a bent line, given out of order: four rods between neighbours."""
    line = np.array([[0, 0, 0], [3, 0, 0], [1, 0, 0], [3, 2, 0], [2, 0, 0]], dtype=float)
    lengths = [np.linalg.norm(line[i] - line[j]) for i, j in tree(line)]
    assert sorted(lengths) == [1, 1, 1, 2]


# ---- channels --------------------------------------------------------------------------------


def test_channels_are_all_columns_with_units() -> None:
    deck = al.read(PENDULUM)
    results = al.simulate(deck)
    drawn = scene(deck, results)
    listed = drawn.plain["channels"]["list"]
    assert [each["name"] for each in listed] == list(results.names)
    units = {each["name"]: each["unit"] for each in listed}
    assert units["PART/2.x"] == "mm" and units["PART/2.psi"] == "rad"
    assert units["PART/2.vz"] == "mm/s" and units["PART/2.alx"] == "rad/s^2"
    assert units["JOINT/1.fx"] == "N" and units["JOINT/1.tz"] == "N mm"
    found = decoded(drawn, named(listed, "PART/2.vz")["values"])
    assert found == pytest.approx(results["PART/2.vz"], rel=1e-6, abs=1e-6)


def test_the_reference_names_all_fields_of_a_scene() -> None:
    """docs/reference/scenes.md, for those who read a page with a program of their own."""
    page = Path(__file__).parent.parent / "docs" / "reference" / "scenes.md"
    _, _, inside = page.read_text(encoding="utf-8").partition("## Inside a page")
    rows = [line.split("|")[1] for line in inside.splitlines() if line.startswith("| `")]
    listed = {word for row in rows for word in re.findall(r"`(\w+)`", row)}
    assert listed - {"f32", "i16", "json"} == set(still(PENDULUM).plain)

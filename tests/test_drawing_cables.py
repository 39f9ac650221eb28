"""Cables of a scene: one line each, through its masses and round its wheels, with its tension."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from page_scenes import decoded, named

import adamslite as al
from adamslite.drawing.cable_comments import cable_comment
from adamslite.drawing.scene import Scene, scene
from adamslite.elements.graphics import Graphics
from adamslite.resources import find
from adamslite.results.results import Results

DESCRIBED = find("decks") / "cables" / "described"

NOTHING = Results(time=np.zeros(0), names=(), values=np.zeros((0, 0)))

CHAIN = """Three masses on four springs between two hooks
PART/1, GROUND
MARKER/1, PART=1
MARKER/5, PART=1, QP=4,0,0
POINT_MASS/2, MASS=1, QG=1,0,0
MARKER/2, POINT_MASS=2
POINT_MASS/3, MASS=1, QG=2,0,0
MARKER/3, POINT_MASS=3
POINT_MASS/4, MASS=1, QG=3,0,0
MARKER/4, POINT_MASS=4
SFORCE/3, I=3, J=4, FUNCTION=-100*(DM(3,4)-0.9)
SFORCE/1, I=1, J=2, FUNCTION=-100*(DM(1,2)-0.9)
SFORCE/2, I=3, J=2, FUNCTION=-100*(DM(2,3)-0.9)
SFORCE/4, I=5, J=4, FUNCTION=-100*(DM(4,5)-0.9)
SIMULATE/DYNAMIC, END=0.1, STEPS=2
END
"""

HOIST = """A winch, a rope of two sections, a weight
PART/1, GROUND
MARKER/11, PART=1
PART/10, MASS=1, CM=10, IP=1,1,1
MARKER/10, PART=10
JOINT/10, REVOLUTE, I=10, J=11
MARKER/100, PART=1, QP=0.3,0,0
POINT_MASS/101, MASS=1, QG=0.3,-1,0
MARKER/101, POINT_MASS=101
POINT_MASS/20, MASS=5, QG=0.3,-2,0
MARKER/20, POINT_MASS=20
SFORCE/101, I=100, J=101, FUNCTION=-100*(DM(100,101)-0.9)
SFORCE/102, I=101, J=20, FUNCTION=-100*(DM(101,20)-0.9)
{drawn}
SIMULATE/DYNAMIC, END=0.1, STEPS=2
END
"""


def drawn_of(text: str, **columns: list[float]) -> Scene:
    """The scene of a deck whose bodies rest, with the columns of some forces."""
    deck = al.read(text)
    count = len(next(iter(columns.values()), [0.0]))
    names = tuple(f"{key.replace('_', '/')}.f" for key in columns)
    values = np.array([*columns.values()], dtype=float).T.reshape(count, len(names))
    return scene(deck, Results(time=np.arange(count) * 0.1, names=names, values=values))


def test_a_chain_of_springs_is_one_line_in_order() -> None:
    """Springs in any order and sense: the line goes from hook to hook; a pull f = -7 is 7."""
    found = drawn_of(CHAIN, SFORCE_1=[-7, -8], SFORCE_2=[-1, 0], SFORCE_3=[2, 2], SFORCE_4=[-5, 0])
    (cable,) = found.plain["cables"]
    points = [each["point"] for each in cable["nodes"]]
    if points[0][1] == 4:
        points, turned = points[::-1], slice(None, None, -1)
    else:
        turned = slice(None)
    assert [point[0] for point in points] == [0, 1, 2, 3, 0]
    assert points[0] == [0, 0, 0, 0] and points[-1] == [0, 4, 0, 0]
    tension = decoded(found, cable["tension"])[:, turned]
    assert tension == pytest.approx(np.array([[7, 1, -2, 5], [8, 0, -2, 0]]), abs=1e-3)
    assert cable["range"] == [-2, 8]


def test_tensions_without_bounds_leave_the_range_finite() -> None:
    """One column is infinite at a time, another one no number at all."""
    found = drawn_of(CHAIN, SFORCE_1=[-7, -np.inf], SFORCE_2=[np.nan, np.nan], SFORCE_3=[2, 2])
    (cable,) = found.plain["cables"]
    assert cable["range"] == [-2, 7]


def test_a_chain_is_drawn_once() -> None:
    """No beads on its masses, no link and no arrow for its sections."""
    plain = drawn_of(CHAIN, SFORCE_1=[-7], SFORCE_2=[-1], SFORCE_3=[2], SFORCE_4=[-5]).plain
    assert plain["shapes"] == plain["links"] == plain["arrows"] == []


def test_a_weight_on_a_row_of_forces_is_drawn_on_its_line() -> None:
    """Forces whose law depends on states make a row as well; the mass of 100 kg in it is no piece
    of the cable.
    """
    text = CHAIN.replace("-0.9)", "-DIF(1))").replace(
        "POINT_MASS/3, MASS=1", "POINT_MASS/3, MASS=100"
    )
    plain = drawn_of(text.replace("SIMULATE", "DIFF/1, IC=0.9, FUNCTION=0.1\nSIMULATE")).plain
    (cable,) = plain["cables"]
    assert len(cable["nodes"]) == 5 and cable["tension"] is None
    assert [(each["kind"], each["body"]) for each in plain["shapes"]] == [("sphere", 2)]


@pytest.mark.parametrize(
    ("text", "radius"),
    [
        ("GEAR/1, JOINTS=1,2, CV=4", {1: 0.1, 2: 0.2}),
        ("COUPLER/1, JOINTS=1,3, TYPE=R:T, SCALES=150,-1000", {1: 0.15}),
        ("COUPLER/1, JOINTS=1,2, TYPE=R:R, SCALES=150,-1000", {}),
        (
            "SFORCE/1, I=30, J=10, FUNCTION=IMPACT(DM(30,10),VR(30,10),0.25,1E5,1.5,1,1E-4)",
            {1: 0.25},
        ),
    ],
)
def test_gears_drums_and_rims_are_wheels(text: str, radius: dict[int, float]) -> None:
    """The pitch point of the gears is 0.1 from the first axle and 0.2 from the second, its velocity
    across the line between them.
    """
    deck = f"""Gears
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=0.3,0,0
MARKER/3, PART=1, QP=0,1,0
MARKER/4, PART=1, QP=0.1,0,0, ZP=0.1,1,0
PART/10, MASS=1, CM=10, IP=1,1,1
MARKER/10, PART=10
PART/20, MASS=1, CM=20, IP=1,1,1, QG=0.3,0,0
MARKER/20, PART=20
PART/30, MASS=1, CM=30, IP=1,1,1, QG=0,1,0
MARKER/30, PART=30
JOINT/1, REVOLUTE, I=10, J=1
JOINT/2, REVOLUTE, I=20, J=2
JOINT/3, TRANSLATIONAL, I=30, J=3
{text}
SIMULATE/DYNAMIC, END=1
END
"""
    shapes = drawn_of(deck).plain["shapes"]
    found = {each["body"]: each["radius"] for each in shapes if each["kind"] == "wheel"}
    assert found == pytest.approx(radius)


def test_two_springs_in_a_row_are_links() -> None:
    found = drawn_of(HOIST.format(drawn=""), SFORCE_101=[-1], SFORCE_102=[-1])
    assert found.plain["cables"] == []
    assert [each["statement"] for each in found.plain["links"]] == ["SFORCE/101", "SFORCE/102"]


def test_a_comment_makes_an_outline_a_cable() -> None:
    """From the winch, which it leaves turning negatively, through the rope to the weight."""
    text = HOIST.format(
        drawn="GRAPHICS/1, OUTLINE=10, 101\n, 20\n"
        "! adamslite: cable, wheel 10 -0.3\n! adamslite: cable, tension -SFORCE/101..102.f"
    )
    found = drawn_of(text, SFORCE_101=[-10, -20], SFORCE_102=[-30, -40])
    (cable,) = found.plain["cables"]
    wheel, node, weight = cable["nodes"]
    assert wheel["radius"] == 0.3 and wheel["sense"] == -1 and wheel["wheel"][0] == 1
    assert node["point"][0] == 2 and weight["point"][0] == 3
    assert decoded(found, cable["tension"]) == pytest.approx(np.array([[10, 30], [20, 40]]))
    assert found.plain["links"] == found.plain["outlines"] == found.plain["notes"][1:] == []
    shapes = found.plain["shapes"]
    assert {each["kind"] for each in shapes if each["body"] == 1} == {"wheel"}
    assert not [each for each in shapes if each["body"] == 2]


@pytest.mark.parametrize(
    ("comment", "note"),
    [
        ("wheel 10 fast", "'wheel 10 fast' means nothing"),
        ("wheel 99 0.3", "'wheel 99 0.3' means nothing"),
        ("wheel 11 0.3", "the line does not go through MARKER/11"),
        ("colour red", "'colour red' means nothing"),
        ("tension SFORCE/7.f none", "the results have no SFORCE/7.f"),
        ("tension SFORCE/101.f", "1 tensions for 2 spans"),
    ],
)
def test_what_a_comment_gets_wrong_is_noted(comment: str, note: str) -> None:
    drawn = f"GRAPHICS/1, OUTLINE=10, 101, 20\n! adamslite: cable, {comment}"
    found = drawn_of(HOIST.format(drawn=drawn), SFORCE_101=[-1], SFORCE_102=[-1])
    assert f"comment of GRAPHICS/1: {note}" in found.plain["notes"]
    assert len(found.plain["cables"]) == 1


def test_ranges_of_tensions_run_either_way() -> None:
    line = "GRAPHICS/1, OUTLINE=10, 101, 20  ! adamslite: cable, tension -GCON/9..7.f none A/b"
    deck = al.read(HOIST.format(drawn=line))
    comment = cable_comment(deck, deck.of(Graphics)[0])
    assert comment is not None
    assert comment.tensions == [
        (-1, "GCON/9.f"), (-1, "GCON/8.f"), (-1, "GCON/7.f"), (1, ""), (1, "A/b"),
    ]  # fmt: skip


def test_an_outline_without_the_comment_is_an_outline() -> None:
    drawn = "GRAPHICS/1, OUTLINE=10, 101, 20\n! adamslite: cables are nice\n"
    found = drawn_of(HOIST.format(drawn=drawn), SFORCE_101=[-1])
    assert found.plain["cables"] == [] and len(found.plain["outlines"]) == 1


def test_a_loop_over_wheels_goes_round_the_first_one_too() -> None:
    """The first span comes again at the end, so that the line has an arc on the wheel between."""
    drawn = "GRAPHICS/1, OUTLINE=10,101,10\n! adamslite: cable, wheel 10 0.3"
    (cable,) = drawn_of(HOIST.format(drawn=drawn)).plain["cables"]
    assert [("wheel" in node) for node in cable["nodes"]] == [True, False, True, False]


@pytest.mark.parametrize(
    ("function", "tensions"),
    [
        ("DM(20,100)+DM(101,100)-3", [9, 9]),
        ("3-DM(20,100)-2*DM(101,100)", [-9, -18]),
        ("(DM(20,100)-1)/3-DM(101,100)*half", [3, -4.5]),
        ("DM(20,100)**2+DM(101,100)-DM(101,100)*0.25-4", [None, 6.75]),
    ],
)
def test_spans_that_a_gcon_keeps_are_cables_of_two_points(
    function: str, tensions: list[float | None]
) -> None:
    """With the strength f = -9 the span with the factor c in FUNCTION pulls with 9 c."""
    text = HOIST.format(drawn=f"GCON/1, FUNCTION={function}\nVARIABLE/half, FUNCTION=0.5")
    found = drawn_of(text, GCON_1=[-9.0])
    cables = found.plain["cables"]
    assert [each["name"] for each in cables] == ["GCON/1", "GCON/1"]
    for cable, tension in zip(cables, tensions, strict=True):
        if tension is None:
            assert cable["tension"] is None
        else:
            assert decoded(found, cable["tension"]) == pytest.approx(np.array([[tension]]))


@pytest.mark.parametrize(
    ("law", "route"),
    [
        ("DM(20,100)-2-0.3*AZ(10,11)", [3, ("wheel", 1, 1)]),
        ("DM(100,20)-2+paid", [("wheel", 1, -1), 3]),
        ("DM(20,100)-2", [3, 0]),
    ],
)
def test_a_wheel_that_winds_up_is_found_in_the_length_of_the_cable(law: str, route: list) -> None:
    """The span hangs down from (0.3, 0, 0), on the rim of a wheel about z of the radius 0.3: from
    there down it turns negatively, and so up to there positively.
    """
    lines = f"GCON/1, FUNCTION={law}\nVARIABLE/paid, FUNCTION=AZ(10,11)*(-0.3)"
    plain = drawn_of(HOIST.format(drawn=lines)).plain
    (cable,) = plain["cables"]
    found = [
        ("wheel", node["wheel"][0], node["sense"]) if "wheel" in node else node["point"][0]
        for node in cable["nodes"]
    ]
    assert found == route
    discs = [(each["body"], each["radius"]) for each in plain["shapes"] if each["kind"] == "wheel"]
    assert discs == ([(1, 0.3)] if ("paid" in law or "AZ" in law) else [])


def test_a_torsional_spring_winds_up_nothing() -> None:
    """12 N m/rad between the markers of a revolute joint is no radius of 12 m."""
    lines = "SFORCE/7, ROTATIONAL, I=10, J=11, FUNCTION=-12*AZ(10,11)\nGCON/1, FUNCTION=2*AZ(10,11)"
    plain = drawn_of(HOIST.format(drawn=lines)).plain
    assert not [each for each in plain["shapes"] if each["kind"] == "wheel"]


# ---- ropes that turrets guide ----------------------------------------------------------------


def test_the_ropes_of_a_tackle_go_round_its_pulleys() -> None:
    """Three stages and a head sheave: two ropes over one pulley each, and one over the last pulley
    and the head.  From the becket on the left a rope goes down and round below the block, which
    is positive about z (counterclockwise); over the head it comes back down, negatively.
    """
    plain = scene(al.read(find("decks") / "tackle" / "hoisting.adm"), NOTHING).plain
    labels = [body["name"] for body in plain["bodies"]]
    routes = [[_stop(labels, node) for node in cable["nodes"]] for cable in plain["cables"]]
    assert routes == [
        ["PART/140", ("PART/110", 1), "PART/170"],
        ["PART/240", ("PART/210", 1), "PART/270"],
        ["PART/340", ("PART/310", 1), ("PART/410", -1), "PART/470"],
    ]
    assert {cable["nodes"][1]["radius"] for cable in plain["cables"]} == {0.1}


def _stop(labels: list[str], node: dict) -> str | tuple[str, int]:
    """The body of a point; the body of a wheel and the sense of the line round it."""
    if "point" in node:
        return labels[node["point"][0]]
    return labels[node["wheel"][0]], node["sense"]


def test_the_tension_of_a_rope_is_half_the_load_of_its_block() -> None:
    """800 N hang at rest on a weightless block with two strands: 400 N in both."""
    deck = al.read(find("decks") / "tackle" / "one-stage.adm")
    found = scene(deck, al.simulate(deck))
    (cable,) = found.plain["cables"]
    tension = decoded(found, cable["tension"])
    assert tension[-1] == pytest.approx([400, 400], abs=0.1)


def test_racks_may_point_at_their_wheel_or_away_from_it() -> None:
    """With both ropes turned over, and the signs of PD with them, nothing else changes."""
    text = (find("decks") / "tackle" / "one-stage.adm").read_text()
    turned = (
        text.replace("J=141, PD=-0.2", "J=142, PD=0.2")
        .replace("J=171, PD=0.2", "J=172, PD=-0.2")
        .replace("MARKER/141,", "MARKER/142, PART=140, REULER=0,90D,0\nMARKER/141,")
        .replace("MARKER/171,", "MARKER/172, PART=170, REULER=0,90D,0\nMARKER/171,")
    )
    seen = []
    for each in (text, turned):
        deck = al.read(each)
        found = scene(deck, al.simulate(deck))
        (cable,) = found.plain["cables"]
        labels = [body["name"] for body in found.plain["bodies"]]
        seen.append([_stop(labels, node) for node in cable["nodes"]])
        assert decoded(found, cable["tension"])[-1] == pytest.approx([400, 400], abs=0.1)
    assert seen[0] == seen[1] == ["PART/140", ("PART/110", 1), "PART/170"]


def test_a_rack_on_guides_of_the_ground_is_no_rope() -> None:
    """A pinion that drives a rack: a wheel, and no line."""
    text = """Rack and pinion
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=0,-0.1,0, REULER=90D,90D,0
PART/10, MASS=1, CM=10, IP=1,1,1
MARKER/10, PART=10
PART/20, MASS=1, CM=20, IP=1,1,1, QG=0,-0.1,0
MARKER/20, PART=20
MARKER/21, PART=20, REULER=90D,90D,0
JOINT/1, REVOLUTE, I=10, J=1
JOINT/2, TRANSLATIONAL, I=21, J=2
JOINT/3, RACKPIN, I=10, J=21, PD=0.2
SIMULATE/DYNAMIC, END=1
END
"""
    plain = drawn_of(text).plain
    assert plain["cables"] == []
    assert named(plain["shapes"], "wheel", "kind")["radius"] == 0.1


# ---- decks of `adamslite cable` --------------------------------------------------------------


def test_every_described_deck_has_its_cable_in_one_piece() -> None:
    """Its comments have a tension for each span and name wheels that the line goes round."""
    for path in sorted(DESCRIBED.glob("*.adm")):
        found = scene(al.read(path), NOTHING)
        assert len(found.plain["cables"]) == 1, path.name
        assert len(found.plain["cables"][0]["nodes"]) >= 2
        assert not [note for note in found.plain["notes"] if "comment" in note], path.name


def lengths(path: Path) -> np.ndarray:
    """Of the spans between points, at the start."""
    deck = al.read(path)
    found = scene(deck, NOTHING)
    bodies = [np.array(each["position"]) for each in found.plain["bodies"]]
    nodes = [each["point"] for each in found.plain["cables"][0]["nodes"] if "point" in each]
    places = np.array([bodies[int(b)] + offset for b, *offset in nodes])
    return np.linalg.norm(np.diff(places, axis=0), axis=1)


@pytest.mark.parametrize("name", ["belt", "drum", "folded", "ring"])
def test_the_sections_of_a_described_cable_are_equal(name: str) -> None:
    """Neighbours in the line are neighbours in the cable: all spans are one section long, to 1 %
    for the stretch by different tensions.
    """
    found = lengths(DESCRIBED / f"{name}.adm")
    assert found == pytest.approx(found.mean(), rel=0.01)


def test_the_tension_of_the_described_crane_is_that_of_its_rope() -> None:
    """At the start 2000 kg hang at rest: 19 620 N; the result column is -GCON/1.f."""
    deck = al.read(DESCRIBED / "crane.adm")
    results = al.simulate(deck)
    found = scene(deck, results)
    (cable,) = found.plain["cables"]
    tension = decoded(found, cable["tension"])[:, 0]
    assert tension[0] == pytest.approx(19620, rel=1e-4)
    span = np.ptp(results["GCON/1.f"])
    assert np.abs(tension + results["GCON/1.f"]).max() < span / 65535
    assert named(found.plain["shapes"], "wheel", "kind")["radius"] == 0.3

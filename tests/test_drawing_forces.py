"""Forces of a scene: arrows, springs and lines; moments that are marked; modes."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest
from page_scenes import decoded, named

import adamslite as al
from adamslite.drawing.scene import Scene, scene
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

#: MARKER/3 is turned about z by 90 degrees on a part that is turned by 90 degrees about x.
START = """Forces on a part
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1, QP=0,0,-3
PART/2, MASS=1, CM=2, IP=1,1,1, REULER=0,90D,0
MARKER/2, PART=2
MARKER/3, PART=2, QP=0,4,0, REULER=90D,0,0
MARKER/9, PART=1, FLOATING
{}
SIMULATE/DYNAMIC, END=1
END
"""


def drawn(lines: str, **columns: float) -> Scene:
    """The scene with the part at rest where the deck has it, at two equal times."""
    deck = al.read(START.format(lines))
    names = tuple(key.replace("_", "/", 1).replace("_", ".") for key in columns)
    values = np.tile([*columns.values()], (2, 1)).astype(float)
    return scene(deck, Results(time=np.array([0.0, 1.0]), names=names, values=values))


def arrow(lines: str, **columns: float) -> tuple[str, list[float], np.ndarray]:
    """Kind, place and vector of the only arrow."""
    found = drawn(lines, **columns)
    (one,) = found.plain["arrows"]
    return one["kind"], one["at"], decoded(found, one["vector"])


def test_a_force_along_a_line_points_away_from_the_other_end() -> None:
    """I is MARKER/3, which y of the part, that is z of ground, brings to (0, 0, 4); J is at z = -3:
    a push of 7 N on I is along +z.
    """
    kind, at, vector = arrow("SFORCE/1, I=3, J=1, FUNCTION=7", SFORCE_1_f=7)
    assert (kind, at) == ("force", pytest.approx([1, 0, 4, 0]))
    assert vector == pytest.approx([0, 0, 7], abs=1e-9)


@pytest.mark.parametrize(("word", "kind"), [("ROTATIONAL, ", "torque"), ("ACTIONONLY, ", "force")])
def test_without_a_line_it_is_along_z_of_j(word: str, kind: str) -> None:
    """z of MARKER/3 on the part is -y of ground."""
    found, _, vector = arrow(f"SFORCE/1, {word}I=1, J=3, FUNCTION=7", SFORCE_1_f=7)
    assert found == kind
    assert vector == pytest.approx([0, -7, 0], abs=1e-9)


def test_components_are_along_the_axes_of_rm() -> None:
    """MARKER/3: x is y of the part, z of ground; y is -x of both; z is z of the part, -y."""
    columns = {"VFORCE_1_fx": 1, "VFORCE_1_fy": 2, "VFORCE_1_fz": 3}
    line = "VFORCE/1, I=2, JFLOAT=9, RM=3, FX=1\\ FY=2\\ FZ=3"
    _, _, vector = arrow(line, **columns)
    assert vector == pytest.approx([-2, -3, 1], abs=1e-9)


def test_a_gforce_is_two_arrows_along_ground() -> None:
    values = dict(zip("fx fy fz tx ty tz".split(), range(1, 7), strict=True))
    line = "GFORCE/1, I=2, JFLOAT=9, RM=3, FX=1\\ FY=2"
    found = drawn(line, **{f"GFORCE_1_{key}": value for key, value in values.items()})
    vectors = {each["kind"]: decoded(found, each["vector"]) for each in found.plain["arrows"]}
    assert vectors["force"] == pytest.approx([1, 2, 3])
    assert vectors["torque"] == pytest.approx([4, 5, 6])


def test_reactions_are_marked_as_such() -> None:
    kind, at, vector = arrow("JPRIM/1, ATPOINT, I=2, J=1", **{
        "JPRIM_1_fx": 1, "JPRIM_1_fy": 0, "JPRIM_1_fz": 0,
    })  # fmt: skip
    assert (kind, at) == ("reaction", [1, 0, 0, 0]) and vector == pytest.approx([1, 0, 0])


@pytest.mark.parametrize(("marker", "at", "sign"), [(2, [1, 0, 0, 0], 1), (1, [0, 0, 0, -3], -1)])
def test_graphics_show_a_force_where_they_say(marker: int, at: list[float], sign: int) -> None:
    """On the body of J it is what acts on J."""
    lines = (
        f"SFORCE/1, I=3, J=1, FUNCTION=7\nGRAPHICS/1, FORCE, ETYPE=sforce, EID=1, EMARKER={marker}"
    )
    _, place, vector = arrow(lines, SFORCE_1_f=7)
    assert place == at and vector == pytest.approx([0, 0, 7 * sign], abs=1e-9)


def test_no_force_is_no_arrow() -> None:
    """Zero, and a column that is not in the results."""
    assert drawn("SFORCE/1, I=3, J=1, FUNCTION=0", SFORCE_1_f=0).plain["arrows"] == []
    assert drawn("SFORCE/1, I=3, J=1, FUNCTION=0").plain["arrows"] == []


# ---- lines -----------------------------------------------------------------------------------

SPRING = "SPRINGDAMPER/4, TRANSLATIONAL, I=3, J=1, K=5, LENGTH=1"


def test_a_spring_has_coils_and_its_force() -> None:
    found = drawn(SPRING, SPRINGDAMPER_4_f=-30)
    (spring,) = found.plain["springs"]
    assert spring["statement"] == "SPRINGDAMPER/4" and spring["coils"] == 8
    assert spring["i"] == pytest.approx([1, 0, 4, 0]) and spring["j"] == [0, 0, 0, -3]
    assert decoded(found, spring["force"]) == pytest.approx([-30, -30])
    assert found.plain["links"] == []


def test_graphics_of_a_spring_replace_it() -> None:
    """Either way round; coils and diameter are those of the statement."""
    lines = f"{SPRING}\nGRAPHICS/3, SPDP, I=1, J=3, COILS=12, DA=0.5"
    (spring,) = drawn(lines, SPRINGDAMPER_4_f=-30).plain["springs"]
    assert (spring["statement"], spring["coils"], spring["diameter"]) == ("GRAPHICS/3", 12, 0.5)
    assert spring["force"] is not None


def test_torsional_springs_and_torques_are_no_lines() -> None:
    lines = "SPRINGDAMPER/4, ROTATIONAL, I=3, J=1, KT=5\nSFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION=1"
    plain = drawn(lines, SPRINGDAMPER_4_f=1).plain
    assert plain["springs"] == plain["links"] == []


# ---- moments ---------------------------------------------------------------------------------


def test_moments_that_the_results_name_are_events() -> None:
    meta = {
        "sensor passed": "SENSOR/1 at t = 0.25 and 2 times later; SENSOR/7 at t = 0.125",
        "out of its law": "CONTACT/1 deeper than its law at t = 0.5",
    }
    deck = al.read(START.format(""))
    results = Results(
        time=np.array([0.0, 0.75]), names=(), values=np.zeros((2, 0)), meta=meta,
        outcome=Outcome.STEP_TOO_SMALL, message="JOINT/1 came apart",
    )  # fmt: skip
    plain = scene(deck, results).plain
    assert [each["time"] for each in plain["events"]] == [0.125, 0.25, 0.5, 0.75]
    assert plain["events"][1]["text"].startswith("SENSOR/1 at t = 0.25")
    assert plain["outcome"] == "JOINT/1 came apart"


# ---- modes -----------------------------------------------------------------------------------


def test_modes_are_frequencies_and_shapes() -> None:
    """Two masses m between three springs k in a line: sqrt(k/m) with equal motions and
    sqrt(3 k/m) with opposite ones.
    """
    text = """Two masses, three springs
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
MARKER/4, PART=1, QP=3,0,0
POINT_MASS/2, MASS=2, QG=1,0,0
MARKER/2, POINT_MASS=2
POINT_MASS/3, MASS=2, QG=2,0,0
MARKER/3, POINT_MASS=3
JPRIM/2, INLINE, I=2, J=5
JPRIM/3, INLINE, I=3, J=5
MARKER/5, PART=1, REULER=90D,90D,0
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=50, LENGTH=1
SPRINGDAMPER/2, TRANSLATIONAL, I=3, J=2, K=50, LENGTH=1
SPRINGDAMPER/3, TRANSLATIONAL, I=4, J=3, K=50, LENGTH=1
END
"""
    deck = al.read(text)
    commands = al.read_commands("SIMULATE/INITIAL\nLINEAR/EIGENSOL\n", deck)
    results = al.simulate(deck, commands=commands)
    modes = scene(deck, results).plain["modes"]
    frequencies = [sqrt(50 / 2) / (2 * pi), sqrt(150 / 2) / (2 * pi)]
    assert [mode["frequency"] for mode in modes] == pytest.approx(frequencies, rel=1e-9)
    assert {mode["unit"] for mode in modes} == {"Hz"}
    assert [mode["damping"] for mode in modes] == pytest.approx([0, 0], abs=1e-12)
    for mode, sense in zip(modes, (1, -1), strict=True):
        first, second = (np.array(row[1:7]) + 1j * np.array(row[7:]) for row in mode["shape"])
        assert [row[0] for row in mode["shape"]] == [1, 2]
        assert second == pytest.approx(sense * first, abs=1e-9 * abs(first[0]))
        assert abs(first[0]) > 0 and np.abs(first[1:]).max() < 1e-9 * abs(first[0])


def test_nothing_linearised_is_no_modes() -> None:
    assert named([drawn("").plain], "Forces on a part", "title")["modes"] == []

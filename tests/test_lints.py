"""What is legal and probably not meant: each warning where it belongs, and nowhere else."""

from __future__ import annotations

from pathlib import Path

import pytest
from decklets import codes, told
from tiers import every

from adamslite import read
from adamslite.assembly.corners import MOST, Corners
from adamslite.language.diagnostics import DeckError
from adamslite.language.messages import START
from adamslite.model.model import Model
from adamslite.resources import find
from adamslite.scene import load_scene

LINTS = {
    "starts-apart", "stays-open", "angle-in-radians", "gravity-units", "kink", "dimensions",
    "ends-coincide", "massless",
}  # fmt: skip
#: Drawn apart on purpose: their runs begin with the assembly.
APART = {"four-bar", "one-stage", "three-stage", "rough", "rest"}
DECKS = sorted(find("decks").rglob("*.adm"))


@pytest.mark.parametrize(
    "folder", every(3, sorted({path.parent for path in DECKS})), ids=lambda p: p.name
)
def test_no_reference_deck_has_one(folder: Path) -> None:
    for path in folder.glob("*.adm"):
        try:
            found = {each.code for each in load_scene(path).warnings} & LINTS
        except DeckError as fault:
            assert {each.code for each in fault.errors} == {"missing-routine"}
            continue
        assert found == ({"starts-apart"} if path.stem in APART else set()), path


def codes_of(statements: str) -> list[str]:
    return [code for code in codes(statements) if code != "unused"]


# ---- angles ------------------------------------------------------------------------------------


@pytest.mark.parametrize("angles", ["400D,0,0", "-720D,0,0", "6.28,0,0", "2*PI,0,0", "3*360D,0,0"])
def test_angles_that_are_meant(angles: str) -> None:
    assert codes_of(f"MARKER/4, PART=1, REULER={angles}") == []


@pytest.mark.parametrize("angles", ["6.29,0,0", "0,0,-180", "90.0, 90D, 0", "0,(45),0"])
def test_angles_above_a_full_turn_in_radians(angles: str) -> None:
    expected = [] if "(" in angles else ["angle-in-radians"]  # brackets: a value that is computed
    assert codes_of(f"MARKER/4, PART=1, REULER={angles}") == expected


def test_the_angle_is_reported_in_degrees() -> None:
    (one,) = told(START + "MARKER/4, PART=1, REULER=0,90,0\nREQUEST/1, F1=DX(4)\n")
    assert one.message == "90 in REULER of MARKER/4 is in radians: 5157 degrees"


# ---- gravity -----------------------------------------------------------------------------------

MILLIMETRES = "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n"


@pytest.mark.parametrize(
    "statements",
    [
        "ACCGRAV/JGRAV=-9806.65", "UNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81",
        MILLIMETRES + "ACCGRAV/JGRAV=-9806.65", MILLIMETRES + "ACCGRAV/KGRAV=9810",
        "UNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-1.62", "UNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-3.71",
        "UNITS/SYSTEM=CGS\nACCGRAV/JGRAV=-981", "UNITS/SYSTEM=IPS\nACCGRAV/JGRAV=-386.09",
        "UNITS/SYSTEM=FPS\nACCGRAV/JGRAV=-32.174", "UNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-10",
        "UNITS/SYSTEM=MKS\nACCGRAV/IGRAV=-6.937,JGRAV=-6.937", "UNITS/UCF=1\nACCGRAV/JGRAV=-9.81",
        "UNITS/SYSTEM=MKS\nACCGRAV/JGRAV=0", MILLIMETRES + "ACCGRAV/JGRAV=-98.1",
    ],
)  # fmt: skip
def test_gravity_that_fits_or_is_of_no_other_unit(statements: str) -> None:
    assert codes_of(statements) == []


def test_gravity_by_components_in_other_units() -> None:
    found = told(START + MILLIMETRES + "ACCGRAV/IGRAV=-6.937, JGRAV=-6.937\n")
    assert [each.code for each in found] == ["gravity-units"]
    assert found[0].message.endswith("here it is 9806.65")


# ---- corners -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "function",
    [
        "STEP(TIME,0,0,1,1)", "HAVSIN(TIME,0,0,1,1)", "SIN(TIME)", "MAX(0,TIME-0.5)**2",
        "IF(TIME-0.5: 0, 0, (TIME-0.5)**2)", "MAX(0,TIME-5)", "0*ABS(TIME-0.5)",
        "IF(TIME-0.5: TIME, 0.5, TIME)", "SQRT(ABS(TIME-0.5)+1)*0+TIME", "MAX(TIME,-1)",
    ],
)  # fmt: skip
def test_motions_without_corners_within_the_run(function: str) -> None:
    run = "SIMULATE/DYNAMICS, END=2, STEPS=1"
    assert codes_of(f"MOTION/1, I=2, J=1, X, FUNCTION={function}\n{run}") == []


@pytest.mark.parametrize(
    ("level", "function", "expected"),
    [
        ("", "MAX(0,TIME-0.5)", ["kink"]), ("", "IF(TIME-1: 0, 0, 1)", ["kink"]),
        ("", "ABS(SIN(3*TIME))", ["kink"]), ("", "MIN(TIME**2,1)", ["kink"]),
        (", VELOCITY", "MAX(0,TIME-0.5)", []), (", VELOCITY", "IF(TIME-1: 0, 0, 1)", ["kink"]),
        (", VELOCITY", "SIGN(1,TIME-1)", ["kink"]), (", ACCELERATION", "IF(TIME-1: 0, 0, 1)", []),
    ],
)  # fmt: skip
def test_corners_count_where_velocities_jump(
    level: str, function: str, expected: list[str]
) -> None:
    run = "SIMULATE/DYNAMICS, END=2, STEPS=1"
    assert codes_of(f"MOTION/1, I=2, J=1, X{level}, FUNCTION={function}\n{run}") == expected


def test_the_search_for_a_corner_grows_as_the_expression() -> None:
    """MAX(1,MAX(1,...TIME)): operations of 20 and of 40 calls, each of which has an edge."""
    taken = []
    for depth in (20, 40):
        function = f"{'MAX(1,' * depth}TIME{')' * depth}"
        deck = read(START + f"MOTION/1, I=2, J=1, X, FUNCTION={function}\nEND\n")
        search = Corners(Model(deck))
        assert search.first(deck.find("MOTION", 1).function, 1, 2.0) == pytest.approx(("MAX", 1.0))
        taken.append(MOST - search.left)
    assert taken[1] < 2.1 * taken[0]


def test_corners_are_looked_for_as_long_as_it_takes_little() -> None:
    """The same in a few motions more than that: no warning is false, the first are there."""
    function = f"{'MAX(1,' * 20}TIME{')' * 20}"
    motions = "".join(
        f"PART/{k}, MASS=1, CM={k}, IP=1,1,1\nMARKER/{k}, PART={k}\n"
        f"MOTION/{k}, I={k}, J=1, X, FUNCTION={function}\n"
        for k in range(10, 70)
    )
    found = codes_of(f"{motions}SIMULATE/DYNAMICS, END=2, STEPS=1")
    assert 3 < found.count("kink") < 60


def test_the_time_of_a_corner_is_reported() -> None:
    found = told(
        START + "VARIABLE/1, FUNCTION=MAX(0,TIME-0.75)\nMOTION/1, I=2, J=1, X, FUNCTION=VARVAL(1)\n"
        "SIMULATE/DYNAMICS, END=2, STEPS=1\n"
    )
    assert [each.message for each in found] == [
        "FUNCTION of MOTION/1 has a corner at 0.75, by MAX, where velocities jump"
    ]


@pytest.mark.parametrize(
    ("law", "expected"),
    [
        ("IF(TIME-1: TIME**3, 1, 3*TIME-2)", []),
        ("IF(TIME-1: TIME**3, 1, 2*TIME-1)", ["kink"]),
        ("MAX(0,TIME-1)**2", ["kink"]),
        ("MAX(0,TIME-5)", []),
        ("MIN(DY(2),1)", ["kink"]),
        ("MAX(1,ABS(TIME-1)-5)", []),
        ("MAX(DY(2),ABS(TIME-1))", ["kink"]),
    ],
)
def test_a_law_in_a_gcon_has_corners_where_the_function_of_time_has(
    law: str, expected: list[str]
) -> None:
    """x = law: t^3 continues smoothly as 3 t - 2 at t = 1; t = 5 is after the end.

    MAX itself has a corner at 1; that its square has none is not looked into.
    """
    run = "SIMULATE/DYNAMICS, END=2, STEPS=1"
    found = codes_of(f"GCON/1, FUNCTION=DX(2)-({law})\n{run}")
    assert [code for code in found if code != "dimensions"] == expected


# ---- dimensions --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "function",
    [
        "200*DX(2,1)+VX(2,1)", "DX(2,1)/0.1+VX(2,1)", "DX(2,1)+1*VX(2,1)", "DX(2,1)-DY(2,1)+0.5",
        "VX(2,1)+WZ(2)*DY(2,1)",
        "DX(2,1)/TIME-VX(2,1)", "SQRT(DX(2,1)**2+DY(2,1)**2)-DM(2,1)", "SIN(TIME)+DX(2,1)",
        "SIN(10*TIME)*DX(2,1)+DY(2,1)", "AZ(2,1)+ATAN2(DX(2,1),DY(2,1))", "FX(2)*DX(2)+TX(2)",
        "STEP(TIME,0,0,1,1)*DX(2)+DY(2)", "IF(DX(2,1): VX(2,1), 0, VY(2,1))", "-1*DX(2,1)+TIME",
        "IMPACT(DX(2,1),VX(2,1),1,1E5,1.5,10,0.1)", "DX(2)*DX(2)+DY(2)**2", "EXP(TIME)+DX(2)",
        "MAX(DX(2,1),0)+DY(2,1)", "MOD(TIME,1)+TIME", "VM(2,1)**2+ACCX(2)*DX(2)",
    ],
)  # fmt: skip
def test_expressions_that_may_be_meant(function: str) -> None:
    force = "FUNCTION=1\nSFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=1\n"
    assert codes_of(f"VARIABLE/9, {force}VARIABLE/1, FUNCTION={function}") == []


@pytest.mark.parametrize(
    ("function", "first", "second"),
    [
        ("DX(2,1)+VX(2,1)", "DX(2, 1, 0), a length", "VX(2, 1, 0, 0), a velocity"),
        ("DX(2,1)-TIME", "DX(2, 1, 0), a length", "TIME, a time"),
        ("AZ(2,1)+WZ(2,1)", "AZ(2, 1), an angle", "WZ(2, 1, 0), an angular velocity"),
        ("2+DX(2)**2-DM(2)", "2 + DX(2, 0, 0)**2, length^2", "DM(2, 0), a length"),
        ("MAX(0,DX(2),VX(2))", "DX(2, 0, 0), a length", "VX(2, 0, 0, 0), a velocity"),
        ("FX(2)+TX(2)", "FX(2, 0, 0), a force", "TX(2, 0, 0), a torque"),
        ("SIN(DX(2)+TIME)", "DX(2, 0, 0), a length", "TIME, a time"),
    ],
)  # fmt: skip
def test_contradictions_are_reported_with_both_sides(
    function: str, first: str, second: str
) -> None:
    text = START + f"SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=1\nVARIABLE/1, FUNCTION={function}\n"
    (one,) = told(text)
    assert (one.code, one.severity) == ("dimensions", "warning")
    assert f"combines {first}, and {second}, which" in one.message


def test_dimensions_of_variables_that_refer_to_each_other_everywhere() -> None:
    """200 with 199 terms each were 40 000 calls within each other; what goes round is unknown."""
    names = range(10, 210)
    sums = ("\n, +".join(f"VARVAL({k})" for k in names if k != n) for n in names)
    circle = "".join(
        f"VARIABLE/{n}, FUNCTION=DX(2)+0.001*(\n, {sum})\n"
        for n, sum in zip(names, sums, strict=True)
    )
    force = "SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION={}\n"
    assert told(f"{START}{circle}{force.format('VARVAL(10)')}") == []


@pytest.mark.parametrize(("rate", "found"), [("VX(2)", "a velocity"), ("DX(2)", "")])
def test_a_dimension_at_the_end_of_a_chain(rate: str, found: str) -> None:
    """Each link is the sum of 100 links before it, the deepest first."""
    links = "".join(
        f"VARIABLE/{n}, FUNCTION=" + "\n, +".join(f"VARVAL({n - 1})" for _ in range(100)) + "\n"
        for n in range(12, 112)
    )
    force = "SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=1\n"
    chain = f"VARIABLE/11, FUNCTION={rate}\n{links}VARIABLE/1, FUNCTION=DX(2)+VARVAL(111)\n"
    messages = [each.message for each in told(f"{START}{force}{chain}")]
    assert [found in each for each in messages] == ([True] if found else [])


# ---- the rest ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "statements",
    [
        "MARKER/4, PART=1, QP=1,0,0\nSFORCE/1, I=2, J=4, FUNCTION=1",
        "SFORCE/1, I=2, J=1, ACTIONONLY, FUNCTION=1", "SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=1",
        "SPRINGDAMPER/1, ROTATIONAL, I=2, J=1, KT=1", "BUSHING/1, I=2, J=1, K=1,1,1",
    ],
)  # fmt: skip
def test_forces_with_a_direction(statements: str) -> None:
    assert codes_of(statements) == []


def test_ends_that_a_start_condition_moves_apart() -> None:
    """The slide starts at 0.2, though it is drawn at 0."""
    deck = "JOINT/1, TRANSLATIONAL, I=2, J=1, IC=0.2\nSPRINGDAMPER/1, I=2, J=1, K=1, LENGTH=1"
    assert codes_of(deck) == []


@pytest.mark.parametrize(
    "joints",
    [
        "JOINT/1, FIXED, I=2, J=4", "JOINT/1, REVOLUTE, I=2, J=4\nMOTION/1, JOINT=1, FUNCTION=TIME",
        "JOINT/1, SPHERICAL, I=2, J=4\nJPRIM/1, ORIENTATION, I=4, J=1",
    ],
)  # fmt: skip
def test_parts_without_mass_that_others_carry(joints: str) -> None:
    assert "massless" not in codes_of(f"PART/4\nMARKER/4, PART=4\n{joints}")


def test_a_part_without_mass_between_two_hinges() -> None:
    """The cross of two hinges follows its neighbours; hung on one of them alone it turns freely."""
    cross = (
        "PART/4\nMARKER/4, PART=4\nMARKER/5, PART=4, REULER=90D,90D,0\n"
        "PART/6, MASS=1, CM=6, IP=1,1,1\nMARKER/6, PART=6\nMARKER/7, PART=6, REULER=90D,90D,0\n"
        "JOINT/1, REVOLUTE, I=4, J=2\n"
    )
    assert codes_of(cross) == ["massless"]
    assert codes_of(cross + "JOINT/2, REVOLUTE, I=5, J=7") == []


def test_what_is_used_in_any_way_is_used() -> None:
    assert codes(
        "MARKER/4, PART=1, QP=1,0,0\nMARKER/5, PART=1, QP=2,0,0\n"
        "GRAPHICS/1, CIRCLE, CM=5, RADIUS=1\n"
        "REQUEST/1, F1=DX(4)\nVARIABLE/1, FUNCTION=3\nVARIABLE/2, FUNCTION=VARVAL(1)*TIME\n"
    ) in ([], ["passed-over"])


def test_ignored_on_its_line() -> None:
    line = "MARKER/4, PART=1, REULER=90,0,0 ! adamslite: ignore angle-in-radians, unused"
    assert codes(line) == []


@pytest.mark.parametrize(
    ("statement", "place", "text"),
    [
        ("VARIABLE/1, FUNCTION=-DX(2,1)-VX(2,1)", (8, 31), "VX(2,1)"),
        ("MARKER/4, PART=2, REULER=0, 90, 0\nREQUEST/1, F1=DX(4)", (8, 29), "90"),
        ("MOTION/1, I=2, J=1, X, FUNCTION=TIME\n, +MAX(0,TIME-1)", (9, 4), "MAX(0,TIME-1)"),
    ],
)
def test_the_caret_is_at_the_function_or_number(
    statement: str, place: tuple[int, int], text: str
) -> None:
    (one,) = told(START + statement + "\n")
    assert (one.span.line, one.span.column) == place
    assert one.source_line[one.span.column - 1 : one.span.end_column - 1] == text


def test_routines_of_the_user_may_ask_for_any_marker() -> None:
    text = START + "MARKER/4, PART=1, QP=1,0,0\nVARIABLE/1, FUNCTION=USER(4)\n"
    assert [each.code for each in told(text, ["VARIABLE/1=0"])] == ["user-bound"]

"""Every lexical rule of the language: how text becomes statements and values."""

from __future__ import annotations

import math

import pytest
from decklets import codes, deck_with, function, last, told

from adamslite.language.expression import to_text
from adamslite.language.messages import START
from adamslite.language.spelling import spelled
from adamslite.reading.read import read

DEGREE = math.pi / 180


# ---- lines ------------------------------------------------------------------------------------


def test_the_first_line_is_the_title_whatever_it_says() -> None:
    for title in ("", "! a comment", "PART(1, = \\ ; & (", "  END ", "PART/1 of 2"):
        assert read(title + START[START.index("\n") :]).title == title


@pytest.mark.parametrize("blank", ["\n", " \t\n", "\n\n \n", "\r\n"])
def test_a_title_may_follow_blank_lines(blank: str) -> None:
    rest = START[START.index("\n") :]
    for title in ("ADAMS/View model name: crane", "a crane, 3 m", "crane/2 of 3"):
        deck = read(f"{blank}{title}{rest}")
        assert deck.title == title
        assert len(deck.statements) == 6
    assert read(f"{blank}{rest}").title.strip() == ""
    assert told(f"{blank}PRT/3{rest}")[0].code == "unknown-statement"


def test_a_statement_in_place_of_the_title_is_read() -> None:
    rest = START.partition("PART/1, GROUND\n")[2]
    deck = read(f"PART/1\n, GROUND\n{rest}")
    assert deck.title == "" and deck.find("PART", 1).ground
    assert [each.code for each in deck.warnings] == ["missing-title"]


def test_comments_run_to_the_end_of_the_line() -> None:
    variable = last("! whole line, with (brackets and a comma,\nVARIABLE/1, FUNCTION=1 ! + 2, IC=5")
    assert to_text(variable.function) == "1"
    assert variable.ic == 0


def test_blank_and_comment_lines_may_stand_before_a_continuation() -> None:
    marker = last("MARKER/4, PART=1 ! first\n! second\n\n   \n!\n  , QP=1,2,3 ! last")
    assert marker.qp == (1, 2, 3)


def test_semicolons_separate_statements() -> None:
    deck = deck_with("VARIABLE/1, FUNCTION=1; VARIABLE/2, FUNCTION=2;\nVARIABLE/3, FUNCTION=3")
    assert [variable.id for variable in deck.of("VARIABLE")] == [1, 2, 3]


def test_nothing_is_read_behind_end() -> None:
    assert deck_with("END\n)( what = ever,, \\\nPART/1, GROUND").of("END")
    assert deck_with("end ! comment\nFORSE/1").of("END")


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_line_ends_of_all_systems(end: str) -> None:
    deck = read((START + "MARKER/4, PART=1\n, QP=1,2,3\n").replace("\n", end) + "\n")
    assert deck.find("MARKER", 4).qp == (1, 2, 3)


def test_case_and_blanks_do_not_matter() -> None:
    deck = deck_with(
        "marker / 4 ,\tpart = 1 , qp = 1 , 2,3\nVariable/a,function = max ( Time , 2 )"
    )
    assert deck.find("MARKER", 4).qp == (1, 2, 3)
    assert to_text(deck.find("VARIABLE", "A").function) == "MAX(TIME, 2)"


def test_places_survive_joining() -> None:
    variable = last("VARIABLE/4 ! c\n! c\n, IC = 1\n  ,  FUNCTION = MAX(1,\n,  2)")
    first = START.count("\n") + 1
    span = variable.spans["function"]
    assert (span.line, span.column) == (first + 3, 6)
    assert (span.end_line, span.end_column) == (first + 4, 6)
    assert (variable.span.line, variable.span.column) == (first, 1)


# ---- continuation and commas ------------------------------------------------------------------


def test_in_a_list_the_leading_comma_separates() -> None:
    deck = deck_with("PART/4, MASS=1, CM=4, IP=1, 2\n, 2, 0\n, 0, 0\nMARKER/4")
    assert deck.find("PART", 4).ip == (1, 2, 2, 0, 0, 0)


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("-1E5*DZ(1,2,2)\n,-1E4*VZ(1,2,2)", "-1E5*DZ(1,2,2)-1E4*VZ(1,2,2)"),
        ("MAX(DY(1,2),\n,  VY(1,2),\n, 3)\n,  * ABS(TIME)", "MAX(DY(1,2),VY(1,2),3)*ABS(TIME)"),
        ("MAX(DY(1,2)\n, + 1, 2)", "MAX(DY(1,2) + 1, 2)"),
        ("2*5.6*,\n, (3 + 1)", "2*5.6*(3 + 1)"),
        ("(1 + 2*,\n, 3)", "(1 + 2*3)"),
        ("MAX(,\n, 1, 2)", "MAX(1, 2)"),
        ("\n, VARVAL(999)*2", "VARVAL(999)*2"),
        ("2\n,*TIME\n,+1", "2*TIME+1"),
        ("[1 +\n, 2]*3", "(1+2)*3"),
    ],
)
def test_in_an_expression_the_leading_comma_vanishes(written: str, meant: str) -> None:
    assert function(written) == function(meant)


def test_a_value_may_begin_on_the_continuation_line() -> None:
    assert last("MARKER/4, PART=1, QP =\n, 1, 2, 3").qp == (1, 2, 3)


# ---- ends of expressions ----------------------------------------------------------------------

VFORCE = "VFORCE/1, I=2, J_PART=1"


@pytest.mark.parametrize(
    "components",
    [
        ", FX=1\\ FY=2\\ FZ=3",
        ", FX=1\\, FY=2\\, FZ=3\\",
        "\n, FX = 1\\\n, FY = 2\\\n, FZ = 3",
        "\n,FX=1/\n,FY=2/\n,FZ=3/",
        "\n, FZ = 3 /  ! the old form\n, FX = 1\\\n, FY = 4/\n, 2",
    ],
)
def test_backslash_and_trailing_slash_end_an_expression(components: str) -> None:
    force = last(VFORCE + components)
    assert [to_text(f) for f in (force.fx, force.fz)] == ["1", "3"]
    assert to_text(force.fy) in ("2", "4/2")


def test_a_slash_inside_an_expression_divides() -> None:
    assert function("TIME /\n, 2") == function("TIME/2")


def test_a_flag_after_an_open_expression_is_taken_with_a_warning() -> None:
    assert codes("SFORCE/1, I=1, J=2, FUNCTION=1, ACTIONONLY") == ["expression-not-closed"]
    assert last("SFORCE/1, I=1, J=2, FUNCTION=1\\ ACTIONONLY").actiononly


# ---- numbers ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("0017", 17.0),
        (".5", 0.5),
        ("2.", 2.0),
        ("1E3", 1000.0),
        ("1.e-3", 1e-3),
        ("1.0D+3", 1000.0),
        ("1D-3", 1e-3),
        ("1d3", 1000.0),
        ("90D", 90 * DEGREE),
        ("30.0d", 30 * DEGREE),
        ("-45.D", -45 * DEGREE),
        ("9.12E-08D", 9.12e-8 * DEGREE),
        ("+7", 7.0),
        ("(3)", 3.0),
        ("1/4", 0.25),
        ("2*PI", 2 * math.pi),
    ],
)
def test_numbers(written: str, value: float) -> None:
    assert last(f"VARIABLE/1, IC={written}, FUNCTION=1").ic == value


def test_degrees_inside_expressions() -> None:
    assert function("30.0d*time").args[0].value == pytest.approx(30 * DEGREE)
    assert function("AZ(2,1)-89D").args[1].value == pytest.approx(89 * DEGREE)


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("90D+360D", 450 * DEGREE),
        ("90D+360.5", 90 * DEGREE + 360.5),
        ("90D-2E1", 90 * DEGREE - 20),
        ("90D +2", 90 * DEGREE + 2),
        ("90D+2", 9000.0),
        ("1D+03", 1000.0),
    ],
)
def test_degrees_before_a_sign(written: str, value: float) -> None:
    """An exponent is a whole number."""
    assert last(f"VARIABLE/1, IC={written}, FUNCTION=1").ic == pytest.approx(value)


@pytest.mark.parametrize("written", ["90D+2*TIME", "TIME*(3-1.5d-1)"])
def test_a_signed_exponent_with_d_is_reported_in_expressions(written: str) -> None:
    deck = deck_with(f"VARIABLE/1, FUNCTION={written}")
    assert [each.code for each in deck.warnings] == ["exponent-or-degrees"]
    assert not deck_with(f"VARIABLE/1, FUNCTION={written.upper().replace('D', 'E')}").warnings
    assert not deck_with("VARIABLE/1, IC=1D-3, FUNCTION=90D + 2*TIME").warnings


@pytest.mark.parametrize("before", ["", "TIME + ", "SIN(TIME)*"])
def test_only_the_signed_exponent_is_marked(before: str) -> None:
    text = f"VARIABLE/1, FUNCTION={before}90D+2*TIME"
    (only,) = deck_with(text).warnings
    assert only.source_line[only.span.column - 1 : only.span.end_column - 1] == "90D+2"


def test_a_vector_may_stand_in_brackets() -> None:
    assert last("MARKER/4, PART=1, QP=(1, -2, 3), REULER=90D, 0D, 1D-3").qp == (1, -2, 3)
    assert last("MARKER/4, PART=(1), REULER=90D,0D,1D-3").reuler == (math.pi / 2, 0, 1e-3)


# ---- names and ids ----------------------------------------------------------------------------


def test_leading_zeros_of_ids_do_not_count() -> None:
    deck = deck_with("MARKER/0004, PART=01\nVARIABLE/1, FUNCTION=DX(04, 0001)")
    assert deck.find("MARKER", 4).label == "MARKER/4"
    assert deck.find("VARIABLE", 1).function == function("DX(4,1)", "MARKER/4, PART=1")


def test_view_names_come_from_the_comment_before() -> None:
    deck = deck_with(
        "!\n!        adams_view_name='Dm'\nVARIABLE/7, FUNCTION=1\n"
        "VARIABLE/8, FUNCTION=DM + varval(dm)\n"
        "! adams_view_name='gone'\n! PART/9\nVARIABLE/9, FUNCTION=1"
    )
    assert deck.find("VARIABLE", 7).name == "Dm"
    assert deck.find("VARIABLE", "dM").id == 7
    assert to_text(deck.find("VARIABLE", 8).function) == "VARVAL(7) + VARVAL(7)"
    assert deck.find("VARIABLE", 9).name is None


def test_the_same_view_name_may_repeat_when_it_is_not_used() -> None:
    named = "! adams_view_name='cm'\nMARKER/{}, PART=1\n"
    assert codes(named.format(4) + named.format(5)) == []


@pytest.mark.parametrize("written", ["\\Delta L", "\\Delta  L", "ΔL", "∆L", "DeltaL", "deltal"])
def test_greek_letters_in_names(written: str) -> None:
    assert function(f"1 + {written}*2", "VARIABLE/\\Delta L, FUNCTION=1") == function(
        "1 + DeltaL*2", "VARIABLE/DeltaL, FUNCTION=1"
    )


def test_spelling_of_greek() -> None:
    assert [spelled(name) for name in ("\\Delta L_0", "ρ", "µ", "Ω2", "plain")] == [
        "DeltaL_0", "rho", "mu", "Omega2", "plain",
    ]  # fmt: skip


def test_a_backslash_before_anything_else_separates() -> None:
    force = last(VFORCE + ", FX=TIME\\FY=2")
    assert (to_text(force.fx), to_text(force.fy)) == ("TIME", "2")


def test_a_marker_without_owner_belongs_to_the_body_before_it() -> None:
    deck = deck_with("PART/9, MASS=1, CM=9, IP=1,1,1\nMARKER/9\nPOINT_MASS/8, MASS=1\nMARKER/8")
    assert deck.find("MARKER", 9).owner == ("PART", 9)
    assert deck.find("MARKER", 8).owner == ("POINT_MASS", 8)


def test_references_may_point_forward() -> None:
    deck = deck_with(
        "VARIABLE/1, FUNCTION=late + DX(far)\nMARKER/far, PART=1\nVAR/late, FUNCTION=1"
    )
    assert to_text(deck.find("VARIABLE", 1).function) == "VARVAL(LATE) + DX(FAR, 0, 0)"


# ---- abbreviation -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("short", "field", "value"),
    [
        ("MARKER/4, PART=1, EU=1,2,3", "reuler", (1, 2, 3)),
        ("MARKER/4, PART=1, EULER=1,2,3", "reuler", (1, 2, 3)),
        ("MARKER/4, PART=1, REU=1,2,3", "reuler", (1, 2, 3)),
        ("MARKER/4, PO=3", "point_mass", 3),
        ("SFORCE/4, ROT, I=1, J=2, FUNC=1", "kind", "ROTATIONAL"),
        ("SFORCE/4, ROTATION, I=1, J=2, F=1", "kind", "ROTATIONAL"),
        ("SFORCE/4, TRANSLATION, I=1, J=2, F=1", "kind", "TRANSLATIONAL"),
        ("SFORCE/4, ACTION, I=2, J=2, F=1", "actiononly", True),
        ("INT/gst, si2, err=1e-5", "formulation", "SI2"),
        ("int/hma=0.1", "hmax", 0.1),
        ("sim/dyn, dur=1, dt=0.1", "duration", 1.0),
        ("SIMULATE/DYNAMIC, END=1, STEPS=10", "kind", "DYNAMICS"),
        ("accg/kgrav=0", "kgrav", 0.0),
        ("UNITS/SYS=MKS", "system", "MKS"),
        ("REQ/1, DISP, I=2", "kind", "DISPLACEMENT"),
    ],
)
def test_unique_beginnings_are_enough(short: str, field: str, value: object) -> None:
    assert getattr(last(short), field) == value


def test_an_exact_word_wins_over_longer_ones() -> None:
    assert last("REQUEST/1, F1=1\\ F2=2").f2 == function("2")
    deck = deck_with("SPRINGDAMPER/1, I=1, J=2, C=3, K=4\nEND")
    assert (deck.find("SPRINGDAMPER", 1).c, deck.find("SPRINGDAMPER", 1).k) == (3, 4)


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("MARKER/9, PART=1, QP=0;0;3", "value-count"),
        ("MARKER/9, PART=1, QP=0; -1;+3, REULER=0,0,0", "value-count"),
        ("VARIABLE/9, IC=1;2, FUNCTION=1", "not-a-number"),
        ("VARIABLE/9, FUNCTION=STEP(TIME;0;1;1;2)", "stray-character"),
    ],
)
def test_a_semicolon_in_a_list_is_one_mistake(line: str, code: str) -> None:
    """No statement begins with a number, so that nothing else is meant by it."""
    assert codes(f"{line}; MARKER/10, PART=1") == [code]
    assert not codes("MARKER/9, PART=1; MARKER/10, PART=1")

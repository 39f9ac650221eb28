"""Words of real decks that do not change the motion: read, passed over, and reported once."""

from __future__ import annotations

import numpy as np
import pytest
from decklets import codes, deck_with, told

import adamslite
from adamslite.elements.passed_over import TABLE
from adamslite.language.messages import START
from adamslite.reading.read import read, read_commands

WORDS = [
    ("MATERIAL/1, NAME=steel, YOUNGS_MODULUS=2.07E+11, DENSITY=7801", "MATERIAL"),
    ("STRING/1, STRING=any text", "STRING"),
    ("STRING/1, STRING=a\nSTRING/2, STRING=b", "STRING (2)"),
    ("PREFERENCES/\n, CONTACT_FACETING_TOLERANCE = 300.0028\n, NTHREADS = 4", "PREFERENCES"),
    ("preferences/solver=fortran", "PREFERENCES"),
    ("DEBUG/EPRINT, DUMP", "DEBUG"),
    ("LSOLVER/UMF, STABILITY=0.01", "LSOLVER"),
    ("OUTPUT/GRSAVE\n, NOSUCHWORD=1:2", "OUTPUT"),
    ("output/nosep", "OUTPUT"),
    ("RESULTS/FORMATTED, NOTIRES\nRESULTS/COMMENT=a.b%", "RESULTS (2)"),
    ("OUTPUT/REQSAVE, GRSAVE\n, NOSUCHWORD=1:2", "OUTPUT GRSAVE, OUTPUT NOSUCHWORD"),
    ("OUTPUT/reqs, nosep, RESULT=1", "OUTPUT NOSEPARATOR, OUTPUT RESULT"),
    ("RESULTS/XRF, NOSUCHWORD", "RESULTS NOSUCHWORD"),
    ("KINEMATICS/HMAX=0.1, MAXIT=7", "KINEMATICS MAXIT, KINEMATICS HMAX"),
    ("KINEMATICS/APATTERN=T:F, AMAXIT=9", "KINEMATICS APATTERN, KINEMATICS AMAXIT"),
    ("GRAPHICS/0101\n, EXTERNAL\n, RM = 02\n, FILE = a.xmt_txt", "GRAPHICS"),
    ("FE_PART/1, SECTION=1, MATERIAL=2", "FE_PART"),
    ("SECTION/1, AREA=1", "SECTION"),
    ("FLEX_BODY/1, MTX_FILE=C:\\a b\\wing.mtx\nMARKER/4, FLEX_BODY=1, NODE_ID=7", "FLEX_BODY"),
    ("PART/5, MASS=1, CM=5, IP=1,1,1, MATERIAL=steel\nMARKER/5, PART=5", "PART MATERIAL"),
    ("JOINT/1, REVOLUTE, I=2, J=1, DELTA_V=0.1, MU_STAT_ROT=0", "JOINT MU_STAT_ROT, JOINT DELTA_V"),
    (
        "JOINT/1, REVOLUTE, I=2, J=1, FRICTION=OFF, MU_DYN_ROT=0.3",
        "JOINT FRICTION, JOINT MU_DYN_ROT",
    ),
    (
        "JOINT/1, TRANSLATION, I=2, J=1, FRICTION=PRELOAD_ONLY, MU_DYN_TRANS=0, HEIGHT=2",
        "JOINT FRICTION, JOINT MU_DYN_TRANS, JOINT HEIGHT",
    ),
    ("JOINT/1, CYLINDRICAL, I=2, J=1, FRICTION=OFF", "JOINT FRICTION"),
    ("GCON/1, I=1, RM=3, FUNCTION=DM(2,1)", "GCON RM"),
]
COMMANDS = [
    ("preferences/solver=cxx", "PREFERENCES"),
    ("output/nosep", "OUTPUT"),
    ("DEBUG/EPRINT\nDEBUG/DUMP", "DEBUG (2)"),
    ("ENVIRONMENT/NAME=PATH, VALUE=C:\\a", "ENVIRONMENT"),
    ("LSOLVER/AUTO", "LSOLVER"),
    ("RESULTS/NOTIRES", "RESULTS"),
    ("KINEMATICS/HMAX=0.1", "KINEMATICS HMAX"),
    ("LINEAR/EIGENSOL, ENERGY=1,25", "LINEAR ENERGY"),
    ("LINEAR/EIGENSOL, NODAMPIN, NOVECTOR, SENERGY=1,2", "LINEAR NOVECTOR, LINEAR STRAIN"),
    ("MATERIAL/7, DENSITY=1", "MATERIAL"),
]


@pytest.mark.parametrize(("words", "listed"), WORDS)
def test_one_note_names_what_is_passed_over(words: str, listed: str) -> None:
    (note,) = told(START + words + "\n")
    assert (note.code, note.severity) == ("passed-over", "note")
    assert note.message == f"passed over, as it does not change the motion: {listed}"
    assert note.span.line in (8, 9)


@pytest.mark.parametrize(("words", "listed"), COMMANDS)
def test_the_same_in_command_files(words: str, listed: str) -> None:
    deck = deck_with("MATERIAL/7")
    (note,) = read_commands(words + "\n", deck).warnings
    assert (note.code, note.severity) == ("passed-over", "note")
    assert note.message.endswith(f": {listed}")


@pytest.mark.parametrize("words", ["OUTPUT/REQSAVE", "RESULTS/XRF, FORM, DEC=8, NOVEL, COMMENT=a"])
def test_words_that_decide_about_files_are_not_passed_over(words: str) -> None:
    assert not told(f"{START}{words}\n")


def test_everything_is_in_one_note() -> None:
    (note,) = told(START + "".join(f"{words}\n" for words, _ in (*WORDS[3:10], WORDS[13])))
    assert note.message.endswith(
        ": PREFERENCES (2), DEBUG, LSOLVER, OUTPUT (2), RESULTS (2), KINEMATICS MAXIT, "
        "KINEMATICS HMAX"
    )


@pytest.mark.parametrize("keyword", TABLE)
def test_the_text_is_kept(keyword: str) -> None:
    entry = TABLE[keyword]
    if entry.place == "command":
        (made,) = read_commands(f"{keyword}/X=1, Y\n", read(START))
    else:
        made = deck_with(f"{keyword}/{'7, ' * entry.has_id}X = 1 ! no\n, Y").statements[-1]
    assert made.keyword == keyword
    assert made.written.startswith("7, X = 1" if entry.has_id else "X")
    assert made.written.endswith("Y")


@pytest.mark.parametrize(
    "use",
    [
        "JOINT/1, FIXED, I=4, J=1",
        "SFORCE/1, I=2, J=4, FUNCTION=1",
        "VARIABLE/1, FUNCTION=2*DX(2,4)",
        "REQUEST/1, FORCE, I=2, J=4",
        "PART/5, MASS=1, CM=4",
        "GRAPHICS/1, POINT, RM=4\nGRAPHICS/2, PLANE, RM=1\n"
        "CONTACT/1, IGEOM=1, JGEOM=2, POISSON, PENALTY=1, RESTITUTION=1",
    ],
)
@pytest.mark.parametrize("body", ["FLEX_BODY/9\nMARKER/4", "FE_PART/9\nMARKER/4, FE_PART=9"])
def test_what_acts_on_a_flexible_body_is_rejected(body: str, use: str) -> None:
    found = told(f"{START}{body}\n{use}\n")
    (mistake,) = (each for each in found if each.code == "flexible-body")
    assert "uses MARKER/4 of F" in mistake.message and "BEAM" in mistake.hint
    assert not any(each.code == "passed-over" for each in found)


def test_a_run_is_the_same_with_them() -> None:
    head = (
        "a mass on a line\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1\n"
        "ACCGRAV/JGRAV=-9.81\nPART/2, MASS=2, CM=2, IP=1,1,1, QG=1,0,0\nMARKER/2, PART=2\n"
        "JOINT/1, REVOLUTE, I=3, J=1\nMARKER/3, PART=2, QP=-1,0,0\n"
    )
    words = "".join(
        f"{words}\n" for words, _ in WORDS if not words.startswith(("PART/", "GCON/", "JOINT/"))
    )
    words = words.replace("STRING/1, STRING=any text\n", "")
    plain = adamslite.simulate(read(head + "END\n"), end=1, steps=5)
    other = adamslite.simulate(read(head + words + "END\n"), end=1, steps=5)
    assert plain.names == other.names
    assert np.array_equal(plain.values, other.values)


# ---- abbreviations and FLOATING markers -----------------------------------------------------


def test_c_is_the_comment_of_a_request() -> None:
    request = deck_with("REQUEST/1, D, I=2, J=1, C=DISPLACEMENT: X Y Z (body-fixed)").statements[-1]
    assert request.comment == "DISPLACEMENT: X Y Z (body-fixed)"


@pytest.mark.parametrize(
    ("short", "full"),
    [
        ("M/4, P=1", "MARKER/4, PART=1"),
        ("P/4, M=1, CM=4, IP=1,1,1\nM/4, PA=4", "PART/4, MASS=1, CM=4, IP=1,1,1\nMARKER/4, PART=4"),
        ("RE/1, D, I=2, C=a", "REQUEST/1, DISPLACEMENT, I=2, COMMENT=a"),
        ("JO/1, REV, I=2, J=1", "JOINT/1, REVOLUTE, I=2, J=1"),
        ("JP/1, INL, I=2, J=1", "JPRIM/1, INLINE, I=2, J=1"),
        ("EQU/AL=1D, ERR=1, IM=2, MAX=3, PAT=T, ST=4, TL=5",
         "EQUILIBRIUM/ALIMIT=1D, ERROR=1, IMBALANCE=2, MAXIT=3, PATTERN=T, STABILITY=4, TLIMIT=5"),
        ("ACC/K=-9.81", "ACCGRAV/KGRAV=-9.81"),
        ("int/hht, err=1E-5, hmax=1", "INTEGRATOR/HHT, ERROR=1E-5, HMAX=1"),
        ("SF/1, ROTATION, I=2, J=1, FUNC=1", "SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=1"),
        ("SF/1, TRANSLATION, I=2, J=3, FU=1", "SFORCE/1, TRANSLATIONAL, I=2, J=3, FUNCTION=1"),
        ("SPR/1, ROTATION, I=2, J=1, KT=1", "SPRINGDAMPER/1, ROTATIONAL, I=2, J=1, KT=1"),
        ("JO/1, CYL, I=2, J=1\nMO/1, JOINT=1, ROTATIONAL, FUNC=TIME",
         "JOINT/1, CYLINDRICAL, I=2, J=1\nMOTION/1, JOINT=1, ROTATION, FUNCTION=TIME"),
        ("VAR/1, FU=1; AR/1, IC, NUM=1", "VARIABLE/1, FUNCTION=1\nARRAY/1, IC, NUMBERS=1"),
    ],
)  # fmt: skip
def test_abbreviations_as_adams_reads_them(short: str, full: str) -> None:
    read_short, read_full = deck_with(short).statements, deck_with(full).statements
    for one, other in zip(read_short, read_full, strict=True):
        assert type(one) is type(other)
        assert all(getattr(one, f) == getattr(other, f) for f in (*one.arguments, "id"))


@pytest.mark.parametrize(
    ("short", "full"),
    [
        ("sim/stat", "SIMULATE/STATICS"),
        ("sim/dyn, end=1, dtout=0.1", "SIMULATE/DYNAMICS, END=1, DTOUT=0.1"),
        ("sim/dyn, dur=1, steps=9", "SIMULATE/DYNAMICS, DURATION=1, STEPS=9"),
        ("equil/maxit=5, stab=1, imb=2", "EQUILIBRIUM/MAXIT=5, STABILITY=1, IMBALANCE=2"),
    ],
)
def test_abbreviated_commands(short: str, full: str) -> None:
    (one,), (other,) = (read_commands(text + "\n", read(START)) for text in (short, full))
    assert all(getattr(one, f) == getattr(other, f) for f in one.arguments)


def test_unused_floating_markers_are_one_note() -> None:
    lines = "".join(f"MARKER/{n}, PART=1, FLOATING\n" for n in range(10, 18))
    (note,) = told(START + lines)
    assert (note.code, note.severity) == ("floating-unused", "note")
    assert note.message.endswith("MARKER/14, MARKER/15 and 2 more")


@pytest.mark.parametrize(("fx", "sign"), [("3*TIME", 1), ("-4", -1)])
def test_a_force_is_measured_between_i_and_its_floating_marker(fx: str, sign: int) -> None:
    """VFORCE of 3 t (or -4) on MARKER/2; the floating MARKER/4 takes the opposite."""
    deck = deck_with(
        f"MARKER/4, PART=1, FLOATING\nVFORCE/1, I=2, JFLOAT=4, RM=1, FX={fx}\\ FY=2\n"
        "SFORCE/1, I=2, J=1, ACTIONONLY, FUNCTION=5\n"
        "REQUEST/1, F1=FX(2,4)\\F2=FX(4,2)\\F3=FY(4,2,1)\\F4=FM(2,4)\\F5=FY(4)\n"
        "REQUEST/2, FORCE, I=2, J=4, RM=1\nREQUEST/3, F, I=4, J=2"
    )
    results = adamslite.simulate(deck, end=1, steps=2)
    force = 3 * results.time if sign > 0 else np.full(3, -4.0)
    assert results["REQUEST/1.F1"] == pytest.approx(force)
    assert results["REQUEST/1.F2"] == pytest.approx(-force)
    assert results["REQUEST/1.F3"] == pytest.approx([-2.0] * 3)
    assert results["REQUEST/1.F4"] == pytest.approx(np.hypot(force, 2))
    assert results["REQUEST/1.F5"] == pytest.approx([-2.0] * 3)
    assert results["REQUEST/2.F2"] == pytest.approx(force)
    assert results["REQUEST/3.F2"] == pytest.approx(-force)
    assert results["REQUEST/3.F3"] == pytest.approx([-2.0] * 3)


@pytest.mark.parametrize(
    ("given", "sign"), [("", 1), ("I=2, ", 1), ("I=1, J=2, ", -1), ("J=2, ", -1)]
)
@pytest.mark.parametrize("mass", [2.0, 0.5])
def test_the_reaction_of_a_gcon_is_at_its_i(given: str, sign: int, mass: float) -> None:
    """A mass hangs on a rule: m g upwards on MARKER/2, downwards on MARKER/1."""
    text = (
        "title\nPART/1, GROUND\nMARKER/1, PART=1\nACCGRAV/JGRAV=-9.81\n"
        f"PART/2, MASS={mass}, CM=2, IP=1,1,1, QG=0,-1,0\nMARKER/2, PART=2\n"
        f"GCON/1, {given}FUNCTION=DM(2,1)-1\n"
        "REQUEST/1, F1=GCON(1,0,3)\\F2=GCON(1,1,3)\\F3=FY(2,1)\\F4=GCON(1)\nEND\n"
    )
    results = adamslite.simulate(read(text), end=0.1, steps=1)
    weight = mass * 9.81
    assert results["REQUEST/1.F1"] == pytest.approx([sign * weight] * 2)
    assert results["REQUEST/1.F2"] == pytest.approx([-sign * weight] * 2)
    assert results["REQUEST/1.F3"] == pytest.approx([weight] * 2)
    assert results["REQUEST/1.F4"] == pytest.approx([-weight] * 2)


def test_friction_inactive_during_is_inactive() -> None:
    joint = "MARKER/4, PART=1\nJOINT/1, REVOLUTE, I=2, J=4\n"
    friction = deck_with(joint + "FRICTION/1, JOINT=1, INACTIVE_DURING=STATIC").of("FRICTION")[0]
    assert friction.inactive == "STATIC"
    assert "passed-over" not in codes(joint + "FRICTION/1, JOINT=1, INACTIVE_DURING=STATIC")


@pytest.mark.parametrize("names", ["a\nout\n", "crane\noutput\n", "s\n", "mo\nP\n"])
def test_names_at_the_top_of_a_command_file_are_no_statements(names: str) -> None:
    """The model and the prefix of its output files, also where they look like keywords."""
    found = read_commands(f"{names}sim/stat\nstop\n", read(START))
    assert [each.keyword for each in found] == ["SIMULATE", "STOP"] and not found.warnings


def test_a_third_name_is_a_mistake() -> None:
    with pytest.raises(adamslite.DeckError, match="there is no statement crane"):
        read_commands("a\nb\ncrane\nstop\n", read(START))

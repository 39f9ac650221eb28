"""Decks as a whole: the paper's statements, what a Deck answers, command files."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest
from decklets import codes, deck_with, function, last, told

import adamslite
from adamslite.checks.rules import check
from adamslite.language.diagnostics import DeckError
from adamslite.language.expression import GROUND_FRAME, Call, Num, Op, Ref, to_text
from adamslite.language.messages import START
from adamslite.reading.read import read, read_commands

PAPER = r"""the statements of the paper, as printed
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1
PART/3, MASS=10, CM=cm, IP=1,1,1
MARKER/cm
POINT_MASS/2, MASS=1, QG=1,0,0
MARKER/2
VARIABLE/Dm, FUNCTION=10*TIME
VARIABLE/EA, FUNCTION=4000
VARIABLE/L_0, FUNCTION=1
VARIABLE/DeltaL, FUNCTION=0.1*TIME
SFORCE/0102, I=1, J=2, FUNCTION= -EA/(L_0+\Delta L)*[DM(1,2)-(L_0+\Delta L)]
VFORCE/02, I_marker=(cm), J_part=(ground)
, FX= VARVAL(Dm) /Gc * (ACCX(cm,0,0)-IGRAV)
,      + VARVAL(d(Dm)/dt) /Gc * VX(cm,0,0) \
, FY= VARVAL(Dm) /Gc * (ACCY(cm,0,0)-JGRAV)
,      + VARVAL(d(Dm)/dt) /Gc * VY(cm,0,0) \
, FZ= VARVAL(Dm)/Gc * (ACCZ(cm,0,0)-KGRAV)
,      + VARVAL(d(Dm)/dt) /Gc * VZ(cm,0,0)
"""


# ---- the paper's dialect ----------------------------------------------------------------------


def test_the_cable_force_of_the_paper() -> None:
    force = read(PAPER).find("SFORCE", 102)
    length = "(VARVAL(L_0) + VARVAL(DELTAL))"
    assert to_text(force.function) == f"-VARVAL(EA)/{length}*(DM(1, 2) - {length})"
    assert (force.label, force.kind, force.i, force.j) == ("SFORCE/102", "TRANSLATIONAL", 1, 2)


def test_the_mass_force_of_the_paper() -> None:
    force = read(PAPER).find("VFORCE", 2)
    assert (force.i, force.jfloat, force.j_part, force.rm) == ("CM", None, 1, 0)
    assert to_text(force.fy) == (
        "VARVAL(DM)/1*(ACCY(CM, 0, 0, 0) - (-9.81)) + DDT(DM)/1*VY(CM, 0, 0, 0)"
    )
    assert to_text(force.fx).startswith("VARVAL(DM)/1*(ACCX(CM, 0, 0, 0) - 0) + DDT(DM)")


def test_view_names_serve_as_names() -> None:
    text = PAPER.replace("VARIABLE/Dm", "! adams_view_name='Dm'\nVARIABLE/7")
    text = text.replace("MARKER/cm", "! adams_view_name='cm'\nMARKER/33")
    force = read(text).find("VFORCE", 2)
    assert force.i == 33
    assert to_text(force.fx).startswith("VARVAL(7)/1*(ACCX(33, 0, 0, 0) - 0) + DDT(7)/1")


def test_a_variable_of_that_very_name_is_the_rate() -> None:
    rate = Call("VARVAL", (Ref("VARIABLE", "D(DM)/DT"),))
    for name in ("VARIABLE/d(Dm)/dt", "! adams_view_name='d(Dm)/dt'\nVARIABLE/9"):
        deck = read(PAPER + f"{name}, FUNCTION=10\nVARIABLE/8, FUNCTION=VARVAL( d(DM) / dt )\n")
        found = deck.find("VARIABLE", 8).function
        assert found in (rate, Call("VARVAL", (Ref("VARIABLE", 9),)))


def test_gc_is_the_unit_factor_unless_a_variable_has_the_name() -> None:
    units = "UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND"
    assert function("Gc", units) == Num(1000.0)
    assert function("gc", "UNITS/SYSTEM=IPS").value == pytest.approx(386.0886, abs=1e-4)
    assert function("Gc", "VARIABLE/GC, FUNCTION=2") == Call("VARVAL", (Ref("VARIABLE", "GC"),))


def test_gravity_has_names() -> None:
    assert function("KGRAV", "ACCGRAV/KGRAV=-9.81") == Num(-9.81)
    assert function("IGRAV") == Num(0.0)


def test_ground_names_the_ground_part() -> None:
    deck = read(PAPER.replace("PART/1, GROUND", "PART/77, GROUND, QG=0,0,0"))
    assert deck.find("VFORCE", 2).j_part == 77
    assert last("PART/GROUND2, MASS=1, CM=g, IP=1,1,1\nMARKER/g\nMARKER/h, PART=ground").part == 1


# ---- expressions ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("-TIME**2", "-(TIME**2)"),
        ("2**3**2", "2**(3**2)"),
        ("2* *3", "2**3"),
        ("2**-TIME**2", "2**(-(TIME**2))"),
        ("-TIME*2", "-(TIME*2)"),
        ("-TIME+2", "(-TIME)+2"),
        ("8/4/2", "(8/4)/2"),
        ("8-4-2", "(8-4)-2"),
        ("2*-TIME", "2*(-TIME)"),
        ("1 - -TIME", "1-(-TIME)"),
        ("+TIME", "TIME"),
        ("((TIME))", "TIME"),
        ("[TIME+1]*2", "(TIME+1)*2"),
        ("ABS[TIME]", "ABS(TIME)"),
        ("TIME − 2·TIME", "TIME-2*TIME"),
    ],
)
def test_precedence_is_that_of_fortran(written: str, meant: str) -> None:
    assert function(written) == function(meant)


def test_a_minus_before_a_number_belongs_to_it() -> None:
    assert function("-5") == Num(-5.0)
    assert function("-2**2") == Op("neg", (Op("**", (Num(2.0), Num(2.0))),))


def test_omitted_markers_are_the_ground_frame() -> None:
    assert function("DX(2)") == Call("DX", (Ref("MARKER", 2), GROUND_FRAME, GROUND_FRAME))
    assert function("VX(2,1)") == function("VX(2,1,0,0)")


def test_if_takes_a_colon() -> None:
    assert function("IF(TIME-1: 0, 1, 2)").args[1:] == (Num(0.0), Num(1.0), Num(2.0))


@pytest.mark.parametrize(
    "text",
    [
        "-(1 + TIME)*2 - (3 - 4)/5",
        "IF(TIME - 1: -1, 0, MAX(1, 2, 3))",
        "2**(-TIME)*(-3)**2",
        "1 - (2 - 3) - (-4)",
        "DX(2, 1)/DM(2, 1)/2",
        " + ".join(f"{n}*TIME - {n}" for n in range(40)),
    ],
)
def test_written_out_and_read_again_it_is_the_same(text: str) -> None:
    node = function(text)
    assert function(to_text(node)) == node


def test_long_sums_stay_shallow_and_keep_their_value() -> None:
    def value(node: object) -> float:
        if isinstance(node, Num):
            return node.value
        left, right = map(value, node.args)
        return left + right if node.op == "+" else left - right

    def depth(node: object) -> int:
        return 1 + max(map(depth, node.args)) if isinstance(node, Op) else 1

    numbers = [(-1) ** (n % 3) * n for n in range(3000)]
    node = function("".join(f"{n:+d}" for n in numbers))
    assert value(node) == sum(numbers)
    assert depth(node) < 20


# ---- decks ------------------------------------------------------------------------------------


def test_what_a_deck_answers() -> None:
    deck = read(PAPER)
    assert deck.title == "the statements of the paper, as printed"
    assert [marker.key for marker in deck.of("MARKER")] == [1, "CM", 2]
    assert deck.find("MARKER", "cM").label == "MARKER/cm"
    assert deck.find("MARKER", 99) is None and deck.of("BEAM") == []
    assert deck.gravity == (0.0, -9.81, 0.0)
    assert deck.ucf == 1.0
    assert deck.single("UNITS").names is None
    assert deck.lines[1] == "ACCGRAV/JGRAV=-9.81"
    assert len(deck.hash) == 64
    assert [s.keyword for s in deck.statements[:3]] == ["ACCGRAV", "PART", "MARKER"]


def test_statements_are_frozen_and_know_what_was_given() -> None:
    marker = last("MARKER/4, PART=1, QP=1,2,3")
    with pytest.raises(dataclasses.FrozenInstanceError):
        marker.qp = (0, 0, 0)
    assert marker.given("qp") and not marker.given("reuler")
    assert dataclasses.replace(marker, qp=(4, 5, 6)).qp == (4, 5, 6)
    with pytest.raises(TypeError, match="no field colour"):
        type(marker)(colour=1)


def test_files_are_read_in_any_usual_encoding(tmp_path: Path) -> None:
    for encoding in ("utf-8", "utf-8-sig", "latin-1", "utf-16"):
        path = tmp_path / f"{encoding}.adm"
        path.write_bytes(("Prüfstand\n" + START[START.index("PART") :]).encode(encoding))
        assert adamslite.read(str(path)).title == "Prüfstand"
        assert read(path).statements[0].span.file == str(path)
    with pytest.raises(OSError):
        read(tmp_path / "none.adm")


def test_a_healthy_deck_has_nothing_to_be_told() -> None:
    assert read(PAPER).warnings == ()
    assert {each.code for each in check(read(PAPER))} == {"effective-mass"}


PUSHED = """A mass that its own acceleration pushes
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={length}, TIME=SECOND
PART/1, GROUND
POINT_MASS/2, MASS=4, CM=2
MARKER/2, POINT_MASS=2
VARIABLE/DM, FUNCTION=0.5+TIME
VFORCE/1, I=2, J_PART=1, FY={force}
END
"""


@pytest.mark.parametrize(("length", "mass"), [("METER", "4"), ("MILLIMETER", "0.004")])
def test_the_effective_mass_is_that_of_forces(length: str, mass: str) -> None:
    """F = DM a takes DM from m/UCF, the force that an acceleration of one unit takes."""
    for force, left in (
        ("VARVAL(DM)*ACCY(2)", "VARVAL(DM)"),
        ("7+0.5*ACCY(2)", "0.5"),
        ("ACCY(2)*(3-TIME)", "(3 - TIME)"),
    ):
        (told,) = check(read(PUSHED.format(length=length, force=force)))
        assert told.message.endswith(f"effective mass along y is {mass} - {left}")
    for force in ("-VARVAL(DM)*ACCY(2)", "1-0.5*ACCY(2)", "-(ACCY(2)/4)"):
        assert not check(read(PUSHED.format(length=length, force=force)))


def test_the_effective_mass_of_a_part_without_mass() -> None:
    """A part that a joint holds may be without MASS: zero is what the force is taken from."""
    held = "PART/5, CM=5\nMARKER/5, PART=5\nJOINT/1, FIXED, I=5, J=1\nMARKER/6, PART=1, FLOATING\n"
    found = told(f"{START}{held}VFORCE/1, I=5, JFLOAT=6, FX=2*ACCX(5)\n")
    assert [each.code for each in found] == ["no-inertia", "effective-mass"]
    assert found[1].message.endswith("effective mass along x is 0 - 2")


def test_a_mistake_does_not_make_others() -> None:
    """What refers to a statement with a mistake is not blamed for it."""
    assert codes("MARKER/4, PART=1, QP=1,2\nSFORCE/1, I=3, J=4, FUNCTION=1") == ["value-count"]
    assert codes("PRT/4, MASS=1, CM=4, IP=1,1,1\nMARKER/4, PART=4") == ["unknown-statement"]
    assert codes("PINT_MASS/4, MASS=1\nMARKER/4\nVARIABLE/1, FUNCTION=DM(4)") == [
        "unknown-statement"
    ]


# ---- commands ---------------------------------------------------------------------------------


def test_command_files() -> None:
    commands = read_commands(
        "file/model=some.thing\n! comment\nINTEGRATOR/ &\n, GSTIFF &  ! comment\n, ERR=1e-5\n"
        "sim/dyn, end=10.0, &\n dtout=5.0E-02; sim/dyn, dur=1\n, steps=5\nstop\nwhatever ( it is\n",
        read(START),
    )
    assert [c.label for c in commands] == ["FILE", "INTEGRATOR", "SIMULATE", "SIMULATE", "STOP"]
    assert (commands[1].method, commands[1].error) == ("GSTIFF", 1e-5)
    assert (commands[2].end, commands[2].dtout, commands[3].steps) == (10.0, 0.05, 5)


def test_a_command_file_may_begin_with_the_name_of_the_model() -> None:
    commands = read_commands("\nmy_model\nmy_model\nSIM/DYN, END=1, STEPS=1\n", read(START))
    assert [command.label for command in commands] == ["SIMULATE"]


def test_mistakes_in_command_files_are_told_like_those_in_decks() -> None:
    with pytest.raises(DeckError) as error:
        read_commands("SIM/DYN, END=1, STEPS=0\nINTEGRATOR/QUICKLY\ncontrol\n", read(START))
    assert [d.code for d in error.value.diagnostics] == [
        "not-positive",
        "unknown-argument",
        "planned-statement",
    ]


def test_deck_with_everything_reads_quickly_enough_to_be_used() -> None:
    """Statements of one form share their syntax tree: a thousand cost far less than a thousand."""
    from adamslite.syntax.forms import _short_form, expression_form

    deck_with("")
    before = _short_form.cache_info().misses + expression_form.cache_info().misses
    lines = (
        f"POINT_MASS/{n}, MASS=1, QG={n},0,0; MARKER/{n}; "
        f"SFORCE/{n}, I={n}, J=1, FUNCTION=-{n}.5*(DM({n},1)-2)"
        for n in range(10, 1010)
    )
    assert len(deck_with("\n".join(lines)).of("SFORCE")) == 1000
    after = _short_form.cache_info().misses + expression_form.cache_info().misses
    assert after - before <= 4

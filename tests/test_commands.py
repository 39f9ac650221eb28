"""Command files: what they may say, and what becomes of the deck."""

from __future__ import annotations

from math import radians
from pathlib import Path
from typing import Any

import pytest

from adamslite.analyses.setup.output_times import output_times
from adamslite.deck.commands import Commands
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Redefinition
from adamslite.language.diagnostics import DeckError, Diagnostic
from adamslite.language.expression import Num, to_text
from adamslite.language.messages import START
from adamslite.reading.read import read, read_commands
from adamslite.scene import load_scene

RIG = (
    START
    + """MARKER/4, PART=2, QP=1,0,0, REULER=90D,0,0
VARIABLE/5, FUNCTION=1
! adams_view_name='lift'
VARIABLE/6, FUNCTION=VARVAL(5) + KGRAV
ACCGRAV/KGRAV=-9.81
SFORCE/7, I=4, J=3, FUNCTION=10
VFORCE/8, I=3, J_PART=1, FX=1\\, FY=KGRAV
REQUEST/9, DISPLACEMENT, I=2
JOINT/10, REVOLUTE, I=4, J=1
JOINT/12, SPHERICAL, I=3, J=1
JOINT/15, SPHERICAL, I=3, J=1
MOTION/11, JOINT=10, ROTATION, FUNCTION=TIME
DIFF/13, IC=2, FUNCTION=-1
PINPUT/1, VARIABLES=5,6
POUTPUT/1, VARIABLES=6
"""
)


def rig() -> Deck:
    return read(RIG)


def commands(text: str, deck: Deck | None = None) -> Commands:
    return read_commands(text + "\n", deck or rig())


def only(text: str) -> Any:
    (command,) = commands(text)
    return command


def changed(text: str) -> Deck:
    """The rig after these commands."""
    deck = rig()
    for command in commands(text, deck):
        deck = deck.after(command)
    return deck


def faults(text: str) -> list[Diagnostic]:
    try:
        return list(commands(text).warnings)
    except DeckError as error:
        return list(error.diagnostics)


# ---- statements that change -------------------------------------------------------------------


def test_a_statement_as_command_changes_only_what_it_gives() -> None:
    command = only("VAR/5, FU=2*TIME")
    assert isinstance(command, Redefinition) and command.label == "VARIABLE/5"
    assert dict(command.changes).keys() == {"function"}
    before = rig()
    after = before.after(command)
    assert to_text(after.find("VARIABLE", 5).function) == "2*TIME"
    assert to_text(before.find("VARIABLE", 5).function) == "1"
    assert [s.label for s in after.statements] == [s.label for s in before.statements]
    part = changed("PART/2, MASS=3").find("PART", 2)
    assert (part.mass, part.cm, part.ip) == (3.0, 2, (1.0, 1.0, 1.0))


def test_start_values_given_too_late_are_told() -> None:
    """A model that has moved goes on from where it is."""
    early = "PART/2, VX=3\nDIFF/13, IC=5\nSIM/DYN, END=1, STEPS=1\n"
    assert not commands(early).warnings
    late = early + "PART/2, VX=4, MASS=2\nDIFF/13, IC=6\nJOINT/10, IC=1\nVAR/5, FU=2\n"
    found = commands(late + "SIM/DYN, END=2, STEPS=1\n").warnings
    assert [(each.code, each.span.line, each.severity) for each in found] == [
        ("no-effect", 4, "warning"), ("no-effect", 5, "warning"), ("no-effect", 6, "warning"),
    ]  # fmt: skip
    assert "VX has no effect in PART/2" in found[0].message


@pytest.mark.parametrize(
    ("text", "keyword", "field", "value"),
    [
        ("MARKER/4, QP=3,0,0", "MARKER", "qp", (3.0, 0.0, 0.0)),
        ("SFORCE/7, I=2", "SFORCE", "i", 2),
        ("VFORCE/8, FX=7", "VFORCE", "fx", Num(7.0)),
        ("MOTION/11, FUNCTION=4", "MOTION", "function", Num(4.0)),
        ("DIFF/13, IC=5", "DIFF", "ic", (5.0,)),
        ("VARIABLE/lift, FUNCTION=8", "VARIABLE", "function", Num(8.0)),
        ("VFORCE/8, J_PART=ground", "VFORCE", "j_part", 1),
    ],
)
def test_any_statement_with_an_id_may_change(
    text: str, keyword: str, field: str, value: Any
) -> None:
    command = only(text)
    deck = rig().after(command)
    found = deck.find(keyword, command.key)
    assert getattr(found, field) == value
    assert found.given(field) and found.spans[field].file == "<commands>"
    assert found.span.file == "<text>"


def test_one_way_to_say_it_replaces_the_other() -> None:
    marker = changed("MARKER/4, ZP=1,0,1, XP=2,0,0").find("MARKER", 4)
    assert marker.reuler == (0.0, 0.0, 0.0) and not marker.given("reuler")
    assert marker.given("zp") and marker.qp == (1.0, 0.0, 0.0)
    request = changed("REQUEST/9, F2=TIME").find("REQUEST", 9)
    assert request.kind is None and request.result_names == ("F2",)


def test_gravity_changes_what_was_named_after_it() -> None:
    deck = changed("VFORCE/8, FX=2*KGRAV\nACCGRAV/KGRAV=0, JGRAV=-1")
    assert deck.gravity == (0.0, -1.0, 0.0)
    assert to_text(deck.find("VFORCE", 8).fy) == "0"
    assert to_text(deck.find("VFORCE", 8).fx) == "2*0"
    assert to_text(deck.find("VARIABLE", 6).function) == "VARVAL(5) + 0"
    later = changed("ACCGRAV/KGRAV=-2\nVARIABLE/5, FUNCTION=KGRAV")
    assert later.find("VARIABLE", 5).function == Num(-2.0)


def test_gravity_may_come_where_there_was_none() -> None:
    deck = read(START)
    (command,) = commands("ACCGRAV/JGRAV=-9.81", deck)
    assert deck.after(command).gravity == (0.0, -9.81, 0.0)


def test_an_acceleration_brings_its_state_up_to_date() -> None:
    deck = read(RIG.replace("ROTATION, FUNCTION=TIME", "ROTATION, ACCELERATION, FUNCTION=TIME"))
    for command in commands("MOTION/11, FUNCTION=3", deck):
        deck = deck.after(command)
    assert [each.function for each in deck.of("DIFF")][0] == Num(3.0)
    assert len(deck.of("DIFF")) == 2


def test_changes_are_checked_where_they_come_to_run() -> None:
    """Between two analyses a statement may be half changed."""
    assert faults("SFORCE/7, I=3\nSFORCE/7, J=2\nSIM/STATICS") == []
    (fault,) = faults("SFORCE/7, I=3\nSIM/STATICS\nSFORCE/7, J=2")
    assert fault.code == "same-marker"
    (fault,) = faults("INTEGRATOR/ERROR=1e-4\nPART/2, MASS=-1")
    assert (fault.code, fault.span.file, fault.span.line) == ("negative-mass", "<commands>", 2)


@pytest.mark.parametrize(
    ("text", "code", "hint"),
    [
        ("VARIABLE/55, FUNCTION=1", "missing-reference", "there is VARIABLE/5"),
        ("VARIABLE/lfit, FUNCTION=1", "missing-reference", "did you mean LIFT?"),
        ("VARIABLE/, FUNCTION=1", "missing-id", "write VARIABLE/1"),
        ("VARIABLE/5, FUNCTION=VARVAL(66)", "missing-reference", ""),
        ("MARKER/4, QP=1,2", "value-count", ""),
        ("BEEM/1", "unknown-statement", ""),
        ("PFORCE/1, I=1", "planned-statement", ""),
    ],
)
def test_what_cannot_change(text: str, code: str, hint: str) -> None:
    (fault,) = faults(text)
    assert fault.code == code and hint in fault.hint


def test_all_mistakes_are_told_at_once_with_their_lines() -> None:
    found = faults(
        "file/model=rig\nVARIABLE/5 &\n, FUNCTION=2*nobody\nPART/2, MAS5=1; SIM/STATICS\n"
        "DEACTIVATE/JOINT, ID=10, 99\nequil/error=0, stab=-1\nstop\n(((\n"
    )
    assert [(each.code, each.span.line) for each in found] == [
        ("unknown-name", 3),
        ("unknown-argument", 4),
        ("missing-reference", 5),
        ("not-positive", 6),
        ("negative", 6),
    ]


# ---- analyses ---------------------------------------------------------------------------------


def test_simulations_of_every_kind() -> None:
    runs = commands(
        "sim/stat; SIMULATE/INITIAL_CONDITIONS, VEL\nSIM/KIN, END=1, STEPS=2\n"
        "SIM/TRANS, DUR=1, DTOUT=.5\nSIM/STATICS, END=3, STEPS=1\nSIM/INIT"
    )
    assert [run.kind for run in runs] == [
        "STATICS", "INITIAL_CONDITIONS", "KINEMATICS", "TRANSIENT", "STATICS", "INITIAL_CONDITIONS",
    ]  # fmt: skip
    assert [run.at_once for run in runs] == [True, True, False, False, False, True]
    assert [run.level for run in runs][1::4] == ["VELOCITY", None]
    now, reached = 0.0, []
    for run in runs:
        now = run.until(now)
        reached.append(now)
    assert reached == [0, 0, 1, 2, 3, 3]


@pytest.mark.parametrize(
    ("text", "start", "times"),
    [
        ("END=1, STEPS=4", 0.0, [0, 0.25, 0.5, 0.75, 1]),
        ("DURATION=1, STEPS=2", 3.0, [3, 3.5, 4]),
        ("END=4, DTOUT=0.4", 3.0, [3, 3.4, 3.8, 4]),
        ("END=.004, DTOUT=.02", 0.0, [0, 0.004]),
        ("DURATION=0.3, DTOUT=0.1", 0.0, [0, 0.1, 0.2, 0.3]),
    ],
)
def test_output_times(text: str, start: float, times: list[float]) -> None:
    assert output_times(only(f"SIM/DYN, {text}"), start) == pytest.approx(times, abs=1e-15)


def test_an_analysis_at_once_writes_once() -> None:
    assert list(output_times(only("SIM/STAT"), 2.0)) == [2.0]
    with_warning = commands("SIM/DYN, END=1")
    assert [each.code for each in with_warning.warnings] == ["no-output-step"]
    assert len(output_times(with_warning[0], 0.0)) == 101


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("SIM/DYN, END=1, STEPS=1\nSIM/DYN, END=1, STEPS=1", "end-not-later"),
        ("SIM/STATICS, STEPS=3", "no-end"),
        ("SIM/STATICS, END=1, DURATION=1, STEPS=3", "two-ends"),
        ("SIM/INITIAL, END=1", "no-effect"),
        ("SIM/INIT, ACCEL", "passed-over"),
        ("LINEAR/EIGENSOL, FILE=a.mat", "no-effect"),
        ("LINEAR/STATEMAT, FORMAT=MATRIXX", "no-effect"),
        ("LINEAR/STATEMAT, COORDS=1,2", "no-effect"),
        ("LINEAR/STATEMAT, PSTATE=1", "missing-reference"),
        ("LINEAR/NASTRAN", "planned-choice"),
        ("LINEAR/STATEMAT, PINPUT=2", "missing-reference"),
    ],
)
def test_analyses_that_make_no_sense(text: str, code: str) -> None:
    assert [each.code for each in faults(text)] == [code]


def test_a_sensor_may_end_a_run_before_its_end() -> None:
    deck = read(RIG + "SENSOR/1, RETURN, VALUE=0.5, FUNCTION=TIME\n")
    assert commands("SIM/DYN, END=1, STEPS=1\nSIM/DYN, END=1, STEPS=1", deck).warnings == ()


def test_linear_commands() -> None:
    first, second = commands("LINEAR/EIGEN, RM=4\nlin/state, file=a.mat, pin=1, pout=1")
    assert (first.kind, first.rm) == ("EIGENSOL", 4)
    assert (second.kind, second.file) == ("STATEMAT", "a.mat")
    assert (second.pinput, second.poutput) == (1, 1)
    assert rig().find("PINPUT", 1).variables == (5, 6)


# ---- settings ---------------------------------------------------------------------------------


def test_the_defaults_of_the_settings() -> None:
    static = rig().settings("EQUILIBRIUM")
    assert (static.alimit, static.tlimit, static.maxit) == (radians(10), 20.0, 25)
    assert (static.error, static.imbalance, static.stability) == (1e-4, 1e-4, 1e-5)
    assert static.pattern == ()
    kinematic = rig().settings("KINEMATICS")
    assert (kinematic.error, kinematic.aerror, kinematic.maxit) == (1e-4, 1e-4, 25)
    assert (kinematic.tlimit, kinematic.alimit) == (1e10, radians(30))


def test_settings_add_up() -> None:
    deck = changed("equil/error=0.1, alim=2.0D\nEQUIL/imbal=2, pattern=T:F\nINTEG/HMAX=.1")
    static = deck.settings("EQUILIBRIUM")
    assert (static.error, static.alimit, static.imbalance) == (0.1, radians(2), 2.0)
    assert (static.pattern, static.maxit) == (("T", "F"), 25)
    assert deck.settings("INTEGRATOR").hmax == 0.1
    deck = changed("equil/error=0.1, maxit=9\nequil/default, maxit=8")
    static = deck.settings("EQUILIBRIUM")
    assert (static.error, static.maxit) == (1e-4, 8)


def test_settings_in_the_deck_come_first() -> None:
    deck = read(RIG + "EQUILIBRIUM/ERROR=1, MAXIT=3\n")
    (command,) = commands("equilibrium/error=2", deck)
    settings = deck.after(command).settings("EQUILIBRIUM")
    assert (settings.error, settings.maxit) == (2.0, 3)


# ---- switches ---------------------------------------------------------------------------------


def test_switching_elements_off_and_on() -> None:
    deck = changed("DEACTIVATE/JOINT, ID=10\nDEACT/JOINT, RANGE=11,20; deac/motion, id=11")
    assert deck.inactive == {("JOINT", 10), ("JOINT", 12), ("JOINT", 15), ("MOTION", 11)}
    assert not deck.is_active(deck.find("JOINT", 10)) and deck.is_active(deck.find("SFORCE", 7))
    (command,) = commands("ACTIVATE/JOINT, ID=10, 12", deck)
    assert deck.after(command).inactive == {("JOINT", 15), ("MOTION", 11)}
    assert deck.with_active("JOINT", [10, 12, 15], True).inactive == {("MOTION", 11)}


@pytest.mark.parametrize(
    ("ends", "joints"),
    [("10,15", {10, 12, 15}), ("12,15", {12, 15}), ("10,12", {10, 12}), ("11,14", {12})],
)
def test_a_range_counts_with_its_first_and_its_last(ends: str, joints: set[int]) -> None:
    deck = changed(f"DEACTIVATE/JOINT, RANGE={ends}")
    assert deck.inactive == {("JOINT", key) for key in joints}


def test_switches_survive_other_changes() -> None:
    deck = changed("DEACTIVATE/SFORCE, ID=7\nVARIABLE/5, FUNCTION=3\nSIM/STATICS")
    assert deck.inactive == {("SFORCE", 7)}


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("DEACTIVATE/JOINT", "missing-argument"),
        ("DEACTIVATE/ID=1", "missing-argument"),
        ("DEACTIVATE/JOINT, ID=11", "missing-reference"),
        ("DEACTIVATE/JOINT, RANGE=100,200", "empty-range"),
        ("DEACTIVATE/JOINT, RANGE=100", "value-count"),
        ("DEACTIVATE/CVCV, ID=1", "missing-reference"),
        ("DEACTIVATE/WHEEL, ID=1", "unknown-argument"),
        ("DEACTIVATE/JOINT, ID=1.5", "bad-id"),
    ],
)
def test_switches_that_reach_nothing(text: str, code: str) -> None:
    assert code in [each.code for each in faults(text)]


# ---- files ------------------------------------------------------------------------------------


def test_the_mistakes_of_deck_and_commands_are_told_together(tmp_path: Path) -> None:
    (tmp_path / "rig.adm").write_text(RIG + "SFORCE/99, I=1, J=77, FUNCTION=1\n")
    (tmp_path / "rig.acf").write_text("SFORCE/99, FUNCTION=1\nVARIABLE/5, FUNCTION=nobody\n")
    with pytest.raises(DeckError) as error:
        load_scene(tmp_path / "rig.adm")
    found = [(Path(each.span.file).name, each.code) for each in error.value.diagnostics]
    assert sorted(found) == [("rig.acf", "unknown-name"), ("rig.adm", "missing-reference")]


def test_warnings_of_commands_are_those_of_the_scene(tmp_path: Path) -> None:
    (tmp_path / "rig.adm").write_text(RIG)
    (tmp_path / "rig.acf").write_text("SIM/DYN, END=1\n")
    scene = load_scene(tmp_path / "rig.adm")
    assert "no-output-step" in [each.code for each in scene.warnings]


def test_mistakes_of_commands_do_not_hide_warnings_of_the_deck(tmp_path: Path) -> None:
    (tmp_path / "rig.adm").write_text(RIG + "MARKER/88, PART=1, FLOATING\n")
    (tmp_path / "rig.acf").write_text("VARIABLE/5, FUNCTION=nobody\n")
    with pytest.raises(DeckError) as error:
        load_scene(tmp_path / "rig.adm")
    found = {each.code for each in error.value.diagnostics}
    assert found >= {"unknown-name", "floating-unused"}


def test_one_note_for_deck_and_commands(tmp_path: Path) -> None:
    """Each place is in the data; the text tells everything where it first stands."""
    (tmp_path / "rig.adm").write_text(RIG + "OUTPUT/NOSEPARATOR\nDEBUG/EPRINT\n")
    (tmp_path / "rig.acf").write_text("output/nosep\nRESULTS/NOLINEAR\nSIM/DYN, END=1, STEPS=2\n")
    found = load_scene(tmp_path / "rig.adm").warnings
    (note,) = (each for each in found if each.code == "passed-over")
    assert note.message.endswith(": OUTPUT (2), DEBUG, RESULTS")
    assert Path(note.span.file).name == "rig.adm"
    assert [Path(each.file).suffix for each in note.places] == [".adm", ".adm", ".acf", ".acf"]

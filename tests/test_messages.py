"""The table of messages: every broken deck in it yields its message, and nothing else."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest
from decklets import told
from hypothesis import given, settings
from hypothesis import strategies as st

import adamslite
from adamslite.language.diagnostics import ERROR, QUOTED, DeckError
from adamslite.language.messages import MESSAGES, START
from adamslite.language.messages.needless import NEEDLESS
from adamslite.reading.read import read, read_commands

WHOLE = ("no-run", *NEEDLESS)
"""What is known only when deck and commands have been read, or is reported by `check` alone."""
LONG = (
    "changes-not-checked", "deck-too-large", "expression-too-large", "expression-too-long",
    "more-messages",
)  # fmt: skip
"""They have no short example, see test_hostile_texts."""
BROKEN = [
    (code, deck)
    for code, message in MESSAGES.items()
    for deck in message.broken
    if code not in WHOLE
]
USER = {
    (code, deck): [option]
    for code, message in MESSAGES.items()
    for deck, option in zip(message.broken, message.user, strict=False)
}
SECTION = "LENGTH=1, IXX=1, IYY=1, IZZ=1, AREA=1, EMODULUS=1, GMODULUS=1"
COMMANDS = [(code, text) for code, message in MESSAGES.items() for text in message.commands]


def whole(code: str, broken: str) -> str:
    """The deck an entry of the table stands for."""
    alone = broken.startswith("title") or code == "missing-title"
    return (broken if alone else START + broken) + "\n"


def test_the_start_is_a_healthy_deck() -> None:
    assert told(START) == []


@pytest.mark.parametrize(("code", "broken"), BROKEN)
def test_a_broken_deck_yields_its_message_only(code: str, broken: str) -> None:
    assert {
        diagnostic.code for diagnostic in told(whole(code, broken), USER.get((code, broken)))
    } == {code}


@pytest.mark.parametrize(("code", "broken"), COMMANDS)
def test_a_broken_command_file_yields_its_message_only(code: str, broken: str) -> None:
    deck = read(START + MESSAGES[code].deck)
    deck.path = Path("deck.adm")
    try:
        found = read_commands(broken + "\n", deck).warnings
    except DeckError as error:
        found = error.diagnostics
    assert {diagnostic.code for diagnostic in found} == {code}


# ---- several mistakes at once -------------------------------------------------------------------

STARTS = re.compile(r"^[ \t]*([A-Za-z_]\w*)[ \t]*/[ \t]*(\d*)", re.MULTILINE)
#: Reported once everything else is right: they need the equations.
LAST = {"no-rate", "force-loop"}
#: What these say depends on statements that may not be readable for another mistake.
DEPENDENT = {"gcon-marker", "motion-not-of-time", "end-not-later"}
TOGETHER, DECKS = 6, 150


def defined(broken: str) -> set[tuple[str, str]]:
    """Keywords and ids of the statements of an entry."""
    return {(keyword.upper(), id) for keyword, id in STARTS.findall(broken)}


def mixtures() -> Iterator[tuple[set[str], str]]:
    """Decks of entries of the table with different ids, with the codes of all of them."""
    random = Random(1)
    entries = [
        (code, broken)
        for code, broken in BROKEN
        if MESSAGES[code].severity == ERROR and code not in LAST | DEPENDENT
        if whole(code, broken).startswith(START) and (code, broken) not in USER
    ]
    for _ in range(DECKS):
        random.shuffle(entries)
        taken: set[tuple[str, str]] = set()
        chosen: list[tuple[str, str]] = []
        for code, broken in entries:
            if len(chosen) < TOGETHER and not taken & defined(broken):
                taken |= defined(broken)
                chosen.append((code, broken))
        yield {code for code, _ in chosen}, "\n".join(broken for _, broken in chosen)


def test_no_mistake_hides_another() -> None:
    found = [(codes, text, told(START + text + "\n")) for codes, text in mixtures()]
    assert sum(len(codes) for codes, *_ in found) > 5 * DECKS
    hidden = [(codes - {each.code for each in all_told}, text) for codes, text, all_told in found]
    assert [(codes, text) for codes, text in hidden if codes] == []


@pytest.mark.parametrize("code", ["no-run"])
def test_a_broken_scene_yields_its_message_only(code: str, tmp_path: Path) -> None:
    path, commands = tmp_path / "deck.adm", tmp_path / "deck.acf"
    for broken in MESSAGES[code].broken:
        path.write_text(whole(code, broken))
        assert {diagnostic.code for diagnostic in adamslite.check(path)} == {code}
        path.write_text(whole(code, broken + f" ! adamslite: ignore {code}"))
        assert adamslite.check(path) == []
        path.write_text(whole(code, broken))
        commands.write_text("SIMULATE/DYNAMICS, END=1, STEPS=1\n")
        assert adamslite.check(path) == []


@pytest.mark.parametrize("code", MESSAGES)
def test_a_message_has_an_example_and_fits_on_a_line(code: str) -> None:
    message = MESSAGES[code]
    assert message.broken or message.commands or code in LONG
    assert "\n" not in message.sentence + message.hint
    assert not message.sentence.endswith(".")


@pytest.mark.parametrize(("code", "broken"), BROKEN)
def test_a_message_shows_its_place(code: str, broken: str) -> None:
    text = whole(code, broken)
    for diagnostic in told(text, USER.get((code, broken))):
        if code == "unknown-user":  # it is about the command line
            continue
        line = text.split("\n")[diagnostic.span.line - 1]
        assert diagnostic.source_line == line or len(line) > QUOTED
        assert 1 <= diagnostic.span.column <= len(line) + 1
        assert f"<text>:{diagnostic.span.line}:{diagnostic.span.column}: " in diagnostic.render()


def test_all_mistakes_are_told_at_once_and_in_order() -> None:
    text = START + "".join(
        f"{line}\n"
        for line in (
            "FORSE/1, I=1, J=2",
            "SFORCE/1, I=1, J=99, FUNCTION=SINN(1) + nobody*MAX(1) + (2",
            "VFORCE/1, I=2, J_PART=1, FX=(1\\",
            ", FY=whatever",
            "MARKER/1, PART=12, QP=1,2",
        )
    )
    found = told(text)
    assert [d.code for d in found] == [
        "unknown-statement",
        "missing-reference",
        "unclosed-bracket",
        "unclosed-bracket",
        "unknown-name",
        "duplicate-id",
        "missing-reference",
        "value-count",
    ]
    assert [d.span.line for d in found] == [8, 9, 9, 10, 11, 12, 12, 12]


@pytest.mark.parametrize(
    ("broken", "hint"),
    [
        ("SFORSE/1, I=1, J=2, FUNCTION=1", "did you mean SFORCE?"),
        ("SFORCE/1, I=1, J=2, FUNCION=1", "did you mean FUNCTION?"),
        ("JOINT/1, REVOLVE, I=1, J=2", "did you mean REVOLUTE?"),
        ("VARIABLE/1, FUNCTION=SQR(2)", "did you mean SQRT?"),
        ("VARIABLE/mass, FUNCTION=1\nVARIABLE/1, FUNCTION=2*mas", "did you mean MASS?"),
        ("VARIABLE/1, FUNCTION=TIM", "did you mean TIME?"),
        ("MARKER/wheel, PART=1\nVARIABLE/1, FUNCTION=DX(weel)", "did you mean WHEEL?"),
        ("UNITS/SYSTEM=MKSA", "did you mean MKS?"),
        ("MARKER/4, PART=3", "there is a POINT_MASS/3"),
        ("VARIABLE/a, FUNCTION=1\nVARIABLE/1, FUNCTION=a(2)", "a is a VARIABLE"),
        ("CURVE/1, FUNCTION=USER(1)", "bind it, user={'CURSUB': function} or user={'CURVE/1': "),
        (f"BEAM/1, I=2, J=1, {SECTION}, FORMULATION=NONLINEAR", "a beam that bends far is a row"),
        ("VARIABLE/1, FUNCTION=2^3", "a power is written **"),
        ("VARIABLE/1, FUNCTION=TIME > 1", "IF(x: a, b, c)"),
        ("VARIABLE/1, FUNCTION=TIME(1)", "TIME takes no arguments"),
        ("VARIABLE/1, FUNCTION=2TIME", "a product is written 2*TIME"),
        ("VARIABLE/1, FUNCTION=DY(1 1)", "arguments are separated by commas"),
        ("VARIABLE/1, FUNCTION=(1 1)", "an expression ends with a backslash when another"),
        ("VARIABLE/1, FUNCTION=1E", "an expression ends with a backslash"),
        ("JOINT/1, INLINE, I=2, J=1", "INLINE belongs to JPRIM"),
        (f"MARKER/{'9' * 19}, PART=1", "an id is a number from 1 up, of 18 digits at most"),
        ("VARIABLE/1, FUNCTION=DX(12)", "there is MARKER/1, 2, 3"),
        ("VARIABLE/1, FUNCTION=DX + 1", "DX is a function: write DX(i[, j][, k])"),
        ("POINT_MASS/4, MASS=3,5", "decimals follow a point: MASS=3.5"),
        ("POINT_MASS/4, MASS=3, VX=-2, 05", "decimals follow a point: VX=-2.05"),
        ("POINT_MASS/4, MASS=3.5,5", "values follow the = sign of their argument"),
    ],
)
def test_hints_name_what_was_meant(broken: str, hint: str) -> None:
    (diagnostic,) = told(START + broken + "\n")
    assert diagnostic.hint.startswith(hint)


def test_a_decimal_comma_is_corrected_to_a_point() -> None:
    (diagnostic,) = told(f"{START}POINT_MASS/4, MASS=3, 5\n")
    (correction,) = diagnostic.fixes
    assert correction.title == "write 3.5"
    assert [(edit.text, edit.span.column, edit.span.end_column) for edit in correction.edits] == [
        (".", 21, 23)
    ]
    first, second = told(f"{START}POINT_MASS/4, MASS=3,5,7\n")
    assert first.fixes and not second.fixes


def test_one_argument_is_one_argument() -> None:
    (diagnostic,) = told(START + "VARIABLE/1, FUNCTION=SIN()\n")
    assert diagnostic.message == "SIN takes 1 argument and has 0"


def test_what_is_not_supported_is_told_once_with_its_number() -> None:
    """A reference to a statement that cannot be run is no mistake of its own."""
    text = "LSSMATRIX/1\nLSSMATRIX/2\nPFORCE/1, X=1\nVARIABLE/1, FUNCTION=AO(1,2)+AO(2,1)"
    found = told(START + text + "\n")
    assert [d.message for d in found] == [
        "not supported yet: LSSMATRIX (2 times, first here)",
        "not supported yet: PFORCE",
        "not supported yet: function AO (2 times, first here)",
    ]


def test_carets_stand_below_what_is_meant() -> None:
    (diagnostic,) = told(START + "VARIABLE/1, FUNCTION=2*SQR(3)\n")
    assert diagnostic.render() == (
        "<text>:8:24: error: there is no function SQR [unknown-function]\n"
        "  8 | VARIABLE/1, FUNCTION=2*SQR(3)\n"
        "    |                        ^^^\n"
        "    = did you mean SQRT?"
    )


# ---- any text ---------------------------------------------------------------------------------

PIECES = [
    *"()[],;:=/\\*+-!&'\"\n .019DEaΔ%\x00",
    *(
        "\n, ",
        "PART/",
        "MARKER/4",
        "SFORCE/1, ",
        "I=1",
        "IF(1:",
        "MAX(",
        "DX(1",
        "FUNCTION=",
        "QP=",
    ),
    *("VARVAL(d(Dm)/dt)", "ACCGRAV/", "END", "1D-3", "90D", "E999", "\\Delta ", "ground"),
    *("! adams_view_name='a'\n", "VARIABLE/a, FUNCTION=", "INTEGRATOR/", "SIM/D,"),
]


@settings(deadline=None, max_examples=300)
@given(st.lists(st.sampled_from(PIECES), max_size=40).map("".join))
def test_no_text_leads_to_anything_but_messages(text: str) -> None:
    deck = read(START)
    for diagnostic in told(START + text + "\n"):
        assert diagnostic.code in MESSAGES and diagnostic.span.line >= 1
    try:
        read_commands(text + "\n", deck)
    except DeckError as error:
        assert str(error)


@settings(deadline=None, max_examples=100)
@given(st.text(max_size=80))
def test_nor_do_any_characters(text: str) -> None:
    told(text + "\n")

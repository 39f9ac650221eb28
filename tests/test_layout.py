"""The canonical layout: `adamslite fmt`."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from random_decks import decks
from tiers import every

from adamslite.cli.main import main
from adamslite.editing.layout import formatted
from adamslite.editing.text_file import read_text
from adamslite.language.diagnostics import DeckError
from adamslite.language.messages.ignoring import judged
from adamslite.reading.read import read
from adamslite.resources import find

FOLDERS = sorted({path.parent for path in find("decks").rglob("*.adm")})
FIRST = [min(folder.glob("*.adm")) for folder in FOLDERS]
LONG = "a" * 70
"""No line has room for it and for another word."""
LAYOUTS = {
    "what is before a word that fills a line stays together": (
        f"MARKER/200, PART=1005, QP=0.1,0,{LONG}",
        f"MARKER/200, PART=1005, QP=0.1,0\n, {LONG}",
    ),
    "keywords in full and in capitals, names as they are": (
        "spr/1, trans, i_m=2, J=1, k=5, length = 1\nM/2,P=1\nvari/Dm, func=step(Time,0,0,1,Ea)",
        "SPRINGDAMPER/1, TRANSLATIONAL, I_MARKER=2, J=1, K=5, LENGTH=1\n"
        "MARKER/2, PART=1\n"
        "VARIABLE/Dm, FUNCTION=STEP(TIME,0,0,1,Ea)",
    ),
    "what fits into a line stands in one": (
        "UNITS/\n, FORCE = NEWTON\n, MASS = KILOGRAM",
        "UNITS/FORCE=NEWTON, MASS=KILOGRAM",
    ),
    "a long statement is filled, an expression begins a line": (
        "SFORCE/1, I=10010, J=10020, TRANSLATION, FUNCTION=-1000*(DM(10010,10020)-1.25)"
        "-20*VR(10010,10020)*STEP(TIME,0,0,1.5,1)",
        "SFORCE/1, I=10010, J=10020, TRANSLATIONAL\n"
        ", FUNCTION=-1000*(DM(10010,10020)-1.25)\n"
        ",     - 20*VR(10010,10020)*STEP(TIME,0,0,1.5,1)",
    ),
    "rows of a matrix that does not fit stay": (
        "MATRIX/1, FULL=RORDER, ROWS=2, COLUMNS=4, VALUES=1.0000000,2.0000000,3.0000000,4.0000000\n"
        ",5.0000000,6.0000000,7.0000000,8.0000000",
        "MATRIX/1, FULL=RORDER, ROWS=2, COLUMNS=4\n"
        ", VALUES=1.0000000,2.0000000,3.0000000,4.0000000\n"
        ", 5.0000000,6.0000000,7.0000000,8.0000000",
    ),
    "comments behind statements are aligned": (
        "PART/1, GROUND ! here\nMARKER/10, PART=1      ! there\n\n\n   ! alone   \nMARKER/2 !x",
        "PART/1, GROUND     ! here\nMARKER/10, PART=1  ! there\n\n! alone\nMARKER/2  !x",
    ),
    "a comment inside a statement keeps its lines": (
        "PART/2, MASS=1 ! kg\n! of the mass centre\n,CM = 2, IP=1,1,1",
        "PART/2, MASS=1  ! kg\n! of the mass centre\n, CM=2, IP=1,1,1",
    ),
    "a comment that ignores keeps the lines it works on": (
        "PART/2\n, MASS=1\n, CM=2  ! adamslite: ignore no-inertia",
        "PART/2\n, MASS=1\n, CM=2  ! adamslite: ignore no-inertia",
    ),
    "statements of a line with such a comment stay together": (
        "PART/2, MASS=1;PART/3, MASS = 1  ! adamslite: ignore no-inertia",
        "PART/2, MASS=1; PART/3, MASS=1  ! adamslite: ignore no-inertia",
    ),
    "functions closed by a slash get the backslash": (
        "REQUEST/1, F2=DX(2)/\n, F3=DY(2)/",
        "REQUEST/1, F2=DX(2)\\ F3=DY(2)",
    ),
    "degrees before a minus sign stay degrees": (
        "VAR/1, F=2*(90D -3)",
        "VARIABLE/1, FUNCTION=2*(90D -3)",
    ),
    "a text stays letter by letter": (
        "REQUEST/1, COMMENT=  two  blanks , F2=TIME",
        "REQUEST/1, COMMENT=two  blanks, F2=TIME",
    ),
    "semicolons become lines": ("PART/1, GROUND; MARKER/1", "PART/1, GROUND\nMARKER/1"),
    "a statement with a mistake stays": ("PART/2,  WEIGHT=1,  CM=2", "PART/2,  WEIGHT=1,  CM=2"),
}  # fmt: skip


def said(text: str) -> tuple[object, ...]:
    """What reading a deck gives, without places."""
    try:
        deck = read(text)
        found = judged(deck.source, deck.warnings, complete=True)
    except DeckError as fault:
        deck, found = fault.deck, [*fault.diagnostics]
    statements = [
        (each.keyword, each.id, each.name)
        + tuple((name, repr(getattr(each, name))) for name in each.arguments)
        for each in deck.own
    ]
    # Lines in a message are those of another place; the order is that of the text.
    return deck.title, statements, [(each.code, each.severity) for each in found]


def assert_same_deck(text: str) -> None:
    """The layout is read as the text is, and laying it out again changes nothing."""
    layout = formatted(text)
    assert said(layout) == said(text)
    assert formatted(layout) == layout


@pytest.mark.parametrize("what", LAYOUTS)
def test_layout(what: str) -> None:
    text, layout = (f"a title\n\n{each}\nEND\n" for each in LAYOUTS[what])
    assert formatted(text) == layout
    assert formatted(layout) == layout


@pytest.mark.parametrize("path", every(3, FIRST), ids=[path.stem for path in FIRST])
def test_a_deck_says_the_same_in_its_layout(path: Path) -> None:
    if path.stat().st_size < 40_000:
        assert_same_deck(read_text(path).text)


@pytest.mark.slow
@pytest.mark.parametrize("folder", FOLDERS, ids=[folder.name for folder in FOLDERS])
def test_every_deck_says_the_same_in_its_layout(folder: Path) -> None:
    for path in folder.glob("*.adm"):
        assert_same_deck(read_text(path).text)


WORDS = (
    "a" * 90,
    "a" * 45,
    "1," * 30,
    ",",
    "\n,",
    "\\",
    "(",
    ")",
    " ",
    "! why\n",
    "=",
    "TIME+",
    "7",
)
"""What makes lines that fit nowhere."""


@pytest.mark.parametrize("seed", range(6))
def test_a_layout_of_lines_that_cannot_be_broken_is_its_own_layout(seed: int) -> None:
    random = Random(seed)
    texts = [text for path in FIRST if len(text := read_text(path).text) < 3000]
    for _ in range(40):
        text = random.choice(texts)
        for _ in range(random.randint(1, 4)):
            at = random.randrange(len(text))
            text = text[:at] + random.choice(WORDS) + text[at:]
        place = random.choice(["deck", "deck", "command"])
        layout = formatted(text, place)
        assert formatted(layout, place) == layout


@pytest.mark.slow
@settings(max_examples=150, deadline=None)
@given(decks())
def test_a_random_deck_says_the_same_in_its_layout(text: str) -> None:
    assert_same_deck(text)


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(st.sampled_from(FIRST), st.data())
def test_a_spoiled_deck_says_the_same_in_its_layout(path: Path, data: st.DataObject) -> None:
    lines = read_text(path).text.split("\n")[:40]
    text = "\n".join(lines)
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(len(lines[0]), len(text)))
        sign = data.draw(st.sampled_from([*"\n!,;&=()\\/*'\" ", "\n,", ", ", "END\n"]))
        text = text[:at] + sign + text[at + data.draw(st.integers(0, 2)) :]
    assert_same_deck(text)


IGNORING = """\
decks in which comments ignore something
PART/1, GROUND
PART/2, MASS=1, CM=2; PART/3, MASS=1, CM=3 ! adamslite: ignore no-inertia
MARKER/2, PART=2; MARKER/3, PART=3
PART/4
, MASS=1     ! adamslite: ignore no-inertia
, CM=4; MARKER/4, PART=4
PART/5, MASS=1, CM=5 ! adamslite: ignore no-inertia
MARKER/5, PART=5 ! adamslite: ignore no-inertia
"""


def test_what_is_ignored_stays_ignored() -> None:
    layout = formatted(IGNORING)
    assert said(layout) == said(IGNORING)
    assert said(IGNORING)[2] == [("ignores-nothing", "note")]
    assert formatted(layout) == layout


def test_names_at_the_top_of_a_command_file_stay() -> None:
    text = "  model\n\noutput\nsim/dyn,  end=1 &\n , steps=10\n\n\nstop\n"
    layout = formatted(text, "command")
    assert layout == "  model\n\noutput\nSIMULATE/DYNAMICS, END=1, STEPS=10\n\nSTOP\n"
    assert formatted(layout, "command") == layout


def test_what_any_layout_would_change_stays() -> None:
    """On a line of its own the first word would be the name of a model."""
    text = "f;odel=1\nSIMULATE/DYNAMICS,  END=1\n"
    assert formatted(text, "command") == text


def test_a_long_command_is_continued_by_ampersands() -> None:
    text = "VARIABLE/1, FUNCTION=" + " + ".join(["STEP(TIME,0,0,1,1)"] * 3) + "\n"
    layout = formatted(text, "command")
    assert [line[-2:] for line in layout.splitlines()] == [" &", "1)"]
    assert formatted(layout, "command") == layout


DECK = "a title\r\npart/1, ground\r\n! ä\r\nend\r\n"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "utf-16"])
def test_a_file_keeps_encoding_and_line_ends(tmp_path: Path, capsys, encoding: str) -> None:
    path = tmp_path / "deck.adm"
    path.write_bytes(DECK.encode(encoding))
    path.chmod(0o600)
    assert main(["fmt", "--check", str(path)]) == 1
    assert path.read_bytes() == DECK.encode(encoding)
    assert main(["fmt", str(path)]) == 0
    assert path.read_bytes().decode(encoding) == "a title\r\nPART/1, GROUND\r\n! ä\r\nEND\r\n"
    assert str(path) in capsys.readouterr().out
    assert path.stat().st_mode & 0o777 == 0o600
    assert main(["fmt", "--check", str(path)]) == 0
    assert capsys.readouterr().out == ""

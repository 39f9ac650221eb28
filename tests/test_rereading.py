"""Reading after an edit gives what reading afresh gives."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from adamslite.editing.document import Content, Document
from adamslite.editing.rename import rename
from adamslite.editing.text_file import read_text
from adamslite.errors import UsageError
from adamslite.resources import find

SMALL = sorted(path for path in find("decks").rglob("*.adm") if path.stat().st_size < 3000)
PIECES = [
    *"\n!,;&=()\\/*'\" 1x", "\n,", "END\n", "DX(2,1)", "PART/1, GROUND\n", "MARKER/77, PART=2\n",
    "! adams_view_name='Name'\n", "UNITS/SYSTEM=MKS\n", "VARIABLE/x, FUNCTION=TIME\n", "=2*x",
    "ARRAY/1, NUMBERS=1,2,3\n", "ARYVAL(1,2)", "KGRAV", "J_PART=ground",
]  # fmt: skip


def said(content: Content) -> tuple[object, ...]:
    """Everything that a reading gives, with all places."""
    deck = content.deck
    assert deck
    statements = [
        (each.keyword, each.id, each.name, each.span, dict(each.spans))
        + tuple(repr(getattr(each, name)) for name in each.arguments)
        for each in deck.own
    ]
    return deck.title, statements, content.diagnostics, sorted(content.uses, key=str)


@settings(max_examples=40, deadline=None)
@given(st.sampled_from(SMALL), st.data())
@pytest.mark.slow
def test_reading_again_is_reading_afresh(path: Path, data: st.DataObject) -> None:
    document = Document("x.adm", "deck")
    text = read_text(path).text
    document.update(text)
    for _ in range(data.draw(st.integers(1, 5))):
        at = data.draw(st.integers(0, len(text)))
        text = (
            text[:at]
            + data.draw(st.sampled_from(PIECES))
            + text[at + data.draw(st.sampled_from([0, 0, 1, 2, 30])) :]
        )
        assert said(document.update(text)) == said(Document("x.adm", "deck").update(text))


def test_only_what_an_edit_concerns_is_read_again(monkeypatch) -> None:
    document = Document("x.adm", "deck")
    lines = ["a title", "PART/1, GROUND", "MARKER/1, PART=1", "PART/2, MASS=1, CM=2, IP=1,1,1"]
    lines += ["MARKER/2, PART=2"]
    lines += [f"VARIABLE/{n}, FUNCTION=DX(2,1)*{n}" for n in range(1, 50)]
    document.update("\n".join(lines))
    known = dict(document._memory.statements)
    lines[10] += "+1"
    document.update("\n".join(lines))
    fresh = [key for key, each in document._memory.statements.items() if known.get(key) is not each]
    assert [key[0] for key in fresh] == ["VARIABLE/6, FUNCTION=DX(2,1)*6+1"]
    lines[4] = "MARKER/3, PART=2"
    document.update("\n".join(lines))
    assert not [key for key in document._memory.statements if "DX(2,1)" in str(key[0])]


@pytest.mark.parametrize("path", SMALL[::12], ids=[path.stem for path in SMALL[::12]])
def test_renaming_and_back_is_nothing(path: Path) -> None:
    """A deck in which an id was renamed has the same messages, and the old text once it is renamed
    back.
    """
    document = Document("x.adm", "deck")
    text = read_text(path).text
    content = document.update(text)
    assert content.deck
    for each in content.deck.own:
        if each.singleton or not each.span.line:
            continue
        renamed = renamed_in(content, content.definitions[each.keyword, each.key].start, "New_1")
        changed = Document("x.adm", "deck").update(renamed)
        assert [d.code for d in changed.diagnostics] == [d.code for d in content.diagnostics]
        use = changed.definitions[each.keyword, "NEW_1"]
        written = text[slice(*content.definitions[each.keyword, each.key][2:])]
        assert renamed_in(changed, use.start, written).upper() == text.upper()


def renamed_in(content: Content, offset: int, new: str) -> str:
    """The text once the id at an offset has been renamed."""
    (uses,) = rename([content], content, offset, new)
    text = content.text
    for use in reversed(uses):
        text = text[: use.start] + new + text[use.end :]
    return text


NAMED = """\
names of ADAMS/View
PART/1, GROUND
!                  adams_view_name='wheel'
MARKER/10, PART=1
MARKER/11, PART=1, QP=1,0,0
VARIABLE/v, FUNCTION=DX(wheel,11)+DX(10,11)+DX(WHEEL)
VARIABLE/2, FUNCTION=V
END
"""


def test_a_name_and_an_id_are_renamed_apart() -> None:
    content = Document("x.adm", "deck").update(NAMED)
    by_name = NAMED.replace("'wheel'", "'hub'").replace("DX(wheel", "DX(hub")
    by_name = by_name.replace("DX(WHEEL)", "DX(hub)")
    for place in ("wheel'", "wheel,11", "WHEEL)"):
        assert renamed_in(content, NAMED.index(place), "hub") == by_name
    by_id = NAMED.replace("MARKER/10", "MARKER/99").replace("DX(10,", "DX(99,")
    for place in ("10, PART", "10,11)"):
        assert renamed_in(content, NAMED.index(place), "99") == by_id


def test_a_deck_that_cannot_be_read_wholly_is_not_renamed_in() -> None:
    content = Document("x.adm", "deck").update(NAMED.replace("DX(10,11)", "DX(10,11"))
    with pytest.raises(UsageError, match="first correct the statements of VARIABLE"):
        renamed_in(content, NAMED.index("10, PART"), "99")


@pytest.mark.parametrize(
    ("place", "new", "reason"),
    [
        ("10, PART", "11", "there is a MARKER/11 already"),
        ("v, FUNCTION", "time", "always means something else"),
        ("v, FUNCTION", "2x", "is not an id"),
        ("wheel'", "5", "is not a name"),
        ("QP", "5", "no id or name here"),
    ],
)
def test_a_name_that_will_not_do_is_refused(place: str, new: str, reason: str) -> None:
    content = Document("x.adm", "deck").update(NAMED)
    with pytest.raises(UsageError, match=reason):
        renamed_in(content, NAMED.index(place), new)


def test_mistakes_of_form_move_with_their_statement() -> None:
    """A statement with mistakes is not parsed again, but its messages name its present place."""
    document = Document("x.adm", "deck")
    faulty = "PART/2, MASS=1, =2, QP=(1\nMARKER/5, PART=2,, QP=1,2,3\n"
    document.update(f"a title\n{faulty}")
    text = f"a title\nPART/1, GROUND\nMARKER/1, PART=1\n{faulty}"
    found = document.update(text)
    assert said(found) == said(Document("x.adm", "deck").update(text))
    lines = {each.span.line for each in found.diagnostics if each.span}
    assert {4, 5} <= lines

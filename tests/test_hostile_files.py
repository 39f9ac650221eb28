"""Hostile command files, descriptions and results are read in little work; counts, no seconds."""

from importlib import import_module as module

import pytest

import adamslite as al
from adamslite.cables.description import messages as cable_messages
from adamslite.cables.description import spec
from adamslite.cables.description.toml_places import Places
from adamslite.language import likeness
from adamslite.language.diagnostics import MOST, Source, numbers_of
from benchmarks.hostile_files import FILES
from benchmarks.hostile_texts import BODIES
from benchmarks.reading import FINE, WAYS

CHANGES = "".join(
    f"MARKER/2, QP={n},0,0\nSIMULATE/DYNAMIC, END={n}, STEPS=1\n" for n in range(1, 99)
)


def test_changes_of_a_deck_are_checked_as_long_as_that_is_worth_it(monkeypatch):
    """How often rules are asked does not grow with deck and commands at once."""
    asked = []
    judge = module("adamslite.reading.read").apply
    monkeypatch.setattr(
        "adamslite.reading.read.apply",
        lambda rules, deck: asked.append(len(deck.own)) or judge(rules, deck),
    )
    monkeypatch.setattr("adamslite.reading.read.MOST_JUDGED", 2000)
    for more in (0, 40):
        deck = al.read(BODIES + "".join(f"MARKER/{n + 9}, PART=2\n" for n in range(more)))
        asked.clear()
        found = al.read_commands(f"hostile\n{CHANGES}", deck).warnings
        assert 500 < sum(asked) + 20 * len(asked) < 2500
        (only,) = [each for each in found if each.code == "changes-not-checked"]
        line = CHANGES.splitlines()[only.span.line - 2]
        assert line.startswith("MARKER/2") and only.severity == "warning"


def test_changes_are_made_as_long_as_that_is_worth_it(monkeypatch):
    """Each makes a deck of its own; where no analysis is between them, rules are not even asked."""
    monkeypatch.setattr("adamslite.reading.read.MOST_JUDGED", 200)
    changes = "".join(f"MARKER/2, QP={n},0,0\n" for n in range(99))
    deck = al.read(BODIES)
    (only,) = al.read_commands(f"hostile\n{changes}", deck).warnings
    made = 5 * 200 // (20 + len(deck.own))
    assert only.code == "changes-not-checked" and only.span.line == made + 2 < 99


def test_a_few_changes_are_all_checked():
    deck = al.read(BODIES)
    assert not al.read_commands(f"hostile\n{CHANGES}", deck).warnings


def test_a_description_of_mistakes_keeps_few_messages(monkeypatch):
    """Guesses too are bounded, and a missing key is reported whatever is wrong before."""
    made = []
    monkeypatch.setattr(
        likeness, "did_you_mean", lambda word, listed: made.append(len(listed)) or ""
    )
    text = "".join(f"k{n} = 1\n" for n in range(9000))
    with pytest.raises(al.DeckError) as fault:
        spec.read(text + "[cable]\nEA = 1\n")
    found = fault.value.diagnostics
    assert sum(made) < likeness.BUDGET + 100
    assert len(found) <= MOST + 1 and found[-1].numbers[0] > 9000 - MOST
    faults = cable_messages.Faults(Places(Source("\n")))
    for _ in range(5000):
        faults.add("unknown-key", ("a",), word="a", known="b")
    faults.add("missing-key", ("a",), label="a", word="b")
    assert len(faults.found) == cable_messages.MOST + 2
    assert "missing-key" in [each.code for each in faults.found]
    assert numbers_of(faults.found)[0] == 5001


@pytest.mark.parametrize("kind", FILES)
def test_hostile_files_are_refused_or_read(kind, tmp_path):
    path = tmp_path / f"file{FILES[kind].suffix}"
    path.write_bytes(FILES[kind].data(3000))
    if FILES[kind].suffix == ".parquet":
        pytest.importorskip("pyarrow")
    assert WAYS[FILES[kind].way](path) in FINE

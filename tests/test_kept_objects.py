"""Objects that are kept between runs: they come back as they were, or are rebuilt."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import pytest
from tiers import every

from adamslite import kept_scene, resources, scene
from adamslite.caching import contents, entries, objects
from adamslite.language.diagnostics import DeckError, render
from adamslite.language.statement import Statement

DECKS = resources.find("decks")


def test_an_object_refers_to_what_is_known(cache) -> None:
    known = [Path("a"), Path("b")]
    objects.keep("scene" + "0" * 32 + ".kept", {"x": known[0], "y": [known[1]]}, known)
    found = objects.find("scene" + "0" * 32 + ".kept", known)
    assert found["x"] is known[0] and found["y"][0] is known[1]
    assert [entry.path.name for entry in contents.entries(cache)] == ["scene" + "0" * 32 + ".kept"]


@pytest.mark.parametrize("thing", [lambda: 1, sys, Path.open])
def test_what_cannot_be_kept_is_not(thing, cache) -> None:
    objects.keep("scene" + "0" * 32 + ".kept", [thing] if thing is not sys else thing)
    assert bool(os.listdir(cache)) == (thing is Path.open)


def test_a_large_object_is_not_kept(cache, monkeypatch) -> None:
    monkeypatch.setattr(objects, "MOST", 1000)
    objects.keep("scene" + "0" * 32 + ".kept", bytes(1000))
    assert not os.listdir(cache)


def test_an_object_that_its_class_no_longer_takes_is_rebuilt(cache, caplog) -> None:
    entries.keep("scene" + "0" * 32 + ".kept", b"\x80\x05cadamslite.errors\nGone\n.")
    assert objects.find("scene" + "0" * 32 + ".kept") is None
    (line,) = caplog.messages
    assert "is rebuilt" in line


@pytest.mark.parametrize("path", every(12, sorted(DECKS.rglob("*.adm"))), ids=lambda p: p.stem)
def test_a_copy_of_a_scene_is_the_scene(path: Path, cache, monkeypatch) -> None:
    """Statements, messages with their places and carets, names of columns."""
    try:
        first = scene.load_scene(path)
    except DeckError:
        return
    if any(kept_scene.tables_of(first.deck, first.commands)) or first.deck.user.called:
        return
    monkeypatch.setattr(scene, "read_together", pytest.fail)
    second = scene.load_scene(path)
    assert second.deck.statements is not first.deck.statements
    assert render(second.warnings) == render(first.warnings)
    assert second.deck.source.text == first.deck.source.text
    assert (second.title, second.stem) == (first.title, first.stem)
    for one, other in zip(
        (*first.deck.statements, *first.commands),
        (*second.deck.statements, *second.commands),
        strict=True,
    ):
        assert type(one) is type(other) and one.label == other.label and one.span == other.span
        assert values(one) == values(other)


def values(statement: Any) -> str:
    names = sorted(statement.field_names - {"spans"} if isinstance(statement, Statement) else ())
    return repr([(name, getattr(statement, name)) for name in names])

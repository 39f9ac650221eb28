"""Published cases: ours is the number of the source, or the exact one where there is one."""

from __future__ import annotations

import runpy
import shutil
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tiers import every, slow
from written import assert_same_reference, assert_same_text

import adamslite as al
from adamslite.reading.read import read_commands
from adamslite.resources import find

ROOT = find("decks").parent
PAGE = runpy.run_path(str(ROOT / "docs" / "validation.py"))
CASES: dict[str, Any] = {str(c.folder.relative_to(ROOT / "decks")): c for c in PAGE["cases"]()}
#: Large models, or several of them.
LONG = {"fast", "a02-n40", "published/sagging-cable", "published/loaded-rod"}


@pytest.mark.parametrize("name", [slow(n) if n in LONG else n for n in sorted(CASES)])
@pytest.mark.filterwarnings("ignore::adamslite.DeckWarning")
def test_a_published_number_is_met(name: str) -> None:
    case = CASES[name]
    runs = {deck: PAGE["run"](case, deck)[0] for deck in {q.deck for q in case.quantities}}
    for quantity in case.quantities:
        value = PAGE["ours"](quantity, runs[quantity.deck])
        assert value == pytest.approx(quantity.expected, rel=case.within), quantity.name


@pytest.mark.parametrize(("kind", "limit"), (("weave", 4.29238), ("capsize", 6.02426)))
def test_a_bicycle_balances_itself_between_two_speeds(kind: str, limit: float) -> None:
    """From 4.292 m/s on the weave dies out, from 6.024 m/s on the capsize grows.

    Closer to the limit the capsize is lost among the zeros of place and heading: rounding moves it
    by about 1e-10 over itself.
    """
    bicycle = runpy.run_path(str(ROOT / "decks" / "published" / "bicycle" / "make_reference.py"))
    for speed, sign in ((limit - 1e-2, 1), (limit + 1e-2, -1)):
        deck = al.read(bicycle["deck"](speed))
        commands = read_commands("SIMULATE/INITIAL\nLINEAR/EIGENSOL\nSTOP\n", deck)
        found = al.simulate(deck, commands=commands).linearizations[0].model.eigenvalues
        (way,) = (s for s in bicycle["eigenvalues"](speed) if abs(s.real) < 0.1 and s.imag >= 0)
        assert way.real * (sign if kind == "weave" else -sign) > 0
        ours = found[np.abs(found - way).argmin()]
        assert ours == pytest.approx(way, abs=1e-3 * abs(way.real))


def test_the_page_names_every_quantity_in_order() -> None:
    page = (ROOT / "docs" / "validation.md").read_text(encoding="utf-8")
    rows = [line.split(" | ")[1].strip() for line in page.splitlines() if line.startswith("| ")][1:]
    assert rows == [q.name for case in CASES.values() for q in case.quantities]


@pytest.mark.parametrize("name", every(3, sorted(n for n in CASES if n.startswith("published/"))))
def test_a_published_deck_is_what_its_generator_writes(name: str, tmp_path: Path) -> None:
    """In a copy of its folder: a generator writes beside itself."""
    kept = ROOT / "decks" / name
    copy = tmp_path / kept.name
    shutil.copytree(kept, copy)
    for module in ("catenary.py", "elastica.py"):
        shutil.copy(kept.parent / module, tmp_path)
    before = list(sys.path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        runpy.run_path(str(copy / "make_reference.py"), run_name="__main__")
    sys.path[:] = before
    for module in ("catenary", "elastica"):
        sys.modules.pop(module, None)
    for reference in kept.glob("*.csv"):
        written = (copy / reference.name).read_text(encoding="utf-8")
        assert_same_reference(written, reference.read_text(encoding="utf-8"))
    for deck in kept.glob("*.adm"):
        texts = [path.read_text(encoding="utf-8") for path in (copy / deck.name, deck)]
        if "! Written by adamslite cable." in texts[1]:
            texts = [without_reasons(text) for text in texts]
        assert_same_text(*texts)


def without_reasons(text: str) -> str:
    """The statements of a deck: the reasons of the cable command change with its advice."""
    return "\n".join(line for line in text.splitlines() if not line.startswith("!"))

"""Every word of command files works, is passed over with a note, or is rejected with a reason.

What works changes the outcome of a small run, what is passed over does not; the tables are
tests/spec/commands.toml and tests/spec/changes.toml.
"""

from __future__ import annotations

import tomllib
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tiers import every

import adamslite
from adamslite.deck.element_switch import SWITCHABLE
from adamslite.language.diagnostics import DeckError, Diagnostic
from adamslite.language.messages import START
from adamslite.language.not_supported import STATEMENTS as NOT_SUPPORTED
from adamslite.language.statement import STATEMENTS
from adamslite.manual import lookup
from adamslite.reading.read import read, read_commands

SPEC = Path(__file__).parent / "spec"
COMMANDS = tomllib.loads((SPEC / "commands.toml").read_text())
CHANGES = tomllib.loads((SPEC / "changes.toml").read_text())
PENDULUM = """a pendulum
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=0.1,0.1,0.1, QG=1,0,0
MARKER/2, PART=2
MARKER/3, PART=2, QP=-1,0,0
JOINT/1, REVOLUTE, I=3, J=1
"""
FREE = """PART/4, MASS=1, CM=4, IP=0.1,0.1,0.1, QG=2,0,0
MARKER/4, PART=4
MARKER/5, PART=1, QP=2,0,0
"""
REFUSALS = {"planned-statement", "planned-argument", "planned-choice"}
BEFORE, AFTER = "SIM/DYN, END=0.02, STEPS=1", "SIM/DYN, END=0.05, STEPS=1"
KNOWN = "deck", "without"
ROWS = [
    (keyword, word, section.get("deck", ""), status, text, *(other or [section.get("without", "")]))
    for keyword, section in COMMANDS.items()
    for word, (status, text, *other) in (
        (word, row) for word, row in section.items() if word not in KNOWN
    )
]
ELEMENTS = CHANGES["element"]
SWITCHED = [(switch, kind) for kind in ELEMENTS for switch in ("DEACTIVATE", "ACTIVATE")]
CHANGED = [(word, "works", *row)[-3:] for word, row in {**ELEMENTS, **CHANGES["data"]}.items()]
WORDS = list({**ELEMENTS, **CHANGES["data"]})


def told(deck: str, commands: str) -> list[Diagnostic]:
    found = read(PENDULUM + deck + "\n", user={"GSESUB": 0.0} if "GSE" in deck else None)
    found.path = Path("deck.adm")
    try:
        return list(read_commands(commands + "\n", found).warnings)
    except DeckError as error:
        return list(error.diagnostics)


@cache
def outcome(deck: str, commands: str) -> tuple[Any, ...]:
    """All that a run leaves behind but CPU."""
    scene = read(PENDULUM + deck + "\n")
    results = adamslite.simulate(scene, commands=read_commands(commands + "\n", scene))
    summary = {key: value for key, value in results.summary.items() if "cpu" not in key}
    linear = [
        (
            *each[:3],
            each.form == "MATLAB",
            each.shapes,
            each.energies,
            *(vars(each.model)[key].tolist() for key in MATRICES),
        )
        for each in results.linearizations
    ]
    values = results.time.tolist(), results.names, results.values.tolist()
    return (
        *values,
        repr(summary),
        repr(linear),
        repr([results.meta.get(key) for key in ("integrator", "info")]),
    )


MATRICES = "eigenvalues", "modes", "state_matrix", "input_matrix", "output_matrix"


def passed_over(found: list[Diagnostic]) -> list[str]:
    """Words that the collected note names."""
    notes = [each.message for each in found if each.code == "passed-over"]
    return [word for note in notes for word in note.partition(": ")[2].split(", ")]


@pytest.mark.parametrize("row", ROWS, ids=[f"{keyword} {word}" for keyword, word, *_ in ROWS])
def test_every_word_of_a_command_has_its_effect_or_says_so(row: tuple[str, ...]) -> None:
    keyword, word, deck, status, commands, without = row
    found = told(deck, commands)
    if status == "refused":
        errors = [each for each in found if each.is_error]
        assert errors and {each.code for each in errors} <= {*REFUSALS, "states-chosen"}
        assert all(each.hint for each in errors)
        return
    assert not any(each.is_error for each in found)
    named = passed_over(found)
    own = keyword if STATEMENTS[keyword].inert else f"{keyword} {word.rpartition(', ')[2]}"
    assert (own in named) == (status == "inert")
    same = outcome(deck, commands) == outcome(deck, without)
    assert same == (status != "works")
    assert bool(found) or status in ("works", "file")


@pytest.mark.parametrize(("word", "row"), every(4, zip(WORDS, CHANGED, strict=True)), ids=WORDS)
def test_every_statement_changes_by_a_command_or_says_so(word: str, row: tuple[str, ...]) -> None:
    status, deck, change = row
    found = told(FREE + deck, change)
    assert any(each.is_error for each in found) == (status == "refused")
    assert (word in passed_over(found)) == (status == "inert")
    if status != "refused":
        changed = outcome(FREE + deck, f"{BEFORE}\n{change}\n{AFTER}")
        same = changed == outcome(FREE + deck, f"{BEFORE}\n{AFTER}")
        assert same == (status in ("inert", "drawn"))


@pytest.mark.parametrize(("switch", "kind"), every(4, SWITCHED))
@pytest.mark.parametrize("chosen", ["ID=1", "RANGE=1,9"])
def test_every_element_is_switched_off_and_on(switch: str, kind: str, chosen: str) -> None:
    deck = FREE + ELEMENTS[kind][0]
    first = f"{BEFORE}\nDEACTIVATE/{kind}, {chosen}"
    off = outcome(deck, f"{first}\n{AFTER}")
    if switch == "DEACTIVATE":
        assert off != outcome(deck, f"{BEFORE}\n{AFTER}")
    else:
        assert off != outcome(deck, f"{first}\nACTIVATE/{kind}, {chosen}\n{AFTER}")


def test_the_tables_have_every_command_and_every_argument() -> None:
    for keyword, cls in STATEMENTS.items():
        if cls.place == "deck":
            assert keyword in {word.partition(" ")[0] for word in WORDS}, keyword
            continue
        assert keyword in COMMANDS or keyword in ("ACTIVATE", "DEACTIVATE"), keyword
        rows = [word for word in COMMANDS.get(keyword, ()) if word not in KNOWN]
        words = {part for word in rows for part in word.split(", ")}
        for argument in () if keyword in OTHERS else cls.arguments.values():
            assert words & {*argument.keys, *argument.options}, f"{keyword} {argument.key}"


# Their arguments have tests of their own: tests/test_integrator_arguments.py, and above.
OTHERS = ("INTEGRATOR", "ACTIVATE", "DEACTIVATE")


def test_the_tables_have_every_element_that_is_switched() -> None:
    assert {*SWITCHABLE} - {*ELEMENTS} <= NOT_SUPPORTED


@pytest.mark.parametrize("keyword", COMMANDS)
def test_help_has_a_page_for_every_command(keyword: str) -> None:
    assert keyword in lookup.pages(keyword.lower())


STATEMENT_ROWS = tomllib.loads((SPEC / "statements.toml").read_text())
RUN = "SIM/DYN, END=0.01, STEPS=1"
ADDED = [
    (keyword, word, entry["deck"], row[1])
    for keyword, entry in STATEMENT_ROWS.items()
    for word, row in entry.items()
    if word not in ("deck", "is") and row[0] == "works" and row[1:] and row[1].startswith(",")
    if entry["deck"].rpartition("\n")[2].startswith(f"{keyword}/") and "FILE" not in word
]


@pytest.mark.parametrize(
    ("deck", "added"),
    every(5, (each[2:] for each in ADDED)),
    ids=[f"{keyword} {word}" for keyword, word, *_ in ADDED],
)
def test_a_statement_that_a_command_changes_is_as_if_it_had_been_written_so(
    deck: str, added: str
) -> None:
    """Arguments that are added by a command before the run, and in the deck."""
    label = deck.rpartition("\n")[2].partition(",")[0]
    changed, written = ran(deck, f"{label}{added}\n{RUN}"), ran(deck + added, RUN)
    assert changed[:2] == written[:2]
    assert np.allclose(changed[2], written[2], rtol=1e-9, atol=1e-12, equal_nan=True)


def ran(deck: str, commands: str) -> tuple[Any, ...]:
    """Outcome, columns and values of a run; of one that cannot be read its mistakes."""
    try:
        scene = read(START + deck + "\n")
        results = adamslite.simulate(scene, commands=read_commands(commands + "\n", scene))
    except DeckError as error:
        return "", sorted({each.code for each in error.errors}), np.zeros(0)
    return results.outcome, results.names, results.values

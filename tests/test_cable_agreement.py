"""`check` says of a deck that `adamslite cable` wrote what `cable` says of its description."""

import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace

import pytest
from descriptions import hoist, hung

import adamslite
from adamslite.cables.deck.scene import chosen, deck, drawn, setting, written
from adamslite.cables.description.head_comments import BEGIN, END, MODEL, carried
from adamslite.cables.recognition.report import about_cables, advice_on, by_description
from adamslite.editing.layout import formatted
from benchmarks.rope_scenes import scene, toml

HOIST = 'title = "a hoist"\n' + hoist(
    end=4,
    cable="EA = 1e7\nrho = 8     # kg/m\ndamping_time = 2e-5",
    radius=0.25,
    inertia=5,
    law="STEP5(TIME,1,0, 1.2,2.5)",
    mass=900,
)
LOOP = """end = 1
closed = true
[cable]
EA = 2e5
rho = 0.2
pretension = 600
[[route]]
kind = "pulley"
at = [0, 0, 0]
radius = 0.1
inertia = 0.01
[[route]]
kind = "pulley"
at = [1, 0, 0]
radius = 0.1
inertia = 0.01
"""
PENDULUM = hung(end=3, cable="EA = 1e6\nrho = 0.1", at=(3, -4), mass=100)


def advice(text: str, p: float = 0.01) -> tuple[object, ...] | None:
    """Level, form, sections and integrator by the description of a deck; None without it."""
    found = adamslite.read(text)
    if by_description(found) is None:
        return None
    said = advice_on(found, p)
    assert said is not None
    return said.level, said.form, said.elements, said.integrator


def lines_of(text: str) -> str:
    """What is said about the cables of a deck, on one line."""
    return " ".join(" ".join(about_cables(adamslite.read(text))).split())


def own_choice(text: str) -> tuple[object, ...]:
    """The same as the deck of a description has them."""
    found = carried(deck(text)[0])
    assert found is not None
    of, elastic = found.model, found.model.level > 1
    form = of.form if of.level == 3 else ""
    return of.level, form, of.elements * elastic, of.method.split(",")[0]


@pytest.mark.parametrize("text", [HOIST, LOOP, PENDULUM], ids=["hoist", "loop", "pendulum"])
def test_the_advice_is_the_choice_of_the_description(text: str) -> None:
    """Level, form, sections, integrator and why, whatever the deck was asked for."""
    head = deck(text)[0]
    assert advice(head) == own_choice(text)
    assert advice(head, 0.02) == own_choice(text + "[model]\naccuracy = 0.02\n")
    of = setting(text)
    assert "; ".join(chosen(of, of.faults).reasons.sentences) in lines_of(head)


@pytest.mark.parametrize("model", ["elements = 7", "level = 3\nform = 'ale'", "accuracy = 0.1"])
def test_another_model_in_the_description_changes_no_advice(model: str) -> None:
    """A hoist with seven sections, by the ale form, or for 10 %, gets the advice of the hoist."""
    text = deck(f"{HOIST}[model]\n{model}\n")[0]
    assert advice(text) == own_choice(HOIST)


def test_what_runs_have_shown_is_repeated() -> None:
    """The model that they led to and why, in the run of the description; not in a longer one."""
    asked = setting(HOIST + "[model]\nlevel = 2\nelements = 3\n")
    why = replace(chosen(asked, asked.faults).reasons, elements=('3 by "trial"', "0.4 % off"))
    text = written(replace(asked, text=HOIST), why).text
    assert advice(text) == (2, "", 3, "HHT")
    assert '; 3 by "trial"; 0.4 % off;' in lines_of(text)
    assert advice(text.replace("END=4", "END=5")) == own_choice(HOIST.replace("= 4", "= 5"))


def test_a_cable_that_runs_have_shown_to_go_slack() -> None:
    """Sections that pull only, which the description does not ask for."""
    of = setting(HOIST).only_pulling()
    text = written(of, chosen(of, of.faults).reasons).text
    assert "MAX(0," in text and "pulls_only" not in HOIST
    assert advice(text) is not None


def test_the_accuracy_of_the_description_is_reported_too() -> None:
    """3 % is asked for: lines for 3 %, 1 % and 0.1 %."""
    lines = about_cables(adamslite.read(deck(HOIST + "[model]\naccuracy = 0.03\n")[0]))
    labels = [line.split("%")[0].split()[-1] for line in lines if line.startswith("    for ")]
    assert labels == ["3", "1", "0.1"]


EDITED: dict[str, tuple[str, str, str, str]] = {
    "time": ("(TIME,1,0, 1.2", "(TIME,1,0, 1.5", "1,0, 1.2,", "1,0, 1.5,"),
    "law": ("1.2,2.5)", "1.2,11)", "1.2,2.5)", "1.2,11)"),
    "damping": ("tau, FUNCTION=2e-05", "tau, FUNCTION=3e-05", "time = 2e-5", "time = 3e-5"),
    "end": ("END=4", "END=40", "end = 4", "end = 40"),
}


@pytest.mark.parametrize("what", EDITED)
def test_an_edited_number_is_one_of_the_description(what: str) -> None:
    """The advice is that for the description with this number."""
    statement, new, key, value = EDITED[what]
    written, edited = deck(HOIST)[0], HOIST.replace(key, value)
    head, below = written.split(END)
    assert below.count(statement) == 1 and edited != HOIST
    assert advice(head + END + below.replace(statement, new)) == own_choice(edited)


def test_an_edited_weight_or_rope_starts_out_of_balance() -> None:
    """The rope is as long as before: half the EA has half the tension, and the weight falls; half
    the weight leaves the tension, and the weight jumps."""
    written = deck(HOIST)[0]
    pull = 900 * 9.81  # at the weight
    for statement, new, tension, mass in (
        ("FUNCTION=10000000", "FUNCTION=5.0E+06", pull / 2, 900),
        ("MASS=919.98079237", "MASS=469.98079237", pull, 450),
    ):
        found = by_description(adamslite.read(written.replace(statement, new)))
        assert found is not None
        (choice, *_) = found.choices([], 4.0, 200)
        still = own_choice(HOIST)[2]
        (at_start, *_) = choice.demand.machines
        assert at_start.rests.min() == pytest.approx(tension)
        assert found.drawn.spec.route[1].mass == pytest.approx(mass)
        assert choice.model.elements > still


def test_settings_and_layout_are_no_contradiction() -> None:
    """Another integrator, more results, other comments, upper case and the canonical layout."""
    written, given = deck(HOIST)[0], drawn(HOIST).given
    for text in (
        written.replace("INTEGRATOR/", "INTEGRATOR/HHT ! not "),
        written.replace("\nEND", "\nREQUEST/77, F2=TIME\nEND"),
        written.replace("! ---- span", "! from the"),
        formatted(written),
        written.replace("\n", "\r\n"),
        written.replace("VFORCE", "vforce"),
    ):
        assert text != written
        found = by_description(adamslite.read(text))
        assert found is not None and found.drawn.given == given


CONTRADICTED: dict[str, Callable[[str], str]] = {
    "a statement more": lambda t: t.replace(
        "INTEGRATOR", "SFORCE/9, I=20, J=1001, FUNCTION=-1\nINTEGRATOR"
    ),
    "one above the description": lambda t: t.replace(BEGIN, f"VARIABLE/77, FUNCTION=1\n{BEGIN}"),
    "a mass of a node": lambda t: t.replace("001, MASS=39.9", "001, MASS=38.9"),
    "a description of something else": lambda t: t.replace('kind = "mass"', 'kind = "body"'),
    "no TOML": lambda t: t.replace("! end = 4", "! end = = 4"),
    "mistakes": lambda t: t.replace("! rho = 8", "! rho = -8"),
    "overflow": lambda t: t.replace("! EA = 1e7", "! EA = 1e49").replace("=10000000", "=1E49"),
    "another model": lambda t: t.replace("! level = 3", "! level = 1"),
    "no model": lambda t: t.replace("! level = 3", "! level = '3'"),
    "a method that is none": lambda t: t.replace('"HHT"', '"HHT\\nPART/9"'),
    "a thousand sections": lambda t: t.replace("! elements = ", "! elements = 1000000000000"),
    "no sections": lambda t: t.replace("! elements = ", "! elements = -"),
    "cut off": lambda t: t.replace(MODEL + "\n", ""),
    "out of the comment": lambda t: t.replace("! end = 4", "VARIABLE/77, FUNCTION=1"),
    "two of them": lambda t: t.replace(BEGIN, f"{BEGIN}\n{BEGIN}"),
    "other units": lambda t: t.replace("UNITS/SYSTEM=MKS\n\n", "UNITS/SYSTEM=CGS\n\n"),
}


@pytest.mark.parametrize("what", CONTRADICTED)
def test_a_description_that_the_statements_contradict_is_left_aside(what: str) -> None:
    """The cable is found in the statements then, as without a description."""
    written = deck(HOIST)[0]
    text = CONTRADICTED[what](written)
    assert text != written
    assert by_description(adamslite.read(text)) is None


def bare(text: str) -> str:
    """A deck without its description."""
    return text.replace(BEGIN, "! a description")


def test_texts_of_a_description_stay_in_its_comments() -> None:
    """Ends of lines that TOML allows and a deck does not know, signs of decks and of LaTeX."""
    odd = 'title = "5 $ & \\\\ ; ! PART/9 \\" \u2028 \u0085 \t $$x^{2}$$"  # ! PART/9 ; \\'
    text = HOIST.replace('title = "a hoist"', odd)
    written = adamslite.read(deck(text)[0])
    plain = adamslite.read(deck(HOIST)[0])
    assert [each.label for each in written.statements] == [e.label for e in plain.statements]
    assert by_description(written) is not None


def test_commands_that_change_the_deck_leave_the_description_aside() -> None:
    """A SIMULATE of a command file sets the time; a mass that it changes is not as described."""
    written = adamslite.read(deck(HOIST)[0])
    runs = adamslite.read_commands("m\n\nSIMULATE/DYNAMIC, END=7, STEPS=9\nSTOP\n", written)
    assert any("lasts 7 s" in line for line in about_cables(written, runs))
    assert by_description(written, runs)
    for line in ("POINT_MASS/20, MASS=7", "SIMULATE/STATICS", "DEACTIVATE/SFORCE, ID=1001"):
        changed = adamslite.read_commands(f"m\n\n{line}\nSIM/DYN, END=7, STEPS=9\nSTOP\n", written)
        assert by_description(written, changed) is None


def test_decks_without_a_description_are_spared_the_modules_that_read_one() -> None:
    """No TOML, and no writer of decks, to check the deck of somebody else."""
    code = (
        "import sys, adamslite\nfrom adamslite.cables.recognition.report import about_cables\n"
        "about_cables(adamslite.read(sys.stdin.read()))\n"
        "print([m for m in sys.modules if m in ('tomllib', 'adamslite.cables.deck.deck_writer')])"
    )
    text = bare(deck(HOIST)[0])
    run = subprocess.run([sys.executable, "-c", code], input=text, capture_output=True, text=True)
    assert run.stdout == "[]\n", run.stderr


@pytest.mark.parametrize("number", range(8))
def test_random_descriptions(number: int) -> None:
    """Of any kind of scene, for 3 %."""
    _, table = scene(7, number)
    text = toml(table | {"model": {"accuracy": 0.03}})
    assert advice(deck(text)[0], 0.03) == own_choice(text)

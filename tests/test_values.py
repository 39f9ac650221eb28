"""Numbers of a deck by name, and decks and kernels with others in their place."""

from __future__ import annotations

import pickle
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tiers import every, slow

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.kernels import collecting
from adamslite.language.diagnostics import DeckError
from adamslite.reading import statement_reader
from adamslite.variation.kernels import _same

DECKS_OF = Path(__file__).parents[1] / "decks"
DECK = """a mass on a spring
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
VARIABLE/L_0, FUNCTION=1.5
VARIABLE/k, FUNCTION=-2*30D+L_0**2
PART/2, MASS=2, CM=2, IP=1,2,3, QG=0,-1,+0, REULER=30D,0,0
MARKER/2, PART=2
SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-200*(DM(2,1)-L_0)-STEP(TIME,0,0,-1+2,-3)+0*VX(2)
SIMULATE/DYNAMIC, END=1, STEPS=10
SIMULATE/DYNAMIC, END=2
END
"""


def compiled(text: str | Path) -> Any:
    return al.compile_model(al.assemble(al.read(text)))


# ---- names -----------------------------------------------------------------------------------


def test_every_number_has_a_name_and_a_value_as_written() -> None:
    found = {each.name: each.value for each in al.names(DECK)}
    assert found == {
        "ACCGRAV.JGRAV": -9.81,
        "VARIABLE/L_0.FUNCTION": 1.5,
        "VARIABLE/k.FUNCTION[0]": 2.0,
        "VARIABLE/k.FUNCTION[1]": 30.0,
        "VARIABLE/k.FUNCTION[2]": 2.0,
        "PART/2.MASS": 2.0,
        **{f"PART/2.IP[{n}]": n + 1.0 for n in range(3)},
        **{f"PART/2.QG[{n}]": value for n, value in enumerate((0.0, -1.0, 0.0))},
        **{f"PART/2.REULER[{n}]": value for n, value in enumerate((30.0, 0.0, 0.0))},
        **{f"SFORCE/1.FUNCTION[{n}]": v for n, v in enumerate((200, 0, 0, 1, 2, -3, 0))},
        "SIMULATE/1.END": 1.0,
        "SIMULATE/1.STEPS": 10.0,
        "SIMULATE/2.END": 2.0,
    }


def test_the_list_shows_units_places_and_parameters(capsys, tmp_path) -> None:
    path = tmp_path / "deck.adm"
    path.write_text(DECK)
    assert main(["names", str(path), "PART/2.I*", "l_0"]) == 0
    out = capsys.readouterr().out
    assert [line.split() for line in out.splitlines()] == [
        ["name", "value", "unit", "place"],
        ["L_0", "1.5", "the", "user's", f"{path}:6:24"],
        ["PART/2.IP[0]", "1", "mass", "length^2", f"{path}:8:26"],
        ["PART/2.IP[1]", "2", "mass", "length^2", f"{path}:8:28"],
        ["PART/2.IP[2]", "3", "mass", "length^2", f"{path}:8:30"],
    ]


@pytest.mark.parametrize(
    ("value", "written"),
    [
        ({"L_0": 1.25}, "VARIABLE/L_0, FUNCTION=1.25"),
        ({"variable/l_0": -1}, "VARIABLE/L_0, FUNCTION=-1"),
        ({"VARIABLE/k.FUNCTION[0]": -3}, "VARIABLE/k, FUNCTION=-(-3)*30D+L_0**2"),
        ({"VARIABLE/k.FUNCTION[1]": 45}, "VARIABLE/k, FUNCTION=-2*45D+L_0**2"),
        ({"PART/2.QG[1]": 2}, "QG=0,2,+0"),
        ({"PART/2.QG[2]": -0.0}, "QG=0,-1,0"),
        ({"PART/2.REULER[0]": -1e-5}, "REULER=-1e-05D,0,0"),
        ({"SFORCE/1.FUNCTION[5]": 4.5}, "STEP(TIME,0,0,-1+2,4.5)"),
        ({"SFORCE/1.FUNCTION[3]": 0.5, "PART/2.MASS": 3}, "STEP(TIME,0,0,-0.5+2,-3)"),
        ({"SIMUL/2.END": 3}, "SIMULATE/DYNAMIC, END=3"),
    ],
)
def test_a_value_is_put_into_the_text(value: dict[str, float], written: str) -> None:
    assert written in al.read(DECK, values=value).source.text
    assert al.read(DECK).with_values(value).source.text == al.read(DECK, values=value).source.text


def test_a_routine_that_is_bound_to_a_number_is_no_parameter() -> None:
    text = DECK.replace("FUNCTION=1.5", "FUNCTION=USER(7)")
    assert [each.name for each in al.names(text, "VARIABLE/L_0", {"VARIABLE/L_0": 1.5})] == [
        "VARIABLE/L_0.FUNCTION"
    ]
    with pytest.raises(UsageError, match="there is VARIABLE/L_0.FUNCTION"):
        al.read(text, {"VARIABLE/L_0": 1.5}, values={"L_0": 2})


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("PART/2.MAS=1", r"no number PART/2.MAS; PART/2 has MASS, IP\[0\]"),
        ("PRT/2.MASS=1", "no number PRT/2.MASS; did you mean PART/2.MASS"),
        ("k=1", r"it is one of VARIABLE/K.FUNCTION\[0\] to VARIABLE/K.FUNCTION\[2\]"),
        ("PART/2.IP=1", r"it is one of PART/2.IP\[0\] to PART/2.IP\[2\]"),
        ("zzz=1", "names"),
        ("PART/2.MASS=heavy", "it must be a number"),
        ("PART/2.MASS=inf", "it must be a finite number"),
        ("PART/2.MASS", "write NAME=VALUE"),
    ],
)
def test_what_cannot_be_set_is_told(given: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        al.read(DECK, values=[given])


def test_a_value_that_is_wrong_is_told_where_it_would_stand(capsys, tmp_path) -> None:
    path = tmp_path / "deck.adm"
    path.write_text(DECK)
    assert main(["check", str(path), "--set", "PART/2.MASS=-1"]) == 3
    out = capsys.readouterr().out
    assert "deck.adm:8:9: error: PART/2 has a negative mass" in out
    assert "PART/2, MASS=-1, CM=2" in out
    for subject in (al.read(path), compiled(path)):
        subject.with_values({"PART/2.MASS": 3})
        with pytest.raises(
            DeckError, match=r"8:9: error: PART/2 has a negative mass.*\n.*MASS=-1, CM=2"
        ):
            subject.with_values({"PART/2.MASS": -1})


def test_solve_takes_values(tmp_path, capsys) -> None:
    path = tmp_path / "deck.adm"
    path.write_text(DECK)
    out = tmp_path / "out.csv"
    assert main(["solve", str(path), "-o", str(out), "--quiet"]) == 0  # which keeps the scene
    assert main(["solve", str(path), "--set", "L_0=1.2", "-o", str(out), "--quiet"]) == 0
    edited = al.simulate(al.read(DECK.replace("FUNCTION=1.5", "FUNCTION=1.2")))
    assert np.abs(al.Results.load(out).values - edited.values).max() < 1e-9
    assert main(["solve", str(path), "--set", "L_1=1.2", "-o", str(out)]) == 2


# ---- decks and kernels ---------------------------------------------------------------------------


def test_the_results_are_those_of_the_edited_text() -> None:
    kernels = compiled(DECK)
    for stiffness in (150.0, 175.0, 220.0):
        values = {"SFORCE/1.FUNCTION[0]": stiffness, "L_0": 1.0 + 1e-3 * stiffness}
        varied = al.simulate(kernels.with_values(values))
        edited = al.simulate(compiled(al.read(DECK, values=values).source.text))
        assert np.array_equal(varied.values, edited.values)
        assert varied.meta == edited.meta


WELDED = """a rod of two parts on a hinge
PART/1, GROUND
MARKER/1, PART=1
ACCGRAV/JGRAV=-9.81
PART/2, MASS=1, CM=2, IP=0.1,0.1,0.1, QG=0.5,0,0
MARKER/2, PART=2
MARKER/21, PART=2, QP=-0.5,0,0
MARKER/22, PART=2, QP=0.5,0,0
PART/3, MASS=2, CM=3, IP=0.1,0.1,0.1, QG=1,0,0
MARKER/3, PART=3
JOINT/1, REVOLUTE, I=21, J=1
JOINT/2, FIXED, I=22, J=3
SIMULATE/DYNAMIC, END=0.5, STEPS=5
END
"""


@pytest.mark.parametrize("text", [DECK, WELDED])
@pytest.mark.filterwarnings("ignore")
def test_a_varied_deck_runs_as_its_text(text: str) -> None:
    deck = al.read(text)
    for mass in (3.0, 4.0, 5.0, 6.0):
        varied = deck.with_values({"PART/2.MASS": mass})
        once, again = al.simulate(varied), al.simulate(al.read(varied.source.text))
        assert np.array_equal(once.values, again.values)
        assert once.meta == again.meta


def test_a_varied_deck_of_which_much_is_kept_is_pickled_as_a_deck() -> None:
    deck = al.read(DECK)
    for length in (1.0, 1.1):
        al.simulate(deck.with_values({"L_0": length}))
    back = pickle.loads(pickle.dumps(deck))
    assert not back.kept
    assert back.with_values({"L_0": 3}).find("VARIABLE", "L_0").function.value == 3.0


def test_the_second_value_reads_and_binds_nothing(monkeypatch) -> None:
    kernels = compiled(DECK)
    kernels.with_values({"L_0": 1.1, "PART/2.MASS": 2.5, "PART/2.QG[1]": -1.25})

    def never(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr(statement_reader.Reading, "statements", never)
    monkeypatch.setattr(collecting, "_bind", never)
    varied = kernels.with_values({"L_0": 1.3, "PART/2.MASS": 2.1, "PART/2.QG[1]": -1.5})
    assert varied.model.bodies[0].mass == 2.1
    assert varied.model.bodies[0].x[1] == -1.5
    assert varied.addresses is kernels.addresses
    assert varied.shared is kernels.shared


def test_values_add_up_and_the_first_deck_stays_as_it_is() -> None:
    deck = al.read(DECK)
    both = deck.with_values({"PART/2.MASS": 3}).with_values({"L_0": 1})
    assert both.values == {"PART/2.MASS": 3.0, "VARIABLE/L_0.FUNCTION": 1.0}
    assert both.find("PART", 2).mass == 3.0
    assert deck.find("PART", 2).mass == 2.0
    kernels = al.compile_model(al.assemble(deck))
    again = kernels.with_values({"PART/2.MASS": 3}).with_values({"L_0": 1})
    assert _same(again, al.compile_model(al.assemble(both)))


def test_check_of_a_varied_deck_shows_its_own_text() -> None:
    deck = al.read(DECK.replace("IP=1,2,3", "IP=1,2,2.5"))
    for third in (2.9, 30.0):
        varied = deck.with_values({"PART/2.IP[2]": third})
        assert [str(each) for each in al.check(varied)] == [
            str(each) for each in al.check(al.read(varied.source.text))
        ]


def test_where_turns_count_from_follows_the_numbers() -> None:
    """A weight is drawn off its guide: racks count from where the other joints close."""
    path = DECKS_OF / "atwood" / "atwood-rackpin.adm"
    kernels = compiled(path)
    assert kernels.model.start is None
    for x in (0.21, 0.22):
        values = {"PART/20.QG[0]": x}
        varied = kernels.with_values(values).model.start
        edited = al.compile_model(al.assemble(al.read(path, values=values))).model.start
        assert np.array_equal([p for p, _ in varied], [p for p, _ in edited])


SHAPES = {
    "a coefficient that vanishes": {"SFORCE/1.FUNCTION[0]": 0.0},
    "another exponent": {"VARIABLE/k.FUNCTION[2]": 3.0},
    "a marker that moves off the mass centre": {"PART/2.QG[0]": 0.5},
    "a zero that gets a value": {"SFORCE/1.FUNCTION[6]": 0.25},
    "a number of a rule": {"SFORCE/1.FUNCTION[1]": 0.25},
}


@pytest.mark.parametrize("values", SHAPES.values(), ids=SHAPES)
def test_another_shape_is_made_the_long_way(values: dict[str, float]) -> None:
    kernels = compiled(DECK)
    (name,) = values
    near = next(e.value for e in al.names(DECK) if e.name == name)
    for each in (near, 1.001 * near):
        kernels.with_values({name: each})
    assert _same(kernels.with_values(values), compiled(al.read(DECK, values=values).source.text))


# ---- every deck ----------------------------------------------------------------------------------

DECKS = [path for path in sorted(DECKS_OF.rglob("*.adm")) if path.stat().st_size < 40_000]
SHORT = [path for path in DECKS if path.stat().st_size < 20_000]


def changed(rng: random.Random, value: float) -> float:
    """Mostly a number near the old one; sometimes one that is another matter."""
    others = (-value, 0.0, 1e3 * value or 5.0, 1.0, 2.0, float(round(value)) + 1.0)
    near = value * (1.0 + 0.1 * rng.random()) if value else rng.random()
    return near if rng.random() < 0.5 else rng.choice(others)


def outcome(make: Any) -> Any:
    """What is made, or the message in its place."""
    try:
        return make()
    except (DeckError, UsageError) as fault:
        return str(fault)


def bodies(kernels: Any) -> list[Any]:
    return [
        (b.mass, *(x.tobytes() for x in (b.inertia, b.x, b.attitude, b.v, b.w)))
        for b in kernels.model.bodies
    ]


@pytest.mark.parametrize(
    "path", [*every(12, SHORT), *(slow(each) for each in DECKS if each not in SHORT)], ids=str
)
@pytest.mark.filterwarnings("ignore")
def test_varied_kernels_are_those_of_the_edited_text(path: Path) -> None:
    """Some numbers twice, the second time quickly, against reading and binding the edited text."""
    rng = random.Random(str(path.name))
    deck = outcome(lambda: al.read(path))
    if isinstance(deck, str):
        pytest.skip("has mistakes of its own")
    kernels, names = al.compile_model(al.assemble(deck)), al.names(deck)
    for count in (1, 3):
        chosen = rng.sample(names, min(count, len(names)))
        for _ in range(2):
            values = {each.name: changed(rng, each.value) for each in chosen}
            varied = outcome(lambda values=values: kernels.with_values(values))
            edited = outcome(
                lambda values=values: al.compile_model(al.assemble(al.read(path, values=values)))
            )
            if isinstance(varied, str) or isinstance(edited, str):
                assert varied == edited, values
                continue
            assert _same(varied, edited), values
            assert bodies(varied) == bodies(edited), values
            assert varied.model.deck.source.text == edited.model.deck.source.text

"""What `adamslite check` says about cables, and that its advice holds."""

from dataclasses import replace
from pathlib import Path

import pytest
from cable_scenes import SCENES, CableScene

import adamslite
from adamslite.cables.advise import Advice, advise
from adamslite.cables.told import about_cables, cables
from adamslite.cli import main

DECKS = Path(__file__).parent.parent / "decks"
#: Scenes that are cheap enough to be solved to 0.1 %.
FINE = ("axial step", "kink at an anchor", "spinning ring", "taut string")


def advised(scene: CableScene, accuracy: float) -> Advice:
    """For the scene as a user drew it."""
    (cable,) = cables(adamslite.read(scene.draw(*scene.drawn)))
    return advise(cable.demand, accuracy)


def less(advice: Advice) -> Advice:
    """One level less: the simpler element, or half of the sections where there is none."""
    if advice.form == "ale":
        return replace(advice, form="paper")
    return replace(advice, elements=(advice.elements + 1) // 2)


def error(scene: CableScene, advice: Advice) -> float:
    """Relative error of the scene, drawn and solved as advised."""
    deck = adamslite.read(scene.draw(advice.form or "fixed", advice.elements))
    results = adamslite.simulate(deck, integrator=advice.integrator, error=advice.error)
    assert results.outcome.name == "DONE"
    return abs(scene.error(results, advice.elements))


@pytest.mark.parametrize(
    ("name", "accuracy"), [*((name, 0.01) for name in SCENES), *((name, 0.001) for name in FINE)]
)
def test_the_advice_keeps_its_promise_and_asks_for_no_more(name: str, accuracy: float) -> None:
    """The model it chooses is as accurate as wanted, with room for another processor's rounding;
    one level less is not.
    """
    advice = advised(SCENES[name], accuracy)
    assert error(SCENES[name], advice) < 0.95 * accuracy
    assert error(SCENES[name], less(advice)) > accuracy


def test_sections_for_a_kink_go_with_the_power_two_thirds_of_the_accuracy() -> None:
    """The ripple behind a kink at a sheave leaves N^(-3/2) in a mean, with a sign that swings.

    0.1 % would take 575 sections and minutes; 0.4 % shows it: 180 sections, which a power 0.41 asks
    for, are 0.5 % off.
    """
    scene, ratio = SCENES["kink at a sheave"], (0.01 / 0.004) ** (2 / 3)
    fine = advised(scene, 0.004)
    assert fine.elements == pytest.approx(ratio * advised(scene, 0.01).elements, abs=ratio)
    assert error(scene, fine) < 0.004


@pytest.mark.parametrize("name", ["kink at a sheave", "weight lowered at 20 m/s", "axial step"])
def test_the_advice_does_not_depend_on_the_model_it_is_asked_with(name: str) -> None:
    scene = SCENES[name]
    others = [replace(scene, drawn=drawn) for drawn in (("paper", 15), ("ale", 15), ("ale", 60))]
    assert len({(a.level, a.form, a.elements) for a in (advised(s, 0.01) for s in others)}) == 1


PENDULUM = """A weight on a light rope
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={length}, TIME=SECOND
ACCGRAV/JGRAV=-{g}
PART/1, GROUND
MARKER/1, PART=1
{masses}
{springs}
SIMULATE/DYNAMIC, END=10, STEPS=100
END
"""


def pendulum(rope: float, spring: str, metre: float = 1.0) -> str:
    """500 kg on 5 m of rope, of the mass `rope` in five pieces, drawn out and to one side."""
    masses, springs = "", ""
    for k in range(1, 6):
        mass = rope / 5 if k < 5 else 500 + rope / 10
        x, y = 0.6 * k * metre, -0.8 * k * metre
        masses += f"POINT_MASS/{k}0, MASS={mass!r}, CM={k + 1}, QG={x!r},{y!r},0\n"
        masses += f"MARKER/{k + 1}, POINT_MASS={k}0\n"
        springs += spring.format(s=k, i=k + 1, j=k, k=1e8 / metre, free=0.99996 * metre) + "\n"
    length = {1.0: "METER", 1000.0: "MILLIMETER"}[metre]
    return PENDULUM.format(length=length, g=9.81 * metre, masses=masses, springs=springs)


SPRINGS = {
    "SPRINGDAMPER": "SPRINGDAMPER/{s}, TRANSLATIONAL, I={i}, J={j}, K={k!r}, LENGTH={free!r}",
    "SFORCE": "SFORCE/{s}, I={i}, J={j}, FUNCTION=-{k!r}*(DM({i},{j})-{free!r})",
    "tension only": "SFORCE/{s}, I={i}, J={j}, FUNCTION=-MAX(0,{k!r}*(DM({i},{j})-{free!r}))",
    "VFORCE": "FLOATING/{s}",
}
VFORCE = ", ".join(
    f"F{a}=-{{k!r}}*(1-{{free!r}}/DM({{i}},{{j}}))*D{a}({{i}},{{j}})\\\n" for a in "XYZ"
)
SPRINGS["VFORCE"] = "VFORCE/{s}, I={i}, J_PART=1, " + VFORCE.removesuffix("\\\n")


@pytest.mark.parametrize("spring", SPRINGS)
def test_a_row_of_masses_on_springs_is_a_cable(spring: str) -> None:
    """EA = k l/5 = 1e8 N/m times 1 m, rho = rope/5 a metre, whatever the spring is made of."""
    (cable,) = cables(adamslite.read(pendulum(50.0, SPRINGS[spring])))
    of = cable.demand
    assert of.stiffness == pytest.approx(1e8 * 0.99996, rel=1e-6)
    assert of.density == pytest.approx(10 / 0.99996, rel=1e-9)
    assert of.length == pytest.approx(5 * 0.99996, rel=1e-9)
    assert of.moved == pytest.approx(505.0)
    assert cable.form == "fixed" and of.known and of.way == 0


def test_figures_are_in_si_units() -> None:
    metres, millimetres = (
        about_cables(adamslite.read(pendulum(50.0, SPRINGS["SFORCE"], metre)))
        for metre in (1.0, 1000.0)
    )
    assert metres == millimetres


@pytest.mark.parametrize(("rope", "level"), [(50.0, 2), (2.0, 1)])
def test_a_light_rope_may_be_rigid(rope: float, level: int) -> None:
    """rho l < p M: 2 kg of rope are 0.4 % of the weight, 50 kg are 10 %. It hangs in balance."""
    (cable,) = cables(adamslite.read(pendulum(rope, SPRINGS["SFORCE"])))
    assert advise(replace(cable.demand, bounces=False), 0.01).level == level


def test_a_contact_is_no_spring() -> None:
    """It pushes only: what keeps a mass off a wheel does not make it a piece of a cable."""
    push = "SFORCE/{s}, I={i}, J={j}, FUNCTION=MAX(0,{k!r}*(1.5-DM({i},{j})))"
    assert cables(adamslite.read(pendulum(50.0, push))) == []


def test_check_prints_a_few_lines_for_a_cable_and_none_without(capsys) -> None:
    assert main(["check", str(DECKS / "cables" / "weight-lowered" / "paper-20.adm")]) == 0
    told = capsys.readouterr().out.splitlines()[3:]
    assert told[0] == "  cable from MARKER/1 to POINT_MASS/21"
    assert [line[4:14].rstrip() for line in told[1:]] == [
        "cable", "waves", "sections", "payout", "paper form", "for 1 %", "for 0.1 %",
    ]  # fmt: skip
    assert "axial 2236 m/s, 8.94 ms along it" in told[2]
    assert "ale form, 32 of them; GSTIFF ERROR=2E-06" in told[6]
    assert main(["check", str(DECKS / "pendulum-revolute" / "pendulum-revolute.adm")]) == 0
    assert "cable" not in capsys.readouterr().out

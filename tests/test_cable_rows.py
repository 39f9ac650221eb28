"""Cable scenes that single rules had wrong: what is chosen for them, and what is reported."""

import re

import pytest

from adamslite.cables.deck.scene import deck
from adamslite.language.diagnostics import DeckError

SCENE = """\
end = {end}
[cable]
EA = {EA}
rho = {rho}
{more}
[[route]]
{top}
[[route]]
kind = "mass"
at = [0, -{length}, 0]
mass = {mass}
velocity = [{across}, {along}, 0]
"""
HOOK = """\
kind = "fixed"
at = [0, 0, 0]"""
WINCH = """\
kind = "winch"
at = [-0.3, 0, 0]
radius = 0.3
inertia = 5
turn = -1
payout = "{law}\""""


def hung(mass: float, length: float, EA: float, rho: float, **more: object) -> str:  # noqa: N803
    """A weight on a held cable."""
    values = {"end": 1, "more": "", "across": 0, "along": 0, "top": HOOK, **more}
    return SCENE.format(mass=mass, length=length, EA=EA, rho=rho, **values)


def hoisted(law: str, mass: float, length: float, EA: float, rho: float, **more: object) -> str:  # noqa: N803
    """A weight on a winch that pays out by a law."""
    values = {"end": 4, "top": WINCH.format(law=law), **more}
    return hung(mass, length, EA, rho, **values)


def chosen(description: str, model: str = "") -> tuple[int, int, str, list[str]]:
    """Level, sections, method, and the codes of what is reported."""
    text, told = deck(description + model)
    head = " ".join(text[: text.index("! Written")].replace("\n! ", " ").split())
    count = re.search(r"(\d+) sections?\b", head)
    level = re.search(r"Level (\d)", head)
    method = re.search(r"INTEGRATOR/(\w+)", text)
    assert level and method
    return int(level[1]), int(count[1]) if count else 0, method[1], [each.code for each in told]


def test_a_push_sideways_is_no_impact() -> None:
    """200 kg on 5 m at 0.5 m/s: v^2/l is 0.5 % of g, and a rigid cable swings alike."""
    assert chosen(hung(200, 5, 1e7, 0.1, across=0.5, end=5))[:2] == (1, 0)


@pytest.mark.parametrize("way", [6, -6])
def test_a_crane_needs_a_few_sections(way: float) -> None:
    """2 t at 1 m/s sideways, six metres up or down."""
    level, sections, _, _ = chosen(
        hoisted(f"STEP5(TIME,0,0,6,{way})", 2000, 20, 2e7, 2, across=1, end=8)
    )
    assert level == 3 and sections <= 10


def test_arrivals_take_the_sections_of_a_front() -> None:
    """7 c/U only where the time counts at which the kink arrives."""
    scene = hung(200, 5, 1e7, 0.1, across=0.5, end=0.2)
    _, few, _, _ = chosen(scene)
    _, many, _, _ = chosen(scene, '[model]\nquantities = ["tension", "arrival"]\n')
    assert few < 40 < many


def test_a_start_along_a_held_cable_is_a_jump() -> None:
    """1 m/s stops against EA (M + rho l/3)/l: 10 kN on 1962 N; level 1 says that it cannot."""
    scene = hung(200, 20, 1e7, 0.05, along=-1)
    assert chosen(scene)[0] == 2
    text, told = deck(scene + "[model]\nlevel = 1\n")
    assert [each.code for each in told] == ["rigid-has-waves"]
    assert "a weight starts along its held cable at 1 m/s" in told[0].message


def test_a_ramp_from_rest_bounces() -> None:
    """v sqrt(EA (M + rho l/3)/l) = 7.9 kN on 19.8 kN for 3 %: not rigid."""
    scene = hoisted("-0.0485*TIME", 2017, 4.53, 5.97e7, 0.5, end=0.05)
    assert chosen(scene, "[model]\naccuracy = 0.03\n")[:2] == (3, 1)


@pytest.mark.parametrize(
    "law", ["SHF(TIME,0,0.2,2,1.5707963268,0.2)", "POLY(TIME,0,0,0,0.5,-0.1)", "0.3*ATAN(TIME**2)",
            "0.2*CHEBY(TIME,0,1,0,0.5)-0.1", "0.1*(1-COS(MOD(TIME,7)))"],
)  # fmt: skip
def test_every_law_of_time_is_known(law: str) -> None:
    """None is "not known before the run", which would take 42 sections."""
    text, _ = deck(hoisted(law, 500, 10, 1e7, 0.5, end=2))
    assert "not known" not in text
    assert chosen(hoisted(law, 500, 10, 1e7, 0.5, end=2))[1] < 5


def test_a_slow_winch_needs_no_fronts() -> None:
    """0.01 m/s at once: rho c v = 22 N of 4905 N, and a bounce of 220 N."""
    assert chosen(hoisted("0.01*TIME", 500, 10, 1e7, 0.5, end=10))[1] == 1


def test_slackness_is_foreseen() -> None:
    """20 kg that stop from 10 m/s with 26 m/s^2 go on upwards."""
    law = "-(10*TIME-3*(1-EXP(-TIME/0.3)))+STEP(TIME,1.1,0,1.5,4.2)"
    told = chosen(hoisted(law, 20, 20, 2e6, 0.3, end=2))[3]
    assert told in (["pushed"], ["slackens"])
    assert "slackens" in chosen(hung(200, 20, 1e7, 0.05, along=1))[3]


def test_pretension_beside_a_weight_is_told() -> None:
    assert "pretension" in chosen(hung(200, 20, 1e7, 0.05, more="pretension = 5019"))[3]


def test_nothing_moves_between_fixed_ends() -> None:
    """A sentence, not a deck without anything in it."""
    scene = hung(1, 10, 1e7, 0.1, more="pretension = 100")
    scene = scene[: scene.rindex("kind")] + 'kind = "fixed"\nat = [0, -10, 0]\n'
    with pytest.raises(DeckError, match="nothing moves between fixed ends"):
        deck(scene + "[model]\nlevel = 1\n")
    assert chosen(scene)[0] == 2

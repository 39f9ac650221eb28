"""Loads on several ropes, as `adamslite cable` writes them."""

import re
from pathlib import Path

import numpy as np
import pytest
from descriptions import ATWOOD

import adamslite
from adamslite.cables.deck.scene import deck

G = 9.81
#: A station where a rope is held above, and the hook below it.
FALL = """\
[[cable]]
EA = {ea}
rho = {rho}
damping = 0.3
{length}
fall = "top{k} hook{k}"
[[route]]
name = "top{k}"
kind = "fixed"
at = [{x}, 0, {z}]
[[route]]
name = "hook{k}"
kind = "hook"
at = [{x}, {y}, {z}]
"""


def fall(k: int, ea: float, x: float = 0.0, y: float = -10.0, z: float = 0.0, rho: float = 1e-3,
         length: str = "") -> str:  # fmt: skip
    return FALL.format(k=k, ea=ea, x=x, y=y, z=z, rho=rho, length=length)


def hang(load: str, *falls: str, model: str = "level = 2\nelements = 1") -> str:
    return (
        f"end = 0.1\nsteps = 10\nstatics = true\nerror = 1e-8\n{''.join(falls)}"
        f"[[load]]\n{load}\n[model]\n{model}\n"
    )


def solve(spec: str) -> adamslite.Results:
    found = adamslite.simulate(adamslite.read(deck(spec)[0]))
    assert found.outcome.name == "DONE"
    return found


@pytest.mark.parametrize("stiff", [(3e6, 1e6), (2e5, 9e5)])
@pytest.mark.parametrize("lengths", [(10.0, 10.0), (9.99, 9.985)])
def test_two_falls_share_a_load_by_their_stiffness(
    stiff: tuple[float, float], lengths: tuple[float, float]
) -> None:
    """T1 + T2 = M g with one stretch for both: T = EA (y/l - 1)."""
    falls = [fall(k, ea, length=f"length = {long}")
             for k, ea, long in zip((1, 2), stiff, lengths, strict=True)]  # fmt: skip
    found = solve(hang("at = [0, -10, 0]\nmass = 300", *falls))
    per_length = np.divide(stiff, lengths)
    y = (300 * G + sum(stiff)) / per_length.sum()
    for k, (ea, long) in enumerate(zip(stiff, lengths, strict=True), 1):
        assert found[f"REQUEST/{k}.F3"] == pytest.approx(ea * (y / long - 1), rel=1e-4)


def test_ropes_that_just_reach_a_load_share_it_by_ea_over_length() -> None:
    """Without a length they start in balance at the place in the route."""
    falls = fall(1, 3e6), fall(2, 1e6).replace("0, 0, 0.0]", "0, 10, 0.0]")
    text = hang("at = [0, -10, 0]\nmass = 300", *falls).replace("statics = true\n", "")
    found = solve(text)
    share = 3e6 / 10 / (3e6 / 10 + 1e6 / 20)
    assert found["REQUEST/1.F3"] == pytest.approx(300 * G * share, rel=1e-4)
    assert found["REQUEST/2.F3"] == pytest.approx(300 * G * (1 - share), rel=1e-4)
    assert np.ptp(found["POINT_MASS/50.y"]) < 1e-6


def test_four_ropes_hold_a_plate_in_space() -> None:
    """Four equal ropes, mass centre off the middle: the stretch is a plane, T = T0 (1 + a x + b z)
    with 4 T0 = M g, a = X/w^2, b = Z/w^2 for places at +-w; it tilts by T0 a l/EA."""
    places = [(-1, -1), (-1, 1), (1, -1), (1, 1)]
    falls = [fall(k, 1e7, x, -5.0, z, length="length = 5") for k, (x, z) in enumerate(places, 1)]
    load = "at = [0.2, -5.1, -0.3]\nmass = 800\ninertia = [300, 500, 300]"
    found = solve(hang(load, *falls))
    for k, (x, z) in enumerate(places, 1):
        exact = 200 * G * (1 + 0.2 * x - 0.3 * z)
        assert found[f"REQUEST/{k}.F3"][-1] == pytest.approx(exact, rel=2e-3)
    assert found["REQUEST/90.F4"][-1] == pytest.approx(-200 * G * 0.2 * 5 / 1e7, rel=5e-3)


def test_ropes_of_one_load_are_not_rigid() -> None:
    """Level 1 is refused where statics does not tell their forces, and not chosen."""
    load, falls = "at = [0, -10, 0]\nmass = 300", (fall(1, 3e9), fall(2, 1e9))
    with pytest.raises(adamslite.DeckError) as fault:
        deck(hang(load, *falls, model="level = 1"))
    assert [each.code for each in fault.value.diagnostics] == ["not-shared"]
    assert "Level 2" in deck(hang(load, *falls, model="accuracy = 0.05"))[0]


def test_a_beam_on_two_ropes_may_be_rigid() -> None:
    """Its levers tell the forces: 3/4 and 1/4."""
    load = "at = [0.5, -10.5, 0]\nmass = 100\ninertia = 40"
    spec = hang(load, fall(1, 1e9, -1), fall(2, 1e9, 1), model="level = 1")
    found = solve(spec.replace("statics = true\n", ""))
    assert -found["GCON/1.f"] == pytest.approx(25 * G, rel=1e-6)
    assert -found["GCON/2.f"] == pytest.approx(75 * G, rel=1e-6)


def test_a_hook_block_hangs_on_two_reeved_ropes() -> None:
    """Two ropes go round a sheave of their own on one block, of J/R^2 = 1 kg: each has two falls.

    T1 + T2 = 100 g and, about the mass centre, 0.2 T1 - 0.6 T2 = (0.1 - 0.3) g of the wheels.
    """
    rope = """\
[[cable]]
EA = {ea}
rho = 1e-3
damping = 0.3
fall = "a{k} s{k} b{k}"
[[route]]
name = "a{k}"
kind = "fixed"
at = [-0.2, 0, {z}]
[[route]]
name = "s{k}"
kind = "pulley"
load = "block"
at = [0, -6, {z}]
radius = 0.2
inertia = 0.04
[[route]]
name = "b{k}"
kind = "fixed"
at = [0.2, 0, {z}]
"""
    falls = rope.format(k=1, ea=3e6, z=0.1), rope.format(k=2, ea=1e6, z=-0.3)
    load = 'name = "block"\nat = [0, -6, 0]\nmass = 198\ninertia = 9'
    found = solve(
        hang(load, *falls, model="level = 3\nelements = 1").replace("statics = true\n", "")
    )
    for k, exact in ((1, 74.75 * G), (2, 25.25 * G)):
        for span in (2 * k - 1, 2 * k):
            assert found[f"REQUEST/{span}.F2"] == pytest.approx(exact, rel=1e-3)


@pytest.mark.parametrize("stiffness", ["4e6", "1.3e8"])
def test_statics_of_a_rope_that_may_part(stiffness: str) -> None:
    """Its tension is a VARIABLE, whose last digits are those of places of 10 m: 1e-10 N and more.

    Both ropes hang at x = 0: they carry 500 kg and half of their own 22 m.
    """
    scene = Path("decks/cables/hoists/parting.toml").read_text(encoding="utf-8")
    scene = "statics = true\n" + scene.replace("EA = 4e6", f"EA = {stiffness}")
    text, _ = deck(scene)
    text = re.sub(r"SIMULATE/DYNAMIC.*", "", text)
    results = adamslite.simulate(adamslite.read(text))
    assert results.outcome is adamslite.Outcome.DONE, results.message
    carried = results["SFORCE/1001.f"][-1] + results["SFORCE/2001.f"][-1]
    assert -carried == pytest.approx(G * (500 + 0.002 * 11), abs=0.05)


def test_names_of_a_description_reach_the_deck() -> None:
    """Of cables, of stations with a wheel or a weight, and of requests; without names no words."""
    one = deck(ATWOOD.replace("level = 1", "level = 3").replace("rho", 'name = "wire"\nrho')
               .replace("mass = 3", 'mass = 3\nname = "cage"')
               .replace("[1.8, 0, 0]", '[1.8, 0, 0]\nname = "a,b;c"'))[0]  # fmt: skip
    statements = one[one.index("\nPART/1, GROUND") :]
    assert one.splitlines()[1].startswith("! Cable wire. Level 3")
    assert "\n! The pulley of station 3 (a_b_c), R = 0.2 m.\n" in statements
    assert "\n! The mass of station 4 (cage).\nPOINT_MASS/40" in statements
    requests = adamslite.read(one).of("REQUEST")
    assert [each.comment for each in requests] == [
        "span 1: tension at its root and tip",
        "span 2 (pulley to a_b_c): tension at its root and tip",
        "span 3 (a_b_c to cage): tension at its root and tip",
        None,
        "a_b_c: travel of the cable",
    ]
    bare = deck(ATWOOD.replace("level = 1", "level = 3"))[0]
    assert "(" not in "".join(re.findall("! The .*", bare)) and "travel of the cable" not in bare


def test_copies_of_a_station_have_names_with_numbers() -> None:
    spec = ATWOOD.replace(
        "radius = 0.2", 'radius = 0.2\nname = "s"\ncount = 2\npitch = [0.5, 0, 0]', 1
    )
    found = re.findall(
        r"! The pulley of (.*), R", deck(spec.replace("0.2, 0, 0]", "0.2, 0.1, 0]"))[0]
    )
    assert found[:2] == ["station 2 (s.1)", "station 3 (s.2)"]

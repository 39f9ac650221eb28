"""What a scene does not need: the advice, followed in the text of the deck, changes results by no
more than it says.
"""

from __future__ import annotations

import re

import numpy as np
import pytest
from fixed_parts import Machine
from random_mechanisms import make, text
from tiers import every

import adamslite
from adamslite.checks.rules import needless
from adamslite.language.messages.needless import NEEDLESS
from adamslite.scene import read_together
from benchmarks.rigid_scenes import link

BROKEN = [(code, deck) for code, message in NEEDLESS.items() for deck in message.broken]


def advice(deck: adamslite.Deck, code: str) -> list[adamslite.Diagnostic]:
    return [each for each in needless(deck) if each.code == code]


def run(deck: adamslite.Deck, error: float = 1e-10) -> adamslite.Results:
    results = adamslite.simulate(deck, error=error, integrator="RADAU")
    assert results.outcome.name == "DONE"
    return results


def changed(one: adamslite.Results, other: adamslite.Results, parts: list[str]) -> float:
    """The largest difference of a place."""
    names = [f"{part}.{axis}" for part in parts for axis in "xyz"]
    return max(float(np.abs(one[name] - other[name]).max()) for name in names)


@pytest.mark.parametrize(("code", "broken"), BROKEN)
def test_a_deck_of_the_table_yields_its_note_only(code: str, broken: str) -> None:
    """And not where a comment on its line says that it is known, or a run begins."""
    text = broken + "\n"
    (note,) = adamslite.check(text)
    assert note.code == code
    lines = text.splitlines()
    for place in note.everywhere:
        lines[place.line - 1] += f"  ! adamslite: ignore {code}"
    assert adamslite.check("\n".join(lines) + "\n") == []
    assert read_together(text, None, ())[2] == ()


# ---- parts that never move against each other --------------------------------------------------


@pytest.mark.parametrize("seed", every(3, [seed for seed in range(12) if Machine(seed).fixed]))
def test_parts_held_twice_are_one_body(seed: int) -> None:
    """Each FIXED of a random machine as a ball joint and equal axes: one body is advised, and one
    body moves as they do.
    """
    fixed = adamslite.read(Machine(seed).text(0.05))
    lines = Machine(seed).text(0.05).splitlines()
    out = []
    for line in lines:
        found = re.fullmatch(r"JOINT/(\d+), FIXED, I=(\d+), J=(\d+)", line)
        out.append(line)
        if found:
            number, i, j = map(int, found.groups())
            out[-1] = f"JOINT/{number}, SPHERICAL, I={i}, J={j}"
            out.append(f"JPRIM/{number}, ORIENTATION, I={i}, J={j}")
    deck = adamslite.read("\n".join(out) + "\n")
    assert advice(deck, "one-body")
    parts = [each.label for each in deck.of("PART") if not each.ground]
    size = max(np.abs(each.qg).max() for each in deck.of("PART"))
    assert changed(run(deck), run(fixed), parts) < 1e-9 * size


@pytest.mark.parametrize("seed", every(4, range(12)))
def test_what_is_called_one_body_or_planar_is_that_in_the_run(seed: int) -> None:
    """Random mechanisms in space: nothing is advised that a run does not bear out."""
    deck = adamslite.read(text(make(seed), 0.1, 4, "RADAU"))
    assert not advice(deck, "light-link")
    assert not advice(deck, "stiff-bushing")
    for note in advice(deck, "planar-motion"):
        normal = "xyz".index(next(axis for axis in "xyz" if axis not in note.message[-18:]))
        results = adamslite.simulate(deck, error=1e-9)
        for part in deck.of("PART"):
            if not part.ground:
                along = results[f"{part.label}.{'xyz'[normal]}"]
                assert np.ptp(along) <= 1e-9 * max(1.0, np.abs(along).max())


def test_couplers_of_a_folding_parallelogram_are_not_one_body() -> None:
    """Both translate alike on one branch; where the linkage lies flat they may part."""
    from adamslite.resources import find
    from adamslite.scene import load_scene

    deck = load_scene(find("decks") / "a02-n2" / "a02-n2.adm").deck
    assert not advice(deck, "one-body")
    assert advice(deck, "planar-motion")


# ---- light links -------------------------------------------------------------------------------

LINKAGE = """A linkage of two heavy parts and a light one
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
MARKER/9, PART=1, QP=2.5,{y},0.3
PART/2, MASS={first}, CM=2, IP=.1,.2,.15, QG=0.5,0,0
MARKER/2, PART=2
MARKER/3, PART=2, QP=-.5,0,0
MARKER/4, PART=2, QP=.5,0,0
{link}
PART/6, MASS={second}, CM=6, IP=.3,.2,.1, QG=2,{y},0
MARKER/6, PART=6
MARKER/7, PART=6, QP=0,0,0.2
MARKER/8, PART=6, QP=.5,0,.3
JOINT/1, REVOLUTE, I=3, J=1
JOINT/4, SPHERICAL, I=8, J=9
{hold}
SIMULATE/DYNAMICS, END=0.5, STEPS=20
END
"""
LINK = """PART/4, MASS={mass!r}, CM=10, IP={wide!r},{wide!r},{thin!r}, QG=1,0,0, ZG=2,{y},0.2
MARKER/10, PART=4, QP=0,0,{half!r}
MARKER/11, PART=4
MARKER/12, PART=4, QP=0,0,{length!r}"""


@pytest.mark.parametrize("seed", every(3, range(6)))
def test_a_light_link_is_as_good_as_a_distance(seed: int) -> None:
    """Places change by no more than the share of the inertia that is reported, times the way.

    That of seed 1 runs through dead centres, with 2000 times its weight in the link.
    """
    rng = np.random.default_rng(seed)
    y, mass = float(rng.uniform(-0.3, 0.3)), float(10 ** rng.uniform(-6, -3.5))
    length = float(np.hypot(np.hypot(1.0, y), 0.2))
    values = {"y": repr(y), "first": rng.uniform(0.5, 5), "second": rng.uniform(0.5, 5)}
    rod = LINK.format(mass=mass, wide=0.08 * mass, thin=0.01 * mass, y=y, half=length / 2,
                       length=length)  # fmt: skip
    hold = "JOINT/2, SPHERICAL, I=11, J=4\nJOINT/3, SPHERICAL, I=12, J=7"
    deck = adamslite.read(LINKAGE.format(link=rod, hold=hold, **values))
    (note,) = advice(deck, "light-link")
    share = float(re.search(r"most (\S+) of", note.message)[1])
    gcon = re.search(r"(FUNCTION=\S+) does", note.hint)[1]
    without = adamslite.read(LINKAGE.format(link="", hold=f"GCON/1, {gcon}", **values))
    one, other = run(deck, 1e-8), run(without, 1e-8)
    way = max(np.ptp(one[f"{part}.{axis}"]) for part in ("PART/2", "PART/6") for axis in "xyz")
    assert 0.0 < changed(one, other, ["PART/2", "PART/6"]) < share * way


@pytest.mark.parametrize("seed", [1, 5, 9])
def test_a_link_without_mass_loses_nothing(seed: int) -> None:
    """In a plane, where no spin of its own is left over."""
    scene = next(each for each in map(link, range(seed, 99)) if "plane" in each.kind)
    text = re.sub(r"PART/4, MASS=\S+, CM=40, IP=[^,]+,[^,]+,[^,]+", "PART/4, CM=40", scene.text)
    deck, size = adamslite.read(text), scene.size
    (note,) = advice(deck, "light-link")
    assert "at most 0 of" in note.message
    one, other = (run(each, 1e-10 * size) for each in (deck, adamslite.read(scene.advised(text))))
    assert changed(one, other, list(scene.parts)) < 1e-8 * size


@pytest.mark.parametrize("seed", [1, 5, 9])
def test_a_link_that_turns_its_neighbour_is_needed(seed: int) -> None:
    """In a plane; where its neighbour is on a ball joint the link's hinges keep it in the plane."""
    scene = next(each for each in map(link, range(seed, 99)) if "plane" in each.kind
                 and advice(adamslite.read(each.text), "light-link"))  # fmt: skip
    loose = scene.text.replace("JOINT/2, REVOLUTE", "JOINT/2, SPHERICAL")
    assert not advice(adamslite.read(loose), "light-link")


@pytest.mark.parametrize("value", ["0", "0.3"])
def test_a_motion_that_stands_still_holds_one_body(value: str) -> None:
    """Where it holds the joint as drawn; one that closes it first is no part of the posture."""
    text = BUSHED.replace("SIMULATE", f"MOTION/1, JOINT=2, FUNCTION={value}\nSIMULATE")
    values = {"m": 2, "n": 3, "i": 0.7, "l": 1, "far": 3, "g": -9.81}
    deck = adamslite.read(text.format(hold="JOINT/2, REVOLUTE, I=6, J=4", **values))
    notes = advice(deck, "one-body")
    assert len(notes) == (value == "0")
    if notes:
        assert "JOINT/2 and MOTION/1" in notes[0].hint
        fixed = adamslite.read(BUSHED.format(hold="JOINT/2, FIXED, I=6, J=4", **values))
        assert changed(run(deck), run(fixed), ["PART/2", "PART/5"]) < 1e-9


@pytest.mark.parametrize("mass", [0.01, 1.0])
def test_a_link_with_mass_is_not_light(mass: float) -> None:
    rod = LINK.format(mass=mass, wide=0.08 * mass, thin=0.01 * mass, y=0.1, half=0.5, length=1.0)
    hold = "JOINT/2, SPHERICAL, I=11, J=4\nJOINT/3, SPHERICAL, I=12, J=7"
    deck = adamslite.read(LINKAGE.format(link=rod, hold=hold, y=0.1, first=1, second=1))
    assert not advice(deck, "light-link")


# ---- stiff bushings ----------------------------------------------------------------------------

BUSHED = """A double pendulum
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV={g}
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS={m}, CM=2, IP={i},{i},{i}, QG={l},0,0
MARKER/2, PART=2
MARKER/3, PART=2, QP=-{l},0,0
MARKER/4, PART=2, QP={l},0,0
PART/5, MASS={n}, CM=5, IP={i},{i},{i}, QG={far},0,0
MARKER/5, PART=5
MARKER/6, PART=5, QP=-{l},0,0
JOINT/1, REVOLUTE, I=3, J=1
{hold}
SIMULATE/DYNAMICS, END=1, STEPS=20
END
"""


@pytest.mark.parametrize("kind", ["SPHERICAL", "FIXED"])
@pytest.mark.parametrize(("length", "stiffness"), [(1.4, 3e8), (0.3, 1e9)])
def test_a_stiff_bushing_is_as_good_as_a_joint(kind: str, length: float, stiffness: float) -> None:
    """Damped a little. Places change by no more than is reported."""
    turning = stiffness * length**2 if kind == "FIXED" else 0.0
    damping = 0.05 * stiffness**0.5
    k, kt, c, ct = ([value] * 3 for value in (stiffness, turning, damping,
                                              damping * length**2 if turning else 0.0))  # fmt: skip
    rows = (f"{name}=" + ",".join(map(repr, row)) for name, row in
            (("K", k), ("KT", kt), ("C", c), ("CT", ct)))  # fmt: skip
    values = {"m": 2, "n": 3, "i": 0.7 * length**2, "l": length, "far": 3 * length, "g": -9.81}
    deck = adamslite.read(BUSHED.format(hold=f"BUSHING/1, I=6, J=4, {', '.join(rows)}", **values))
    (note,) = advice(deck, "stiff-bushing")
    told = float(re.search(r"up to (\S+),", note.hint)[1])
    joined = adamslite.read(BUSHED.format(hold=f"JOINT/2, {kind}, I=6, J=4", **values))
    difference = changed(run(deck, 1e-8), run(joined, 1e-8), ["PART/2", "PART/5"])
    assert 0.01 * told < difference < told


@pytest.mark.parametrize(("force", "told"), [(0.0, True), (5.0, True), (1e7, False)])
def test_a_load_that_is_zero_at_regular_times_counts(force: float, told: bool) -> None:
    """A force of a period of a quarter of the run, itself or in a VARIABLE."""
    wave = f"{force!r}*SIN(8*PI*TIME)"
    values = {"m": 2, "n": 3, "i": 0.7, "l": 1, "far": 3, "g": -9.81}
    hold = "BUSHING/1, I=6, J=4, K=1E8,1E8,1E8\n"
    pushed = f"SFORCE/1, ACTIONONLY, I=5, J=1, FUNCTION={wave}"
    indirect = f"VARIABLE/1, FUNCTION={wave}\nSFORCE/1, ACTIONONLY, I=5, J=1, FUNCTION=VARVAL(1)"
    for push in (pushed, indirect):
        deck = adamslite.read(BUSHED.format(hold=hold + push, **values))
        assert bool(advice(deck, "stiff-bushing")) == told


@pytest.mark.parametrize(("stiffness", "g"), [(1e4, -9.81), (1e9, 0.0)])
def test_a_bushing_that_gives_way_or_whose_load_is_unknown_is_kept(
    stiffness: float, g: float
) -> None:
    hold = f"BUSHING/1, I=6, J=4, K={stiffness},{stiffness},{stiffness}"
    deck = adamslite.read(BUSHED.format(hold=hold, m=1, n=1, i=0.1, l=1, far=3, g=g))
    assert not advice(deck, "stiff-bushing")

"""Contacts and stops that a mechanism is too short to reach are named, with what is missing."""

from __future__ import annotations

import re

import numpy as np
import pytest
from tiers import every

import adamslite
from adamslite.assembly.reach import Reach
from adamslite.checks.rules import needless
from adamslite.model.model import Model
from benchmarks.rigid_scenes import SYSTEMS, Drawn

STOP = "SFORCE/{n}, ACTIONONLY, I=32, J=1, FUNCTION={f}\n"


def arm(seed: int, a: float, b: float, joint: str = "SPHERICAL") -> tuple[Drawn, str]:
    """Two arms of lengths a and b [m] that hang on the origin; MARKER/32 is the end."""
    d = Drawn(seed)
    inner = d.part(2, 1.0, (a / 2, 0, 0), 0.3) + d.marker(21, 2, (-a / 2, 0, 0))
    outer = d.part(3, 1.0, (a + b / 2, 0, 0), 0.3) + d.marker(31, 3, (-b / 2, 0, 0))
    ends = d.marker(22, 2, (a / 2, 0, 0)) + d.marker(32, 3, (b / 2, 0, 0))
    joints = f"JOINT/1, {joint}, I=21, J=1\nJOINT/2, SPHERICAL, I=31, J=22\n"
    return d, d.head("Arms") + inner + outer + ends + joints


def told(text: str) -> dict[str, float]:
    notes = [n for n in needless(adamslite.read(text)) if n.code == "out-of-reach"]
    found = [re.search(r"(\w+/\w+) is never reached: .* (\S+) apart", n.message) for n in notes]
    return {match[1]: float(match[2]) for match in found if match}


def ball(d: Drawn, number: int, marker: int, radius: float) -> str:
    wide = repr(2 * radius * d.length)
    return (
        f"GRAPHICS/{number}, ELLIPSOID, CM={marker}, XSCALE={wide}, YSCALE={wide}, ZSCALE={wide}\n"
    )


CONTACT = "CONTACT/1, IGEOM=1, JGEOM=2, IMPACT, STIFFNESS=1E3, EXPONENT=1.5, DAMPING=1, DMAX=0.01\n"


@pytest.mark.parametrize("seed", range(len(SYSTEMS)))
@pytest.mark.parametrize(("a", "b"), [(0.5, 0.8), (2.0, 0.3)])
@pytest.mark.parametrize("missing", [0.2, -0.01])
def test_a_ball_and_a_floor(seed: int, a: float, b: float, missing: float) -> None:
    """At a + b + radii + missing from the origin: what is missing is reported, and no more."""
    d, text = arm(seed, a, b)
    text += ball(d, 1, 32, 0.1)
    far = a + b + 0.1 + missing
    balls = d.marker(7, 1, (0, -far - 0.05, 0)) + ball(d, 2, 7, 0.05) + CONTACT
    floor = d.marker(7, 1, (3, -far, 1)).rstrip() + ", REULER=0,-90D,0\n"
    floor += "GRAPHICS/2, PLANE, RM=7, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1\n" + CONTACT
    expected = {"CONTACT/1": pytest.approx(missing * d.length, rel=5e-3)} if missing > 0 else {}
    assert told(text + balls + d.run(0.1)) == expected
    assert told(text + floor + d.run(0.1)) == expected


@pytest.mark.parametrize("seed", range(len(SYSTEMS)))
@pytest.mark.parametrize(("a", "b"), [(0.5, 0.8), (2.0, 0.3)])
def test_stops_at_a_distance_or_along_an_axis(seed: int, a: float, b: float) -> None:
    """The end is within a + b of the origin, and at least |a - b| less twice the shorter of it."""
    d, text = arm(seed, a, b)
    L, R = d.length, (a + b) * d.length
    rest = "1E3,1.5,1,0.01)"
    functions = {
        1: f"IMPACT(DX(32,1),VX(32,1),{-R - 0.1 * L!r},{rest}",
        2: f"IMPACT({3 * R!r}-DM(32,1),-VR(32,1),{1.5 * R!r},{rest}",
        3: f"BISTOP(DY(32,1),VY(32,1),{-1.2 * R!r},{1.1 * R!r},{rest}+3",
        4: f"IMPACT(DX(32,1),VX(32,1),{-R + 0.1 * L!r},{rest}",
        5: f"BISTOP(DY(32,1),VY(32,1),{-1.2 * R!r},{0.9 * R!r},{rest}",
        6: f"IMPACT(DX(32,1),VX(32,1),-1-TIME,{rest}",
    }
    stops = "".join(STOP.format(n=n, f=f) for n, f in functions.items())
    assert told(text + stops + d.run(0.1)) == {
        "SFORCE/1": pytest.approx(0.1 * L, rel=5e-3),
        "SFORCE/2": pytest.approx(0.5 * R, rel=5e-3),
        "SFORCE/3": pytest.approx(0.1 * R, rel=5e-3),
    }


@pytest.mark.parametrize("joint", ["TRANSLATIONAL", "CYLINDRICAL"])
def test_what_slides_may_reach_anything(joint: str) -> None:
    d, text = arm(0, 0.5, 0.5, joint)
    stop = STOP.format(n=1, f="IMPACT(DX(32,1),VX(32,1),-9,1E3,1.5,1,0.01)")
    assert told(text + stop + d.run(0.1)) == {}


@pytest.mark.parametrize("seed", every(4, range(12)))
def test_a_run_does_not_reach_it_either(seed: int) -> None:
    """Thrown about: the run misses what is reported out of reach, by no less than is reported."""
    rng = np.random.default_rng(seed)
    a, b = rng.uniform(0.3, 1.5, 2)
    d, text = arm(seed, float(a), float(b))
    place = rng.normal(size=3)
    place *= rng.uniform(0.8, 1.5) * (a + b) / np.linalg.norm(place)
    text += ball(d, 1, 32, 0.1) + d.marker(7, 1, tuple(place)) + ball(d, 2, 7, 0.1) + CONTACT
    found = told(text + d.run(1.0))
    assert bool(found) == (np.linalg.norm(place) > a + b + 0.2)
    results = adamslite.simulate(adamslite.read(text + d.run(1.0)), error=1e-6 * d.length)
    missed = re.search(r"CONTACT/1 by ([^,;]+)", results.meta.get("not reached", ""))
    if found:
        assert missed is not None
        assert float(missed[1]) > 0.99 * found["CONTACT/1"]


def test_a_long_chain_is_not_searched_without_end() -> None:
    """1000 links with a stop each: the ways to ground are 500 links long."""
    d = Drawn(0)
    text = d.head("Chain") + "MARKER/2, PART=1\n"
    for n in range(10, 1010):
        text += d.part(n, 1.0, (n, 0, 0), 0.3) + f"MARKER/{n}1, PART={n}, QP=-1,0,0\n"
        text += f"JOINT/{n}, SPHERICAL, I={n}1, J={n - 1}0\n" if n > 10 else ""
        text += STOP.format(n=n, f=f"IMPACT(DX({n}0,1),VX({n}0,1),-1E9,1E3,1.5,1,0.01)").replace(
            "I=32", f"I={n}0"
        )
    text = text.replace("JOINT/11,", "JOINT/10, SPHERICAL, I=101, J=2\nJOINT/11,", 1)
    deck = adamslite.read(text + d.run(1.0))
    model = Model(deck)
    reach = Reach(model)
    for n in range(10, 1010):
        list(reach.anchors(10 * n))
    assert reach.left == 0
    assert 0 < sum(each.code == "out-of-reach" for each in needless(deck)) < 1000

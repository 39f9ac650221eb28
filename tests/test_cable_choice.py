"""What `auto` picks for a cable scene, and the reasons it writes into the head of the deck."""

import re
from math import atan, ceil, cos, pi, sin, sqrt, tanh

import pytest
from descriptions import BELT, HOIST, PAYOUT
from scipy.optimize import brentq

from adamslite.cables.deck.scene import deck
from adamslite.cables.description.messages import Faults
from adamslite.cables.description.payout_law import parse, value

LIGHT = """
end = 1
[cable]
EA = 1e7
rho = 1e-4
[[route]]
kind = "mass"
at = [-0.2, -5, 0]
mass = 5
[[route]]
kind = "pulley"
at = [0, 0, 0]
radius = 0.2
inertia = 0.04
[[route]]
kind = "mass"
at = [0.2, -5, 0]
mass = 5
"""
# V^2/c^2 = 2 (e - e0) sqrt(e (1 + e)) - (e - e0)^2,  U = c sqrt(e (1 + e)) - c (e - e0)
E0 = 13e3 / 6e7
E = brentq(lambda e: 2 * (e - E0) * sqrt(e * (1 + e)) - (e - E0) ** 2 - 65**2 * 5.5 / 6e7, E0, 0.1)
KINK = ceil(7 / (sqrt(E * (1 + E)) - (E - E0)))
STRUCK = """
end = 0.01
gravity = [0, 0, 0]
[cable]
EA = 6e7
rho = 5.5
pretension = 13e3
[[route]]
kind = "fixed"
at = [-15, 0, 0]
[[route]]
kind = "mass"
at = [0, 0, 0]
mass = 1e9
velocity = [0, 65, 0]
[[route]]
kind = "fixed"
at = [15, 0, 0]
"""
ENGINE = HOIST.replace(PAYOUT, 'force = "9000*VARVAL(SD)*TIME"')
FAST = HOIST.replace("0.5*TIME", "10*TIME")
SLIPS = LIGHT.replace("radius = 0.2\n", "radius = 0.2\nmu = 0.3\n")


def head(spec: str) -> str:
    """The comments at the top of the deck, as one line."""
    text, _ = deck(spec)
    lines = text.split("\n\n")[0].splitlines()[1:]
    return " ".join(line.removeprefix("! ") for line in lines)


def chosen(spec: str) -> str:
    """The INTEGRATOR statement's method."""
    return re.search(r"INTEGRATOR/(\w+)", deck(spec)[0])[1]


@pytest.mark.parametrize(
    ("spec", "method", "says"),
    [
        (LIGHT, "GSTIFF", ["level 1: no estimate speaks against a rigid cable without mass"]),
        (
            STRUCK,
            "VERLET",
            [
                "not level 1: a weight starts across it at 65 m/s",
                "level 2: no cable goes over a wheel",
                f"{KINK} sections for a kink, 7 c/U",
                "VERLET: fronts in masses that nothing ties together",
            ],
        ),
        (
            HOIST,
            "GSTIFF",
            [
                "level 3: cable goes over wheels",
                "form paper: its estimates are all below 0.01",
                "1 section for tensions and places",
            ],
        ),
        (
            FAST,
            "HHT",
            ["form ale: the paper's misses 0.01 by rho (l s\" + s'^2)/(2 T) ="],
        ),
        (BELT, "HHT", ["form brute: the route is closed", "sections for (h/R)^2/24 on a rim"]),
        (
            SLIPS,
            "HHT",
            [
                "not level 1: the cable may slip on its wheels",
                "form ale: the paper's misses 0.01 by the cable may slip on its wheels",
                "HHT: friction that a small sliding speed builds up",
            ],
        ),
    ],
)  # fmt: skip
def test_the_head_says_why(spec: str, method: str, says: list[str]) -> None:
    assert chosen(spec) == method
    for sentence in says:
        assert sentence in head(spec)


def test_a_winch_with_an_engine_is_estimated_too() -> None:
    """The rigid cable is run, S and SD known to the force: its travel is among the figures."""
    assert re.search(r"travel 0 to [\d.]+ m, up to [\d.]+ m/s", head(ENGINE))


def hoist(law: str, reverse: bool) -> str:
    """The winch and its weight, listed from the winch on or from the weight on."""
    start, *stations = HOIST.replace(PAYOUT, law).split("[[route]]\n")
    if reverse:
        stations = [each.replace("turn = -1", "turn = 1") for each in reversed(stations)]
    return "[[route]]\n".join([start, *stations])


@pytest.mark.parametrize("reverse", [False, True])
@pytest.mark.parametrize("force", [5000, 12000])
def test_a_winch_lets_out_what_its_weight_pulls(reverse: bool, force: float) -> None:
    """(m + J/R^2 + rho L) s" = m g - F, up or down, at either end of the route; 400 steps of the
    estimate make s off by a 400th.
    """
    told = head(hoist(f'force = "{force}"', reverse))
    way = re.search(r"travel ([-\d.]+) to ([-\d.]+) m, up to ([\d.]+) m/s", told)
    least, most, speed = map(float, way.groups())
    rate = (1000 * 9.81 - force) / (1000 + 25 / 0.5**2 + 4 * 20)
    assert speed == pytest.approx(abs(rate) * 2, rel=1e-3)
    ends = sorted((0.0, rate * 2**2 / 2))
    assert [least, most] == pytest.approx(ends, rel=4e-3)


LAWS = {
    "SHF(TIME,0,0.5,2,0.1,0.3)": lambda t: 0.5 * sin(2 * t - 0.1) + 0.3,
    "POLY(TIME,0,1,2,3)": lambda t: 1 + 2 * t + 3 * t * t,
    "CHEBY(TIME,0,1,2,3)": lambda t: 1 + 2 * t + 3 * (2 * t * t - 1),
    "MOD(TIME,0.7)+ATAN(TIME)": lambda t: t % 0.7 + atan(t),
    "IF(TIME-1:2,3,5)": lambda t: 2 if t < 1 else 3 if t == 1 else 5,
    "STEP(TIME,0,1,2,4)": lambda t: 1 + 3 * (t / 2) ** 2 * (3 - t),
    "STEP5(TIME,0,1,2,4)": lambda t: 1 + 3 * (t / 2) ** 3 * (10 - 15 * t / 2 + 6 * (t / 2) ** 2),
    "HAVSIN(TIME,0,1,2,4)": lambda t: 1 + 3 * (1 - cos(pi * t / 2)) / 2,
    "MAX(1,TIME)-MIN(1,TIME)": lambda t: abs(1 - t),
    "IMPACT(1-TIME,-1,0.5,20,1,0,0)": lambda t: max(0.0, 20 * (t - 0.5)),
    "2**TIME/(1+TIME)-TANH(TIME)": lambda t: 2**t / (1 + t) - tanh(t),
}


@pytest.mark.parametrize("law", LAWS)
def test_a_law_is_worked_out_as_the_deck_does(law: str) -> None:
    node = parse(law, ("route", 0, "payout"), Faults("<text>"))
    for t in (0.0, 0.3, 1.0, 1.7):
        assert value(node, t, {}) == pytest.approx(LAWS[law](t), abs=1e-12)


def test_accuracy_asks_for_more() -> None:
    """(h/R)^2/24 < p/50: a tenth of p takes sqrt(10) times the sections, before rounding up."""
    found = []
    for p in ("0.01", "0.001"):
        told = head(BELT.replace("0.3, 0", "0.6, 0") + f"[model]\naccuracy = {p}\n")
        found.append(int(re.search(r"(\d+) sections for \(h/R\)", told)[1]))
    assert found[1] == pytest.approx(found[0] * 10**0.5, abs=10**0.5 + 1)

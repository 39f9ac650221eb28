"""Where a cable touches its wheels, and where its route meets itself."""

from itertools import combinations

import numpy as np
import pytest

from adamslite.cables.description.messages import Faults
from adamslite.cables.description.spec import read
from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import apart, reaches, spans, turned

HEAD = "end = 1\n{more}\n[cable]\nEA = 1e6\nrho = 0.1\npretension = 10\n"
WHEEL = '[[route]]\nkind = "{kind}"\nat = [{x}, {y}, 0]\nradius = {radius}\n{drive}\n'
DRIVEN = 'inertia = 1\npayout = "TIME"'


def loop(
    places: list[tuple[int, int]], winch: int, other: str, more: str, radius: float
) -> tuple[Spec, Faults]:
    """A belt round wheels, the one with the number `winch` driven."""
    text = HEAD.format(more="closed = true")
    for i, (x, y) in enumerate(places):
        kind, drive = ("winch", DRIVEN) if i == winch else (other, more)
        text += WHEEL.format(kind=kind, x=x, y=y, radius=radius, drive=drive)
    spec, faults = read(text, "<text>")
    return turned(spec), faults


@pytest.mark.parametrize("sense", [1, -1])
def test_the_wheels_of_a_loop_turn_as_it_runs_round(sense: int) -> None:
    """A triangle, against the clock and with it: the first and the last wheel too."""
    places = [(0, 0), (2, 0), (1, 2)][::sense]
    spec, _ = loop(places, 0, "pulley", "inertia = 1", 0.2)
    assert [each.turn for each in spec.route] == [sense] * 3


@pytest.mark.parametrize("seed", range(4))
def test_every_crossing_of_a_route_is_named(seed: int) -> None:
    """Forty small wheels at random: pairs of spans without a wheel in common that meet, each tried
    with each.
    """
    rng = np.random.default_rng(seed)
    wheels = "".join(
        WHEEL.format(kind="pulley", x=round(x, 3), y=round(y, 3), radius=1e-4, drive="inertia = 1")
        for x, y in rng.uniform(0, 10, (40, 2))
    )
    ends = '[[route]]\nkind = "fixed"\nat = [{}, 0, 0]\n'
    text = HEAD.format(more="") + ends.format(-1) + wheels + ends.format(11)
    spec, faults = read(text, "<text>")
    spec = turned(spec)
    found = spans(spec, faults)
    expected = {
        f"spans {a[0] + 1}-{a[1] + 1} and {b[0] + 1}-{b[1] + 1} meet"
        for (p, a), (q, b) in combinations(enumerate(spec.pairs), 2)
        if not {*a} & {*b} and apart(found[p], found[q]) < 1e-9
    }
    told = {each.message for each in faults.found if each.code == "crossing"}
    assert len(expected) > 20
    assert all(any(words in message for message in told) for words in expected)


def test_a_loop_that_begins_with_a_bend_is_one_reach_there() -> None:
    """Three bends and a driven wheel: from the wheel round to itself."""
    places = [(0, 0), (4, 0), (4, 3), (0, 3)]
    spec, faults = loop(places, 2, "bend", "", 0.5)
    (whole,) = reaches(spec, spans(spec, faults))
    assert whole == pytest.approx(2 * (4 + 3) + 3 * 0.5 * np.pi / 2)

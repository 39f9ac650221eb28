"""What `check` makes of a cable whose deck has no description, from its statements alone."""

import re
from typing import Any

import pytest

import adamslite
from adamslite.cables.deck.scene import chosen, deck, setting
from adamslite.cables.recognition.chain_finder import all_rows, damper
from adamslite.cables.recognition.chain_routes import routes
from adamslite.cables.recognition.posture import Posture
from adamslite.cables.recognition.recovery import Recovered, recovered
from adamslite.cables.recognition.report import about_cables, advice_on
from benchmarks.rope_scenes import KINDS, Draw, toml

# With the level that an elastic cable has there, and the number of a scene with a heavy weight.
FOUND = {
    "across": (2, 3), "hoist": (3, 3), "crane": (3, 3), "trolley": (2, 3), "heave": (2, 3),
    "atwood": (3, 3), "engine": (3, 3), "struck": (2, 4),
}  # fmt: skip


def described(kind: str, number: int = 3, **model: Any) -> str:
    """A random scene of a kind, with the sections that a chain takes."""
    return toml(KINDS[kind](Draw(5, number)) | {"model": {"accuracy": 0.01, **model}})


def statements(text: str) -> str:
    """The deck of a description without its comments."""
    return re.sub(r"(?m)^!.*\n|![^\n]*", "", deck(text)[0])


def route(text: str) -> Recovered:
    """The one route of a deck."""
    read = adamslite.read(text)
    posture = Posture(read)
    (found,) = routes(all_rows(read, posture), posture)
    run = read.of("SIMULATE")[0]
    whole = recovered(found, posture, run.end, run.steps)
    assert whole is not None
    return whole


@pytest.mark.parametrize("kind", FOUND)
def test_statements_amount_to_their_description(kind: str) -> None:
    """EA, rho, damping and the stations; and the model that follows."""
    level, number = FOUND[kind]
    text = described(kind, number, level=level, elements=3)
    asked, found = setting(text), route(statements(text))
    for name in ("stiffness", "density", "damping_time"):
        wanted = getattr(asked.spec.cable, name)
        assert getattr(found.spec.cable, name) == pytest.approx(wanted, rel=1e-6, abs=1e-9)
    ours, theirs = asked.spec.route, found.spec.route
    ours = ours if ours[0].is_free == theirs[0].is_free else ours[::-1]
    key = [(each.mass, each.radius, each.inertia, *each.velocity) for each in ours]
    got = [(each.mass, each.radius, each.inertia, *each.velocity) for each in theirs]
    by_size = sorted(key), sorted(got)
    assert [v for row in by_size[1] for v in row] == pytest.approx(
        [v for row in by_size[0] for v in row], rel=1e-4, abs=1e-6
    )
    free = setting(described(kind, number))
    model, choice = found.chosen(0.01), chosen(free, free.faults)
    assert (model.level, model.form, model.elements, model.method) == (
        choice.level, choice.form, choice.elements, choice.method,
    )  # fmt: skip


def same(one: str, other: str) -> bool:
    """Whether two decks get the same advice."""
    a, b = (advice_on(adamslite.read(text), 0.01) for text in (one, other))
    assert a is not None and b is not None
    return (a.level, a.form, a.elements, a.integrator) == (
        b.level, b.form, b.elements, b.integrator,
    )  # fmt: skip


def test_names_of_variables_and_ids_do_not_matter() -> None:
    """Nothing is found by what `cable` calls it."""
    text = statements(described("hoist", level=3, elements=3))
    other = re.sub(r"\b(EA|rho|tau|S1|SD1|SDD1|LT1|H1|Dm1)\b", r"Q\1", text)
    other = re.sub(r"\b(100[0-9])\b", r"7\1", other)
    assert "QLT1" in other and "SFORCE/71002" in other
    assert same(other, text)


def struck(metre: float = 1.0, length: str = "METER", axis: int = 0, first: int = 1) -> str:
    """Statements of 20 kg between two anchors on 2 x 6 m of 0.2 kg/m, struck at 3 m/s."""
    n, ea, tension, half = 4, 2e5, 2e3, 6.0
    drawn = half / n
    free, mass = drawn / (1 + tension / ea), 0.2 * drawn / (1 + tension / ea)
    spring = f"FUNCTION=-{ea / free / metre!r}*(DM({{i}},{{j}})-{free * metre!r})"
    lines, x, y = [], "XYZ"[axis], "XYZ"[(axis + 1) % 3]
    for k in range(2 * n + 1):
        key, place = first + k, ["0", "0", "0"]
        place[axis] = repr((k * drawn - half) * metre)
        at = ",".join(place)
        if k in (0, 2 * n):
            lines.append(f"MARKER/{key}, PART=1, QP={at}")
        else:
            own, start = (20 + mass, f", V{y}={3 * metre!r}") if k == n else (mass, "")
            lines.append(f"POINT_MASS/{key}, MASS={own!r}, CM={key}, QG={at}{start}")
            lines.append(f"MARKER/{key}, POINT_MASS={key}")
        if k:
            lines.append(f"SFORCE/{key}, I={key - 1}, J={key}, {spring.format(i=key - 1, j=key)}")
    assert x != y
    return "\n".join(lines)


def whole(length: str, *parts: str) -> str:
    """A deck of statements."""
    head = f"t\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={length}, TIME=SECOND\n"
    run = "INTEGRATOR/GSTIFF\nSIMULATE/DYNAMIC, END=0.05, STEPS=200\nEND\n"
    return f"{head}PART/1, GROUND\n" + "\n".join(parts) + "\n" + run


def test_units_and_directions_do_not_matter() -> None:
    """The lines of a deck in millimetres, and along y, are those of one in metres along x."""
    lines = about_cables(adamslite.read(whole("METER", struck())))
    assert lines[0] == "  cable from MARKER/1 by POINT_MASS/5 to MARKER/9"
    millimetres = whole("MILLIMETER", struck(1000.0))
    assert about_cables(adamslite.read(millimetres)) == lines
    assert about_cables(adamslite.read(whole("METER", struck(axis=1)))) == lines


def test_two_cables_of_a_deck() -> None:
    """Two that are alike share their lines."""
    two = about_cables(adamslite.read(whole("METER", struck(), struck(first=101))))
    (one, *lines) = about_cables(adamslite.read(whole("METER", struck())))
    assert two[0] == f"{one}, from MARKER/101 by POINT_MASS/105 to MARKER/109"
    assert two[1:] == lines


@pytest.mark.parametrize(
    "more",
    [
        "VFORCE/99, I=3, J_PART=1, FX=0\\, FY=-2*VY(3)\\, FZ=0",  # water on a node
        "SFORCE/99, I=5, J=1, FUNCTION=-100*VR(5,1)",  # a damper at the weight
        "GCON/99, FUNCTION=DZ(5,1)",
    ],
)
def test_what_else_acts_is_no_part_of_a_description(more: str) -> None:
    """The advice then rests on rules; forces on the nodes of the cable are reported."""
    lines = about_cables(adamslite.read(whole("METER", struck(), more)))
    assert not any("because" in line for line in lines)
    assert any("forces     on its nodes" in line for line in lines) == ("I=3" in more)


def test_a_damper_in_a_vforce_counts() -> None:
    """Of three components, along a line that leans."""
    places = ("0,0,0", "3,-4,0", "6,-8,0", "9,-12,0")
    lines = [f"MARKER/1, PART=1, QP={places[0]}"]
    for k, place in enumerate(places[1:], 2):
        force = "\\, ".join(
            f"F{a}=-(5e4*(1-4.9/DM({k},{k - 1}))+30*VR({k},{k - 1})/DM({k},{k - 1}))"
            f"*D{a}({k},{k - 1})" for a in "XYZ"
        )  # fmt: skip
        lines += [f"POINT_MASS/{k}, MASS=1, CM={k}, QG={place}", f"MARKER/{k}, POINT_MASS={k}",
                  f"VFORCE/{k}, I={k}, J_PART=1, {force}"]  # fmt: skip
    read = adamslite.read(whole("METER", *lines))
    posture = Posture(read)
    (chain,) = all_rows(read, posture)
    assert [damper(link, posture) for link in chain.links] == pytest.approx([30.0] * 3)

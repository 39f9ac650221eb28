"""Everything `adamslite cable` can say, each provoked by a description that is wrong in one way."""

from pathlib import Path

import pytest
import reeving_mistakes
import water_mistakes
from descriptions import ATWOOD, BELT, HOIST, PAYOUT, WIRE, folded, hung

import adamslite
from adamslite.api.trials import described
from adamslite.cables.deck.scene import deck
from adamslite.cables.description.messages import MESSAGES
from adamslite.cli.main import main
from adamslite.language.diagnostics import WARNING, Diagnostic
from adamslite.progress import Progress

#: With the form they are written in, on the last line.
LOWERS = HOIST + "[model]\nlevel = 3\n"
LOWERS_ROPE = LOWERS.replace("rho = 4", "rho = 4\npulls_only = true")
DRIVES = BELT + "[model]\nelements = 6\n"
CHAIN = DRIVES.replace(
    'kind = "pulley"\nat = [0.3, 0, 0]\nradius = 0.1',
    """\
kind = "pulley"
at = [0.52, 0, 0]
radius = 0.1
teeth = 12""",
).replace("radius = 0.1\ninertia = 0.1\npay", "radius = 0.1\nteeth = 12\ninertia = 0.1\npay")
FOLD = folded(0.49, 0.01, "free", end=1)
BEAD = (
    WIRE.format(kind='"mass"', haul="")
    .replace("[1.6, 1.2, 0]", "[3, 1, 0]")
    .replace("velocity = [0.8, 0.6, 0]\n", "")
)
ZERO = "at = [0, 0, 0]"
WOUND = (
    ZERO
    + """
radius = 0.1
inertia = 0.1
payout = "TIME"
turn = 1
mu = 1"""
)
SLIPPING = ATWOOD.replace("radius = 0.2", "radius = 0.2\nmu = 0.3", 1)
HANGS = (
    hung(end=0.1, cable="EA = 1e7\nrho = 0.1", at=(0, -20), mass=200)
    + "velocity = [0, 0, 0]\n[model]\nlevel = 2\n"
)
#: Its lighter weight goes up by its 5 m in 2.26 s.
RUNS_IN = ATWOOD.replace("end = 0.5", "end = 2.5\nsteps = 20")
LAST = ATWOOD.index("[[route]]", ATWOOD.index("1.8"))
# Code: (description, what is replaced, by what, the line and column of the caret).
WRONG = reeving_mistakes.MISTAKES | water_mistakes.MISTAKES | {
    "toml": (ATWOOD, "EA = 1e7", "EA = ", (3, 1)),
    "unknown-key": (ATWOOD, "rho = 0.01", "rho = 0.01\nrhu = 2", (5, 1)),
    "missing-key": (ATWOOD, "mass = 5\n", "", (5, 1)),
    "wrong-value": (ATWOOD, "mass = 5", 'mass = "5"', (8, 1)),
    "not-positive": (ATWOOD, "EA = 1e7", "EA = -1e7", (3, 1)),
    "not-a-share": (ATWOOD, "rho = 0.01", "rho = 0.01\ndamping = 2", (5, 1)),
    "damped-twice": (
        ATWOOD, "rho = 0.01", "rho = 0.01\ndamping = 0.1\ndamping_time = 1e-4", (5, 1)
    ),
    "negative": (ATWOOD, "rho = 0.01", "rho = 0.01\npretension = -1", (5, 1)),
    "short-route": (ATWOOD[:LAST], ATWOOD[ATWOOD.index('kind = "pulley"') - 10 : LAST], "", (5, 1)),
    "wrong-end": (ATWOOD, 'kind = "mass"\nat = [2, -5, 0]\nmass = 3', 'kind = "pulley"\n'
                  "at = [2, -5, 0]\nradius = 0.1\ninertia = 1", (20, 1)),
    "run-to-run": (
        ATWOOD[: ATWOOD.index("[[route]]")],
        "rho = 0.01\n",
        "rho = 0.01\n" + '[[route]]\nkind = "run"\nat = [0, 0, 0]\n'
        + '[[route]]\nkind = "run"\nat = [1, 0, 0]\n',
        (9, 1),
    ),
    "drive": (LOWERS, PAYOUT, "", (5, 1)),
    "reel-between": (ATWOOD, 'kind = "pulley"', 'kind = "winch"\ntorque = "0"\n'
                     "reel = { thickness = 0.01, core = 0.1 }", (12, 1)),
    "reel-core": (LOWERS, PAYOUT, PAYOUT + "\nreel = { thickness = 0.01, core = 0.5 }", (12, 1)),
    "moved-twice": (ATWOOD, "radius = 0.2", 'radius = 0.2\nmass = 2\nmotion = ["TIME**2", 0, 0]',
                    (14, 1)),
    "no-carriage": (ATWOOD, "radius = 0.2", "radius = 0.2\nslide = [1, 0, 0]", (13, 1)),
    "no-slide": (ATWOOD, "radius = 0.2", 'radius = 0.2\nmass = 2\npull = "10"', (14, 1)),
    "expression": (LOWERS, PAYOUT, 'payout = "0.5*TIM**2"', (11, 1)),
    "law-start": (LOWERS, PAYOUT, 'payout = "1+TIME**2"', (11, 1)),
    "law-no-value": (LOWERS, PAYOUT, 'payout = "1-SQRT(1-TIME)"', (11, 1)),
    "payout-too-far-in": (LOWERS, PAYOUT, 'payout = "-6*TIME**2"', (11, 1)),
    "zero-span": (ATWOOD, "[1.8, 0, 0]", "[0.2, 0, 0]", (16, 1)),
    "radius-over-spacing": (ATWOOD, "[1.8, 0, 0]", "[0.5, 0, 0]", (16, 1)),
    "crossing": (ATWOOD, "[2, -5, 0]", "[-2, -1, 0]", (16, 1)),
    "axis-along-cable": (ATWOOD, "radius = 0.2", "radius = 0.2\naxis = [1, 0, 0]", (13, 1)),
    "too-many": (LOWERS, "level = 3", "elements = 1000", (17, 1)),
    "form-has-level": (ATWOOD, "level = 1", 'level = 1\nform = "ale"', (25, 1)),
    "needs-brute": (DRIVES, "elements = 6", "level = 1", (20, 1)),
    "brute-no-wheel": (ATWOOD[: ATWOOD.index("[[route]]\nkind = \"pulley\"")] + ATWOOD[LAST:],
                       "level = 1", 'form = "brute"', (14, 1)),
    "mount-moves": (ATWOOD, "radius = 0.2", "radius = 0.2\nmass = 2\n"
                    "mount = { foot = [0, 1, 0], mass = 5 }", (14, 1)),
    "reel-leans": (LOWERS, PAYOUT, PAYOUT + "\nreel = { thickness = 0.01, core = 0.1 }\n"
                   "leans = true", (13, 1)),
    "brute-cannot": (LOWERS, PAYOUT, PAYOUT + "\nreel = { thickness = 0.01, core = 0.1 }", (12, 1)),
    "brute-plane": (LOWERS, "level = 3", 'gravity = [0, -9, 1]', (18, 1)),
    "overstretched": (LOWERS, "EA = 2e7", "EA = 2e3", (3, 1)),
    "bend-too-tight": (FOLD, "radius = 0.01", "radius = 0.005", (13, 1)),
    "speed-on-a-route": (FOLD, "end = 1", "end = 1\nspeed = 3", (2, 1)),
    "slides-between": (BEAD.replace("fixed", "winch", 1).replace(ZERO, WOUND, 1), "", "", (19, 1)),
    "no-slider": (BEAD, "slides = true", 'haul = "TIME"', (14, 1)),
    "slider-form": (BEAD, "level = 1", "level = 2", (14, 1)),
    "pitches": (CHAIN, "teeth = 12\ninertia = 0.1\n[model]", "teeth = 13\ninertia = 0.1\n[model]",
                (18, 1)),
    "loop-of-links": (CHAIN, "[0.52, 0, 0]", "[0.53, 0, 0]", (17, 1)),
    "rigid-cannot": (ATWOOD, "radius = 0.2", "radius = 0.2\nmu = 0.3", (13, 1)),
    "stored-too-little": (LOWERS, PAYOUT, PAYOUT + '\nstored = 1', (12, 1)),
    "level-2-pays-out": (LOWERS, "level = 3", "level = 2\nelements = 40", (17, 1)),
    "level-2-unknown": (SLIPPING, "level = 1", "level = 2", (25, 1)),
    "rigid-has-waves": (ATWOOD, "mass = 3", "mass = 3\nvelocity = [10, 0, 0]", (25, 1)),
    "breaking": (ATWOOD, "rho = 0.01", "rho = 0.01\nbreaking_load = 40", (5, 1)),
    "paper-not-valid": (LOWERS, "level = 3", 'level = 3\nform = "paper"\naccuracy = 1e-4', (18, 1)),
    "faster-than-waves": (LOWERS_ROPE, "0.5*TIME**2", "60*TIME**2", (18, 1)),
    "slackens": (HANGS, "velocity = [0, 0, 0]", "velocity = [0, 2, 0]", (2, 1)),
    "goes-slack": (HANGS, "velocity = [0, 0, 0]", "velocity = [0, 2, 0]", (2, 1)),
    "unsettled": (LOWERS, "level = 3", "level = 3\naccuracy = 0.01\ntrial = 1e-3", (18, 1)),
    "does-not-end": (RUNS_IN.replace("inertia = 0.04", "inertia = 0.04\nfriction = 1e-3", 1),
                     "level = 1", "level = 3\nelements = 1", (25, 1)),
    "runs-into-wheel": (RUNS_IN, "", "", (22, 1)),
    "pretension": (HANGS, "rho = 0.1", "rho = 0.1\npretension = 2500", (5, 1)),
    "pushed": (LOWERS, "0.5*TIME**2", "6*TIME**2", (11, 1)),
    "pushed-at-once": (LOWERS, "0.5*TIME**2", "2*TIME", (11, 1)),
}  # fmt: skip
#: What only runs show.
TRIED = {"goes-slack", "unsettled", "does-not-end"}
BRUTE = {"stored-too-little", "brute-plane", "brute-cannot", "overstretched"}


def told(spec: str, tried: bool = False) -> list[Diagnostic]:
    """All messages about a description."""
    try:
        if tried:
            return described(spec, "scene.toml", None, Progress()).deck.messages
        return deck(spec, "scene.toml")[1]
    except adamslite.DeckError as fault:
        return list(fault.diagnostics)


def provoked(code: str) -> str:
    """The description that is wrong as `code` says."""
    spec, old, new, _ = WRONG[code]
    assert old in spec
    changed = spec.replace(old, new, 1)
    if code == "brute-plane":
        changed = "gravity = [0, -9, 1]\n" + spec
    return changed.replace("level = 3", 'form = "brute"') if code in BRUTE else changed


def test_every_message_has_a_description_here() -> None:
    assert set(WRONG) == set(MESSAGES)


@pytest.mark.parametrize("code", WRONG)
def test_a_mistake_is_told_where_it_stands(code: str) -> None:
    """Its code alone, at its line and column, with the line and a hint."""
    found = told(provoked(code), code in TRIED)
    assert [each.code for each in found] == [code]
    only, line, column = found[0], *WRONG[code][3]
    assert (only.span.file, only.span.line, only.span.column) == ("scene.toml", line, column)
    assert only.severity == MESSAGES[code].severity
    assert only.source_line == provoked(code).splitlines()[line - 1]
    assert only.hint


def test_everything_wrong_is_told_at_once() -> None:
    """A table that cannot be read hides neither the others nor what the route does."""
    spec = ATWOOD.replace("EA = 1e7", "EA = 0").replace("[1.8, 0, 0]", "[0.5, 0, 0]")
    spec = spec.replace("level = 1", "level = 4\nacuracy = 0.1").replace("end = 0.5", "end = -1")
    found = [(each.code, each.span.line) for each in told(spec)]
    assert found == [
        ("not-positive", 1), ("not-positive", 3), ("radius-over-spacing", 16),
        ("wrong-value", 24), ("unknown-key", 25),
    ]  # fmt: skip
    assert MESSAGES["rigid-has-waves"].severity == WARNING


@pytest.mark.parametrize(
    ("written", "wrong", "said"),
    [
        ("EA = 1e7", "ea = 1e7", ["missing-key", "unknown-key"]),
        ("[cable]", "[Cable]", ["unknown-key", "missing-key", "missing-key"]),
        ("[cable]", "[[cable]]", []),
        (
            "[cable]\nEA = 1e7",
            "cable = [3]\n[kable]\nEA = 1e7",
            ["wrong-value", "missing-key", "missing-key", "unknown-key"],
        ),
        ("level = 1", "accuracy = 0", ["not-positive"]),
        ("end = 0.5", 'end = 0.5\ntitle = "two\\nlines"', ["wrong-value"]),
        ("end = 0.5", "\ufeffend = 0.5", ["toml"]),
    ],
)
def test_slips_of_all_kinds_are_told(written: str, wrong: str, said: list[str]) -> None:
    """A key in small letters, an accuracy of 0, a title that would break the deck."""
    found = [each.code for each in told(ATWOOD.replace(written, wrong))]
    assert sorted(found) == sorted(said)


def test_a_byte_order_mark_is_no_part_of_a_description(tmp_path: Path, capsys) -> None:
    path = tmp_path / "scene.toml"
    path.write_text("\ufeff" + ATWOOD, encoding="utf-8")
    assert main(["cable", str(path)]) == 0


def test_the_command_prints_places_and_ends_with_3(tmp_path: Path, capsys) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(ATWOOD.replace("[1.8, 0, 0]", "[0.5, 0, 0]"), encoding="utf-8")
    assert main(["cable", str(path)]) == 3
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(
        f"{path}:16:1: error: the wheels of stations 2 and 3 reach over their spacing of 0.3 m: no"
        " cable fits between [radius-over-spacing]\n"
        "  16 | at = [0.5, 0, 0]\n"
        "     | ^^^^^^^^^^^^^^^^\n"
        "    = smaller radii, or stations further apart\n"
    )


@pytest.mark.parametrize(
    ("payout", "cable", "load", "told"),
    [
        ("4*TIME**2", "", "", set()),
        ("6*TIME**2", "", "", {"pushed"}),
        ("6*TIME**2", "pulls_only = true\n", "", set()),
        ("2*TIME+4*TIME**2", "", "", {"pushed-at-once"}),
        ("2*TIME+4*TIME**2", "", "velocity = [0, -2, 0]\n", set()),
        ("-6*TIME**2", "", "", set()),
    ],
)
def test_a_winch_that_outruns_its_load_pushes(payout, cable, load, told) -> None:
    """A load falls by g t^2/2 = 4.9 t^2; payout beyond that is slack."""
    text = HOIST.replace("0.5*TIME**2", payout).replace("end = 2", "end = 1")
    text = text.replace("rho = 4\n", "rho = 4\n" + cable) + load + "[model]\nlevel = 3\n"
    found = {each.code for each in deck(text)[1]}
    assert found & {"pushed", "pushed-at-once"} == told


#: A cable over a wheel that is carried across it, to a load.
SWEPT = """\
end = 1
[[cable]]
EA = 1e6
rho = 0.1
[[load]]
at = [2, -5, 0]
mass = 50
[[route]]
kind = "fixed"
at = [0, 0.2, 0]
[[route]]
kind = "pulley"
at = [1.8, 0, 0]
radius = 0.2
inertia = 1
motion = ["0.1*TIME**2", "", ""]
[[route]]
kind = "hook"
at = [2, -5, 0]
"""
LEANING = SWEPT.replace("motion = ", "leans = true # ")
POINT = "inertia is missing: a load without it is a point, held at its mass centre, and "


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        (SWEPT, "the wheel of station 2 moves across its cable: only form brute represents that;"
                " form brute is written for one cable without [[load]]"),
        (SWEPT + '[model]\nform = "brute"\n', "form = brute is given; form brute is written for"
                                             " one cable without [[load]]"),
        (LEANING, ""),
        (reeving_mistakes.ROUND.replace("\ninertia = 5", ""), POINT + "station 2 is a wheel on it"),
        (LEANING.replace("[2, -5, 0]", "[2, -6, 0]", 1), POINT + "station 3 is 1 m from there"),
        (LEANING.replace("mass = 50", "mass = 50\npivot = { at = [2, -5, 0] }"),
         POINT + "this one turns about a hinge"),
        (ATWOOD.replace("rho = 0.01", "rho = 0.01\ndamping = 1.0"),
         "damping has to be at least 0 and below 1, and is 1.0"),
        (ATWOOD.replace("level = 1", "accuracy = 1"),
         "accuracy has to be at least 0 and below 1, and is 1"),
    ],
)  # fmt: skip
def test_a_message_gives_the_reason_that_holds(spec: str, said: str) -> None:
    """A cable with a load and no form, a load without inertia, a share of exactly 1."""
    assert [each.message for each in told(spec)] == [said] * bool(said)


@pytest.mark.parametrize("value", ["1e-300", "1e51", "-1e60", "inf"])
@pytest.mark.parametrize("key", ["EA = 1e7", "rho = 0.01", "mass = 3"])
def test_numbers_no_product_of_which_is_a_number_are_refused(key: str, value: str) -> None:
    """Sizes from 1e-50 to 1e50 are numbers of an engineer, in whatever units."""
    name = key.split(" = ")[0]
    only, *others = told(ATWOOD.replace(key, f"{name} = {value}", 1))
    assert (only.code, others) == ("wrong-value", [])
    assert "1e-50 to 1e+50" in only.message


@pytest.mark.parametrize("law", ["1e60*TIME", "TIME**400", "EXP(999*TIME)"])
def test_a_payout_beyond_all_numbers_is_refused(law: str) -> None:
    assert [each.code for each in told(HOIST.replace("0.5*TIME**2", law))] == ["law-no-value"]


def test_a_cable_that_sags_by_more_than_its_length_is_refused() -> None:
    """From a drum 1e50 m away."""
    spec = LOWERS.replace("at = [-0.5, 0, 0]", "at = [0, 1e50, 1e-9]")
    assert [each.code for each in told(spec)] == ["overstretched"]

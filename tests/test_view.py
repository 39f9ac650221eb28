"""`adamslite view` and `solve --page`: which deck is drawn, what is written, what is rejected."""

from __future__ import annotations

import webbrowser
from pathlib import Path

import numpy as np
import pytest
from page_scenes import decoded, named, scene_of

import adamslite as al
from adamslite.cables.deck.scene import deck as cable_deck
from adamslite.cli.main import main
from adamslite.page.page import page
from adamslite.resources import find
from adamslite.results.results import Results

DECK = """A falling mass </script><!-- {{data}}
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1
MARKER/2, POINT_MASS=2
SIMULATE/DYNAMIC, END=1, STEPS=10
END
"""
OTHER = DECK.replace("POINT_MASS/2,", "POINT_MASS/3,").replace("POINT_MASS=2", "POINT_MASS=3")
TIME = np.linspace(0, 1, 11)


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """A folder of its own with a deck and its results; the addresses that a browser opens."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("DISPLAY", ":0")
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", lambda url: opened.append(url) or True)
    Path("fall.adm").write_text(DECK)
    fall().save("fall.csv")
    return opened


def fall(**changes: object) -> Results:
    """y = -5 t^2 of POINT_MASS/2."""
    meta = {"deck": "A falling mass", "deck hash": al.read(DECK).hash}
    values = np.stack([0 * TIME, -5 * TIME**2, 0 * TIME], axis=1)
    names = ("POINT_MASS/2.x", "POINT_MASS/2.y", "POINT_MASS/2.z")
    return Results(**{"time": TIME, "names": names, "values": values, "meta": meta, **changes})


def last_y(page: str) -> float:
    drawn = scene_of(Path(page).read_text(encoding="utf-8"))
    (body,) = (each for each in drawn.plain["bodies"] if each["kind"] == "point_mass")
    return float(decoded(drawn, body["position"])[-1, 1])


def test_a_result_is_drawn_with_the_deck_beside_it_and_opened(here: list[str]) -> None:
    assert main(["view", "fall.csv"]) == 0
    assert here == [Path("fall.html").resolve().as_uri()]
    assert last_y("fall.html") == pytest.approx(-5)


def test_with_a_name_the_page_is_written_only(here: list[str]) -> None:
    assert main(["view", "fall.csv", "-o", "Seil & Last ü.html"]) == 0
    assert main(["view", "fall.csv", "--no-open"]) == 0
    assert here == [] and last_y("Seil & Last ü.html") == last_y("fall.html")


def test_a_deck_of_another_name_is_found_by_its_hash() -> None:
    Path("fall.adm").rename("tower.adm")
    Path("fallen.adm").write_text(OTHER)
    assert main(["view", "fall.csv"]) == 0
    assert last_y("fall.html") == pytest.approx(-5)


def test_results_that_carry_their_deck_need_no_other() -> None:
    """A result of `solve` in NetCDF, taken to an empty folder; the deck of that name is another."""
    assert main(["solve", "fall.adm", "-o", "run.nc", "--quiet"]) == 0
    Path("run.adm").write_text(OTHER)
    assert main(["view", "run.nc"]) == 0
    assert last_y("run.html") == pytest.approx(-5, rel=1e-4)


def test_a_deck_is_solved_first() -> None:
    assert main(["view", "fall.adm", "--end", "2", "--no-open"]) == 0
    assert last_y("fall.html") == pytest.approx(-20, rel=1e-4)


def test_a_run_that_stops_early_is_shown_as_far_as_it_went(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """1/(1 - t) has no value at t = 1."""
    law = "SFORCE/1, I=2, J=1, ACTIONONLY, FUNCTION=SQRT(0.5-TIME)\nSIMULATE"
    Path("stop.adm").write_text(DECK.replace("SIMULATE", law))
    assert main(["view", "stop.adm"]) == 4
    assert "adamslite: " in capsys.readouterr().err
    drawn = scene_of(Path("stop.html").read_text(encoding="utf-8"))
    assert decoded(drawn, drawn.plain["times"])[-1] < 0.6
    assert drawn.plain["events"][-1]["text"]


def test_a_title_cannot_leave_its_place() -> None:
    """Neither as an element of the page nor as a word that is replaced."""
    main(["view", "fall.csv", "-o", "fall.html"])
    text = Path("fall.html").read_text(encoding="utf-8")
    assert "</script><!-- {{data}}" not in text
    assert "&lt;/script&gt;&lt;!-- {{data}}" in text
    assert scene_of(text).plain["title"] == DECK.partition("\n")[0]


def test_solve_writes_a_page_beside_its_results(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "fall.adm", "-o", "a.nc", "--page"]) == 0
    assert "  page                 a.html\n" in capsys.readouterr().err
    assert main(["solve", "fall.adm", "--page", "b.html", "--quiet"]) == 0
    assert last_y("a.html") == last_y("b.html") == pytest.approx(-5, rel=1e-4)


def test_a_crane_of_143_bodies_is_less_than_a_megabyte_and_a_half() -> None:
    """A rope of 140 sections at 401 times, with all of its 1887 channels."""
    spec = (find("decks") / "cables" / "described" / "crane.toml").read_text(encoding="utf-8")
    fine = spec.replace("level = 1", "level = 3\nelements = 140").replace(
        "steps = 120", "steps = 400"
    )
    text, _ = cable_deck(fine.replace("error = 1e-7", "error = 1e-4"))
    results = al.simulate(al.read(text))
    drawn = page(results)
    plain = scene_of(drawn).plain
    assert len(plain["bodies"]) == 143 and results.values.shape == (401, 1887)
    assert len(drawn.encode()) < 1_500_000


# ---- two results -----------------------------------------------------------------------------


def test_a_reference_is_drawn_beside_the_results() -> None:
    """It has y alone, half as far: x and z are those of the results."""
    Path("ref.csv").write_text("# tolerance: rel 1\ntime,POINT_MASS/2.y\n0,0\n0.5,-0.5\n1,-2\n")
    assert main(["view", "fall.csv", "--against", "ref.csv", "--no-open"]) == 0
    drawn = scene_of(Path("fall.html").read_text(encoding="utf-8"))
    against = drawn.plain["against"]
    assert against["name"] == "ref.csv" and against["bodies"][0] is None
    position = decoded(drawn, against["bodies"][1]["position"])
    assert position == pytest.approx(np.array([[0, 0, 0], [0, -0.5, 0], [0, -2, 0]]), abs=1e-4)
    assert decoded(drawn, against["times"]) == pytest.approx([0, 0.5, 1])
    channel = named(against["channels"]["list"], "POINT_MASS/2.y")
    assert decoded(drawn, channel["values"]) == pytest.approx([0, -0.5, -2])


def test_bodies_that_the_other_results_lack_are_none() -> None:
    """Two masses, of which the reference has the second."""
    text = DECK.replace("SIMULATE", "POINT_MASS/7, MASS=1\nMARKER/7, POINT_MASS=7\nSIMULATE")
    Path("fall.adm").write_text(text)
    names = tuple(f"POINT_MASS/{k}.{x}" for k in (2, 7) for x in "xyz")
    fall(names=names, values=np.zeros((11, 6)), meta={}).save("fall.csv")
    Path("ref.csv").write_text("time,POINT_MASS/7.y\n0,0\n1,1\n")
    assert main(["view", "fall.csv", "--against", "ref.csv"]) == 0
    drawn = scene_of(Path("fall.html").read_text(encoding="utf-8"))
    ground, first, second = drawn.plain["against"]["bodies"]
    assert ground is first is None
    assert decoded(drawn, second["position"])[:, 1] == pytest.approx([0, 1], abs=1e-4)


def test_columns_that_were_not_selected_are_those_of_the_deck() -> None:
    """y alone: the mass falls from x = 0, z = 0, with a note."""
    words = ["solve", "fall.adm", "-o", "y.nc", "--quiet", "--outputs", "POINT_MASS/2.y"]
    assert main(words) == 0
    assert main(["view", "y.nc"]) == 0
    drawn = scene_of(Path("y.html").read_text(encoding="utf-8"))
    position = decoded(drawn, drawn.plain["bodies"][1]["position"])
    assert position[-1] == pytest.approx([0, -5, 0], rel=1e-4)
    assert (
        "not all coordinates are in the results, drawn with the deck's: POINT_MASS/2"
        in (drawn.plain["notes"])
    )


def test_nothing_that_moves_is_selected(capsys: pytest.CaptureFixture[str]) -> None:
    """Results of this very deck, without its only body."""
    fall(names=("VARIABLE/1", "VARIABLE/2", "VARIABLE/3")).save("fall.csv")
    assert main(["view", "fall.csv"]) == 5
    assert sentence(capsys) == (
        "adamslite: fall.csv has no position of a body, and nothing would move"
    )


# ---- mistakes --------------------------------------------------------------------------------


def sentence(capsys: pytest.CaptureFixture[str]) -> str:
    """The only line on standard error."""
    (line,) = capsys.readouterr().err.splitlines()
    assert not Path("fall.html").exists()
    return line


@pytest.mark.parametrize(
    ("words", "code", "expected"),
    [
        (["fall.csv", "--deck", "other.adm"], 5, "fall.csv is no result of other.adm"),
        (["alone/alone.csv"], 2, "alone/alone.csv carries no deck"),
        (["empty.csv"], 2, "empty.csv carries no deck"),
        (["empty.csv", "--deck", "fall.adm"], 5, "it has no output time"),
        (["none.csv"], 5, "none.csv"),
        (["binary.csv"], 5, "binary.csv is not a table"),
        (["words.csv"], 5, "words.csv"),
        (["fall.csv", "--against", "strange.csv"], 5, "strange.csv has no channel of these"),
        (["fall.csv", "--against", "empty.csv"], 5, "empty.csv has no output time"),
        (["fall.csv", "--against", "none.csv"], 5, "none.csv"),
        (["fall.csv", "--glb", "--against", "fall.csv"], 2, "a model shows one result"),
        (["fall.csv", "-o", "fall.csv"], 2, "-o fall.csv"),
        (["fall.csv", "-o", "x.pdf"], 2, "x.pdf"),
        (["fall.csv", "-o", "away/x.html"], 5, "no such folder"),
        (["fall.csv", "--end", "2"], 2, "fall.csv is a result file: there is nothing to solve"),
        (["fall.csv", "fall.acf"], 2, "fall.csv is a result file: there is nothing to solve"),
        (["fall.adm", "--deck", "fall.adm"], 2, "--deck belongs to a result file"),
    ],
)
def test_mistakes_are_one_sentence(
    words: list[str], code: int, expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("other.adm").write_text(OTHER)
    Path("alone").mkdir()
    fall(meta={}).save("alone/alone.csv")
    Path("empty.csv").write_text("")
    Path("binary.csv").write_bytes(b"\xff\xfe\x00\x80")
    Path("words.csv").write_text("The quick brown fox\n")
    Path("strange.csv").write_text("time,PART/9.x\n0,1\n")
    assert main(["view", *words]) == code
    assert expected in sentence(capsys)


@pytest.mark.parametrize("words", [["-o", "fall.adm.txt"], ["-o", "away/x.html"],
                                   ["--against", "none.csv"]])  # fmt: skip
def test_nothing_is_solved_when_it_could_not_be_shown(
    words: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    solved: list[object] = []
    monkeypatch.setattr(al, "simulate", lambda *args, **options: solved.append(args))
    assert main(["view", "fall.adm", *words]) in (2, 5)
    assert solved == []


def test_a_stored_run_that_stopped_early_says_so() -> None:
    """The view itself has succeeded: 0."""
    text = (
        Path("fall.csv")
        .read_text()
        .replace("time,", "# outcome: STEP_TOO_SMALL JOINT/1 came apart\ntime,", 1)
    )
    Path("fall.csv").write_text(text)
    assert main(["view", "fall.csv"]) == 0
    plain = scene_of(Path("fall.html").read_text(encoding="utf-8")).plain
    assert plain["outcome"] == "JOINT/1 came apart"
    assert plain["events"][-1]["time"] == 1.0


def test_a_page_does_not_overwrite_what_was_read(capsys: pytest.CaptureFixture[str]) -> None:
    Path("fall.adm").rename("deck.html")
    assert main(["view", "fall.csv", "--deck", "deck.html", "-o", "deck.html"]) == 2
    assert "is read, and would be written over" in sentence(capsys)
    assert Path("deck.html").read_text() == DECK


def test_a_deck_that_has_changed_is_drawn_with_a_word(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("fall.adm").write_text(DECK.replace("JGRAV=-10", "JGRAV=-9.81"))
    assert main(["view", "fall.csv"]) == 0
    assert "the deck is not the one of these results" in capsys.readouterr().err


def test_columns_without_numbers_are_drawn_as_far_as_they_go() -> None:
    """All of y is missing from the middle on: the mass waits at y = -5/4."""
    results = fall()
    results.values[6:, 1] = np.nan
    results.save("fall.csv")
    assert main(["view", "fall.csv"]) == 0
    assert last_y("fall.html") == pytest.approx(-1.25, abs=1e-4)
    drawn = scene_of(Path("fall.html").read_text(encoding="utf-8"))
    values = decoded(drawn, named(drawn.plain["channels"]["list"], "POINT_MASS/2.y")["values"])
    assert np.isnan(values[6:]).all() and np.isfinite(values[:6]).all()


@pytest.mark.parametrize("reason", ["no desktop", "no browser"])
def test_without_a_browser_the_page_is_written_and_a_sentence_says_so(
    reason: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER"):
        monkeypatch.delenv(name, raising=False)
    if reason == "no browser":
        monkeypatch.setenv("BROWSER", "none")
    monkeypatch.setattr(webbrowser, "open", lambda url: False)
    assert main(["view", "fall.csv"]) == 0
    lines = capsys.readouterr().err.splitlines()
    assert lines == ["fall.html", "adamslite: no browser could be opened; open fall.html yourself"]
    assert last_y("fall.html") == pytest.approx(-5)


def test_one_output_time_is_a_picture() -> None:
    fall(time=TIME[:1], values=np.array([[1.0, 2.0, 3.0]])).save("fall.csv")
    assert main(["view", "fall.csv"]) == 0
    drawn = scene_of(Path("fall.html").read_text(encoding="utf-8"))
    assert drawn.plain["bodies"][1]["position"] == [1, 2, 3]

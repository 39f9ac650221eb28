"""Pictures and films of pages: what they show, and what is said where nothing can draw them."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from browsing import need
from sample_page import sample

from adamslite.cli.main import main
from adamslite.page import browsers, pictures
from adamslite.page.browsers import VARIABLE, find_browser
from adamslite.page.pictures import film_times, write_film, write_picture

DECK = """A mass on a spring
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=0,-1,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=200, LENGTH=0.5
SIMULATE/DYNAMIC, END=1, STEPS=20
END
"""


@pytest.fixture
def deck(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    Path("spring.adm").write_text(DECK)
    return "spring.adm"


def pixels(path: Path, frame: int = 0) -> np.ndarray:
    image = pytest.importorskip("PIL.Image").open(path)
    image.seek(frame)
    return np.asarray(image.convert("RGB"), dtype=int)


def coloured(picture: np.ndarray, colour: tuple[int, int, int]) -> np.ndarray:
    """Rows and columns of the pixels of about that colour, (n, 2)."""
    return np.argwhere(np.abs(picture - colour).max(axis=-1) < 45)


@pytest.mark.slow
@pytest.mark.browser
def test_a_picture_shows_the_scene_at_its_time(tmp_path: Path) -> None:
    need(find_browser(), "browser of the Chromium family")
    orange, heights = (230, 159, 0), []
    for time in (0.5, 1.5):  # the weight is highest, then lowest
        write_picture(sample(), time, tmp_path / "it.png", (640, 360), view="z")
        picture = pixels(tmp_path / "it.png")
        assert picture.shape == (360, 640, 3)
        heights.append(coloured(picture, orange)[:, 0].mean())
    assert heights[1] - heights[0] > 30  # rows are counted downwards


@pytest.mark.slow
@pytest.mark.browser
@pytest.mark.parametrize("suffix", [".gif", ".mp4"])
def test_a_film_has_its_pictures_and_moves(tmp_path: Path, suffix: str) -> None:
    need(find_browser(), "browser of the Chromium family")
    if not shutil.which("ffmpeg"):
        pytest.skip("there is no FFmpeg")
    film = tmp_path / f"it{suffix}"
    write_film(sample(), [0.0, 0.5, 1.0], film, (320, 180), theme="dark")
    if suffix == ".mp4":
        assert film.read_bytes()[4:8] == b"ftyp"
        return
    first, last = pixels(film), pixels(film, 2)
    assert first.shape == (180, 320, 3)
    assert (np.abs(first - last).max(axis=-1) > 60).sum() > 200
    with pytest.raises(EOFError):
        pixels(film, 3)


@pytest.mark.parametrize(
    "first, last, second, shown",
    [
        (0, 5, 1, 5),  # real time
        (2, 5000, 1e-3, 4.998),  # milliseconds
        (0, 0.01, 1, 8),  # too short to be seen
        (0, 3600, 1, 8),  # too long to be watched
    ],
)
def test_a_film_takes_its_time(first: float, last: float, second: float, shown: float) -> None:
    times = film_times(first, last, second, 30)
    assert (len(times) - 1) / 30 == pytest.approx(shown, abs=1 / 60)
    assert [times[0], times[-1]] == pytest.approx([first, last])
    assert np.diff(times) == pytest.approx((last - first) / (len(times) - 1))


def test_a_film_of_one_time_is_one_picture() -> None:
    assert film_times(3.0, 3.0, 1.0, 30) == [3.0]


@pytest.mark.parametrize(
    "words, said",
    [
        ("--png 2", "--png 2: the results are from 0 to 1"),
        ("-o x.png", "-o x.png: a picture is of one time; give it with --png T"),
        ("--png 1 -o x.gif", "-o x.gif: the name must end in .png"),
        ("--dark", "--size, --along and --dark belong to --png, --gif and --mp4"),
    ],
)
def test_what_cannot_be_drawn_is_said_in_a_sentence(
    deck: str, words: str, said: str, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pictures, "find_browser", lambda: "a browser")
    monkeypatch.setattr(shutil, "which", lambda name: name)
    assert main(["view", deck, *words.split()]) == 2
    assert capsys.readouterr().err.splitlines()[-1] == f"adamslite: {said}"
    assert sorted(path.name for path in Path().iterdir()) == [deck]


@pytest.mark.parametrize("size", ["1280", "1280x", "101x200", "99x100", "10000x100", "axb"])
def test_sizes_that_no_picture_can_have_are_refused(deck: str, size: str) -> None:
    assert main(["view", deck, "--png", "1", "--size", size]) == 2


def test_without_a_browser_nothing_is_solved(
    deck: str, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(browsers, "_candidates", lambda: iter(["no-such-browser"]))
    monkeypatch.delenv(VARIABLE, raising=False)
    assert main(["view", deck, "--png", "1"]) == 2
    (said,) = capsys.readouterr().err.splitlines()
    assert said.startswith("adamslite: pictures are drawn by Chromium, Chrome or Edge")
    assert VARIABLE in said


def test_without_ffmpeg_there_is_no_film(
    deck: str, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pictures, "find_browser", lambda: "a browser")
    monkeypatch.setattr(shutil, "which", lambda name: None)
    assert main(["view", deck, "--gif"]) == 2
    (said,) = capsys.readouterr().err.splitlines()
    assert said == "adamslite: films are made by FFmpeg, whose program ffmpeg is not found"


def test_the_program_named_in_the_environment_is_the_browser(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "my-browser"
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    monkeypatch.setenv(VARIABLE, str(program))
    assert find_browser() == str(program)
    monkeypatch.setenv(VARIABLE, str(tmp_path / "none"))
    assert find_browser() is None

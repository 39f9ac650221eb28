"""The pictures of the README and of the gallery, drawn from decks: `python docs/pictures.py`.

Each is made of a page of `adamslite view` by an installed browser. Names after the command limit it
to these: `python docs/pictures.py crane page`.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import urlencode

from adamslite.page.browsers import flags
from adamslite.page.page import page
from adamslite.page.pictures import RATES, need_browser, write_film, write_picture
from adamslite.results.results import Results
from adamslite.scene import load_scene, run_scene

ROOT = Path(__file__).parent.parent
FOLDER = Path(__file__).parent / "pictures"
SMALL, WIDE = (960, 540), (1280, 720)


@dataclass(frozen=True)
class Picture:
    """A picture of a deck: `time` as a part of the run, and what the page is asked for."""

    deck: str
    time: float = 0.4
    asked: dict[str, str] = field(default_factory=dict)


CABLES = "decks/cables/described"
PICTURES = {
    "arrestment": Picture(f"{CABLES}/arrestment.adm"),
    "belt": Picture(f"{CABLES}/belt.adm", 0.3),
    "bricard": Picture("decks/bricard/bricard.adm"),
    "cradle": Picture("decks/contact/cradle/cradle.adm", 0.45),
    "crane": Picture(f"{CABLES}/crane.adm"),
    "drum": Picture(f"{CABLES}/drum.adm"),
    "four-bar": Picture("decks/four-bar/four-bar.adm", 0.4, {"show": "reaction"}),
    "mount": Picture(f"{CABLES}/mount.adm"),
    "reels": Picture(f"{CABLES}/reels.adm", 0.2),
    "ropeway": Picture(f"{CABLES}/ropeway.adm"),
    "slider-crank": Picture("decks/slider-crank/slider-crank.adm", 0.6),
    "spring": Picture("decks/hanging-mass/hanging-mass.adm", 0.2),
    "swinging-cable": Picture("decks/swinging-cable-n50/swinging-cable-n50.adm", 0.7),
    "tackle": Picture("decks/tackle/hoisting.adm", 0.5),
}
"""Of the scene alone."""
PAGES = {
    "page": Picture("decks/tackle/hoisting.adm", 0.5, {"theme": "light"}),
    "page-dark": Picture("decks/slider-crank/slider-crank.adm", 0.6, {"theme": "dark"}),
}
"""Of the whole page, with its controls and plots."""
FILMS = {"tackle": Picture("decks/tackle/hoisting.adm")}
"""Of the scene, as GIF."""


def main() -> None:
    """Draw what the command names, or everything."""
    names = sorted({*PICTURES, *PAGES, *FILMS})
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", choices=[*names, []], metavar="NAME", help=str(names))
    chosen = parser.parse_args().names or names
    FOLDER.mkdir(exist_ok=True)
    for name in chosen:
        for table, suffix, draw in (
            (PICTURES, ".png", draw_scene), (PAGES, ".png", draw_page), (FILMS, ".gif", draw_film),
        ):  # fmt: skip
            if name in table:
                path = FOLDER / f"{name}{suffix}"
                draw(table[name], path)
                sys.stderr.write(f"{path.relative_to(ROOT)}: {path.stat().st_size / 1e3:.0f} kB\n")


def solved(picture: Picture) -> tuple[str, Results, float]:
    """The page of a deck, its results, and the time of the picture."""
    scene = load_scene(ROOT / picture.deck)
    results = run_scene(scene, {})
    first, last = results.time[0], results.time[-1]
    return page(results, scene.deck), results, float(first + picture.time * (last - first))


def draw_scene(picture: Picture, path: Path) -> None:
    """Of the scene, with its title and the time."""
    text, _, time = solved(picture)
    write_picture(text, time, path, SMALL, **picture.asked)


def draw_film(picture: Picture, path: Path) -> None:
    """Of the scene while it moves, for four seconds."""
    text, results, _ = solved(picture)
    first, last, count = results.time[0], results.time[-1], 4 * RATES[".gif"]
    times = [float(first + (last - first) * k / count) for k in range(count + 1)]
    write_film(text, times, path, (640, 360), **picture.asked)


def draw_page(picture: Picture, path: Path) -> None:
    """Of the page as a reader sees it."""
    text, _, time = solved(picture)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        file = Path(folder) / "page.html"
        file.write_text(text, encoding="utf-8")
        address = f"{file.as_uri()}#{urlencode({**picture.asked, 't': time})}"
        window = "--window-size={},{}".format(*WIDE)
        profile = f"--user-data-dir={folder}/profile"
        shot = f"--screenshot={path.resolve()}"
        command = [need_browser(), *flags(), window, profile, shot, address]
        subprocess.run(command, check=True, capture_output=True)


if __name__ == "__main__":
    main()

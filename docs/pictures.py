"""Pictures of README and tutorials, drawn by an installed browser: `python docs/pictures.py`.

Each is made of a page of `adamslite view`; those of the gallery are drawn by docs/gallery.py. Names
after the command limit it to these: `python docs/pictures.py tackle`.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urlencode

import adamslite as al
from adamslite.page.browsers import flags
from adamslite.page.page import page
from adamslite.page.pictures import RATES, need_browser, write_film
from adamslite.plots.style import save as save_figure
from adamslite.results.results import Results
from adamslite.scene import load_scene, run_scene
from adamslite.sweeps.motions import page_of_sweep

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ROOT = Path(__file__).parent.parent
FOLDER = Path(__file__).parent / "pictures"
WIDE, FILMED, LASTING = (1280, 720), (640, 360), 4
"""Sizes of a page and of a film in pixels; how long a film is [s]."""
COLOURS, LINES = 256, 24
"""Colours of a scene, of a plot."""


@dataclass(frozen=True)
class Picture:
    """A picture of a deck: `time` as a part of the run, and what the page is asked for."""

    deck: str
    time: float = 0.4
    asked: dict[str, str] = field(default_factory=dict)


PAGES = {"page": Picture("decks/tackle/hoisting.adm", 0.5, {"theme": "light"})}
"""Of the whole page, with its controls and plots."""
PLOTS = {"hoist": ("docs/tutorials/hoist.toml", ("REQUEST/1.F2", "POINT_MASS/20.y"))}
"""Of a described cable scene: channels."""
SWEEPS = {
    "sweep": (
        "decks/hanging-mass/hanging-mass.adm",
        {"SPRINGDAMPER/1.K": "80:200:13", "POINT_MASS/2.MASS": "1,1.5,2"},
        "min POINT_MASS/2.y",
    )
}  # fmt: skip
"""Of a sweep: a deck, what varies, a measure."""
SLIDERS = {"sliders": (*SWEEPS["sweep"], {"theme": "light", "run": "20", "plot": "POINT_MASS/2.y"})}
"""Of the page of a sweep: the same, and what the page is asked for."""
FILMS = {"tackle": Picture("decks/tackle/hoisting.adm")}
"""Of the scene, as GIF."""


def main() -> None:
    """Draw what the command names, or everything."""
    names = sorted({*PAGES, *PLOTS, *SWEEPS, *SLIDERS, *FILMS})
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", choices=[*names, []], metavar="NAME", help=str(names))
    chosen = parser.parse_args().names or names
    FOLDER.mkdir(exist_ok=True)
    for table, suffix, draw in (
        (PAGES, ".png", draw_page), (PLOTS, ".png", draw_plot), (SWEEPS, ".png", draw_sweep),
        (SLIDERS, ".png", draw_sliders), (FILMS, ".gif", draw_film),
    ):  # fmt: skip
        for name in table.keys() & chosen:
            path = FOLDER / f"{name}{suffix}"
            draw(table[name], path)
            sys.stderr.write(f"{path.relative_to(ROOT)}: {path.stat().st_size / 1e3:.0f} kB\n")


def solved(picture: Picture) -> tuple[str, Results, float]:
    """The page of a deck, its results, and the time of the picture."""
    scene = load_scene(ROOT / picture.deck)
    results = run_scene(scene, {})
    first, last = results.time[0], results.time[-1]
    return page(results, scene.deck), results, float(first + picture.time * (last - first))


def draw_film(picture: Picture, path: Path) -> None:
    """Of the scene while it moves."""
    text, results, _ = solved(picture)
    first, last, count = results.time[0], results.time[-1], LASTING * RATES[".gif"]
    times = [float(first + (last - first) * k / count) for k in range(count + 1)]
    write_film(text, times, path, FILMED, **picture.asked)


def draw_page(picture: Picture, path: Path) -> None:
    """Of the page as a reader sees it."""
    text, _, time = solved(picture)
    save_page(text, {**picture.asked, "t": str(time)}, path)


def draw_sliders(given: tuple[str, dict[str, str], str, dict[str, str]], path: Path) -> None:
    """Of the page of a sweep."""
    deck, varied, measure, asked = given
    text, _ = page_of_sweep(al.sweep(ROOT / deck, varied, measures=measure))
    save_page(text, {**asked, "t": "0.4"}, path)


def save_page(text: str, asked: dict[str, str], path: Path) -> None:
    """The picture of a page with its controls."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        file, raw = Path(folder) / "page.html", Path(folder) / "raw.png"
        file.write_text(text, encoding="utf-8")
        address = f"{file.as_uri()}#{urlencode(asked)}"
        window = "--window-size={},{}".format(*WIDE)
        profile = f"--user-data-dir={folder}/profile"
        command = [need_browser(), *flags(), window, profile, f"--screenshot={raw}", address]
        subprocess.run(command, check=True, capture_output=True)
        save_small(raw, path, COLOURS)


def draw_plot(plot: tuple[str, tuple[str, ...]], path: Path) -> None:
    """Of channels over the time."""
    description, channels = plot
    save_figure_small(al.simulate(al.cable(ROOT / description)).plot(*channels), path)


def draw_sweep(given: tuple[str, dict[str, str], str], path: Path) -> None:
    """Of a measure over a number."""
    deck, varied, measure = given
    save_figure_small(al.sweep(ROOT / deck, varied, measures=measure).plot(), path)


def save_figure_small(figure: Figure, path: Path) -> None:
    """Write a figure with few colours."""
    with tempfile.TemporaryDirectory() as folder:
        raw = Path(folder) / "raw.png"
        save_figure(figure, raw)
        save_small(raw, path, LINES)


def save_small(raw: Path, path: Path, colours: int) -> None:
    """Write a picture again, with few colours."""
    from PIL import Image

    picture = Image.open(raw).convert("RGB")
    few = picture.quantize(colours, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    few.save(path, optimize=True)


if __name__ == "__main__":
    main()

"""The gallery: a page for each scene of docs/gallery/scenes.toml, with picture, deck and plot.

python docs/gallery.py                        the pages
python docs/gallery.py --pictures [NAME ...]  the pages, and the pictures of these or of all scenes

Pictures are drawn by a browser from the page of the results, plots by matplotlib; both are PNG with
few colours.  tests/test_gallery.py compares the pages.
"""

from __future__ import annotations

import sys
import tempfile
import tomllib
from dataclasses import dataclass
from pathlib import Path

import adamslite as al

FOLDER = Path(__file__).with_name("gallery")
DECKS = Path(__file__).parent.parent / "decks"
#: Size of pictures in pixels; colours of pictures and of plots.
SIZE, COLOURS, LINES = (640, 400), 96, 48
HEAD = "<!-- Written by docs/gallery.py: do not edit. -->\n"
INTRODUCTION = """# Gallery

Decks that come with the program, each with a picture, a plot and what must come out. All of them
have a reference: `adamslite verify` solves them and compares.
[decks](../../decks/README.md) has more of them.
"""


@dataclass(frozen=True)
class Scene:
    """An entry of scenes.toml; its file says what the fields mean."""

    deck: str
    text: str
    plot: tuple[str, ...]
    x: str = "time"
    at: float = 0.4
    view: str = "iso"

    @property
    def name(self) -> str:
        """Of its page and pictures: the path of the deck, without what is said twice."""
        folder, _, stem = self.deck.rpartition("/")
        last = folder.rpartition("/")[2]
        return stem if stem.startswith(last) else f"{last}-{stem}"

    @property
    def file(self) -> Path:
        """The deck."""
        return DECKS / f"{self.deck}.adm"

    @property
    def title(self) -> str:
        """The first line of the deck."""
        return self.file.read_text(encoding="utf-8").partition("\n")[0].strip()

    @property
    def readme(self) -> Path:
        """What derives its reference."""
        return self.file.with_name("README.md")


def scenes() -> dict[str, list[Scene]]:
    """The scenes by the name of their group."""
    content = tomllib.loads((FOLDER / "scenes.toml").read_text(encoding="utf-8"))
    return {
        group["name"]: [Scene(**{**each, "plot": tuple(each["plot"])}) for each in group["scene"]]
        for group in content["group"]
    }


def index() -> str:
    """The page that shows all scenes."""
    parts = [HEAD, INTRODUCTION]
    for group, members in scenes().items():
        rows = [
            f"| [![{each.title}]({each.name}.png)]({each.name}.md) "
            f"| [{each.title}]({each.name}.md)<br>{each.text.replace(chr(10), ' ')} |"
            for each in members
        ]
        parts.append("\n".join([f"## {group}\n", "| | |", "|---|---|", *rows]) + "\n")
    names = "\n".join(each.name for members in scenes().values() for each in members)
    return "\n".join([*parts, f"```{{toctree}}\n:hidden:\n\n{names}\n```"]) + "\n"


def page(scene: Scene) -> str:
    """The page of one scene."""
    deck = f"../../decks/{scene.deck}.adm"
    source = scene.readme.relative_to(DECKS).as_posix()
    if scene.readme.exists():
        derived = f"[Equations and the source of its reference](../../decks/{source})."
    else:
        derived = "Its reference is computed beside it."
    over = "" if scene.x == "time" else f" --x {scene.x}"
    return f"""{HEAD}
# {scene.title}

![The scene at {scene.at:.0%} of the run]({scene.name}.png)

{scene.text}

The deck: [{scene.file.name}]({deck}). {derived}

```sh
adamslite view {scene.file.name}
adamslite plot {scene.file.name} {" ".join(scene.plot)}{over}
```

![{", ".join(scene.plot)}]({scene.name}-plot.png)
"""


def pages() -> dict[str, str]:
    """Every page by the name of its file."""
    found = {f"{each.name}.md": page(each) for some in scenes().values() for each in some}
    return {"index.md": index(), **found}


def draw(scene: Scene) -> None:
    """Solve the deck; write its picture and its plot."""
    from pictures import save_small  # beside this program

    from adamslite.page.page import page as page_of
    from adamslite.page.pictures import write_picture
    from adamslite.plots.style import save as save_figure
    from adamslite.plots.time_histories import plot

    results = al.simulate(scene.file)
    first, last = results.time[0], results.time[-1]
    with tempfile.TemporaryDirectory() as folder:
        raw = Path(folder) / "raw.png"
        time = first + scene.at * (last - first)
        write_picture(page_of(results), float(time), raw, SIZE, view=scene.view)
        save_small(raw, FOLDER / f"{scene.name}.png", COLOURS)
        save_figure(plot(results, scene.plot, x=scene.x), raw)
        save_small(raw, FOLDER / f"{scene.name}-plot.png", LINES)


def main(arguments: list[str]) -> None:
    """Write the pages, and the pictures that are asked for."""
    for name, text in pages().items():
        (FOLDER / name).write_text(text, encoding="utf-8")
    if arguments[:1] == ["--pictures"]:
        for each in (each for members in scenes().values() for each in members):
            if len(arguments) == 1 or each.name in arguments:
                draw(each)


if __name__ == "__main__":
    main(sys.argv[1:])

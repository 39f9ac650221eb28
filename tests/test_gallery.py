"""The gallery is up to date with its list, has all of its pictures, and these are small."""

import runpy
from pathlib import Path

import pytest

import adamslite

DOCS = Path(__file__).parent.parent / "docs"
GALLERY = DOCS / "gallery"
WRITER = runpy.run_path(str(DOCS / "gallery.py"))
PAGES = WRITER["pages"]()
SCENES = [scene for group in WRITER["scenes"]().values() for scene in group]
#: Bytes of one picture, of all, and of a film.
MOST_OF_ONE, MOST_OF_ALL, MOST_OF_FILM = 60_000, 3_000_000, 200_000
scene_by_name = pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)


def test_pages_are_those_of_the_list() -> None:
    written = {page.name: page.read_text(encoding="utf-8") for page in GALLERY.glob("*.md")}
    assert written == PAGES, "run: python docs/gallery.py"
    assert len(SCENES) >= 30
    assert len({scene.name for scene in SCENES}) == len(SCENES)


def test_pictures_are_those_of_the_list_and_small() -> None:
    pictures = {path.name: path.stat().st_size for path in GALLERY.glob("*.png")}
    wanted = {f"{scene.name}{end}.png" for scene in SCENES for end in ("", "-plot")}
    assert set(pictures) == wanted, "run: python docs/gallery.py --pictures NAME ..."
    assert max(pictures.values()) < MOST_OF_ONE
    assert sum(pictures.values()) < MOST_OF_ALL


def test_pictures_of_other_pages_are_used_and_small() -> None:
    pages = [DOCS.parent / "README.md", *DOCS.glob("**/*.md")]
    texts = "\n".join(page.read_text(encoding="utf-8") for page in pages)
    for picture in (DOCS / "pictures").iterdir():
        assert picture.name in texts, f"nothing shows {picture.name}"
        assert picture.stat().st_size < (MOST_OF_ONE if picture.suffix == ".png" else MOST_OF_FILM)


@scene_by_name
def test_a_plot_shows_statements_of_the_deck(scene) -> None:
    deck = adamslite.read(scene.file)
    channels = [*scene.plot, *([] if scene.x == "time" else [scene.x])]
    for channel in channels:
        keyword, _, rest = channel.partition("/")
        name = rest.partition(".")[0]
        assert deck.find(keyword, int(name) if name.isdecimal() else name), channel


@scene_by_name
def test_a_scene_has_a_reference(scene) -> None:
    folder, stem = scene.file.parent, scene.file.stem
    named = list(folder.glob(f"{stem}.reference*.csv"))
    assert named or list(folder.glob("reference*.csv"))

"""Attacks on the promises of docs/security.md: pages, notebooks and figures hold texts of decks as
texts. Each is made of a deck with a hostile word and of one with a harmless word as long; both must
have the same elements and attributes.
"""

from __future__ import annotations

from collections.abc import Callable
from html.parser import HTMLParser
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from xml.etree import ElementTree

import pytest
from browsing import opened
from scenes import SPRING

import adamslite as al

WORDS = [
    "<script>alert(1)</script>", "</script><script>alert(1)</script>", "<!--<script>alert(1)",
    "<img src=x onerror=alert(1)>", "'><svg/onload=alert(1)>", "</pre></title></style><b>x</b>",
    "{{bundle}}{{scene}}", "&lt;b&gt;&#60;i&#62;", "]]><x/>", "--><x/>", "javascript:alert(1)",
    "\u2028\u2029\x85</script>\x00<b>", "'`\x1b\x7f\u202e<b onclick=owned=1>",
    "\ufffe\x0b<![CDATA[<b>",
]  # fmt: skip


def scene(word: str) -> al.Results:
    """Results of a deck that has a word in its title, in names, comments and texts."""
    text = SPRING.partition("\n")[2].replace(
        "END\n",
        f"! adams_view_name='{word}'\nPART/3, MASS=1, CM=3, IP=1,1,1\nMARKER/3, PART=3\n"
        f'REQUEST/1, F2=TIME, TITLE="{word}":"{word}", CUNITS="{word}", CNAMES="{word}",'
        f' COMMENT="{word}"\n! {word}\nEND\n',
    )
    found = al.simulate(al.read(f"{word}\n{text}"), end=0.1, steps=2)
    assert found.outcome is al.Outcome.DONE, found.message
    return found


class Shape(HTMLParser):
    """Names of elements and of their attributes, in their order, and links."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[tuple[str, ...]] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        links = [value or "" for name, value in attrs if name in ("href", "src")]
        self.found.append((tag, *(name for name, _ in attrs), *(each[:8] for each in links)))
        for name, value in attrs:
            if name == "srcdoc":
                self.found += Shape(value or "").found


def svg(results: al.Results) -> str:
    """A figure with names and titles of the deck."""
    pytest.importorskip("matplotlib")
    from adamslite.plots.style import styled

    memory = BytesIO()
    with styled():
        figure = al.plot(results, [results.names[-1], "POINT_MASS/2.x"])
        figure.axes[0].set_title(results.meta["deck"])
        figure.savefig(memory, format="svg")
    return memory.getvalue().decode()


def page(results: al.Results) -> str:
    from adamslite.page.page import page as made

    return made(results)


def checked(results: al.Results) -> str:
    assert results.source is not None
    return al.html(al.check(results.source.deck))


def sweep(results: al.Results) -> str:
    """A page of some runs."""
    assert results.source is not None
    deck, numbers = results.source.read()[0], ["SPRINGDAMPER/1.K=8,9"]
    runs = al.sweep(
        deck, numbers, outputs=["REQUEST/*"], measures=["max REQUEST/1.F2"], end=0.1, steps=2
    )
    with TemporaryDirectory() as folder:
        path = Path(folder, "a.html")
        al.view(runs, path)
        return path.read_text(encoding="utf-8")


MAKERS: dict[str, Callable[[al.Results], str]] = {
    "page": page, "notebook": al.html, "check": checked,
    "sweep": sweep,
}  # fmt: skip


@pytest.mark.parametrize("maker", MAKERS)
@pytest.mark.parametrize("word", WORDS)
def test_a_word_of_a_deck_is_a_text_of_the_page(word: str, maker: str) -> None:
    made = MAKERS[maker]
    hostile, harmless = made(scene(word)), made(scene("w" * len(word)))
    assert Shape(hostile).found == Shape(harmless).found


@pytest.mark.parametrize("word", WORDS)
def test_a_word_of_a_deck_is_a_text_of_the_figure(word: str) -> None:
    kept = {each.tag for each in ElementTree.fromstring(svg(scene("w" * len(word)))).iter()}
    assert {each.tag for each in ElementTree.fromstring(svg(scene(word))).iter()} <= kept


def test_a_page_loads_nothing_and_asks_nobody() -> None:
    """The browser is told so by the page itself, should a text ever pass for an element."""
    text = page(scene("harmless"))
    policy = text.partition('Content-Security-Policy" content="')[2].partition('"')[0]
    assert policy.startswith("default-src 'none';") and "connect-src" not in policy


@pytest.mark.browser
def test_no_word_of_a_deck_is_carried_out_by_a_browser(browser: Any, tmp_path: Path) -> None:
    """All of them at once, each of which would set a variable or open a dialog."""
    words = " ".join(WORDS).replace("alert(1)", "owned=1")
    pages = {name: maker(scene(words)) for name, maker in MAKERS.items()}
    for name, text in pages.items():
        whole = text if "<html" in text else f"<!DOCTYPE html><body>{text}"
        with opened(browser, whole, tmp_path, quiet=name != "notebook") as tab:
            tab.page.on("dialog", lambda dialog: dialog.dismiss())
            tab.page.wait_for_timeout(300)
            for tag in ("button", "summary", "[role=tab]", "tr", "li"):
                for each in tab.page.locator(tag).all()[:40]:
                    if each.is_visible():
                        each.dispatch_event("click")
            frames = [each.evaluate("() => typeof owned") for each in tab.page.frames]
            assert frames and set(frames) == {"undefined"}, name
            assert tab.page.locator("[onerror],[onload],[onclick],img,b:text-is('x')").count() == 0


def test_results_of_others_are_texts_of_the_page(tmp_path: Path) -> None:
    """A table with hostile names of columns and comments."""
    word = WORDS[1]
    (tmp_path / "a.csv").write_text(f'# deck: {word}\ntime,"{word}"\n0,1\n', encoding="utf-8")
    shown = al.html(al.Results.load(tmp_path / "a.csv"))
    (tmp_path / "a.csv").write_text("# deck: w\ntime,w\n0,1\n", encoding="utf-8")
    assert Shape(shown).found == Shape(al.html(al.Results.load(tmp_path / "a.csv"))).found

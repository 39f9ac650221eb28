"""A page in a real browser: an installed one, without a window, that Playwright drives."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from adamslite.page.browsers import find_browser, flags

NEEDED = os.environ.get("ADAMSLITE_NEED_BROWSER") == "1"
SIZE = (1280, 720)
PHONE = (390, 844)


def need(present: object, what: str) -> None:
    """Skip a test for the lack of something; where it must not be skipped, fail."""
    if not present:
        (pytest.fail if NEEDED else pytest.skip)(f"there is no {what}")


@contextmanager
def started() -> Iterator[Any]:
    """A browser for some tests."""
    need(importlib.util.find_spec("playwright"), "Playwright")
    program = find_browser()
    need(program, "browser of the Chromium family")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=flags())
        yield browser
        browser.close()


@dataclass
class Opened:
    """A page that is open, what its console said, and what it asked for."""

    page: Any
    said: list[str] = field(default_factory=list)
    asked: list[str] = field(default_factory=list)

    def do(self, script: str) -> Any:
        """The value of an expression of JavaScript; `it` is the page's handle."""
        return self.page.evaluate(f"() => {{ const it = window.adamslite; return {script}; }}")

    def wait(self, condition: str) -> None:
        self.page.wait_for_function(
            f"() => {{ const it = window.adamslite; return {condition}; }}", timeout=20000
        )

    def seen(self, selector: str) -> str:
        """The text of an element that is seen."""
        found = self.page.locator(selector)
        assert found.is_visible(), f"{selector} is not seen"
        return str(found.inner_text())


@contextmanager
def opened(
    browser: Any,
    text: str,
    folder: Path,
    address: str = "t=0",
    size: tuple[int, int] = SIZE,
    quiet: bool = True,
    before: str = "",
    **context: Any,
) -> Iterator[Opened]:
    """A page whose text is given; when it is closed, it must have said and asked nothing."""
    file = folder / "page.html"
    file.write_text(text, encoding="utf-8")
    width, height = size
    held = browser.new_context(viewport={"width": width, "height": height}, **context)
    tab = Opened(held.new_page())
    tab.page.on("console", lambda message: tab.said.append(message.text))
    tab.page.on("pageerror", lambda error: tab.said.append(str(error)))
    tab.page.on("request", lambda request: tab.asked.append(request.url))
    if before:
        tab.page.add_init_script(before)
    tab.page.goto(f"{file.as_uri()}#{address}")
    yield tab
    held.close()
    inside = ("data:", "blob:", file.as_uri())
    assert [url for url in tab.asked if not url.startswith(inside)] == []
    assert not (quiet and tab.said), tab.said

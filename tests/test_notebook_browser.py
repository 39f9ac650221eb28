"""The frame of a notebook's output in a browser: the page moves in it, and reaches nothing else."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browsing import opened, started

import adamslite as al

pytestmark = [pytest.mark.browser, pytest.mark.slow]

STONE = """A stone
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, VX=3
MARKER/2, POINT_MASS=2
INTEGRATOR/GSTIFF, ERROR=1E-8
SIMULATE/DYNAMIC, END=2, STEPS=20
END
"""
NOTEBOOK = "<!DOCTYPE html><title>a notebook</title><script>var secret = 1</script>{}"


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with started() as found:
        yield found


def test_the_page_in_the_frame_shows_the_motion(browser: Any, tmp_path: Path) -> None:
    """x = 3 t, y = -5 t^2 at t = 1, on a straight line between the output times around it."""
    text = NOTEBOOK.format(al.html(al.simulate(STONE)))
    with opened(browser, text, tmp_path) as tab:
        (frame,) = (each for each in tab.page.frames if each.parent_frame)
        frame.wait_for_function("() => window.adamslite && window.adamslite.ready", timeout=20000)
        frame.evaluate("() => window.adamslite.ready.then(() => null)")
        # The page plays: what is asked later would be of a later time.
        place = frame.evaluate(
            "() => { adamslite.seek(1.0); adamslite.renderFrame();"
            " return Array.from(adamslite.bodyPosition('POINT_MASS/2')) }"
        )
        np.testing.assert_allclose(place, [3.0, -5.0, 0.0], atol=1e-3)
        assert tab.said == []
        assert all(each.startswith(("file:", "about:", "blob:", "data:")) for each in tab.asked)


def test_the_page_in_the_frame_does_not_reach_the_notebook(browser: Any, tmp_path: Path) -> None:
    """What it tries to read of the document around it is refused, for its origin is its own."""
    text = NOTEBOOK.format(al.html(al.simulate(STONE)))
    with opened(browser, text, tmp_path) as tab:
        (frame,) = (each for each in tab.page.frames if each.parent_frame)
        tried = "() => { try { return String(parent.secret) } catch (e) { return e.name } }"
        assert frame.evaluate(tried) == "SecurityError"
        assert frame.evaluate("() => self.origin") == "null"

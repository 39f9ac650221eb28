"""The page of a sweep in a browser: sliders choose the run, by pointer and by keyboard.

The mass falls from rest at y = 5: after t seconds it is at 5 + g t^2/2.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from browsing import PHONE, Opened

import adamslite as al
from adamslite.sweeps.motions import page_of_sweep

pytestmark = pytest.mark.browser

DECK = """a mass that falls
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=0,5,0
MARKER/2, POINT_MASS=2
REQUEST/1, F2=DM(2,1)
SIMULATE/DYNAMIC, END=1, STEPS=20
END
"""
G, MASS = "ACCGRAV.JGRAV", "POINT_MASS/2.MASS"
GRAVITIES, MASSES = [-1.0, -2.0, -4.0], [-1.0, 1.0, 3.0]
NEAR = 2e-3


@cache
def grid() -> str:
    """Runs 3 k fail: their mass is negative."""
    sweep = al.sweep(DECK, {G: GRAVITIES, MASS: MASSES}, measures="min POINT_MASS/2.y", workers=1)
    sweep.messages[3] = "<img src=x onerror=alert(1)>"
    return page_of_sweep(sweep)[0]


@cache
def sample() -> tuple[str, Any]:
    sweep = al.sweep(
        DECK, {G: "-9:-1", MASS: "1:3"}, sample="lhs:100", measures="min POINT_MASS/2.y", workers=1
    )
    return page_of_sweep(sweep)[0], sweep


def height(tab: Opened) -> float:
    return float(tab.do("it.bodyPosition('POINT_MASS/2')")[1])


def test_sliders_choose_the_run_that_is_shown(show: Any) -> None:
    with show(grid(), address="t=1") as tab:
        assert tab.do("it.run") == 1  # the first that has a motion
        assert height(tab) == pytest.approx(4.5, abs=NEAR)
        gravity = tab.page.get_by_label(G)
        gravity.fill("0")  # of -4, -2, -1
        assert tab.do("it.run") == 7 and tab.do("it.time") == 1
        assert height(tab) == pytest.approx(3, abs=NEAR)
        assert gravity.get_attribute("aria-valuetext") == "-4 m/s^2"
        assert "-4 m/s^2" in tab.seen(".runs") and "Run 7 of 9" in tab.seen(".runs")
        name, value = tab.seen(".runs dl").splitlines()
        assert name == "min POINT_MASS/2.y" and value.endswith(" m")
        assert float(value.split()[0]) == pytest.approx(3, abs=NEAR)
        tab.page.get_by_label(MASS).fill("2")
        assert tab.do("it.run") == 8
        curves = tab.do("it.curves()").splitlines()
        assert [float(each) for each in curves[-1].split(",")] == pytest.approx([1, 3], abs=NEAR)


def test_the_keyboard_moves_sliders_and_goes_from_run_to_run(show: Any) -> None:
    with show(grid(), address="t=0.5") as tab:
        gravity = tab.page.get_by_label(G)
        gravity.press("Home")
        assert tab.do("it.run") == 7
        gravity.press("ArrowRight")
        assert (tab.do("it.run"), tab.do("it.time")) == (4, 0.5)
        assert tab.page.evaluate("document.activeElement.getAttribute('aria-label')") == G
        tab.page.keyboard.press(".")
        assert tab.do("it.run") == 5
        tab.page.keyboard.press(",")
        tab.page.keyboard.press(",")
        assert tab.do("it.run") == 3
    with show(grid(), address="t=0&run=8") as tab:
        assert tab.do("it.run") == 8
        tab.page.keyboard.press("?")
        assert "the run after" in tab.seen(".help")


def test_a_run_that_failed_shows_why_in_place_of_a_motion(show: Any) -> None:
    with show(grid(), address="t=1&run=3") as tab:
        told = tab.seen("#app > .failure")
        assert "Run 3 has no motion. Failed: INVALID: <img src=x onerror=alert(1)>" in told
        assert not tab.page.locator("canvas.scene").is_visible()
        assert not tab.page.locator(".panel").is_visible()
        assert tab.page.locator(".runs dd").inner_text() == "–"
        tab.page.keyboard.press(".")
        assert tab.page.locator("canvas.scene").is_visible()
        assert not tab.page.locator("#app > .failure").is_visible()
        assert height(tab) == pytest.approx(4, abs=NEAR)


def test_what_a_reader_has_chosen_stays_from_run_to_run(show: Any) -> None:
    with show(grid(), address="t=0.5") as tab:
        tab.do("it.plot(['POINT_MASS/2.vy'])")
        tab.do("it.view('iso')")
        tab.do("it.select('POINT_MASS/2')")
        tab.page.keyboard.press("t")
        tab.page.keyboard.press("l")
        tab.page.locator(".panel [role=tab]", has_text="About").click()
        theme = tab.do("it.theme")
        tab.page.get_by_label(G).press("Home")
        assert tab.do("it.run") == 7
        assert tab.do("it.plotted") == ["POINT_MASS/2.vy"]
        assert tab.do("it.selected") == "POINT_MASS/2" and tab.do("it.theme") == theme
        assert tab.page.locator(".about").is_visible()
        assert tab.do("it.app.showing.state().find(([name]) => name === 'labels')[1]")
        tab.do("it.play()")
        tab.page.keyboard.press(".")
        tab.wait("it.playing && it.run === 8 && it.time > 0.5")


def test_a_view_that_was_turned_stays_and_a_framed_one_holds_every_run(show: Any) -> None:
    with show(grid(), address="t=1") as tab:
        tab.do("it.chooseRun(7)")
        wide = tab.do("it.cameraFrame()")
        x, y = tab.do("it.screenPosition('POINT_MASS/2')")
        size = tab.page.locator("canvas.scene").bounding_box()
        assert 0 < x < size["width"] and 0 < y < size["height"]
        tab.do("it.chooseRun(1)")
        again = tab.do("it.cameraFrame()")
        assert again["position"] == pytest.approx(wide["position"], rel=0.05)
        tab.page.mouse.move(size["x"] + 200, size["y"] + 200)
        tab.page.mouse.wheel(0, -300)
        before = tab.do("it.cameraFrame()")
        tab.do("it.chooseRun(4)")
        after = tab.do("it.cameraFrame()")
        assert after["position"] == pytest.approx(before["position"], rel=1e-9)


def test_of_a_sample_the_nearest_run_is_shown_with_its_own_values(show: Any) -> None:
    text, sweep = sample()
    with show(text, address="t=1") as tab:
        tab.page.get_by_label(G).fill("50")  # of 200 places from the least to the largest
        tab.page.get_by_label(MASS).fill("150")
        low, high = sweep.values.min(axis=0), sweep.values.max(axis=0)
        asked = low + (high - low) * [0.25, 0.75]
        nearest = int((((sweep.values - asked) / (high - low)) ** 2).sum(axis=1).argmin())
        assert tab.do("it.run") == nearest
        g, mass = sweep.values[nearest]
        shown = tab.page.locator(".runs output").all_inner_texts()
        assert [float(each.split()[0]) for each in shown] == pytest.approx([g, mass], rel=1e-4)
        assert height(tab) == pytest.approx(5 + g / 2, abs=5e-3)
        # The knob stays where it was put, so that keys go on from there.
        assert tab.page.get_by_label(G).input_value() == "50"
        for _ in range(3):
            tab.page.get_by_label(G).press("ArrowRight")
        assert tab.page.get_by_label(G).input_value() == "53"


@pytest.mark.slow
def test_going_through_all_runs_keeps_nothing_of_them(show: Any) -> None:
    text, _ = sample()
    with show(text, address="t=0") as tab:
        tab.do("it.chooseRun(1)")
        memory = tab.do("({...it.app.stage.renderer.info.memory})")
        for run in range(2, 60):
            tab.do(f"it.chooseRun({run})")
        assert tab.do("({...it.app.stage.renderer.info.memory})") == memory
        assert tab.do("document.querySelectorAll('canvas.scene, .panel, .player').length") == 3


@pytest.mark.slow
def test_a_sweep_on_a_phone_has_sliders_motion_and_plots(show: Any) -> None:
    with show(grid(), address="t=1", size=PHONE) as tab:
        for selector in (".runs", "canvas.scene", ".player", ".panel"):
            box = tab.page.locator(selector).bounding_box()
            assert box["width"] > 300 and box["y"] + 30 < PHONE[1]
        assert tab.do("document.documentElement.scrollWidth") <= PHONE[0]

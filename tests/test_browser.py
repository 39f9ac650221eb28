"""A page in a browser: it loads, plays, is looked at from all sides and picked at.

What is read back are the matrices of the three.js objects, pixels and texts of the document.
"""

from __future__ import annotations

import io
from typing import Any

import numpy as np
import pytest
from browsing import PHONE, Opened
from sample_page import ARM, END, FRAMES, TURNS, UPRIGHT, bare, crank, sample, solid, swarm, weight

from adamslite.page.page import framed

pytestmark = pytest.mark.browser

STEP = END / (FRAMES - 1)
# Positions are drawn on straight lines between output times: the height of an arc of a step, and
# one of 65535 parts of the travel.
CHORD = ARM * (2 * np.pi * STEP / END) ** 2 / 8 + 2 * ARM / 65535


def click(tab: Opened, place: list[float]) -> None:
    """Click at pixels of the picture."""
    box = tab.page.locator("canvas.scene").bounding_box()
    tab.page.mouse.click(box["x"] + place[0], box["y"] + place[1])


def pixels(tab: Opened, selector: str = "canvas.scene") -> np.ndarray:
    """Red, green and blue of what an element shows, (height, width, 3)."""
    image = pytest.importorskip("PIL.Image")
    shot = io.BytesIO(tab.page.locator(selector).screenshot())
    return np.asarray(image.open(shot).convert("RGB"), dtype=int)


def near(picture: np.ndarray, colour: str, apart: int = 40) -> int:
    """How many pixels are close to a colour."""
    wanted = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
    return int((np.abs(picture - wanted).max(axis=-1) < apart).sum())


def test_a_page_loads_without_a_word_and_asks_for_nothing(show: Any) -> None:
    with show(sample()) as tab:
        tab.do("it.ready")
        assert tab.seen("h1") == "A crank, a sheave & a <weight>"
        assert tab.page.title() == "A crank, a sheave & a <weight>"


@pytest.mark.slow
def test_a_page_tells_what_was_run_and_keeps_the_licences(show: Any) -> None:
    with show(sample(), address="t=0&tab=about") as tab:
        told = tab.seen(".about")
        assert "sample.adm: The run reached its end." in told and "A note." in told
        assert f"Motion is drawn from {FRAMES} times" in told
        tab.page.locator(".about summary").click()
        licences = tab.seen(".about pre")
        assert all(f"{name} " in licences for name in ("three", "uplot", "fflate"))
        tab.page.locator(".events button").click()
        assert tab.do("it.time") == 1.0


@pytest.mark.slow
def test_a_page_plays_when_it_is_opened(show: Any) -> None:
    with show(sample(), address="") as tab:
        tab.wait("it.playing && it.time > 0")
    with show(sample(), address="", reduced_motion="reduce") as tab:
        assert not tab.do("it.playing")


@pytest.mark.slow
def test_the_pointer_turns_moves_and_zooms_the_view_and_picks_nothing(show: Any) -> None:
    with show(sample()) as tab:
        box = tab.page.locator("canvas.scene").bounding_box()
        middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

        def drag(button: str) -> tuple[np.ndarray, np.ndarray]:
            """Change of the camera's place and of what it looks at."""
            before = tab.do("it.cameraFrame()")
            tab.page.mouse.move(*middle)
            tab.page.mouse.down(button=button)
            tab.page.mouse.move(middle[0] + 80, middle[1] + 40, steps=4)
            tab.page.mouse.up(button=button)
            after = tab.do("it.cameraFrame()")
            moved = [np.subtract(after[key], before[key]) for key in ("position", "target")]
            return moved[0], moved[1]

        turned, aim = drag("left")
        assert np.linalg.norm(turned) > 0.5 and np.linalg.norm(aim) < 1e-9
        moved, aim = drag("right")
        assert moved == pytest.approx(aim, abs=1e-6) and np.linalg.norm(moved) > 0.1
        before = tab.do("(window.before = it.cameraFrame())")
        tab.page.mouse.wheel(0, -300)
        tab.wait("it.cameraFrame().position.join() !== window.before.position.join()")
        after = tab.do("it.cameraFrame()")
        distances = [
            np.linalg.norm(np.subtract(f["position"], f["target"])) for f in (before, after)
        ]
        assert distances[1] < distances[0]
        assert tab.do("it.selected") is None


@pytest.mark.slow
def test_the_picture_shows_bodies_cable_and_ground_in_their_colours(show: Any) -> None:
    with show(sample(), address="t=0.5") as tab:
        picture = pixels(tab)
        assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 500
        for colour in ("#0072b2", "#e69f00", "#009e73"):  # crank, weight, sheave
            assert near(picture, colour) > 300


def test_playing_moves_bodies_as_the_results_say(show: Any) -> None:
    with show(sample()) as tab:
        assert tab.do("it.bodyPosition('PART/2')") == pytest.approx(crank(0), abs=CHORD)
        tab.page.locator("button.play").click()
        tab.wait("it.time > 0.4")
        tab.page.locator("button.play").click()
        places = "[it.time, it.bodyPosition('PART/2'), it.bodyPosition('POINT_MASS/3')]"
        time, place, height = tab.do(f"(it.renderFrame(), {places})")
        assert not tab.do("it.playing")
        pull = 40 + 10 * np.sin(np.pi * time)
        assert float(tab.seen(".legend .value >> nth=0").split()[0]) == pytest.approx(pull, 1e-3)
        assert place == pytest.approx(crank(time), abs=CHORD)
        assert height == pytest.approx(weight(time), abs=CHORD)


@pytest.mark.slow
@pytest.mark.parametrize("time", [0.0, 0.123, 1.0, 1.999, 2.0])
def test_at_any_time_a_body_has_its_place_and_attitude(show: Any, time: float) -> None:
    with show(sample()) as tab:
        tab.do(f"(it.seek({time}), it.renderFrame())")
        assert tab.do("it.bodyPosition('crank arm')") == pytest.approx(crank(time), abs=CHORD)
        angle = 2 * np.pi * time / END
        turned = np.array([0, 0, np.sin(angle / 2), np.cos(angle / 2)])
        assert tab.do("it.bodyAttitude('PART/2')") == pytest.approx(turned, abs=1e-3)


@pytest.mark.slow
def test_playing_begins_again_at_the_end_and_stops_there_when_not_repeated(show: Any) -> None:
    with show(sample()) as tab:
        tab.do("(it.seek(1.9), it.play())")
        tab.wait("it.time < 1.5")
        tab.page.get_by_label("Repeat").click()
        tab.do("it.seek(1.9)")
        tab.wait("!it.playing")
        assert tab.do("it.time") == END


def test_picking_names_the_part_and_says_where_it_is_and_how_fast(show: Any) -> None:
    with show(sample(), address="t=0.5") as tab:
        click(tab, tab.do("it.screenPosition('POINT_MASS/3')"))
        assert tab.do("it.selected") == "POINT_MASS/3"
        card = tab.seen(".selection")
        assert "POINT_MASS/3" in card and "5 kg" in card
        assert "1.25, -0.7, 0 m" in card
        tab.do("(it.seek(0), it.renderFrame())")
        speed = float(tab.seen(".selection dd >> nth=2").split()[0])
        assert speed == pytest.approx(0.3 * np.pi, rel=1e-3)
        tab.do("it.select('PART/4')")
        turning = float(tab.seen(".selection dd >> nth=3").split()[0])
        assert turning == pytest.approx(3 * TURNS / END, rel=1e-3)
        tab.page.keyboard.press("Escape")
        assert tab.do("it.selected") is None


@pytest.mark.slow
def test_a_body_is_picked_anywhere_on_it_and_none_beside_it(show: Any) -> None:
    with show(sample(), address="t=0.5") as tab:
        x, y = tab.do("it.screenPosition('POINT_MASS/3')")
        assert tab.do(f"it.pick({x + 18}, {y})") == "POINT_MASS/3"
        assert tab.do("it.pick(2, 300)") is None


@pytest.mark.slow
def test_names_of_bodies_are_text(show: Any) -> None:
    with show(sample(), address="t=0.5&show=labels") as tab:
        assert "Rolle <b>ö</b>" in tab.page.locator(".label").all_inner_texts()


@pytest.mark.slow
def test_the_camera_frames_the_whole_motion(show: Any) -> None:
    with show(sample()) as tab:
        for view in ("iso", "x", "y", "z", "start"):
            tab.do(f"it.view('{view}')")
            for time in np.linspace(0, END, 9):
                tab.do(f"(it.seek({time}), it.renderFrame())")
                for name in ("PART/2", "POINT_MASS/3", "PART/4"):
                    x, y = tab.do(f"it.screenPosition('{name}')")
                    assert 0 < x < 880 and 0 < y < 620, (view, time, name)


@pytest.mark.slow
def test_views_look_along_their_axes(show: Any) -> None:
    with show(sample()) as tab:
        for k, name in enumerate("xyz"):
            tab.do(f"it.view('{name}')")
            frame = tab.do("it.cameraFrame()")
            towards = np.subtract(frame["position"], frame["target"])
            assert towards[k] / np.linalg.norm(towards) == pytest.approx(1, abs=1e-5)


@pytest.mark.slow
def test_a_followed_body_stays_where_it_is_in_the_picture(show: Any) -> None:
    with show(sample()) as tab:
        tab.do("it.select('PART/2')")
        before = tab.do("it.screenPosition('PART/2')")
        tab.page.get_by_label("Follow this body").click()
        tab.do("(it.seek(0.8), it.renderFrame())")
        assert tab.do("it.screenPosition('PART/2')") == pytest.approx(before, abs=0.5)


@pytest.mark.slow
def test_a_cable_runs_along_tangents_and_around_the_rim(show: Any) -> None:
    """The weight hangs below the right of the sheave, the other end is below its left."""
    with show(sample()) as tab:
        drawn = tab.do("Array.from(it.app.cables.list[0].strokes.array)")
        pieces = np.array(drawn).reshape(-1, 2, 4)
        assert pieces[0, :, :3] == pytest.approx(
            np.array([[1.25, -1, 0], [1.25, 0.5, 0]]), abs=1e-4
        )
        arc = pieces[1:-1, 1, :3] - [1.0, 0.5, 0.0]
        assert np.linalg.norm(arc, axis=1) == pytest.approx(0.25, abs=1e-6)
        assert arc[:, 1].min() >= -1e-6  # over the top
        assert pieces[-1, :, :3] == pytest.approx(
            np.array([[0.75, 0.5, 0], [0.75, -1.5, 0]]), abs=1e-4
        )
        # 40 N and 36 N at the start, of a range from 27 N to 50 N
        ends = [(40 - 27) / 23, (36 - 27) / 23]
        assert [pieces[0, 0, 3], pieces[-1, 1, 3]] == pytest.approx(ends, abs=1e-4)
        assert tab.seen(".tension").split() == ["tension", "(N)", "27", "50"]


@pytest.mark.slow
def test_a_spring_reaches_from_end_to_end(show: Any) -> None:
    with show(sample()) as tab:
        tab.do("(it.seek(0.5), it.renderFrame())")
        matrix = tab.do("Array.from(it.app.springs.groups[0].mesh.instanceMatrix.array)")
        start, along = np.array(matrix[12:15]), np.array(matrix[8:11])
        assert start == pytest.approx(crank(0.5), abs=CHORD)
        assert start + along == pytest.approx([0, -1.4, 0], abs=1e-5)


@pytest.mark.slow
def test_a_mode_swings_the_bodies_that_take_part(show: Any) -> None:
    with show(sample()) as tab:
        rest = np.array(tab.do("it.bodyPosition('POINT_MASS/3')"))
        most = 0.12 * tab.do("it.app.box.radius")
        tab.do("it.mode(0)")
        for phase, part in ((0, 1), (np.pi / 2, 0), (np.pi, -1)):
            place = f"(it.app.modes.setPhase({phase}), it.bodyPosition('POINT_MASS/3'))"
            swung = np.array(tab.do(place))
            assert swung - rest == pytest.approx([0, part * most, 0], abs=1e-5)
        tab.do("(it.seek(0), it.renderFrame())")
        assert tab.do("it.bodyPosition('POINT_MASS/3')") == pytest.approx(rest, abs=1e-6)


@pytest.mark.slow
def test_on_a_phone_everything_is_within_the_width(show: Any) -> None:
    with show(sample(), size=PHONE, device_scale_factor=2, has_touch=True) as tab:
        assert tab.do("document.documentElement.scrollWidth") == PHONE[0]
        outside = tab.do(
            "[...document.querySelectorAll('button, input, select, canvas')]"
            ".filter(e => e.getClientRects().length)"
            ".filter(e => e.getBoundingClientRect().right > innerWidth + 1)"
            ".map(e => e.outerHTML)"
        )
        assert outside == []
        for selector in ("canvas.scene", ".player", ".plots"):
            assert tab.page.locator(selector).is_visible()


@pytest.mark.slow
def test_a_page_is_dark_where_the_system_is_and_where_it_is_switched(show: Any) -> None:
    dark, light = "rgb(23, 28, 35)", "rgb(255, 255, 255)"
    background = "getComputedStyle(document.querySelector('.panel')).backgroundColor"
    with show(sample(), color_scheme="dark") as tab:
        assert tab.do(background) == dark
        assert pixels(tab)[2, -2].max() < 40
        tab.page.get_by_label("Dark or light (T)").click()
        assert tab.do(background) == light
        assert pixels(tab)[2, -2].min() > 200


NOTHING = bare()
ONE_TIME = {"times": {"at": 0, "shape": [1], "coding": "f32"}}


@pytest.mark.slow
@pytest.mark.parametrize("text", [NOTHING, bare(**ONE_TIME)], ids=["no time", "one time"])
def test_a_page_with_nothing_to_see_is_shown_all_the_same(show: Any, text: str) -> None:
    with show(text) as tab:
        assert tab.page.locator("button.play").is_disabled()
        assert tab.do("it.bodyPosition('PART/1')") == [0, 0, 0]
        tab.page.keyboard.press(" ")
        assert not tab.do("it.playing")


@pytest.mark.slow
def test_without_graphics_the_page_says_so(show: Any) -> None:
    refuse = "HTMLCanvasElement.prototype.getContext = () => null;"
    with show(sample(), before=refuse, quiet=False) as tab:
        assert "shows no 3-D graphics" in tab.seen(".failure")


@pytest.mark.slow
def test_a_thousand_masses_are_drawn_by_few_calls_of_few_triangles(show: Any) -> None:
    """What takes software renderers time is counted: time itself depends on who measures."""
    with show(swarm(1000)) as tab:
        tab.do("(it.seek(1), it.renderFrame())")
        drawn = tab.do("({ ...it.app.stage.renderer.info.render })")
        assert drawn["calls"] <= 5
        assert drawn["triangles"] == 2 * 1000 + 2 * 999
        x, z = divmod(499, 32)
        place = [0.2 * x + 0.05 * np.cos(1), 0.4 * np.sin(2 * np.pi * (0.5 + x / 32)), 0.2 * z]
        assert tab.do("it.bodyPosition('POINT_MASS/501')") == pytest.approx(place, abs=1e-3)
        tab.do("it.view('y')")
        click(tab, tab.do("it.screenPosition('POINT_MASS/501')"))
        assert tab.do("it.selected") == "POINT_MASS/501"
        tab.do("it.renderFrame()")


@pytest.mark.slow
def test_lines_are_tangents_of_wheels_that_turn_either_way(show: Any) -> None:
    """From a point around two wheels crosswise to a point, and a belt around both: every straight
    piece is perpendicular to the radii at which it begins and ends, and runs as the wheels turn.
    """
    first, second = [0, 0, 0, 0, *UPRIGHT], [0, 2, 1, 0, *UPRIGHT]
    crossed = [
        {"point": [0, -3, 1, 0]},
        {"wheel": first, "radius": 0.5, "sense": 1},
        {"wheel": second, "radius": 0.8, "sense": -1},
        {"point": [0, 5, -2, 0]},
    ]
    belt = [{"wheel": at, "radius": r, "sense": 1} for at, r in ((first, 0.5), (second, 0.8))]
    cable = {"name": "", "tension": None, "range": [0, 0]}
    text = bare(cables=[{**cable, "nodes": crossed}, {**cable, "nodes": [*belt, belt[0]]}])
    with show(text) as tab:
        lines = [
            np.array(drawn).reshape(-1, 2, 4)[..., :3]
            for drawn in tab.do("it.app.cables.list.map(c => Array.from(c.strokes.array))")
        ]
    # straight pieces of the first, then wheel, radius and sense at their ends
    centres = np.array([[0, 0, 0], [2, 1, 0]])
    rims = [(centres[0], 0.5, 1), (centres[1], 0.8, -1)]
    into, between, out = lines[0][0], lines[0][25], lines[0][50]
    ends = [(into, 1, rims[0]), (between, 0, rims[0]), (between, 1, rims[1]), (out, 0, rims[1])]
    loop = [(lines[1][24], 0, (centres[0], 0.5, 1)), (lines[1][24], 1, (centres[1], 0.8, 1))]
    for (start, end), which, (centre, radius, sense) in (*ends, *loop):
        arm = (start, end)[which] - centre
        along = (end - start) / np.linalg.norm(end - start)
        assert np.linalg.norm(arm) == pytest.approx(radius, abs=1e-5)
        assert np.cross([0, 0, sense], arm / radius) == pytest.approx(along, abs=1e-5)
    assert lines[1][-1, 1] == pytest.approx(lines[1][24, 0], abs=1e-5)  # the belt closes


@pytest.mark.slow
@pytest.mark.parametrize("count, pieces", [(40, 0), (41, 11), (150, 11), (151, 1)])
def test_many_springs_are_lines_between_their_ends(show: Any, count: int, pieces: int) -> None:
    ends = [([0, k, 0, 0], [0, k, 2 + k, 1]) for k in range(count)]
    springs = [
        {"statement": f"SPRINGDAMPER/{k}", "i": i, "j": j, "coils": 8, "diameter": 0.1}
        for k, (i, j) in enumerate(ends)
    ]
    with show(bare(springs=springs)) as tab:
        assert tab.do("Boolean(it.app.springs.groups[0].strokes)") == (pieces > 0)
        if pieces:
            drawn = tab.do("Array.from(it.app.springs.groups[0].strokes.array)")
            lines = np.array(drawn).reshape(count, pieces, 2, 4)[..., :3]
            assert lines[:, 0, 0] == pytest.approx(np.array([i[1:] for i, _ in ends]), abs=1e-5)
            assert lines[:, -1, 1] == pytest.approx(np.array([j[1:] for _, j in ends]), abs=1e-4)
            assert lines[:, 1:, 0] == pytest.approx(lines[:, :-1, 1])  # one line without gaps


@pytest.mark.slow
def test_many_rods_are_lines_from_end_to_end(show: Any) -> None:
    rods = [solid("rod", 0, (k, 0, 0), to=[0.0, 3.0, 4.0]) for k in range(61)]
    with show(bare(shapes=rods)) as tab:
        drawn = tab.do("Array.from(it.app.shapes.lines[0].strokes.array)")
        ends = np.array(drawn).reshape(61, 2, 4)[..., :3]
        assert ends[:, 0] == pytest.approx(np.array([[k, 0, 0] for k in range(61)]), abs=1e-5)
        assert ends[:, 1] == pytest.approx(np.array([[k, 3, 4] for k in range(61)]), abs=1e-5)


@pytest.mark.slow
def test_a_page_works_in_the_frame_of_a_notebook(show: Any) -> None:
    with show(f"<!DOCTYPE html><body>{framed(sample())}</body>") as tab:
        frame = tab.page.frame_locator("iframe")
        frame.locator("button.play").wait_for()
        inside = tab.page.frames[1]
        inside.wait_for_function("() => window.adamslite?.time > 0")
        time, place = inside.evaluate(
            "() => { const it = window.adamslite; it.pause(); it.renderFrame();"
            " return [it.time, it.bodyPosition('PART/2')]; }"
        )
        assert place == pytest.approx(crank(time), abs=CHORD)

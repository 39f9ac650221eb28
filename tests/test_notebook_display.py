"""What notebooks show of decks, results, modes, comparisons and charts."""

from __future__ import annotations

import re
from dataclasses import replace
from html import unescape
from html.parser import HTMLParser
from math import pi, sqrt
from typing import Any

import numpy as np
import pytest

import adamslite as al
from adamslite.errors import UsageError
from adamslite.resources import find

SPRING = """A mass on a spring, <b>20 N/m</b> & a damper
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=1.1,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=20, C=0.4, LENGTH=1
"""
RUN = "SIMULATE/DYNAMIC, END=1, STEPS=10\n"
VOID = {"meta", "link", "br", "hr", "img", "input", "circle", "path", "line", "rect", "use"}


class Document(HTMLParser):
    """Elements, balanced, with their attributes; rows of cells; text outside of frames."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.rows: list[list[str]] = []
        self.text = ""
        self.feed(text)
        self.close()
        assert not self.open, f"not closed: {self.open}"

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag: str) -> None:
        if tag not in VOID:
            assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data
        if self.open and self.open[-1] in ("td", "th"):
            self.rows[-1][-1] += data

    def of(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.elements if name == tag]


def shown(thing: Any) -> Document:
    """A notebook asks the object itself."""
    html = thing._repr_html_()
    assert html == al.html(thing)
    return Document(html)


def test_a_deck_shows_its_check() -> None:
    """A warning with its place, the counts, the contents, the text; nothing of it is markup."""
    text = SPRING.replace("UNITS/SYSTEM=MKS", "UNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9806.65") + "END\n"
    document = shown(al.read(text))
    assert "A mass on a spring, <b>20 N/m</b> & a damper: 1 warning" in document.text
    assert re.search(r"<text>:3:\d+: warning: gravity is 9806.65", document.text)
    assert "[gravity-units]" in document.text
    assert "3 degrees of freedom: 0 moving parts, 1 point mass" in document.text
    assert "SPRINGDAMPER/1, TRANSLATIONAL, I=2" in document.text
    assert len(document.of("b")) == 3  # title, counts, severity


def test_a_deck_without_mistakes_says_so() -> None:
    assert "no mistakes found" in shown(al.read(SPRING + "END\n")).text


def test_a_check_with_errors_shows_them_all() -> None:
    wrong = SPRING.replace("MASS=2,", "MASS=2, BUS=3,").replace("J=1,", "J=7,") + "END\n"
    found = al.check(wrong)
    document = shown(found)
    assert "2 errors, 0 warnings" in document.text
    assert "POINT_MASS has no argument BUS" in document.text
    assert "there is no MARKER/7" in document.text


def test_a_long_deck_is_shown_in_part() -> None:
    comments = "! nothing\n" * 5000
    text = shown(al.read(SPRING + comments + "END\n")).text
    assert "... " in text and " more lines" in text and text.count("! nothing") < 1000


def test_mistakes_are_all_that_a_notebook_prints_of_them() -> None:
    with pytest.raises(al.DeckError) as caught:
        al.read(SPRING.replace("J=1,", "J=7,") + "END\n")
    lines = caught.value._render_traceback_()
    assert lines[0] == "DeckError: 1 mistake" and "there is no MARKER/7" in lines[-1]


def test_results_show_outcome_table_and_page() -> None:
    results = al.simulate(SPRING + RUN + "END\n")
    document = shown(results)
    assert "The run reached its end." in document.text
    rows = dict(row for row in document.rows if len(row) == 2)
    assert rows["reached"] == "t = 1"
    assert rows["degrees of freedom"] == "3"
    assert rows["steps"].startswith(f"{results.summary['steps']} and ")
    assert f"{len(results.names)} channels at 11 times" in document.text
    (frame,) = document.of("iframe")
    assert frame["sandbox"] == "allow-scripts allow-downloads"
    page = frame["srcdoc"] or ""
    assert page.startswith("<!DOCTYPE html>") or page.startswith("<!doctype html>")
    assert "POINT_MASS/2" in page and 'id="scene"' in page


def test_results_name_the_command_file_that_lies_beside(tmp_path: Any) -> None:
    (tmp_path / "spring.adm").write_text(SPRING + "END\n")
    (tmp_path / "spring.acf").write_text(RUN)
    rows = shown(al.simulate(tmp_path / "spring.adm")).rows
    assert ["deck", "spring.adm"] in rows and ["commands", "spring.acf"] in rows
    rows = shown(al.simulate(SPRING + "END\n", commands=RUN)).rows
    assert {row[0] for row in rows}.isdisjoint({"deck", "commands"})


def test_the_frame_is_small() -> None:
    """A long run of a small deck is decimated: two million numbers become less than a megabyte
    beside the program of the page."""
    time = np.linspace(0.0, 1.0, 200_001)
    short = al.simulate(SPRING + RUN + "END\n")
    values = np.column_stack([np.sin(50.0 * time + k) for k in range(len(short.names))])
    long = replace(short, time=time, values=values)
    assert len(al.html(long)) < len(al.html(short)) + 1_000_000


def test_results_of_an_early_end_show_why() -> None:
    text = SPRING + "VFORCE/1, I=2, J_PART=1, FX=1/(0.5-TIME)\\FY=0\\FZ=0\n" + RUN + "END\n"
    results = al.simulate(text)
    assert not results.outcome.is_requested
    document = shown(results)
    assert f"stopped early ({results.outcome.name})" in document.text
    assert "VFORCE/1" in document.text


def test_results_that_carry_no_deck_show_their_table(tmp_path: Any) -> None:
    al.simulate(SPRING + RUN + "END\n").save(tmp_path / "spring.csv")
    document = shown(al.Results.load(tmp_path / "spring.csv"))
    assert "Nothing is drawn: the results carry no deck" in document.text
    assert not document.of("iframe")


def test_empty_results_show_that_they_are() -> None:
    empty = al.Results(time=np.zeros(0), names=(), values=np.zeros((0, 0)))
    assert "0 channels at 0 times" in shown(empty).text


def test_results_are_short_in_a_terminal() -> None:
    results = al.simulate(SPRING + RUN + "END\n")
    count = len(results.names)
    assert repr(results) == (
        f"<Results of 'A mass on a spring, <b>20 N/m</b> & a damper': {count} channels at 11 "
        "times, t = 0 to 1; DONE>"
    )


def test_a_linearisation_shows_its_modes() -> None:
    """2 kg at 20 N/m and 0.4 N s/m along x: omega = sqrt(10), damping ratio c/(2 sqrt(k m))."""
    document = shown(al.linearize(SPRING.replace("1.1", "1") + "END\n"))
    assert document.rows[0] == ["mode", "frequency [Hz]", "damping ratio", "real", "imaginary"]
    along = document.rows[-1]
    assert float(along[1]) == pytest.approx(sqrt(10) / (2 * pi), rel=1e-5)
    assert float(along[2]) == pytest.approx(0.4 / (2 * sqrt(20 * 2)), rel=1e-3)
    assert along[4].startswith("± ")
    assert "6 states, 0 inputs, 0 outputs" in document.text


def test_a_comparison_shows_what_is_outside_first() -> None:
    results = al.simulate(SPRING + RUN + "END\n", error=1e-8)
    moved = results.values.copy()
    moved[3:, results.names.index("POINT_MASS/2.vx")] += 0.5
    found = al.compare(replace(results, values=moved), results)
    document = shown(found)
    assert "1 outside its tolerance" in document.text
    assert document.rows[1][0] == "POINT_MASS/2.vx"
    assert float(document.rows[1][1]) == pytest.approx(0.5)
    assert document.rows[1][4] == "0.3"
    assert "all within their tolerances" in shown(al.compare(results, results)).text


def test_a_chart_shows_all_points_and_a_recommendation() -> None:
    chart = al.chart(SPRING + RUN + "END\n", integrator="gstiff", error=[1e-4, 1e-6], repeats=1)
    document = shown(chart)
    assert [row[1] for row in document.rows[1:]] == [point.setting for point in chart.points]
    assert re.search(r"recommended: GSTIFF|no run has 3 digits", document.text)
    (picture,) = document.of("img")
    assert (picture["src"] or "").startswith("data:image/png;base64,iVBOR")
    errors = [float(row[4]) for row in document.rows[1:]]
    np.testing.assert_allclose(errors, [point.error for point in chart.points], rtol=0.05)


def test_a_chart_without_matplotlib_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    from adamslite.notebooks import chart as display

    def absent(*given: Any) -> None:
        raise UsageError("matplotlib is not installed")

    monkeypatch.setattr(display, "accuracy_chart", absent)
    chart = al.chart(SPRING + RUN + "END\n", integrator="gstiff", error=1e-4, repeats=1)
    document = shown(chart)
    assert "matplotlib is not installed" in document.text and not document.of("img")


def test_a_deck_is_short_in_a_terminal() -> None:
    assert repr(al.read("A deck\nPART/1, GROUND\nEND\n")) == "<Deck 'A deck': 2 statements>"


def test_what_is_not_of_this_package_is_not_shown() -> None:
    with pytest.raises(TypeError, match="int"):
        al.html(3)  # type: ignore[arg-type]


def test_a_frame_of_a_reference_deck_is_whole() -> None:
    """What the notebook reads is the page, letter by letter."""
    from adamslite.page.page import page

    results = al.simulate(find("decks") / "hanging-mass" / "hanging-mass.adm")
    html = al.html(results)
    found = re.search(r'srcdoc="([^"]*)"', html)
    assert found and unescape(found[1]) == page(results)

"""The notebook of the tutorials is run, in an empty folder, and shows what its text says."""

from __future__ import annotations

import os
import re
from math import cos, exp, pi, sin, sqrt
from pathlib import Path
from typing import Any

import nbclient
import nbformat
import pytest

ROOT = Path(__file__).parent.parent
NOTEBOOK = ROOT / "docs" / "tutorials" / "notebook.ipynb"

pytestmark = pytest.mark.slow  # a kernel of its own, which imports and may compile

# 2 kg on 200 N/m and 2 N s/m, released 0.1 m beyond the free length.
K, M, C, STRETCH = 200.0, 2.0, 2.0, 0.1
DECAY = C / (2 * M)
OMEGA = sqrt(K / M - DECAY**2)


def notebook() -> Any:
    return nbformat.read(NOTEBOOK, as_version=4)


@pytest.fixture(scope="module")
def cells(tmp_path_factory: pytest.TempPathFactory) -> dict[str, dict[str, str]]:
    """For the first line of each cell what it shows: MIME type to content, and `printed`."""
    run = notebook()
    folder = tmp_path_factory.mktemp("notebook")
    before = os.environ.get("PYTHONPATH")
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(ROOT), before]))
    try:
        resources = {"metadata": {"path": str(folder)}}
        nbclient.NotebookClient(
            run, timeout=300, kernel_name="python3", resources=resources
        ).execute()
    finally:
        os.environ.pop("PYTHONPATH")
        if before is not None:
            os.environ["PYTHONPATH"] = before
    code = [each for each in run.cells if each.cell_type == "code"]
    return {each.source.split("\n")[0]: _shown(each.outputs) for each in code}


def _shown(outputs: list[Any]) -> dict[str, str]:
    found = {"printed": ""}
    for each in outputs:
        if each.output_type == "stream":
            assert each.name == "stdout", each.text
            found["printed"] += each.text
        elif each.output_type == "execute_result":  # not the progress, which is gone at the end
            found.update(each.data)
    return found


def test_it_is_kept_without_outputs() -> None:
    for each in notebook().cells:
        assert each.get("outputs", []) == [] and each.get("execution_count") is None


def test_a_deck_shows_its_check(cells: Any) -> None:
    html = cells['text = """A mass on a spring and a damper']["text/html"]
    assert "no mistakes found" in html and "1 SPRINGDAMPER" in html
    assert "3 degrees of freedom" in html


def test_results_show_a_table_and_the_page(cells: Any) -> None:
    shown = cells["results = al.simulate(deck)"]
    html = shown["text/html"]
    assert "The run reached its end." in html and "t = 2</td>" in html
    assert '<iframe srcdoc="&lt;!' in html and 'sandbox="allow-scripts allow-downloads"' in html
    assert "11 channels at 201 times" in shown["text/plain"]


def test_the_motion_is_the_closed_form(cells: Any) -> None:
    """ERROR=1E-7 over 200 steps or so."""
    printed = cells["m, k, c = 2.0, 200.0, 2.0"]["printed"]
    assert 0.0 < float(re.search(r"largest error: (\S+) m", printed)[1]) < 1e-5


def test_a_figure_is_a_picture(cells: Any) -> None:
    shown = cells['results.plot("POINT_MASS/2.x", "REQUEST/1.F2")']
    assert shown["image/png"].startswith("iVBOR") and len(shown["image/png"]) > 10_000


def test_a_table_begins_with_the_stretched_spring(cells: Any) -> None:
    """At the start, where the force is largest: x = 1.1 m and -200 N/m 0.1 m = -20 N."""
    text = cells["table = results.to_pandas()"]["text/plain"]
    rows = {line.split()[0]: line.split()[1:] for line in text.splitlines()[1:]}
    assert float(rows["max"][0]) == pytest.approx(1 + STRETCH)
    assert float(rows["min"][1]) == pytest.approx(-K * STRETCH)
    assert float(rows["count"][0]) == 201


def test_modes_are_those_of_the_text(cells: Any) -> None:
    html = cells['modes = al.linearize(text.replace("QG=1.1", "QG=1"), commands=())']["text/html"]
    values = [float(each) for each in re.findall(r">([-\d.e]+)</td>", html)]
    for wanted in (sqrt(K / M) / (2 * pi), DECAY / sqrt(K / M), -DECAY):
        assert any(each == pytest.approx(wanted, rel=1e-4) for each in values), wanted
    said = " ".join(each.source for each in notebook().cells)
    assert f"{OMEGA / (2 * pi):.3f} Hz" in said and f"{DECAY / sqrt(K / M):g}" in said


def test_every_damping_gives_its_closed_form(cells: Any) -> None:
    printed = cells["for damping in (0.0, 2.0, 8.0):"]["printed"]
    found = re.findall(r"C = (\S+): x\(1 s\) = (\S+) m, exactly (\S+) m", printed)
    assert len(found) == 3
    for damping, computed, shown in found:
        d = float(damping) / (2 * M)
        w = sqrt(K / M - d**2)
        exact = 1 + STRETCH * exp(-d) * (cos(w) + d / w * sin(w))
        assert float(shown) == pytest.approx(exact, abs=1e-5)
        assert float(computed) == pytest.approx(exact, abs=2e-5)


def test_results_are_compared(cells: Any) -> None:
    html = cells["rough = al.simulate(text, error=1e-3)"]["text/html"]
    assert "all within their tolerances" in html


def test_a_chart_recommends(cells: Any) -> None:
    html = cells['methods = ["GSTIFF", "ABAM"]']["text/html"]
    assert "data:image/png;base64," in html and "recommended: " in html
    assert "9 runs" in html  # GSTIFF in two formulations, ABAM


def test_mistakes_speak_python(cells: Any) -> None:
    first = 'al.check(text.replace("I=2, J=1, K=200", "I=3, J=1, KK=200"))'
    html = cells[first]["text/html"]
    assert "2 errors, 0 warnings" in html and "there is no MARKER/3" in html
    assert "did you mean K?" in html
    assert cells[first]["text/plain"].endswith("2 errors, 0 warnings")
    lines = cells["for mistake in ("]["printed"].splitlines()
    assert lines[0].startswith("integrator='GSTIF': there are ")
    assert lines[1] == "end=-1.0: it must be a positive number"
    assert lines[2].startswith("no result is called 'POINTMASS/2.x'; did you mean POINT_MASS/2.x")


def test_no_output_speaks_of_flags(cells: Any) -> None:
    printed = "".join(each["printed"] for each in cells.values())
    assert printed and "--" not in printed


def test_files_are_read_again(cells: Any) -> None:
    printed = cells['results.save("spring.nc")']["printed"]
    assert "11 channels at 201 times, t = 0 to 2; DONE" in printed


def test_a_page_of_the_manual_is_set(cells: Any) -> None:
    assert cells['al.help("SPRINGDAMPER")']["text/markdown"].startswith("## SPRINGDAMPER")

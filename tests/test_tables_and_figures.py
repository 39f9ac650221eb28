"""Results as tables of pandas and xarray, as figures, and as pages."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import adamslite as al
from adamslite.errors import FormatError, UsageError
from adamslite.results.results import UnknownChannel

THROW = """A stone
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, VX=3
MARKER/2, POINT_MASS=2
REQUEST/1, F2=DX(2)
INTEGRATOR/GSTIFF, ERROR=1E-8
SIMULATE/DYNAMIC, END=2, STEPS=4
END
"""
OTHER = THROW.replace("/2", "/7").replace("POINT_MASS=2", "POINT_MASS=7")
OTHER = OTHER.replace("CM=2", "CM=7").replace("DX(2)", "DX(7)")


@pytest.fixture(scope="module")
def thrown() -> al.Results:
    """x = 3 t, y = -5 t^2 at 0, 0.5, 1, 1.5, 2 s."""
    return al.simulate(THROW)


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Files without a folder are written to an empty one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_pandas_has_a_column_for_each_channel(thrown: al.Results) -> None:
    frame = thrown.to_pandas()
    assert list(frame.columns) == list(thrown.names)
    assert frame.index.name == "time"
    np.testing.assert_array_equal(frame.index, [0.0, 0.5, 1.0, 1.5, 2.0])
    np.testing.assert_allclose(frame["POINT_MASS/2.y"], -5 * np.array(frame.index) ** 2, atol=1e-6)
    assert frame.loc[1.0, "POINT_MASS/2.x"] == pytest.approx(3.0)
    units = frame.attrs["channel units"]
    assert (units["POINT_MASS/2.vx"], units["REQUEST/1.F2"]) == ("m/s", "m")
    assert frame.attrs["outcome"] == "DONE" and frame.attrs["deck"] == "A stone"


def test_xarray_has_what_the_file_has(thrown: al.Results) -> None:
    import xarray

    thrown.save("stone.nc")
    data = thrown.to_xarray()
    with xarray.open_dataset("stone.nc") as read:
        assert data.identical(read.load())
    x = data.position.sel(body="POINT_MASS/2", axis="x")
    np.testing.assert_allclose(x, 3.0 * data.time, atol=1e-6)
    assert x.units == "m"


def test_columns_are_selected(thrown: al.Results) -> None:
    chosen = thrown.select("REQUEST/*", "POINT_MASS/2.v?")
    assert chosen.names == tuple(f"POINT_MASS/2.v{axis}" for axis in "xyz") + ("REQUEST/1.F2",)
    np.testing.assert_array_equal(chosen["REQUEST/1.F2"], thrown["REQUEST/1.F2"])
    assert chosen.outcome is thrown.outcome
    assert thrown.select("POINT_MASS/2.x").view("few.html").is_file()
    with pytest.raises(FormatError, match="the given table has no position of a body"):
        chosen.view("few.html")
    assert "Nothing is drawn: the table has no position of a body" in al.html(chosen)
    assert len(thrown.select("POINT_MASS/2").names) == len(thrown.names) - 1
    with pytest.raises(UsageError, match=r"no result is called 'PART/9'; did you mean|there are"):
        thrown.select("REQUEST/1", "PART/9")


@pytest.mark.parametrize("library", ["pandas", "xarray"])
def test_a_missing_library_is_named_in_a_sentence(
    thrown: al.Results, library: str, monkeypatch: Any
) -> None:
    monkeypatch.setattr("adamslite.api.tables.find_spec", lambda name: None)
    with pytest.raises(UsageError, match=f"{library}, which is not installed: python -m pip"):
        getattr(thrown, f"to_{library}")()


def test_empty_results_are_empty_tables() -> None:
    empty = al.Results(time=np.zeros(0), names=("PART/2.x",), values=np.zeros((0, 1)))
    assert empty.to_pandas().shape == (0, 1)
    assert empty.to_xarray().sizes["time"] == 0


def test_a_figure_is_drawn_and_written(thrown: al.Results) -> None:
    figure = thrown.plot("POINT_MASS/2.x", "POINT_MASS/2.v?", output="stone.svg")
    assert Path("stone.svg").read_text().startswith("<?xml")
    lines = [
        line for axis in figure.axes for line in axis.get_lines() if len(line.get_xdata()) == 5
    ]
    drawn = {tuple(np.round(line.get_ydata(), 6)) for line in lines}
    assert (0.0, 1.5, 3.0, 4.5, 6.0) in drawn  # x = 3 t
    assert figure._repr_png_().startswith(b"\x89PNG")


@pytest.mark.parametrize("given", ["deck", "text", "file"])
def test_figures_of_decks_and_files(thrown: al.Results, given: str) -> None:
    Path("stone.adm").write_text(THROW)
    thrown.save("stone.csv")
    named = {"deck": al.read("stone.adm"), "text": THROW, "file": "stone.csv"}[given]
    assert al.plot(named, "REQUEST/1.F2").axes


def test_a_figure_beside_a_reference(thrown: al.Results) -> None:
    thrown.save("stone.csv")
    assert al.plot(thrown, ["POINT_MASS/2.x"], against=Path("stone.csv")).axes
    assert thrown.plot("POINT_MASS/2.x", against=thrown, x="POINT_MASS/2.y").axes


def test_wrong_channels_and_files_of_figures(thrown: al.Results) -> None:
    with pytest.raises(UnknownChannel, match=r"did you mean POINT_MASS/2\.x"):
        thrown.plot("POINTMASS/2.x")
    with pytest.raises(UsageError, match="png"):
        thrown.plot("POINT_MASS/2.x", output="stone.bmp")


@pytest.fixture
def opened(monkeypatch: Any) -> list[Path]:
    """What a browser would open."""
    pages: list[Path] = []
    monkeypatch.setattr("adamslite.page.showing.open_page", lambda page: pages.append(page) or True)
    return pages


def test_a_page_is_written_and_opened(opened: list[Path]) -> None:
    Path("stone.adm").write_text(THROW)
    assert al.view("stone.adm") == Path("stone.html")
    assert opened == [Path("stone.html")]
    assert "POINT_MASS/2" in Path("stone.html").read_text("utf-8")


def test_a_page_that_no_browser_opens(thrown: al.Results, monkeypatch: Any) -> None:
    monkeypatch.setattr("adamslite.page.showing.open_page", lambda page: False)
    with pytest.warns(UserWarning, match=r"no browser could be opened; open results\.html"):
        assert al.view(thrown) == Path("results.html")


def test_a_page_that_is_named_is_written_only(thrown: al.Results, opened: list[Path]) -> None:
    assert thrown.view("a stone.html") == Path("a stone.html")
    assert not opened
    thrown.view("a stone.html", show=True)
    assert opened == [Path("a stone.html")]
    with pytest.raises(UsageError, match=r"ends in none of \.html, \.htm, \.glb"):
        thrown.view("stone.pdf")


def test_a_model_and_a_picture_take_the_suffix_of_their_name(
    thrown: al.Results, opened: list[Path], monkeypatch: Any
) -> None:
    """A picture is of one time of the results; a model has one result."""
    assert thrown.view("stone.glb").read_bytes()[:4] == b"glTF" and not opened
    with pytest.raises(UsageError, match="a model .* shows one result"):
        thrown.view("stone.glb", against=thrown)
    with pytest.raises(UsageError, match="a picture is of one time"):
        thrown.view("stone.png")
    drawn: list[tuple[float, Path]] = []
    monkeypatch.setattr(
        "adamslite.page.pictures.write_picture",
        lambda page, time, path, size, **wish: drawn.append((time, path)),
    )
    thrown.view("stone.png", time=0.5)
    assert drawn == [(0.5, Path("stone.png"))]


def test_a_page_of_a_file_that_carries_no_deck(thrown: al.Results, opened: list[Path]) -> None:
    thrown.save("stone.csv")
    with pytest.raises(FormatError, match="carry no deck"):
        al.view("stone.csv")
    Path("thrown.adm").write_text(THROW)
    assert al.view("stone.csv", show=False) == Path("thrown.html")
    assert al.view("stone.csv", deck=THROW, show=False) == Path("results.html")
    with pytest.warns(al.DeckWarning, match="the deck is not the one of these results") as caught:
        al.view("stone.csv", deck=THROW.replace("A stone", "Another stone"), show=False)
    assert [each.filename for each in caught] == [__file__]
    with pytest.warns(al.DeckWarning), pytest.raises(FormatError, match="no column like"):
        al.view("stone.csv", deck=OTHER)


def test_directions_of_pictures_are_known(thrown: al.Results) -> None:
    with pytest.raises(UsageError, match="along='up': there are x, y, z, iso"):
        thrown.view("stone.png", time=1.0, along="up")


def test_two_results_in_a_page(thrown: al.Results) -> None:
    faster = al.simulate(THROW.replace("VX=3", "VX=4"))
    page = thrown.view("both.html", against=faster).read_text("utf-8")
    assert '"against":{"name"' in page


def test_a_notebook_shows_the_page_in_a_frame(thrown: al.Results, monkeypatch: Any) -> None:
    shell = SimpleNamespace(get_ipython=lambda: SimpleNamespace(kernel=object()))
    monkeypatch.setitem(sys.modules, "IPython", shell)
    frame = thrown.view()
    assert frame._repr_html_().startswith('<iframe srcdoc="&lt;!')
    assert repr(frame).startswith("<page of ") and not list(Path().iterdir())
    assert thrown.view("stone.html") == Path("stone.html")


def test_results_with_gaps_are_drawn(thrown: al.Results) -> None:
    """A channel without a value for a while, as after DEACTIVATE."""
    values = thrown.values.copy()
    values[2:4] = np.nan
    gaps = replace(thrown, values=values)
    assert gaps.view("gaps.html").stat().st_size > 0
    assert gaps.plot("POINT_MASS/2.x").axes

"""`plot` and `view` as users of Python call them: figures, and the page that moves."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.api.runs import simulate
from adamslite.deck.deck import Deck
from adamslite.errors import DeckWarning, UsageError
from adamslite.notation import shown
from adamslite.progress.choice import in_notebook
from adamslite.reading.read import read
from adamslite.results.formats import formats
from adamslite.results.results import Results
from adamslite.results.source import source_of
from adamslite.sweeps import netcdf
from adamslite.sweeps.recognition import holds_sweep
from adamslite.sweeps.record import Sweep

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from adamslite.verification.reference_file import Reference


def plot(
    results: Results | Sweep | Deck | str | os.PathLike[str],
    channels: str | Sequence[str] = (),
    against: Reference | Results | str | os.PathLike[str] | None = None,
    x: str | None = None,
    output: str | os.PathLike[str] | None = None,
    deck: Deck | str | os.PathLike[str] | None = None,
    by: str | None = None,
    band: tuple[float, float] | None = None,
    pairs: bool = False,
    indices: bool = False,
    dark: bool = False,
) -> Figure:
    """Draw channels of results, or the runs of a sweep, as `adamslite plot` does; needs
    matplotlib.

    Parameters
    ----------
    results : Results, Sweep, Deck, str or Path
        Results, a sweep, a file of one of them, or a deck, which is solved first.
    channels : str or sequence of str
        Names or patterns: ``PART/2.x``, ``JOINT/*.f?``; of a sweep measures or histories, by
        default all measures.
    against : Reference, Results, str or Path
        A reference, drawn with the band of its tolerance, or other results.
    x : str
        The channel of the horizontal axis; of a sweep the number that varies or the measure.
    output : str or Path
        A file for the figure: .png, .svg or .pdf.
    deck : Deck, str or Path
        That of results which carry none: statement names and units of requests come from it.
    by : str
        Of a sweep the number whose values are colours.
    band : pair of float
        Of a sweep a band of these percentiles in place of a line for each run: ``(0, 100)`` for
        all, ``(5, 95)``.
    pairs, indices : bool
        Of a sweep measures and numbers over each other; Sobol indices.
    dark : bool
        Whether the ground is dark.

    Raises
    ------
    UnknownChannel
        When there is no such channel; names what comes near.
    UsageError
        Without matplotlib, and when there is nothing to draw.
    """
    from adamslite.plots.style import need_matplotlib, need_suffix, save
    from adamslite.plots.sweep_selection import Wanted
    from adamslite.plots.time_histories import plot as drawn

    need_matplotlib()
    if output is not None:
        need_suffix(Path(output))
    sweep = _sweep_of(results)
    if sweep is not None:
        if against is not None or deck is not None:
            raise UsageError("against= and deck= belong to results, and this is a sweep")
        from adamslite.plots.sweep_figures import sweep_figure

        names = [channels] if isinstance(channels, str) else channels
        wanted = Wanted(names=names, x=x, by=by, band=band, pairs=pairs, indices=indices)
        figure = sweep_figure(sweep, wanted, dark)
    elif by or band or pairs or indices:
        raise UsageError("by=, band=, pairs= and indices= belong to a sweep")
    else:
        assert not isinstance(results, Sweep)
        beside = Path(against) if isinstance(against, os.PathLike) else against
        figure = drawn(results_of(results, deck), channels, beside, x or "time", dark)
    if output is not None:
        save(figure, Path(output))
    # A figure made without pyplot has no picture of its own for notebooks.
    setattr(figure, "_repr_png_", lambda: _png(figure))  # noqa: B010
    return figure


def _sweep_of(given: object) -> Sweep | None:
    """A sweep, or that of a file of one; None of anything else."""
    if isinstance(given, Sweep):
        return given
    path = isinstance(given, os.PathLike) or (isinstance(given, str) and "\n" not in given)
    return netcdf.read(Path(given)) if path and holds_sweep(Path(given)) else None  # type: ignore[arg-type]


def _png(figure: Figure) -> bytes:
    content = BytesIO()
    figure.savefig(content, format="png", dpi=110)
    return content.getvalue()


DIRECTIONS = ("x", "y", "z", "iso")


class Frame(str):
    """The text of a page; a notebook shows it in a frame."""

    def _repr_html_(self) -> str:
        from adamslite.page.page import framed

        return framed(self)

    def __repr__(self) -> str:
        return f"<page of {len(self)} characters>"


def view(
    results: Results | Sweep | Deck | str | os.PathLike[str],
    output: str | os.PathLike[str] | None = None,
    against: Results | str | os.PathLike[str] | None = None,
    deck: Deck | str | os.PathLike[str] | None = None,
    show: bool | None = None,
    time: float | None = None,
    size: tuple[int, int] = (1280, 720),
    along: str | None = None,
    dark: bool = False,
    runs: str | Sequence[int] | None = None,
    channels: str | Sequence[str] = (),
) -> Frame | Path:
    """Show how it moves, as `adamslite view` does: in a notebook in a frame, else in the browser.

    Parameters
    ----------
    results : Results, Sweep, Deck, str or Path
        Results, a sweep, a file of one of them, or a deck, which is solved first. The page of a
        sweep shows the run that sliders choose; runs are computed again.
    output : str or Path
        The page (.html) to write; by default the name of the deck, in the current folder.  A
        notebook writes none unless it is named.  Other suffixes: an animated model (.glb), a
        picture (.png) of `time`, a film (.gif, .mp4).
    against : Results, str or Path
        Other results of the same deck, drawn beside these.
    deck : Deck, str or Path
        That of results which carry none.
    show : bool
        Whether a browser opens what is written; by default when no ``output`` is named.
    time : float
        The time of a picture.
    size, along, dark
        Of pictures and films: width and height in pixels, from where they look ("x", "y", "z",
        "iso"; by default the front), and whether the ground is dark.
    runs, channels
        Of a sweep: the runs, by their numbers or as ``"0:100:5"``, and names or patterns of the
        columns to plot.

    Returns
    -------
    Path or Frame
        The file; in a notebook the page, which it shows.

    Raises
    ------
    FormatError
        When there is no deck, or it has none of the bodies of the results.
    """
    from adamslite.drawing.run_deck import deck_of, need_its_bodies
    from adamslite.page.page import page
    from adamslite.page.showing import Look, write_motion

    sweep = _sweep_of(results)
    if sweep is not None:
        return _view_sweep(sweep, output, deck, show, runs, channels)
    if runs is not None or channels:
        raise UsageError("runs= and channels= belong to a sweep")
    assert not isinstance(results, Sweep)
    found = results_of(results, deck)
    need_its_bodies(deck_of(found), found, "the given table")
    other = None if against is None else results_of(against, None)
    name = other.source.name if other is not None and other.source else "the others"
    look = Look(time, size, _look(along, dark))
    if output is None and show is not True and in_notebook():
        return Frame(page(found, None, other, name))
    path = Path(output or f"{found.source.stem if found.source else 'results'}.html")
    write_motion(path, deck_of(found), found, other, name, look)
    return _opened(path, show, output is None)


def _opened(path: Path, show: bool | None, unnamed: bool) -> Path:
    """A page that is written, opened where that is asked for."""
    from adamslite.page.showing import open_page

    if (show or (show is None and unnamed)) and not open_page(path):
        warnings.warn(f"no browser could be opened; open {path} yourself", stacklevel=3)
    return path


def _view_sweep(
    sweep: Sweep,
    output: str | os.PathLike[str] | None,
    deck: Deck | str | os.PathLike[str] | None,
    show: bool | None,
    runs: str | Sequence[int] | None,
    channels: str | Sequence[str],
) -> Frame | Path:
    """The page of a sweep."""
    from adamslite.page.page import write_page
    from adamslite.page.showing import PAGES
    from adamslite.sweeps.motions import numbers_of_runs, page_of_sweep

    path = Path(output or "sweep.html")
    if path.suffix.lower() not in PAGES:
        raise UsageError(f"'{path}': a sweep is shown by a page (.html)")
    names = [channels] if isinstance(channels, str) else channels
    if isinstance(deck, str | os.PathLike):
        deck = read(Path(deck) if isinstance(deck, os.PathLike) else deck)
    numbers = numbers_of_runs(runs, len(sweep)) if isinstance(runs, str) else runs
    page, different = page_of_sweep(sweep, deck, numbers, names)
    if different:
        warnings.warn(different, DeckWarning, stacklevel=3)
    if output is None and show is not True and in_notebook():
        return Frame(page)
    write_page(page, path)
    return _opened(path, show, output is None)


def _look(along: str | None, dark: bool) -> dict[str, str]:
    """The words of a page for a direction and a ground."""
    if along not in (None, *DIRECTIONS):
        raise UsageError(f"--along {along}: there are {', '.join(DIRECTIONS)}")
    return {"theme": "dark" if dark else "light", **({"view": along} if along else {})}


def results_of(
    given: Results | Deck | str | os.PathLike[str], deck: Deck | str | os.PathLike[str] | None
) -> Results:
    """Results, with the deck that they carry or that is given or lies beside their file."""
    if isinstance(given, Deck):
        return simulate(given)
    if isinstance(given, Results):
        return _with_deck(given, deck) if deck is not None else given
    text = isinstance(given, str) and "\n" in given
    if text or Path(given).suffix.lower() not in formats():
        return simulate(given)
    from adamslite.drawing.run_deck import beside

    results = Results.load(Path(given))
    found = deck or (None if results.source else beside(Path(given), results))
    return _in_own_terms(results, None) if found is None else _with_deck(results, found)


def _with_deck(results: Results, deck: Deck | str | os.PathLike[str]) -> Results:
    """Results with a deck; a warning where it is not the one that they were computed from."""
    from adamslite.drawing.run_deck import difference

    source = Path(deck) if isinstance(deck, os.PathLike) else deck
    found = source if isinstance(source, Deck) else read(source)
    if warning := difference(found, results):
        warnings.warn(f"{found.path or found.title}: {warning}", DeckWarning, stacklevel=4)
    return replace(_in_own_terms(results, found), source=source_of(found, ()))


def _in_own_terms(results: Results, deck: Deck | None) -> Results:
    """Results that ADAMS has written in the terms of this program; warnings of what is lost."""
    from adamslite.results.common_terms import of_deck

    results, notes = of_deck(results, deck)
    for note in notes:
        warnings.warn(shown(note), DeckWarning, stacklevel=5)
    return results

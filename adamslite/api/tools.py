"""The other commands as functions: comparison, verification, descriptions of cables, layout, help,
and what is kept between runs.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import Any, NamedTuple

from adamslite.deck.deck import Deck
from adamslite.errors import DeckWarning, FormatError, UsageError
from adamslite.language.diagnostics import WARNING
from adamslite.language.file_name import open_folders
from adamslite.language.text import MOST, contents
from adamslite.progress import Progress, progress_of
from adamslite.reading.read import read
from adamslite.results.comparison import INTERPOLATIONS, Comparison, Tolerance
from adamslite.results.results import Results
from adamslite.verification.common_comparison import compared
from adamslite.verification.reference_file import (
    Reference,
    read_reference,
    tolerance_of,
)
from adamslite.verification.verification import Verdict, find_cases
from adamslite.verification.verification import verify as verify_cases


def compare(
    results: Results | str | os.PathLike[str],
    reference: Results | Reference | str | os.PathLike[str],
    tolerance: Tolerance | Callable[[str], Tolerance] | float | str | None = None,
    interpolate: str | None = None,
    deck: Deck | str | os.PathLike[str] | None = None,
) -> Comparison:
    """Compare results with a reference, channel by channel, as `adamslite diff` does.

    Parameters
    ----------
    results, reference : Results, str or Path
        Results or files of them.  The channels of the reference may be a few of those of the
        results, its times must be output times unless they are interpolated.
    tolerance : float, str, Tolerance, or function of a channel name that returns a Tolerance
        ``X`` for ``"abs X peak X"``, or any of ``"abs A rel R peak P digits N"``.  By default
        what the reference file says, else 1e-6.
    interpolate : {None, "linear", "cubic"}
        How to get values at reference times that are not output times.
    deck : Deck, str or Path
        Where the centres of mass are, to compare with a ``.res`` of ADAMS; by default that of
        either side.

    Warns
    -----
    DeckWarning
        When the two are results of different decks, when units are converted, and of channels of
        ADAMS that cannot be compared.

    Raises
    ------
    Mismatch
        When the results lack a channel or a time of the reference, or the reference is empty.
    UsageError, FormatError
        When the tolerance is none; when a file is not one of results.
    """
    if interpolate is not None and interpolate not in INTERPOLATIONS:
        raise UsageError(f"--interpolate {interpolate}: there are {', '.join(INTERPOLATIONS)}")
    found = results if isinstance(results, Results) else Results.load(Path(results))
    judge = reference_of(reference)
    judge = replace(judge, interpolate=interpolate or judge.interpolate)
    allowed = tolerance if callable(tolerance) else None
    if tolerance is not None and not callable(tolerance):
        given = tolerance if isinstance(tolerance, Tolerance) else tolerance_of(tolerance)
        judge = replace(judge, tolerances=[("*", given)])
    source = Path(deck) if isinstance(deck, os.PathLike) else deck
    read_deck = source if isinstance(source, Deck) or source is None else read(source)
    comparison, notes = compared(found, judge, read_deck, allowed)
    for note in notes:
        warnings.warn(note, DeckWarning, stacklevel=2)
    return comparison


def reference_of(given: Results | Reference | str | os.PathLike[str]) -> Reference:
    """References, given as such, as results or as a file."""
    if isinstance(given, Reference):
        return given
    if isinstance(given, Results):
        return Reference(path=Path(), table=given)
    return read_reference(Path(given))


def verify(*paths: str | os.PathLike[str], jobs: int = 1) -> list[Verdict]:
    """Solve reference decks and compare, as `adamslite verify` does.

    Parameters
    ----------
    *paths : str or Path
        Decks, and folders with decks that have a reference; without any, those that come with the
        program.
    jobs : int
        How many processes share the decks.

    Returns
    -------
    list of Verdict
        For each reference whether it is met (``passed``), what part of its tolerance the worst
        channel uses (``share``), and a sentence (``text``).
    """
    from adamslite.resources import find

    cases = find_cases([Path(each) for each in paths] or [find("decks")])
    if not cases:
        listed = ", ".join(map(str, paths))
        raise UsageError(f"there is no deck with a reference.csv in {listed}")
    return list(verify_cases(cases, jobs=jobs))


def allow_path(folder: str | os.PathLike[str]) -> None:
    """Let decks read tables from this folder and below, too, in this process and its workers.

    A deck reads files from its own folder and below alone: it may have come from somebody else.

    Parameters
    ----------
    folder : str or Path
    """
    open_folders([os.fspath(folder)])


def cable(
    description: str | os.PathLike[str],
    trial: float | None = None,
    progress: Progress | Callable[[float, float], Any] | bool | None = None,
) -> str:
    """The deck of a cable scene, written from a short description of the cable and its route.

    Parameters
    ----------
    description : str or Path
        A file, or the text of a description (TOML, more than one line), as
        docs/reference/cable-command.md has it.
    trial : float
        What runs that try models may cost, in seconds of a usual machine; 0: none is made, the
        linear model chooses.  By default what the description says.
    progress : bool, callable or Progress
        As for :func:`simulate`; it says when an engine is compiled.

    Returns
    -------
    str
        The text of the deck, which :func:`adamslite.simulate` takes.

    Warns
    -----
    DeckWarning
        For every warning about the description.

    Raises
    ------
    DeckError
        With every mistake of the description.
    """
    from adamslite.api.trials import described

    if trial is not None and not 0 <= trial < inf:
        raise UsageError(f"trial={trial!r}: it is a number of seconds, zero or above")
    text, place = description, "<text>"
    if isinstance(text, os.PathLike) or "\n" not in text:
        path = Path(text)
        try:
            text, place = contents(path, MOST).decode("utf-8-sig").replace("\r\n", "\n"), str(path)
        except UnicodeDecodeError as fault:
            raise FormatError(f"{path} is not UTF-8 text: {fault.reason}") from None
    with closing(progress_of(progress)) as shown:
        written = described(text, place, trial, shown).deck
    for each in written.messages:
        if each.severity == WARNING:
            warnings.warn(each.render(), DeckWarning, stacklevel=2)
    return written.text


def fmt(source: str | os.PathLike[str], write: bool = False) -> str:
    """A deck or command file in the canonical layout, as `adamslite fmt` writes it.

    Parameters
    ----------
    source : str or Path
        A file, or a text (more than one line).
    write : bool
        Write it back to the file, where it differs.
    """
    from adamslite.editing.layout import formatted
    from adamslite.editing.text_file import read_text

    if isinstance(source, str) and "\n" in source:
        return formatted(source.replace("\r\n", "\n").replace("\r", "\n"))
    file = read_text(Path(source))
    layout = formatted(file.text, file.place)
    if write and layout != file.text:
        file.replace(layout)
    return layout


class Page(str):
    """A page of the manual, in Markdown; a notebook shows it set."""

    def __repr__(self) -> str:
        return str(self)

    def _repr_markdown_(self) -> str:
        return str(self)


def help(name: str = "") -> Page:
    """What a statement, a function, an integrator or a message means; without a name, all names.

    Raises
    ------
    UsageError
        When nothing is called that; names what comes near.
    """
    from adamslite.manual import lookup

    return Page(lookup.pages(name) if name else lookup.contents())


class Kept(NamedTuple):
    """What is kept between runs: its folder, the number of entries, their size [bytes]."""

    folder: Path
    entries: int
    size: int


def cache(clear: bool = False) -> Kept:
    """Compiled code and tables that are kept between runs, or those that were removed.

    Parameters
    ----------
    clear : bool
        Remove all of it.
    """
    from adamslite.caching import contents
    from adamslite.caching.folder import cache_folder

    folder = cache_folder()
    found = contents.clear(folder) if clear else contents.entries(folder)
    return Kept(folder, len(found), sum(entry.size for entry in found))

"""Pictures and films of a page, drawn by a browser that is installed.

The page draws pictures at several times into its own document, as its address asks, and the browser
prints the document: nothing but the browser is needed, and for films FFmpeg.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
from base64 import b64decode
from collections.abc import Iterator, Sequence
from pathlib import Path
from urllib.parse import urlencode

from adamslite.deck.deck import Deck
from adamslite.elements.units import Units
from adamslite.errors import FormatError, UsageError
from adamslite.language import units
from adamslite.outputs.whole_files import whole_file
from adamslite.page.browsers import VARIABLE, find_browser, flags
from adamslite.results.results import Results

Size = tuple[int, int]
SIZE: Size = (1280, 720)
FILMS = (".gif", ".mp4")
RATES = {".gif": 15, ".mp4": 30}
"""Pictures in a second."""
SHORTEST, LONGEST, PLEASANT = 1.0, 20.0, 8.0
"""A film runs in real time when that takes 1 to 20 seconds, else 8 [s]."""
AT_ONCE = 40
"""Pictures that a browser draws before it is started anew."""
PATIENCE = 300
"""Seconds after which a browser that draws them is given up."""
FILM = re.compile(r'<pre id="film">(.*?)</pre>', re.S)
START = "data:image/png;base64,"
PALETTE = "split[one][two];[one]palettegen=stats_mode=diff[colours];[two][colours]paletteuse"
ENCODING = {
    ".gif": ["-filter_complex", PALETTE],
    ".mp4": ["-c:v", "libx264", "-crf", "20", "-pix_fmt", "yuv420p", "-movflags", "+faststart"],
}


def draw(
    page: str,
    path: Path,
    deck: Deck,
    results: Results,
    time: float | None = None,
    size: Size = SIZE,
    asked: dict[str, str] | None = None,
) -> None:
    """Write a picture of a page at a time, or a film, by the suffix of the file.

    Raises
    ------
    UsageError
        When there is no such time, or no program that draws.
    """
    times, wish = results.time, asked or {}
    if not len(times):
        raise UsageError("the results hold no time of which a picture could be drawn")
    if time is not None:
        if not times[0] <= time <= times[-1]:
            raise UsageError(f"--png {time:g}: the results are from {times[0]:g} to {times[-1]:g}")
        return write_picture(page, time, path, size, **wish)
    names = deck.single(Units).names
    second = units.TIME[names[3]] if names else 1.0
    rate = RATES[path.suffix.lower()]
    write_film(
        page, film_times(float(times[0]), float(times[-1]), second, rate), path, size, **wish
    )


def write_picture(
    page: str, time: float, path: str | Path, size: Size = SIZE, **asked: str
) -> None:
    """Write the picture of a page at a time, as PNG.

    Parameters
    ----------
    page : str
        The text of the page.
    time : float
        A time of its results, [time].
    path : str or Path
    size : pair of int
        Width and height in pixels.
    **asked
        What else its address asks of the page: ``theme="dark"``, ``view="iso"``, ...
    """
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        (content,) = _pictures(page, [time], Path(folder), size, asked)
    with whole_file(path, binary=True) as stream:
        stream.write(content)


def write_film(
    page: str, times: Sequence[float], path: str | Path, size: Size = SIZE, **asked: str
) -> None:
    """Write pictures of a page at several times as a film, ``.gif`` or ``.mp4``."""
    path = Path(path)
    suffix = path.suffix.lower()
    encoder = need_encoder()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as name:
        folder = Path(name)
        for k, content in enumerate(_pictures(page, times, folder, size, asked)):
            (folder / f"{k:06}.png").write_bytes(content)
        made = folder / f"film{suffix}"
        command = [encoder, "-loglevel", "error", "-framerate", str(RATES[suffix])]
        _run([*command, "-i", str(folder / "%06d.png"), *ENCODING[suffix], str(made)], "FFmpeg")
        with whole_file(path, binary=True) as stream:
            stream.write(made.read_bytes())


def film_times(first: float, last: float, unit: float, rate: int) -> list[float]:
    """Times of the pictures of a film of results from ``first`` to ``last``.

    `unit` is the unit of time in seconds, `rate` the pictures in a second.
    """
    duration = (last - first) * unit
    shown = duration if SHORTEST <= duration <= LONGEST else PLEASANT if duration > 0 else 0.0
    count = round(shown * rate)
    return [first + (last - first) * k / count for k in range(count + 1)] if count else [first]


def need_browser() -> str:
    """The browser that draws.

    Raises
    ------
    UsageError
        When none is installed.
    """
    found = find_browser()
    if found is None:
        raise UsageError(
            "pictures are drawn by Chromium, Chrome or Edge, and none is found; "
            f"install one, or name its program in {VARIABLE}"
        )
    return found


def need_encoder() -> str:
    """The program that makes films of pictures.

    Raises
    ------
    UsageError
        When it is not installed.
    """
    import shutil

    found = shutil.which("ffmpeg")
    if found is None:
        raise UsageError("films are made by FFmpeg, whose program ffmpeg is not found")
    return found


def _pictures(
    page: str, times: Sequence[float], folder: Path, size: Size, asked: dict[str, str]
) -> Iterator[bytes]:
    """The pictures at several times, as PNG."""
    file = folder / "page.html"
    file.write_text(page, encoding="utf-8")
    for first in range(0, len(times), AT_ONCE):
        some = times[first : first + AT_ONCE]
        film = ",".join(repr(float(time)) for time in some)
        wish = {"theme": "light", **asked, "bare": "1", "size": "{}x{}".format(*size), "film": film}
        yield from _drawn(f"{file.as_uri()}#{urlencode(wish)}", folder, size, len(some))


def _drawn(address: str, folder: Path, size: Size, count: int) -> list[bytes]:
    window = "--window-size={},{}".format(*size)
    profile = f"--user-data-dir={folder / 'profile'}"
    command = [need_browser(), *flags(), window, profile, "--dump-dom", address]
    found = FILM.search(_run(command, "The browser"))
    pictures = found[1].split() if found else []
    if len(pictures) != count or not all(each.startswith(START) for each in pictures):
        raise FormatError("the browser has drawn no picture of the page")
    return [b64decode(each.removeprefix(START)) for each in pictures]


def _run(command: list[str], what: str) -> str:
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, encoding="utf-8", errors="replace",
            timeout=PATIENCE, stdin=subprocess.DEVNULL, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise FormatError(f"{what} did not finish within {PATIENCE} s") from None
    if done.returncode:
        last = done.stderr.strip().splitlines()[-1:] or ["no message"]
        raise FormatError(f"{what} failed: {last[0]}")
    return done.stdout

"""Reading results files of ADAMS in the older text form: the motion of parts.

Blocks begin with a title of 40 letters and the number of lines that follow (8 places), the last of
which is ``!``. RIGID PARTS MAP names the parts, which of displacements, velocities and
accelerations are there, and in which lines of a block of output. ANALYSIS OUTPUT BLOCK has number,
kind, time, and for each part x y z and four Euler parameters, the scalar first; then velocities,
translational and angular, and accelerations; 12 places a number. The layout is that of a public
writer of this form (MBDyn); no file of ADAMS was at hand, and other maps are passed over.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from adamslite.errors import FormatError
from adamslite.model.attitude_angles import angles_313
from adamslite.results.part_frames import ALIGNED
from adamslite.results.printed import Printed
from adamslite.results.results import Results

START = b"FILE TYPE AND SOURCE"
TITLE, PLACES = 40, 8
NUMBER = 12
DIGITS = 6
GROUPS = (
    ("bcs_x", "bcs_y", "bcs_z", "bcs_psi", "bcs_theta", "bcs_phi"),
    ("bcs_vx", "bcs_vy", "bcs_vz", "wx", "wy", "wz"),
    ("bcs_ax", "bcs_ay", "bcs_az", "alx", "aly", "alz"),
)
"""Components by displacement, velocity and acceleration."""


def read_text(path: str | Path, text: str) -> Results:
    """Read the content of a file.

    Raises
    ------
    FormatError
        When it is damaged or cut off.
    """
    try:
        return _results(list(_blocks(text.splitlines())))
    except (ValueError, IndexError) as fault:
        raise FormatError(f"{path} is damaged or cut off: {fault}") from None


def _blocks(lines: list[str]) -> Iterator[tuple[str, list[str]]]:
    """Title and lines of each block, without its end."""
    at = 0
    while at < len(lines):
        title, count = lines[at][:TITLE].strip(), int(lines[at][TITLE : TITLE + PLACES])
        end = at + count
        if count < 1 or lines[end].strip() != "!":
            raise ValueError(f"the block in line {at + 1} does not end in line {end + 1}")
        yield title, lines[at + 1 : end]
        at = end + 1


def _results(blocks: list[tuple[str, list[str]]]) -> Results:
    found = dict(blocks)
    if "RIGID PARTS MAP" not in found:
        raise ValueError("it has no RIGID PARTS MAP")
    head, *parts = found["RIGID PARTS MAP"]
    there = [head[k : k + 3] == "YES" for k in (8, 11, 14)]
    outputs = [lines for title, lines in blocks if title == "ANALYSIS OUTPUT BLOCK"]
    names = [
        f"PART/{line[:20].strip()}.{component}"
        for line in parts
        for group, given in zip(GROUPS, there, strict=True)
        if given
        for component in group
    ]
    rows = [[value for line in parts for value in _of_part(lines, line, there)]
            for lines in outputs]  # fmt: skip
    title = next(iter(found.get("DATA SET TITLE", [])), "").strip()
    return Results(
        time=np.array([float(lines[1]) for lines in outputs]),
        names=tuple(names),
        values=np.array(rows).reshape(len(rows), len(names)),
        meta={"deck": title, "written by": "ADAMS, text form"},
        printed=Printed(digits=DIGITS),
    )


def _of_part(lines: list[str], entry: str, there: list[bool]) -> Iterator[float]:
    """The numbers of one part in a block of output."""
    places = [int(entry[k : k + PLACES]) for k in (20, 28, 36)]
    for place, given, kind in zip(places, there, GROUPS, strict=True):
        if given:
            line = lines[place - 1]
            numbers = [float(line[k : k + NUMBER]) for k in range(0, len(line.rstrip()), NUMBER)]
            yield from _posture(numbers) if kind is GROUPS[0] else numbers


def _posture(numbers: list[float]) -> list[float]:
    """Position and 3-1-3 angles from position and Euler parameters."""
    x, y, z, s, a, b, c = numbers
    size = s * s + a * a + b * b + c * c
    if not size > 0.0:
        raise ValueError("Euler parameters of a part are zero")
    r = np.array([
        [s * s + a * a - b * b - c * c, 2 * (a * b - s * c), 2 * (a * c + s * b)],
        [2 * (a * b + s * c), s * s - a * a + b * b - c * c, 2 * (b * c - s * a)],
        [2 * (a * c - s * b), 2 * (b * c + s * a), s * s - a * a - b * b + c * c],
    ])  # fmt: skip
    return [x, y, z, *angles_313(r[None] / size, ALIGNED)[0].tolist()]

"""Results of a linearisation, as tables and as files.

A conjugate pair of eigenvalues is one mode; modes are numbered by undamped frequency.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from adamslite.errors import UsageError
from adamslite.outputs.whole_files import whole_file
from adamslite.results.linearization import Linearization

HEAD = ("mode", "frequency [Hz]", "damping ratio", "real", "imaginary")
# An eigenvalue within this share of the largest one of an axis lies on it.
ON_AXIS = 1e-9


class ModeRow(NamedTuple):
    """One mode.

    Parameters
    ----------
    frequency : float
        |s| / (2 pi) [cycles per time].
    damping : float
        -Re s / |s|; 0 for a free motion (s = 0).
    real, imaginary : float
        The eigenvalue s, of a pair the upper one [1/time].
    pair : bool
        Whether the conjugate value belongs to the mode too.
    """

    number: int
    frequency: float
    damping: float
    real: float
    imaginary: float
    pair: bool


def mode_rows(linearization: Linearization) -> list[ModeRow]:
    """The modes, slowest first."""
    found = linearization
    scale = max((abs(each) for each in found.eigenvalues), default=0.0)
    rows: list[ModeRow] = []
    facts = zip(found.eigenvalues, found.frequencies, found.damping_ratios, strict=True)
    for value, frequency, damping in sorted(facts, key=lambda fact: float(fact[1])):
        pair = abs(value.imag) > ON_AXIS * scale
        if not pair or value.imag > 0.0:
            number, imaginary = len(rows) + 1, float(value.imag) if pair else 0.0
            damping, real = float(damping), float(value.real)
            rows.append(ModeRow(number, float(frequency), damping, real, imaginary, pair))
    return rows


def mode_table(linearization: Linearization) -> str:
    """The modes as a table to read, and below it what to know before they are used."""
    number, *rest = HEAD
    lines = [f"{number:>4}  " + "  ".join(f"{word:>16}" for word in rest)]
    for row in mode_rows(linearization):
        sign = "+/-" if row.pair else ""
        imaginary = f"{sign}{row.imaginary:.9g}"
        values = (f"{row.frequency:.9g}", f"{row.damping:.6g}", f"{row.real:.9g}", imaginary)
        lines.append(f"{row.number:4}  " + "  ".join(f"{value:>16}" for value in values))
    if linearization.note:
        lines += ["", linearization.note]
    return "\n".join(lines) + "\n"


def save(linearization: Linearization, path: str | Path) -> None:
    """Write the modes (a name that ends with .csv) or everything (any other name, as JSON)."""
    write = _csv if Path(path).suffix.lower() == ".csv" else _json
    with whole_file(path) as stream:
        stream.write(write(linearization))


def need_suffix(path: str | Path) -> None:
    """Raise UsageError for a file name that does not say how to write."""
    if Path(path).suffix.lower() not in (".csv", ".json"):
        raise UsageError(f"'{path}': the name must end with .csv (modes) or .json (everything)")


def _csv(linearization: Linearization) -> str:
    """Numbers with all their digits, as in result files."""
    lines = ["mode,frequency,damping_ratio,real,imaginary,pair"]
    for row in mode_rows(linearization):
        values = (row.frequency, row.damping, row.real, row.imaginary)
        lines.append(",".join([str(row.number), *map(repr, values), str(int(row.pair))]))
    return "\n".join(lines) + "\n"


def _json(linearization: Linearization) -> str:
    """Complex numbers are pairs [real, imaginary]; matrices are lists of rows."""
    import json

    found = linearization
    whole = {
        "coordinates": list(found.coordinates),
        "eigenvalues": list(_pairs(found.eigenvalues)),
        "frequencies": [float(each) for each in found.frequencies],
        "damping_ratios": [float(each) for each in found.damping_ratios],
        "undamped": [float(each) for each in found.undamped],
        "modes": [list(_pairs(row)) for row in found.modes],
        "state_matrix": found.state_matrix.tolist(),
        "inputs": list(found.inputs),
        "outputs": list(found.outputs),
        "input_matrix": found.input_matrix.tolist(),
        "output_matrix": found.output_matrix.tolist(),
        "feedthrough": found.feedthrough.tolist(),
        "note": found.note,
    }
    return json.dumps(whole, indent=1) + "\n"


def _pairs(values: Iterable[complex]) -> Iterator[list[float]]:
    return ([float(each.real), float(each.imag)] for each in values)

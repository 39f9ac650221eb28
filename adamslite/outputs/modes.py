"""Results of a linearisation, as tables and as files.

A conjugate pair of eigenvalues is one mode; modes are numbered by undamped frequency.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.errors import UsageError
from adamslite.outputs.whole_files import PLAIN, whole_file
from adamslite.results.linearization import SecondOrder

if TYPE_CHECKING:
    from adamslite.elements.linear import Linear
    from adamslite.results.linearization import Linearization
    from adamslite.results.results import Linearized

HEAD = ("mode", "frequency [Hz]", "damping ratio", "real", "imaginary")
# An eigenvalue within this share of the largest one of an axis lies on it.
ON_AXIS = 1e-9
# Displacements that differ by less than this share are equally large: the first one counts.
ALIKE = 1e-6


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
    place : int
        Its place among the eigenvalues.
    """

    number: int
    frequency: float
    damping: float
    real: float
    imaginary: float
    pair: bool
    place: int


def mode_rows(linearization: Linearization) -> list[ModeRow]:
    """The modes, slowest first."""
    found = linearization
    scale = max((abs(each) for each in found.eigenvalues), default=0.0)
    rows: list[ModeRow] = []
    order = np.argsort(found.frequencies, kind="stable").tolist()
    for index in order:
        value, frequency = found.eigenvalues[index], found.frequencies[index]
        pair = abs(value.imag) > ON_AXIS * scale
        if not pair or value.imag > 0.0:
            number, imaginary = len(rows) + 1, float(value.imag) if pair else 0.0
            damping, real = float(found.damping_ratios[index]), float(value.real)
            rows.append(ModeRow(number, float(frequency), damping, real, imaginary, pair, index))
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


def save_command(made: Linearized, path: Path) -> list[Path]:
    """Write what a LINEAR command has found; the files that are written.

    ``path`` is that of modes or of the state matrices; files beside it have names made from it.
    """
    if made.kind == "MKB":
        return save_second_order(made, path)
    if made.kind == "STATEMAT" and made.form == "MATLAB":
        return _save_tables(made.model, path)
    save(made.model, path)
    write = {"shapes": _shapes, "kinetic": _energies}
    beside = files_beside(path, made)
    for word, other in beside.items():
        with whole_file(other) as stream:
            stream.write(write[word](made))
    return [path, *beside.values()]


def files_beside(path: Path, made: Linear | Linearized) -> dict[str, Path]:
    """The files that an EIGENSOL writes beside that of its modes, by what is in them."""
    asked = {"shapes": made.shapes, "kinetic": made.energies} if made.kind == "EIGENSOL" else {}
    stem = path.name.removesuffix(".modes.csv")
    return {word: path.with_name(f"{stem}.{word}.csv") for word, modes in asked.items() if modes}


def _save_tables(model: Linearization, path: Path) -> list[Path]:
    """A, B, C and D, as far as there are inputs and outputs, a row of numbers per line."""
    tables = {
        "a": model.state_matrix, "b": model.input_matrix,
        "c": model.output_matrix, "d": model.feedthrough,
    }  # fmt: skip
    paths = []
    for letter, table in tables.items():
        if table.shape[1] and table.shape[0] or letter == "a":
            paths.append(path.with_name(path.name + letter))
            with whole_file(paths[-1]) as stream:
                stream.write(PLAIN)
                stream.writelines(" ".join(map(repr, row)) + "\n" for row in table.tolist())
    return paths


def _rows_between(found: Linearization, modes: tuple[int, int] | None) -> list[ModeRow]:
    """The modes from a first to a last one."""
    first, last = modes or (1, 0)
    return mode_rows(found)[first - 1 : last]


def _energies(made: Linearized) -> str:
    """Shares of bodies in the kinetic energy of modes."""
    found = made.model
    lines = ["mode,frequency,body,share"]
    for row in _rows_between(found, made.energies):
        shares = found.kinetic[:, row.place].tolist()
        lines += [f"{row.number},{row.frequency!r},{name},{share!r}"
                  for name, share in zip(found.bodies, shares, strict=True)]  # fmt: skip
    return "\n".join(lines) + "\n"


def _shapes(made: Linearized) -> str:
    """Magnitudes and phases [degrees] of the coordinates of modes; the largest of a mode is 1."""
    found = made.model
    lines = ["mode,frequency,coordinate,magnitude,phase"]
    for row in _rows_between(found, made.shapes):
        shape = found.modes[:, row.place]
        far = np.abs(shape)
        largest = shape[np.flatnonzero(far >= (1.0 - ALIKE) * far.max())[0]] if far.any() else 1.0
        for name, share in zip(found.coordinates, shape / largest, strict=True):
            size, phase = float(abs(share)), float(np.degrees(np.angle(share)))
            lines.append(f"{row.number},{row.frequency!r},{name},{size!r},{phase!r}")
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
        "bodies": list(found.bodies),
        "kinetic": found.kinetic.tolist(),
        "note": found.note,
    }
    return json.dumps(whole, indent=1) + "\n"


def _pairs(values: Iterable[complex]) -> Iterator[list[float]]:
    return ([float(each.real), float(each.imag)] for each in values)


def save_second_order(made: Linearized, path: Path) -> list[Path]:
    """M, B, K, F and the basis as JSON; matrices are lists of rows."""
    found = made.model.second_order
    assert found is not None  # the command reports a model without
    names = {"coordinates": list(made.model.coordinates), "inputs": list(made.model.inputs)}
    matrices = {name: getattr(found, name).tolist() for name in SecondOrder._fields}
    with whole_file(path) as stream:
        stream.write(json.dumps(names | matrices | {"note": made.model.note}, indent=1) + "\n")
    return [path]

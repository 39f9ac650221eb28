"""SPLINE: a table of numbers, as a curve or as a family of curves.

Equation (x_1 < ... < x_n, of a family z_1 < ... < z_m; the function that uses it decides how the
points are joined)::

    one curve   y(x_k) = Y_k                                X=x_1, ..., x_n, Y=y_1, ..., y_n
    a family    y(x_k, z_j) = Y_jk, linear in z between     X=x_1, ..., x_n,
                neighbours, and beyond z_1 and z_m too      Y=z_1, y_11, ..., y_1n,
                                                            Y=z_2, y_21, ..., y_2n, ...
    from a file y(x_k) = channel at x_k                     FILE=road.csv, BLOCK=left

Beyond x_1 and x_n a curve continues as the parabola through the outermost three points, one from a
file with the value at the end; with LINEAR_EXTRAPOLATE both continue along the tangent.

A file is a table beside the deck, comma-separated: the first column is x, each further one a
channel; the first row may name them.  Results that ``adamslite solve -o NAME.csv`` writes are such
tables, so that a run can be the input of another one.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from adamslite.elements.bases import data_file
from adamslite.language.statement import Statement, flag, integer, statement, text, vector, vectors
from adamslite.symbolic.interpolant import corners, interpolant, piece_numbers

if TYPE_CHECKING:
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.interpolant import Interpolant

LEAST, MOST = 4, 10**6
KINDS = ("linear", "akima", "natural")


class Points(NamedTuple):
    """``x`` (n,); ``curves``: values at x, one row for each; ``places``: z of each curve."""

    x: tuple[float, ...]
    curves: tuple[tuple[float, ...], ...]
    places: tuple[float, ...] = (0.0,)

    def table(self, kind: str, beyond: str) -> Interpolant:
        """The points joined as :mod:`adamslite.symbolic.interpolant` has it."""
        import numpy as np

        places = np.array(self.places)
        return interpolant(np.array(self.x), np.array(self.curves).T, kind, beyond, places)

    def numbers(self) -> Interpolant:
        """The numbers of the straight lines between the corners of the points."""
        import numpy as np

        x = np.array(self.x)
        return piece_numbers(x[corners(x, np.array(self.curves).T)])

    def strips(self) -> Interpolant:
        """The numbers, from 0, of the strips between the curves: all but the outer two end them."""
        import numpy as np

        return piece_numbers(np.array(self.places[1:-1]))


@statement("SPLINE", planned=("ROUTINE",), data=True)
class Spline(Statement):
    """Points for the functions AKISPL, CUBSPL and INTERP."""

    alternatives = ((("x", "y"), ("file", "channel", "block")),)

    x: tuple[float, ...] | None = vector(
        "X", size=LEAST, most=MOST, unit="the user's", help="where the points are"
    )
    y: tuple[tuple[float, ...], ...] = vectors(
        "Y", size=LEAST, most=MOST, unit="the user's",
        help="values at X; in a family z before them, and Y= once for each curve",
    )  # fmt: skip
    file: str | None = text("FILE", help="a table .csv in the folder of the deck or below")
    channel: int | None = integer("CHANNEL", help="number of the column, from 1 after that of x")
    block: str | None = text("BLOCK", help="name of the column")
    linear_extrapolate: bool = flag(
        "LINEAR_EXTRAPOLATE", help="beyond its ends a curve continues along its tangent"
    )

    @property
    def family(self) -> bool:
        """Whether there are several curves, one for each z."""
        return len(self.y) > 1

    def points(self, folder: Path) -> Points:
        """The points, from a file where one is named."""
        if self.file is not None:
            x, y = data_file.points(folder, self.file, self.channel, self.block)
            return Points(x, (y,))
        assert self.x is not None  # a rule asks for it
        if self.family:
            rows = tuple(row[1:] for row in self.y)
            return Points(self.x, rows, tuple(row[0] for row in self.y))
        return Points(self.x, self.y)

    @property
    def beyond(self) -> str:
        """How a curve continues beyond its ends."""
        usual = "parabola" if self.file is None else "constant"
        return "tangent" if self.linear_extrapolate else usual

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """A table for each way to join the points."""
        points = model.once(("SPLINE", self.key), partial(self.points, model.folder))
        tables = {
            kind: model.once(("SPLINE", self.key, kind), partial(points.table, kind, self.beyond))
            for kind in KINDS
        }
        tables["pieces"] = model.once(("SPLINE", self.key, "pieces"), points.numbers)
        inner = len(points.places) > 2
        strips = model.once(("SPLINE", self.key, "strips"), points.strips) if inner else None
        return {**tables, "strips": strips, "family": "yes" if self.family else None}

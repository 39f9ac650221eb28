"""A cable of variable length and what its decks share."""

from dataclasses import dataclass
from math import ceil, log10

import numpy as np
from formulas import Cable
from pulleys import damped_section, damped_variables, payout_variables

from adamslite.cables.statements.forms import head

FORMS = ("paper", "ale")


@dataclass(frozen=True)
class Span:
    """A cable of `sections` with the free length `length` [m] at the start, with its form."""

    form: str
    cable: Cable
    sections: int
    length: float
    damping: float = 0.0

    @property
    def node_mass(self) -> float:
        """Of an inner node at the start [kg]."""
        return self.cable.density * self.length / self.sections

    def text(self, title: str, notes: str, *lines: str) -> str:
        """Head and variables."""
        text = head(f"{title} ({self.form})", notes, "", "PART/1, GROUND", *lines)
        return (
            text
            + damped_variables(self.cable, self.damping)
            + payout_variables(self.cable, self.sections, self.length)
        )

    def sections_text(self) -> str:
        """All of them."""
        return "\n" + "".join(
            damped_section(k, k, k + 1, "H", self.damping) for k in range(1, self.sections + 1)
        )


def supported(column: np.ndarray, error: float) -> np.ndarray:
    """A column without the digits below its relative `error`, of the largest value."""
    worst = error * np.abs(column).max()
    return np.round(column, -ceil(log10(worst))) if worst else column


def table(
    header: list[str], lines: list[str], columns: list[np.ndarray], error: float = 0.0
) -> str:
    """A reference with instructions and a table.

    `error` is more than that of the integration that computed the columns, which shows in a run
    with a thousandth of its tolerance. Digits below it are not printed, as they differ between
    processors, whose BLAS sums products of matrices in different orders: 1e-16 there is 1e-12 to
    1e-8 when it has gone through the choice of steps.
    """
    shown = [columns[0], *(supported(np.asarray(column), error) for column in columns[1:])]
    rows = "".join(
        ",".join(f"{value + 0.0:.12g}" for value in row) + "\n" for row in np.column_stack(shown)
    )
    return "".join(f"# {line}\n" for line in lines) + ",".join(header) + "\n" + rows

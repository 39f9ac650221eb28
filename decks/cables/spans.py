"""A cable of variable length and what its decks share."""

from dataclasses import dataclass

import numpy as np
from formulas import Cable

from adamslite.cables.statements import cable_variables, head, payout_variables, section

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
            + cable_variables(self.cable, self.damping)
            + payout_variables(self.cable, self.sections, self.length)
        )

    def sections_text(self) -> str:
        """All of them."""
        return "\n" + "".join(
            section(k, k, k + 1, "H", self.damping) for k in range(1, self.sections + 1)
        )


def table(header: list[str], lines: list[str], columns: list[np.ndarray]) -> str:
    """A reference with instructions and a table."""
    rows = "".join(
        ",".join(f"{value + 0.0:.12g}" for value in row) + "\n" for row in np.column_stack(columns)
    )
    return "".join(f"# {line}\n" for line in lines) + ",".join(header) + "\n" + rows

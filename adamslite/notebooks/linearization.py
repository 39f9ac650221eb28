"""A linearised model in a notebook: the table of its modes."""

from __future__ import annotations

from adamslite.notebooks.markup import number_table, paragraph
from adamslite.outputs.modes import HEAD, mode_rows
from adamslite.results.linearization import Linearization


def linearization_html(found: Linearization) -> str:
    """Number, frequency, damping ratio and eigenvalue of every mode, and what to know of them."""
    rows = [
        (
            str(row.number), f"{row.frequency:.6g}", f"{row.damping:.4g}", f"{row.real:.6g}",
            f"{'± ' if row.pair else ''}{row.imaginary:.6g}",
        )
        for row in mode_rows(found)
    ]  # fmt: skip
    note = paragraph(found.note) if found.note else ""
    return f"<div>{paragraph(found.sizes)}{number_table(HEAD, rows)}{note}</div>"

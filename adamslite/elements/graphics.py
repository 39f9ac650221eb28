"""GRAPHICS: shapes for display.

Equation: none; it is read and ignored.
"""

from __future__ import annotations

from adamslite.language.statement import Statement, statement


@statement("GRAPHICS", ignored=True)
class Graphics(Statement):
    """Display geometry; its arguments are not read."""

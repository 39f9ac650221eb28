"""END: the end of the deck, or of a command file.

Equation: none.
"""

from __future__ import annotations

from adamslite.language.statement import Statement, statement


@statement("END", singleton=True, place="both", ends=True)
class End(Statement):
    """Lines after it are not read."""

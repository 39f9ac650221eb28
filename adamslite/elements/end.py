"""END: the end of the deck.

Equation: none.
"""

from __future__ import annotations

from adamslite.language.statement import Statement, statement


@statement("END", singleton=True, ends=True)
class End(Statement):
    """Lines after it are not read."""

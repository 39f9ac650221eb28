"""STRING: a text.

Equation: none.
"""

from __future__ import annotations

from adamslite.language.statement import Statement, statement, text


@statement("STRING", data=True, inert=True)
class String(Statement):
    """A text for subroutines, such as the name of a file; nothing in a run depends on it."""

    string: str = text("STRING", required=True, help="the text; commas end it")

"""STOP: the end of a command file.

Equation: none.
"""

from __future__ import annotations

from adamslite.language.statement import Statement, statement


@statement("STOP", singleton=True, place="command", ends=True)
class Stop(Statement):
    """Lines after it are not read."""

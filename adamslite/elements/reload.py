"""RELOAD: goes back to a state that SAVE has kept.

Equation: none.
"""

from __future__ import annotations

from adamslite.elements.save import Kept, saved_buffer, saved_file, saved_kind, saved_title
from adamslite.language.statement import Statement, statement, text


@statement("RELOAD", singleton=True, repeatable=True, place="command")
class Reload(Kept, Statement):
    """Goes on from a kept state, time included, to the same numbers as if nothing had come between.

    STATES are put into the model as it is now; a SYSTEM takes the place of all that commands have
    changed.  A file may come from an earlier run of the same deck.  What is written afterwards
    follows in the same table, in which the time then goes back.
    """

    kind: str = saved_kind("SYSTEM")
    buffer: str | None = saved_buffer()
    file: str | None = saved_file()
    title: str | None = saved_title()
    output_prefix: str | None = text(
        "OUTPUT_PREFIX", inert=True, help="first part of the names of output files"
    )

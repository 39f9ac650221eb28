"""FILE: names the deck of a command file.

Equation: none.
"""

from __future__ import annotations

from adamslite.language.statement import Statement, statement, text


@statement("FILE", singleton=True, repeatable=True, place="command", planned=("COMMAND",))
class File(Statement):
    """The first line of a command file; the deck is the one given on the command line.

    Instead of it two lines with bare names may stand on top, of the deck and of the output files.
    The command line takes precedence: `adamslite solve -o FILE`.
    """

    model: str | None = text("MODEL", help="name of the deck; a note reports another one")
    output_prefix: str | None = text(
        "OUTPUT_PREFIX",
        help="first part of the names of output files; the deck's unless given",
    )

"""SAVE: keeps the state that a run has reached, for RELOAD.

Equation: none.
"""

from __future__ import annotations

from adamslite.language.statement import Statement, choice, integer, statement, text


def saved_kind(default: str) -> str:
    """What is kept."""
    return choice(
        options=("STATES", "SYSTEM"), default=default,
        help="time and states; or everything: also settings, and what commands have changed",
    )  # fmt: skip


def saved_buffer() -> str | None:
    """Where STATES are."""
    return text("BUFFER", help="name of a place in memory, for STATES")


def saved_file() -> str | None:
    """Where a SYSTEM is."""
    return text("FILE", help="plain name of a file beside the results, for SYSTEM")


def saved_title() -> str | None:
    """Words of the user."""
    return text("TITLE", inert=True, help="a title")


class Kept:
    """A command about a state that is kept."""

    kind: str
    buffer: str | None
    file: str | None

    @property
    def where(self) -> tuple[str, str | None]:
        """What it is kept as, and under which name."""
        return self.kind, self.buffer if self.kind == "STATES" else self.file


@statement("SAVE", singleton=True, repeatable=True, place="command")
class Save(Kept, Statement):
    """Keeps the present state under a name.

    STATES are kept in memory until the end of the run, a SYSTEM in a file too, which is written at
    once, whole or not at all.  The file belongs to its deck.
    """

    kind: str = saved_kind("SYSTEM")
    buffer: str | None = saved_buffer()
    file: str | None = saved_file()
    title: str | None = saved_title()
    autosave: int | None = integer(
        "AUTOSAVE", inert=True, help="steps after which ADAMS writes a file of its own"
    )

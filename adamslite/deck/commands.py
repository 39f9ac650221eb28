"""The commands of a run, as a command file gives them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.deck.redefinition import Command

if TYPE_CHECKING:
    from adamslite.language.diagnostics import Diagnostic, Source


class Commands(tuple[Command, ...]):
    """Commands in their order: statements, and :class:`Redefinition` for those that change one."""

    warnings: tuple[Diagnostic, ...] = ()
    prefix: str = ""
    """First part of the names of the files of a run; empty where the commands name none."""
    source: Source | None = None
    """The text that they were read from."""

"""Commands as cases call them."""

from __future__ import annotations

import io
from contextlib import redirect_stderr, redirect_stdout

from adamslite.cli import main as command_line
from adamslite.cli.commands.codes import BROKEN

CODES = {0: "done", 1: "different", 2: "usage", 3: "errors", 4: "stopped", 5: "not read"}


class Broken(Exception):
    """Exit code 70: what the program reported as its own fault."""


def call(*words: str) -> str:
    """The word for the exit code of a command."""
    told = io.StringIO()
    with redirect_stdout(io.StringIO()), redirect_stderr(told):
        code = command_line.main(words)
    if code == BROKEN:
        raise Broken(told.getvalue().partition("not in your deck: ")[2].partition("\n")[0])
    assert "Traceback" not in told.getvalue(), told.getvalue()
    return CODES[code]

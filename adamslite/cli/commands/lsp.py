"""serve editors: messages while typing, pages, completion, renaming (Language Server Protocol)

An editor starts it and talks to it over standard input and output; `adamslite editors` writes what
VS Code needs for that (docs/how-to/editor.md). It needs the extra [lsp].
"""

import argparse
import logging
import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from adamslite.cli.commands.codes import DONE, STOPPED_EARLY

#: What ends the server, where the system knows it.
ENDING = ("SIGINT", "SIGTERM", "SIGHUP")
INTERRUPTED = b"adamslite: interrupted\n"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite lsp`; editors like to give --stdio."""
    parser.add_argument("--stdio", action="store_true", help="as without it")


def run(args: argparse.Namespace) -> int:
    """Serve until the editor leaves; return the exit code."""
    from adamslite.errors import UsageError

    try:
        import pygls.lsp.server  # noqa: F401
    except ImportError:
        raise UsageError(
            "the language server needs pygls 2: pip install 'adamslite[lsp]'"
        ) from None
    from adamslite.editing.handlers import start

    faults = logging.StreamHandler()
    faults.setFormatter(_OneLine())
    logging.getLogger("pygls").addHandler(faults)
    logging.getLogger("pygls").propagate = False
    # Of parameters that are wrong the stream of messages says so.
    logging.getLogger("pygls.protocol.json_rpc").addFilter(
        lambda record: not record.msg.startswith("Unable to deserialize")
    )
    with _ended_at_once():
        start()
    return DONE


@contextmanager
def _ended_at_once() -> Iterator[None]:
    """Meanwhile signals end the process: there is nothing to keep, and a thread that reads standard
    input would be waited for until the editor writes.  One that is ignored stays ignored.
    """
    known = [number for each in ENDING if (number := getattr(signal, each, None))]
    heard = {n: old for n in known if (old := signal.getsignal(n)) not in (signal.SIG_IGN, None)}
    for number in heard:
        signal.signal(number, _end)
    try:
        yield
    finally:
        for number, old in heard.items():
            signal.signal(number, old)


def _end(*_: object) -> None:
    with suppress(OSError):
        os.write(2, INTERRUPTED)
    os._exit(STOPPED_EARLY)


class _OneLine(logging.Formatter):
    """What an editor has sent that is no message is reported in a line, not by a traceback, which
    may be in the text of the report, too.
    """

    def format(self, record: logging.LogRecord) -> str:
        lines = record.getMessage().strip().splitlines()
        if record.exc_info:
            lines += str(record.exc_info[1]).strip().splitlines()
        last = f": {lines[-1].strip()}" if len(lines) > 1 else ""
        return f"adamslite: {''.join(lines[:1])}{last}"

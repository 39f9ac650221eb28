"""serve editors: messages while typing, pages, completion, renaming (Language Server Protocol)

An editor starts it and talks to it over standard input and output; `adamslite editors` writes what
VS Code needs for that (docs/how-to/editor.md). It needs the extra [lsp].
"""

import argparse
import logging

from adamslite.cli.commands.codes import DONE


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
    start()
    return DONE


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

"""serve editors: messages while typing, pages, completion, renaming (Language Server Protocol)

An editor starts it and talks to it over standard input and output; `adamslite editors` writes what
VS Code needs for that (docs/how-to/editor.md). It needs the extra [lsp].
"""

import argparse

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

    start()
    return DONE

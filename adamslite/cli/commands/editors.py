"""write what editors need: colours, snippets, a folder for VS Code

DIR gets a TextMate grammar and snippets for decks and for command files, and the folder vscode,
which is an extension: copy it to ~/.vscode/extensions/adamslite (docs/how-to/editor.md).
Everything is made from the statements and functions that this version knows.
"""

import argparse
import sys
from pathlib import Path

from adamslite.cli.commands.codes import DONE


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite editors`."""
    parser.add_argument("folder", metavar="DIR", type=Path, help="folder; made if it is not there")


def run(args: argparse.Namespace) -> int:
    """Write the files; return the exit code."""
    from adamslite.editing.vscode import files, write
    from adamslite.outputs.whole_files import need_file

    need_file(args.folder)
    write(args.folder)
    for name in files():
        sys.stdout.write(f"{args.folder / name}\n")
    return DONE

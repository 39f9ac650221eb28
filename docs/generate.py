"""Write the pages that come from the program itself; tests/test_manual.py says when to run this.

python docs/generate.py
"""

from pathlib import Path

from adamslite.cli.main import command_parsers
from adamslite.manual.api import python_names
from adamslite.manual.commands import commands
from adamslite.manual.functions import deck_functions
from adamslite.manual.integrators import integrators
from adamslite.manual.lookup import result_formats
from adamslite.manual.messages import messages
from adamslite.manual.statements import statements

PAGES = {
    "reference/statements.md": statements,
    "reference/functions.md": deck_functions,
    "reference/messages.md": messages,
    "reference/integrators.md": integrators,
    "reference/formats.md": result_formats,
    "reference/commands.md": lambda: commands(command_parsers()),
    "reference/api.md": python_names,
}


def main() -> None:
    """Write every page into its folder beside this file."""
    for name, page in PAGES.items():
        (Path(__file__).parent / name).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()

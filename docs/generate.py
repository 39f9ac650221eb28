"""Write the pages that come from the program itself; tests/test_manual.py says when to run this.

python docs/generate.py
"""

from pathlib import Path

from adamslite import manual

PAGES = {
    "reference/statements.md": manual.statements,
    "reference/functions.md": manual.deck_functions,
    "reference/messages.md": manual.messages,
    "reference/integrators.md": manual.integrators,
    "reference/formats.md": manual.result_formats,
}


def main() -> None:
    """Write every page into its folder beside this file."""
    for name, page in PAGES.items():
        (Path(__file__).parent / name).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()

"""Write the pages that come from the program itself; tests/test_manual.py says when to run this.

python docs/generate.py
"""

from pathlib import Path

from adamslite import manual

PAGES = {
    "statements.md": manual.statements,
    "functions.md": manual.deck_functions,
    "messages.md": manual.messages,
    "integrators.md": manual.integrators,
    "formats.md": manual.result_formats,
}


def main() -> None:
    """Write every page beside this file."""
    for name, page in PAGES.items():
        Path(__file__).with_name(name).write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()

"""The locations of the grammar and of the reference decks.

In a wheel they are inside the package; in a checkout (installed in editable mode or not at all)
they stand next to it.
"""

from pathlib import Path


def find(name: str) -> Path:
    """Return the folder `name` ("grammar", "decks"): inside the package first, then next to it."""
    package = Path(__file__).parent
    inside = package / name
    return inside if inside.is_dir() else package.parent / name

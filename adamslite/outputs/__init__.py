"""Output files: formats of results, modes, saved states; the room adams reads files of ADAMS.

A module that registers a format is found by itself.
"""

from collections.abc import Iterator
from pkgutil import iter_modules


def modules() -> Iterator[str]:
    """Names of all modules here; the import of one registers the formats that it holds."""
    return (f"{__name__}.{each.name}" for each in iter_modules(__path__))

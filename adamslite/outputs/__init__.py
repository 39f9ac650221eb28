"""Output files: formats of results, charts and tables of modes."""

from collections.abc import Iterator
from pkgutil import iter_modules


def modules() -> Iterator[str]:
    """Names of all modules here; the import of one registers the formats that it holds."""
    return (f"{__name__}.{each.name}" for each in iter_modules(__path__))

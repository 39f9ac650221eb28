"""The deck functions, grouped by family, for :data:`adamslite.language.function.FUNCTIONS`."""

from collections.abc import Iterator
from pkgutil import iter_modules


def modules() -> Iterator[str]:
    """Names of all modules here; the import of one registers the functions that it holds."""
    return (f"{__name__}.{each.name}" for each in iter_modules(__path__))

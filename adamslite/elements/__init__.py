"""The statements, one per file; :data:`adamslite.language.statement.STATEMENTS` finds them.

The room bases has what families of statements share.
"""

from collections.abc import Iterator
from pkgutil import iter_modules


def modules() -> Iterator[str]:
    """Names of all modules here; the import of one registers the statements that it holds."""
    return (f"{__name__}.{each.name}" for each in iter_modules(__path__))

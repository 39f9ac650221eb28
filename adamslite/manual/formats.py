"""The page of the formats of result files."""

from __future__ import annotations

from adamslite.manual.markdown import HEAD, table
from adamslite.results.formats import formats

INTRO = """# Formats of result files

The suffix of a name decides: `adamslite solve DECK -o NAME.csv`. What can be read can be compared:
`adamslite diff A B`.
"""


def result_formats() -> str:
    """The page of the formats of result files: docs/reference/formats.md."""
    rows = [
        (f"`{suffix}`", each.what, "written, read" if each.read else "written")
        for suffix, each in sorted(formats().items())
    ]
    return "\n".join([HEAD, INTRO, table(("suffix", "content", "can be"), rows)])

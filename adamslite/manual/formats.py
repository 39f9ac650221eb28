"""The page of the formats of result files."""

from __future__ import annotations

import sys

from adamslite.manual.markdown import HEAD, markdown, table
from adamslite.results import run_texts
from adamslite.results.formats import Format, formats

INTRO = """# Formats of result files

The suffix of a name decides: `adamslite solve DECK -o NAME.csv`. What can be read can be compared:
`adamslite diff A B`. A failed write leaves an earlier file as it was.
"""


def result_formats() -> str:
    """The page of the formats of result files: docs/reference/formats.md."""
    rows = [
        (f"`{suffix}`", each.what, "written, read" if each.read else "written")
        for suffix, each in sorted(formats().items())
    ]
    parts = [HEAD, INTRO, table(("suffix", "content", "can be"), rows)]
    parts.append(f"## Texts of a run\n\n{markdown(run_texts.__doc__)}")
    return "\n".join([*parts, *(_layout(*each) for each in sorted(formats().items()))])


def _layout(suffix: str, format: Format) -> str:
    """What such a file holds, in detail: the documentation of its module."""
    return f"## `{suffix}`\n\n{markdown(sys.modules[format.write.__module__].__doc__)}"

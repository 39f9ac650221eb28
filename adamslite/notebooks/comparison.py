"""A comparison in a notebook: per channel the largest difference and its tolerance."""

from __future__ import annotations

from adamslite.notebooks.markup import marked, number_table
from adamslite.results.comparison import HEAD, Comparison

#: More channels than this are counted only.
MOST = 200


def comparison_html(found: Comparison) -> str:
    """Those outside their tolerance first."""
    mark = marked("done" if found.inside else "error", found.verdict)
    count = len(found.differences)
    more = f"<p>and {count - MOST} more</p>" if count > MOST else ""
    table = number_table(HEAD, [each.cells for each in found.outside_first[:MOST]])
    return f"<div><p>{mark}</p>{table}{more}</div>"

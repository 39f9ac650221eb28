"""A comparison in a notebook: per channel the largest difference and its tolerance."""

from __future__ import annotations

from adamslite.notebooks.markup import marked, number_table
from adamslite.results.comparison import Comparison, Difference

HEAD = ("channel", "worst", "allowed", "at t", "outside from")
#: More channels than this are counted only.
MOST = 200


def comparison_html(found: Comparison) -> str:
    """Those outside their tolerance first."""
    outside = [each for each in found if not each.inside]
    inside = [each for each in found if each.inside]
    listed = [*outside, *inside][:MOST]
    count = len(found.differences)
    verdict = f"{len(outside)} outside its tolerance" if outside else "all within their tolerances"
    mark = marked("error" if outside else "done", verdict)
    more = f"<p>and {count - MOST} more</p>" if count > MOST else ""
    return (
        f"<div><p>{count} compared, {mark}</p>{number_table(HEAD, map(_row, listed))}{more}</div>"
    )


def _row(each: Difference) -> tuple[str, ...]:
    leaves = "" if each.leaves is None else f"{each.leaves:.6g}"
    if not each.inside and each.leaves is None:
        leaves = "outside"
    time = "" if each.time is None else f"{each.time:.6g}"
    return each.name, f"{each.worst:.3e}", f"{each.allowed:.3e}", time, leaves

"""A chart of work against precision in a notebook: the recommendation, and all points."""

from __future__ import annotations

from adamslite.notebooks.markup import number_table, paragraph
from adamslite.verification.work_precision import Chart, Point

HEAD = ("integrator", "setting", "CPU [ms]", "steps", "error", "digits")
#: Digits for which a point is recommended.
DIGITS = 3


def chart_html(chart: Chart) -> str:
    """Recommendation, and a row for each run."""
    truth = f"reference: {chart.truth.origin}; known to {chart.truth.doubt:.1e}"
    rows = [_row(each, chart.useless) for each in chart.points]
    return f"<div>{paragraph(_verdict(chart))}{number_table(HEAD, rows)}{paragraph(truth)}</div>"


def _verdict(chart: Chart) -> str:
    if chart.useless:
        return "no recommendation: even tight runs do not agree, so no error can be trusted"
    best = chart.recommended(DIGITS)
    if best is None:
        return f"no run has {DIGITS} digits"
    return f"recommended for {DIGITS} digits: {best.program} {best.setting}"


def _row(point: Point, useless: bool) -> tuple[str, ...]:
    start = (point.program, point.setting)
    if not point.ok:
        return (*start, " ".join(point.reason.split()), "", "", "")
    digits = "-" if useless else str(point.digits)
    return (*start, f"{1e3 * point.median:.3g}", str(point.steps), f"{point.error:.1e}", digits)

"""A chart of work against precision in a notebook: figure, recommendation, all points."""

from __future__ import annotations

from base64 import b64encode
from io import BytesIO

from adamslite.errors import UsageError
from adamslite.notebooks.markup import folded, number_table, paragraph
from adamslite.plots.accuracy_chart import accuracy_chart
from adamslite.plots.accuracy_text import verdict
from adamslite.verification.work_precision import DIGITS, Chart, Point

HEAD = ("integrator", "setting", "CPU [ms]", "steps", "error", "digits")


def chart_html(chart: Chart) -> str:
    """Figure and recommendation, and on a click a row for each run."""
    lines = "".join(map(paragraph, verdict(chart, DIGITS).splitlines()))
    rows = [_row(each, chart.useless) for each in chart.points]
    table = folded(f"{len(rows)} runs", number_table(HEAD, rows))
    return f"<div>{_figure(chart)}{lines}{table}</div>"


def _figure(chart: Chart) -> str:
    """A picture; a sentence without matplotlib, nothing where no run reached its end."""
    try:
        name = chart.truth.results.meta.get("deck", "")
        figure = accuracy_chart(chart, name, DIGITS, chart.channels)
    except UsageError as absent:
        return paragraph(str(absent))
    if figure is None:
        return ""
    content = BytesIO()
    figure.savefig(content, format="png", dpi=110)
    source = f"data:image/png;base64,{b64encode(content.getvalue()).decode()}"
    return f'<img src="{source}" alt="CPU against error of each integrator" style="max-width:100%">'


def _row(point: Point, useless: bool) -> tuple[str, ...]:
    start = (point.program, point.setting)
    if not point.ok:
        return (*start, " ".join(point.reason.split()), "", "", "")
    digits = "-" if useless else str(point.digits)
    return (*start, f"{1e3 * point.median:.3g}", str(point.steps), f"{point.error:.1e}", digits)

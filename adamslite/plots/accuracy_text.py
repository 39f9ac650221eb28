"""A chart of work against precision as text: all runs, and what is recommended."""

from __future__ import annotations

from adamslite.notation import shown
from adamslite.plots.accuracy_chart import LIMITED, limited
from adamslite.verification.work_precision import Chart, Point


def table(chart: Chart) -> str:
    """A line for each run: CPU, steps, error, digits."""
    lines = [
        f"{'integrator':<14} {'setting':<12} {'CPU [ms]':>10} {'steps':>8} {'error':>9} digits"
    ]
    for p in chart.points:
        start = f"{p.program:<14} {p.setting:<12}"
        if p.ok:
            digits = "-" if chart.useless else p.digits
            lines.append(
                f"{start} {1e3 * p.median:>10.3g} {p.steps:>8} {p.error:>9.1e} {digits:>6}"
            )
        else:
            lines.append(f"{start} {' '.join(p.reason.split())}")
    return "\n".join(lines) + "\n"


def verdict(chart: Chart, digits: int) -> str:
    """The reference, what to know of the runs, and the point that is recommended."""
    truth = chart.truth
    header = f"reference: {truth.origin}; known to {truth.doubt:.1e}\n"
    if names := limited(chart):
        header += f"note: {shown(LIMITED.format(names=', '.join(names)))}\n"
    if chart.useless:
        return header + shown(
            "no recommendation: even tight runs do not agree, so no error above can be "
            "trusted. The scene may amplify every error (a shorter --end shows), or jump.\n"
        )
    best = chart.recommended(digits)
    if best:
        return f"{header}recommended: {_named(best)}\n"
    good = [p for p in chart.points if p.ok]
    nearest = min(good, key=lambda p: (p.error, p.median), default=None)
    return header + (
        f"no run has {digits} digits; nearest: {_named(nearest)}\n" if nearest
        else "no run reached its end\n"
    )  # fmt: skip


def _named(p: Point) -> str:
    return f"{p.program} {p.setting}: {1e3 * p.median:.3g} ms, {p.digits} digits"

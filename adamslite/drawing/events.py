"""Moments of a run that its results report."""

from __future__ import annotations

import re
from typing import Any

from adamslite.results.results import Results

# Comments of results that name moments.
WITH_TIMES = ("sensor", "sensor passed", "out of its law", "no number", "linear")
AT = re.compile(r"(?:\bat |\bsince |\bfrom )?t = ([-+0-9.eE]*[0-9])")


def events(results: Results) -> list[dict[str, Any]]:
    """Time and sentence of each, in their order."""
    found = []
    for key in WITH_TIMES:
        for sentence in str(results.meta.get(key, "")).split("; "):
            for time in AT.findall(sentence)[:1]:
                found.append({"time": float(time), "text": sentence})
    if not results.outcome.is_requested and len(results.time):
        found.append({"time": float(results.time[-1]), "text": results.outcome.sentence})
    return sorted(found, key=lambda each: each["time"])

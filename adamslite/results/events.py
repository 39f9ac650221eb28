"""Moments of a run that its results report: sensors, contacts, an early end, numbers that are none.

Comments of the results name most of them, also after they were written and read again.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from adamslite.results.results import Results

#: Comments of results that name moments.
COMMENTS = ("sensor", "sensor passed", "out of its law", "no number", "linear")
AT = re.compile(r"\bt = ([-+0-9.eE]*[0-9])")
TOUCHING = ".incidents"


class Event(NamedTuple):
    """A time of the run and what happened then, in words."""

    time: float
    text: str


def events_of(results: Results) -> list[Event]:
    """The events of a run in their order; several at the same time stay apart."""
    found = [*_reported(results), *_contacts(results), *_early_end(results)]
    return sorted(found, key=lambda each: each.time)


def _reported(results: Results) -> Iterator[Event]:
    for key in COMMENTS:
        for sentence in str(results.meta.get(key, "")).split("; "):
            if match := AT.search(sentence):
                lead = "no number in " if key == "no number" else ""
                yield Event(float(match[1]), lead + sentence)


def _contacts(results: Results) -> Iterator[Event]:
    """Output times at which a contact touches, or has parted, for the first time since the last."""
    for name in results.names:
        if name.startswith("CONTACT/") and name.endswith(TOUCHING):
            label = name.removesuffix(TOUCHING)
            with np.errstate(invalid="ignore"):
                touching = results[name] > 0.0
            for at in np.flatnonzero(touching[1:] != touching[:-1]) + 1:
                what = "touches" if touching[at] else "parts"
                time = float(results.time[at])
                yield Event(time, f"{label} {what} by t = {time:.6g}")


def _early_end(results: Results) -> Iterator[Event]:
    """Of a run that stopped, with its outcome."""
    if not results.outcome.is_requested and len(results.time):
        time = float(results.time[-1])
        yield Event(time, f"stopped early at t = {time:.6g}: {results.outcome.name}")

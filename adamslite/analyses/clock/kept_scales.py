"""Time scales of long expressions of time, kept between runs.

A chain of VARIABLEs of TIME has as many curves as links, each as long as the chain before it: to
bisect them takes seconds, and gives the same for the same numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.clock.changes import Found, time_scales
from adamslite.caching.entries import recall_json
from adamslite.caching.sources import version_of
from adamslite.native import compiler
from adamslite.native.worker import require_time

if TYPE_CHECKING:
    from adamslite.analyses.clock.clock import Program
    from adamslite.native.worker import Over

#: Instructions of all programs from which on to keep is faster than to find again.
WORTH = 2000
PLAIN = (str, int, float)


def all_time_scales(
    programs: Sequence[Program], start: float, end: float, longest: float, over: Over = None
) -> list[Found]:
    """What :func:`time_scales` finds of each program; Overspent is raised when it was ``over``
    before.
    """

    def scales(program: Program) -> Found:
        require_time(over)
        return time_scales(program, start, end, longest)

    def found() -> list[Found]:
        return [scales(program) for program in programs]

    words = [word for program in programs for instruction in program for word in instruction]
    if sum(map(len, programs)) < WORTH or not all(isinstance(word, PLAIN) for word in words):
        return found()
    known = repr((programs, start, end, longest))
    name = f"scales{compiler.digest(version_of('analyses.clock.changes'), known)}.json"
    kept = recall_json(name, lambda: [_numbers(each) for each in found()])
    return [
        Found(np.array(times), np.array(spans).reshape(-1, 3), whole)
        for times, spans, whole in kept
    ]


def _numbers(found: Found) -> tuple[list[float], list[list[float]], bool]:
    return found.times.tolist(), found.spans.tolist(), found.whole

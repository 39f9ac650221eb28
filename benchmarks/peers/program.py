"""What a program is to the measurement.

1. ``ladder`` lists its settings for a scene, from loose and cheap to tight and dear.
2. ``solve`` imports the program, solves the scene once with one of them and returns a Solution.
3. Set-up is everything from the arrays of the scene to a program ready to step; solve is the rest
   up to the end state. Imports are in neither.
4. All times are CPU seconds of the process, user and system.
"""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

Settings = dict[str, Any]


@dataclass(frozen=True)
class Solution:
    """One solved scene.

    values : (n, 3) end positions [m] of a chain, or as ``mechanisms.truth``
    setup, solve : CPU [s];  steps : accepted steps, 0 where the program does not tell
    reason : what the program says when it failed
    """

    values: np.ndarray
    setup: float
    solve: float
    steps: int = 0
    ok: bool = True
    reason: str = ""


@dataclass(frozen=True)
class Program:
    """A program with one method; kind is ours, implicit, explicit or limit.

    order : of a fixed-step method whose settings have "steps"; 0 where the program picks its steps
    compiles : whether the first run of a scene includes compilation, measured apart in ``startup``
    """

    name: str
    kind: str
    scenes: tuple[str, ...]
    ladder: Callable[[str, int], list[Settings]]
    solve: Callable[[str, int, Settings], Solution]
    installed: Callable[[], bool]
    order: int = 0
    compiles: bool = False


def module_found(name: str) -> Callable[[], bool]:
    """Whether a Python module can be imported, without importing it."""
    return lambda: importlib.util.find_spec(name) is not None


def tolerances(first: float, last: float) -> Callable[[str, int], list[Settings]]:
    """Relative tolerances from first down to last, two a decade; the absolute one is 1/100."""
    count = round(2 * np.log10(first / last)) + 1
    grid = [float(f"{x:.2g}") for x in np.geomspace(first, last, count)]
    return lambda scene, n: [{"rtol": x, "atol": x / 100} for x in grid]


def step_counts(first: int, last: int) -> list[int]:
    """Numbers of steps from first to last, each the square root of 2 times the one before."""
    counts, count = [], float(first)
    while count <= last * 1.01:
        counts.append(round(count))
        count *= 2**0.5
    return counts


class Laps:
    """CPU seconds between calls."""

    def __init__(self) -> None:
        self.before = time.process_time()

    def lap(self) -> float:
        """Seconds since the last call."""
        now = time.process_time()
        passed, self.before = now - self.before, now
        return passed

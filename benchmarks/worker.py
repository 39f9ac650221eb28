"""A process that solves scenes with one program: JSON lines in, JSON lines out.

It keeps running, so that imports and caches are warm as in a session of a user, and so that a
program that crashes takes nothing else with it.
"""

from __future__ import annotations

import json
import os
import sys
from typing import Any

import numpy as np

from benchmarks.peers import PROGRAMS
from benchmarks.reference import DOUBT, reference


def error_of(scene: str, n: int, values: np.ndarray) -> dict[str, float | None]:
    """Error of the end state: largest place [m], or angle [rad] with the energy drift of S4."""
    truth = reference(scene, n)
    if truth is None:
        return {"error": None}
    if scene == "S3":
        return {"error": float(abs(values[0] - truth[0]))}
    if scene == "S4":
        drift = float(abs(values[1] / truth[1] - 1))
        return {"error": float(abs(values[0] - truth[0])), "drift": drift}
    worst = float(np.sqrt(((values - truth) ** 2).sum(axis=1)).max())
    return {"error": max(worst, DOUBT.get((scene, n), 0.0))}


def answer(name: str, question: dict[str, Any]) -> dict[str, Any]:
    """Solve once; what goes wrong is told, not raised."""
    scene, n = question["scene"], question["n"]
    try:
        solution = PROGRAMS[name].solve(scene, n, question["settings"])
    except Exception as reason:
        return {"ok": False, "reason": f"{type(reason).__name__}: {reason}"[:300]}
    told = {"setup": solution.setup, "solve": solution.solve, "steps": int(solution.steps)}
    if not solution.ok:
        return {"ok": False, "reason": "it said it failed", **told}
    return {"ok": True, **told, **error_of(scene, n, solution.values)}


def main() -> None:
    """Answer until the input ends; what a program prints is thrown away."""
    replies = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    for line in sys.stdin:
        replies.write(json.dumps(answer(sys.argv[1], json.loads(line))) + "\n")
        replies.flush()


if __name__ == "__main__":
    main()

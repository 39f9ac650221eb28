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

from benchmarks.mechanisms import PLANAR, SPATIAL, truth
from benchmarks.memory import forget_peak, peak
from benchmarks.peers import PROGRAMS
from benchmarks.reference import DOUBT, reference

#: A program's refusal, by name: at another setting the answer would be the same.
REFUSAL = "UsageError"


def error_of(scene: str, n: int, values: np.ndarray) -> dict[str, float | None]:
    """Error of the end state: largest distance [m] or difference [rad]; energy drift of S4."""
    if scene in (*PLANAR, *SPATIAL):
        return mechanism_error(scene, n, values)
    known = reference(scene, n)
    if known is None:
        return {"error": None}
    worst = float(np.sqrt(((values - known) ** 2).sum(axis=1)).max())
    return {"error": max(worst, DOUBT.get((scene, n), 0.0))}


def mechanism_error(scene: str, n: int, values: np.ndarray) -> dict[str, float | None]:
    """Distance of the watched point [m], or difference of the watched angle [rad]."""
    known = truth(scene, n)
    if scene in ("S3", "S4"):
        told = {"error": float(abs(values[0] - known[0]))}
        return told if scene == "S3" else {**told, "drift": float(abs(values[1] / known[1] - 1))}
    return {"error": float(np.linalg.norm(values - known))}


def answer(name: str, question: dict[str, Any]) -> dict[str, Any]:
    """Solve once; what goes wrong is reported, not raised."""
    scene, n = question["scene"], question["n"]
    forget_peak()
    try:
        solution = PROGRAMS[name].solve(scene, n, question["settings"])
    except Exception as reason:
        kind = type(reason).__name__
        sentence = " ".join(f"{kind}: {reason}".split())[:300]
        return {"ok": False, "reason": sentence, "refused": kind == REFUSAL}
    told = {"setup": solution.setup, "solve": solution.solve, "steps": int(solution.steps)}
    # The hand-coded programs run outside of this process.
    told["peak"] = None if PROGRAMS[name].kind == "limit" else peak()
    if not solution.ok:
        return {"ok": False, "reason": solution.reason or "it said it failed", **told}
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

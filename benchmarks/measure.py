"""Measures programs against each other: climb to the accuracy, then repeat in turns.

1. Every program climbs its ladder of settings until it has met every target, or until the next rung
   would cost more than the budget. A fixed-step method of known order leaves out rungs that
   cannot do.
2. For every target the cheapest rung that met it is repeated, the programs taking turns, so that a
   disturbance of the machine hits all of them; the median counts.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from dataclasses import dataclass, field
from statistics import median
from threading import Timer
from typing import Any

from benchmarks.peers import PROGRAMS
from benchmarks.peers.program import Program, Settings

#: A rung may cost this much more than the last one, if nothing is known about it.
NEXT_RUNG = 1.4
#: Errors below this follow the order of the method.
ASYMPTOTIC = 0.05
#: Runs of this CPU [s] are repeated less: (from, at most this often).
SHORTER = ((8.0, 1), (2.0, 3))

#: Wall time [s] after which a run is given up, whatever the budget.
PATIENCE = 120.0

ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}


@dataclass
class Point:
    """One program with one setting on one scene; times are CPU [s], one per repeat."""

    program: str
    scene: str
    n: int
    settings: Settings
    error: float | None = None
    drift: float | None = None
    steps: int = 0
    ok: bool = False
    reason: str = ""
    first_solve: float = 0.0
    first_setup: float = 0.0
    solves: list[float] = field(default_factory=list)
    setups: list[float] = field(default_factory=list)

    @property
    def solve(self) -> float:
        """Median CPU [s] from the ready program to the end state."""
        return median(self.solves) if self.solves else self.first_solve

    @property
    def setup(self) -> float:
        """Median CPU [s] before that."""
        return median(self.setups) if self.setups else self.first_setup

    @property
    def fastest(self) -> float:
        """Least solve CPU [s]."""
        return min(self.solves, default=self.first_solve)

    def meets(self, target: float) -> bool:
        """Whether the error is known and small enough."""
        return self.ok and self.error is not None and self.error <= target


class Worker:
    """The process of one program; it is ended when an answer takes longer than its patience."""

    def __init__(self, name: str, patience: float = PATIENCE) -> None:
        self.name, self.patience = name, patience
        self.process: subprocess.Popen | None = None

    def ask(self, point: Point) -> dict[str, Any]:
        """Have the point solved once; a crash is an answer, too."""
        if self.process is None or self.process.poll() is not None:
            command = [sys.executable, "-m", "benchmarks.worker", self.name]
            self.process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                env={**os.environ, **ONE_THREAD}, stderr=subprocess.DEVNULL,
            )  # fmt: skip
        question = {"scene": point.scene, "n": point.n, "settings": point.settings}
        self.process.stdin.write(json.dumps(question) + "\n")
        self.process.stdin.flush()
        alarm = Timer(self.patience, self.process.kill)
        alarm.start()
        line = self.process.stdout.readline()
        alarm.cancel()
        if line:
            return json.loads(line)
        self.process.wait()
        late = self.process.returncode == -signal.SIGKILL
        return {"ok": False, "reason": "it took too long" if late else "it crashed"}

    def close(self) -> None:
        """Let the process end."""
        if self.process is not None and self.process.poll() is None:
            self.process.stdin.close()
            self.process.wait()


def first_run(worker: Worker, point: Point) -> Point:
    """Fill a point from its first run, which only warms up."""
    told = worker.ask(point)
    point.ok, point.reason = told["ok"], told.get("reason", "")
    point.steps, point.error, point.drift = (told.get(k) for k in ("steps", "error", "drift"))
    point.first_solve, point.first_setup = told.get("solve", 0.0), told.get("setup", 0.0)
    return point


def climb(
    worker: Worker, program: Program, scene: str, n: int, targets: list[float], budget: float
) -> list[Point]:
    """Run the rungs of a program's ladder until all targets are met or the budget ends it."""
    points: list[Point] = []
    left = sorted(targets, reverse=True)
    needed = 0
    ladder = program.ladder(scene, n)
    if ladder and program.compiles:
        first_run(worker, Point(program.name, scene, n, ladder[0]))
    for settings in ladder:
        if settings.get("steps", 0) < needed:
            continue
        if points and predicted(points[-1], settings) > budget:
            break
        point = first_run(worker, Point(program.name, scene, n, settings))
        if sys.stderr.isatty():
            print(f"{scene} N={n} {program.name} {settings}: {point.error}", file=sys.stderr)
        points.append(point)
        left = [t for t in left if not point.meets(t)]
        if not left:
            break
        needed = steps_needed(program, point, left[0])
    return points


def predicted(last: Point, settings: Settings) -> float:
    """CPU [s] the next rung will take."""
    more = settings["steps"] / last.settings["steps"] if "steps" in settings else NEXT_RUNG
    return last.first_solve * more


def steps_needed(program: Program, point: Point, target: float) -> float:
    """Steps below which a method of known order cannot meet the target."""
    if not program.order or not point.ok or not point.error or point.error > ASYMPTOTIC:
        return 0
    return 0.9 * point.settings["steps"] * (point.error / target) ** (1 / program.order)


def cheapest(points: list[Point], target: float) -> Point | None:
    """The cheapest point that meets a target."""
    return min((p for p in points if p.meets(target)), key=lambda p: p.solve, default=None)


def repeats_of(point: Point, repeats: int) -> int:
    """How often a point is repeated: long runs less often."""
    return next((min(repeats, k) for cpu, k in SHORTER if point.first_solve > cpu), repeats)


def repeat_in_turns(workers: dict[str, Worker], points: list[Point], repeats: int) -> None:
    """Measure points again and again, one after the other."""
    for turn in range(repeats):
        for point in points:
            if turn < repeats_of(point, repeats):
                told = workers[point.program].ask(point)
                if told["ok"]:
                    point.solves.append(told["solve"])
                    point.setups.append(told["setup"])


def measure(
    scene: str, n: int, programs: list[str], targets: list[float], budget: float, repeats: int
) -> list[Point]:
    """All points of a scene at one N, those that are the cheapest for a target repeated."""
    workers = {name: Worker(name, max(4 * budget, 30.0)) for name in programs}
    by_program = {
        name: climb(workers[name], PROGRAMS[name], scene, n, targets, budget) for name in programs
    }
    chosen = {
        id(p): p for points in by_program.values() for t in targets if (p := cheapest(points, t))
    }
    if not chosen:  # no reference: the last rung stands for the cost
        chosen = {id(ps[-1]): ps[-1] for ps in by_program.values() if ps and ps[-1].ok}
    repeat_in_turns(workers, list(chosen.values()), repeats)
    for worker in workers.values():
        worker.close()
    return [point for points in by_program.values() for point in points]

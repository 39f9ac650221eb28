"""Measures programs against each other: climb to the accuracy, then repeat in turns.

1. Every program climbs its ladder of settings until it has met every target, or until the next rung
   would cost more than the budget. A fixed-step method of known order leaves out rungs that
   cannot do.
2. All rungs are repeated, the programs taking turns, so that a disturbance of the machine hits all
   of them; the median counts. Long runs are repeated less.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from statistics import median
from threading import Event, Thread
from typing import Any

from adamslite.verification import work_precision
from adamslite.verification.work_precision import repeats_of
from benchmarks.peers import PROGRAMS
from benchmarks.peers.program import Program, Settings

#: A rung may cost this much more than the last one, if nothing is known about it.
NEXT_RUNG = 1.4
#: Errors below this follow the order of the method.
ASYMPTOTIC = 0.05
#: A program that failed at so many rungs one after the other fails at all.
FAILURES = 4
#: CPU a run may take before it is given up, as a multiple of the budget, and at least [s].
PATIENCE = 2.0
LEAST_PATIENCE = 4.0
#: Wall time [s] per CPU second of patience after which a process is taken for dead.
DEAD = 20.0
#: How often that is looked at [s].
LOOK = 0.25

#: Why a setting was not run: it says nothing about the program.
TIME_UP = "not run: the time was up"

ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}


@dataclass(frozen=True)
class Effort:
    """How much is measured.

    targets : errors to reach;  budget : CPU [s] a run may take;  repeats : of short runs
    coarse : every second rung only;  lasting : processes live on from scene to scene
    deadline : ``time.monotonic`` after which nothing new is begun
    """

    targets: tuple[float, ...]
    budget: float
    repeats: int
    coarse: bool = False
    lasting: bool = False
    deadline: float = float("inf")

    @property
    def over(self) -> bool:
        """Whether the time is up."""
        return time.monotonic() > self.deadline

    @property
    def patience(self) -> float:
        """CPU [s] after which a run is given up."""
        return max(PATIENCE * self.budget, LEAST_PATIENCE)


@dataclass(kw_only=True)
class Point(work_precision.Point):
    """One program with one setting on one scene.

    drift : of the energy, S4 only;  setups : CPU [s] of set-ups;  peak : memory [MB]
    """

    scene: str
    n: int
    settings: Settings
    drift: float | None = None
    setups: list[float] = field(default_factory=list)
    peak: float | None = None
    refused: bool = False

    @property
    def setup(self) -> float | None:
        """Median CPU [s] from the scene to a program ready to step."""
        return median(self.setups) if self.setups else None


def point(program: str, scene: str, n: int, settings: Settings) -> Point:
    """A point to be measured; the absolute tolerance follows from the relative one, unprinted."""
    told = {"error": "ERROR", "steps": "steps", "rtol": "rtol"}
    setting = " ".join(f"{told[k]}={v:g}" for k, v in settings.items() if k in told)
    if "steps" in settings:
        setting = f"steps={settings['steps']}"
    return Point(program=program, setting=setting, scene=scene, n=n, settings=settings)


class Worker:
    """The process of one program; it is ended when an answer takes longer than its patience."""

    def __init__(self, name: str, patience: float) -> None:
        self.name, self.patience = name, patience
        self.process: subprocess.Popen | None = None

    def ask(self, point: Point, patience: float | None = None) -> dict[str, Any]:
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
        answered = Event()
        Thread(target=self._guard, args=(answered, patience or self.patience), daemon=True).start()
        line = self.process.stdout.readline()
        answered.set()
        if line:
            return json.loads(line)
        self.process.wait()
        late = self.process.returncode == -signal.SIGKILL
        reason = "it took too long and was given up" if late else "it crashed"
        return {"ok": False, "reason": reason, "given_up": late}

    def _guard(self, answered: Event, patience: float) -> None:
        """Kill the process when it has used too much CPU before it answered.

        From here, because a CPU timer or limit inside of the process makes its own clock coarse.
        """
        process, start, wall = self.process, None, time.monotonic()
        while not answered.wait(LOOK):
            used = cpu_of(process.pid)
            start = used if start is None else start
            if used - start > patience or time.monotonic() - wall > DEAD * patience:
                process.kill()
                return

    def close(self) -> None:
        """Let the process end."""
        if self.process is not None and self.process.poll() is None:
            self.process.stdin.close()
            self.process.wait()


def cpu_of(process: int) -> float:
    """CPU [s] a process has used, 0 where the system does not tell."""
    try:
        words = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


#: The first run of a scene may compile for this long [s].
COMPILING = 180.0


def warm_up(worker: Worker, program: Program, first: Point) -> None:
    """A run that is not counted, for programs that compile and keep."""
    if program.compiles:
        worker.ask(first, COMPILING)


def first_run(worker: Worker, point: Point) -> Point:
    """Fill a point from its first run."""
    told = worker.ask(point)
    point.reason = "" if told["ok"] else told.get("reason", "") or "it failed"
    point.error, point.drift, point.peak = (told.get(k) for k in ("error", "drift", "peak"))
    point.steps = told.get("steps", 0)
    point.given_up, point.refused = told.get("given_up", False), told.get("refused", False)
    if "solve" in told:
        point.cpu, point.setups = [told["solve"]], [told["setup"]]
    return point


def climb(worker: Worker, program: Program, scene: str, n: int, effort: Effort) -> list[Point]:
    """Run the rungs of a program's ladder until all targets are met or the budget ends it."""
    points: list[Point] = []
    left = sorted(effort.targets, reverse=True)
    needed, failures = 0.0, 0
    ladder = program.ladder(scene, n)[:: 2 if effort.coarse else 1]
    if ladder and not effort.over:
        warm_up(worker, program, point(program.name, scene, n, ladder[0]))
    for settings in ladder:
        if settings.get("steps", needed) < needed:
            continue
        if points and predicted(points[-1], settings) > effort.budget:
            break
        if effort.over:
            points.append(point(program.name, scene, n, settings))
            points[-1].reason = TIME_UP
            break
        made = first_run(worker, point(program.name, scene, n, settings))
        if sys.stderr.isatty():
            print(f"{scene} N={n} {made.program} {made.setting}: {made.error}", file=sys.stderr)
        points.append(made)
        left = [t for t in left if not made.meets(t)]
        failures = 0 if made.ok else failures + 1
        if not left or made.refused or made.given_up or failures == FAILURES:
            break
        needed = steps_needed(program, made, left[0])
    return points


def predicted(last: Point, settings: Settings) -> float:
    """CPU [s] the next rung will take."""
    more = settings["steps"] / last.settings["steps"] if "steps" in settings else NEXT_RUNG
    return last.median * more if last.cpu else 0.0


def steps_needed(program: Program, point: Point, target: float) -> float:
    """Steps below which a method of known order cannot meet the target."""
    if not program.order or not point.ok or not point.error or point.error > ASYMPTOTIC:
        return 0.0
    return 0.9 * point.settings["steps"] * (point.error / target) ** (1 / program.order)


def repeat_in_turns(workers: dict[str, Worker], points: list[Point], effort: Effort) -> None:
    """Measure points again and again, one after the other; where that is done the first run, which
    may have been a cold one, does not count.
    """
    turns = {id(p): repeats_of(p.cpu[0], effort.repeats) for p in points if p.ok}
    for p in points:
        if turns.get(id(p), 1) > 1:
            p.cpu, p.setups = [], []
    for turn in range(effort.repeats):
        for p in points:
            if p.ok and 1 < turns[id(p)] > turn and not (p.cpu and effort.over):
                told = workers[p.program].ask(p)
                if told["ok"]:
                    p.cpu.append(told["solve"])
                    p.setups.append(told["setup"])


class Crew(dict):
    """Workers by the name of their program, hired when first asked for."""

    def __init__(self, effort: Effort) -> None:
        super().__init__()
        self.effort = effort

    def __missing__(self, name: str) -> Worker:
        self[name] = Worker(name, self.effort.patience)
        return self[name]

    def share(self, deadline: float) -> None:
        """Begin nothing new after ``deadline``, a ``time.monotonic``."""
        self.effort = replace(self.effort, deadline=deadline)

    def close(self) -> None:
        """Let all processes end."""
        for worker in self.values():
            worker.close()
        self.clear()


def measure(scene: str, n: int, programs: list[str], crew: Crew) -> list[Point]:
    """All points of a scene at one N."""
    effort = crew.effort
    points = [p for name in programs for p in climb(crew[name], PROGRAMS[name], scene, n, effort)]
    repeat_in_turns(crew, points, effort)
    if not effort.lasting:
        crew.close()
    return points

"""Whether advice on cables holds: random scenes, solved as advised, as more than that, as less.

    python -m benchmarks.advice --scenes 60 --seed 1 [--p 0.001] [--jobs 2]
    python -m benchmarks.advice --seed 1 --scene 17             # one of them, with its description
    python -m benchmarks.advice --sample                        # the sample beside this file
    python -m benchmarks.advice --renew FILE ...                # write it anew, from outputs

Advice is given twice: by the linear model alone, and by trying. Truth is that of
:mod:`benchmarks.rope_runs`. Less is half the sections, the next lower level or form, and ten times
ERROR. Each scene is a line of JSON in --out, for --renew and for those who count otherwise.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import resource
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks.rope_runs import (
    CLOCK,
    STILL,
    Model,
    Solved,
    apart,
    described,
    solve,
    solved,
    truths,
)
from benchmarks.rope_scenes import Table, scene

#: CPU that a truth may take [s].
BUDGET = 40.0
#: In p: what a truth may be off where it still tells whether a model is inside.
LARGEST_DOUBT = 0.5
LOOSER = 10.0
#: Short runs are timed more than twice: so many times at most, so long [s].
MOST_TIMES, LONG = 6, 0.05
#: Scenes that are solved again and again, with their truth; how many, of which CPU [s] at most, and
#: how far inside, in p: other processors round otherwise.
SAMPLE = Path(__file__).parent / "advice.json"
SAMPLED, SHORT, ROOM = 40, 0.2, 0.95
WAYS = ("linear", "tried")


@dataclass
class Advised:
    """What one way of advising gave.

    model : what was advised;  off : its error in p, in the figure ``worst``;  less : errors of
    cheaper ones, with how much cheaper each is
    """

    model: str = ""
    off: float = math.nan
    worst: str = ""
    cpu: float = 0.0
    told: float = 0.0
    less: dict[str, tuple[float, float]] = field(default_factory=dict)
    why: str = ""

    @property
    def is_least(self) -> bool:
        """Whether nothing that is cheaper by half does."""
        return all(off > 1 or gain < 2 for off, gain in self.less.values())


@dataclass
class Verdict:
    """What became of a scene; ``doubt`` of its truth in p."""

    seed: int
    scene: int
    kind: str
    p: float
    doubt: float = math.nan
    linear: Advised = field(default_factory=Advised)
    tried: Advised = field(default_factory=Advised)
    truth: list[dict[str, float]] = field(default_factory=list)
    why: str = ""
    warned: list[str] = field(default_factory=list)

    def of(self, way: str) -> Advised:
        """The advice of that way."""
        found: Advised = getattr(self, way)
        return found

    def is_known(self, way: str) -> bool:
        """Whether there is a truth that tells inside from outside."""
        if not self.doubt <= LARGEST_DOUBT or math.isnan(self.of(way).off):
            return False
        return self.doubt <= STILL or abs(self.of(way).off - 1) > self.doubt


@dataclass(frozen=True)
class Deck:
    """The deck of an advice, its model and method, and CPU estimated [s]."""

    text: str
    model: Model
    method: str
    told: float


def judge(seed: int, number: int, p: float, budget: float) -> Iterator[Verdict]:
    """The verdict, again after each run that says more."""
    kind, table = scene(seed, number)
    yield from judged(table, Verdict(seed, number, kind, p), budget)


def judged(table: Table, found: Verdict, budget: float) -> Iterator[Verdict]:
    """The same of any description."""
    p = found.p
    found.why = "no truth in time"
    decks, finest, found.warned = advised(table, p)
    if "goes-slack" in found.warned:
        table = {**table, "cable": {**table["cable"], "pulls_only": True}}
    runs: dict[str, Solved] = {}
    for way, deck in decks.items():
        one = found.of(way)
        one.model = f"{deck.model.level} {deck.model.form} {deck.model.elements} {deck.method}"
        one.model += f" {deck.model.error:.1E}"
        same = runs["linear"] if way == "tried" and deck.text == decks["linear"].text else None
        try:
            runs[way] = same or quickest(partial(solved, table, deck.text, deck.model))
        except RuntimeError as fault:
            one.why = " ".join(str(fault).split())[:100]
            continue
        one.cpu, one.told = runs[way].cpu, deck.told
        yield found
    truth = None
    if "unsettled" in found.warned:
        budget /= 3
    above = [*(deck.model for deck in decks.values()), *finest]
    for truth, found.doubt in truths(table, above, p, budget):
        found.truth = [truth.figures, truth.scales]
        for way, run in runs.items():
            found.of(way).off, found.of(way).worst = apart(run, truth, p)
        yield found
    for way in runs:
        if truth is not None and found.is_known(way):
            found.why = ""
            compare_less(table, found.of(way), decks[way], truth, p)
            yield found


def advised(table: Table, p: float) -> tuple[dict[str, Deck], list[Model], list[str]]:
    """The decks of both ways, the finest that was tried, and what is warned of."""
    from adamslite.api.trials import solver
    from adamslite.cables.deck.scene import setting, written
    from adamslite.cables.model.advice import advise
    from adamslite.cables.trials.trial import tried
    from adamslite.progress import Progress

    of = setting(described(table, Model(), p))
    found = tried(of, solver(Progress()), of.spec.trial)
    first, last = written(of), found.deck
    told = advise(of.demand, p).cost
    decks = {
        "linear": _deck(first, told),
        "tried": _deck(last, found.cpu if math.isfinite(found.cpu) else told),
    }
    finest = found.finest
    above = [Model(finest.level, finest.form, finest.elements, finest.error)] if finest else []
    return decks, above, [each.code for each in last.messages]


def _deck(of: Any, told: float) -> Deck:
    model = of.model
    form = model.form if model.level == 3 else "auto"
    count = 0 if model.level == 1 else model.elements
    return Deck(
        of.text, Model(model.level, form, count, model.error), model.method, max(told, CLOCK)
    )


def quickest(run: Callable[[], Solved]) -> Solved:
    """With the least CPU of two, of more where they are short."""
    runs = [run(), run()]
    while len(runs) < MOST_TIMES and sum(each.cpu for each in runs) < LONG:
        runs.append(run())
    return min(runs, key=lambda each: each.cpu)


def compare_less(table: Table, one: Advised, deck: Deck, truth: Solved, p: float) -> None:
    """Models that are less than the advised one."""
    for name, model in lesser(deck.model).items():
        method = deck.method if model.level != 1 else ""
        try:
            run = quickest(partial(solve, table, model, p, method))
        except Exception as fault:
            one.why = f"{name}: {' '.join(str(fault).split())[:100]}"
            continue
        one.less[name] = (apart(run, truth, p)[0], one.cpu / run.cpu)


def lesser(used: Model) -> dict[str, Model]:
    """Half the sections, ten times ERROR, and the next lower level or form."""
    found = {"ERROR": replace(used, error=used.error * LOOSER)}
    if used.elements > 1:
        found["sections"] = replace(used, elements=(used.elements + 1) // 2)
    if used.form == "ale":
        found["form"] = replace(used, form="paper")
    elif used.level > 1:
        found["level"] = Model(1)
    return found


# ---- many scenes -----------------------------------------------------------------------------


def in_process(seed: int, number: int, p: float, budget: float) -> Verdict:
    """A scene in a process of its own, which ends when its CPU is used up."""
    words = [sys.executable, "-m", "benchmarks.advice", "--worker", "--seed", str(seed), "--scene",
             str(number), "--p", repr(p), "--budget", repr(budget)]  # fmt: skip
    env = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    run = subprocess.run(words, capture_output=True, text=True, env=env, check=False)
    lines = [line for line in run.stdout.splitlines() if line.startswith("{")]
    error = (run.stderr.strip().splitlines() or ["no CPU left"])[-1][:200]
    if not lines:
        return Verdict(seed, number, scene(seed, number)[0], p, why=error)
    found = read_verdict(lines[-1])
    if run.returncode and found.why:
        found.why = error
    return found


def read_verdict(line: str) -> Verdict:
    """From a line of JSON."""
    said = json.loads(line)
    for way in WAYS:
        less = {name: tuple(each) for name, each in said[way]["less"].items()}
        said[way] = Advised(**{**said[way], "less": less})
    return Verdict(**said)


def work(arguments: argparse.Namespace) -> None:
    """One scene: a line of JSON after each run."""
    limit = int(2 * arguments.budget + 60)
    resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
    for found in judge(arguments.seed, arguments.scene[0], arguments.p, arguments.budget):
        print(json.dumps(asdict(found)), flush=True)


def line(each: Verdict) -> str:
    """A scene in the listing."""
    told = [f"{each.scene:4d} {each.kind:9} doubt {each.doubt:.2g}p {each.why}"
            f" {' '.join(each.warned)}"]  # fmt: skip
    for way in WAYS:
        one = each.of(way)
        less = ", ".join(f"{k} {off:.2g}p at 1/{gain:.2g}" for k, (off, gain) in one.less.items())
        ratio = one.told / one.cpu if one.cpu else math.nan
        told.append(f"     {way:6} {one.model:30} off {one.off:8.3g}p {one.worst:10} cpu"
                    f" {one.cpu:.3g} told x{ratio:.2g}; {less} {one.why}")  # fmt: skip
    return "\n".join(told)


def report(found: Sequence[Verdict], way: str) -> list[str]:
    """The shares of one way."""
    known = [each.of(way) for each in found if each.is_known(way)]

    def share(count: int, of: int) -> str:
        return f"{count} of {of} ({100 * count / max(of, 1):.0f} %)"

    inside = [each for each in known if each.off <= 1]
    ratios = [one.told / one.cpu for one in (each.of(way) for each in found)
              if one.cpu > 0 and one.told > 0]  # fmt: skip
    near = [r for r in ratios if 0.5 <= r <= 2]
    unsettled = [each for each in found if "unsettled" in each.warned]
    lines = [
        f"{way}: {len(found)} scenes, {len(known)} with a truth that stands still to p/10",
        f"  inside p          {share(len(inside), len(known))}",
        f"  inside 1.5 p      {share(sum(each.off <= 1.5 for each in known), len(known))}",
        f"  nothing cheaper   {share(sum(each.is_least for each in inside), len(inside))}"
        " (outside p, or less than twice cheaper)",
        f"  CPU estimated     {share(len(near), len(ratios))} within a factor 2",
    ]
    if way == "tried":
        lines.append(f"  not settled       {len(unsettled)}, of which with a truth "
                     f"{sum(each.is_known(way) for each in unsettled)}")  # fmt: skip
    for name in ("sections", "form", "level", "ERROR"):
        tried = [each.less[name] for each in inside if name in each.less]
        good = sum(off > 1 or gain < 2 for off, gain in tried)
        lines.append(f"    less {name:9} {share(good, len(tried))}")
    return lines


# ---- the sample ------------------------------------------------------------------------------


def sample() -> int:
    """Solve the scenes of the sample as advised, and hold them against what is written there: how
    many are outside."""
    outside = 0
    for each in json.loads(SAMPLE.read_text(encoding="utf-8")):
        kind, table = scene(each["seed"], each["scene"])
        truth = Solved(each["figures"], each["scales"], 0.0, Model())
        deck = advised(table, each["p"])[0]["tried"]
        off, worst = apart(solved(table, deck.text, deck.model), truth, each["p"])
        outside += off > 1
        print(f"{each['seed']:4d} {each['scene']:4d} {kind:9} {off:8.3g}p {worst}", flush=True)
    print(f"{outside} outside the accuracy that was asked for")
    return outside


def renew(files: Sequence[Path]) -> None:
    """Write scenes inside the accuracy with their truth, of kinds in turn."""
    lines = [line for file in files for line in file.read_text(encoding="utf-8").splitlines()]
    found = [read_verdict(line) for line in lines]
    kept = [each for each in found if each.is_known("tried") and each.doubt <= STILL
            and each.tried.off < ROOM and each.tried.cpu < SHORT]  # fmt: skip
    turns: dict[str, int] = {}
    order = {}
    for each in kept:
        turns[each.kind] = turns.get(each.kind, 0) + 1
        order[id(each)] = turns[each.kind]
    kept = sorted(kept, key=lambda each: order[id(each)])[:SAMPLED]
    listed = [
        {"seed": each.seed, "scene": each.scene, "p": each.p,
         **{name: {k: float(f"{v:.7g}") for k, v in part.items()}
            for name, part in zip(("figures", "scales"), each.truth, strict=True)}}
        for each in kept
    ]  # fmt: skip
    text = ",\n".join(json.dumps(each) for each in listed)
    SAMPLE.write_text(f"[\n{text}\n]\n", encoding="utf-8")
    print(f"{len(listed)} scenes in {SAMPLE.name}")


def arguments() -> argparse.Namespace:
    """What is asked for."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.advice", description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)  # fmt: skip
    parser.add_argument("--scenes", type=int, default=60)
    parser.add_argument("--first", type=int, default=0, help="number of the first scene (0)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scene", type=int, nargs="+", help="only these, with what they are")
    parser.add_argument("--p", type=float, default=0.01, help="relative accuracy (0.01)")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--budget", type=float, default=BUDGET, help="CPU of a truth [s] (40)")
    parser.add_argument("--out", type=Path, help="file for the verdicts, a line of JSON each")
    parser.add_argument("--sample", action="store_true", help="the kept scenes alone")
    parser.add_argument("--renew", type=Path, nargs="+", help="write the kept scenes from --out")
    parser.add_argument("--worker", action="store_true", help=argparse.SUPPRESS)
    return parser.parse_args()


def main() -> None:
    """Measure and print."""
    asked = arguments()
    if asked.worker:
        work(asked)
    elif asked.sample:
        sys.exit(int(sample() > 0))
    elif asked.renew:
        renew(asked.renew)
    else:
        measure(asked)


def measure(asked: argparse.Namespace) -> None:
    """Many scenes."""
    numbers = asked.scene or range(asked.first, asked.first + asked.scenes)
    found = []
    with ThreadPoolExecutor(asked.jobs) as pool:
        tasks = [pool.submit(in_process, asked.seed, n, asked.p, asked.budget) for n in numbers]
        for task in tasks:
            found.append(task.result())
            print(line(found[-1]), flush=True)
            if asked.out:
                with asked.out.open("a", encoding="utf-8") as stream:
                    stream.write(json.dumps(asdict(found[-1])) + "\n")
            if asked.scene:
                print(described(scene(asked.seed, found[-1].scene)[1], Model(), asked.p))
    print(f"\np = {asked.p:g}, seed {asked.seed}")
    for way in WAYS:
        print("\n".join(report(found, way)))
    for each in found:
        if each.tried.off > 1:
            print(f"missed: python -m benchmarks.advice --seed {asked.seed} --scene {each.scene}"
                  f" --p {asked.p:g}   {each.tried.off:.3g}p in {each.tried.worst}")  # fmt: skip


if __name__ == "__main__":
    main()

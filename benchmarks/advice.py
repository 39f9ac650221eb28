"""Whether advice on cables holds: random scenes, solved as advised, as more than that, as less.

    python -m benchmarks.advice --scenes 60 --seed 1 [--p 0.001] [--jobs 2]
    python -m benchmarks.advice --seed 1 --scene 17             # one of them, with its description
    python -m benchmarks.advice --sample                        # the sample beside this file
    python -m benchmarks.advice --renew --seed 1                # write the sample anew

Truth is the model with sections doubled and ERROR a third, again and again, until all figures
stand still to p/10. Less is half the sections, the next lower level or form, and ten times ERROR.
A figure is the greatest, least or mean tension at either end of a span, as a share of the greatest
there, and the greatest, least or mean place of a weight, as a share of its way.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import re
import resource
import subprocess
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.rope_scenes import Table, scene, toml

#: CPU that a scene may use [s].
BUDGET = 90.0
#: Of p: a change of all figures that small is none.
STILL = 0.1
#: In p: what a truth may be off where it still tells whether a model is inside.
LARGEST_DOUBT = 0.5
MOST_SECTIONS = 900
#: Speeds below this share of gravity's, over the length of the cable, are round-off.
NOTHING = 1e-6
LOOSER = 10.0
#: Scenes that are solved again and again, with their truth; how many, of which CPU [s] at most, and
#: how far inside, in p: a change of the advice that leaves less is no mistake yet.
SAMPLE = Path(__file__).parent / "advice.json"
SAMPLED, SHORT, ROOM = 40, 0.2, 0.8
#: A run's CPU is not told from less [s].
CLOCK = 1e-3
#: ERROR of a truth, from one to the next.
FINER = 3.0


@dataclass(frozen=True)
class Model:
    """What a description asks for; level 0 is auto."""

    level: int = 0
    form: str = "auto"
    elements: int = 0
    error: float = 0.0


@dataclass(frozen=True)
class Solved:
    """Figures of a run by name, with their scales, and its CPU [s]; ``text`` of its deck."""

    figures: dict[str, float]
    scales: dict[str, float]
    cpu: float
    steps: int
    model: Model
    told: float = 0.0
    text: str = ""


@dataclass
class Verdict:
    """What became of a scene.

    off : error of the advised model in p;  less : of each cheaper one, with how much cheaper it is
    """

    seed: int
    scene: int
    kind: str
    advised: str = ""
    off: float = math.nan
    worst: str = ""
    doubt: float = math.nan
    cpu: float = 0.0
    told: float = 0.0
    less: dict[str, tuple[float, float]] = field(default_factory=dict)
    truth: list[dict[str, float]] = field(default_factory=list)
    why: str = ""
    warned: list[str] = field(default_factory=list)

    @property
    def is_known(self) -> bool:
        """Whether there is a truth that tells inside from outside."""
        if not self.doubt <= LARGEST_DOUBT:
            return False
        return self.doubt <= STILL or abs(self.off - 1) > self.doubt

    @property
    def is_least(self) -> bool:
        """Whether nothing that is cheaper by half does."""
        return all(off > 1 or gain < 2 for off, gain in self.less.values())


# ---- a run -----------------------------------------------------------------------------------


def described(table: Table, model: Model, p: float) -> str:
    """The text of a scene with a model."""
    wanted: dict[str, Any] = {"accuracy": p}
    if model.level:
        wanted["level"] = model.level
    if model.form != "auto":
        wanted["form"] = model.form
    if model.elements:
        wanted["elements"] = model.elements
    top = {"error": model.error} if model.error else {}
    return toml({**top, **table, "model": wanted})


def solve(table: Table, model: Model, p: float, method: str = "") -> Solved:
    """The scene by a model."""
    import adamslite
    from adamslite.cables.scene import deck

    asked = described(table, model, p)
    text, _ = deck(asked)
    if method:
        text = re.sub(r"(?m)^INTEGRATOR/[^\n]*(, ERROR=)", f"INTEGRATOR/{method}\\1", text)
    run = adamslite.simulate(adamslite.read(text))
    if run.outcome.name != "DONE":
        raise RuntimeError(f"{run.outcome.name}: {run.message}")
    figures, scales = figures_of(table, run)
    used = replace(model, **chosen(text))
    cpu = max(run.summary["solve_cpu_s"], CLOCK)
    return Solved(figures, scales, cpu, int(run.summary["steps"]), used, told(asked, p), text)


def told(text: str, p: float) -> float:
    """CPU [s] that the advice on a description tells."""
    from adamslite.cables.advice import advise
    from adamslite.cables.estimate import estimate_moves, laws
    from adamslite.cables.geometry import spans, turned
    from adamslite.cables.model_choice import demand_of
    from adamslite.cables.spec import read

    spec, faults = read(text)
    spec = turned(spec)
    pieces, prescribed = spans(spec, faults), laws(spec, faults)
    moves = estimate_moves(spec, pieces, prescribed)
    return advise(demand_of(spec, pieces, moves, prescribed), p).cost


def chosen(text: str) -> dict[str, Any]:
    """Level, form, sections and ERROR of a deck."""
    head = " ".join(text[: text.index("! Written")].replace("\n! ", " ").split())
    level = 3 if "Brute force:" in head else int(re.search(r"Level (\d):", head)[1])
    form = "brute" if "Brute force:" in head else "ale" if "form ale" in head else "auto"
    if "form paper" in head and level == 3:
        form = "paper"
    count = re.search(r"(\d+) sections?\b", head)
    error = re.search(r"INTEGRATOR/.*ERROR=([\d.eE+-]+)", text)
    return {"level": level, "form": form, "elements": int(count[1]) if count else 0,
            "error": float(error[1])}  # fmt: skip


def figures_of(table: Table, run: Any) -> tuple[dict[str, float], dict[str, float]]:
    """Greatest, least and mean of tensions and places, and the scale of each."""
    cable, route = table["cable"], table["route"]
    transit = length_of(table) * math.sqrt(cable["rho"] / cable["EA"])
    window = max(int(round(transit / 2 / (run.time[1] - run.time[0]))), 1)
    figures, scales = {}, {}

    def keep(name: str, values: np.ndarray, scale: float) -> None:
        for word in ("max", "min", "mean"):
            figures[f"{name} {word}"] = float(getattr(values, word)())
            scales[f"{name} {word}"] = scale

    for p in range(1, len(route)):
        for end in tensions(run, p):
            pull = smoothed(run[end] * (-1 if end.startswith("GCON") else 1), window)
            which = end[-1] if end.startswith("REQ") else "f"
            keep(f"T{p}.{which}", pull, float(np.abs(pull).max()))
    for i, each in enumerate(route):
        if each["kind"] == "mass":
            ways = [run[f"POINT_MASS/{10 * (i + 1)}.{a}"] for a in "XYZ"]
            moved = math.sqrt(sum((w - w[0]).max() ** 2 + (w - w[0]).min() ** 2 for w in ways))
            if moved > NOTHING * length_of(table):
                for a, w in zip("XYZ", ways, strict=True):
                    keep(f"{a}{i + 1}", w - w[0], moved)
    return figures, scales


def tensions(run: Any, p: int) -> list[str]:
    """Channels of the tension at both ends of span p."""
    names = set(run.names)
    found = [f"REQUEST/{p}.{f}" for f in ("F2", "F3")]
    found = [name for name in found if name in names and np.any(run[name])]
    return found or [name for name in (f"GCON/{p}.f",) if name in names]


def length_of(table: Table) -> float:
    """Of the longest span [m]."""
    places = [each["at"] for each in table["route"]]
    return max(math.dist(a, b) for a, b in zip(places, places[1:], strict=False))


def smoothed(values: np.ndarray, window: int) -> np.ndarray:
    """Moving mean: a front's overshoot in a chain of masses is none of the cable's."""
    if window < 2 or window >= len(values):
        return values
    return np.convolve(values, np.ones(window) / window, "valid")


def apart(one: Solved, truth: Solved, p: float) -> tuple[float, str]:
    """The largest difference of a figure in p, and its name."""
    worst, name = 0.0, ""
    for each, exact in truth.figures.items():
        found = match(one.figures, each)
        if found is None or not truth.scales[each]:
            continue
        off = abs(found - exact) / truth.scales[each] / p
        if not off <= worst:
            worst, name = off, each
    return worst, name


def match(figures: dict[str, float], name: str) -> float | None:
    """A figure of a model that may have one tension for both ends of a span."""
    both = re.sub(r"^(T\d+)\.\d", r"\1.f", name)
    return figures.get(name, figures.get(both))


# ---- a scene ---------------------------------------------------------------------------------


def judge(seed: int, number: int, p: float, budget: float) -> Iterator[Verdict]:
    """The verdict, again after each run that says more."""
    kind, table = scene(seed, number)
    yield from judged(table, Verdict(seed, number, kind), p, budget)


def judged(table: Table, found: Verdict, p: float, budget: float) -> Iterator[Verdict]:
    """The same of any description."""
    from adamslite.cables.scene import deck

    found.warned = [each.code for each in deck(described(table, Model(), p))[1]]
    advised = solve(table, Model(), p)
    again = solve(table, Model(), p)
    used = advised.model
    method = re.search(r"INTEGRATOR/(\w+)", advised.text)[1]
    found.advised = f"level {used.level} {used.form} {used.elements} {method} {used.error:.1E}"
    found.cpu, found.told = min(advised.cpu, again.cpu), advised.told
    found.why = "no truth in time"
    yield found
    truth = None
    for truth, doubt in truths(table, advised, p, budget):
        found.doubt, found.truth = doubt, [truth.figures, truth.scales]
        found.off, found.worst = apart(advised, truth, p)
        yield found
    if truth is None or not found.is_known:
        return
    found.why = ""
    for name, model in lesser(used).items():
        try:
            runs = [solve(table, model, p, method if model.level != 1 else "") for _ in range(2)]
        except Exception as fault:
            found.why = f"{name}: {' '.join(str(fault).split())[:100]}"
            continue
        cpu = min(each.cpu for each in runs)
        found.less[name] = (apart(runs[0], truth, p)[0], found.cpu / max(cpu, 1e-9))
        yield found
    yield found


def truths(
    table: Table, advised: Solved, p: float, budget: float
) -> Iterator[tuple[Solved, float]]:
    """Dearer and dearer models, each with how far it is from the one before, in p."""
    used = advised.model
    form = used.form if used.form == "brute" else "ale"
    level = {1: 3, 2: 2, 3: 3}[used.level]
    exact = Model(level, form if level == 3 else "auto", min(max(used.elements, 12), 450))
    exact = replace(exact, error=min(used.error, base_error(table, p, exact.elements)) / FINER)
    before: Solved | None = None
    begun = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    while True:
        try:
            run = solve(table, exact, p)
        except RuntimeError:
            run = None
        if run is not None:
            if before is not None:
                doubt = apart(before, run, p)[0]
                yield run, doubt
                if doubt <= STILL:
                    return
            before = run
        # Twice the sections and a quarter of ERROR: up to eight times the work.
        left = budget + begun - resource.getrusage(resource.RUSAGE_SELF).ru_utime
        if run is None or 6 * run.cpu > left or exact.elements >= MOST_SECTIONS:
            return
        count = min(2 * exact.elements, MOST_SECTIONS)
        exact = replace(exact, elements=count, error=exact.error / FINER)


def base_error(table: Table, p: float, sections: int) -> float:
    """p T H/EA of the lightest load."""
    cable = table["cable"]
    loads = [each["mass"] * 9.81 for each in table["route"] if each["kind"] == "mass"]
    pull = cable.get("pretension") or min(loads)
    return p * pull * length_of(table) / sections / cable["EA"] / 3


def lesser(used: Model) -> dict[str, Model]:
    """Models that are less than the advised one."""
    keep = replace(used, form=used.form if used.level == 3 else "auto")
    found = {"ERROR": replace(keep, error=keep.error * LOOSER)}
    if used.level == 1:
        found["ERROR"] = replace(found["ERROR"], elements=0)
    elif used.elements > 1:
        found["sections"] = replace(keep, elements=(used.elements + 1) // 2)
    if used.form == "ale":
        found["form"] = replace(keep, form="paper")
    elif used.level in (2, 3) and used.form != "brute":
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
    if not lines:
        why = (run.stderr.strip().splitlines() or ["no CPU left"])[-1]
        return Verdict(seed, number, scene(seed, number)[0], why=why[:200])
    said = json.loads(lines[-1])
    found = Verdict(**{**said, "less": {k: tuple(v) for k, v in said["less"].items()}})
    if run.returncode and not found.is_known:
        error = run.stderr.strip().splitlines()
        found.why = error[-1][:200] if error else "no truth in time"
    return found


def work(arguments: argparse.Namespace) -> None:
    """One scene: a line of JSON after each run."""
    limit = int(2 * arguments.budget + 30)
    resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
    for found in judge(arguments.seed, arguments.scene[0], arguments.p, arguments.budget):
        print(json.dumps(asdict(found)), flush=True)


def line(each: Verdict) -> str:
    """A scene in the listing."""
    less = ", ".join(f"{k} {off:.2g}p at 1/{gain:.2g}" for k, (off, gain) in each.less.items())
    ratio = each.told / each.cpu if each.cpu else math.nan
    return (
        f"{each.scene:4d} {each.kind:9} {each.advised:38} off {each.off:8.3g}p {each.worst:10} "
        f"cpu {each.cpu:.3g} told x{ratio:.2g}; {less}; {each.why} {' '.join(each.warned)}"
    )


def report(found: Sequence[Verdict], p: float) -> list[str]:
    """The shares."""
    known = [each for each in found if each.is_known]

    def share(count: int, of: int) -> str:
        return f"{count} of {of} ({100 * count / max(of, 1):.0f} %)"

    inside = [each for each in known if each.off <= 1]
    ratios = [each.told / each.cpu for each in found if each.cpu > 0 and each.told > 0]
    near = [r for r in ratios if 0.5 <= r <= 2]
    lines = [
        f"p = {p:g}: {len(found)} scenes, {len(known)} with a truth that stands still to p/10",
        f"inside p          {share(len(inside), len(known))}",
        f"inside 1.5 p      {share(sum(each.off <= 1.5 for each in known), len(known))}",
        f"nothing cheaper   {share(sum(each.is_least for each in inside), len(inside))}"
        " (outside p, or less than twice cheaper)",
        f"CPU told          {share(len(near), len(ratios))} within a factor 2",
    ]
    for name in ("sections", "form", "level", "ERROR"):
        tried = [each.less[name] for each in inside if name in each.less]
        good = sum(off > 1 or gain < 2 for off, gain in tried)
        lines.append(f"  less {name:9} {share(good, len(tried))}")
    return lines


# ---- the sample ------------------------------------------------------------------------------


def sample() -> int:
    """Solve the scenes of the sample as advised, and hold them against what is written there: how
    many are outside."""
    outside = 0
    for each in json.loads(SAMPLE.read_text(encoding="utf-8")):
        kind, table = scene(each["seed"], each["scene"])
        truth = Solved(each["figures"], each["scales"], 0.0, 0, Model())
        off, worst = apart(solve(table, Model(), each["p"]), truth, each["p"])
        outside += off > 1
        print(f"{each['seed']:4d} {each['scene']:4d} {kind:9} {off:8.3g}p {worst}", flush=True)
    print(f"{outside} outside the accuracy that was asked for")
    return outside


def renew(found: Sequence[Verdict], p: float) -> None:
    """Write the first scenes inside `p` with their truth."""
    kept = [each for each in found if each.is_known and each.off < ROOM and each.cpu < SHORT]
    listed = [
        {"seed": each.seed, "scene": each.scene, "p": p,
         **{name: {k: float(f"{v:.7g}") for k, v in part.items()}
            for name, part in zip(("figures", "scales"), each.truth, strict=True)}}
        for each in kept[:SAMPLED]
    ]  # fmt: skip
    text = ",\n".join(json.dumps(each) for each in listed)
    SAMPLE.write_text(f"[\n{text}\n]\n", encoding="utf-8")
    print(f"{len(listed)} scenes in {SAMPLE.name}")


def arguments() -> argparse.Namespace:
    """What is asked for."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.advice", description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)  # fmt: skip
    parser.add_argument("--scenes", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scene", type=int, nargs="+", help="only these, with what they are")
    parser.add_argument("--p", type=float, default=0.01, help="relative accuracy (0.01)")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--budget", type=float, default=BUDGET, help="CPU of a scene [s] (90)")
    parser.add_argument("--sample", action="store_true", help="the kept scenes alone")
    parser.add_argument("--renew", action="store_true", help="write the kept scenes")
    parser.add_argument("--worker", action="store_true", help=argparse.SUPPRESS)
    return parser.parse_args()


def main() -> None:
    """Measure and print."""
    asked = arguments()
    if asked.worker:
        work(asked)
        return
    if asked.sample:
        sys.exit(int(sample() > 0))
    numbers = asked.scene or range(asked.scenes)
    found = []
    with ThreadPoolExecutor(asked.jobs) as pool:
        tasks = [pool.submit(in_process, asked.seed, n, asked.p, asked.budget) for n in numbers]
        for task in tasks:
            found.append(task.result())
            print(line(found[-1]), flush=True)
            if asked.scene:
                print(described(scene(asked.seed, found[-1].scene)[1], Model(), asked.p))
    missed = [each for each in found if each.off > 1]
    print("\n".join(["", *report(found, asked.p)]))
    if asked.renew:
        renew(found, asked.p)
    for each in missed:
        print(f"missed: python -m benchmarks.advice --seed {asked.seed} --scene {each.scene}"
              f" --p {asked.p:g}   {each.off:.3g}p in {each.worst}")  # fmt: skip


if __name__ == "__main__":
    main()

"""Kill runs at random instants, resume them, compare their bytes with those of undisturbed runs.

    python tests/kills.py                     100 kills of each case of unfinished_scenes
    python tests/kills.py --kills 5 --jobs 4 --seed 3 --case RADAU --case VERLET

Instants are spread evenly over the time that a run takes, from the start of the process to its end,
so that some are before there is a file to go on with, which do not count, and some while results
are written, which those of long runs are from their start; every third kill is in the middle of a
write to the file of the run.  Resumed runs are killed again, of which some are killed again.  All
files that a run writes are compared with those that are written at its end.  A line for each case
says how many kills there were, and what was left; the exit code is 1 when bytes differed anywhere.
Sweeps and fits are killed and given again: at no instant is their file anything but whole, and no
process is left.
"""

from __future__ import annotations

import argparse
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from unfinished_runs import AT_ONCE, PATIENCE, command
from unfinished_scenes import CASES, SUFFIXES, pendulum, prepared, written

from adamslite import load_sweep

#: Where a kill met a run.
RUNNING, IN_WRITE, WRITING, EARLY, LATE = "running", "in state", "writing", "early", "late"
SHOWN = (RUNNING, IN_WRITE, WRITING, EARLY, LATE, "resumed", "again", "drafts", "wrong")
#: Share of the kills that are in a write to the file of the run; about so many writes a second.
IN_WRITES, WRITES = 0.3, 60.0
#: Workers of a command that was killed have ended after this time [s].
AFTERWARDS = 30.0


class Killing:
    """One case in a folder of its own; ``counts`` is what has happened."""

    def __init__(self, case: str, folder: Path, seed: int) -> None:
        self.folder, self.words = folder, CASES[case][1:]
        self.deck, self.chance = prepared(folder, case), random.Random(f"{case} {seed}")
        self.output = folder / f"out{SUFFIXES.get(case, '.csv')}"
        self.part = Path(f"{self.output}.part")
        self.counts: Counter[str] = Counter()
        self.read = set(self._contents())
        for _ in range(2):  # the second finds everything compiled
            began = time.monotonic()
            self._finished(self._at_once())
            self.takes = time.monotonic() - began
        self.whole = self._contents()

    def until(self, kills: int) -> Counter[str]:
        """Kill until so many have met a run that had something to go on with."""
        while self.counts[RUNNING] + self.counts[IN_WRITE] + self.counts[WRITING] < kills:
            self._once()
        return self.counts

    def _begun(self, at: int = 0) -> list[str]:
        return command(str(self.deck), "-o", str(self.output), *self.words, at=at)

    def _at_once(self) -> list[str]:
        words = ["solve", "--quiet", str(self.deck), "-o", str(self.output), *self.words]
        return [sys.executable, "-c", AT_ONCE, *words]

    def _gone_on(self, at: int = 0) -> list[str]:
        return command("--resume", str(self.part), at=at)

    def _contents(self) -> dict[str, bytes]:
        return {each.name: each.read_bytes() for each in self.folder.iterdir()}

    def _clear(self) -> None:
        for each in self.folder.iterdir():
            if each.name not in self.read:
                each.unlink()

    def _once(self) -> None:
        """One run from its start to its end, over one kill or some."""
        self._clear()
        self._kill(self._begun)
        while self.part.exists() and self.chance.random() < 0.6:
            self.counts["again"] += 1
            self._kill(self._gone_on)
        if self.part.exists():
            self.counts["resumed"] += 1
            self._finished(self._gone_on())
        elif not self.output.exists():
            return
        self._compare()

    def _compare(self) -> None:
        """Whether all files are those of a run that was not disturbed, but for drafts."""
        found = self._contents()
        left = [name for name in found if name not in self.whole]
        self.counts["drafts"] += len(left)
        drafts = all(name.startswith(".") and name.endswith(".part") for name in left)
        same = {name: found.get(name) for name in self.whole} == self.whole
        self.counts["wrong"] += not (same and drafts)

    def _kill(self, words: Callable[[int], Sequence[str]]) -> None:
        """Start a run and kill it at some time of it, or in some write to its file."""
        before = self.part.stat().st_mtime_ns if self.part.exists() else None
        inside, at, after = self.chance.random() < IN_WRITES, 0, PATIENCE
        if inside:
            at = self.chance.randrange(1, max(2, int(WRITES * self.takes)))
        else:
            after = self.chance.uniform(0.1 * self.takes, self.takes)
        code, error = self._ended(words(at), after)
        if code >= 0:
            if code:
                raise AssertionError(error)
            self.counts[LATE] += 1
        elif not self.part.exists() or self.part.stat().st_mtime_ns == before:
            self.counts[EARLY] += 1
        elif self.output.exists() or [*self.folder.glob(f".{self.output.name}.????????.part")]:
            self.counts[WRITING] += 1
        else:
            self.counts[IN_WRITE if inside else RUNNING] += 1

    def _ended(self, words: Sequence[str], after: float) -> tuple[int, str]:
        """Exit code and messages of a run that is killed after some time [s]."""
        process = subprocess.Popen(
            words, cwd=self.folder, text=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
        )
        try:
            error = process.communicate(timeout=after)[1]
        except subprocess.TimeoutExpired:
            process.kill()
            try:  # its messages end when its workers have ended
                error = process.communicate(timeout=AFTERWARDS)[1]
            except subprocess.TimeoutExpired:
                raise AssertionError("processes of a killed command go on") from None
        return process.returncode, error

    def _finished(self, words: Sequence[str]) -> None:
        done = subprocess.run(
            words, cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE
        )
        if done.returncode:
            raise AssertionError(done.stderr)


#: Commands that are simply given again, by the file that each writes: they take what there is from
#: it, or leave it alone until they have another one.  A program that writes a sweep every moment.
AGAIN = {
    "a sweep": (
        "out.nc",
        "sweep deck.adm PART/2.MASS=1:2:60 --workers 2 --quiet -o out.nc --measure",
        "max REQUEST/1.F2",
    ),
    "a fit": ("out.adm", "fit deck.adm measured.csv --by PART/2.MASS --quiet -o out.adm"),
}
OFTENER = """\
import sys
from adamslite.sweeps import sweep
sweep.INTERVAL, sweep.SHARE = 0.01, 1.0
from adamslite.__main__ import main
sys.exit(main())
"""


#: What is in the file of a deck before it is fitted.
EARLIER = b"an earlier deck\n"


class Repeating(Killing):
    """A command that is killed and given again until it comes to its end."""

    def __init__(self, case: str, folder: Path, seed: int) -> None:
        name, words, *more = AGAIN[case]
        self.folder, self.chance = folder, random.Random(f"{case} {seed}")
        self.words = [sys.executable, "-c", OFTENER, *words.split(), *more]
        self.output, self.counts = folder / name, Counter()
        measured = ["solve", "deck.adm", "--quiet", "-o", "measured.csv", "--set", "PART/2.MASS=2"]
        written(folder, pendulum(2, 50))
        self._finished([sys.executable, "-m", "adamslite", *measured])
        self.read = set(self._contents())
        for _ in range(2):
            self._clear()
            began = time.monotonic()
            self._finished(self.words)
            self.takes = time.monotonic() - began
        self.whole = self._contents()
        self.runs = load_sweep(self.output) if self.output.suffix == ".nc" else None

    def _once(self) -> None:
        """One file, over some kills; it is whole whatever happens, and loses nothing."""
        self._clear()
        if self.runs is None and self.chance.random() < 0.5:
            self.output.write_bytes(EARLIER)
        while self.chance.random() < 0.8:
            before = self._contents()
            drafts = self._drafts()
            after = self.chance.uniform(0.1 * self.takes, 1.05 * self.takes)
            code, error = self._ended(self.words, after)
            if code > 0:
                raise AssertionError(error)
            began = self.runs is None or self.output.exists()
            meets = WRITING if self._drafts() > drafts else RUNNING if began else EARLY
            self.counts[LATE if code == 0 else meets] += 1
            self.counts["wrong"] += not self._keeps(before)
        self.counts["resumed"] += 1
        self._finished(self.words)
        self._compare()

    def _drafts(self) -> int:
        return len([*self.folder.glob(".*.part")])

    def _keeps(self, before: dict[str, bytes]) -> bool:
        """Whether the file is what it was before, or what there will be; of a sweep, some runs with
        their numbers, no fewer than before, and nothing else is touched.
        """
        after, name = self._contents(), self.output.name
        if any(after.get(each) != before[each] for each in self.read):
            return False
        if self.runs is None:
            return after.get(name) in (before.get(name), self.whole[name])
        if name not in after:
            return name not in before
        found, done = load_sweep(self.output), self._done(before.get(name))
        there = [k for k, outcome in enumerate(found.outcomes) if outcome]
        same = (found.measures[there] == self.runs.measures[there]).all()
        return bool(same) and done <= set(there)

    def _done(self, content: bytes | None) -> set[int]:
        """The runs that are in a file of a sweep."""
        if content is None:
            return set()
        with tempfile.NamedTemporaryFile(suffix=".nc") as file:
            file.write(content)
            file.flush()
            return {k for k, outcome in enumerate(load_sweep(file.name).outcomes) if outcome}


def killed(case: str, kills: int, seed: int) -> Counter[str]:
    """So many kills of one case; what has happened."""
    kind = Repeating if case in AGAIN else Killing
    with tempfile.TemporaryDirectory() as folder:
        try:
            found = kind(case, Path(folder), seed).until(kills)
        except AssertionError as fault:
            sys.stderr.write(f"{case}: {fault}\n")
            found = Counter(wrong=1)
    numbers = "".join(f"{found[name]:9}" for name in SHOWN)
    sys.stdout.write(f"{case:32}{numbers}\n")
    sys.stdout.flush()
    return found


def main() -> int:
    """Read the arguments, kill, report."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=100, help="of each case")
    parser.add_argument("--jobs", type=int, default=1, help="cases at once")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument(
        "--case", action="append", choices=[*CASES, *AGAIN], help="this one; repeated: these"
    )
    args = parser.parse_args()
    heads = "".join(f"{name:>9}" for name in SHOWN)
    sys.stdout.write(f"{'case':32}{heads}\n")
    total: Counter[str] = Counter()
    with ThreadPoolExecutor(args.jobs) as pool:
        cases = args.case or [*CASES, *AGAIN]
        for found in pool.map(lambda case: killed(case, args.kills, args.seed), cases):
            total += found
    sys.stdout.write(f"{'all':32}{''.join(f'{total[name]:9}' for name in SHOWN)}\n")
    return 1 if total["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())

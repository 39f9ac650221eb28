"""Kill runs at random instants, resume them, compare their bytes with those of undisturbed runs.

    python tests/kills.py                     100 kills of each case of unfinished_scenes
    python tests/kills.py --kills 5 --jobs 4 --seed 3 --case RADAU --case VERLET

Instants are spread evenly over the time that a run takes, from the start of the process to its end,
so that some are before there is a file to go on with, which do not count, and some while results
are written.  Of the resumed runs every second one is killed, too.  A line for each case says how
many kills there were, and what was left; the exit code is 1 when bytes differed anywhere.
"""

from __future__ import annotations

import argparse
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from unfinished_runs import PATIENCE, command
from unfinished_scenes import CASES, SUFFIXES, written

#: Where a kill met a run.
EARLY, RUNNING, WRITING, LATE = "early", "running", "writing", "late"
SHOWN = (RUNNING, WRITING, EARLY, LATE, "resumed", "again", "drafts", "wrong")


class Killing:
    """One case in a folder of its own; ``counts`` is what has happened."""

    def __init__(self, case: str, folder: Path, seed: int) -> None:
        text, *self.words = CASES[case]
        self.deck, self.chance = written(folder, text), random.Random(f"{case} {seed}")
        self.suffix = SUFFIXES.get(case, ".csv")
        self.output = folder / f"killed{self.suffix}"
        self.part = Path(f"{self.output}.part")
        self.counts: Counter[str] = Counter()
        whole = folder / f"whole{self.suffix}"
        for _ in range(2):  # the second finds everything compiled
            began = time.monotonic()
            self._finished(command(str(self.deck), "-o", str(whole), *self.words))
            self.takes = time.monotonic() - began
        self.whole = whole.read_bytes()

    def until(self, kills: int) -> Counter[str]:
        """Kill until so many have met a run that had something to go on with."""
        while self.counts[RUNNING] + self.counts[WRITING] < kills:
            self._once()
        return self.counts

    def _once(self) -> None:
        """One run from its start to its end, over one kill or two."""
        self.output.unlink(missing_ok=True)
        self._kill(command(str(self.deck), "-o", str(self.output), *self.words))
        if self.part.exists() and self.chance.random() < 0.5:
            self.counts["again"] += 1
            self._kill(command("--resume", str(self.part)))
        if self.part.exists():
            self.counts["resumed"] += 1
            self._finished(command("--resume", str(self.part)))
        elif not self.output.exists():
            return
        self.counts["wrong"] += self.output.read_bytes() != self.whole or self.part.exists()
        known = {self.deck.name, self.output.name, f"whole{self.suffix}"}
        left = [each for each in self.deck.parent.iterdir() if each.name not in known]
        self.counts["drafts"] += len(left)
        for each in left:
            each.unlink()

    def _kill(self, words: Sequence[str]) -> None:
        """Start a run and kill it at some time of it."""
        process = subprocess.Popen(words, cwd=self.deck.parent, stderr=subprocess.PIPE)
        try:
            error = process.communicate(timeout=self.chance.uniform(0.0, self.takes))[1]
            if process.returncode:
                raise AssertionError(error.decode())
            self.counts[LATE] += 1
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            drafts = list(self.deck.parent.glob(f".{self.output.name}.*.part"))
            known = WRITING if drafts or self.output.exists() else RUNNING
            self.counts[known if self.part.exists() else EARLY] += 1

    def _finished(self, words: Sequence[str]) -> None:
        done = subprocess.run(
            words, cwd=self.deck.parent, capture_output=True, text=True, timeout=PATIENCE
        )
        if done.returncode:
            raise AssertionError(done.stderr)


def killed(case: str, kills: int, seed: int) -> Counter[str]:
    """So many kills of one case; what has happened."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            found = Killing(case, Path(folder), seed).until(kills)
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
    parser.add_argument("--case", action="append", choices=CASES, help="this one; repeated: these")
    args = parser.parse_args()
    heads = "".join(f"{name:>9}" for name in SHOWN)
    sys.stdout.write(f"{'case':32}{heads}\n")
    total: Counter[str] = Counter()
    with ThreadPoolExecutor(args.jobs) as pool:
        cases = args.case or list(CASES)
        for found in pool.map(lambda case: killed(case, args.kills, args.seed), cases):
            total += found
    sys.stdout.write(f"{'all':32}{''.join(f'{total[name]:9}' for name in SHOWN)}\n")
    return 1 if total["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())

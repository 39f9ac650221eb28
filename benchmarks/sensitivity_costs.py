"""What forward sensitivities cost: CPU of the native loop along the tape against that of the run.

`python -m benchmarks.sensitivity_costs [DECK ...] [--integrator RADAU]` prints a row for each deck:
the run without a tape in ms, and against it the loop with one number, and what each of two more
adds; medians of several, in turns.
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

import adamslite as al
from adamslite.analyses.dynamics.begun_again import Beginning
from adamslite.analyses.dynamics.dynamic import integrate, make_ready
from adamslite.results.outcomes import Outcome
from adamslite.sensitivity import taped
from adamslite.sensitivity.study import PLANAR, Study

DECKS = Path(__file__).parents[1] / "decks"
#: Decks with the ERROR of their runs, what to run of them, and numbers of each.
SCENES = {
    "hanging-mass/hanging-mass": (1e-7, {}, ()),
    "four-bar/four-bar": (1e-8, {}, ()),
    "andrews/andrews": (1e-6, {}, ()),
    "conical-pendulum/conical-pendulum": (1e-6, {}, ("PART/2.IP[2]",)),
    "heavy-top/heavy-top": (1e-6, {}, ()),
    "swinging-cable-n50/swinging-cable-n50": (1e-6, {}, ()),
    "cables/crane/free-trolley": (1e-7, {}, ()),
    "slider-crank/slider-crank": (1e-6, {}, ()),
    "car-axis/car-axis": (1e-6, {}, ()),
}
KINDS = ("MASS", "K", "IP[2]", "JGRAV", "KGRAV")
TIMES = 7


class Timed(taped.Taped):
    """A session whose run is carried out several times over, and its tape followed."""

    found: Any = None
    directions: Any = None
    count = 3

    def _taped(
        self, system: Any, times: Any, apart: float, beginning: Beginning, planar: bool
    ) -> Outcome:
        settings = self.chosen.settings

        def plain() -> None:
            make_ready(system, times, apart, settings)
            spent["run"].append(cpu(lambda: integrate(system, settings, None)))
            beginning.return_to()
            if planar:
                taped.reduce_to_plane(system)

        spent: dict[Any, list[float]] = {"run": [], 1: [], self.count: []}
        plain()
        spent["run"].clear()

        def follow(system: Any, method: str) -> None:
            found = self.directions(system, True, 0)
            for _ in range(TIMES):
                for number in (1, self.count):
                    lot = [found] * number
                    _NATIVE.clear()
                    along = taped.followed(system, method, lot)
                    spent[number].append(_NATIVE[0])
            self.found = (spent, int(system.tape.rows), along)

        for _ in range(TIMES):
            plain()
        self.follow = follow
        return super()._taped(system, times, apart, beginning, planar)


_NATIVE: list[float] = []


def cpu(work: Callable[[], Any]) -> float:
    """CPU that it takes [s]."""
    began = time.process_time()
    work()
    return time.process_time() - began


def watched(entry: str) -> Callable[..., Any]:
    """The native function of an entry, whose CPU is kept."""
    native = _FUNCTION(entry)

    def run(*given: Any) -> Any:
        code: list[Any] = []
        _NATIVE.append(cpu(lambda: code.append(native(*given))))
        return code[0]

    return run


_FUNCTION = taped._native


def number_of(deck: Any) -> str:
    """A number that a run hangs on."""
    values = [each for each in al.names(deck) if each.value]
    for kind in KINDS:
        for each in values:
            if each.name.endswith("." + kind):
                return str(each.name)
    raise SystemExit("no number")


def main() -> None:
    """A row for each deck."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("decks", nargs="*")
    parser.add_argument("--integrator", default="GSTIFF")
    args = parser.parse_args()
    warnings.simplefilter("ignore")
    taped._native = watched
    print("| deck | number | steps | run, ms | first | each further |\n|---|---|---|---|---|---|")
    for name, (error, run, by) in SCENES.items():
        if args.decks and not any(word in name for word in args.decks):
            continue
        deck = al.read(DECKS / f"{name}.adm")
        by = by or (number_of(deck),)
        study = Study(deck, (), {"error": error, "integrator": args.integrator, **run})
        session = study.session(Timed, study.kernels)
        session.directions, session.planar = study.directions(study.named(by)), PLANAR
        session.execute(study.plan)
        spent, steps, _ = session.found
        least = {k: median(v) for k, v in spent.items()}
        first = least[1] / least["run"]
        further = (least[Timed.count] - least[1]) / (Timed.count - 1) / least["run"]
        print(f"| {name} | {by[0]} | {steps} | {1e3 * least['run']:.2f} | {first:.2f} "
              f"| {further:.2f} |", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()

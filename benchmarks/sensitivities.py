"""Derivatives of reference decks by random numbers against tight differences of runs.

`python -m benchmarks.sensitivities [DECK ...]` prints a row for each deck and number: errors of
GSTIFF and RADAU.  An error is the largest of a column's history against the largest of its kind (x,
y, z; vx, vy, vz; ...) of its statement: the median over the columns that change, and the largest
one.  Angles where two of the three are one say nothing.
"""

from __future__ import annotations

import argparse
import random
import re
import time
import warnings
from pathlib import Path

import numpy as np

import adamslite as al
from adamslite.deck.deck import Deck
from adamslite.errors import UsageError
from adamslite.language.diagnostics import DeckError

DECKS = Path(__file__).parents[1] / "decks"
#: Small decks of every kind, with what to run of those that are long.
SCENES = {
    "hanging-mass/hanging-mass": {},
    "spring-pendulum/spring-pendulum": {"end": 2.0, "steps": 40},
    "pendulum-revolute/pendulum-revolute": {"end": 2.0, "steps": 40},
    "pendulum-gcon/pendulum-gcon": {"end": 1.0, "steps": 40},
    "conical-pendulum/conical-pendulum": {"end": 2.0, "steps": 40},
    "four-bar/four-bar": {"end": 0.5, "steps": 50},
    "slider-crank/slider-crank": {"end": 0.05, "steps": 25},
    "bricard/bricard": {"end": 0.5, "steps": 25},
    "growing-mass-spring/growing-mass-spring": {"end": 1.0, "steps": 50},
    "heavy-top/heavy-top": {"end": 0.5, "steps": 50},
    "atwood/atwood": {"end": 1.0, "steps": 20},
    "gear-pair/gear-pair": {"end": 1.0, "steps": 20},
    "screw-jack/screw-jack": {"end": 0.5, "steps": 20},
    "bushing/bushing": {"end": 0.5, "steps": 50},
    "beam-cantilever/beam-cantilever": {"end": 0.2, "steps": 20},
    "swinging-cable-n10/swinging-cable-n10": {"end": 0.5, "steps": 25},
    "car-axis/car-axis": {"end": 0.5, "steps": 25},
    "andrews/andrews": {"end": 0.01, "steps": 20},
    "sliding-mass/sliding-mass": {"end": 1.0, "steps": 20},
    "friction/friction": {"end": 1.0, "steps": 20},
    "contact/contact": {"end": 0.5, "steps": 50},
    "cam/cam": {"end": 0.5, "steps": 25},
    "shafts/shafts": {"end": 0.5, "steps": 25},
    "nforce/nforce": {"end": 0.5, "steps": 25},
    "gforce-pair/gforce-pair": {"end": 0.5, "steps": 25},
    "splines/splines": {"end": 0.5, "steps": 25},
    "three-joint-coupler/three-joint-coupler": {"end": 0.5, "steps": 25},
    "delayed-brake/delayed-brake": {"end": 0.5, "steps": 25},
    "arrays/arrays": {"end": 0.5, "steps": 25},
}
SHARE, TIGHT = 1e-4, 1e-11
KIND = re.compile(r"(psi|theta|phi|v?[xyz]|w[xyz]|a[xyz]|al[xyz]|f[xyz]|t[xyz])$")
KINDS = """PART POINT_MASS SPRINGDAMPER SFORCE VFORCE VTORQUE GFORCE BUSHING BEAM MARKER VARIABLE
ACCGRAV JOINT MOTION CONTACT NFORCE FIELD FRICTION DIFF SPLINE""".split()
NOTHING = "nothing changes"
CLASSES = {"psi": "angle", "theta": "angle", "phi": "angle"}


def deck_files(words: list[str]) -> list[tuple[Path, dict]]:
    """Files of the decks named, or of all."""
    found = []
    for name, run in SCENES.items():
        folder = DECKS / name.partition("/")[0]
        files = [DECKS / f"{name}.adm"] if (DECKS / f"{name}.adm").exists() else sorted(
            folder.glob("*.adm"))[:1]  # fmt: skip
        found += [(each, run) for each in files if not words or any(w in name for w in words)]
    return found


def groups_of(names: tuple[str, ...]) -> list[str]:
    """What each column is one of."""
    found = []
    for name in names:
        label, _, last = name.rpartition(".")
        kind = KIND.match(last)
        found.append(f"{label}.{CLASSES.get(last, last[:-1]) if kind else last}")
    return found


def differences(deck: Deck, name: str, value: float, run: dict, method: str) -> np.ndarray:
    """Slopes (nt, nc) by central differences of runs."""
    h, found = SHARE * (abs(value) or 1.0), {}
    for k in (-2, -1, 1, 2):
        found[k] = al.simulate(
            deck.with_values({name: value + k * h}), error=TIGHT, integrator=method,
            no_reduction=("plane", "fixed"), **run,
        )  # fmt: skip
    near, far = (found[k].values - found[-k].values for k in (1, 2))
    return (8.0 * near - far) / (12.0 * h)


def errors(
    deck: Deck, name: str, run: dict, integrator: str, error: float, slopes: np.ndarray
) -> tuple[float, float, str]:
    """Median and largest error, where."""
    made = al.sensitivities(deck, [name], error=error, integrator=integrator, **run)
    gap = np.abs(made.curves[0] - slopes).max(axis=0)
    kinds, size = groups_of(made.results.names), np.abs(slopes).max(axis=0)
    of_kind = {
        kind: max(s for s, k in zip(size, kinds, strict=True) if k == kind) for kind in kinds
    }
    values = np.abs(made.results.values).max(axis=0) / max(abs(made.at[0]), 1e-9)
    scale = np.array([of_kind[kind] for kind in kinds])
    told = scale > 1e-7 * values.max()
    if not told.any():
        return 0.0, 0.0, NOTHING
    share, names = gap[told] / scale[told], np.array(made.results.names)[told]
    return float(np.median(share)), float(share.max()), str(names[share.argmax()])


def choose(deck: Deck, some: random.Random) -> list[str]:
    """Numbers of statements that make a model."""
    own = (each for each in al.names(deck) if each.value != 0.0)
    names = [each.name for each in own if re.split("[/.]", each.name)[0] in KINDS]
    some.shuffle(names)
    return names


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("decks", nargs="*")
    parser.add_argument("--count", type=int, default=2)
    parser.add_argument("--error", type=float, default=1e-9)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    warnings.simplefilter("ignore")
    print("| deck | number | GSTIFF: median, largest | RADAU: median, largest |")
    print("|---|---|---|---|")
    for path, run in deck_files(args.decks):
        _rows(path, run, args)


def _rows(path: Path, run: dict, args: argparse.Namespace) -> None:
    try:
        deck = al.read(path)
    except DeckError as fault:
        print(f"| {path.stem} | {str(fault).splitlines()[0]} |")
        return
    some, done = random.Random(f"{args.seed}{path.stem}"), 0
    values = {each.name: each.value for each in al.names(deck)}
    for name in choose(deck, some)[:12]:
        if done >= args.count:
            return
        began = time.process_time()
        try:
            slopes = differences(deck, name, values[name], run, "RADAU")
            row = [errors(deck, name, run, m, args.error, slopes) for m in ("GSTIFF", "RADAU")]
        except (UsageError, DeckError, RuntimeError, ValueError) as fault:
            text = str(fault).splitlines()[0]
            print(f"| {path.stem} | {name} | {type(fault).__name__}: {text[:110]} | |", flush=True)
            continue
        done += row[0][2] != NOTHING
        texts = " | ".join(f"{a:.1e}, {b:.1e} ({where})" for a, b, where in row)
        print(f"| {path.stem} | {name} | {texts} | {time.process_time() - began:.1f} s", flush=True)


if __name__ == "__main__":
    main()

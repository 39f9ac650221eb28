"""Ours: descriptions for `adamslite cable`, solved as it advises, and decks of decks/published.

The second run counts: what is compiled is kept.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks import rope_cases as cases
from benchmarks.peers.program import Laps
from benchmarks.rope_cases import DECKS, LIGHT, LOWERED, MOORED, MOVED, SHAKEN, Answer, RopeRun


def described(rho: float) -> str:
    """The deck of the lowered weight on rope of `rho` [kg/m]."""
    from adamslite.cables.deck.scene import deck

    text = (DECKS / "lowered-weight" / "lowered-weight.toml").read_text(encoding="utf-8")
    if rho == cases.RHO:
        return deck(text)[0]
    return deck(text.replace("rho = 5.536", f"rho = {rho!r}") + "[model]\nlevel = 3\n")[0]


def lowered(scene: str) -> tuple[str, str]:
    """Deck and measure of the mean tension at the top."""
    a, b = cases.WINDOWS[scene]
    text = described(cases.RHO if scene == LOWERED else 1e-6)
    return text, f"mean REQUEST/1.F2 from {a} to {b}"


def written(name: str, measure: str) -> tuple[str, str]:
    """A deck of decks/published and a measure of its results."""
    return (DECKS / name).with_suffix(".adm").read_text(encoding="utf-8"), measure


def solve(prepare: Callable[[], tuple[str, str]], scale: float = 1.0) -> Answer:
    """Solve twice, and take the second; reading belongs to the set-up."""
    import adamslite as al
    from adamslite.verification.reference_file import parse_measure

    text, measure = prepare()
    for _ in range(2):
        laps = Laps()
        results = al.simulate(al.read(text))
        took, solved = laps.lap(), results.summary["solve_cpu_s"]
    value = parse_measure(f"{measure} = 0 tol abs 1").measured(results, "cubic")
    return Answer(float(value) * scale, took - solved, solved)


def shaken() -> Answer:
    """Largest difference of the lower end from the closed form, as a share of the stroke."""
    import adamslite as al

    chain = cases.shaken()
    text = (DECKS / "shaken-chain" / "shaken-chain.adm").read_text(encoding="utf-8")
    for _ in range(2):
        laps = Laps()
        results = al.simulate(al.read(text))
        took, solved = laps.lap(), results.summary["solve_cpu_s"]
    off = results["REQUEST/1.F2"] - chain["lower_end"](results.time)
    return Answer(float(np.abs(off).max() / chain["STROKE"]), took - solved, solved)


def runs() -> list[RopeRun]:
    """One of each scene."""
    chain = partial(written, str(Path("mooring", "two-hundred")), "last VARIABLE/fairlead")
    surge = partial(
        written, str(Path("moved-jumper", "surge")), f"max REQUEST/1.F3 from {cases.MOVED_FROM:g}"
    )
    return [
        RopeRun(
            LOWERED, "adamslite", "as `cable` advises", partial(solve, partial(lowered, LOWERED))
        ),
        RopeRun(
            LIGHT, "adamslite", "level 3, one section", partial(solve, partial(lowered, LIGHT))
        ),
        RopeRun(MOORED, "adamslite", "76 sections", partial(solve, chain, 1e-3)),
        RopeRun(SHAKEN, "adamslite", "100 links, RADAU", shaken),
        RopeRun(MOVED, "adamslite", "68 sections", partial(solve, surge, 1e-3)),
    ]

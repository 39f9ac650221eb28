"""The references of `deck-sheaves` and `deck-kink`: an arrestment over deck sheaves."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from formulas import Cable, Impact  # noqa: E402

IMPACT = Impact(Cable(38e6, 5.6, 12e3), 69.4)
HALF_SPAN, BELOW, HOOK = 15.25, 40.0, 23600.0
SHARE = "rel 1e-2"


def measures(title: str, lines: list[tuple[str, float, str]]) -> str:
    """Return a reference of measures: what is measured, its value, its tolerance."""
    rows = [f"# measure: {what} = {value:.9g} tol {within}\n" for what, value, within in lines]
    return f"# {title}: README.md\n# written by describe.py\n" + "".join(rows)


def deck_sheaves() -> str:
    """Fronts T1 at l/c, twice their jump at the engine, speed of the sheave, loss of the hook.

    Feed over a sheave u/(1 + e1); velocity of the hook V - 2 T1 sin(gamma) t/M.
    """
    cable, t0, t1 = IMPACT.cable, IMPACT.cable.pretension, IMPACT.tension
    at_sheave, at_engine = HALF_SPAN / cable.speed, (HALF_SPAN + BELOW) / cable.speed
    half, engine = (t0 + t1) / 2, 2 * t1 - t0
    feed = IMPACT.inflow / (1 + IMPACT.strain)
    loss = 2 * t1 * IMPACT.sine * 0.03 / HOOK
    lines = [
        ("mean REQUEST/3.F2 from 0.008 to 0.02", t1, SHARE),
        ("mean REQUEST/4.F2 from 0.008 to 0.02", t1, SHARE),
        ("value REQUEST/4.F2 at 0.02", t1, SHARE),
        ("mean REQUEST/40.F3 from 0.008 to 0.02", -feed, SHARE),
        (f"arrival REQUEST/3.F2 through {half:.9g} from 0.003", at_sheave, "rel 3e-2"),
        (f"arrival REQUEST/4.F3 through {t1:.9g} from 0.015", at_engine, SHARE),
        ("mean REQUEST/4.F3 from 0.024 to 0.03", engine, SHARE),
        ("mean REQUEST/1.F2 from 0.024 to 0.03", engine, SHARE),
        ("last POINT_MASS/30.vy", IMPACT.speed - loss, f"abs {2e-2 * loss:.2g}"),
    ]
    return measures("Axial fronts at the sheaves and the engines", lines)


def deck_kink() -> str:
    """T1, arrival of the kink, T2 and raw peak at a sheave that feeds from a long run."""
    t1, t2, come = IMPACT.tension, IMPACT.free_running, HALF_SPAN / IMPACT.kink
    echo = 2 * HALF_SPAN / IMPACT.cable.speed
    times = (0.3 * come, 0.9 * come, come + 0.35 * echo, come + 0.95 * echo)
    a, b, c, d = (f"{round(time, 4):g}" for time in times)
    lines = [
        (f"mean REQUEST/1.F2 from {a} to {b}", t1, SHARE),
        (f"arrival REQUEST/1.F2 through {(t1 + t2) / 2:.9g} from {a}", come, SHARE),
        (f"mean REQUEST/1.F2 from {c} to {d}", t2, SHARE),
        ("max REQUEST/1.F2", IMPACT.raw_peak, SHARE),
    ]
    return measures("The kink at the deck sheave", lines)

"""Scenes of ropes with closed forms, which programs for mooring and for reeving solve as well.

LOWERED, LIGHT : 1000 kg on 20 m of rope, which a winch pays out up to 20 m/s within 4 s:
    T = (M + rho l)(g - S") at the top, by the momentum of rope and weight; its mean over WINDOWS.
    LIGHT has a rope without mass, the mean while the winch accelerates, and S + l T/EA for S.
MOORED : 760 m of chain from a fairlead to an anchor 700 m away on the bed 200 m below; elastic
    catenary and rigid bed: tension at the fairlead.
SHAKEN : 10 m of chain whose upper end is moved sideways: way of the lower end by Bernoulli's modes;
    the largest difference within 10 s, as a share of the stroke.
MOVED : surge of decks/published/moved-jumper, where the value is read from a published curve.
"""

from __future__ import annotations

import runpy
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

DECKS = Path(__file__).resolve().parent.parent / "decks" / "published"
LOWERED, LIGHT, MOORED, SHAKEN, MOVED = "lowered", "light", "moored", "shaken", "moved"
TITLES = {
    LOWERED: "weight lowered at 20 m/s: mean tension at the top from 4.2 to 5 s [N]",
    LIGHT: "the same without mass of the rope: mean tension from 1 to 2 s [N]",
    MOORED: "chain on a sea bed: tension at the fairlead [kN]",
    SHAKEN: "chain whose upper end is shaken: error of the lower end / stroke",
    MOVED: "jumper in water whose upper end surges: greatest pull [kN]",
}
G, WEIGHT, RHO, EA, START, END = 9.81, 1000.0, 5.536, 60e6, 20.0, 5.0
WINDOWS = {LOWERED: (4.2, 5.0), LIGHT: (1.0, 2.0)}
#: Of the chain on the bed: its axis is half a diameter above it.
CHAIN, DIAMETER, CHAIN_EA, WATER, CHAIN_G = 390.0, 0.252, 1.674e9, 1025.0, 9.8
CHAIN_LENGTH, AWAY, DEPTH = 760.0, 700.0, 200.0 - DIAMETER / 2

#: Of the jumper: end of the run [s], begin of what is compared, and what was published [kN].
MOVED_END, MOVED_FROM, PUBLISHED = 81.0, 54.0, 52.23946


@dataclass(frozen=True)
class Answer:
    """What a program gives: the value of the scene, CPU [s] of set-up and of the solution."""

    value: float
    setup: float
    solve: float


@dataclass(frozen=True)
class RopeRun:
    """A program at one setting; `package` is its distribution, ``solve`` imports it."""

    scene: str
    package: str
    setting: str
    solve: Callable[[], Answer]


def payout(t: float) -> tuple[float, float]:
    """Length [m] that the winch has paid out at `t`, and its rate."""
    if t > 4:
        return 40 + 20 * (t - 4), 20.0
    u = t / 4
    return 80 * (2.5 * u**4 - 3 * u**5 + u**6), 20 * (10 * u**3 - 15 * u**4 + 6 * u**5)


def surge(t: float) -> float:
    """Place [m] of the upper end of the jumper: 10 m to both sides, growing for one period."""
    u = min(t / 27, 1.0)
    return 10 * np.sin(2 * np.pi * t / 27) * u**3 * (10 - 15 * u + 6 * u**2)


def closed_form(scene: str) -> float:
    """The value of a scene, without a program."""
    if scene in (SHAKEN, MOVED):
        return 0.0 if scene == SHAKEN else PUBLISHED
    if scene == MOORED:
        exact, line = mooring()["exact"], mooring()["catenary"].Cable
        weight = (CHAIN - WATER * np.pi / 4 * DIAMETER**2) * CHAIN_G
        return exact(line(weight, CHAIN, CHAIN_EA, CHAIN_LENGTH), AWAY, DEPTH)[0] / 1e3
    a, b = WINDOWS[scene]
    rho = RHO if scene == LOWERED else 0.0
    t = np.linspace(a, b, 10001)
    lengths = np.array([START + payout(x)[0] for x in t])
    rates = np.array([payout(x)[1] for x in t])
    gain = np.gradient(rates, t, edge_order=2)
    if scene == LIGHT:
        stretch = lengths * WEIGHT * (G - gain) / EA
        gain += np.gradient(np.gradient(stretch, t, edge_order=2), t, edge_order=2)
    return float(np.trapezoid((WEIGHT + rho * lengths) * (G - gain), t) / (b - a))


def mooring() -> dict[str, Any]:
    """The generator of the deck of the chain on the bed, which writes nothing here."""
    return runpy.run_path(str(DECKS / "mooring" / "make_reference.py"))


def shaken() -> dict[str, Any]:
    """The generator of the deck of the shaken chain."""
    return runpy.run_path(str(DECKS / "shaken-chain" / "make_reference.py"))

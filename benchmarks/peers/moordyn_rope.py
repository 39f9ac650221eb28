"""MoorDyn: explicit lumped mass lines; the length of a line is set before every step.

Its manual recommends damping near the critical one of a segment (-0.8): such a damper acts on the
rate of the stretched length, from which the payout rate is not subtracted. Without damping the
payout is right. The axis of a point is z upwards, and everything here is below the water.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import rope_cases as cases
from benchmarks.peers.program import Laps
from benchmarks.rope_cases import LOWERED, MOORED, MOVED, SHAKEN, Answer, RopeRun

INPUT = """MoorDyn
---------------------- LINE TYPES -----------------------------------
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
rope {diameter} {rho} {stiffness} {damping} {bending} {drag} {added} 0 0
---------------------- POINTS ---------------------------------------
ID Attachment X Y Z M V CdA CA
(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Coupled 0 0 {top} 0 0 0 0
2 {kind} {x} 0 {z} {mass} 0 0 0
---------------------- LINES ----------------------------------------
ID LineType AttachA AttachB UnstrLen NumSegs LineOutputs
(#) (name) (#) (#) (m) (-) (-)
1 rope 2 1 {length} {segments} -
---------------------- OPTIONS --------------------------------------
0 writeLog
{step} dtM
{scheme} tScheme
{gravity} g
{water} rho
{depth} WtrDpth
3e6 kBot
3e5 cBot
{settle_step} dtIC
{settle} TmaxIC
1e-5 threshIC
"""


@cache
def references_to_none() -> list[None]:
    """Functions of the bindings (2.7) return None without a reference of its own, which Python
    before 3.12 counts: this many calls are paid for.
    """
    return [None] * 4_000_000


@contextmanager
def line_at_rest(**given: Any) -> Iterator[Any]:
    """The program with this line, which writes a file while it runs. The upper end is at x = 0."""
    import moordyn

    references_to_none()
    filled = {"diameter": 0.03, "water": 0, "gravity": cases.G, "depth": 1000, "mass": 0, "x": 0}
    filled |= {"kind": "Free", "top": -10.0, "settle": 20, "settle_step": 0.1}
    filled |= {"bending": 0, "drag": 0, "added": 0, "scheme": "RK4"}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "line.txt"
        path.write_text(INPUT.format(**filled | given))
        system = moordyn.Create(str(path))
        moordyn.SetVerbosity(system, moordyn.LEVEL_ERR)
        moordyn.Init(system, [0.0, 0.0, given.get("top", filled["top"])], [0.0, 0.0, 0.0])
        yield system


def lowered(segments: int, damping: float, step: float = 1e-4, every: float = 1e-3) -> Answer:
    """Mean of the force at the winch; `every` is the time [s] between two lengths."""
    import moordyn

    laps = Laps()
    with line_at_rest(
        rho=cases.RHO, stiffness=cases.EA, damping=damping, length=cases.START, mass=cases.WEIGHT,
        segments=segments, z=-10 - cases.START, step=step,
    ) as system:  # fmt: skip
        line, setup = moordyn.GetLine(system, 1), laps.lap()
        a, b = cases.WINDOWS[LOWERED]
        pulls = []
        for t in np.arange(round(b / every)) * every:
            length, rate = cases.payout(t)
            moordyn.SetLineUnstretchedLength(line, cases.START + length)
            moordyn.SetLineUnstretchedLengthVel(line, rate)
            force = moordyn.Step(system, [0.0, 0.0, -10.0], [0.0, 0.0, 0.0], t, every)
            pulls += [-force[2]] if t > a - 1.5 * every else []
        return Answer(float(np.mean(pulls)), setup, laps.lap())


def moored(segments: int, step: float) -> Answer:
    """Force at the fairlead [kN] behind dynamic relaxation, half a segment's weight included."""
    import moordyn

    laps = Laps()
    with line_at_rest(
        rho=cases.CHAIN, stiffness=cases.CHAIN_EA, damping=-0.8, length=cases.CHAIN_LENGTH,
        diameter=cases.DIAMETER, water=cases.WATER, gravity=cases.CHAIN_G, kind="Fixed", top=0.0,
        segments=segments, x=cases.AWAY, z=-cases.DEPTH, depth=cases.DEPTH, step=step,
        settle=400, settle_step=1,
    ) as system:  # fmt: skip
        setup = laps.lap()
        force = moordyn.Step(system, [0.0] * 3, [0.0] * 3, 0.0, step)
        return Answer(float(np.linalg.norm(force)) / 1e3, setup, laps.lap())


def shaken(segments: int, step: float, every: float = 2e-3) -> Answer:
    """Largest difference of the lower end from the closed form, as a share of the stroke."""
    import moordyn

    chain = cases.shaken()
    stroke, turn = chain["STROKE"], chain["RATE"]
    laps = Laps()
    times = np.arange(1, round(chain["END"] / every) + 1) * every
    swing = 1 - np.cos(turn * (times - every))
    places = stroke / 4 * swing**2
    rates = stroke / 2 * turn * swing * np.sin(turn * (times - every))
    with line_at_rest(
        rho=chain["MASS"], stiffness=chain["EA"], damping=-0.8, length=chain["LENGTH"],
        segments=segments, z=-10 - chain["LENGTH"], step=step,
    ) as system:  # fmt: skip
        point, setup = moordyn.GetPoint(system, 2), laps.lap()
        way = []
        for t, x, v in zip(times - every, places, rates, strict=True):
            moordyn.Step(system, [x, 0.0, -10.0], [v, 0.0, 0.0], t, every)
            way.append(moordyn.GetPointPos(point)[0])
    solve = laps.lap()
    return Answer(float(np.abs(way - chain["lower_end"](times)).max() / stroke), setup, solve)


def moved(every: float = 5e-3) -> Answer:
    """Greatest pull at the top [kN]; scheme, steps, segments and damping are those of its tests."""
    import moordyn

    laps = Laps()
    with line_at_rest(
        rho=165, stiffness=5e8, damping=-0.5, bending=120.8e3, drag=1, added=1, diameter=0.396,
        length=170, segments=68, x=-100, z=-55, top=-5.0, kind="Fixed", water=1000, depth=100,
        gravity=9.807, scheme="midpoint5", step=1e-3, settle=30, settle_step=1,
    ) as system:  # fmt: skip
        line, setup = moordyn.GetLine(system, 1), laps.lap()
        times = np.arange(round(cases.MOVED_END / every)) * every
        places = [cases.surge(t) for t in [*times, times[-1] + every]]
        pulls = []
        for k, t in enumerate(times):
            rate = (places[k + 1] - places[k]) / every
            moordyn.Step(system, [places[k], 0.0, -5.0], [rate, 0.0, 0.0], t, every)
            if t > cases.MOVED_FROM:
                pulls.append(np.linalg.norm(moordyn.GetLineNodeForce(line, 68)))
        return Answer(float(max(pulls)) / 1e3, setup, laps.lap())


def runs() -> list[RopeRun]:
    """From cheap to dear."""
    made: list[tuple[str, str, Callable[[], Answer]]] = [
        (LOWERED, "10 segments, damping 0.8 as recommended", partial(lowered, 10, -0.8)),
        (LOWERED, "1 segment, no damping", partial(lowered, 1, 0)),
        (LOWERED, "10 segments, no damping", partial(lowered, 10, 0)),
        (MOORED, "20 segments", partial(moored, 20, 1e-3)),
        (MOORED, "76 segments", partial(moored, 76, 5e-4)),
        (SHAKEN, "25 segments", partial(shaken, 25, 1e-4)),
        (SHAKEN, "50 segments", partial(shaken, 50, 5e-5)),
        (MOVED, "68 segments, as its tests", moved),
    ]
    return [RopeRun(scene, "moordyn", setting, solve) for scene, setting, solve in made]

"""Random trees and loops of all joints and primitives against equations written apart from the
program: positions to 1e-7, reactions and torques to 1e-6.

Markers are oblique and given by REULER, ZP/XP, USEXP, ZG/XG; inertias are full; MOTIONs prescribe
displacements and velocities; units are metric, imperial and none.
"""

from __future__ import annotations

import numpy as np
import pytest
from frame_constraints import GEARS, JOINTS, PRIMITIVES, about
from newton_euler import Frame, Tie
from random_mechanisms import SYSTEMS, leaves, make, text
from scenes import compiled
from tiers import fast

import adamslite as al
from adamslite.results.outcomes import Outcome

END, STEPS = 0.25, 5
METHODS = ("ABAM, ERROR=1E-11", "RADAU, ERROR=1E-10")


def attitude(results: al.Results, part: str, row: int) -> np.ndarray:
    """Axes of the marker at the centre of mass of a part, from its 3-1-3 angles."""
    a, b, c = (results[f"{part}.{name}"][row] for name in ("psi", "theta", "phi"))
    return about(2, a) @ about(0, b) @ about(2, c)


@pytest.mark.parametrize("seed", fast(range(60), *range(14, 40, 9)))
def test_motion_and_reactions_of_a_random_mechanism(seed: int) -> None:
    made = make(seed)
    assembly, length = made.assembly, made.length
    results = al.simulate(compiled(text(made, END, STEPS, METHODS[seed % 2])))
    assert results.outcome is Outcome.DONE, results.message
    if not leaves(made):
        assert "assembled" not in results.meta and "start speeds" not in results.meta
    assert "redundant" not in results.meta
    states = assembly.run(made.start, results.time)
    weight = sum(body.mass for body in made.bodies) * 9.81 * length / assembly.ucf
    scale = {False: weight, True: weight * length}
    expected = [assembly.reactions(s, t) for s, t in zip(states, results.time, strict=True)]
    for wrench in (w for row in expected for w in row.values()):
        scale[False] = max(scale[False], np.abs(wrench[:3]).max())
        scale[True] = max(scale[True], np.abs(wrench[3:]).max())
    for row, state in enumerate(states):
        for b in range(len(made.bodies)):
            part = f"PART/{b + 2}"
            place = [results[f"{part}.{axis}"][row] for axis in "xyz"]
            assert place == pytest.approx(state.r[b], abs=1e-7 * length)
            centre = state.rotation[b] @ made.centres[b]
            assert attitude(results, part, row) == pytest.approx(centre, abs=1e-7)
        for tie in made.ties:
            got = [
                results[f"{tie.name}.{name}"][row] for name in ("fx", "fy", "fz", "tx", "ty", "tz")
            ]
            assert got[:3] == pytest.approx(expected[row][tie.name][:3], abs=1e-6 * scale[False])
            assert got[3:] == pytest.approx(expected[row][tie.name][3:], abs=1e-6 * scale[True])


@pytest.mark.slow
def test_the_sixty_mechanisms_hold_every_kind() -> None:
    lines = [line for seed in range(60) for line in make(seed).lines]
    kinds = {line.split(", ")[1] for line in lines}
    assert {*JOINTS, *PRIMITIVES, *GEARS} <= kinds
    told = " ".join(lines)
    assert all(word in told for word in ("ROTATION", "TRANSLATION", " X,", "B1", "VELOCITY"))
    assert {make(seed).system for seed in range(60)} == set(SYSTEMS)


def test_rows_of_the_reference_agree_with_differences() -> None:
    """The rates that jets carry, against central differences of positions on a moving path."""
    made = next(m for m in map(make, range(60)) if len(m.bodies) > 2 and len(m.ties) > 2)
    assembly = made.assembly
    times = np.linspace(0.0, 2e-3, 3)
    before, now, after = assembly.run(made.start, times)
    for tie in made.ties:
        if tie.of_rate:
            continue
        free = Tie(tie.name, tie.i, Frame(-1, np.array([0.1, 0.2, 0.3]), about(0, 0.4)), tie.rows)
        rows = [
            assembly.rows(s, t, [free]) for s, t in zip((before, now, after), times, strict=True)
        ]
        for a, b, c in zip(*rows, strict=True):
            rate = (float(c.value) - float(a.value)) / 2e-3
            assert float(b.rate) == pytest.approx(rate, rel=1e-4, abs=1e-4 * made.length)

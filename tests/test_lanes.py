"""VERLET takes the loads of bodies that stand behind each other several at once, by component."""

from __future__ import annotations

import itertools
import random

import numpy as np
import pytest

from adamslite import assemble, compile_model, read, simulate
from adamslite.equations import system as equations
from adamslite.equations.lanes import runs
from adamslite.equations.system import System

HEAD = """Masses, springs and dampers
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
MARKER/9000, PART=1, QP=0.3,0.2,0.1
VARIABLE/1, FUNCTION=COS(2*TIME)
VARIABLE/2, FUNCTION=1+TIME
"""


def mass(i: int, x: float, y: float = 0.0) -> str:
    """One that differs from the others in mass and speed."""
    return (
        f"POINT_MASS/{i}, MASS={1 + 0.1 * (i % 7)}, CM={i}, QG={x},{y},0, VZ={0.1 * (i % 5)}\n"
        f"MARKER/{i}, POINT_MASS={i}\n"
    )


def spring(s: int, i: int, j: int) -> str:
    """One that differs from the others in stiffness."""
    law = f"-{1000 + 50 * (s % 11)}*(DM({i},{j})-0.9)-2*VR({i},{j})"
    return f"SFORCE/{s}, TRANSLATIONAL, I={i}, J={j}, FUNCTION={law}\n"


def drag(i: int, variable: int = 1) -> str:
    """Air that resists, a wind that changes with time."""
    return (
        f"MARKER/{i + 5000}, PART=1, FLOATING\n"
        f"VFORCE/{i}, I={i}, JFLOAT={i + 5000}, FX=-0.3*VX({i})*VM({i})\\\n"
        f", FY=SIN(3*TIME)-0.1*VY({i})\\ FZ=VARVAL({variable})*DZ({i},9000)\n"
    )


def chain(n: int) -> str:
    """n masses, the first at the ground."""
    masses = "".join(mass(i, i - 1) for i in range(2, n + 2))
    return HEAD + masses + "".join(spring(i, i, i - 1) for i in range(2, n + 2))


def net(n: int) -> str:
    """n by n masses, the first column at the ground; the springs as they come, mass by mass."""
    at = {(r, c): 2 + r * n + c for r in range(n) for c in range(n)}
    pairs = []
    for (r, c), i in at.items():
        pairs += [(i, at[r, c - 1] if c else 9000)] + ([(i, at[r - 1, c])] if r else [])
    masses = "".join(mass(i, c + 1, r) for (r, c), i in at.items())
    return HEAD + masses + "".join(spring(s, i, j) for s, (i, j) in enumerate(pairs, 1))


def shuffled(n: int) -> str:
    """The chain with its springs in an order of chance."""
    springs = [spring(i, i, i - 1) for i in range(2, n + 2)]
    random.Random(3).shuffle(springs)
    return HEAD + "".join(mass(i, i - 1) for i in range(2, n + 2)) + "".join(springs)


def windy(n: int) -> str:
    """The chain in air."""
    return chain(n) + "".join(drag(i) for i in range(2, n + 2))


def in_turns(n: int) -> str:
    """... with another VARIABLE at every second mass."""
    return chain(n) + "".join(drag(i, 1 + i % 2) for i in range(2, n + 2))


def stopped(n: int) -> str:
    """The chain on a floor that changes its force where it begins."""
    floor = (f"SFORCE/{i + 300}, TRANSLATIONAL, I={i}, J=9000" for i in range(2, n + 2))
    laws = (f", FUNCTION=100*MAX(0,1-DM({i},9000))\n" for i in range(2, n + 2))
    return chain(n) + "".join(map("".join, zip(floor, laws, strict=True)))


SCENES = {
    "chain": chain(20), "two blocks": chain(300), "one more than lanes": chain(33),
    "net": net(9), "shuffled": shuffled(20), "wind": windy(20),
}  # fmt: skip


def count(text: str) -> int | None:
    """Runs of a deck."""
    system = System(compile_model(assemble(read(text + "END\n"))), False)
    found = runs(system.instances)
    return found and len(found.rows)


@pytest.mark.parametrize(
    ("text", "number"),
    [
        (chain(20), 2),  # the first spring has another shape: it hangs on the ground
        (shuffled(20), 2),
        (windy(20), 3),
        (net(9), 19),  # rows, all columns together, and each of those that hold the net
        (in_turns(20), None),
        (stopped(20), None),
        (chain(1), None),
    ],
)
def test_instances_whose_bodies_follow_each_other_are_a_run(text, number):
    assert count(text) == number


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("settings", ["ERROR=1E-3", "ERROR=1E-5", "HINIT=0.004"])
def test_the_motion_is_the_same_but_for_round_off(scene, settings, monkeypatch):
    """Round-off of 1e-16 grows with the motion, which is chaotic in the net."""
    kernels = compile_model(assemble(read(f"{SCENES[scene]}INTEGRATOR/VERLET, {settings}\nEND\n")))
    fast = simulate(kernels, end=0.5, steps=10)
    monkeypatch.setattr(equations, "runs", lambda instances: None)
    slow = simulate(kernels, end=0.5, steps=10)
    assert fast.summary["steps"] == slow.summary["steps"] > 0
    np.testing.assert_allclose(fast.values, slow.values, rtol=1e-8, atol=1e-8)


def test_an_energy_balance_sees_every_step(monkeypatch):
    """An audit reads the workspace, which runs do not write: it takes the other way."""
    found = simulate(read(chain(20) + "END\n"), 1.0, 10, "VERLET", error=1e-4, audit=True)
    assert found.balances[0].closes


def test_what_has_no_value_is_seen():
    """Two masses at one place: the direction between them is 0/0."""
    text = chain(20).replace("QG=2,", "QG=1,")
    found = simulate(read(text + "END\n"), end=1.0, steps=10, integrator="VERLET")
    assert found.outcome.name == "NOT_FINITE"


def test_a_session_goes_on_with_another_method():
    """Places and velocities are where every method looks for them."""
    one = "SIMULATE/DYNAMICS, END=0.3, STEPS=3\nINTEGRATOR/{}, ERROR=1E-6\n"
    two = "SIMULATE/DYNAMICS, END=0.6, STEPS=3\nEND\n"
    found = [
        simulate(read(chain(20) + "INTEGRATOR/VERLET, ERROR=1E-6\n" + one.format(other) + two))
        for other in ("ABAM", "VERLET")
    ]
    for a, b in itertools.pairwise(found):
        np.testing.assert_allclose(a["POINT_MASS/21.y"], b["POINT_MASS/21.y"], atol=1e-3)

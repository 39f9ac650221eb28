"""What does not depend on the numbers of a deck is made once for all runs of its kernels."""

import numpy as np

import adamslite as al
from adamslite.equations.elimination import Elimination

CHAIN = """three bars on hinges, drawn in the plane
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
{bars}
SIMULATE/DYNAMIC, END=0.2, STEPS=4
END
"""
BAR = """PART/{n}, MASS=2, CM={n}0, IP=0.1,0.1,0.2, QG={x},0,0
MARKER/{n}0, PART={n}
MARKER/{n}1, PART={n}, QP=-0.5,0,0
MARKER/{n}2, PART={n}, QP=0.5,0,0
JOINT/{n}, REVOLUTE, I={n}1, J={before}"""


def kernels():
    bars = "\n".join(
        BAR.format(n=n, x=n - 1.5, before=1 if n == 2 else f"{n - 1}2") for n in (2, 3, 4)
    )
    return al.compile_model(al.assemble(al.read(CHAIN.format(bars=bars))))


def test_a_second_run_plans_no_elimination(monkeypatch):
    made = []
    plan = Elimination._plan
    monkeypatch.setattr(Elimination, "_plan", lambda self: made.append(1) or plan(self))
    ready = kernels()
    first = al.simulate(ready)
    assert len(made) == 2  # in space, and in the plane
    second = al.simulate(ready)
    assert len(made) == 2
    assert np.array_equal(first.values, second.values)


def test_the_whole_and_the_plane_of_a_chain_keep_their_own_plans():
    ready = kernels()
    plane, space = al.simulate(ready), al.simulate(kernels(), no_reduction=["plane"])
    again = al.simulate(ready, no_reduction=["plane"])
    assert np.array_equal(space.values, again.values)
    assert np.abs(plane.values - space.values).max() < 1e-6 * np.abs(space.values).max()

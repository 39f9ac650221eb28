"""VERLET and ABAM take the loads of bodies that stand behind each other several at once."""

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


def growing(n: int, full: bool = False) -> str:
    """The chain with masses that grow with time; ``full``: other ones along each axis, coupled."""
    laws = ", FX=-0.5*(VARVAL(2)-1)*ACCX({i})\\, FY=-0.5*(VARVAL(2)-1)*(ACCY({i})-JGRAV)\\"
    if full:
        laws = ", FX=-VARVAL(2)*(2*ACCX({i})+0.5*ACCZ({i}))\\, FY=-VM({i})*ACCX({i})-ACCY({i})\\"
    laws = f"VFORCE/{{i}}, I={{i}}, JFLOAT={{f}}{laws}, FZ=-0.5*(1+DX({{i}})**2)*ACCZ({{i}})\n"
    float_ = "MARKER/{f}, PART=1, FLOATING\n"
    pairs = [{"i": i, "f": i + 5000} for i in range(2, n + 2)]
    return chain(n) + "".join((float_ + laws).format(**pair) for pair in pairs)


def pushed(n: int) -> str:
    """The chain, with one load that changes its law in time and one that is a table of it."""
    return chain(n) + (
        "SPLINE/1, X=0,1,2,5,50, Y=0,1,0,3,30\n"
        "SFORCE/900, TRANSLATIONAL, I=9, J=9000, FUNCTION=STEP(TIME,0.1,0,0.11,10)\n"
        "SFORCE/901, TRANSLATIONAL, I=15, J=14, FUNCTION=-CUBSPL(TIME,0,1)\n"
    )


SCENES = {
    "chain": chain(20), "two blocks": chain(300), "one more than lanes": chain(33),
    "net": net(9), "shuffled": shuffled(20), "wind": windy(20),
    "pushed": pushed(20),
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
        (pushed(20), 2),  # with others beside them
        (pushed(14), None),  # too many of them
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


BY_COMPONENT = {
    **{f"{n} masses": chain(n) for n in (4, 5, 8, 9)}, **SCENES, "scaled": chain(20),
    "growing": growing(20), "growing by axis": growing(11, full=True),
}  # fmt: skip


@pytest.mark.parametrize("scene", BY_COMPONENT)
@pytest.mark.parametrize("settings", ["ERROR=1E-8", "ERROR=1E-9, INTERPOLATE=OFF"])
def test_the_explicit_formula_moves_the_same_but_for_round_off(scene, settings, monkeypatch):
    """A choice of the step may turn over by round-off: then the error of the formula is left.

    With a larger ERROR bodies by component have a formula of their own.
    """
    if scene == "scaled":
        settings += ", SCALE=1,1,1,10,1,1"
    kernels = compile_model(
        assemble(read(f"{BY_COMPONENT[scene]}INTEGRATOR/ABAM, {settings}\nEND\n"))
    )
    fast = simulate(kernels, end=0.5, steps=10)
    monkeypatch.setattr(equations, "runs", lambda instances: None)
    slow = simulate(kernels, end=0.5, steps=10)
    assert abs(fast.summary["steps"] - slow.summary["steps"]) <= 0.02 * slow.summary["steps"]
    same = fast.summary["steps"] == slow.summary["steps"] and scene != "net"
    np.testing.assert_allclose(fast.values, slow.values, rtol=0, atol=1e-6 if same else 1e-3)


def test_growing_masses_are_those_of_the_implicit_formula():
    """... whose matrix has them."""
    for text in (growing(20), growing(11, full=True)):
        assert count(text) == 3
        found, known = (
            simulate(read(text + "END\n"), end=0.5, steps=5, integrator=method, error=1e-9)
            for method in ("ABAM", "RADAU")
        )
        for name in ("POINT_MASS/9.x", "POINT_MASS/10.y", "POINT_MASS/11.vz", "POINT_MASS/3.ay"):
            np.testing.assert_allclose(found[name], known[name], atol=1e-4)


def test_markers_of_one_mass_have_the_same_acceleration():
    """The force of their difference is none, on ground it is that of the one that moves."""
    others = "".join(f"MARKER/{i + 7000}, POINT_MASS={i}, QP=0.1,0,0\n" for i in range(2, 22))
    texts = [growing(20) + others, growing(20)]
    for i in range(2, 22):
        texts[0] = texts[0].replace(f"*ACCX({i})", f"*(ACCX({i})+9*ACCX({i},{i + 7000}))")
    found, known = (
        simulate(read(text + "END\n"), end=0.5, steps=5, integrator="ABAM", error=1e-8)
        for text in texts
    )
    assert count(texts[0]) == 3
    for name in known:
        np.testing.assert_allclose(found[name], known[name], atol=1e-6)


def test_an_effective_mass_that_vanishes_among_others_ends_the_run():
    """(1 + 0.1 k - 2 t) of each mass: the first is without at half a second."""
    text = growing(9).replace("-0.5*(VARVAL(2)-1)*ACCX", "2*TIME*ACCX")
    found = simulate(read(text + "END\n"), end=1.0, steps=100, integrator="ABAM", error=1e-5)
    assert found.outcome.name == "SINGULAR_ACCELERATION"
    assert 0.45 < found.time[-1] <= 0.5


@pytest.mark.parametrize("last", ["POINT_MASS/24.x", "POINT_MASS/24.vy"])
def test_what_is_hardest_to_follow_is_named(last):
    """The last of 23 masses is driven ever faster towards a pole of its force at 0.3."""
    axis = "FX" if last.endswith("x") else "FY"
    push = f"VFORCE/1, I=24, J_PART=1, {axis}=1/(0.3-TIME)**2\n"
    text = chain(23) + push + "VFORCE/2, I=23, J_PART=1, FZ=1E-3*SIN(TIME)\nEND\n"
    found = simulate(read(text), end=1.0, steps=10, integrator="ABAM", error=1e-8)
    assert found.outcome.name != "DONE" and "POINT_MASS/24" in found.message


def test_the_balance_of_the_explicit_formula_closes():
    found = simulate(read(chain(20) + "END\n"), 1.0, 10, "ABAM", error=1e-6, audit=True)
    assert found.balances[0].closes


def test_an_expression_that_is_watched_takes_the_other_way():
    """A SENSOR ends the run where the last mass has fallen by a metre."""
    sensor = "SENSOR/1, FUNCTION=DY(21), VALUE=-1, LE, HALT, ERROR=1E-6\nEND\n"
    found = simulate(read(chain(20) + sensor), end=3.0, steps=10, integrator="ABAM", error=1e-6)
    assert found["POINT_MASS/21.y"][-1] == pytest.approx(-1.0, abs=1e-5)

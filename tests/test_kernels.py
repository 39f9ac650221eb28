"""Exact derivatives of every element and every function, and what equal statements share."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from scenes import (
    GROUND,
    assert_derivatives,
    chain,
    compare_derivatives,
    done,
    random_state,
    system,
)

import adamslite as al
import adamslite.functions  # noqa: F401  fills the registry
from adamslite.functions.vectors import VECTORS
from adamslite.integrators import contract
from adamslite.language.function import FUNCTIONS
from adamslite.language.routines import USER

BODIES = (
    GROUND
    + """MARKER/11, PART=1, QP=0.3,-0.2,0.5, REULER=0.4,0.7,-0.3
MARKER/12, PART=1
PART/2, MASS=2, CM=20, IP=1,2,3,0.1,0.2,0.3, QG=1,2,3, REULER=0.5,0.6,0.7
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.2,0.4,-0.3, REULER=0.9,0.4,0.2
MARKER/22, PART=2
PART/3, MASS=3, CM=30, IP=2,2,1, QG=-1,0.5,1, REULER=-0.5,0.9,0.2
MARKER/30, PART=3
MARKER/31, PART=3, QP=-0.3,0.1,0.6, REULER=0.3,-0.8,0.4
MARKER/32, PART=3, QP=0.5,0,0
POINT_MASS/4, MASS=1, CM=40, QG=0.5,-2,0.4
MARKER/40, POINT_MASS=4
MARKER/41, POINT_MASS=4, QP=0.1,0.2,0.3, REULER=0.2,0.3,0.4
"""
)
FLOATING = {
    1: "MARKER/13, PART=1, FLOATING",
    2: "MARKER/23, PART=2, FLOATING",
    3: "MARKER/33, PART=3, FLOATING",
    4: "MARKER/43, POINT_MASS=4, FLOATING",
}
# What stands for the parameters of a function: turned and offset markers on every kind of body.
MARKERS = ((21, 31, 41, 11), (40, 11, 21, 32))
# Arguments of functions of numbers: the first two move.
X = "(0.5+0.3*SIN(DX(21,41)))"
V = "(0.6*SIN(VX(31)))"
NUMBERS = {
    1: (X,),
    2: (X, V),
    4: (V, X, "DY(21)", "WZ(31)"),
    5: (X, "0.1", V, "0.9", "DY(21)"),
    6: (X, V, "1.2", "0.7", "0.3", "0.2"),
    7: (X, V, "1.4", "2.5", "2.2", "0.3", "0.2"),
    8: (X, V, "0.9", "1.2", "2.5", "2.2", "0.3", "0.2"),
}
OWN_NUMBERS = {"SWEEP": (X, "2.0", "0.1", "0.3", "0.9", "0.7", "0.2")}


def with_markers(name: str, markers: tuple[int, ...]) -> str:
    """A call with the first markers of a tuple; of a vector its product with another."""
    count = len(FUNCTIONS[name].parameters)
    call = f"{name}({','.join(map(str, markers[:count]))})"
    return f"{call}*VXYZ(31)" if name in VECTORS else call


def measures() -> list[str]:
    """Every function of markers, with every kind of marker in every place."""
    names = [n for n, f in FUNCTIONS.items() if {p.kind for p in f.parameters} == {"marker"}]
    return [with_markers(n, m) for n, m in itertools.product(names, MARKERS)]


def intrinsics() -> list[str]:
    """Every function of numbers, of arguments that move."""
    found = []
    for name, function in FUNCTIONS.items():
        if name != USER and {p.kind for p in function.parameters} == {"number"}:
            repeated = function.parameters[-1].counts is not None
            args = OWN_NUMBERS.get(name) or NUMBERS[len(function.parameters) + repeated]
            first, *rest = args
            found.append(f"{name}({first}{':' if function.colon else ','}{','.join(rest)})")
            found[-1] = found[-1].replace(",)", ")")
    return found


def states(expressions: list[str]) -> str:
    """One DIFF for each expression: a row of its own in the equations."""
    lines = [f"DIFF/{100 + k}, FUNCTION={e}" for k, e in enumerate(expressions)]
    return BODIES + "\n".join([*lines, "END\n"])


@pytest.mark.parametrize("part", range(3))
def test_derivatives_of_every_function_of_markers(part):
    scene = system(states(measures()[part::3]))
    random_state(scene)
    assert_derivatives(scene, contract.ROWS)


def test_derivatives_of_every_function_of_numbers():
    scene = system(states(intrinsics()))
    random_state(scene)
    assert_derivatives(scene, contract.ROWS)


ORIENTATIONS = [f"ORIENT({s},{c},21,31)" for s, c in ((5, 1), (27, 3))]
REACTIONS = [
    f"{name}(1,{jflag},{comp},{rm})"
    for name, jflag, comp, rm in (
        ("JOINT", 1, 2, 0), ("JOINT", 0, 7, 21), ("JOINT", 0, 1, 0), ("SFORCE", 1, 1, 0),
        ("VFORCE", 0, 4, 21), ("SPDP", 0, 2, 0),
    )
]  # fmt: skip
ELEMENTS = rf"""{FLOATING[1]}
JOINT/1, REVOLUTE, I=21, J=31
SFORCE/1, TRANSLATIONAL, I=21, J=32, FUNCTION=-3*(DM(21,32)-1)-VR(21,32)
VFORCE/1, I=21, JFLOAT=13, RM=31, FX=ACCX(31)\FY=2*DX(21,31)\FZ=VM(21)
SPRINGDAMPER/1, TRANSLATIONAL, I=31, J=40, K=3, C=0.2, LENGTH=1, FORCE=2
VARIABLE/1, FUNCTION=0.5*SIN(VARVAL(1))+DX(21)
VARIABLE/2, FUNCTION=TIME**2
VARIABLE/3, FUNCTION=VX(21)*VARVAL(2)
"""
OTHERS = ["VARVAL(1)*DX(21)", "VARVAL(2)*DX(21)", "VARVAL(3)**3", "DIF1(100)*DIF(101)", "DDT(3)"]


def test_derivatives_of_functions_of_elements_and_states():
    scene = system(states([*ORIENTATIONS, *REACTIONS, *OTHERS]).replace("END", ELEMENTS + "END"))
    random_state(scene)
    assert_derivatives(scene, contract.INDEX3)


PAIRS = ["I=21, J=31", "I=11, J=31", "I=40, J=21", "I=31, J=41", "I=41, J=12", "I=20, J=32"]
FORCES = [
    "SFORCE/{id}, TRANSLATIONAL, {ij}, FUNCTION=({sign}3)*(VX(21)+DX(31)**2*ACCY(41))",
    "SFORCE/{id}, TRANSLATIONAL, ACTIONONLY, {ij}, FUNCTION=({sign}3)*(VX(21)+DX(31)**2)",
    "SFORCE/{id}, ROTATIONAL, {ij}, FUNCTION=({sign}2)*(WZ(21,31,31)+AZ(21,31))",
    "SPRINGDAMPER/{id}, TRANSLATIONAL, {ij}, K={sign}3, C=0.2, LENGTH=1, FORCE=2",
    "SPRINGDAMPER/{id}, ROTATIONAL, {ij}, KT={sign}3, CT=0.2, ANGLE=0.1, TORQUE=2",
    "VFORCE/{id}, {ij}, RM=31, FX=({sign}2)*ACCX(21,31)\\FY=2*DX(21,31)\\FZ=VM(21)",
]


@pytest.mark.parametrize("force", FORCES, ids=lambda f: f.split(",")[0][:6] + f[14:26])
def test_derivatives_of_forces_between_every_kind_of_marker(force):
    """Loads on parts, point masses and ground, both signs, at offset and turned markers."""
    rotational = "ROTATIONAL" in force.upper().split(",")[1]
    pairs = [p for p in PAIRS if "4" not in p] if rotational else PAIRS
    if "VFORCE" in force:
        pairs = [p[:5] + p[5:].replace("J=", "JFLOAT=")[:-1] + "3" for p in pairs]
    floating = FLOATING.values() if "VFORCE" in force else ()
    for sign in ("", "-"):
        lines = [force.format(id=k, ij=ij, sign=sign) for k, ij in enumerate(pairs, 1)]
        scene = system(BODIES + "\n".join([*floating, *lines, "END\n"]))
        random_state(scene)
        assert_derivatives(scene, contract.LOADS)


KINDS = ("REVOLUTE", "SPHERICAL", "TRANSLATIONAL", "FIXED")


@pytest.mark.parametrize("kind", KINDS)
def test_derivatives_of_joints(kind):
    """Rows at position, velocity and acceleration level, and the reactions."""
    pairs = ("I=21, J=31", "I=12, J=32")
    lines = [f"JOINT/{k}, {kind}, {ij}" for k, ij in enumerate(pairs, 1)]
    scene = system(BODIES + "\n".join([*lines, "END\n"]))
    for phases in (contract.INDEX3, contract.STABILISED):
        random_state(scene)
        assert_derivatives(scene, phases)
    compare_derivatives(scene, contract.ACCELERATION, 2, "d/da")
    compare_derivatives(scene, contract.ACCELERATION, 3, "d/d(lam, V)")


def test_derivatives_of_constraints_by_expression():
    """Holonomic and nonholonomic GCON, with functions of time and of variables."""
    lines = [
        "VARIABLE/1, FUNCTION=SIN(TIME)",
        "GCON/1, FUNCTION=DX(21,31)**2+DM(41,31)-VARVAL(1)",
        "GCON/2, FUNCTION=VX(21,31,31)*DY(40)+TIME",
        "GCON/3, FUNCTION=AZ(21)-2*DZ(31)",
        "END\n",
    ]
    scene = system(BODIES + "\n".join(lines))
    for phases in (contract.INDEX3, contract.STABILISED):
        random_state(scene)
        assert_derivatives(scene, phases)
    compare_derivatives(scene, contract.ACCELERATION, 2, "d/da")
    compare_derivatives(scene, contract.ACCELERATION, 3, "d/d(lam, V)")


# ---- shapes ------------------------------------------------------------------------------------


def kernels(deck: str) -> al.compile_model:
    return al.compile_model(al.assemble(al.read(deck)))


def test_a_thousand_equal_forces_are_one_shape():
    found = [g for g in kernels(chain(1001)).groups if g.face == "loads"]
    assert sorted(len(g.instances) for g in found) == [1, 1000]  # the first hangs on the ground


def test_numbers_and_ids_are_arguments_of_the_kernels():
    """A deck with other numbers, other ids and another order compiles nothing."""
    deck = BODIES + "SFORCE/1, TRANSLATIONAL, I=21, J=31, FUNCTION=-37*(DM(21,31)-0.125)\nEND\n"
    kernels(deck)
    numbers = deck.replace("37", "41.5").replace("0.125", "7").replace("QG=1,2,3", "QG=3,2,1")
    assert kernels(numbers).compiled == 0
    ids = numbers.replace("/21", "/7021").replace("(21", "(7021").replace("I=21", "I=7021")
    assert kernels(ids).compiled == 0


def test_an_exponent_and_a_flag_are_part_of_the_shape():
    text = BODIES + "SFORCE/1, TRANSLATIONAL, I=21, J=31, FUNCTION=DM(21,31)**3\nEND\n"
    names = {
        g.name
        for deck in (text, text.replace("**3", "**4"), text.replace("FUNC", "ACTIONONLY, FUNC"))
        for g in kernels(deck).groups
        if g.face == "loads"
    }
    assert len(names) == 3


CONTACT = """SFORCE/1, TRANSLATIONAL, I=21, J=31
, FUNCTION=IMPACT(DM(21,31),VR(21,31),{free},7,{exponent},0.3,0.1)
"""


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0, 3.0, 2.2])
@pytest.mark.parametrize("free", [5.0, 0.01])
def test_derivatives_of_a_contact(exponent, free):
    """In contact and out of it: products, a root, or a power."""
    scene = system(BODIES + CONTACT.format(free=free, exponent=exponent) + "END\n")
    random_state(scene)
    assert_derivatives(scene, contract.LOADS)


@pytest.mark.parametrize(
    "exponent, needed", [("1", 0), ("3/2", 0), ("2.0", 0), ("3", 0), ("2.2", 1)]
)
@pytest.mark.parametrize(
    "force", [
        "IMPACT(DM(21,31),VR(21,31),1,2,{},3,4)", "BISTOP(DM(21,31),VR(21,31),1,5,2,{},3,4)"
    ],
)  # fmt: skip
def test_the_usual_exponents_of_contacts_need_no_power(force, exponent, needed):
    text = f"SFORCE/1, TRANSLATIONAL, I=21, J=31, FUNCTION={force.format(exponent)}"
    model = al.assemble(al.read(f"{BODIES}{text}\nEND\n"))
    (group,) = [g for g in al.compile_model(model).groups if g.face == "loads"]
    assert (" @llvm.pow." in group.write.kernels("kernel")[0]) == needed


def test_a_contact_that_is_held_open_or_shut():
    """Where its branch says that nothing touches, nothing is added, whatever the depth; where it
    says that something does, the law goes on behind its end; released, the depth decides.
    """
    scene = system(BODIES + CONTACT.format(free=30.0, exponent=1.5) + "END\n")
    random_state(scene)
    first, count = scene.nw, scene.sizes.watched
    assert count == 2
    loads = {}
    for branch in (0.0, -1e200, 1e200):
        scene.W[first : first + count] = branch
        scene.run(contract.RESIDUAL, contract.LOADS)
        loads[branch] = scene.F[: scene.n].copy()
    free = system(BODIES + "END\n")
    for name in ("q", "u", "a", "base"):
        getattr(free, name)[:] = getattr(scene, name)
    free.run(contract.RESIDUAL, contract.LOADS)
    assert np.array_equal(loads[-1e200], free.F[: free.n])
    assert np.array_equal(loads[0.0], loads[1e200])
    assert np.abs(loads[0.0] - loads[-1e200]).max() > 1.0


def test_results_do_not_depend_on_ids_or_on_the_order_of_statements():
    deck = BODIES + ELEMENTS.replace("JOINT/1, REVOLUTE", "JOINT/1, SPHERICAL") + "END\n"
    title, *lines = deck.replace("END\n", "").rstrip().split("\n")
    ground, rest = lines[:1], lines[1:]
    there = done(deck, 0.2, 4, error=1e-6)
    back = done("\n".join([title, *ground, *rest[::-1], "END\n"]), 0.2, 4, error=1e-6)
    for name in ("PART/2.x", "PART/3.phi", "JOINT/1.fx", "SFORCE/1.f"):
        np.testing.assert_allclose(back[name], there[name], rtol=1e-7, atol=1e-8)

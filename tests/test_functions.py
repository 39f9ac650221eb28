"""Deck functions against their definitions: value tables, frames of derivatives, attitudes."""

from __future__ import annotations

import itertools
import math
import subprocess
import sys

import mpmath as mp
import pytest
from sample_scope import (
    GROUND,
    NOW,
    SampleScope,
    attitude,
    evaluate,
    place,
    rate,
    spin,
    state,
    turn,
)
from tiers import every

import adamslite.functions  # noqa: F401  fills the registry
from adamslite.functions.angles import SEQUENCES
from adamslite.functions.integration import NUMBERS
from adamslite.language.function import FUNCTIONS
from adamslite.language.routines import USER
from adamslite.symbolic.graph import number

MARKERS = (GROUND, 0, 1, 2)


def call(name: str, *args) -> float:
    """A deck function of numbers."""
    return float(FUNCTIONS[name].body(SampleScope(), *map(number, args)))


def measure(name: str, *frames: int) -> mp.mpf:
    """A deck function of frames, now."""
    scope = SampleScope()
    return evaluate(FUNCTIONS[name].body(scope, *frames), scope.values)


def test_registering_imports_no_graph():
    code = "import sys, adamslite.functions; sys.exit('adamslite.symbolic.graph' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


# ---- frames in which derivatives are taken -------------------------------------------------------


def seen_from(frame: int, vector, order: int) -> mp.matrix:
    """The derivative in ``frame`` by definition: of the components along its axes."""
    components = rate(lambda t: attitude(frame, t).T * vector(t), order)
    return attitude(frame, NOW) * components


def separation(i: int, j: int):
    return lambda t: place(i, t) - place(j, t)


def turning(i: int, j: int):
    return lambda t: spin(i, t) - spin(j, t)


CASES = {"V": (separation, 1), "ACC": (separation, 2), "WDT": (turning, 1)}


@pytest.mark.parametrize("family", every(3, CASES))
@pytest.mark.parametrize("l", MARKERS)
@pytest.mark.parametrize("j", every(2, (GROUND, 1)))
def test_time_derivatives_are_taken_in_frame_l(family, j, l):  # noqa: E741
    source, order = CASES[family]
    truth = seen_from(l, source(0, j), order)
    assert abs(measure(family + "M", 0, j, l) - mp.norm(truth)) < 1e-12
    for k, (c, letter) in itertools.product((GROUND, 2), enumerate("XYZ")):
        along = (truth.T * state("x", k)[:, c])[0]
        assert abs(measure(family + letter, 0, j, k, l) - along) < 1e-12


@pytest.mark.parametrize("l", MARKERS)
def test_vr_is_the_rate_of_dm_in_every_frame(l):  # noqa: E741
    assert (
        abs(measure("VR", 0, 1, l) - mp.diff(lambda t: mp.norm(separation(0, 1)(t)), NOW)) < 1e-12
    )


@pytest.mark.parametrize("k", (GROUND, 2))
def test_displacements_and_angular_velocities_are_components_along_k(k):
    for letter, c in zip("XYZ", range(3), strict=True):
        axis = state("x", k)[:, c]
        assert (
            abs(measure("D" + letter, 0, 1, k) - ((place(0, NOW) - place(1, NOW)).T * axis)[0])
            < 1e-12
        )
        assert (
            abs(measure("W" + letter, 0, 1, k) - ((spin(0, NOW) - spin(1, NOW)).T * axis)[0])
            < 1e-12
        )
    assert abs(measure("DM", 0, 1) - mp.norm(place(0, NOW) - place(1, NOW))) < 1e-12
    assert abs(measure("WM", 0, 1) - mp.norm(spin(0, NOW) - spin(1, NOW))) < 1e-12


def test_ground_frame_adds_no_terms():
    scope = SampleScope()
    for name, leaf in (("VX", "v"), ("ACCX", "a"), ("WDTX", "al")):
        assert str(FUNCTIONS[name].body(scope, 0, 1, GROUND, GROUND)) == f"{leaf}_0_1_0"


# ---- attitudes -----------------------------------------------------------------------------------


class Posed(SampleScope):
    """Frame 0 in a given attitude against frame 1, which has a given attitude in ground."""

    def __init__(self, relative, base) -> None:
        super().__init__()
        self.matrices = {0: base * relative, 1: base}

    def axes(self, k):
        if k not in self.matrices:
            return super().axes(k)
        return tuple(self.vector(f"x_{k}_{c}", self.matrices[k][:, c]) for c in range(3))


def component(relative, name: str, *args) -> float:
    for base, j in ((mp.eye(3), GROUND), (attitude(2, NOW), 1)):
        scope = Posed(relative, base)
        value = evaluate(FUNCTIONS[name].body(scope, *args, 0, j), scope.values)
        assert mp.isfinite(value)
    return float(value)


def product(sequence, angles) -> mp.matrix:
    return (
        turn(sequence[0], angles[0]) * turn(sequence[1], angles[1]) * turn(sequence[2], angles[2])
    )


@pytest.mark.parametrize("system", range(1, 13))
@pytest.mark.parametrize("outer", [(0.3, -0.8), (2.5, 2.9), (-2.2, 1.9), (-0.4, -3.0)])
def test_orient_recovers_the_angles_of_a_sequence(system, outer):
    sequence = SEQUENCES[system - 1]
    middle = 1.1 if sequence[0] == sequence[2] else -1.1
    angles = (outer[0], middle, outer[1])
    relative = product(sequence, angles)
    found = [component(relative, "ORIENT", system, c) for c in (1, 2, 3)]
    assert found == pytest.approx(angles, abs=1e-12)


@pytest.mark.parametrize("system", range(13, 25))
@pytest.mark.parametrize("outer", [(0.3, -0.8), (2.5, 2.9), (-2.2, 1.9), (-0.4, -3.0)])
def test_orient_recovers_turns_about_axes_that_stay(system, outer):
    """R = R_c(a3) R_b(a2) R_a(a1): each turn is about an axis of j."""
    a, b, c = SEQUENCES[system - 13]
    middle = 1.1 if a == c else -1.1
    relative = turn(c, outer[1]) * turn(b, middle) * turn(a, outer[0])
    found = [component(relative, "ORIENT", system, n) for n in (1, 2, 3)]
    assert found == pytest.approx((outer[0], middle, outer[1]), abs=1e-12)


@pytest.mark.parametrize("system", range(1, 13))
@pytest.mark.parametrize("end", (0, 1))
def test_orient_where_outer_angles_merge(system, end):
    sequence = SEQUENCES[system - 1]
    middle = end * mp.pi if sequence[0] == sequence[2] else (end - mp.mpf(1) / 2) * mp.pi
    with mp.workdps(60):
        relative = product(sequence, (mp.mpf("0.7"), +middle, 0)).apply(lambda x: mp.chop(x, 1e-14))
    found = [component(relative, "ORIENT", system, c) for c in (1, 2, 3)]
    assert found == pytest.approx((0.7, float(middle), 0.0), abs=1e-12)


def test_names_of_the_usual_sequences():
    relative = product((2, 0, 2), (-2.0, 0.4, 1.3))
    assert [component(relative, n) for n in ("PSI", "THETA", "PHI")] == pytest.approx(
        (-2.0, 0.4, 1.3)
    )
    relative = product((2, 1, 0), (-2.0, 0.4, 1.3))
    # PITCH has the opposite sign of the second angle.
    assert [component(relative, n) for n in ("YAW", "PITCH", "ROLL")] == pytest.approx(
        (-2.0, -0.4, 1.3)
    )


@pytest.mark.parametrize("axis", (0, 1, 2))
@pytest.mark.parametrize("angle", (-3.0, -1.0, 0.0, 0.5, 2.0, 3.1))
def test_single_rotations_count_full_turns(axis, angle):
    found = component(turn(axis, angle), "A" + "XYZ"[axis])
    assert found == pytest.approx(angle + 2 * math.pi)


@pytest.mark.parametrize(
    "angles", [(0.1, 0.2, 0.3), (3.0, 0.1, 0.2), (0.1, 3.0, 0.2), (1.5, 3.1, -1.5), (-2, 2.8, 1)]
)
def test_euler_parameters_rebuild_the_attitude(angles):
    relative = product((0, 1, 2), angles)
    p0, p1, p2, p3 = (component(relative, "ORIENT", 27, c) for c in (1, 2, 3, 4))
    assert p0 >= 0
    rebuilt = [
        [1 - 2 * (p2**2 + p3**2), 2 * (p1 * p2 - p0 * p3), 2 * (p1 * p3 + p0 * p2)],
        [2 * (p1 * p2 + p0 * p3), 1 - 2 * (p1**2 + p3**2), 2 * (p2 * p3 - p0 * p1)],
        [2 * (p1 * p3 - p0 * p2), 2 * (p2 * p3 + p0 * p1), 1 - 2 * (p1**2 + p2**2)],
    ]
    assert sum(rebuilt, []) == pytest.approx([float(x) for x in relative], abs=1e-12)


# ---- forces and states ---------------------------------------------------------------------------


def test_components_of_a_reaction():
    values = [measure("JOINT", 7, 0, comp, GROUND) for comp in range(1, 9)]
    assert values == pytest.approx([13, 3, -4, 12, math.sqrt(5.25), 0.5, 2, -1])
    assert measure("SFORCE", 7, 1, 4, GROUND) == -12
    along = (mp.matrix([3, -4, 12]).T * state("x", 2)[:, 1])[0]
    assert abs(measure("VFORCE", 7, 0, 3, 2) - along) < 1e-12


def test_a_reaction_is_asked_of_its_own_statement():
    scope = SampleScope()
    FUNCTIONS["JOINT"].body(scope, 7, 1, 2, GROUND)
    assert scope.loads == [(7, 1)]


def test_states():
    assert [measure(n, 4) for n in ("VARVAL", "DIF", "DIF1", "DDT")] == [1.5, 2.5, -0.5, 0.25]
    assert measure("SENVAL", 4) == 4.5


# ---- value tables --------------------------------------------------------------------------------

TABLE = {
    "STEP": [
        ((0.5, 1, -2, 3, 6), -2), ((1, 1, -2, 3, 6), -2), ((1.5, 1, -2, 3, 6), -0.75),
        ((2, 1, -2, 3, 6), 2), ((3, 1, -2, 3, 6), 6), ((9, 1, -2, 3, 6), 6),
        ((1.5, 3, 6, 1, -2), -0.75), ((9, 3, 6, 1, -2), 6), ((0, 3, 6, 1, -2), -2),
    ],
    "STEP5": [
        ((1, 1, -2, 3, 6), -2), ((1.5, 1, -2, 3, 6), -2 + 8 * 0.103515625),
        ((2, 1, -2, 3, 6), 2), ((4, 1, -2, 3, 6), 6),
    ],
    "HAVSIN": [
        ((0, 1, -2, 3, 6), -2), ((1.5, 1, -2, 3, 6), 2 + 4 * math.sin(math.pi / 4 - math.pi / 2)),
        ((2, 1, -2, 3, 6), 2), ((3, 1, -2, 3, 6), 6),
    ],
    "IMPACT": [
        ((5, -1, 4, 10, 1.5, 2, 0.5), 0), ((4, -1, 4, 10, 1.5, 2, 0.5), 0),
        ((3, -1, 4, 10, 1.5, 2, 0.5), 12), ((3.75, -1, 4, 10, 1.5, 2, 0.5), 1.25 + 1),
        ((3, 100, 4, 10, 1.5, 2, 0.5), 0), ((3, -1, 4, 10, 2, 2, 0), 12),
    ],
    "BISTOP": [
        ((1, 3, 0, 2, 10, 1.5, 2, 0.5), 0), ((-1, -1, 0, 2, 10, 1.5, 2, 0.5), 12),
        ((3, 1, 0, 2, 10, 1.5, 2, 0.5), -12), ((2.25, 1, 0, 2, 10, 1.5, 2, 0.5), -2.25),
        ((3, -100, 0, 2, 10, 1.5, 2, 0.5), 0), ((-1, 100, 0, 2, 10, 1.5, 2, 0.5), 0),
    ],
    "SWEEP": [
        ((0.3, 5, 1, 2, 3, 6, 0.5), 0),
        ((2, 5, 1, 2, 3, 6, 0.5), 5 * math.sin(2 * math.pi * (2 * 1 + 2 * 1 + 1))),
        ((2.3, 5, 1, 2, 3, 6, 0.5), 5 * math.sin(2 * math.pi * (2 + 2 * 1.3 + 1.3**2))),
        ((3.3, 5, 1, 2, 3, 6, 0.5), 5 * math.sin(2 * math.pi * (6 * 3.3 - 4 * 2))),
        ((4.1, 5, 0.7, 2, 2.3, 3.1, 0.5), 5 * math.sin(2 * math.pi * (3.1 * 4.1 - 1.1 * 1.5))),
        ((1.25, 5, 1, 2, 3, 6, 0.5), 2.5 * math.sin(2 * math.pi * (2 + 0.5 + 0.0625))),
    ],
    "SHF": [
        ((2, 0.5, 3, 2, 0.25, 1), 3 * math.sin(2.75) + 1), ((2, 0.5, 3, 2), 3 * math.sin(3)),
    ],
    "FORCOS": [
        ((2, 0.5, 0.7, 9), 9),
        ((2, 0.5, 0.7, 9, 2, -1), 9 + 2 * math.cos(1.05) - math.cos(2.1)),
    ],
    "FORSIN": [((2, 0.5, 0.7, 9, 2, -1), 9 + 2 * math.sin(1.05) - math.sin(2.1))],
    "POLY": [((2, 0.5, 7), 7), ((2, 0.5, 7, -1, 2, 4), 7 - 1.5 + 4.5 + 13.5)],
    "CHEBY": [((2, 0.5, 7), 7), ((2, 0.5, 7, -1, 2, 4), 7 - 1.5 + 2 * 3.5 + 4 * 9)],
    "IF": [((-1, 2, 3, 4), 2), ((0, 2, 3, 4), 3), ((1e-9, 2, 3, 4), 4)],
    "ABS": [((-2,), 2), ((0,), 0), ((3,), 3)],
    "MAX": [((1, 3), 3), ((3, -1, 7, 2), 7)],
    "MIN": [((1, 3), 1), ((3, -1, 7, 2), -1)],
    "DIM": [((3, 1), 2), ((1, 3), 0)],
    "SIGN": [((3, -2), -3), ((-3, 2), 3), ((-3, 0), 3), ((3, -1e-9), -3)],
    "MOD": [((7, 3), 1), ((-7, 3), -1), ((7, -3), 1), ((5.5, 2), 1.5), ((6, 3), 0)],
    "AINT": [((2.7,), 2), ((-2.7,), -2), ((2,), 2)],
    "ANINT": [((2.5,), 3), ((-2.5,), -3), ((2.4,), 2), ((-0.4,), 0)],
    "INT": [((2.7,), 2), ((-2.7,), -2), ((-3,), -3), ((0.9,), 0)],
    "NINT": [((1.5,), 2), ((-1.5,), -2), ((0.49,), 0), ((-7.6,), -8)],
    "SQRT": [((2.25,), 1.5)],
    "EXP": [((1.5,), math.exp(1.5))],
    "LOG": [((1.5,), math.log(1.5))],
    "LOG10": [((1000,), 3)],
    "SIN": [((0.5,), math.sin(0.5))],
    "COS": [((0.5,), math.cos(0.5))],
    "TAN": [((0.5,), math.tan(0.5))],
    "ASIN": [((0.5,), math.asin(0.5))],
    "ACOS": [((0.5,), math.acos(0.5))],
    "ATAN": [((0.5,), math.atan(0.5))],
    "ATAN2": [((-1, -2), math.atan2(-1, -2)), ((1, -2), math.atan2(1, -2))],
    "SINH": [((0.5,), math.sinh(0.5))],
    "COSH": [((0.5,), math.cosh(0.5))],
    "TANH": [((0.5,), math.tanh(0.5))],
}  # fmt: skip


@pytest.mark.parametrize("name", TABLE)
def test_values(name):
    for args, expected in TABLE[name]:
        assert call(name, *args) == pytest.approx(expected, abs=1e-13), args


def test_every_function_of_numbers_stands_in_the_table():
    of_numbers = {"number", "exponent"}
    numeric = {n for n, f in FUNCTIONS.items() if {p.kind for p in f.parameters} <= of_numbers}
    assert numeric - {USER, *NUMBERS} == set(TABLE)

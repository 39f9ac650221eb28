"""The start of a deck in numbers: derivatives of constraints, gaps of joints, redundant rows."""

from __future__ import annotations

import math

import numpy as np
import pytest
from constraint_decks import BODIES, DECKS, deck
from decklets import told
from scipy.sparse import csr_array
from tiers import fast

import adamslite as al
from adamslite.analyses.initial.redundancy import row_name
from adamslite.analyses.initial.rows import constraint_gradient
from adamslite.analyses.session.session import Session
from adamslite.api.checks import _freedom
from adamslite.assembly.closing import close, moved
from adamslite.assembly.rank import (
    MOST_ORTHOGONALISED,
    TooManyDependent,
    dependent_of_many,
    dependent_rows,
    unit_rows,
)
from adamslite.assembly.rows import gradient, sparse_gradient, values
from adamslite.assembly.scope import WIDTH, Posture
from adamslite.assembly.start import closing_of, has_loops, redundant_rows
from adamslite.equations.system import System
from adamslite.kernels.compile import compile_model
from adamslite.model.model import Model
from adamslite.resources import find

STEP = 1e-5
LOOPS = ("andrews/andrews", "bricard/bricard", "four-bar/four-bar", "slider-crank/slider-crank",
         "slider-crank/equal-arms", "a02-n2/a02-n2", "gear-pair/planetary", "shafts/convel",
         "torture/flattened/parallelogram", "three-joint-coupler/three-joint-coupler")  # fmt: skip


@pytest.mark.parametrize("name", [name for name in DECKS if " of a velocity" not in name
                                  and name[-8:] not in ("VELOCITY", "LERATION")])  # fmt: skip
def test_derivatives_are_those_of_finite_differences(name: str) -> None:
    """Central differences with h = 1e-5: truncation h^2 times third derivatives of sizes up to
    some ten, round-off 1e-16/h: 1e-8 holds both.
    """
    model = Model(al.read(deck(name)))
    kept = [each for each in model.constraints if not each.is_rate(model)]
    at = Posture.start(model)
    rows = gradient(model, at, kept)
    for column in range(WIDTH * len(model.bodies)):
        step = np.zeros(WIDTH * len(model.bodies))
        step[column] = STEP
        if model.bodies[column // WIDTH].width < WIDTH and column % WIDTH >= 3:
            continue
        ahead, back = (
            np.concatenate([values(model, moved(at, sign * step), each) for each in kept])
            for sign in (-1, 1)
        )
        np.testing.assert_allclose(rows[:, column], (ahead - back) / (2 * STEP), atol=1e-8)


@pytest.mark.parametrize(
    "name", fast(DECKS, "JOINT CONVEL", "GCON", "GCON of a velocity", "PTCV closed")
)
def test_derivatives_are_those_of_native_code(name: str) -> None:
    """Both apply the rules of differentiation: equal to round-off of a few products."""
    of = al.read(deck(name))
    model = Model(of)
    system = System(compile_model(model), False)
    here, there = [], []
    for b, body in enumerate(model.bodies):
        here += range(WIDTH * b, WIDTH * b + body.width)
        there += range(system.starts[b], system.starts[b] + body.width)
    rows = gradient(model, Posture.start(model), model.constraints)
    np.testing.assert_allclose(rows[:, here], constraint_gradient(system)[:, there], atol=1e-14)


@pytest.mark.parametrize("name", fast(LOOPS, "four-bar/four-bar", "bricard/bricard"))
def test_redundant_rows_are_those_that_a_run_leaves_out(name: str) -> None:
    of = al.read(find("decks") / f"{name}.adm")
    system = Session(of, None, {}).system
    left_out = [row_name(system, row) for row in system.elimination.dropped]
    assert has_loops(of) and redundant_rows(of) == left_out


@pytest.mark.parametrize("name", fast(LOOPS, "andrews/andrews", "bricard/bricard"))
def test_of_many_rows_as_many_are_left_out(name: str) -> None:
    """The sparse method on what the dense one has found: as many rows, and the others are about as
    far from dependence.
    """
    model, closing = closing_of(al.read(find("decks") / f"{name}.adm"))
    posture = close(model, model.constraints, closing.posture).posture
    sparse = sparse_gradient(model, posture, model.constraints)
    rows = gradient(model, posture, model.constraints)
    np.testing.assert_array_equal(sparse.toarray(), rows)
    scaled = unit_rows(rows)
    expected, found = dependent_rows(scaled), dependent_of_many(sparse)
    assert len(found) == len(expected)
    least = [np.linalg.svd(np.delete(scaled, out, axis=0))[1][-1] for out in (expected, found)]
    assert least[1] > 0.1 * least[0]


@pytest.mark.parametrize("count", [MOST_ORTHOGONALISED // 2, 2 * MOST_ORTHOGONALISED])
def test_rows_that_are_left_out_are_combinations_of_those_that_stay(count: int) -> None:
    """Either way to find them; the last three of all rows are combinations of the first five."""
    random = np.random.default_rng(4)
    rows = random.normal(size=(count - 3, count + 20))
    rows = unit_rows(np.vstack([rows, random.normal(size=(3, 5)) @ rows[:5]]))
    left_out = dependent_rows(rows)
    assert len(left_out) == 3
    assert {*left_out} < {0, 1, 2, 3, 4, count - 3, count - 2, count - 1}
    staying = np.delete(rows, left_out, axis=0)
    assert np.linalg.matrix_rank(staying) == np.linalg.matrix_rank(rows) == count - 3


def test_a_loop_of_a_hundred_and_sixty_links() -> None:
    """800 rows and more are sparse.  A closed chain of hinges with one axis, n links on the ground,
    keeps 5 (n + 1) - 3 independent rows, so that n - 2 freedoms are left.
    """
    n, lines = 160, ["title", "PART/1, GROUND", "MARKER/1, PART=1", "MARKER/2, PART=1, QP=0,1,0"]
    for k in range(n):
        angle = math.pi * k / n
        lines += [
            f"PART/{k + 2}, MASS=1, CM={10 * k + 10}, IP=1,1,1, "
            f"QG={math.sin(angle) / 2:.12f},{(1 - math.cos(angle)) / 2:.12f},0",
            f"MARKER/{10 * k + 10}, PART={k + 2}",
            f"JOINT/{k + 1}, REVOLUTE, I={10 * k + 10}, J={10 * k + 1 if k else 1}",
        ]
        ahead = math.pi * (k + 1) / n
        dx, dy = (f(ahead) - f(angle) for f in (math.sin, lambda a: -math.cos(a)))
        lines += [f"MARKER/{10 * k + 11}, PART={k + 2}, QP={dx / 2:.12f},{dy / 2:.12f},0"]
    lines += [f"JOINT/{n + 1}, REVOLUTE, I={10 * n + 1}, J=2", "END", ""]
    of = al.read("\n".join(lines))
    assert closing_of(of)[1].closed
    assert len(redundant_rows(of)) == 3


def fixed_again_and_again(count: int) -> str:
    """A part that is fixed to the ground by so many joints between the same two markers."""
    joints = "".join(f"JOINT/{k}, FIXED, I=2, J=1\n" for k in range(1, count + 1))
    bodies = "MARKER/1, PART=1\nPART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2, PART=2\n"
    return f"again and again\nPART/1, GROUND\n{bodies}{joints}END\n"


def test_of_many_rows_of_few_coordinates_all_but_as_many_are_left_out() -> None:
    left_out = redundant_rows(al.read(fixed_again_and_again(200)))
    assert len(left_out) == 6 * 199 and len({*left_out}) == len(left_out)
    assert not any(each.startswith("JOINT/1,") for each in left_out)


def test_freedoms_are_not_counted_where_thousands_of_rows_are_redundant(monkeypatch) -> None:
    monkeypatch.setattr("adamslite.api.checks.MOST_NAMED", 3)
    freedom, named = _freedom(al.read(fixed_again_and_again(3)))
    assert freedom.startswith("0 degrees of freedom") and named.endswith("; and 9 more")
    assert named.count(";") == 3
    monkeypatch.setattr("adamslite.api.checks.MOST_SURPLUS", 11)
    (only,) = _freedom(al.read(fixed_again_and_again(3)))
    assert only.endswith("18 constraint rows: too many of them are redundant to count degrees of "
                         "freedom")  # fmt: skip


def test_more_dependent_rows_than_can_be_found_are_refused(monkeypatch) -> None:
    monkeypatch.setattr("adamslite.assembly.rank.MOST_PRODUCTS", 1e5)
    rows = csr_array(np.tile(np.random.default_rng(1).normal(size=(150, 160)), (3, 1)))
    with pytest.raises(TooManyDependent):
        dependent_of_many(rows)


def test_a_tree_has_no_loops() -> None:
    assert not has_loops(al.read(find("decks") / "friction/friction.adm"))


def test_a_loop_beside_free_bodies_is_found() -> None:
    """Two hinges on one axis hold 10 rows, 5 of them twice; a body that flies free beside them has
    nothing to do with it.
    """
    of = al.read(
        "title\nPART/1, GROUND\nMARKER/1, PART=1\nMARKER/2, PART=1, QP=0,0,1\n"
        "PART/2, MASS=1, CM=20, IP=1,1,1\nMARKER/20, PART=2\nMARKER/21, PART=2, QP=0,0,1\n"
        "PART/3, MASS=1, CM=30, IP=1,1,1, QG=5,0,0\nMARKER/30, PART=3\n"
        "PART/4, MASS=1, CM=40, IP=1,1,1, QG=7,0,0\nMARKER/40, PART=4\n"
        "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=21, J=2\nEND\n"
    )
    assert len(redundant_rows(of)) == 5


# ---- gaps -------------------------------------------------------------------------------------

GAPS = [
    ("QP=3,4,0", "SPHERICAL", "5 millimeters apart"),
    ("QP=0,0,1", "SPHERICAL", "1 millimeter apart"),
    ("QP=3,4,12", "CYLINDRICAL", "5 millimeters apart"),
    ("QP=3,4,12", "PLANAR", "12 millimeters apart"),
    ("REULER=0,2D,0", "REVOLUTE", "2 degrees out of line"),
    ("REULER=30D,2D,-30D", "REVOLUTE", "2 degrees out of line"),
    ("REULER=0,2D,0", "FIXED", "2 degrees out of line"),
    ("REULER=0,170D,0", "FIXED", "10 degrees out of line"),
    ("REULER=0,100D,0", "FIXED", "80 degrees out of line"),
    ("QP=0.5,0,0, REULER=7D,0,0", "FIXED", "0.5 millimeters apart and 7 degrees out of line"),
    ("REULER=0,93D,0", "UNIVERSAL", "3 degrees out of line"),
    ("REULER=3D,0,0", "HOOKE", "3 degrees out of line"),
]


@pytest.mark.parametrize(("place", "kind", "how"), GAPS)
def test_a_joint_that_starts_apart_is_reported_with_its_size(
    place: str, kind: str, how: str
) -> None:
    """The second part is drawn as MARKER/1 is; MARKER/2 of it is where the case says."""
    found = told(
        "title\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n"
        "PART/1, GROUND\nMARKER/1, PART=1, QP=100,200,300, REULER=10D,20D,30D\n"
        "PART/2, MASS=1, CM=3, IP=1,1,1, QG=100,200,300, REULER=10D,20D,30D\n"
        f"MARKER/2, PART=2, {place}\nMARKER/3, PART=2, QP=0,70,0\n"
        f"JOINT/7, {kind}, I=2, J=1\nEND\n"
    )
    (one,) = [each for each in found if each.code == "starts-apart"]
    assert one.message == f"MARKER/2 and MARKER/1 of JOINT/7 start {how}"
    assert (one.span.line, one.severity) == (8, "warning")


def test_digits_of_numbers_are_no_gap() -> None:
    """A hinge at 1/3, written with seven digits; a turn by 0.005 degrees."""
    assert not told(
        "title\nPART/1, GROUND\nMARKER/1, PART=1\n"
        "PART/2, MASS=1, CM=3, IP=1,1,1, QG=0.3333333,0,0\n"
        "MARKER/2, PART=2, QP=-0.3333332,0,0, REULER=0,0.005D,0\n"
        "MARKER/3, PART=2\nJOINT/7, REVOLUTE, I=2, J=1\nEND\n"
    )


def test_closing_moves_as_a_run_does() -> None:
    """The same least change, weighted by radii of gyration: positions to 1e-12 of the size."""
    of = al.read(find("decks") / "four-bar/four-bar.adm")
    model, closing = closing_of(of)
    system = Session(of, None, {}).system
    assert closing.closed
    np.testing.assert_allclose(
        closing.posture.x.ravel(), system.q[system.places].ravel(), atol=1e-12
    )


def test_a_row_that_no_posture_decides_is_left_alone() -> None:
    deck = "VARIABLE/1, FUNCTION=DM(21,40)\nGCON/1, FUNCTION=VARVAL(d(1)/dt)-DX(21,31)\nEND\n"
    of = al.read(BODIES + deck)
    assert not np.isfinite(values(Model(of), Posture.start(Model(of)), of.of("GCON")[0])).any()
    assert "no-rate" in {each.code for each in al.check(of)} and redundant_rows(of) == []


def test_constraints_without_a_start_are_reported_with_what_they_contradict() -> None:
    """A rod of length 1 between points that are held 3 apart."""
    found = told(
        BODIES.replace("constraints between skew bodies", "title")
        + "JPRIM/1, ATPOINT, I=40, J=2\nMARKER/3, PART=1, QP=2.9,0.2,0.4\n"
        "GCON/1, FUNCTION=DM(40,3)-1\nEND\n"
    )
    (one,) = [each for each in found if each.code == "stays-open"]
    both = {"JPRIM/1", "GCON/1"}
    assert all(label in one.message for label in both)

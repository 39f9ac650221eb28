"""Initial conditions of many constraint rows: by sparse factors, as the dense way has them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tiers import fast

import adamslite as al
from adamslite.analyses.initial import least_change, redundancy
from adamslite.analyses.initial.redundancy import badly_chosen, redundant_rows
from adamslite.analyses.initial.rows import constraint_gradient, weights
from adamslite.analyses.session.session import Session
from adamslite.assembly.rank import unit_rows
from adamslite.equations.system import System
from adamslite.kernels.compile import Kernels
from adamslite.resources import find

NEVER = 10**9


def started(kernels: Kernels, monkeypatch: pytest.MonkeyPatch, most_dense: int) -> Session:
    """A session whose rows are sparse above a number of them, without a second try."""
    for module in (least_change, redundancy):
        monkeypatch.setattr(module, "MOST_DENSE", most_dense)
    monkeypatch.setattr(least_change, "MOST_REPEATED", 0)
    session = Session(kernels, None, {})
    session.prepare()
    return session


def compiled(text: str) -> Kernels:
    return al.compile_model(al.assemble(al.read(text)))


def least_of_kept(system: System) -> float:
    """The smallest singular value of the rows that are not left out."""
    rows = unit_rows(constraint_gradient(system) / weights(system))
    kept = np.delete(rows, system.elimination.dropped, axis=0)
    return float(np.linalg.svd(kept, compute_uv=False)[-1])


def ring(links: int, off: float = 0.0, speed: float = 0.0) -> str:
    """A closed chain of hinges with one axis, hung from the ground by one of them.

    Its markers fit a regular polygon; ``off``: how far every other body is drawn beside its place;
    ``speed``: of all of them along x.
    """
    angle = [2 * math.pi * k / links for k in range(links + 1)]
    corner = [(math.sin(a), math.cos(a)) for a in angle]
    lines = ["ring", "PART/1, GROUND", f"MARKER/1, PART=1, QP={corner[0][0]},{corner[0][1]},0"]
    for k in range(links):
        (xa, ya), (xb, yb) = corner[k : k + 2]
        at, dx, dy = 10 * (k + 2), (xb - xa) / 2, (yb - ya) / 2
        beside = off if k % 2 else 0.0
        lines += [
            f"PART/{k + 2}, MASS=1, CM={at}, IP=0.1,0.1,0.1, VX={speed}"
            f", QG={(xa + xb) / 2 + beside:.15g},{(ya + yb) / 2 + 0.7 * beside:.15g},0",
            f"MARKER/{at}, PART={k + 2}",
            f"MARKER/{at + 1}, PART={k + 2}, QP={-dx:.15g},{-dy:.15g},0",
            f"MARKER/{at + 2}, PART={k + 2}, QP={dx:.15g},{dy:.15g},0",
            f"JOINT/{k + 1}, REVOLUTE, I={at + 2}, J={10 * ((k + 1) % links + 2) + 1}",
        ]
    lines += [f"JOINT/{links + 1}, REVOLUTE, I=21, J=1", "END", ""]
    return "\n".join(lines)


@pytest.mark.parametrize(("off", "speed"), [(0.0, 0.0), (1e-3, 0.5), (0.05, 2.0)])
def test_a_ring_closes_as_the_dense_way_closes_it(
    monkeypatch: pytest.MonkeyPatch, off: float, speed: float
) -> None:
    """12 links in a plane: 3 of 65 rows follow from the others, and 72 - 62 = 10 freedoms are left,
    whatever gaps and speeds the links are drawn with.
    """
    kernels = compiled(ring(12, off, speed))
    dense = started(kernels, monkeypatch, NEVER).system
    sparse = started(kernels, monkeypatch, 0).system
    assert sparse.dof == dense.dof == 10
    for name in ("q", "u", "base"):
        np.testing.assert_allclose(getattr(sparse, name), getattr(dense, name), atol=1e-9)
    assert least_of_kept(sparse) > 0.1 * least_of_kept(dense)


@pytest.mark.parametrize("name", fast(
    ("four-bar/four-bar", "bricard/bricard", "andrews/andrews", "a02-n40/a02-n40",
     "slider-crank/slider-crank", "slider-crank/equal-arms"), "bricard/bricard",
))  # fmt: skip
def test_as_many_rows_are_left_out_of_loops(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    kernels = al.compile_model(al.assemble(al.read(find("decks") / f"{name}.adm")))
    dense = started(kernels, monkeypatch, NEVER).system
    sparse = started(kernels, monkeypatch, 0).system
    assert len(sparse.elimination.dropped) == len(dense.elimination.dropped) > 0
    np.testing.assert_allclose(sparse.u, dense.u, atol=1e-9)
    assert least_of_kept(sparse) > 0.1 * least_of_kept(dense)
    assert not badly_chosen(sparse)


def test_of_a_large_ring_no_matrix_is_dense(monkeypatch: pytest.MonkeyPatch) -> None:
    """60 links: 305 rows, 3 of which follow from the others; a run does without dense matrices."""

    def refused(*_: object) -> None:
        raise AssertionError("a dense matrix")

    for module, name in ((System, "dense_jacobian"), (np.linalg, "lstsq")):
        monkeypatch.setattr(module, name, refused)
    results = al.simulate(compiled(ring(60, 1e-4)), end=0.01, steps=1, integrator="HHT")
    assert results.outcome is al.Outcome.DONE, results.message
    assert results.summary["dof"] == 360 - 302


def test_rows_that_contradict_each_other_are_named_as_before(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A second hinge beside each of two hinges of a ring holds the same body elsewhere."""
    beside = "MARKER/500, PART=2, QP=0.3,0,0.1\nMARKER/501, PART=3, QP=0.3,0.4,0\n"
    deck = ring(30).replace("END\n", f"{beside}JOINT/99, SPHERICAL, I=500, J=501\nEND\n")
    kernels = compiled(deck)
    found = []
    for most in (NEVER, 100):
        monkeypatch.setattr(least_change, "MOST_DENSE", most)
        session = Session(kernels, None, {})
        session.prepare()
        assert session.unclosed is not None
        others = [each.label for each in session.unclosed.others]
        found.append((session.unclosed.statement.label, session.unclosed.equation, others))
    assert found[0] == found[1]


@pytest.mark.parametrize("share", [0.0, 1e-3, 1.0])
def test_contradictions_stay_at_their_least_sum_of_squares(
    monkeypatch: pytest.MonkeyPatch, share: float
) -> None:
    """Defects of a ring that contradict each other, and a share of others; without any, what is
    left of them is round-off, which contradicts, too.
    """
    system = started(compiled(ring(12)), monkeypatch, 0).system
    system.drop([])
    kept, level = np.arange(system.m), least_change.POSITIONS
    dense, sparse = (way(system, level, kept) for way in (least_change.Dense, least_change.Sparse))
    draw = np.random.default_rng(3)
    left, sizes, _ = np.linalg.svd(dense.gradient * dense.scale)
    against = left[:, (sizes > 1e-9).sum() :]
    defect = against @ draw.normal(size=against.shape[1]) + share * draw.normal(size=system.m)
    wanted = dense.step(defect)
    np.testing.assert_allclose(sparse.step(defect), wanted, atol=1e-9 * (share + 1e-3))


def test_a_bad_choice_of_rows_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """A parallelogram that has flattened keeps rows that are dependent there while those left out
    are not, or is as singular as all rows are: both ways judge alike.
    """
    kernels = compiled(ring(4))
    session = started(kernels, monkeypatch, 0)
    system = session.system
    kept = [row for row in range(system.m) if row not in system.elimination.dropped]
    system.drop(kept[:3])
    sparse = badly_chosen(system)
    monkeypatch.setattr(redundancy, "MOST_DENSE", NEVER)
    assert sparse == badly_chosen(system)
    assert len(redundant_rows(system)) == 3

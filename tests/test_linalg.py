"""Elimination of block patterns against numpy: chains, trees, loops, saddle points, mixed sizes."""

from __future__ import annotations

import itertools
from types import SimpleNamespace

import numpy as np
import pytest
from scenes import chain, links, system

from adamslite.equations.elimination_order import DENSE, analyse
from adamslite.integrators.linalg import blocks
from adamslite.sensitivity import inverse

PATTERNS = {
    "chain": [(k, k + 1) for k in range(11)],
    "tree": [((k - 1) // 2, k) for k in range(1, 12)],
    "loop": [(k, (k + 1) % 12) for k in range(12)],
    "ladder": [(k, k + 2) for k in range(10)] + [(k, k + 1) for k in range(0, 12, 2)],
    "full": list(itertools.combinations(range(12), 2)),
}
WIDTHS = {"points": [3], "in a plane": [2], "parts": [6], "mixed": [1, 3, 5, 6, 2, 2]}


def starts_of(widths: list[int]) -> list[int]:
    return np.concatenate([[0], np.cumsum(widths)[:-1]]).tolist()


def random_matrix(widths, pairs, seed, symmetric=False) -> np.ndarray:
    """Random blocks at these pairs, heavy enough on the diagonal to be regular."""
    some, first = np.random.default_rng(seed), starts_of(widths)
    full = np.zeros((sum(widths),) * 2)
    for r, c in pairs:
        block = some.standard_normal((widths[r], widths[c]))
        full[first[r] : first[r] + widths[r], first[c] : first[c] + widths[c]] = block
    if symmetric:
        full = full + full.T
    return full + 4 * np.diag(some.choice((-1.0, 1.0), len(full)) if symmetric else [1] * len(full))


def eliminate(full, widths, pairs, late=None):
    """The plan, and the factor arrays filled with the matrix."""
    pairs = np.array(sorted(set(pairs))).T
    found = analyse(widths, pairs, late or {})
    values = np.zeros(found.size + 1)
    first = starts_of(widths)
    for r, c, at, lead in zip(*pairs, *found.places.locate(*pairs), strict=True):
        for i, j in itertools.product(range(widths[r]), range(widths[c])):
            values[at + i * lead + j] = full[first[r] + i, first[c] + j]
    plan = SimpleNamespace(**found.plan)
    return plan, values, np.zeros(len(full) + 1, dtype=np.int64), np.zeros(max(80, found.room))


def solved(full, widths, pairs, b, late=None) -> np.ndarray:
    plan, values, pivots, work = eliminate(full, widths, pairs, late)
    assert blocks.factor(plan, values, pivots, work)
    x = b.copy()
    blocks.solve(plan, values, pivots, x, np.zeros(len(b)), work)
    return x


def both_ways(edges: list[tuple[int, int]], count: int) -> list[tuple[int, int]]:
    return [*edges, *((c, r) for r, c in edges), *((k, k) for k in range(count))]


@pytest.mark.parametrize("sizes", WIDTHS)
@pytest.mark.parametrize("pattern", PATTERNS)
def test_solutions_of_random_patterns(pattern, sizes):
    """A x = b by blocks and by numpy, unsymmetric."""
    widths = list(itertools.islice(itertools.cycle(WIDTHS[sizes]), 12))
    pairs = both_ways(PATTERNS[pattern], 12)
    full = random_matrix(widths, pairs, 3)
    b = np.random.default_rng(4).standard_normal(len(full))
    x = solved(full, widths, pairs, b)
    np.testing.assert_allclose(x, np.linalg.solve(full, b), rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize("sizes", WIDTHS)
def test_what_nothing_depends_on_adds_no_fill(sizes):
    """A chain of 12, two integrals of all of it, and one of the second of them."""
    widths = list(itertools.islice(itertools.cycle(WIDTHS[sizes]), 15))
    edges = both_ways(PATTERNS["chain"], 12)
    pairs = [*edges, *((k, k) for k in range(12, 15)), (14, 13)]
    pairs += [(row, column) for row in (12, 13) for column in range(12)]
    full = random_matrix(widths, pairs, 5)
    b = np.random.default_rng(6).standard_normal(len(full))
    x = solved(full, widths, pairs, b)
    np.testing.assert_allclose(x, np.linalg.solve(full, b), rtol=1e-8, atol=1e-9)
    both, chain_only = (analyse(widths, np.array(sorted(each)).T, {}) for each in (pairs, edges))
    assert len(both.plan["target"]) == len(chain_only.plan["target"]) == 11
    plan, values, pivots, work = eliminate(full, widths, pairs)
    negative = blocks.signature(plan, values, pivots, work, np.zeros(len(full)), 0.0)
    sign = np.sign(np.linalg.det(full))
    assert (-1) ** negative == sign


def test_small_systems_are_dense_and_pivoted():
    """A zero on every diagonal is no obstacle up to DENSE unknowns."""
    widths = [3] * (DENSE // 3)
    pairs = list(itertools.product(range(len(widths)), repeat=2))
    full = random_matrix(widths, pairs, 5)
    np.fill_diagonal(full, 0.0)
    b = np.arange(1.0, DENSE + 1)
    np.testing.assert_allclose(
        solved(full, widths, pairs, b), np.linalg.solve(full, b), rtol=1e-8, atol=1e-10
    )


def test_the_inverse_of_a_small_matrix():
    """With zeros on the diagonal; unknowns in another order, and one left out, whose row is 0."""
    some, size = np.random.default_rng(8), 7
    full = some.standard_normal((size, size))
    np.fill_diagonal(full, 0.0)
    place = np.array([3, 0, size, 6, 5, 1, 2, 4])  # the third is left out
    plan = SimpleNamespace(size=np.array([size]), place=place, fronts=np.zeros(0))
    A, pivots = np.append(full.ravel(), 0.0), np.zeros(size + 1, dtype=np.int64)
    b = some.standard_normal(size + 1)
    b[2] = 0.0
    x, rooms = b.copy(), [np.zeros(size + 1) for _ in range(2)]
    assert inverse.is_small(plan)
    assert inverse.invert_small(plan, A, pivots)
    inverse.times_small_inverse(plan, A, pivots, x, *rooms)
    live = np.delete(np.arange(size + 1), 2)
    expected = np.linalg.solve(full[np.ix_(place[live], place[live])], b[live])
    np.testing.assert_allclose(x[live], expected, rtol=1e-10)
    assert x[2] == 0.0
    assert not inverse.invert_small(plan, np.zeros(size * size + 1), pivots)
    wide = SimpleNamespace(size=np.array([inverse.SMALL + 1]), fronts=np.zeros(0))
    assert not inverse.is_small(wide)


@pytest.mark.parametrize(("coupled", "nodes"), [(1, 41), (40, 1)])
def test_chains_are_not_dense(coupled: int, nodes: int):
    """Forty masses in a plane and a constraint on the last, each coupled with so many others."""
    pairs = {(r, c) for r in range(40) for c in range(40) if abs(r - c) <= coupled}
    pairs |= {(40, 39), (39, 40), (40, 40)}
    found = analyse([2] * 40 + [1], np.array(sorted(pairs)).T, {40: {39}})
    assert len(found.plan["size"]) == nodes


@pytest.mark.parametrize("count", (4, 9))
def test_joints_are_saddle_points(count):
    """A chain of bodies hinged in pairs: the multipliers' own blocks are zero."""
    widths = [6] * count + [5] * count
    edges = [(count + k, k) for k in range(count)] + [(count + k, k - 1) for k in range(1, count)]
    pairs = both_ways(edges, 2 * count)
    full = random_matrix(widths, pairs, 6, symmetric=True)
    full[6 * count :, 6 * count :] = 0.0
    full[: 6 * count, : 6 * count] = np.kron(np.eye(count), np.diag([3.0, 4, 5, 6, 7, 8]))
    late = {count + k: {k, max(k - 1, 0)} for k in range(count)}
    b = np.random.default_rng(7).standard_normal(len(full))
    x = solved(full, widths, pairs, b, late)
    np.testing.assert_allclose(x, np.linalg.solve(full, b), rtol=1e-7, atol=1e-8)


@pytest.mark.parametrize("pattern", ("chain", "tree", "loop"))
@pytest.mark.parametrize("sizes", WIDTHS)
def test_negative_pivots_are_negative_eigenvalues(pattern, sizes):
    """Sylvester: the signature of a symmetric matrix, by blocks and dense."""
    for count, seed in itertools.product((4, 12), range(3)):
        widths = list(itertools.islice(itertools.cycle(WIDTHS[sizes]), count))
        edges = [e for e in PATTERNS[pattern] if max(e) < count]
        full = random_matrix(widths, both_ways(edges, count), seed, symmetric=True)
        arrays = eliminate(full, widths, both_ways(edges, count))
        found = blocks.signature(*arrays, np.zeros(len(full)), 0.0)
        assert found == (np.linalg.eigvalsh(full) < 0).sum()


@pytest.mark.parametrize("full", (np.diag([2.0, 0.0, -1.0]), np.diag([0.0, 2.0, 1.0])))
def test_a_singular_matrix_has_no_signature(full):
    arrays = eliminate(full, [3], {(0, 0)})
    assert blocks.signature(*arrays, np.zeros(3), 0.0) == -1


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_singular_matrices_are_refused():
    widths = [3] * 13
    pairs = both_ways(PATTERNS["chain"], 13)
    full = random_matrix(widths, pairs, 8)
    for zero in (slice(0, 3), slice(36, 39)):
        broken = full.copy()
        broken[zero] = broken[:, zero] = 0.0
        plan, values, pivots, work = eliminate(broken, widths, pairs)
        assert not blocks.factor(plan, values, pivots, work)


def test_a_chain_has_no_fill():
    """Every place in the factors is a place in the matrix."""
    count = 200
    pairs = both_ways([(k, k + 1) for k in range(count - 1)], count)
    found = analyse([3] * count, np.array(pairs).T, {})
    assert found.size == 9 * len(set(pairs))


@pytest.mark.parametrize("stabilised", (True, False))
@pytest.mark.parametrize("scene", (chain, links))
def test_the_work_grows_like_the_number_of_bodies(scene, stabilised):
    """Block updates and entries of the plan of a hanging chain and of a chain of hinged rods."""
    small, large = (system(scene(n), stabilised) for n in (30, 60))
    for measure in (lambda s: len(s.elimination.plan["target"]), lambda s: s.elimination.LV.size):
        assert measure(large) < 2.2 * measure(small)

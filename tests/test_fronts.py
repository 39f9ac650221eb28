"""Elimination by fronts against scipy: nets, solids, holes, hubs, joints, islands."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import compiled
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

import adamslite as al
from adamslite.equations import elimination_order, frontal_plan
from adamslite.equations.elimination_order import _by_fronts
from adamslite.equations.engine import ints
from adamslite.equations.system import System
from adamslite.integrators.linalg import blocks, complex_blocks, minimum_degree
from adamslite.integrators.linalg.plan import Plan

Edges = list[tuple[int, int]]


def grid(*shape: int) -> tuple[int, Edges]:
    """Points of a net or a solid, each coupled with its neighbours along the axes."""
    number = np.arange(np.prod(shape)).reshape(shape)
    edges: Edges = []
    for axis, count in enumerate(shape):
        near = [np.take(number, range(k, count - 1 + k), axis).ravel().tolist() for k in (0, 1)]
        edges += zip(*near, strict=True)
    return number.size, edges


def holed(size: int, every: int) -> tuple[int, Edges]:
    """A net in which every so many points are missing."""
    count, edges = grid(size, size)
    left = [k for k in range(count) if k % every]
    number = {k: n for n, k in enumerate(left)}
    return len(left), [(number[a], number[b]) for a, b in edges if a in number and b in number]


def star(rays: int) -> tuple[int, Edges]:
    """One node in the middle, coupled with all others."""
    return rays + 1, [(rays // 2, k) for k in range(rays + 1) if k != rays // 2]


def islands(size: int) -> tuple[int, Edges]:
    """Two nets that nothing couples, and a node alone."""
    count, edges = grid(size, size)
    return 2 * count + 1, edges + [(a + count, b + count) for a, b in edges]


def wild(count: int) -> tuple[int, Edges]:
    """Random couplings, three for each node."""
    ends = np.random.default_rng(8).integers(0, count, (3 * count, 2)).tolist()
    return count, [(a, b) for a, b in ends if a != b]


PATTERNS = {
    "net": grid(17, 23), "solid": grid(7, 8, 9), "holes": holed(20, 7), "star": star(300),
    "islands": islands(9), "wild": wild(150), "chain": grid(90), "full": wild(40), "point": (1, []),
    "none": (12, []),
}  # fmt: skip


class Matrix:
    """Random blocks at all couplings, heavy on the diagonal, and the plan by fronts."""

    def __init__(self, count: int, edges: Edges, widths: list[int], late=None) -> None:
        self.widths = np.array(widths)
        self.starts = np.cumsum(self.widths) - self.widths
        both = {*edges, *((b, a) for a, b in edges), *((k, k) for k in range(count))}
        self.pairs = np.array(sorted(both)).T
        some = np.random.default_rng(5)
        self.blocks = [
            some.standard_normal((widths[r], widths[c]))
            + (r == c) * 9 * np.eye(widths[r], widths[c])
            for r, c in self.pairs.T.tolist()
        ]
        self.found = _by_fronts(widths, self.pairs, late or {})
        self.n = int(self.widths.sum())

    def sparse(self):
        """The matrix (n, n)."""
        rows, columns, values = [], [], []
        for (r, c), block in zip(self.pairs.T.tolist(), self.blocks, strict=True):
            i, j = np.indices(block.shape)
            rows.append((self.starts[r] + i).ravel())
            columns.append((self.starts[c] + j).ravel())
            values.append(block.ravel())
        entries = [np.concatenate(each) for each in (values, rows, columns)]
        return coo_array((entries[0], (entries[1], entries[2])), shape=(self.n, self.n)).tocsc()

    def factors(self, step: int = 1) -> np.ndarray:
        """The array of the factors with the blocks in it, every ``step`` numbers."""
        values = np.zeros(step * (self.found.size + 1))
        where = self.found.places.locate(*self.pairs)
        for block, at, lead in zip(self.blocks, *where, strict=True):
            i, j = np.indices(block.shape)
            values[step * (at + i * lead + j)] = block
        return values

    @property
    def plan(self) -> Plan:
        made = Plan.zeros()
        for name, value in self.found.plan.items():
            setattr(made, name, value)
        return made

    def room(self) -> tuple[np.ndarray, np.ndarray]:
        """Pivots and workspace."""
        return ints([0] * (self.n + 1)), np.zeros(2 * self.found.room + 200)


def widths_of(kind: str, count: int) -> list[int]:
    sizes = {"points": [3], "parts": [6], "mixed": [1, 3, 5, 6, 2]}[kind]
    return [sizes[k % len(sizes)] for k in range(count)]


@pytest.mark.parametrize("kind", ("points", "parts", "mixed"))
@pytest.mark.parametrize("pattern", PATTERNS)
def test_solutions_are_those_of_scipy(pattern: str, kind: str) -> None:
    """A x = b, unsymmetric; the engine's functions run as plain Python and call the native code."""
    count, edges = PATTERNS[pattern]
    matrix = Matrix(count, edges, widths_of(kind, count))
    plan, factors, (pivots, work) = matrix.plan, matrix.factors(), matrix.room()
    assert blocks.factor(plan, factors, pivots, work)
    b = np.random.default_rng(6).standard_normal(matrix.n)
    x = b.copy()
    blocks.solve(plan, factors, pivots, x, np.zeros(matrix.n + 1), work)
    np.testing.assert_allclose(x, spsolve(matrix.sparse(), b), rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize("pattern", ("net", "holes", "star", "islands"))
def test_complex_solutions_are_those_of_scipy(pattern: str) -> None:
    """The real blocks with one imaginary unit more on the diagonal."""
    count, edges = PATTERNS[pattern]
    matrix = Matrix(count, edges, widths_of("mixed", count))
    plan, factors, (pivots, work) = matrix.plan, matrix.factors(2), matrix.room()
    at, lead = matrix.found.places.locate(*matrix.pairs)
    own = matrix.pairs[0] == matrix.pairs[1]
    for width, first, row in zip(matrix.widths, at[own], lead[own], strict=True):
        factors[2 * (first + np.arange(width) * (row + 1)) + 1] = 1.0
    assert complex_blocks.factor_complex(plan, factors, pivots, work)
    b = np.random.default_rng(6).standard_normal(2 * matrix.n)
    x = b.copy()
    complex_blocks.solve_complex(plan, factors, pivots, x, np.zeros(2 * matrix.n + 2), work)
    whole = matrix.sparse() + 1j * coo_array(np.eye(matrix.n))
    found = spsolve(whole.tocsc(), b[::2] + 1j * b[1::2])
    np.testing.assert_allclose(x[::2] + 1j * x[1::2], found, rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize("pattern", ("net", "holes", "wild", "chain"))
def test_negative_pivots_are_negative_eigenvalues(pattern: str) -> None:
    """Sylvester: the signature of a symmetric matrix with heavy diagonals of both signs."""
    count, edges = PATTERNS[pattern]
    matrix = Matrix(count, edges, widths_of("mixed", count))
    signs = iter(np.random.default_rng(3).choice((-9.0, 9.0), matrix.n))
    at = {pair: k for k, pair in enumerate(map(tuple, matrix.pairs.T.tolist()))}
    for (r, c), k in at.items():
        if r < c:
            matrix.blocks[at[c, r]] = matrix.blocks[k].T
        elif r == c:
            half = matrix.blocks[k] - 9 * np.eye(len(matrix.blocks[k]))
            matrix.blocks[k] = half + half.T + np.diag([next(signs) for _ in half])
    pivots, work = matrix.room()
    found = np.zeros(matrix.n + 1)
    negative = blocks.signature(matrix.plan, matrix.factors(), pivots, work, found, 0.0)
    assert negative == (np.linalg.eigvalsh(matrix.sparse().toarray()) < 0).sum()


@pytest.mark.parametrize("node", (0, 40, 80))
def test_singular_matrices_are_refused(node: int) -> None:
    """A node whose rows and columns are zero."""
    count, edges = grid(9, 9)
    matrix = Matrix(count, edges, widths_of("points", count))
    for (r, c), block in zip(matrix.pairs.T.tolist(), matrix.blocks, strict=True):
        block *= node not in (r, c)
    assert not blocks.factor(matrix.plan, matrix.factors(), *matrix.room())
    assert not complex_blocks.factor_complex(matrix.plan, matrix.factors(2), *matrix.room())
    pivots, work = matrix.room()
    found = np.zeros(matrix.n + 1)
    assert blocks.signature(matrix.plan, matrix.factors(), pivots, work, found, 0.0) == -1


def test_multipliers_wait_for_their_bodies() -> None:
    """A net of parts, hinged to each other along a few rows: the blocks of multipliers are zero."""
    bodies, edges = grid(12, 12)
    joints = [(k, k + 1) for k in range(0, bodies - 1, 7)]
    late = {bodies + n: {a, b} for n, (a, b) in enumerate(joints)}
    edges = edges + [(bodies + n, each) for n, pair in enumerate(joints) for each in pair]
    widths = [6] * bodies + [5] * len(joints)
    matrix = Matrix(bodies + len(joints), edges, widths, late)
    for (r, c), block in zip(matrix.pairs.T.tolist(), matrix.blocks, strict=True):
        block *= r < bodies or c < bodies
    order = np.argsort(matrix.found.places.place).tolist()
    assert all(order.index(k) > order.index(b) for k, before in late.items() for b in before)
    factors, (pivots, work) = matrix.factors(), matrix.room()
    assert blocks.factor(matrix.plan, factors, pivots, work)
    b = np.ones(matrix.n)
    x = b.copy()
    blocks.solve(matrix.plan, factors, pivots, x, np.zeros(matrix.n + 1), work)
    np.testing.assert_allclose(x, spsolve(matrix.sparse(), b), rtol=1e-7, atol=1e-8)


def test_nodes_that_wait_for_each_other_are_placed_all_the_same() -> None:
    count, edges = grid(6, 6)
    matrix = Matrix(count, edges, [3] * count, {4: {5}, 5: {4}, 9: {4, 20}, 20: {9}})
    assert sorted(np.argsort(matrix.found.places.place).tolist()) == [*range(count)]


def test_the_order_is_the_same_as_plain_python(monkeypatch: pytest.MonkeyPatch) -> None:
    """The native function, and itself as Python, which has to compress its lists on the way."""
    count, edges = grid(15, 15)
    row, column = np.array(sorted({*edges, *((b, a) for a, b in edges)})).T
    given = np.full(count, 3), row, column, {7: {30, 31}}
    native = frontal_plan._least_degree(*given)
    monkeypatch.setattr(frontal_plan, "SPARE", 1)
    compressed = []
    whole = minimum_degree.compress

    def compress(graph: minimum_degree.Graph) -> None:
        compressed.append(graph.free)
        whole(graph)

    monkeypatch.setattr(minimum_degree, "compress", compress)
    monkeypatch.setattr(
        frontal_plan, "_call", lambda name, graph: minimum_degree.minimum_degree(graph)
    )
    assert frontal_plan._least_degree(*given).tolist() == native.tolist()
    assert compressed


def test_a_net_fills_little() -> None:
    """No more than 31/4 n log2 n blocks in the lower factor (George, 1973), with the zeros that
    fronts have: 60 x 60 points.
    """
    count, edges = grid(60, 60)
    matrix = Matrix(count, edges, [1] * count)
    assert matrix.found.size < 2 * 7.75 * count * np.log2(60)


def net(size: int, more: str = "") -> str:
    """A net of point masses on springs, held at one side, under its weight."""
    lines = ["a net", "PART/1, GROUND", "ACCGRAV/KGRAV=-9.81"]
    for i in range(size):
        for j in range(size):
            k = 2 + i * size + j
            lines.append(f"POINT_MASS/{k}, MASS=0.1, CM={k}, QG={i + 1},{j},0" if i else "")
            lines.append(f"MARKER/{k}, POINT_MASS={k}" if i else f"MARKER/{k}, PART=1, QP=1,{j},0")
            for other in (k - size, k - 1):
                if i and (other == k - size or j):
                    lines.append(
                        f"SPRINGDAMPER/{len(lines)}, TRANSLATIONAL, I={k}, J={other}, K=500, C=0.2,"
                        " LENGTH=0.9"
                    )
    return "\n".join([*filter(None, lines), more, "END", ""])


GROWING = r"""MARKER/9001, PART=1, FLOATING
VFORCE/1, I=200, JFLOAT=9001, FX=-0.05*ACCX(200)\ FY=-0.05*ACCY(200)\ FZ=-0.05*ACCZ(200)"""


@pytest.mark.parametrize(
    ("method", "more"), [("GSTIFF", ""), ("HHT", ""), ("RADAU", ""), ("GSTIFF", GROWING)]
)
def test_a_net_moves_the_same_by_fronts_and_by_blocks(
    method: str, more: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """15 x 15 points for 0.1 s; once more with blocks that may have any number of updates.

    With ``GROWING``, a force adds mass to one of them: accelerations are coupled.
    """
    run = {"end": 0.1, "steps": 2, "integrator": method, "error": 1e-6}
    kernels = compiled(net(15, more))
    assert System(kernels, False).elimination.plan["fronts"].size > 1
    by_fronts = al.simulate(kernels, **run)
    monkeypatch.setattr(elimination_order, "UPDATES", np.inf)
    kernels.shared.clear()
    by_blocks = al.simulate(kernels, **run)
    assert System(kernels, False).elimination.plan["fronts"].size == 0
    assert by_fronts.summary["newton"] == by_blocks.summary["newton"]
    np.testing.assert_allclose(by_fronts.values, by_blocks.values, rtol=1e-9, atol=1e-9)


def rigid(size: int) -> str:
    """A net of parts on bushings; some are hinged to the next instead, in closed loops too."""
    lines = ["a net of parts", "PART/1, GROUND", "ACCGRAV/KGRAV=-9.81"]
    for i in range(1, size):
        for j in range(size):
            k = 2 + i * size + j
            lines.append(f"PART/{k}, MASS=0.1, CM={k}, IP=0.002,0.003,0.004, QG={i},{j},0")
            lines.append(f"MARKER/{k}, PART={k}")
            for n, (di, dj) in enumerate(((1, 0), (0, 1))):
                if j < dj:
                    continue
                there = f"PART={k - di * size - dj}, QP={di / 2},{dj / 2},0"
                if i == di:
                    there = f"PART=1, QP=0.5,{j},0"
                a, b = 1000 + 4 * k + 2 * n, 1001 + 4 * k + 2 * n
                lines.append(f"MARKER/{a}, PART={k}, QP={-di / 2},{-dj / 2},0")
                lines.append(f"MARKER/{b}, {there}")
                law = "K=800,800,800, KT=5,5,5, C=0.4,0.4,0.4, CT=0.005,0.005,0.005"
                if i == 2 and (dj or j % 2 == 0):
                    lines.append(f"JOINT/{2 * k + n}, SPHERICAL, I={a}, J={b}")
                else:
                    lines.append(f"BUSHING/{2 * k + n}, I={a}, J={b}, {law}")
    return "\n".join([*lines, "END", ""])


@pytest.mark.parametrize("method", ("GSTIFF", "RADAU", "HHT", "STATICS"))
def test_joints_in_a_net_are_the_same_by_fronts_and_by_blocks(
    method: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Multipliers, also of closed loops, and with them the signs of pivots at rest."""
    run = {"end": 0.02, "steps": 2, "integrator": method, "error": 1e-6}
    deck = rigid(5)
    if method == "STATICS":
        run, deck = {}, deck.replace("END", "SIMULATE/STATICS\nEND")
    kernels = compiled(deck)
    by_blocks = al.simulate(kernels, **run)
    assert System(kernels, True).elimination.plan["fronts"].size == 0
    monkeypatch.setattr(elimination_order, "UPDATES", -np.inf)
    kernels.shared.clear()
    by_fronts = al.simulate(kernels, **run)
    assert System(kernels, True).elimination.plan["fronts"].size > 1
    assert by_fronts.summary["newton"] == by_blocks.summary["newton"]
    np.testing.assert_allclose(by_fronts.values, by_blocks.values, rtol=1e-7, atol=1e-7)


def test_results_of_a_net_are_its_record() -> None:
    """Tables of large models are not copied."""
    results = al.simulate(net(3), end=0.1, steps=2)
    assert not results.values.flags.owndata
    assert results["POINT_MASS/5.z"].tolist() != [0.0, 0.0, 0.0]
    assert results.time.tolist() == [0.0, 0.05, 0.1]

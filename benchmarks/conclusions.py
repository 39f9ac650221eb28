"""What the tables of measured figures amount to, in sentences and small tables (Markdown)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from statistics import median

from benchmarks import hard_cases
from benchmarks.figures import Figure
from benchmarks.growth import FROM, exponent
from benchmarks.points import Row
from benchmarks.same_method import NAMES, SUFFIX
from benchmarks.scenes import SCALING
from benchmarks.tables import (
    PEERS,
    TARGETS,
    by_scene,
    cheapest,
    milliseconds,
    named,
    short,
    table,
    tried,
)

#: The accuracy of the one-line comparison of each scene [m or rad].
MIDDLE = 1e-5


def conclusions(
    rows: Sequence[Row], single: Sequence[Figure], cells: Sequence[hard_cases.Cell]
) -> str:
    """One item for each part that was measured."""
    parts = (_peers(rows), _methods(rows), _equal_steps(rows), _growth(rows), _cases(cells),
             _bounds(single))  # fmt: skip
    return "".join(f"- {sentence}\n" for part in parts for sentence in part)


def _contests(rows: Iterable[Row]) -> Iterator[tuple[Row | None, Row | None, Row | None]]:
    """Cheapest of ours, of the implicit and of all peers, wherever some program met a target."""
    for _, _, mine in by_scene(rows):
        for target in TARGETS:
            found = tuple(cheapest(mine, target, k) for k in (("ours",), ("implicit",), PEERS))
            if any(found):
                yield found


def _peers(rows: Sequence[Row]) -> Iterator[str]:
    """How ours compares with the best of the others."""
    contests = list(_contests(rows))
    if not contests or not tried(rows, PEERS):
        return
    reached = sum(own is not None for own, _, _ in contests)
    alone = sum(own is not None and best is None for own, _, best in contests)
    yield (
        f"**Reach.** Of {len(contests)} combinations of scene and accuracy that any program "
        f"reached, adamslite reached {reached}; no other program reached {alone} of these."
    )
    for kind, which in (("implicit program", 1), ("program of any kind", 2)):
        ratios = [c[which].cpu_median / c[0].cpu_median for c in contests if c[0] and c[which]]
        if ratios:
            yield (
                f"**Cost.** The best other {kind} takes {min(ratios):.2g} to {max(ratios):.2g} "
                f"times the CPU of adamslite; the median of {len(ratios)} is {median(ratios):.2g}."
            )


def _methods(rows: Sequence[Row]) -> Iterator[str]:
    """Which integrators are the cheapest, and how often."""
    first = Counter(short(own.program) for own, _, _ in _contests(rows) if own)
    if first:
        counts = ", ".join(f"{name} {count}" for name, count in first.most_common())
        yield f"**Methods.** The cheapest integrator of adamslite is {counts} times."


def _equal_steps(rows: Sequence[Row]) -> Iterator[str]:
    """Ours over the hand-coded limit and over the peer, at the same number of steps."""
    cost = {(r.scene, r.n, r.program): r.cpu_median for r in rows
            if r.scene.endswith(SUFFIX) and r.ok}  # fmt: skip
    ours, limit, peer = NAMES
    ratios = [
        [mine / cost[scene, n, other] for (scene, n, name), mine in cost.items()
         if name == ours and (scene, n, other) in cost]
        for other in (limit, peer)
    ]  # fmt: skip
    if all(ratios):
        (low, high), (least, most) = ((min(r), max(r)) for r in ratios)
        yield (
            f"**Work.** With the same method and the same steps adamslite takes {low:.2g} to "
            f"{high:.2g} times the CPU of hand-coded C, and {least:.2g} to {most:.2g} times that "
            "of Exudyn."
        )


def _growth(rows: Sequence[Row]) -> Iterator[str]:
    """The range of exponents of ours."""
    mine = [r for r in rows if r.scene in SCALING and r.kind == "ours"]
    found = {name: exponent(r for r in mine if r.program == name) for name in _names(mine)}
    known = [e for e in found.values() if e is not None]
    if known:
        most = max(r.n for r in mine if r.ok)
        yield (
            f"**Growth.** CPU per step grows with the number of masses N as N^{min(known):.2f} to "
            f"N^{max(known):.2f}, depending on the integrator, from N = {FROM} to {most}."
        )


def _names(rows: Iterable[Row]) -> list[str]:
    return list(dict.fromkeys(r.program for r in rows))


def _cases(cells: Sequence[hard_cases.Cell]) -> Iterator[str]:
    """The counts of the matrix."""
    if cells:
        yield f"**Hard cases.** Of {len(cells)} runs of hard cases {hard_cases.counts(cells)}."


def _bounds(single: Sequence[Figure]) -> Iterator[str]:
    """Figures beyond their bounds, if there are any."""
    bound = [f for f in single if f.bound is not None]
    over = [f"{f.what} ({f.value:.3g} {f.unit}, bound {f.bound:g})" for f in bound
            if f.value > f.bound]  # fmt: skip
    if bound:
        yield (
            f"**Start and memory.** {len(bound) - len(over)} of {len(bound)} figures are within "
            f"their bounds{'; beyond them: ' + ', '.join(over) if over else ''}."
        )


def scenes(rows: Sequence[Row], target: float = MIDDLE) -> str:
    """The cheapest of ours and of all others at one accuracy: one line for each scene."""
    body = []
    for scene, n, mine in by_scene(rows):
        own, best = cheapest(mine, target, ("ours",)), cheapest(mine, target, PEERS)
        if own or best:
            ratio = f"{best.cpu_median / own.cpu_median:.2g}" if own and best else "-"
            others = _cost(best) if tried(mine, PEERS) else ("not measured", "-")
            body.append([named(scene, n), *_cost(own), *others, ratio])
    head = ("scene", "adamslite", "CPU ms", "best other program", "CPU ms", "ratio")
    return table(head, body) if body else ""


def _cost(found: Row | None) -> tuple[str, str]:
    return (short(found.program), milliseconds(found.cpu_median)) if found else ("none", "-")


def cases(cells: Sequence[hard_cases.Cell]) -> str:
    """The hard cases of each integrator, counted by how they ended."""
    body = []
    for name in dict.fromkeys(cell.integrator for cell in cells):
        own = [cell for cell in cells if cell.integrator == name]
        passed = [cell for cell in own if cell.verdict == hard_cases.PASSED]
        at_once = sum(cell.share == cell.first for cell in passed)
        before = sum(cell.rejected_before for cell in own)
        ended = sum(cell.verdict == hard_cases.STOPPED for cell in own) - before
        rest = (hard_cases.REPORTED, hard_cases.SLOW, hard_cases.SILENT)
        others = [sum(cell.verdict == verdict for cell in own) for verdict in rest]
        counts = (at_once, len(passed) - at_once, before, ended, *others)
        body.append([name, *(str(count) for count in counts)])
    head = ("integrator", "inside at once", "inside at a smaller ERROR", "rejected before the run",
            "ended early", "outside, reported", "too slow", "outside, not reported")  # fmt: skip
    return table(head, body) if body else ""

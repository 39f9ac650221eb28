"""What was measured, as tables to read (Markdown)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from itertools import groupby

from benchmarks.figures import Figure
from benchmarks.growth import exponent
from benchmarks.mechanisms import WATCHED
from benchmarks.points import Row
from benchmarks.same_method import NAMES, SUFFIX
from benchmarks.scenes import SCALING, parameters

KINDS = ("ours", "implicit", "explicit", "limit")
PEERS = ("implicit", "explicit")
TARGETS = (1e-3, 1e-5, 1e-7)
INCOMPLETE = """
\\* The time was up before every setting of every program had its turn: others may have done better
than is shown.
"""


def milliseconds(seconds: float | None) -> str:
    """Three digits."""
    if seconds is None:
        return "-"
    return f"{1e3 * seconds:.3g}" if seconds < 1 else f"{1e3 * seconds:.0f}"


def table(head: Sequence[str], body: Iterable[Sequence[str]]) -> str:
    """Cells with bars."""
    lines = [head, ["---"] * len(head), *body]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def by_scene(rows: Iterable[Row]) -> list[tuple[str, int, list[Row]]]:
    """Rows of each scene and N that have a work-precision chart, in the order of the scenes."""
    order = [*parameters(), *WATCHED]
    mine = sorted((r for r in rows if r.scene in order), key=lambda r: (order.index(r.scene), r.n))
    return [(*key, list(group)) for key, group in groupby(mine, key=lambda r: (r.scene, r.n))]


def named(scene: str, n: int) -> str:
    """A scene and its N, if it has one."""
    return f"{scene} N={n}" if "N" in parameters().get(scene, {}) else scene


def cheapest(rows: Iterable[Row], target: float, kinds: Sequence[str]) -> Row | None:
    """The cheapest row of some kinds of programs that meets a target."""
    met = [r for r in rows if r.kind in kinds and r.meets(target)]
    return min(met, key=lambda r: r.cpu_median, default=None)


def summary(rows: Iterable[Row], targets: Sequence[float] = TARGETS) -> str:
    """Ours against the best implicit peer and the best of any kind, at every target."""
    body = []
    for scene, n, mine in by_scene(rows):
        for target in targets:
            own = cheapest(mine, target, ("ours",))
            rivals = [_against(own, mine, target, kinds) for kinds in (("implicit",), PEERS)]
            if any(r.meets(target) for r in mine):
                incomplete = "*" if any(r.missed for r in mine) else ""
                where = f"{named(scene, n)}{incomplete}"
                body.append([where, f"{target:g}", *_cell(own), *rivals[0], *rivals[1]])
    head = ("scene", "error <=", "ours", "CPU ms", "best implicit peer", "times ours",
            "best peer", "times ours")  # fmt: skip
    note = "" if not any("*" in line[0] for line in body) else INCOMPLETE
    return table(head, body) + note if body else ""


def _cell(own: Row | None) -> tuple[str, str]:
    if own is None:
        return "not reached", "-"
    return f"{short(own.program)} {own.setting}", milliseconds(own.cpu_median)


def _against(
    own: Row | None, mine: Sequence[Row], target: float, kinds: Sequence[str]
) -> tuple[str, str]:
    """The best of some kinds and its CPU over ours; a program without a turn did not fail."""
    rival = cheapest(mine, target, kinds)
    if rival is None:
        return ("none got there" if tried(mine, kinds) else "not measured"), "-"
    shown = f"{short(rival.program)} {milliseconds(rival.cpu_median)} ms"
    return shown, f"{rival.cpu_median / own.cpu_median:.2g}" if own else "-"


def tried(rows: Iterable[Row], kinds: Sequence[str]) -> list[Row]:
    """The rows of programs of some kinds that had a turn."""
    return [r for r in rows if r.kind in kinds and not r.missed]


def short(program: str) -> str:
    """The name without what a reader knows from the table."""
    return program.removeprefix("adamslite ").removesuffix(", mechanism")


def programs(mine: Sequence[Row], targets: Sequence[float] = TARGETS) -> str:
    """Cheapest CPU of every program at every target: one scene, one N."""
    names = sorted({(KINDS.index(r.kind), r.program) for r in mine})
    body = []
    for _, name in names:
        own = [r for r in mine if r.program == name]
        kind = own[0].kind
        best = [cheapest(own, target, (kind,)) for target in targets]
        cells = [milliseconds(b.cpu_median) if b else "-" for b in best]
        setups = [r.setup for r in own if r.setup is not None]
        peaks = [r.peak for r in own if r.peak is not None]
        body.append(
            [short(name), kind, *cells, milliseconds(min(setups, default=None)),
             f"{max(peaks):.0f}" if peaks else "-", _remark(own, best)]
        )  # fmt: skip
    head = ("program", "kind", *(f"to {t:g}" for t in targets), "set-up", "peak MB", "remark")
    return table(head, body)


def _remark(own: Sequence[Row], best: Sequence[Row | None]) -> str:
    """Why the tightest target was not met."""
    if best[-1] or not own:
        return ""
    last = own[-1]
    if last.reason:
        words = last.reason.partition(". ")[0].replace("UsageError: ", "")
        return f"{last.setting}: {words}".replace("|", "/")
    if last.error is None:
        return "no reference"
    return f"{last.setting}: {last.error:.1e} in {milliseconds(last.cpu_median)} ms"


def errors_of_ours(mine: Sequence[Row]) -> str:
    """S4: error, energy drift and cost of every integrator of ours at every ERROR."""
    body = [
        [short(r.program), r.setting, f"{r.error:.1e}", f"{r.drift:.1e}",
         milliseconds(r.cpu_median)]
        if r.ok and r.error is not None and r.drift is not None
        else [short(r.program), r.setting, _ending(r.reason), "-", "-"]
        for r in mine if r.kind == "ours"
    ]  # fmt: skip
    return table(("integrator", "setting", "error rad", "energy drift", "CPU ms"), body)


def _ending(reason: str) -> str:
    """Why there is no result, without the details of the last step."""
    first = reason.partition(". ")[0].removeprefix("UsageError: ")
    when = re.search(r"at t = ([-+.\de]+)", first)
    return f"ended early at t = {when[1].rstrip('.')}" if when else first


def equal_steps(rows: Iterable[Row]) -> str:
    """The same method at the same number of steps: ours, the C limit, Exudyn."""
    found = {(r.scene, r.n, r.program): r for r in rows if r.scene.endswith(SUFFIX) and r.ok}
    body = []
    for scene, n in dict.fromkeys((s, n) for s, n, _ in found):
        ours, limit, peer = (found.get((scene, n, name)) for name in NAMES)
        if ours is None:
            continue
        ratios = [f"{ours.cpu_median / r.cpu_median:.2g}" if r else "-" for r in (limit, peer)]
        errors = [f"{r.error:.1e}" if r and r.error else "-" for r in (ours, limit, peer)]
        costs = [milliseconds(r.cpu_median) if r else "-" for r in (ours, limit, peer)]
        body.append(
            [f"{scene.removesuffix(SUFFIX)} N={n}", str(ours.steps), *costs, *ratios, *errors]
        )
    head = ("scene", "steps", "ours ms", "C ms", "Exudyn ms", "ours / C", "ours / Exudyn",
            "error ours", "error C", "error Exudyn")  # fmt: skip
    return table(head, body) if body else ""


def growth(rows: Iterable[Row]) -> str:
    """CPU per step at every N, and the exponent."""
    mine = [r for r in rows if r.scene in SCALING and r.ok and r.steps]
    sizes = sorted({r.n for r in mine})
    body = []
    for name in dict.fromkeys(r.program for r in mine):
        own = {r.n: r for r in mine if r.program == name}
        costs = [
            f"{1e6 * own[n].cpu_median / own[n].steps:.3g}" if n in own else "-" for n in sizes
        ]
        grown = exponent(own.values())
        body.append([name, *costs, "-" if grown is None else f"{grown:.2f}"])
    return table(("program", *(f"N={n}" for n in sizes), "exponent"), body) if body else ""


def single(figures: Iterable[Figure]) -> str:
    """Figures with their bounds, group by group."""
    body = [
        [f.group, f.what, f"{f.value:.3g} {f.unit}", "" if f.bound is None else f"{f.bound:g}"]
        for f in figures
    ]
    return table(("", "", "measured", "bound"), body) if body else ""

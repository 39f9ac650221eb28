"""CPU and memory of reading hostile texts, and how they grow: `python -m benchmarks.reading`.

Every text is read in a process of its own, with limits of CPU and memory.  Imports are included in
memory and not in CPU.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from itertools import product
from pathlib import Path
from time import process_time
from typing import NamedTuple

from benchmarks.hostile_files import FILES
from benchmarks.hostile_texts import BODIES, BYTES, KINDS

LINES = {"one": False, "many": True}
MEGABYTE = 1 << 20
#: Exit codes of the command line that are no fault.
FINE = (0, 1, 3, 5)


class Case(NamedTuple):
    """One text, read in one way."""

    way: str
    kind: str
    lines: str
    size: float


class Cost(NamedTuple):
    """CPU [s], memory [MB] at most, characters written; ``fault`` where it did not end well."""

    cpu: float = math.inf
    memory: float = math.inf
    written: int = 0
    fault: str = ""


# ---- ways of reading -----------------------------------------------------------------------------


def _command_line(*words: str) -> Callable[[Path], int]:
    def run(path: Path) -> int:
        from adamslite.cli.main import main

        return main([*words, str(path)])

    return run


def _read(path: Path) -> int:
    import adamslite as al

    try:
        al.read(path)
    except al.DeckError as fault:
        str(fault)
    return 0


def _commands(path: Path) -> int:
    """The text as a command file."""
    import adamslite as al
    from adamslite.reading.read import read_commands

    deck = al.read(BODIES)
    try:
        read_commands(path, deck)
    except al.DeckError as fault:
        str(fault)
    return 0


def _edit(path: Path) -> int:
    """Opened in an editor, and one letter typed."""
    from adamslite.editing.document import Document
    from adamslite.editing.positions import Positions
    from adamslite.language.text import decoded

    text = decoded(path.read_bytes())
    document = Document(path, "deck")
    for each in (text, text[:-5] + " " + text[-5:]):
        content = document.update(each)
        positions = Positions(content, "utf-16")
        for diagnostic in content.diagnostics:
            for place in diagnostic.everywhere:
                positions.range_of(place)
    return 0


def _names(path: Path) -> int:
    return _command_line("names")(path)


def _results(path: Path) -> int:
    """As a file of results of its suffix."""
    from adamslite.errors import FormatError
    from adamslite.results.formats import format_of

    read = format_of(path, to_read=True).read
    assert read is not None
    try:
        read(path)
    except FormatError as fault:
        str(fault)
    return 0


WAYS: dict[str, Callable[[Path], int]] = {
    "check": _command_line("check"),
    "json": _command_line("check", "--format=json"),
    "read": _read,
    "commands": _commands,
    "edit": _edit,
    "names": _names,
    "fmt": _command_line("fmt", "--check"),
    "cable": _command_line("cable", "--no-trial"),
    "results": _results,
    "diff": lambda path: _command_line("diff", str(path))(path),
}


def measured(way: str, path: Path) -> Cost:
    """One way on a file, in this process."""
    from benchmarks.memory import peak

    small = path.parent / f"small{path.suffix}"
    kind = next(
        (each for each in FILES.values() if (each.way, each.suffix) == (way, path.suffix)), None
    )
    small.write_bytes(kind.data(1000) if kind else BODIES.encode())
    out, err = StringIO(), StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        WAYS[way](small)
        out.truncate(0), err.truncate(0)
        began = process_time()
        code = WAYS[way](path)
    fault = "" if code in FINE else f"exit code {code}: {err.getvalue()[-300:]}"
    return Cost(process_time() - began, peak(), len(out.getvalue()) + len(err.getvalue()), fault)


# ---- in processes of their own -------------------------------------------------------------------


def text_of(case: Case) -> bytes:
    """The bytes of the file of a case."""
    size = int(case.size * MEGABYTE)
    if case.kind in FILES:
        return FILES[case.kind].data(size)
    if case.kind in BYTES:
        return BYTES[case.kind](size)
    return KINDS[case.kind].data(size, LINES[case.lines])


def cost(case: Case, cpu: int, memory: int) -> Cost:
    """What a case takes, with limits of CPU [s] and memory [MB]."""

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (cpu, cpu + 1))
        resource.setrlimit(resource.RLIMIT_AS, (memory * MEGABYTE, memory * MEGABYTE))

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "cable.toml" if case.way == "cable" else "deck.adm")
        path = path.with_suffix(".csv") if case.way == "diff" else path
        path = path.with_suffix(FILES[case.kind].suffix) if case.kind in FILES else path
        path.write_bytes(text_of(case))
        done = subprocess.run(
            [sys.executable, "-m", "benchmarks.reading", "--file", case.way, str(path)],
            preexec_fn=limited, capture_output=True, text=True, check=False,
            env={**os.environ, "ADAMSLITE_CACHE": os.environ.get("ADAMSLITE_CACHE", folder)},
        )  # fmt: skip
    if done.returncode:
        last = (done.stderr.strip().splitlines() or [f"signal {-done.returncode}"])[-1]
        return Cost(fault=f"{last[:100]} (code {done.returncode})")
    return Cost(**json.loads(done.stdout.splitlines()[-1]))


def exponent(costs: list[tuple[float, Cost]]) -> float:
    """The power of the size that CPU grows with, from the last two sizes that were measured."""
    known = [(size, each.cpu) for size, each in costs if each.cpu < math.inf]
    if len(known) < 2:
        return math.nan
    (a, x), (b, y) = known[-2:]
    return math.log(max(y, 1e-3) / max(x, 1e-3)) / math.log(b / a)


def row(way: str, kind: str, lines: str, args: argparse.Namespace) -> list[tuple[float, Cost]]:
    """A row of the table, size by size until one does not end within its limits."""
    found: list[tuple[float, Cost]] = []
    for size in args.sizes:
        found.append((size, cost(Case(way, kind, lines, size), args.cpu, args.memory)))
        if found[-1][1].cpu == math.inf:
            break
    return found


def told(name: str, found: list[tuple[float, Cost]], args: argparse.Namespace) -> str:
    """A row as text."""
    last = found[-1][1]
    columns = [f"{each.cpu:8.2f}" for _, each in found] + ["       -"] * (
        len(args.sizes) - len(found)
    )
    most = f"{last.memory:6.0f}" if last.memory < math.inf else "     -"
    bad = " <-" if last.fault or last.cpu > args.within or last.memory > args.below else ""
    return (
        f"{name:60}{''.join(columns)} {most} {exponent(found):5.1f} {last.written:9d}{bad} "
        f"{last.fault}"
    )


def cases(args: argparse.Namespace) -> Iterator[tuple[str, str, str]]:
    """What the command line requests."""
    every = (*KINDS, *BYTES, *FILES)
    wanted = [kind for kind in every if not args.kind or any(word in kind for word in args.kind)]
    for way, kind, lines in product(args.way, wanted, args.lines):
        if kind in KINDS or (kind in BYTES and lines == args.lines[0]):
            yield way, kind, lines
    for kind in wanted if args.files else ():
        if kind in FILES:
            yield FILES[kind].way, kind, args.lines[0]


def arguments(argv: Iterable[str] | None = None) -> argparse.Namespace:
    """Ways, kinds and sizes."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.reading", description=__doc__)
    parser.add_argument("--file", nargs=2, metavar=("WAY", "FILE"), help="one file, in here")
    parser.add_argument("--way", nargs="+", choices=WAYS, default=["check"])
    parser.add_argument("--kind", nargs="+", help="kinds with one of these in their name")
    parser.add_argument(
        "--files", action="store_true", help="also command files, descriptions and results"
    )
    parser.add_argument("--lines", nargs="+", choices=LINES, default=list(LINES))
    parser.add_argument("--sizes", nargs="+", type=float, default=[0.25, 0.5, 1.0], metavar="MB")
    parser.add_argument("--cpu", type=int, default=20, help="CPU [s] that a text may take (20)")
    parser.add_argument("--memory", type=int, default=3000, help="address space [MB] (3000)")
    parser.add_argument("--within", type=float, default=2.0, help="CPU [s] to mark above (2)")
    parser.add_argument(
        "--below", type=float, default=300.0, help="memory [MB] to mark above (300)"
    )
    parser.add_argument("--jobs", type=int, default=1, help="processes at a time (1)")
    parser.add_argument("--bad", action="store_true", help="only rows that are marked")
    return parser.parse_args(argv)


def main() -> int:
    """Measure and print the table."""
    args = arguments()
    if args.file:
        print(json.dumps(measured(args.file[0], Path(args.file[1]))._asdict()))
        return 0
    sizes = "".join(f"{f'{size:g} MB':>8}" for size in args.sizes)
    print(f"{'CPU [s]':60}{sizes}     MB power   written")
    with ThreadPoolExecutor(args.jobs) as pool:
        every = list(cases(args))
        for case, found in zip(every, pool.map(lambda c: row(*c, args), every), strict=True):
            text = told(f"{case[0]}: {case[1]}, {case[2]}", found, args)
            if not args.bad or "<-" in text:
                print(text, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())

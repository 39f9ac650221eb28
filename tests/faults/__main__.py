"""Deliberate faults: each is put into a copy of the program, and the tests have to notice.

    python tests/faults                    every fault of faults.toml; exit code 1 when more survive
                                           than ``ALLOWED`` of them
    python tests/faults friction units     those with one of these words in their name
    python tests/faults -j 4               four at a time
    python tests/faults --whole            faults that survive their own tests meet all tests

A fault names the file, the text that is replaced (which stands there once, or ``times`` often), and
the tests that are expected to see it.  A fault whose text is not found any more is an error: the
table has to follow the code.
"""

from __future__ import annotations

import argparse
import compileall
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PARTS = (
    "adamslite",
    "grammar",
    "decks",
    "docs",
    "tests",
    "benchmarks",
    ".ci",
    "LICENSE",
    "README.md",
    "pyproject.toml",
)
#: Share of the faults that may survive, and seconds after which a fault counts as noticed: the
#: program hangs.
ALLOWED, PATIENCE = 0.02, 900.0
NOTICED, SURVIVED, LOST = "noticed", "SURVIVED", "text not found"


@dataclass(frozen=True)
class Fault:
    """``old`` in ``file`` becomes ``new``; ``tests`` are arguments of pytest."""

    name: str
    file: str
    old: str
    new: str
    tests: tuple[str, ...]
    times: int = 1

    def put_into(self, root: Path) -> bool:
        """Change the file below ``root``; False when the text is not there so often."""
        path = root / self.file
        text = path.read_text(encoding="utf-8")
        if text.count(self.old) != self.times:
            return False
        path.unlink()  # a link to the common copy
        path.write_text(text.replace(self.old, self.new), encoding="utf-8")
        return True


def faults() -> list[Fault]:
    """The table."""
    rows = tomllib.loads((HERE / "faults.toml").read_text(encoding="utf-8"))["fault"]
    return [Fault(**{**row, "tests": tuple(row["tests"])}) for row in rows]


def copy(folder: Path) -> Path:
    """A copy of the program and its tests."""
    folder.mkdir(exist_ok=True)
    for name in PARTS:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, folder / name, ignore=_left_out)
        else:
            shutil.copy(source, folder / name)
    return folder


def linked(whole: Path, folder: Path) -> Path:
    """A copy of a copy: sources are copied, since the program is known by facts of its sources that
    a link changes; the rest is linked, because tests write nothing there.
    """
    return Path(shutil.copytree(whole, folder / "tree", copy_function=_brought))


def _brought(source: str, target: str) -> None:
    if source.endswith((".py", ".lark")):
        shutil.copy2(source, target)
    else:
        os.link(source, target)


def _left_out(folder: str, names: list[str]) -> list[str]:
    """What is compiled, and what benchmarks have measured; the room `results` belongs to it all."""
    measured = ["results"] if Path(folder).name == "benchmarks" else []
    return [name for name in names if name in ("__pycache__", "node_modules", *measured)]


def passes(root: Path, tests: Sequence[str], cache: Path) -> bool:
    """Whether these tests pass below ``root``."""
    # Hypothesis and pytest keep notes of failures, which would follow from one fault to the next.
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "-m", "", "-p",
               "no:cacheprovider", *tests]  # fmt: skip
    environment = {**os.environ, "PYTHONPATH": str(root), "ADAMSLITE_CACHE": str(cache),
                   "PYTHONDONTWRITEBYTECODE": "1"}  # fmt: skip
    try:
        done = subprocess.run(
            command, cwd=root, env=environment, timeout=PATIENCE, capture_output=True
        )
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def verdict(fault: Fault, common: Path, cache: Path, whole: bool) -> str:
    """What becomes of a fault in a copy of the ``common`` one."""
    with tempfile.TemporaryDirectory(prefix="fault-", dir=common.parent) as scratch:
        root = linked(common, Path(scratch))
        if not fault.put_into(root):
            return LOST
        survives = passes(root, fault.tests, cache) and not (
            whole and not passes(root, ["tests"], cache)
        )
    return SURVIVED if survives else NOTICED


def main() -> int:
    """Try the faults that are asked for."""
    parser = argparse.ArgumentParser(
        prog="python tests/faults", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("words", nargs="*", help="only faults with one of these in their name")
    parser.add_argument("-j", "--jobs", type=int, default=1)
    parser.add_argument("--whole", action="store_true")
    args = parser.parse_args()
    table = [f for f in faults() if not args.words or any(w in f.name for w in args.words)]
    with tempfile.TemporaryDirectory(prefix="faults-") as scratch:
        common, cache = Path(scratch, "common"), Path(scratch, "cache")
        cache.mkdir(mode=0o700)
        compileall.compile_dir(copy(common) / "adamslite", quiet=1)
        with ThreadPoolExecutor(args.jobs) as pool:
            work = partial(verdict, common=common, cache=cache, whole=args.whole)
            found = list(pool.map(_said, table, [work] * len(table)))
    survivors = [f.name for f, what in zip(table, found, strict=True) if what == SURVIVED]
    lost = found.count(LOST)
    print(f"{len(table)} faults, {len(survivors)} survived, {lost} not found: {survivors}")
    return 1 if lost or len(survivors) > ALLOWED * len(table) else 0


def _said(fault: Fault, work: partial) -> str:
    what = work(fault)
    print(f"{what:14} {fault.name}", flush=True)
    return what


if __name__ == "__main__":
    sys.exit(main())

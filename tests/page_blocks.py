"""Blocks of a page of Markdown, run as a reader would run them one after the other.

What a block is follows from its language and from a comment of HTML on the line before it:

    ```console            commands after "$ " and what they print; also without a language, where
                          the first line begins with "$ "
    ```sh                 commands whose output is not compared
    ```python             run in one process with the Python blocks above it on the page; a `text`
                          block that follows is what it prints
    <!-- file: NAME -->   the text of a file, which the reader saves: that of the
                          file of this name beside the page or in `decks/`, if there is one
    <!-- part of: NAME -->        lines of a file of the repository or of one above
    <!-- exit code: N -->         of the last command, else 0
    <!-- not run: REASON -->

Commands are `adamslite` and `python`; no browser is opened. They run in an empty folder that holds
the files of the page: those of its blocks and those to which it links (decks, command files,
descriptions, tables and programs). Folders of `decks/` and `docs/` whose files a command or a
program names are there too.

Printed text agrees when it is the same but for these differences: "..." stands for any text in a
line, alone on a line for any lines; blanks may be more or fewer; seconds of CPU are any; counts of
work (steps, iterations, ...) may differ by a tenth, since they depend on how a processor rounds; a
number printed with an exponent by a twentieth or 1e-9; any other number by one in its last printed
digit.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import runpy
import shlex
import shutil
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

from adamslite.cli import main

ROOT = Path(__file__).parent.parent
FENCE = re.compile(
    r"^(?:<!-- (?P<said>[^\n]*?) -->\n)?```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S
)
LINK = re.compile(r"\]\(([^)\s#]+\.(?:adm|acf|toml|csv|res|req|py))\)")
#: A folder of the repository with a file that a command or a program names.
USED = re.compile(r"[ \"]((?:decks|docs)/[\w/-]+)/[\w.-]+")
NUMBER = r"(?<![\w.])[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?(?!\w)"
COUNTED = re.compile(r"^ *(steps|Newton iterations|Jacobians|evaluations|iterations)\b|\d steps$")
TIMED = re.compile(r"^ *CPU\b|\d s$")
#: Smaller differences of numbers are rounding.
ROUNDING = 1e-9
#: What is said only while a cache is empty.
AT_FIRST = re.compile(r"^compiling .*\n", re.M)


@dataclass(frozen=True)
class Block:
    """A fenced block: what its comment says, its language, its text and its line on the page."""

    said: str
    language: str
    text: str
    line: int

    def word(self, key: str) -> str | None:
        """What the comment says after `key`."""
        head, _, tail = self.said.partition(":")
        return tail.strip() if head.strip() == key else None


def blocks(page: str) -> list[Block]:
    """The blocks of a page, from first to last."""
    return [
        Block(
            found["said"] or "", found["language"], found["text"],
            page.count("\n", 0, found.start("text")),
        )
        for found in FENCE.finditer(page)
    ]  # fmt: skip


# What is printed


def agree(expected: str, printed: str) -> bool:
    """Does printed text agree with that of the page?"""
    return _lines_agree(_lines(expected), _lines(AT_FIRST.sub("", printed)))


def _lines(text: str) -> list[str]:
    return [re.sub(r"\s+", " ", line).rstrip() for line in text.strip("\n").splitlines()]


def _lines_agree(expected: list[str], printed: list[str]) -> bool:
    if not expected:
        return not printed
    if expected[0].strip() == "...":
        rest = expected[1:]
        return any(_lines_agree(rest, printed[k:]) for k in range(len(printed) + 1))
    return bool(
        printed and line_agrees(expected[0], printed[0]) and _lines_agree(expected[1:], printed[1:])
    )


def line_agrees(expected: str, printed: str) -> bool:
    """Does one printed line agree with that of the page?"""
    # Parts at odd places are numbers and wildcards.
    parts = re.split(rf"({NUMBER}|\.\.\.)", expected)
    wanted = [part for part in parts[1::2] if part != "..."]
    parts[::2] = map(re.escape, parts[::2])
    parts[1::2] = [".*" if part == "..." else f"({NUMBER})" for part in parts[1::2]]
    found = re.fullmatch("".join(parts), printed)
    if found is None or TIMED.search(expected):
        return found is not None
    counted = COUNTED.search(expected) is not None
    return all(_close(a, b, counted) for a, b in zip(wanted, found.groups(), strict=True))


def _close(expected: str, printed: str, counted: bool) -> bool:
    away, size = abs(float(expected) - float(printed)), abs(float(expected))
    if counted:
        return away <= max(2, 0.1 * size)
    if "e" in expected.lower():
        return away <= max(0.05 * size, ROUNDING)
    decimals = len(expected.partition(".")[2])
    return away <= (1.01 * 10**-decimals if decimals else ROUNDING)


# Running


class Reader:
    """Follows a page in `folder`, which is empty at the start."""

    def __init__(self, page: Path, folder: Path) -> None:
        self.page, self.folder = page, folder
        self.text = page.read_text(encoding="utf-8")
        self.names: dict[str, object] = {"__name__": "__main__"}
        self.printed = ""
        for link in LINK.findall(self.text):
            if not link.startswith("http"):
                shutil.copy(page.parent / link, folder)
        for case in set(USED.findall(self.text)):
            shutil.copytree(ROOT / case, folder / case, dirs_exist_ok=True)

    def follow(self) -> None:
        """Run every block; the first that does not do what the page says raises."""
        with contextlib.chdir(self.folder):
            for block in blocks(self.text):
                self._run(block)

    def _run(self, block: Block) -> None:
        if block.word("not run") is not None:
            return
        if (name := block.word("file")) is not None:
            self._save(name, block)
        elif (name := block.word("part of")) is not None:
            whole = (self.folder / name).read_text(encoding="utf-8")
            self._must(block.text in whole, block, f"these are no lines of {name}", whole)
        elif block.language == "python":
            self.printed = self._python(block.text)
        elif block.language == "text":
            self._must(agree(block.text, self.printed), block, "printed", self.printed)
        elif block.language in ("sh", "console") or block.text.startswith("$ "):
            self._session(block)
        else:
            self._must(False, block, "nothing says what this block is", "")

    def _must(self, right: bool, block: Block, sentence: str, text: str) -> None:
        place = f"{self.page.parent.name}/{self.page.name}:{block.line}"
        assert right, f"{place}: {sentence}:\n{text}\nthe page has:\n{block.text}"

    def _save(self, name: str, block: Block) -> None:
        """A file of the page; what the repository has under that name is the same."""
        for kept in (self.page.parent / name, ROOT / "decks" / Path(name).stem / name):
            if kept.exists():
                whole = kept.read_text(encoding="utf-8")
                self._must(whole == block.text, block, f"{kept.relative_to(ROOT)} is", whole)
        (self.folder / name).write_text(block.text, encoding="utf-8")

    def _session(self, block: Block) -> None:
        """Commands, each with what it prints below it."""
        steps = list(_commands(block))
        for k, (command, expected) in enumerate(steps):
            code, printed = run(command, self.folder)
            last = k == len(steps) - 1
            self._must(
                code == (int(block.word("exit code") or 0) if last else 0),
                block, f"{command} ended with {code}", printed,
            )  # fmt: skip
            compared = block.language != "sh"
            self._must(
                not compared or agree(expected, printed), block, f"{command} printed", printed
            )

    def _python(self, text: str) -> str:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            exec(compile(text, f"{self.page.name}", "exec"), self.names)
        return printed.getvalue()


def _commands(block: Block) -> Iterator[tuple[str, str]]:
    """Each command of a block, and what is printed below it."""
    if block.language == "sh":
        lines = block.text.replace("\\\n", " ").splitlines()
        yield from ((line, "") for line in lines if line and not line.startswith("#"))
        return
    for piece in re.split(r"^\$ ", block.text, flags=re.M)[1:]:
        command, _, printed = re.split(r"(?<!\\)(\n|\Z)", piece, maxsplit=1)
        yield command.replace("\\\n", " "), printed


def run(command: str, folder: Path) -> tuple[int, str]:
    """Exit code and all that a command prints, errors among it."""
    program, *arguments = shlex.split(command)
    printed = io.StringIO()
    shown = patch("adamslite.page.showing.open_page", return_value=True)
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed), shown:
        if program == "adamslite":
            sys.path.insert(0, str(folder))  # as `python -m` and routines of users have it
            try:
                return main.main(arguments), printed.getvalue()
            finally:
                sys.path.remove(str(folder))
        assert program == "python", f"no command of a page: {command}"
        runpy.run_path(os.path.join(folder, arguments[0]), run_name="__main__")
    return 0, printed.getvalue()

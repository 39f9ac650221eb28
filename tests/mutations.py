"""Mutations of public decks: whatever a deck says, it is read and checked, or it is reported.

    python tests/mutations.py 10000         read and check so many
    python tests/mutations.py 500 --solve   solve those that have no errors, too
    python tests/mutations.py --more FOLDER    of further decks, too

A mutant is a deck with one to four random changes of its text, or of that of its command file.
Mutant number n is always the same.  What ends in a traceback is printed with its number.
"""

from __future__ import annotations

import argparse
import re
import signal
import sys
import traceback
from collections import Counter
from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import adamslite as al
from adamslite.api.contents import contents
from adamslite.errors import RunFailed, UsageError
from adamslite.language.diagnostics import DeckError
from adamslite.resources import find
from adamslite.scene import Scene, load_scene, run_scene

WORD = re.compile(r"[A-Za-z_]\w*")
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d*)?(?:[EeDd][-+]?\d+)?")
NUMBERS = ("0", "-1", "1", "2", "3", "1E-300", "1E300", "9" * 30, "0.5", "-0", "1D", "90D", "1E5D")
PIECES = (
    "", ",", ",,", "=", "/", "\\", "(", ")", "[", "]", ":", ";", "!", "&", "\n", "\n, ", "\t", "\0",
    "*", "**", "-", "+", ".", "E", "D", "'", '"', "é", "Δ", "#", "%", " ", "IF(TIME: 1, 2, 3)",
    "MAX(", "VARVAL(1)", "TIME", "1/0", "0/0", "USER(1)", "FUNCTION=", "\nEND\n", "\\Delta ",
)  # fmt: skip
LONGEST = 60_000
"""Characters of the largest deck that is changed: reading takes its time for all of it."""
PATIENCE = 60
"""Seconds a run may take."""


FOLDERS = [find("decks")]


@cache
def scenes() -> tuple[tuple[str, str], ...]:
    """The texts of decks and of their command files, which may be missing."""
    files = sorted(path for folder in FOLDERS for path in folder.rglob("*.adm"))
    found = []
    for path in files:
        beside = path.with_suffix(".acf")
        commands = beside.read_text("latin-1") if beside.is_file() else ""
        found.append((path.read_text("latin-1"), commands))
    return tuple(each for each in found if len(each[0]) < LONGEST)


def decks() -> tuple[str, ...]:
    """The texts of the decks that are changed."""
    return tuple(deck for deck, _ in scenes())


def mutant(number: int) -> tuple[str, str]:
    """Deck and commands of one mutant."""
    random = Random(number)
    deck, commands = random.choice(scenes())
    of_commands = bool(commands) and random.random() < 0.5
    text = commands if of_commands else deck
    for _ in range(random.randint(1, 4)):
        text = random.choice(CHANGES)(random, text)
    return (deck, text) if of_commands else (text, commands)


def _line(random: Random, text: str) -> tuple[list[str], int]:
    lines = text.split("\n")
    return lines, random.randrange(len(lines))


def cut(random: Random, text: str) -> str:
    """Without some characters."""
    at = random.randrange(len(text) + 1)
    return text[:at] + text[at + random.randint(1, 30) :]


def insert(random: Random, text: str) -> str:
    """With a piece of text somewhere."""
    at = random.randrange(len(text) + 1)
    return text[:at] + random.choice(PIECES) + text[at:]


def drop_line(random: Random, text: str) -> str:
    """Without a line."""
    lines, at = _line(random, text)
    return "\n".join(lines[:at] + lines[at + 1 :])


def double_line(random: Random, text: str) -> str:
    """With a line twice."""
    lines, at = _line(random, text)
    other = random.randrange(len(lines))
    return "\n".join([*lines[:other], lines[at], *lines[other:]])


def swap_lines(random: Random, text: str) -> str:
    """With two lines exchanged."""
    lines, at = _line(random, text)
    other = random.randrange(len(lines))
    lines[at], lines[other] = lines[other], lines[at]
    return "\n".join(lines)


def end_early(random: Random, text: str) -> str:
    """Without its end."""
    return text[: random.randrange(len(text) + 1)]


def _replaced(random: Random, text: str, pattern: re.Pattern[str], by: str) -> str:
    found = list(pattern.finditer(text))
    if not found:
        return text
    start, end = random.choice(found).span()
    return text[:start] + by + text[end:]


def other_number(random: Random, text: str) -> str:
    """With a number exchanged for another."""
    present = NUMBER.findall(text)
    by = random.choice(NUMBERS if random.random() < 0.6 or not present else present)
    return _replaced(random, text, NUMBER, by)


def other_word(random: Random, text: str) -> str:
    """With a word exchanged for another one of the deck."""
    present = WORD.findall(text)
    return _replaced(random, text, WORD, random.choice(present)) if present else text


def other_words(random: Random, text: str) -> str:
    """With a word of another deck."""
    return _replaced(random, text, WORD, random.choice(WORD.findall(random.choice(decks())) or "X"))


def foreign_lines(random: Random, text: str) -> str:
    """With some lines of another deck."""
    lines, at = _line(random, text)
    others, start = _line(random, random.choice(decks()))
    return "\n".join(lines[:at] + others[start : start + random.randint(1, 5)] + lines[at:])


CHANGES = (
    cut, insert, drop_line, double_line, swap_lines, end_early, other_number, other_number,
    other_number, other_word, other_words, foreign_lines,
)  # fmt: skip


def outcome(number: int, folder: Path, solve: bool = False) -> str:
    """What comes of a mutant: ``errors``, ``checked``, ``solved`` or ``stopped``.

    Whatever else is raised is a fault of the program.
    """
    path, commands = folder / "mutant.adm", folder / "mutant.acf"
    for file, text in zip((path, commands), mutant(number), strict=True):
        file.write_text(text, "utf-8", newline="")
    if not commands.read_text():
        commands.unlink()
    try:
        scene = load_scene(path)
        contents(scene.deck, scene.commands)
    except DeckError as fault:
        assert str(fault) and all(each.span.line >= 1 for each in fault.errors)
        return "errors"
    return _solved(scene) if solve else "checked"


def _solved(scene: Scene) -> str:
    """What comes of a run, which is interrupted after a minute as by Ctrl-C."""
    signal.signal(signal.SIGALRM, signal.default_int_handler)
    signal.alarm(PATIENCE)
    try:
        results = run_scene(scene, {})
    except (RunFailed, UsageError, DeckError, KeyboardInterrupt):
        return "stopped"
    finally:
        signal.alarm(0)
    return "solved" if results.outcome is al.Outcome.DONE else "stopped"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("count", type=int, nargs="?", default=10_000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--solve", action="store_true")
    parser.add_argument("--more", type=Path, action="append", default=[])
    options = parser.parse_args()
    FOLDERS.extend(options.more)
    counts: Counter[str] = Counter()
    with TemporaryDirectory() as folder:
        for number in range(options.first, options.first + options.count):
            try:
                counts[outcome(number, Path(folder), options.solve)] += 1
            except Exception:
                counts["faults"] += 1
                sys.stdout.write(f"---- mutant {number}\n{traceback.format_exc()}\n")
    sys.stdout.write(", ".join(f"{n} {name}" for name, n in sorted(counts.items())) + "\n")
    return 1 if counts["faults"] else 0


if __name__ == "__main__":
    sys.exit(main())

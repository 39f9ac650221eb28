"""Whether `check` advises on the decks that `adamslite cable` writes what `cable` itself does.

    python -m benchmarks.agreement --scenes 260 --seed 11 [--p 0.01] [--show 3]

Random descriptions are written as decks and read back, four times: as they are written; with
another model asked for in the description; with a number of a law, the damping or the time edited
in the statements alone; and without comments. Compared are level, form, sections and integrator; a
deck with another model or number is compared with what `cable` chooses for what it is now.
"""

from __future__ import annotations

import argparse
import re
from collections import Counter
from collections.abc import Callable, Iterator

import numpy as np

import adamslite
from adamslite.cables.deck.scene import chosen as choice
from adamslite.cables.deck.scene import deck, drawn
from adamslite.cables.description.head_comments import END, below
from adamslite.cables.recognition.report import advice_on
from adamslite.cables.statements.forms import number as number_of
from adamslite.language.diagnostics import DeckError
from benchmarks.rope_scenes import Table, scene, toml

#: Level, form, sections, integrator.
Said = tuple[int, str, int, str]
#: What is done to a description: its own text, the deck that is read, and what that one is.
Case = tuple[str, str]
#: By which numbers are changed.
FACTORS = (0.5, 0.8, 1.25, 2.0)
NUMBER = re.compile(r"(?<![\w.])\d+\.?\d*(?:[eE][+-]?\d+)?(?![\w.])")
COMMENT = re.compile(r"(?m)^!.*\n|![^\n]*")


def chosen(text: str) -> Said:
    """The choice of `cable` without a word about the model."""
    of = drawn(text)
    asked = of.asking(of.given.accuracy, of.given.end, of.given.steps).demanding()
    model = choice(asked, asked.faults)
    return _said(model.level, model.form, model.elements, model.integrator)


def advised(text: str, p: float) -> Said | None:
    """The advice of `check` on a deck."""
    found = advice_on(adamslite.read(text), p)
    return _said(found.level, found.form, found.elements, found.integrator) if found else None


def _said(level: int, form: str, sections: int, method: str) -> Said:
    return level, form if level == 3 else "", sections * (level > 1), method.split(",")[0]


# ---- what is done to a description ------------------------------------------------------------


def as_written(table: Table, rng: np.random.Generator) -> Case:
    """Nothing."""
    return toml(table), deck(toml(table))[0]


def asked(table: Table, rng: np.random.Generator) -> Case:
    """Sections, or a level with them, as a user wishes."""
    wish = {"level": int(rng.integers(2, 4)), "elements": int(rng.choice([1, 2, 5, 17]))}
    text = toml(table | {"model": table.get("model", {}) | wish})
    return text, deck(text)[0]


def edited(table: Table, rng: np.random.Generator) -> Case:
    """A number of a law, the damping or the time of the run, edited in the statements."""
    text = toml(table)
    written = deck(text)[0]
    head, statements = written[: written.index(END)], below(written)
    factor = float(rng.choice(FACTORS))
    changes = [*_changes(text, factor)]
    for k in rng.permutation(len(changes)):
        place, new, old_statement, new_statement = changes[k]
        if old_statement in statements:
            described = text[: place.start(1)] + new + text[place.end(1) :]
            return described, head + statements.replace(old_statement, new_statement)
    raise DeckError([])


def _changes(text: str, factor: float) -> Iterator[tuple[re.Match[str], str, str, str]]:
    """Places in a description, what to write there, and the same in a statement."""
    for place in re.finditer(r'(?m)= ?\[?[^\n]*?"([^"\n]*TIME[^"\n]*)"', text):
        for number in NUMBER.finditer(place[1]):
            if float(number[0]):
                value = f"{float(number[0]) * factor:.6g}"
                new = place[1][: number.start()] + value + place[1][number.end() :]
                yield place, new, place[1], new
    for place in re.finditer(r"(?m)^damping = (.*)$", text):
        new = f"{min(float(place[1]) * factor, 0.9):.6g}"
        yield place, new, f"2*{float(place[1]):g}*SQRT", f"2*{new}*SQRT"
    for place in re.finditer(r"(?m)^end = (.*)$", text):
        new = f"{float(place[1]) * factor:.6g}"
        yield place, new, f"END={number_of(float(place[1]))},", f"END={new},"


def stripped(table: Table, rng: np.random.Generator) -> Case:
    """All comments taken out."""
    return toml(table), COMMENT.sub("", deck(toml(table))[0])


CASES: dict[str, Callable[[Table, np.random.Generator], Case]] = {
    "as written": as_written, "another model asked": asked, "a law or time edited": edited,
    "without comments": stripped,
}  # fmt: skip


def main() -> None:
    """Count agreements."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", type=int, default=60)
    parser.add_argument("--seed", type=int, default=11)
    parser.add_argument("--p", type=float, default=0.01)
    parser.add_argument("--show", type=int, default=0, help="differences to print, by kind")
    parser.add_argument("--only", choices=CASES)
    args = parser.parse_args()
    counts = {name: Counter[str]() for name in CASES if args.only in (None, name)}
    kinds = Counter[tuple[str, str, str]]()
    for number in range(args.scenes):
        kind, table = scene(args.seed, number)
        table["model"] = {"accuracy": args.p}
        for name, count in counts.items():
            try:
                text, written = CASES[name](table, np.random.default_rng([args.seed, number]))
                ours, theirs = chosen(text), advised(written, args.p)
            except DeckError:
                count["no deck"] += 1
                continue
            verdict = "silent" if theirs is None else "agree" if ours == theirs else "differ"
            count[verdict] += 1
            kinds[name, kind, verdict] += 1
            if verdict != "agree" and kinds[name, kind, verdict] <= args.show:
                print(f"{name}: {kind} {number}: cable {ours}, check {theirs}")
    print("                         agree  differ  silent  no deck")
    for name, count in counts.items():
        found = [count[word] for word in ("agree", "differ", "silent", "no deck")]
        print(f"{name:24}" + "".join(f"{n:7}" for n in found))


if __name__ == "__main__":
    main()

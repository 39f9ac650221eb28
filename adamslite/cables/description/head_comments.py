"""The description that a deck carries in the comments of its head, and the model it was written by.

::

    ! ---- description ----
    ! end = 10
    ! ...
    ! ---- model ----
    ! level = 3
    ! form = "paper"
    ! elements = 4
    ! method = "GSTIFF, SI2"
    ! error = 2e-05
    ! pulls_only = false
    ! tried = []
    ! ---- statements ----

`tried` are the reasons for the model where runs have shown that the description needs it; they may
have shown, too, that the cable goes slack, and the model pulls only then. Both are TOML, and data:
nothing in them is evaluated but the expressions of a description.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from json import dumps
from typing import Any, NamedTuple

BEGIN, MODEL, END = (f"! ---- {word} ----" for word in ("description", "model", "statements"))
METHOD = re.compile("[A-Z0-9, ]+")


class Model(NamedTuple):
    """What the statements show of the model they were written by, and why it is that one."""

    level: int
    form: str
    elements: int
    method: str
    error: float
    pulls_only: bool
    tried: Sequence[str]


class Carried(NamedTuple):
    """A description, and the model of the statements below it."""

    text: str
    model: Model


def comments(text: str, model: Model) -> str:
    """The lines of a head that hold a description and its model."""
    shown = [f"{name} = {dumps(value)}" for name, value in model._asdict().items()]
    if model.tried:
        shown[-1:] = ["tried = [", *(f"  {dumps(each)}," for each in model.tried), "]"]
    # Lines end where those of a deck do: TOML allows other ends of lines within its texts.
    described = text.replace("\r\n", "\n").strip("\n").split("\n")
    lines = [BEGIN, *map(_comment, described), MODEL, *map(_comment, shown), END]
    return "".join(f"{line}\n" for line in lines)


def _comment(line: str) -> str:
    return f"! {line}".rstrip(" ")


def is_described(deck: str) -> bool:
    """Whether the text of a deck carries a description."""
    return BEGIN in deck


def below(deck: str) -> str:
    """The statements below a description."""
    return deck[deck.index(END) :]


def carried(deck: str) -> Carried | None:
    """What the head of a deck carries; None without a description, and for two."""
    lines = deck.split("\n")
    marks = [[k for k, line in enumerate(lines) if line.rstrip() == mark]
             for mark in (BEGIN, MODEL, END)]  # fmt: skip
    if any(len(found) != 1 for found in marks):
        return None
    (begin,), (middle,), (end,) = marks
    if not begin < middle < end or not all(line.startswith("!") for line in lines[begin:end]):
        return None
    if any(line.strip() and not line.startswith("!") for line in lines[1:begin]):
        return None
    model = _model(_plain(lines[middle + 1 : end]))
    return Carried(_plain(lines[begin + 1 : middle]), model) if model else None


def _plain(lines: list[str]) -> str:
    return "\n".join(line[1:].removeprefix(" ") for line in lines) + "\n"


def _model(text: str) -> Model | None:
    # Decks without a description, which are most, are spared the modules of its model.
    import tomllib

    from adamslite.cables.description.keys import FORMS
    from adamslite.cables.description.toml_places import excess_of
    from adamslite.cables.description.vocabulary import MOST_SECTIONS

    try:
        shown: dict[str, Any] = {} if excess_of(text) else tomllib.loads(text)
    except (ValueError, RecursionError):
        return None
    kinds = (int, str, int, str, float, bool, list)
    values = [shown.get(name) for name in Model._fields]
    if [*map(type, values)] != [*kinds]:
        return None
    found = Model(**{name: shown[name] for name in Model._fields})
    # More sections than any deck is written with would take forever to write.
    if not (1 <= found.level <= 3 and 1 <= found.elements <= MOST_SECTIONS and found.form in FORMS):
        return None
    if not all(isinstance(each, str) for each in found.tried):
        return None
    return found if METHOD.fullmatch(found.method) and found.error > 0 else None

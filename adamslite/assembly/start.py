"""The start of a deck: gaps of joints, redundant rows, and what IC and VELOCITY demand of it."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from adamslite.assembly.closing import OPEN, Closing, close
from adamslite.assembly.rank import (
    MOST_DENSE,
    RANK,
    dependent_of_many,
    dependent_rows,
    names_of_rows,
    unit_rows,
)
from adamslite.assembly.rows import gradient, sparse_gradient
from adamslite.assembly.scope import WIDTH, Posture
from adamslite.assembly.start_posture import settle_start
from adamslite.deck.deck import Deck
from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.joint import Joint
from adamslite.elements.marker import Marker
from adamslite.elements.motion import Motion
from adamslite.elements.part import Part
from adamslite.elements.ptcv import Ptcv
from adamslite.language.expression import Num
from adamslite.language.interfaces import Key
from adamslite.model.model import POINT, Model
from adamslite.model.model import Body as ModelBody
from adamslite.model.scaling import coordinate_weights

GROUND = ("PART", "GROUND")
# Rows off by this share of the worst take part in a contradiction.
INVOLVED = 1e-3
Body = tuple[str, Key]


@lru_cache(maxsize=1)
def closing_of(deck: Deck) -> tuple[Model, Closing]:
    """The model and its posture at the start, with the initial conditions of its joints."""
    active = [s for s in deck.statements if isinstance(s, Joint | Motion) and deck.is_active(s)]
    extra = [c for s in active for c in conditions(s) if c.level == "DISPLACEMENT"]
    model = Model(deck.with_more(extra) if extra else deck)
    settle_start(model)
    return model, close(model, model.constraints, Posture.start(model), OPEN)


def redundant_rows(deck: Deck) -> list[str]:
    """Names of the constraint rows that follow from the others at the start.

    Raises
    ------
    TooManyDependent
        When more of thousands of rows do so than are looked for.
    """
    if not has_loops(deck):
        return []
    started, closing = closing_of(deck)
    posture = close(started, started.constraints, closing.posture).posture
    model = Model(deck) if len(started.deck.own) > len(deck.own) else started
    weights = coordinate_weights(model).ravel()
    with np.errstate(all="ignore"):  # numbers that are too large
        if sum(each.n_rows for each in model.constraints) > MOST_DENSE:
            rows = sparse_gradient(model, posture, model.constraints)
            dropped = dependent_of_many(rows.multiply(1.0 / weights[None, :]).tocsr())
            return names_of_rows(model.constraints, dropped)
        scaled = unit_rows(gradient(model, posture, model.constraints) / weights)
    if not np.isfinite(scaled).all():
        return []
    return names_of_rows(model.constraints, dependent_rows(scaled))


def has_loops(deck: Deck) -> bool:
    """Whether some constraint connects bodies that others connect already."""
    leader: dict[Body, Body] = {}

    def group(body: Body) -> Body:
        while leader.get(body, body) != body:
            body = leader[body]
        return body

    for each in deck.statements:
        if not hasattr(each, "constraints") or not deck.is_active(each):
            continue
        ends = [_body(deck, getattr(each, name, None)) for name in ("i", "j")]
        if None in ends:
            return True
        first, second = (group(end) for end in ends if end is not None)
        if first == second:
            return True
        leader[first] = second
    return False


def _body(deck: Deck, marker: Key | None) -> Body | None:
    found = deck.find(Marker, marker) if marker is not None else None
    if found is None or found.owner is None:
        return None
    return GROUND if getattr(deck.find(*found.owner), "ground", False) else found.owner


def worst_gap(closing: Closing) -> tuple[Constraint, str, float, list[str]] | None:
    """The constraint that stays open most, its row, by how much, and what it contradicts.

    At the least sum of squares the gaps are a combination of rows that cancels: rows that stay open
    contradict each other.  None where a row has no value.
    """
    kept = closing.kept
    worst = [float(np.abs(gap).max()) for gap in closing.gaps]
    if not np.isfinite(worst).all():
        return None
    at = int(np.argmax(worst))
    row = int(np.argmax(np.abs(closing.gaps[at])))
    involved = (each.label for each, size in zip(kept, worst, strict=True)
                if size > INVOLVED * worst[at] and each is not kept[at])  # fmt: skip
    return kept[at], kept[at].row_names[row], worst[at], list(involved)


def loose_bodies(model: Model, posture: Posture) -> set[int]:
    """Bodies without mass that take part in a motion in which nothing else moves.

    Such motions are the null space of the constraint rows, of the columns of these bodies alone.
    """
    columns = [c for b, body in enumerate(model.bodies) for c in _weightless(b, body)]
    rows = gradient(model, posture, model.constraints)
    scaled = unit_rows(rows)[:, columns]
    if not columns or not np.isfinite(scaled).all():
        return set()
    full = np.zeros((max(len(scaled), len(columns)), len(columns)))
    full[: len(scaled)] = scaled
    _, sizes, motions = np.linalg.svd(full)
    free = np.abs(motions[sizes <= RANK]).max(axis=0, initial=0.0)
    return {columns[k] // WIDTH for k in np.flatnonzero(free > INVOLVED)}


def _weightless(number: int, body: ModelBody) -> range:
    """The columns of coordinates that move nothing that has mass."""
    if body.mass or body.width == POINT:
        return range(0)
    first = WIDTH * number
    return range(first, first + (3 if body.inertia.any() else WIDTH))


class Condition(Motion):
    """A motion that holds at the start only; ``name`` says what of the deck it stands for."""

    @property
    def label(self) -> str:
        """``ICDISP of MOTION/1``"""
        return self.name or super().label

    @property
    def row_names(self) -> tuple[str, ...]:
        """The requested displacements and speeds."""
        return ("speed" if self.level == "VELOCITY" else "displacement",)


def conditions(statement: Joint | Motion) -> list[Condition]:
    """A motion for each requested displacement and speed."""
    where: dict[str, Key | None] = {"joint": statement.key}
    if isinstance(statement, Motion):
        where = {"joint": statement.joint, "i": statement.i, "j": statement.j}
    return [
        Condition(
            id=f"{statement.label} {field} {level}",
            name=f"{field.upper()} of {statement.label}",
            axis=freedom or None,
            level=level,
            function=Num(value),
            spans=statement.spans,
            **where,
        )
        for field, freedom, *values in statement.initial()
        for level, value in zip(("DISPLACEMENT", "VELOCITY"), values, strict=True)
        if value is not None
    ]


def speed_on_curve(deck: Deck, constraint: Ptcv, rate: float) -> tuple[Marker, Condition]:
    """A motion of the massless point that carries the parameter, at ``rate``, and a marker on the
    ground for it.
    """
    ground = next(part.key for part in deck.of(Part) if part.ground)
    fixed = Marker(id=f"{constraint.slider}_GROUND".upper(), part=ground, spans=constraint.spans)
    condition = Condition(
        id=f"{constraint.label} velocity",
        name=f"VELOCITY of {constraint.label}",
        axis="X",
        level="VELOCITY",
        function=Num(rate),
        i=constraint.slider.upper(),
        j=fixed.key,
        spans=constraint.spans,
    )
    return fixed, condition

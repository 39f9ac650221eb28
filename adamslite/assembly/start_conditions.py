"""What IC, ICTRAN, ICROT, ICDISP and VELOCITY of a PTCV demand of the start, as motions."""

from __future__ import annotations

from adamslite.deck.deck import Deck
from adamslite.elements.joint import Joint
from adamslite.elements.marker import Marker
from adamslite.elements.motion import Motion
from adamslite.elements.part import Part
from adamslite.elements.ptcv import Ptcv
from adamslite.language.expression import Num
from adamslite.language.interfaces import Key


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

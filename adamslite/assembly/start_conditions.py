"""What IC, ICTRAN, ICROT and ICDISP demand of the start, as motions."""

from __future__ import annotations

from adamslite.elements.joint import Joint
from adamslite.elements.motion import Motion
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

"""A statement as its physics sees it: frames for markers, symbols for numbers, expressions."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from adamslite.kernels.reactions import reactions
from adamslite.symbolic.scope import Load, Scope
from adamslite.symbolic.types import Physics, Read, Symbol


class View:
    """A statement as its physics sees it: frames, symbols, expressions, words."""

    def __init__(
        self,
        cls: Physics,
        fields: dict[str, Read],
        unknowns: list[Symbol],
        moving_view: Callable[[], View] | None = None,
    ) -> None:
        self.__dict__.update(fields)
        self.cls = cls
        self.unknowns = unknowns
        self.moving_view = moving_view

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Read:
            """A field."""

    def own_loads(self, scope: Scope) -> list[Load]:
        """Loads of a force, or the reactions of a constraint."""
        if hasattr(self.cls, "loads"):
            return self.cls.loads(self, scope)
        with scope.everything_moves():
            view = self.moving_view() if self.moving_view else self
            return reactions(view.cls.constraints(view, scope), view.unknowns, scope)

    def side(self, jflag: int) -> tuple[int | None, int | None]:
        """The frame that is measured, and the only partner that counts (None: all)."""
        sides = self.__dict__.get("sides")
        return sides[jflag] if sides else (self.end(jflag), None)

    def end(self, jflag: int) -> int | None:
        """The frame called I (``jflag`` 0) or J: its own, or that of the (first) joint it acts
        on.
        """
        known = self.__dict__
        held = known.get("joint") or (known.get("joints") or (None,))[0]
        if held is not None:
            return held.end(jflag)
        names = ("j", "jfloat", "j_part") if jflag else ("i",)
        return next((known[name] for name in names if known.get(name) is not None), None)

"""MARKER: a point with axes on a body.

Equation (position and axes in ground of a marker on a body at ``r`` with attitude ``A``)::

    r_marker = r + A QP,    A_marker = A Rz(a) Rx(b) Rz(c)       REULER=a,b,c

With RM, r and A are those of that marker of the same body.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.language.statement import Statement, flag, reference, statement, texts, vector

if TYPE_CHECKING:
    from adamslite.language.interfaces import Key

BODIES = ("POINT_MASS", "PART", "FLEX_BODY", "FE_PART")
"""What a marker may be on, by arguments of the same name."""
OWNERS = tuple((keyword, keyword.lower()) for keyword in BODIES)


@statement("MARKER")
class Marker(Statement):
    """A frame fixed to a PART or POINT_MASS.

    Without PART or POINT_MASS it belongs to the nearest one before it in the deck.
    A FLOATING marker is placed by the solver and serves as JFLOAT of a force.
    """

    alternatives = (
        (("part",), ("point_mass",), ("flex_body",), ("fe_part",)),
        (("reuler",), ("zp", "xp", "usexp")),
    )

    part: int | str | None = reference("PART", "P", to="PART", help="the part it is fixed to")
    point_mass: int | str | None = reference(
        "POINT_MASS", to="POINT_MASS", help="the point mass it is fixed to"
    )
    flex_body: int | str | None = reference(
        "FLEX_BODY", to="FLEX_BODY", help="the flexible body it is on"
    )
    fe_part: int | str | None = reference("FE_PART", to="FE_PART", help="the FE_PART it is on")
    node_id: tuple[str, ...] = texts("NODE_ID", "NODE", help="node of the flexible body")
    qp: tuple[float, ...] = vector(
        "QP", size=3, unit="length", default=(0.0, 0.0, 0.0), help="origin, in the body frame or RM"
    )
    reuler: tuple[float, ...] = vector(
        "REULER", "EULER", size=3, unit="angle", default=(0.0, 0.0, 0.0),
        help="body 3-1-3 angles of its axes in the body frame or RM",
    )  # fmt: skip
    zp: tuple[float, ...] | None = vector(
        "ZP", size=3, unit="length",
        help="point of the body on its +z axis (with USEXP: in its +xz half-plane)",
    )  # fmt: skip
    xp: tuple[float, ...] | None = vector(
        "XP", size=3, unit="length",
        help="point of the body in its +xz half-plane (with USEXP: on its +x axis)",
    )  # fmt: skip
    rm: int | str | None = reference(
        "RM", to="MARKER", help="marker of the body that QP, REULER, ZP and XP refer to"
    )
    usexp: bool = flag("USEXP", help="XP gives the x axis exactly, ZP the plane")
    floating: bool = flag("FLOATING", help="placed by the solver")

    @classmethod
    def completed(
        cls, values: dict[str, object], body: tuple[str, Key | None] | None
    ) -> dict[str, object]:
        """The nearest body before it owns a marker that names none."""
        if body is None or any(field in values for _, field in OWNERS):
            return {}
        keyword, id = body
        return {keyword.lower(): id}

    @property
    def owner(self) -> tuple[str, int | str] | None:
        """Keyword and id of the body it is fixed to."""
        for keyword, field in OWNERS:
            key = getattr(self, field)
            if key is not None:
                return keyword, key
        return None

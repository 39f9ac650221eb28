"""GRAPHICS: a shape on a part, for display and for CONTACT.

Equations (x, y, z: axes of the marker CM, CORNER or RM, from its origin)::

    ELLIPSOID   (2x/XSCALE)^2 + (2y/YSCALE)^2 + (2z/ZSCALE)^2 <= 1
    CYLINDER    x^2 + y^2 <= RADIUS^2,   z from 0 to LENGTH
    FRUSTUM     the same with a radius from BOTTOM at z = 0 to TOP at z = LENGTH
    BOX         from the corner to the point X, Y, Z
    PLANE       z = 0,  XMIN <= x <= XMAX,  YMIN <= y <= YMAX,  its outside is +z
    POINT       x = y = z = 0
    CIRCLE      x^2 + y^2 = RADIUS^2, z = 0;  an ARC of it from the x axis through RANGLE
    TORUS       a circle MINOR_RADIUS round the circle MAJOR_RADIUS, z = 0

LENGTH, X, Y and Z may be negative.  A scale of an ELLIPSOID is the length of a whole axis, twice
the radius of a sphere.
Source: Adams/Solver statement GRAPHICS; the words of a TORUS are those of Adams/View.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from adamslite.language.statement import (
    Statement,
    choice,
    ids,
    number,
    reference,
    references,
    statement,
    text,
)

if TYPE_CHECKING:
    from adamslite.language.statement import Field


def _length(key: str, help: str, *aliases: str) -> Field:
    return number(key, *aliases, unit="length", help=help)


@statement("GRAPHICS", inert=True, data=True)
class Graphics(Statement):
    """A shape; it moves nothing unless a CONTACT names it."""

    kind: str | None = choice(
        options=(
            "ARC", "BOX", "CIRCLE", "CURVE", "CYLINDER", "ELLIPSOID", "EXTERNAL", "FORCE",
            "FRUSTUM", "PLANE", "POINT", "SPDP", "SPRINGDAMPER", "TORUS",
        ),
        help="a shape; without one it is an OUTLINE",
    )  # fmt: skip
    cm: int | str | None = reference("CM", to="MARKER", help="marker at the centre or the base")
    rm: int | str | None = reference(
        "RM", to="MARKER",
        help="PLANE, POINT, EXTERNAL: marker of the shape; CYLINDER: marker on its surface",
    )  # fmt: skip
    radius: float | None = _length("RADIUS", "CYLINDER, CIRCLE, ARC: radius")
    length: float | None = _length("LENGTH", "CYLINDER, FRUSTUM: length along z of CM")
    bottom: float | None = _length("BOTTOM", "FRUSTUM: radius at CM")
    top: float | None = _length("TOP", "FRUSTUM: radius at the other end")
    rangle: float | None = number(
        "RANGLE", unit="angle", help="CYLINDER, FRUSTUM, ARC: sector about z from the x axis"
    )
    corner: int | str | None = reference("CORNER", to="MARKER", help="BOX: marker at a corner")
    x: float | None = _length("X", "BOX: edge along x of the corner")
    y: float | None = _length("Y", "BOX: edge along y")
    z: float | None = _length("Z", "BOX: edge along z")
    xscale: float | None = _length("XSCALE", "ELLIPSOID: axis along x, XS in short")
    yscale: float | None = _length("YSCALE", "ELLIPSOID: axis along y")
    zscale: float | None = _length("ZSCALE", "ELLIPSOID: axis along z")
    xmin: float | None = _length("XMIN", "PLANE: border")
    xmax: float | None = _length("XMAX", "PLANE: border")
    ymin: float | None = _length("YMIN", "PLANE: border")
    ymax: float | None = _length("YMAX", "PLANE: border")
    major_radius: float | None = _length("MAJOR_RADIUS", "TORUS: radius of the circle")
    minor_radius: float | None = _length("MINOR_RADIUS", "TORUS: radius of the tube")
    outline: tuple[int | str, ...] = references(
        "OUTLINE", to="MARKER", help="markers that lines join; the first again closes them"
    )
    i: int | str | None = reference("I", to="MARKER", help="SPRINGDAMPER: marker at one end")
    j: int | str | None = reference("J", to="MARKER", help="SPRINGDAMPER: marker at the other end")
    coils: float | None = number("COILS", unit="1", help="SPRINGDAMPER: coils of the spring")
    da: float | None = _length("DA", "SPRINGDAMPER: diameter of the spring")
    db: float | None = _length("DB", "SPRINGDAMPER: diameter of the cup")
    dc: float | None = _length("DC", "SPRINGDAMPER: diameter of the piston")
    la: float | None = _length("LA", "SPRINGDAMPER: from I to the spring")
    lb: float | None = _length("LB", "SPRINGDAMPER: from J to the spring")
    lc: float | None = _length("LC", "SPRINGDAMPER: length of the cup")
    ld: float | None = _length("LD", "SPRINGDAMPER: from I to the cup")
    etype: str | None = text("ETYPE", help="FORCE: keyword of the element that exerts it")
    eid: tuple[int | str, ...] = ids("EID", help="FORCE: its id")
    emarker: int | str | None = reference("EMARKER", to="MARKER", help="FORCE: where it is drawn")
    file: str | None = text("FILE", help="EXTERNAL: file of the shape")
    element: str | None = text("ELEMENT", help="EXTERNAL: name of the solid in the file")
    faceting_tolerance: float | None = number(
        "FACETING_TOLERANCE", unit="1", help="EXTERNAL: how finely it is drawn"
    )
    cid: int | str | None = reference("CID", to="CURVE", help="CURVE: the curve")
    crm: int | str | None = reference("CRM", to="MARKER", help="CURVE: marker it is drawn in")
    function: str | None = text("FUNCTION", help="USER(...): drawn by a routine of ADAMS")
    seg: float | None = number("SEG", unit="1", help="facets or segments of the drawing")
    sides: float | None = number("SIDES", unit="1", help="facets of the drawing")

    needs: ClassVar[dict[str, tuple[str, ...]]] = {
        "ARC": ("cm", "radius"),
        "BOX": ("corner", "x", "y", "z"),
        "CIRCLE": ("cm", "radius"),
        "CURVE": ("cid", "crm"),
        "CYLINDER": ("cm", "length"),
        "ELLIPSOID": ("cm", "xscale", "yscale", "zscale"),
        "EXTERNAL": ("rm",),
        "FORCE": ("etype", "eid", "emarker"),
        "FRUSTUM": ("cm", "length", "bottom", "top"),
        "FUNCTION": ("function",),
        "OUTLINE": ("outline",),
        "PLANE": ("rm",),
        "POINT": ("rm",),
        "SPRINGDAMPER": ("i", "j"),
        "TORUS": ("cm", "major_radius", "minor_radius"),
    }
    """What a shape cannot do without."""
    takes: ClassVar[dict[str, tuple[str, ...]]] = {
        "ARC": ("rangle", "seg", "sides"),
        "CIRCLE": ("seg", "sides"),
        "CURVE": ("seg",),
        "CYLINDER": ("radius", "rm", "rangle", "seg", "sides"),
        "EXTERNAL": ("file", "element", "faceting_tolerance"),
        "FRUSTUM": ("rangle", "seg", "sides"),
        "PLANE": ("xmin", "xmax", "ymin", "ymax"),
        "SPRINGDAMPER": ("coils", "da", "db", "dc", "la", "lb", "lc", "ld"),
        "TORUS": ("seg", "sides"),
    }
    """What it may have beside that."""

    @property
    def shape(self) -> str | None:
        """The kind by one name each; None where nothing is drawn."""
        if self.kind is None:
            return "OUTLINE" if self.outline else "FUNCTION" if self.function else None
        return "SPRINGDAMPER" if self.kind == "SPDP" else self.kind

    @property
    def marker(self) -> int | str | None:
        """The marker whose axes the shape is described in."""
        at = {"BOX": "corner", "CURVE": "crm", "EXTERNAL": "rm", "PLANE": "rm", "POINT": "rm"}
        found: int | str | None = getattr(self, at.get(self.shape or "", "cm"))
        return found

    @property
    def missing(self) -> list[str]:
        """Keywords of what the shape lacks."""
        words = [
            self.arguments[field].key
            for field in self.needs.get(self.shape or "", ())
            if not self.given(field)
        ]
        if self.shape == "CYLINDER" and not (self.given("radius") or self.given("rm")):
            words.append("RADIUS")
        return words

    def size(self, field: str) -> float:
        """A length that is given."""
        return float(getattr(self, field))

"""Arguments that several statements share: the frame of a body, the reaction of a force."""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.language.routines import ARGUMENT
from adamslite.language.statement import expression, number, reference, text, vector

if TYPE_CHECKING:
    from adamslite.language.statement import Field


def body_origin() -> Field:
    """Where the frame of a body starts."""
    return vector(
        "QG",
        start=True,
        size=3,
        unit="length",
        default=(0.0, 0.0, 0.0),
        help="origin of the body, in ground",
    )


def body_angles() -> Field:
    """Its axes by angles."""
    return vector(
        "REULER", "EULER", start=True, size=3, unit="angle", default=(0.0, 0.0, 0.0),
        help="body 3-1-3 angles of the body frame in ground",
    )  # fmt: skip


def body_z_point() -> Field:
    """Its z axis by a point."""
    return vector(
        "ZG", start=True, size=3, unit="length", help="point in ground on the +z axis of the body"
    )


def body_x_point() -> Field:
    """Its x axis by a point."""
    return vector(
        "XG",
        start=True,
        size=3,
        unit="length",
        help="point in ground in the +xz half-plane of the body",
    )


def body_rate(key: str, unit: str, help: str) -> float:
    """A component of its velocity at the start."""
    return number(key, start=True, unit=f"{unit}/time", default=0.0, help=f"initial {help}")


def reaction_marker() -> Field:
    """What takes the reaction, by a marker that follows the other one."""
    return reference(
        "JFLOAT", "J", to="MARKER", help="floating marker on the part that takes the reaction"
    )


def reaction_part() -> Field:
    """What takes the reaction, by its part."""
    return reference("J_PART", to="PART", help="part that takes the reaction")


def component_axes() -> Field:
    """The axes that components are along."""
    return reference("RM", to="MARKER", default=0, help="marker whose axes the components refer to")


def component_vector(key: str, unit: str) -> Field:
    """All three components at once, by a vector: ``FXYZ`` for FX, FY and FZ."""
    fields = tuple(key[0].lower() + axis for axis in "xyz")
    written = ", ".join(fields).upper()
    return expression(key, unit=unit, fills=fields, help=f"a vector: {written} at once")


def components_of_routine(*fields: str, unit: str) -> Field:
    """All components at once, from a routine of the user."""
    written = ", ".join(fields).upper()
    help = f"USER(...), a routine: {written} at once"
    return expression(ARGUMENT, unit=unit, fills=fields, help=help)


def routine_name() -> Field:
    """Which routine FUNCTION=USER means."""
    return text("ROUTINE", help="library::name of the routine of FUNCTION=USER(...)")

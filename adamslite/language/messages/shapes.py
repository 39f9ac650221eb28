"""Messages about shapes and the contact between them."""

from __future__ import annotations

from adamslite.language.messages.entry import Message

SHAPES: dict[str, Message] = {
    "no-shape": Message(
        "{label} has no shape",
        "one of {listed}",
        ("GRAPHICS/1, CM=2", "GRAPHICS/1, RADIUS=1, LENGTH=2, CM=1"),
    ),
    "shape-incomplete": Message(
        "{label}: {kind} needs {listed}",
        "",
        ("GRAPHICS/1, CYLINDER, CM=2, LENGTH=1", "GRAPHICS/1, ELLIPSOID, CM=2, XS=1, YS=1",
         "GRAPHICS/1, BOX, X=1, Y=1, Z=1", "GRAPHICS/1, PLANE, XMIN=1",
         "GRAPHICS/1, FORCE, EID=1, EMARKER=2", "GRAPHICS/1, SPDP, I=1"),
    ),
}  # fmt: skip

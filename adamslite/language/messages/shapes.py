"""Messages about shapes and the contact between them."""

from __future__ import annotations

from adamslite.language.messages.entry import Message

SHEET = "GRAPHICS/2, PLANE, RM=1\n"
FLOOR = f"GRAPHICS/1, ELLIPSOID, CM=2, XS=1, YS=1, ZS=1\n{SHEET}"
BOXES = "GRAPHICS/1, BOX, CORNER=2, X=1, Y=1, Z=1\nGRAPHICS/2, BOX, CORNER=1, X=1, Y=1, Z=1\n"
MEET = "CONTACT/1, IGEOM=1, JGEOM=2, POISSON, PENALTY=1, RESTITUTION=1"

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
         "GRAPHICS/1, FORCE, EID=1, EMARKER=2", "GRAPHICS/1, SPDP, I=1",
         FLOOR + "CONTACT/1, IGEOM=1, JGEOM=2, IMPACT, STIFFNESS=1",
         FLOOR + f"{MEET}, COULOMB_FRICTION=ON, MU_STATIC=1",
         "JOINT/1, REVOLUTE, I=2, J=1\nFRICTION/1, JOINT=1, FORMULATION=LUGRE"),
    ),
    "contact-shape": Message(
        "{label} cannot compute how {shape} touches: it is of kind {kind}",
        "write it as ELLIPSOID with equal scales, BOX, CYLINDER or PLANE",
        (SHEET + "GRAPHICS/1, EXTERNAL, RM=2, FILE=a.xmt_txt\n" + MEET,
         SHEET + "GRAPHICS/1, ELLIPSOID, CM=2, XS=1, YS=2, ZS=1\n" + MEET,
         SHEET + "GRAPHICS/1, CYLINDER, CM=2, LENGTH=1, RM=1\n" + MEET,
         SHEET + "GRAPHICS/1, TORUS, CM=2, MAJOR=1, MINOR=0.1\n" + MEET),
    ),
    "contact-pair": Message(
        "{label}: contact of {first} with {second} is not supported",
        "put POINTs, or ELLIPSOIDs with equal scales, where they touch",
        (BOXES + MEET,
         "GRAPHICS/1, PLANE, RM=1\nGRAPHICS/2, PLANE, RM=2\n" + MEET,
         "GRAPHICS/1, POINT, RM=1\nGRAPHICS/2, POINT, RM=2\n" + MEET),
    ),
    "contact-parts": Message(
        "{word} of {label} has shapes on two bodies, {first} and {other}",
        "write a CONTACT for each of them",
        (FLOOR + "GRAPHICS/3, POINT, RM=3\n"
         "CONTACT/1, IGEOM=1,3, JGEOM=2, POISSON, PENALTY=1, RESTITUTION=1",),
    ),
    "contact-same-part": Message(
        "both sides of {label} are on {owner}",
        "a part does not touch itself",
        ("GRAPHICS/2, PLANE, RM=2\nGRAPHICS/1, POINT, RM=2\n" + MEET,),
    ),
    "contact-friction": Message(
        "{high} of {label} is too small beside {low}",
        "friction falls from MU_STATIC to MU_DYNAMIC between the two transition velocities",
        (FLOOR + f"{MEET}, COULOMB_FRICTION=ON, MU_STATIC=0.1, MU_DYNAMIC=0.2"
         ", STICTION_TRANSITION_VELOCITY=1, FRICTION_TRANSITION_VELOCITY=2",
         FLOOR + f"{MEET}, COULOMB_FRICTION=ON, MU_STATIC=0.2, MU_DYNAMIC=0.1"
         ", STICTION_TRANSITION_VELOCITY=2, FRICTION_TRANSITION_VELOCITY=2"),
    ),
}  # fmt: skip

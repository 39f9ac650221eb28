"""Messages about constraints."""

from __future__ import annotations

from adamslite.language.messages.entry import Message

LINE = "MATRIX/1, ROWS=2, COLUMNS=3, VALUES=0,0,0,1,0,0\nCURVE/1, OPEN, MATRIX=1\n"
_PAIR = "JOINT/1, CYLINDRICAL, I=2, J=1\nPART/5, MASS=1, CM=5, IP=1,1,1\nMARKER/5, PART=5\n"
_BALL = _PAIR + "JOINT/2, SPHERICAL, I=5, J=1\n"
_PIN = _PAIR + "JOINT/2, REVOLUTE, I=5, J=1\n"

CONSTRAINTS: dict[str, Message] = {
    "joint-size": Message(
        "{label} is a {kind} {word}",
        "SCREW needs its PITCH, RACKPIN the pitch diameter PD of the pinion",
        ("JOINT/1, SCREW, I=2, J=1", "JOINT/1, RACKPIN, I=2, J=1, PD=0"),
    ),
    "coupled-count": Message(
        "{label} has {count} joints and couples {expected}",
        "",
        (_PIN + "COUPLER/1, JOINTS=2, SCALES=1", _PIN + "GEAR/1, JOINTS=1,2,1, CV=1"),
    ),
    "scale-count": Message(
        "{label} has {count} scales for {joints} joints",
        "give one for each joint; the first may be left out and is 1",
        (_PIN + "COUPLER/1, JOINTS=1,2, SCALES=1,2,3, TYPE=T:R",),
    ),
    "type-count": Message(
        "TYPE of {label} has {count} letters for {joints} joints",
        "give T or R for each joint, separated by colons",
        (_PIN + "COUPLER/1, JOINTS=1,2, SCALES=1,2, TYPE=R",),
    ),
    "freedom-unclear": Message(
        "{label} does not specify which freedom of {joint} it couples",
        "",
        (_PIN + "COUPLER/1, JOINTS=1,2, SCALES=1,2", _PIN + "MOTION/1, JOINT=1, FUNCTION=TIME"),
    ),
    "no-such-freedom": Message(
        "{label} needs a freedom that {joint}, {kind}, does not have",
        "TRANSLATIONAL joints translate, REVOLUTE joints rotate, CYLINDRICAL joints do both",
        (
            _BALL + "COUPLER/1, JOINTS=1,2, SCALES=1,2, TYPE=R:R",
            _PIN + "COUPLER/1, JOINTS=1,2, SCALES=1,2, TYPE=R:T",
            _BALL + "MOTION/1, JOINT=2, FUNCTION=TIME",
            _PIN + "MOTION/1, JOINT=2, TRANSLATION, FUNCTION=TIME",
            _BALL + "GEAR/1, JOINTS=1,2, CV=1",
        ),
    ),
    "not-on-carrier": Message(
        "CV of {label} is on {owner}, the J marker of {joint} is not",
        "the J markers of both joints and CV belong to the part that carries the gears",
        (_PIN + "GEAR/1, JOINTS=1,2, CV=5",),
    ),
    "matrix-size": Message(
        "{label} has {count} VALUES and needs {expected}",
        "one for each of ROWS times COLUMNS; SPARSE: row, column and number of each",
        (
            "MATRIX/1, ROWS=2, COLUMNS=3, VALUES=1,2,3,4,5",
            "MATRIX/1, SPARSE, ROWS=2, COLUMNS=3, VALUES=1,2,3,4",
        ),
    ),
    "curve-not-plane": Message(
        "{label} cannot roll {curve}, which is not plane",
        "z of its points, the third column of its MATRIX, is zero for a CVCV",
        (
            "MATRIX/1, ROWS=3, COLUMNS=3, VALUES=0,0,0,1,0,0.1,2,1,0\n"
            "MATRIX/2, ROWS=2, COLUMNS=3, VALUES=0,0,0,1,0,0\n"
            "CURVE/1, MATRIX=1\nCURVE/2, MATRIX=2\n"
            "CVCV/1, ICURVE=1, JCURVE=2, IRM=2, JRM=1",
        ),
    ),
    "matrix-place": Message(
        "{label} has a value at {place}",
        "a row and a column of it are whole numbers from 1 to ROWS and to COLUMNS",
        (
            "MATRIX/1, SPARSE, ROWS=2, COLUMNS=3, VALUES=1,2,3, 3,1,4",
            "MATRIX/1, SPARSE, ROWS=2, COLUMNS=3, VALUES=0,1,4",
        ),
    ),
    "matrix-too-large": Message(
        "{label} has {elements} elements, and at most {most} are worked with",
        "zeros count; split the system into several",
        ("MATRIX/1, SPARSE, ROWS=1001, COLUMNS=1000, VALUES=1,1,4",),
    ),
    "matrix-sources": Message(
        "{label} has its elements twice: {word} excludes another argument",
        "give VALUES by FULL or by SPARSE, or FILE",
        (
            "MATRIX/1, FULL=RORDER, SPARSE, ROWS=1, COLUMNS=1, VALUES=1,1,1",
            "MATRIX/1, FILE=a.csv, ROWS=1, COLUMNS=1, VALUES=1",
        ),
    ),
    "curve-points": Message(
        "{label} cannot pass through the points of {matrix}",
        "its rows are points x, y, z; at least {least}, each different from the one before",
        (
            "MATRIX/1, ROWS=2, COLUMNS=3, VALUES=1,2,3,1,2,3\nCURVE/1, OPEN, MATRIX=1",
            "MATRIX/1, ROWS=2, COLUMNS=2, VALUES=1,2,3,4\nCURVE/1, OPEN, MATRIX=1",
            "MATRIX/1, ROWS=2, COLUMNS=3, VALUES=1,2,3,1,2,3\nCURVE/1, CLOSED, MATRIX=1",
        ),
    ),
    "curve-open": Message(
        "{label} is CLOSED, and the last point of {matrix} is {gap} away from the first one",
        "repeat the first point as the last row",
        (
            "MATRIX/1, ROWS=4, COLUMNS=3, VALUES=1,0,0,0,1,0,-1,0,0,0,-1,0\n"
            "CURVE/1, CLOSED, MATRIX=1",
        ),
    ),
    "curve-order": Message(
        "{label} has ORDER={order}; curves can only be of order 4",
        "of order 4 are pieces of degree 3, with continuous slopes and bends",
        (LINE + "CURVE/2, OPEN, MATRIX=1, ORDER=2",),
    ),
    "motion-nowhere": Message(
        "{label} does not specify what it drives",
        "give JOINT=, or I= and J= with one of X, Y, Z, B1, B2, B3",
        ("MOTION/1, FUNCTION=TIME", "MOTION/1, I=2, X, FUNCTION=TIME"),
    ),
    "motion-no-axis": Message(
        "{label} does not specify which freedom it drives",
        "give one of X, Y, Z, B1, B2, B3; TRANSLATION and ROTATION are those of a joint",
        ("MOTION/1, I=2, J=1, FUNCTION=TIME", "MOTION/1, I=2, J=1, ROTATION, FUNCTION=TIME"),
    ),
    "motion-two-ways": Message(
        "{label} has both JOINT and markers",
        "leave out I and J: those of the joint are used",
        (_PIN + "MOTION/1, JOINT=2, I=5, J=1, FUNCTION=TIME",),
    ),
    "motion-twice": Message(
        "{label} drives what {other} drives already",
        "both prescribe {freedom} of the same markers",
        (
            _PIN + "MOTION/1, JOINT=2, FUNCTION=TIME\nMOTION/2, JOINT=2, FUNCTION=2*TIME",
            "MOTION/1, I=2, J=1, X, FUNCTION=TIME\nMOTION/2, I=2, J=1, X, FUNCTION=TIME",
        ),
    ),
    "freedom-held": Message(
        "{label} drives {freedom}, which {joint} holds",
        "the joint between these markers leaves no such freedom",
        (_PIN + "MOTION/1, I=5, J=1, X, FUNCTION=TIME",),
    ),
    "motion-not-of-time": Message(
        "FUNCTION of {label} depends on {word}, not on TIME alone",
        "a motion follows TIME and variables of TIME; use a force, or a GCON",
        (
            _PIN + "MOTION/1, JOINT=2, FUNCTION=AZ(2,1)",
            _PIN + "VARIABLE/1, FUNCTION=DX(2)\nMOTION/1, JOINT=2, FUNCTION=VARVAL(1)*TIME",
            _PIN + "MOTION/1, JOINT=2, FUNCTION=TIME*MODE",
        ),
    ),
    "delayed-constraint": Message(
        "FUNCTION of {label} takes values of the past: {word}",
        "they may jump, which a constraint cannot follow: use a force, or TIME-delay for TIME",
        (
            _PIN + "MOTION/1, JOINT=2, FUNCTION=DELAY(SIN(TIME),0.1)",
            "VARIABLE/1, FUNCTION=DELAY(DX(2),0.1)\nGCON/1, FUNCTION=DY(2)-VARVAL(1)",
        ),
    ),
    "no-rate": Message(
        "{label} needs the rate of {what}",
        "a GCON takes displacements, velocities and TIME; d( )/dt takes what these and DIF make up",
        (
            "GCON/1, FUNCTION=ACCX(2)-1",
            "DIFF/1, FUNCTION=TIME\nGCON/1, FUNCTION=DX(2)-DIF(1)",
            "VARIABLE/1, FUNCTION=VARVAL(1)/2+DX(2)\nGCON/1, FUNCTION=VARVAL(1)",
            "VARIABLE/1, FUNCTION=VARVAL(1)/2+TIME\nREQUEST/1, F1=VARVAL(d(1)/dt)",
            "VARIABLE/1, FUNCTION=ACCX(2)\n"
            "SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=VARVAL(d(1)/dt)",
        ),
    ),
    "joint-friction": Message(
        "{label} has friction of its own, a form of older versions that is not supported",
        "write FRICTION/1, JOINT={id}, MU_STATIC=..., MU_DYNAMIC=... in its place",
        (
            "JOINT/1, REVOLUTE, I=1, J=2, MU_STAT_ROT=0, MU_DYN_ROT=0.2, OUTER_RADIUS=0.1",
            "JOINT/1, TRANSLATIONAL, I=1, J=2, FRICTION=ON, DELTA_V=0.1",
        ),
    ),
    "gcon-marker": Message(
        "FUNCTION of {label} does not measure at MARKER/{key}",
        "the reaction of a GCON is known at the markers of its FUNCTION: {listed}",
        ("GCON/1, I=3, FUNCTION=DM(2,1)-1", "GCON/1, I=2, J=1, FUNCTION=DY(2)"),
    ),
    "force-loop": Message(
        "{label} needs the force of {other}, which depends on itself",
        "measure it in a VARIABLE, which is solved for, or name the other forces one by one",
        (
            "SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=-TM(2,1)/2",
            "SFORCE/1, ROTATIONAL, I=2, J=1, FUNCTION=SFORCE(2,0,1,0)/2\n"
            "SFORCE/2, ROTATIONAL, I=2, J=1, FUNCTION=SFORCE(1,0,1,0)/2",
        ),
    ),
}

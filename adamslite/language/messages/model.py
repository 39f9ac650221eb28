"""Messages about several statements together."""

from __future__ import annotations

from adamslite.language.diagnostics import NOTE, WARNING
from adamslite.language.messages.constraints import LINE
from adamslite.language.messages.entry import Message

MODEL: dict[str, Message] = {
    "effective-mass": Message(
        "{label} pushes {body} along its own acceleration: "
        "its effective mass along {axis} is {mass}",
        "",
        (
            "PART/4, MASS=1, CM=4, IP=1,1,1\nMARKER/4, PART=4\n"
            "VFORCE/4, I=4, J_part=(ground), FX=0.5*ACCX(4)",
            "VARIABLE/Dm, FUNCTION=10*TIME\n"
            "VFORCE/4, I=2, J_part=(ground), FY=VARVAL(Dm)/Gc*(ACCY(2,0,0)-JGRAV)",
        ),
        severity=WARNING,
    ),
    "no-ground": Message(
        "no part is the ground",
        "add PART/1, GROUND",
        ("title\nPOINT_MASS/1, MASS=1\nMARKER/1\nEND",),
    ),
    "two-grounds": Message(
        "{label} is a second ground part", "exactly one part is GROUND", ("PART/4, GROUND",)
    ),
    "ground-with-data": Message(
        "the ground part has {word}, which has no effect",
        "",
        ("title\nPART/1, GROUND, VX=1\n", "title\nPART/1, GROUND, MASS=3\n"),
        severity=WARNING,
    ),
    "no-mass": Message(
        "{label} has no mass",
        "every body needs MASS= above zero, except a PART that constraints carry",
        ("PART/4", "POINT_MASS/4, MASS=0"),
    ),
    "zero-mass": Message(
        "MASS=0 is taken as given: {listed}",
        "such a PART has no weight and resists no acceleration; constraints alone carry it. Leave "
        "out MASS where that is meant",
        ("PART/4, MASS=0\nMARKER/4, PART=4\nJOINT/1, FIXED, I=2, J=4",),
        severity=NOTE,
    ),
    "negative-mass": Message(
        "{label} has a negative mass, {mass:g}",
        "a force along its motion would slow it down: give MASS= above zero",
        ("POINT_MASS/4, MASS=-1", "PART/4, MASS=-2, CM=4, IP=1,1,1\nMARKER/4, PART=4"),
    ),
    "no-cm": Message(
        "{label} has a mass but no CM",
        "CM= names the marker at the centre of mass",
        ("PART/4, MASS=1",),
    ),
    "no-inertia": Message(
        "{label} has no inertia IP",
        "a body that does not rotate is a POINT_MASS; else give IP=xx,yy,zz",
        ("PART/4, MASS=1, CM=4\nMARKER/4, PART=4",),
        severity=WARNING,
    ),
    "bad-inertia": Message(
        "the inertia of {label} belongs to no body: {reason}",
        "moments are not negative and none exceeds the sum of the other two",
        ("PART/4, MASS=1, CM=4, IP=1,1,3\nMARKER/4, PART=4",
         "PART/4, MASS=1, CM=4, IP=-1,1,1\nMARKER/4, PART=4",
         "PART/4, MASS=1, CM=4, IP=1,1,1,2,0,0\nMARKER/4, PART=4",
         "PART/4, MASS=1, CM=4, IM=5, IP=1,1,1\nMARKER/4, PART=4\nMARKER/5, PART=4, QP=0,0,2"),
        severity=WARNING,
    ),
    "foreign-marker": Message(
        "{word} of {label} is on another body",
        "MARKER/{key} belongs to {owner}",
        ("PART/4, MASS=1, CM=2, IP=1,1,1",
         "PART/4, MASS=1, CM=4, IM=2, IP=1,1,1\nMARKER/4, PART=4",
         LINE + "MARKER/4, PART=2, FLOATING\nPTCV/1, I=3, JFLOAT=4, CURVE=1, RM=1"),
    ),
    "marker-circle": Message(
        "MARKER/{key}, to which RM of {label} refers, is itself placed by {label}",
        "one of them has to be placed in the body frame",
        ("MARKER/4, PART=2, RM=4", "MARKER/4, PART=2, RM=5\nMARKER/5, PART=2, RM=4"),
    ),
    "no-owner": Message(
        "{label} belongs to no body",
        "give PART= or POINT_MASS=, or put it after the body",
        ("title\nMARKER/1, QP=1,2,3\nPART/1, GROUND\n",),
    ),
    "two-owners": Message(
        "{label} has both PART and POINT_MASS", "", ("MARKER/4, PART=2, POINT_MASS=3",)
    ),
    "orientation-twice": Message(
        "{label} gives its axes by angles and by points",
        "give REULER, or the points, not both",
        ("MARKER/4, PART=1, REULER=1,2,3, ZP=0,0,1",
         "POINT_MASS/4, MASS=1, REULER=1,2,3, XG=1,0,0"),
    ),
    "orientation-incomplete": Message(
        "{label} gives only one of the two points it needs",
        "{word}",
        ("MARKER/4, PART=1, USEXP, ZP=0,0,1", "MARKER/4, PART=1, USEXP"),
    ),
    "orientation-nowhere": Message(
        "{word} of {label} is its own origin and gives no direction",
        "{word} is a point on the axis, in the coordinates in which the origin is given",
        ("MARKER/4, PART=1, ZP=0,0,0", "MARKER/4, PART=1, QP=1,2,3, ZP=1,2,3"),
    ),
    "orientation-flat": Message(
        "{word} of {label} lies on the {axis} axis that {other} gives",
        "give a point beside that axis; it fixes the directions of the other two",
        ("MARKER/4, PART=1, ZP=0,0,1, XP=0,0,2", "MARKER/4, PART=1, USEXP, XP=0,1,0, ZP=0,-2,0",
         "MARKER/4, PART=1, QP=1,2,3, ZP=1,2,4, XP=1,2,0",
         "PART/4, MASS=1, CM=4, IP=1,1,1, ZG=0,1,1, XG=0,3,3\nMARKER/4, PART=4",
         "POINT_MASS/4, MASS=1, ZG=0,1,1, XG=0,-0.3,-0.3"),
    ),
    "markers-opposed": Message(
        "MARKER/{i} and MARKER/{j} of {label} are half a turn apart: their {axes} axes point "
        "opposite ways",
        "the joint {kind} expects axes with equal directions; it keeps them as drawn",
        ("MARKER/4, PART=1, REULER=0,180D,0\nJOINT/1, FIXED, I=2, J=4",
         "MARKER/4, PART=1, REULER=180D,0,0\nJOINT/1, TRANSLATIONAL, I=2, J=4",
         "MARKER/4, PART=1, ZP=0,0,-1\nJOINT/1, REVOLUTE, I=2, J=4",
         "MARKER/4, PART=1, ZP=0,0,-1\nJPRIM/1, ORIENTATION, I=2, J=4"),
        severity=WARNING,
    ),
    "floating-placed": Message(
        "{label} is FLOATING and is given a position",
        "the solver places it: leave out QP, REULER, ZP and XP",
        ("MARKER/4, PART=1, FLOATING, QP=1,2,3\nVFORCE/1, I=2, JFLOAT=4, FX=1",),
    ),
    "floating-unused": Message(
        "FLOATING and used by no force: {listed}",
        "leave them out, or name them as JFLOAT",
        ("MARKER/4, PART=1, FLOATING", "MARKER/4, PART=1, FLOATING\nMARKER/5, PART=2, FLOATING"),
        severity=NOTE,
    ),
    "flexible-body": Message(
        "{label} uses MARKER/{key} of {body}, and flexible bodies are not supported",
        "{instead}",
        ("FLEX_BODY/4, MTX_FILE=a.mtx\nMARKER/4, FLEX_BODY=4, NODE_ID=1000\n"
         "JOINT/1, FIXED, I=2, J=4", "FE_PART/4\nMARKER/4\nREQUEST/1, F1=DX(4)"),
    ),
    "output-form": Message(
        "{word} of OUTPUT is passed over; with it ADAMS writes other numbers for REQUEST/{kind}",
        "here angles are PSI, THETA, PHI and nothing is scaled; write F1=..., F2=... for others",
        ("OUTPUT/YPR\nREQUEST/1, D, I=2", "OUTPUT/REQSAVE, DSCALE=(1000,1)\nREQUEST/1, D, I=2"),
        severity=WARNING,
    ),
    "passed-over": Message(
        "passed over, as it does not change the motion: {listed}",
        "",
        ("PREFERENCES/SOLVER=CXX\nSTRING/1, STRING=a\nSTRING/2, STRING=b",
         "KINEMATICS/HMAX=0.1", "MATERIAL/1, NAME=steel, DENSITY=7801.0",
         "FLEX_BODY/4\nMARKER/4, FLEX_BODY=4"),
        commands=("ENVIRONMENT/NAME=A, VALUE=C:\\b", "OUTPUT/NOSEP\nRESULTS/\nRESULTS/"),
        severity=NOTE,
    ),
    "floating-misused": Message(
        "{word} of {label} is a FLOATING marker",
        "MARKER/{key} has no position of its own; it may be JFLOAT, or a marker between which "
        "REQUEST/FORCE and FX, FY ... TZ measure",
        ("MARKER/4, PART=1, FLOATING\nVFORCE/1, I=2, JFLOAT=4, FX=1\n"
         "SFORCE/1, I=2, J=4, FUNCTION=1",
         "MARKER/4, PART=1, FLOATING\nVFORCE/1, I=2, JFLOAT=4, FX=DX(2,4)",
         "MARKER/4, PART=1, FLOATING\nVFORCE/1, I=2, JFLOAT=4, FX=1\n"
         "REQUEST/1, FORCE, I=2, J=4, RM=4",
         "MARKER/4, PART=1, FLOATING\nVFORCE/1, I=2, JFLOAT=4, FX=1\n"
         "REQUEST/1, F2=FX(2,4,4)"),
    ),
    "not-floating": Message(
        "JFLOAT of {label} is not a FLOATING marker",
        "add FLOATING to MARKER/{key}, or name the part: J_PART=",
        ("VFORCE/1, I=2, JFLOAT=1, FX=1",),
    ),
    "no-reaction": Message(
        "{label} does not name the part that takes its reaction",
        "give JFLOAT= or J_PART=; J_PART=ground drops it",
        ("VFORCE/1, I=2, FX=1",),
    ),
    "two-reactions": Message(
        "{label} has both JFLOAT and J_PART", "", (
            "MARKER/4, PART=1, FLOATING\nVFORCE/1, I=2, JFLOAT=4, J_PART=1, FX=1",)
    ),
    "reaction-on-other-part": Message(
        "the reaction of {label} is to act on {word}, but marker J is on {owner}",
        "J_PART= is the part of marker J, or ground to drop the reaction",
        ("PART/4, MASS=1, CM=4, IP=1,1,1\nMARKER/4, PART=4\n"
         "SFORCE/1, I=3, J=2, J_PART=4, FUNCTION=1",),
    ),
    "same-marker": Message(
        "I and J of {label} are the same marker",
        "a force along the line between them has no direction; ACTIONONLY acts along z of J",
        ("SFORCE/1, I=2, J=2, FUNCTION=1", "SPRINGDAMPER/1, I=2, J=2, K=1"),
    ),
    "same-body": Message(
        "I and J of {label} are on the same body",
        "both belong to {owner}, which the statement then does not act on",
        ("MARKER/4, PART=2\nJOINT/1, FIXED, I=2, J=4",
         "MARKER/4, PART=2\nJPRIM/1, INLINE, I=2, J=4",
         "MARKER/4, PART=2\nMOTION/1, I=2, J=4, X, FUNCTION=TIME",
         LINE + "MARKER/4, PART=2\nPTCV/1, I=2, CURVE=1, RM=4",
         "VFORCE/1, I=2, J_PART=2, FX=1"),
    ),
    "internal-force": Message(
        "I and J of {label} are on the same body",
        "both belong to {owner}, and the force cancels itself",
        ("MARKER/4, PART=2, QP=1,0,0\nSFORCE/1, I=2, J=4, FUNCTION=1",),
        severity=WARNING,
    ),
    "torque-on-point": Message(
        "{label} puts a torque on {owner}",
        "a POINT_MASS cannot rotate; make it a PART",
        ("SFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION=1", "JOINT/1, REVOLUTE, I=1, J=3",
         "JPRIM/1, ORIENTATION, I=1, J=3", "MOTION/1, I=3, J=1, B3, FUNCTION=TIME",
         "BUSHING/1, I=3, J=1, K=1,1,1",
         "GFORCE/1, I=2, J_PART=1, TX=1\nVTORQUE/1, I=3, J_PART=1, TX=1"),
    ),
    "two-dampings": Message(
        "{label} has both CRATIO and CMATRIX",
        "CRATIO derives the damping from the stiffness; CMATRIX gives it directly",
        ("FIELD/1, I=2, J=1, CRATIO=1, CMATRIX=" + ",".join(["1"] * 36),),
    ),
    "friction-not-there": Message(
        "{label} cannot act in {joint}: friction of a joint {kind} is not supported",
        "translational, revolute, cylindrical, spherical, Hooke and universal joints have friction",
        ("JOINT/1, PLANAR, I=2, J=1\nFRICTION/1, JOINT=1",),
    ),
    "friction-transition": Message(
        "{label} must end its transition beyond STICTION_TRANSITION_VELOCITY",
        "a TRANSITION_VELOCITY_COEFFICIENT is larger than 1; 1.5 is the default",
        ("JOINT/1, REVOLUTE, I=2, J=1\nFRICTION/1, JOINT=1, TRANSITION_VELOCITY_COEFFICIENT=1",),
    ),
    "not-with-bristles": Message(
        "{word} of {label} does not go with FORMULATION=LUGRE",
        "the law has no regimes that could act alone: delete EFFECT",
        ("JOINT/1, REVOLUTE, I=2, J=1\nFRICTION/1, JOINT=1, FORMULATION=LUGRE, EFFECT=SLIDING"
         ", BRISTLE=1, DAMPING=1, VISCOUS=1, VELOCITY=1, DECAY=2",),
    ),
    "no-effect": Message(
        "{word} has no effect in {label}",
        "{reason}",
        ("JOINT/1, REVOLUTE, I=2, J=1, PITCH=1", "JOINT/1, SPHERICAL, I=2, J=1, IC=1",
         "MOTION/1, I=2, J=1, X, ICDISP=1, FUNCTION=TIME",
         "MARKER/4, PART=1, QP=1,0,0\nSPRINGDAMPER/1, I=2, J=4, KT=1",
         "MARKER/4, PART=1, USEXP, XP=1,0,0, ZP=0,0,1\n"
         "SPRINGDAMPER/1, ROTATIONAL, I=2, J=4, K=1",
         "INTEGRATOR/HHT, KMAX=3", "INTEGRATOR/RKF45\nINTEGRATOR/PATTERN=T:F",
         "SENSOR/1, HALT, VALUE=1, BISECTION, FUNCTION=TIME",
         "SENSOR/1, RETURN, DT=1, FUNCTION=TIME",
         "SENSOR/1, RETURN, STEPSIZE=1, CODGEN, RESTART, FUNCTION=TIME",
         "INTEGRATOR/NEWMARK, ALPHA=-0.2", "INTEGRATOR/RADAU, ADAPTIVITY=1E-8",
         "JOINT/1, REVOLUTE, I=2, J=1\nFRICTION/1, JOINT=1, EFFECT=SLIDING"
         ", MAX_STICTION_DEFORMATION=1"),
        severity=WARNING,
    ),
    "units-incomplete": Message(
        "UNITS gives only {word}",
        "give FORCE, MASS, LENGTH and TIME together, or SYSTEM, or UCF",
        ("UNITS/FORCE=NEWTON",),
    ),
    "units-twice": Message(
        "UNITS is given in two ways",
        "give the four units, or SYSTEM, or UCF",
        ("UNITS/SYSTEM=MKS, UCF=1",),
    ),
    "not-positive": Message(
        "{word} of {label} must be above zero",
        "",
        ("MATRIX/1, ROWS=-2, COLUMNS=-2, VALUES=1,2,3,4", "UNITS/UCF=0",
         "INTEGRATOR/ERROR=0", "INTEGRATOR/HMAX=-1", "INTEGRATOR/KMAX=0",
         "SIMULATE/DYNAMICS, END=1, STEPS=0", "SIMULATE/DYNAMICS, DURATION=0, STEPS=1"),
    ),
    "out-of-range": Message(
        "{word} of {label} must lie between {low} and {high}",
        "",
        ("INTEGRATOR/HHT, ALPHA=-0.5",),
    ),
    "steps-disordered": Message(
        "HMIN of INTEGRATOR is larger than HMAX", "", ("INTEGRATOR/HMIN=1, HMAX=0.1",)
    ),
    "empty-request": Message(
        "{label} requests nothing",
        "give DISPLACEMENT, VELOCITY, ACCELERATION or FORCE with I=, expressions F1= to F8=, or "
        "VARIABLES=",
        ("REQUEST/1", "REQUEST/1, DISPLACEMENT", "REQUEST/1, I=2", "MREQUEST/1, FORCE"),
    ),
    "two-requests": Message(
        "{label} requests both {word} and {other}",
        "write two REQUEST statements",
        ("REQUEST/1, DISPLACEMENT, I=2, F1=1",
         "VARIABLE/1, FUNCTION=1\nREQUEST/1, F1=2\\ VARIABLES=1"),
    ),
    "reserved-name": Message(
        "{label} has a reserved name",
        "{word} in an expression always means something else; choose another name",
        ("VARIABLE/Time, FUNCTION=1", "VARIABLE/pi, FUNCTION=1"),
    ),
}  # fmt: skip

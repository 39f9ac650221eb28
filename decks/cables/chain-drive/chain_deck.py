"""The text of the deck of a chain drive (chain.Chain)."""

TOP = """Chain drive: {n} pins run around sprockets with {z1} and {z2} teeth
! Written by make_reference.py. Pitch {pitch:g} m; the driver (PART/1001) turns at {speed:g} rad/s.
! A pin at the angle a of a sprocket meets its rim (IMPACT, along the radius) at
! R + H (sqrt(sin(z a/2)**2 + e**2) - e), teeth of the height H with blunt roots; the force is
! normal to the rim.

UNITS/SYSTEM=MKS

PART/1000, GROUND
MARKER/1000, PART=1000
MARKER/1010, PART=1000, QP={distance:.12g},0,0, REULER=90D,90D,0 ! z along the way of the tensioner

PART/1001, MASS=1, CM=1001, IP={inertia:g},{inertia:g},{inertia:g}, WZ={speed:g} ! driver
MARKER/1001, PART=1001
MARKER/1101, PART=1001, FLOATING
JOINT/1, REVOLUTE, I=1001, J=1000
MOTION/1, JOINT=1, FUNCTION={speed:g}*TIME

PART/1002, MASS=2, CM=1002, IP=0.01,0.01,0.01, QG={distance:.12g},0,0, VX={drift:.12g}
MARKER/1002, PART=1002                             ! mount of the tensioner
MARKER/1012, PART=1002, REULER=90D,90D,0
JOINT/2, TRANSLATIONAL, I=1012, J=1010
SFORCE/1002, TRANSLATIONAL, ACTIONONLY, I=1012, J=1010, FUNCTION={pull:g}

PART/1003, MASS=1, CM=1003, IP={inertia:g},{inertia:g},{inertia:g}, QG={distance:.12g},0,0
, REULER={turn:.12g},0,0, VX={drift:.12g}, WZ={driven:.12g} ! driven sprocket
MARKER/1003, PART=1003
MARKER/1103, PART=1003, FLOATING
JOINT/3, REVOLUTE, I=1003, J=1002
SFORCE/1003, ROTATIONAL, I=1003, J=1002, FUNCTION=-{load:g}-{brake:g}*(WZ(1003)-{mean:.12g})
"""
PIN = """
POINT_MASS/{k}, MASS={mass:.12g}, CM={k}, QG={x:.12g},{y:.12g},0, VX={vx:.12g}, VY={vy:.12g}
MARKER/{k}, POINT_MASS={k}
SFORCE/{k}, I={k}, J={next}, FUNCTION=-{stiffness:.12g}*(DM({k},{next})-{free:.12g})
, -{damping:.8g}*VR({k},{next})
"""
# P: radial force outwards, Q: tangential force with the sense of the turn.
CONTACT = """VARIABLE/A{s}{k}, FUNCTION={z}*(ATAN2(DY({k},{c}),DX({k},{c}))-AZ({c}))
VARIABLE/H{s}{k}, FUNCTION=SQRT((1-COS(A{s}{k}))/2+{blunt:g})
VARIABLE/P{s}{k}, FUNCTION=IMPACT(DM({k},{c}),VR({k},{c}),
, {radius:.12g}+{tooth:g}*(H{s}{k}-{root:g}),{seat:g},1.0,{damping:g},1E-4)
VARIABLE/Q{s}{k}, FUNCTION=-P{s}{k}*{steep:g}*SIN(A{s}{k})/H{s}{k}/DM({k},{c})
VFORCE/{s}{k}, I={k}, JFLOAT={floating}, RM=1000
, FX=(P{s}{k}*DX({k},{c})-Q{s}{k}*DY({k},{c}))/DM({k},{c})\\
, FY=(P{s}{k}*DY({k},{c})+Q{s}{k}*DX({k},{c}))/DM({k},{c})
"""
BOTTOM = """
! Ratio of the speeds; its first harmonic while a tooth passes; teeth by which the driven one is
! ahead of the mean ratio.
VARIABLE/ratio, FUNCTION=WZ(1003)/{speed:g}
VARIABLE/chordal, FUNCTION=2*(VARVAL(ratio)-{z1}/{z2})*COS({z1}*AZ(1001))
VARIABLE/ahead, FUNCTION=({z2}*(AZ(1003)-{turn:.12g})-{z1}*AZ(1001))/(2*PI)

INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-4
END
"""


def deck(c):
    """The text of the deck of c."""
    turn, distance, _ = c.start
    rate, drift = c.rates((0, turn), distance)
    ids = vars(c) | {
        "z1": c.teeth[0], "z2": c.teeth[1], "distance": distance, "drift": drift, "turn": turn,
        "driven": rate, "mean": c.speed * c.teeth[0] / c.teeth[1],
        "free": c.pitch / (1 + c.pull / 2 / c.ea), "stiffness": c.ea / c.pitch,
    }  # fmt: skip
    place, speed = c.pins()
    n = len(place)
    text = TOP.format(n=n, **ids)
    for k, ((x, y), (vx, vy)) in enumerate(zip(place, speed, strict=True), 1):
        own = ids | {"k": k, "next": k % n + 1, "x": x, "y": y, "vx": vx, "vy": vy}
        text += PIN.format(**own)
        for i, s in enumerate("AB"):
            r, z = c.radii[i], c.teeth[i]
            text += CONTACT.format(
                **own, s=s, z=z, c=1001 + 2 * i, floating=1101 + 2 * i, radius=r,
                blunt=c.root**2, steep=c.tooth / 4 * z,
            )  # fmt: skip
    return text + BOTTOM.format(**ids)

"""The text of the deck of a belt drive (belt.Belt)."""

import numpy as np

TOP = """{title}
! Written by make_reference.py. {n} lumps of a belt (rho = {rho:g} kg/m, EA = {ea:g} N) flow around two
! pulleys of R = {radius:g} m; the driver (PART/1001) turns at {turn:g} rad/s, PART/1003 is driven.
! Each lump has, towards each pulley, the normal force N (IMPACT at the rim), the sliding speed S
! along the rim, and Coulomb friction F that grows to mu N over {vs:g} m/s (STEP).

UNITS/SYSTEM=MKS

PART/1000, GROUND
MARKER/1000, PART=1000
MARKER/1010, PART=1000, QP={distance:.12g},0,0, REULER=90D,90D,0 ! z along the way of the tensioner

PART/1001, MASS=1, CM=1001, IP={inertia:g},{inertia:g},{inertia:g}, WZ={turn:g} ! driver
MARKER/1001, PART=1001
MARKER/1101, PART=1001, FLOATING
JOINT/1, REVOLUTE, I=1001, J=1000
MOTION/1, JOINT=1, FUNCTION={turn:g}*TIME

PART/1002, MASS=2, CM=1002, IP=0.01,0.01,0.01, QG={distance:.12g},0,0 ! mount of the tensioner
MARKER/1002, PART=1002
MARKER/1012, PART=1002, REULER=90D,90D,0
JOINT/2, TRANSLATIONAL, I=1012, J=1010
SFORCE/1002, TRANSLATIONAL, ACTIONONLY, I=1012, J=1010, FUNCTION={pull:g}-500*VX(1002)

PART/1003, MASS=1, CM=1003, IP={inertia:g},{inertia:g},{inertia:g}, QG={distance:.12g},0,0, WZ={driven:.12g}
MARKER/1003, PART=1003
MARKER/1103, PART=1003, FLOATING
JOINT/3, REVOLUTE, I=1003, J=1002
{brake}
"""  # noqa: E501
LOAD = "SFORCE/1003, ROTATIONAL, I=1003, J=1002, FUNCTION=-{load:.12g}*WZ(1003)"
HELD = "MOTION/3, JOINT=3, FUNCTION={driven:.12g}*TIME"

LUMP = """
POINT_MASS/{k}, MASS={mass:.12g}, CM={k}, QG={x:.12g},{y:.12g},0, VX={vx:.12g}, VY={vy:.12g}
MARKER/{k}, POINT_MASS={k}
SFORCE/{k}, I={k}, J={next}, FUNCTION=-{stiffness:.12g}*(DM({k},{next})-{free:.12g})
, -{damper:.8g}*VR({k},{next})
"""
CONTACT = """VARIABLE/N{s}{k}, FUNCTION=IMPACT(DM({k},{c}),VR({k},{c}),{radius:g},{contact:g},1.0,{cn:g},1E-4)
VARIABLE/S{s}{k}, FUNCTION=(DX({k},{c})*VY({k},{c})-DY({k},{c})*VX({k},{c}))/DM({k},{c})
, -WZ({c})*DM({k},{c})
VARIABLE/F{s}{k}, FUNCTION={mu:g}*N{s}{k}*STEP(S{s}{k},-{vs:g},-1,{vs:g},1)
VFORCE/{s}{k}, I={k}, JFLOAT={floating}, RM=1000
, FX=(N{s}{k}*DX({k},{c})+F{s}{k}*DY({k},{c}))/DM({k},{c})\\
, FY=(N{s}{k}*DY({k},{c})-F{s}{k}*DX({k},{c}))/DM({k},{c})
"""  # noqa: E501
# Heat of friction and dampers, and what sections and contacts have stored.
HEAT = """DIFF/heat{k}, FUNCTION=FA{k}*SA{k}+FB{k}*SB{k}+{damper:.8g}*VR({k},{next})**2
, -(NA{k}-{contact:g}*MAX(0,{radius:g}-DM({k},1001)))*VR({k},1001)
, -(NB{k}-{contact:g}*MAX(0,{radius:g}-DM({k},1003)))*VR({k},1003)
VARIABLE/stored{k}, FUNCTION={mass:.12g}/2*VM({k})**2
, +{stiffness:.12g}/2*(DM({k},{next})-{free:.12g})**2
, +{contact:g}/2*(MAX(0,{radius:g}-DM({k},1001))**2+MAX(0,{radius:g}-DM({k},1003))**2)
"""
BOTTOM = """
DIFF/in, FUNCTION=-MOTION(1,1,8,0)*WZ(1001)+({pull:g}-500*VX(1002))*VX(1002)
DIFF/out, FUNCTION={out}*WZ(1003)
DIFF/rubbed, FUNCTION={friction}

! F2: energy that came in, less what went out, became heat or is stored.  F3, F4: mean powers.
! F6: heat of friction so far.
REQUEST/1, F2=DIF(in)-DIF(out)
{heat}
, -1.5*VX(1002)**2-{inertia:g}/2*WZ(1003)**2
{stored}\\
, F3=DIF1(in)\\F4=DIF1(out)\\F6=DIF(rubbed)

INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-3
END
"""


def places(b):
    """Places and velocities (N, 2) of the lumps at the start, driver first, counterclockwise."""
    n, m, c, v = b.half, b.straight, b.distance, b.speed
    turn = np.pi * (0.5 + np.arange(n + 1) / n)
    out = np.column_stack([np.cos(turn), np.sin(turn)])
    run = np.arange(1, m) * b.chord
    straight = np.column_stack([run, 0 * run])
    ahead = np.array([1.0, 0.0])
    low, high = [0, -b.radius], [c, b.radius]
    place = [out * b.radius, straight + low, [c, 0] - out * b.radius, high - straight]
    across = np.column_stack([-out[:, 1], out[:, 0]])
    speed = [across, ahead + 0 * straight, -across, -ahead + 0 * straight]
    return np.vstack(place), v * np.vstack(speed)


def lines(terms, per=6):
    """Terms as continuation lines."""
    groups = [terms[i : i + per] for i in range(0, len(terms), per)]
    return "\n".join(f", {''.join(group)}" for group in groups)


def deck(b):
    """The text of the deck of b."""
    driven = b.slip * b.turn if b.slip else b.state(*b.creeping())[1]
    ids = vars(b) | {
        "turn": b.turn, "mass": b.mass, "free": b.free, "distance": b.distance, "driven": driven,
        "vs": b.creep_speed, "cn": b.contact_damping, "stiffness": b.ea / b.free,
        "damper": 2 * b.zeta * np.sqrt(b.ea * b.rho),
    }  # fmt: skip
    place, speed = places(b)
    n = len(place)
    brake = (HELD if b.slip else LOAD).format(**ids)
    text = TOP.format(n=n, brake=brake, **ids)
    for k, ((x, y), (vx, vy)) in enumerate(zip(place, speed, strict=True), 1):
        own = ids | {"k": k, "next": k % n + 1, "x": x, "y": y, "vx": vx, "vy": vy}
        text += LUMP.format(**own)
        for s, mu, c in zip("AB", b.mu, (1001, 1003), strict=True):
            text += CONTACT.format(**own | {"s": s, "mu": mu, "c": c, "floating": c + 100})
        text += HEAT.format(**own)
    each = range(1, n + 1)
    return text + BOTTOM.format(
        heat=lines([f"-DIF(heat{k})" for k in each]),
        stored=lines([f"-stored{k}" for k in each]),
        friction="".join(f"+FA{k}*SA{k}+FB{k}*SB{k}" for k in each),
        out="-MOTION(3,0,8,0)" if b.slip else f"{b.load:.12g}*WZ(1003)",
        **ids,
    )

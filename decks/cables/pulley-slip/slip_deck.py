"""The text of a deck of slip.Pulley."""

from slip import G

TOP = """{title}
! Written by make_reference.py. {m1:g} kg and {m2:g} kg on {length:g} m of cable over a pulley of
! R = {radius:g} m; mu = {mu:g}, wrap {wrap:.6g} rad: T1/T2 can be exp(mu wrap) = {ratio:.6g}.
! DIFF/paid is the cable that has run to side 1, DIFF/speed its speed; F is the friction, full at a
! sliding speed of {creep:g} m/s.

UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81

PART/1000, GROUND
MARKER/1000, PART=1000

PART/1005, MASS=10, CM=1005, IP=1,1,1              ! mount
MARKER/1005, PART=1005
JOINT/2, FIXED, I=1005, J=1000

PART/1010, MASS=5, CM=1010, IP={inertia:g},{inertia:g},{inertia:g}, WZ={spin:.12g}
MARKER/1010, PART=1010
JOINT/1, REVOLUTE, I=1010, J=1005
SFORCE/1010, ROTATIONAL, I=1010, J=1005, FUNCTION={radius:g}*VARVAL(F)
{brake}
DIFF/paid, FUNCTION=DIF(speed)
DIFF/speed, IC={speed:g}, FUNCTION=(VARVAL(T1)-VARVAL(T2)-VARVAL(F))/{rim:g}
VARIABLE/sliding, FUNCTION=DIF(speed)-{radius:g}*WZ(1010,1005)
VARIABLE/F, FUNCTION=(T1+T2)*TANH({mu:g}*{wrap:.12g}/2*STEP(sliding,-{creep:g},-1,{creep:g},1))
"""
LOCK = "MOTION/1, JOINT=1, FUNCTION=0*TIME\n"
BRAKE = """SFORCE/1011, ROTATIONAL, I=1010, J=1005
, FUNCTION=-MIN({rise:g}*TIME,{brake:g})*STEP(WZ(1010,1005),-0.01,-1,0.01,1)
"""
SIDE = """
! ---- side {j} ----
MARKER/{top}, PART=1005, QP={x:g},0,0
VARIABLE/L{j}, FUNCTION=({length:g}{sign}DIF(paid))/{n}
VARIABLE/Dm{j}, FUNCTION={rho:g}*({sign}DIF(paid))/{n}
VARIABLE/T{j}, FUNCTION={ea:g}/L{j}*(DM({top},{first})-L{j})
, +{damper:.8g}*(VR({top},{first}){opposite}DIF(speed)/{n})
POINT_MASS/{tip}, MASS={weight:g}, CM={tip}, QG={x:g},{y:.12g},0, VY={vy:.12g}
MARKER/{tip}, POINT_MASS={tip}
SFORCE/{top}, I={first}, J={top}, FUNCTION=-T{j}
"""
NODE = """POINT_MASS/{k}, MASS={mass:g}, CM={k}, QG={x:g},{y:.12g},0, VY={vy:.12g}
MARKER/{k}, POINT_MASS={k}
VFORCE/{k}, I={k}, J_PART=1000
, FX=-VARVAL(Dm{j})*(ACCX({k})-IGRAV)-VARVAL(d(Dm{j})/dt)*VX({k})\\
, FY=-VARVAL(Dm{j})*(ACCY({k})-JGRAV)-VARVAL(d(Dm{j})/dt)*VY({k})\\
, FZ=-VARVAL(Dm{j})*(ACCZ({k})-KGRAV)-VARVAL(d(Dm{j})/dt)*VZ({k})
SFORCE/{k}, I={next}, J={k}
, FUNCTION=-{ea:g}/L{j}*(DM({next},{k})-L{j})-{damper:.8g}*(VR({next},{k}){opposite}DIF(speed)/{n})
"""
BOTTOM = """
! Load on the mount; its tensions, ratio; speeds of cable and rim.
REQUEST/1, F2=JOINT(2,1,3,0)\\F3=VARVAL(T1)\\F4=VARVAL(T2)\\F6=T1/T2\\F7=DIF(speed)\\
, F8={radius:g}*WZ(1010,1005)

INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-6
END
"""


def depths(p, side):
    """How far below the pulley the nodes and the weight of a side hang at the start."""
    a, v = p.start
    top = p.tops(0, v)[side]
    sign = 1 if side == 0 else -1
    tension, free = top[0] - top[1] * a * sign, p.length / p.sections
    out, y = [], 0.0
    for k in range(1, p.sections + 1):
        y += free * (1 + tension / p.ea)
        out.append(y)
        share = k / p.sections
        tension -= p.rho * free * G
        tension += p.rho / p.sections * share * (p.length * a * sign + v * v)
    return out


def deck(p):
    """The text of the deck of p."""
    ids = vars(p) | {
        "m1": p.weights[0], "m2": p.weights[1], "spin": p.speed / p.radius, "n": p.sections,
        "ratio": (1 + p.hold) / (1 - p.hold),
        "damper": 0.3 * (p.ea / p.length * sum(p.weights)) ** 0.5 * p.sections,
    }  # fmt: skip
    text = TOP.format(**ids | {"brake": BRAKE.format(**ids) if p.rise else LOCK})
    for side in (0, 1):
        text += one_side(p, side, ids)
    return text + BOTTOM.format(**ids)


def one_side(p, side, ids):
    """Spans and weight of one side."""
    j, sign, base = side + 1, "+-"[side], 100 * (side + 1)
    speed = -p.speed if side == 0 else p.speed
    y = [-d for d in depths(p, side)]
    nodes = [base + k for k in range(1, p.sections)]
    tip = base + p.sections
    own = ids | {
        "j": j, "sign": sign, "opposite": "-+"[side], "top": base, "tip": tip,
        "weight": p.weights[side], "first": (*nodes, tip)[0],
        "x": -p.radius if side == 0 else p.radius, "mass": p.rho * p.length / p.sections,
    }  # fmt: skip
    text = SIDE.format(**own, y=y[-1], vy=speed)
    for k, (place, node) in enumerate(zip(y, nodes, strict=False), 1):
        text += NODE.format(**own, k=node, next=node + 1, y=place, vy=speed * k / p.sections)
    return text

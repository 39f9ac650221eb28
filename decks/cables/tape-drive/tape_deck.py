"""The text of the deck of a tape drive (tape.Tape)."""

import numpy as np

TOP = """{title}
! Written by make_reference.py. The tape leaves the supply reel PART/10 upwards, goes around roller
! 20 to the right, around the capstan 30 downwards, around roller 40 to the right onto reel 50.
! DIFF/l1 to l4: unstretched tape in the spans; e strain, T tension; w angular velocity in the sense
! of the tape, n unstretched tape that passes in unit time.

UNITS/SYSTEM=MKS

PART/1, GROUND
"""
WHEEL = """
MARKER/{k}, PART=1, QP={x}
PART/{id}, MASS=0.1, CM={id}, IP={inertia:g},{inertia:g},{inertia:g}, QG={x}
MARKER/{id}, PART={id}
JOINT/{k}, REVOLUTE, I={id}, J={k}
VARIABLE/w{id}, FUNCTION={sense}WZ({id})
VFORCE/{id}, I={id}, J_PART=1, FX={fx}\\FY={fy}
SFORCE/{id}, ROTATIONAL, I={id}, J={k}
"""
ROLLER = """, FUNCTION={sense}({radius:g}*(T{after}-T{before})-{drag:g}*w{id}{motor})
VARIABLE/n{before}, FUNCTION={radius:g}*w{id}/(1+e{before})
"""
# The pack's inertia acts through the acceleration, as a torque.
PACK = """, FUNCTION={sense}({torque})-J{id}*WDTZ({id})
VARIABLE/n{n}, FUNCTION=r{id}*w{id}
DIFF/moved{id}, FUNCTION=VARVAL(n{n})
VARIABLE/r{id}, FUNCTION=SQRT({r2:.12g}{sign}{share:.12g}*DIF(moved{id}))
VARIABLE/J{id}, FUNCTION={heavy:.12g}*(VARVAL(r{id})**4-{core4:.12g})
"""
SPAN = """
VARIABLE/e{i}, FUNCTION={length:g}/DIF(l{i})-1
DIFF/l{i}, IC={free:.12g}, FUNCTION=VARVAL(n{before})-VARVAL(n{i})
VARIABLE/T{i}, FUNCTION={ea:g}*(e{i}-{beta:g}*{length:g}*(n{before}-n{i})/DIF(l{i})**2)
"""
BOTTOM = """
! Load of the tape on the mount of the capstan, torque of the motor.
REQUEST/capstan, F2=JOINT(4,1,2,0)\\F3=JOINT(4,1,3,0)\\F6={gain:g}*({told:.12g}-w30)

INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-7
END
"""
PLACES = ("0,0,0", "0,0.2,0", "0.3,0.2,0", "0.3,0,0", "0.6,0,0")
SENSES = ("-", "-", "-", "", "-")
FORCES = (("0", "T1"), ("T2", "-T1"), ("-T2", "-T3"), ("T4", "T3"), ("-T4", "0"))


def deck(tape):
    """The text of the deck."""
    ids = vars(tape) | {"told": tape.speed / tape.rollers[1]}
    ids |= {"heavy": tape.rho * np.pi / 2 / tape.thickness, "core4": tape.core**4}
    text = TOP.format(**ids)
    for number, (place, sense, (fx, fy)) in enumerate(zip(PLACES, SENSES, FORCES, strict=True)):
        own = ids | {"id": 10 * (number + 1), "k": number + 2, "x": place, "sense": sense}
        own |= {"fx": fx.replace("T", "1*T"), "fy": fy.replace("T", "1*T")}
        text += roller(tape, number, own) if 0 < number < 4 else pack(tape, number, own)
    for i, (length, free) in enumerate(zip(tape.spans, tape.free, strict=True), 1):
        text += SPAN.format(**ids | {"i": i, "before": i - 1, "length": length, "free": free})
    return text + BOTTOM.format(**ids)


def roller(tape, number, own):
    """A roller, or the capstan with its motor."""
    own = own | {"inertia": tape.inertias[number - 1], "radius": tape.rollers[number - 1]}
    own |= {"before": number, "after": number + 1}
    own["motor"] = "+{gain:g}*({told:.12g}-w30)".format(**own) if number == 2 else ""
    return WHEEL.format(**own) + ROLLER.format(**own)


def pack(tape, number, own):
    """A reel with its pack and its motor."""
    side = number // 4
    radius = tape.packs[side]
    own = own | {"inertia": tape.core_inertia, "n": 4 * side, "sign": "-+"[side]}
    own |= {"r2": radius**2, "share": tape.thickness / np.pi}
    driven = f"{tape.pull * radius:.12g}"
    own["torque"] = f"{driven}-r50*T4" if side else f"r10*T1-{driven}"
    return WHEEL.format(**own) + PACK.format(**own)

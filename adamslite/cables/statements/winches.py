"""What turns a wheel: its bearing, an engine with its characteristic, a brake, a law of payout.

engine   Q = torque or force of the description, or gain (s' - set speed); at most the
         characteristic M(|w|), w the speed of the drum, and none once a limit switch has acted
brake    M_b b k, b the share applied, 1 once a limit switch has acted; k = y/g, g = 1e-4 m
         b > 0:  y' = x - |x| k  at the speed x of the rim (Dahl);  b = 0:  y' = -y/tau;
             at rest it damps: y + 5 ms x exp(-(x/(1 mm/s))^2) for y
switch   a SENSOR, which holds what it has seen: S reached low or high
"""

from adamslite.cables.description.vocabulary import Spec, Station
from adamslite.cables.statements.forms import number
from adamslite.cables.statements.wheels import STICKS, arm, is_rim, own_names, rolled, turning

# Displacement of a rim at which its brake holds with its torque [m]; time in which it lets go [s].
BRAKE_GRIP, LETS_GO = 1e-4, 0.01
# What damps a wheel that its brake holds [s], up to the speed with which it rings [m/s].
DAMPS, RINGS = 5e-3, 1e-3
# Points of a table; speeds that no drum has, over the highest of the description.
FEWEST_POINTS, FAR = 4, 1e3


def _bearing(spec: Spec, i: int) -> tuple[str, str]:
    """The state that the friction of a bearing needs, and its torque: the capstan's laws for the
    speed and the displacement of the rim."""
    each, n = spec.route[i], spec.marker(i)
    if not each.grip:
        return "", f"-{number(each.friction)}*STEP({turning(i, spec, 1)},-0.01,-1,0.01,1)"
    speed = rolled(i, spec, 1)
    share = f"DIF(rests_{n})/{number(each.grip)}"
    rate = f"{speed}*(1-TANH({speed}/{STICKS:g})*{share})"
    return f"DIFF/rests_{n}, FUNCTION={rate}\n", f"{number(-each.turn * each.friction)}*{share}"


def drive(spec: Spec, i: int, torques: list[str]) -> str:
    """What turns wheel i: `torques` of the cable, friction, an engine, a payout law."""
    each, n = spec.route[i], spec.marker(i)
    if each.held:
        return ""
    torques, text = list(torques), ""
    # Payout is cable that leaves the winch, to whichever side the route goes.
    sense = spec.outwards(i)
    out = arm(i, spec, sense)
    if each.friction:
        more, torque = _bearing(spec, i)
        text += more
        torques.append(torque)
    if each.reel:
        text += f"SFORCE/{n + 3}, ROTATIONAL, ACTIONONLY, I={n}, J={n + 1}"
        text += f", FUNCTION=-J_{n}*{turning(i, spec, 2)}\n"
    if each.has_engine:
        text += (
            "\n! Payout of the winch and its speed.\n"
            f"VARIABLE/S_{n}, FUNCTION={rolled(i, spec, 0, sense)}\n"
            f"VARIABLE/SD_{n}, FUNCTION={rolled(i, spec, 1, sense)}\n"
        )
        held = out if each.force else number(sense * each.turn)
        text += _switch(each, n) + _engine(spec, i) + _brake(spec, i)
        if each.has_states and (each.force or each.torque or each.motor):
            torques.append(f"-({held})*engine_{n}")
        elif each.force or each.torque:
            torques.append(f"-({held})*{_law(each, n)}")
        torques += [f"-({number(sense * each.turn)})*brake_{n}"] if each.brake else []
    if torques:
        text += _turned(spec, i, "\n, +".join(torques))
    if each.speed and not each.motor:
        speed = rolled(i, spec, 1, sense)
        text += f"VARIABLE/S_{n}, FUNCTION={rolled(i, spec, 0, sense)}\n"
        text += f"VARIABLE/SD_{n}, FUNCTION={speed}\n"
        text += f"GCON/{n}, FUNCTION={speed}\n, -({own_names(each.speed, n)})\n"
    if each.payout:
        text += f"GCON/{n}, FUNCTION={rolled(i, spec, 0, sense)}\n, -({each.payout})\n"
    return text


def _turned(spec: Spec, i: int, torque: str) -> str:
    """What a torque does to wheel i: to a part, or by J v'/R = torque to the speed v of its rim,
    which is an error of the step as the speed of the cable is, however small the wheel."""
    each, n = spec.route[i], spec.marker(i)
    if not is_rim(i, spec):
        only = "" if each.mount else ", ACTIONONLY"
        return f"SFORCE/{n}, ROTATIONAL{only}, I={n}, J={n + 1}\n, FUNCTION={torque}\n"
    return (
        "! Way and speed of the rim of the wheel along the route.\n"
        f"DIFF/rolled_{n}, FUNCTION=DIF(rolls_{n})\n"
        f"DIFF/rolls_{n}, FUNCTION={arm(i, spec)}*({torque})/{number(each.inertia)}\n"
    )


def _law(each: Station, n: int) -> str:
    """The torque or force of the description, with the names of station n."""
    return f"({own_names(each.force or each.torque, n)})"


def _switch(each: Station, n: int) -> str:
    """The sensors of a limit switch, and VARIABLE/stopped_n: 1 once one of them has acted."""
    if not each.limit:
        return ""
    low, high = each.limit
    return (
        "! The limit switch: 1 from the time at which the payout reaches an end.\n"
        f"SENSOR/{n}, FUNCTION=S_{n}\\, VALUE={number(low)}, ERROR=0, LE, EVALUATE=1\n"
        f"SENSOR/{n + 1}, FUNCTION=S_{n}\\, VALUE={number(high)}, ERROR=0, GE, EVALUATE=1\n"
        f"VARIABLE/stopped_{n}, FUNCTION=SENVAL({n})+SENVAL({n + 1})"
        f"-SENVAL({n})*SENVAL({n + 1})\n"
    )


def _engine(spec: Spec, i: int) -> str:
    """VARIABLE/engine_n: torque, or pull at the rim, against paying out."""
    each, n = spec.route[i], spec.marker(i)
    if not each.has_states or not (each.force or each.torque or each.motor):
        return ""
    text, asked = "", _law(each, n)
    if each.motor:
        if each.speed:
            asked = f"({number(each.motor.gain)}*(SD_{n}-({own_names(each.speed, n)})))"
        x, y = (
            ",".join(number(v) for v in values)
            for values in zip(*_spread(each.motor.curve), strict=True)
        )
        text = (
            "! The engine: what is asked of it, and the torque it has at its speed.\n"
            f"SPLINE/{n}, X={x}\n, Y={y}\n"
            f"VARIABLE/asked_{n}, FUNCTION={asked}\n"
            f"VARIABLE/most_{n}, FUNCTION=MAX(0,INTERP(ABS({turning(i, spec, 1)}),1,{n}))\n"
        )
        asked = f"MAX(-most_{n},MIN(most_{n},asked_{n}))"
    runs = f"(1-stopped_{n})*" if each.limit else ""
    return f"{text}VARIABLE/engine_{n}, FUNCTION={runs}{asked}\n"


def _spread(curve: tuple[tuple[float, float], ...]) -> list[tuple[float, float]]:
    """The same straight lines with the four points that a SPLINE needs; at higher speeds the last
    torque remains."""
    (v, a), *_, (w, b) = curve
    found = [*curve, (FAR * w, b)]
    if len(found) < FEWEST_POINTS:
        found.insert(1, ((v + w) / 2, (a + b) / 2))
    return found


def _brake(spec: Spec, i: int) -> str:
    """VARIABLE/brake_n: torque of a brake against paying out."""
    each, n = spec.route[i], spec.marker(i)
    if not each.brake:
        return ""
    applied = f"({own_names(each.brake.applied, n)})" if each.brake.applied else "0"
    if each.limit:
        applied = f"(1-(1-{applied})*(1-stopped_{n}))"
    speed, share = f"SD_{n}", f"DIF(held_{n})/{BRAKE_GRIP:g}"
    damps = f"{DAMPS:g}*{speed}*EXP(-({speed}/{RINGS:g})**2)"
    holds = f"applied_{n}*{speed}*(1-TANH({speed}/{STICKS:g})*{share})"
    return (
        "! The brake: the share of it that is applied; it holds what is at rest.\n"
        f"VARIABLE/applied_{n}, FUNCTION={applied}\n"
        f"DIFF/held_{n}, FUNCTION={holds}-(1-applied_{n})*DIF(held_{n})/{LETS_GO:g}\n"
        f"VARIABLE/brake_{n}, FUNCTION={number(each.brake.torque)}*applied_{n}\n"
        f", *(DIF(held_{n})+{damps})/{BRAKE_GRIP:g}\n"
    )

"""What the cable does to a wheel: it turns with the rim, or slips on it by the capstan's friction.

s" acceleration of the cable over the wheel, m its mass on the rim, m1 and m2 those of the halves of
the spans (or sections) beside it, t1 and t2 the tensions beside it but for these, u = rho s'^2:

    T1 = t1 + m1 s",  T2 = t2 - m2 s",  m s" = T2 - T1 - F
    F = (T1 + T2 - 2 u) h,  h = tanh(k mu b/2)

so that (T2 - u)/(T1 - u) = exp(k mu b) over the wrap b but for m s". Where the centrifugal force u
lifts the cable off, F = 0. The share k of the friction follows from the sliding speed x:

    k = STEP(x, -v, -1, v, 1)                         without grip: the cable creeps where it holds
    k = y/grip,  y' = x - |x| k/g                     it holds, displaced by y (Dahl)
    g = 1 + (mu_static/mu - 1) exp(-(x/v)^2)          friction at rest is greater

|x| is x tanh(x/v0), which has no corner.
"""

from math import exp

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import FreeSpan, wrap
from adamslite.cables.model.model_choice import CableModel
from adamslite.cables.statements.forms import number
from adamslite.cables.statements.pieces import Piece, at_least_nothing, is_between
from adamslite.cables.statements.wheel_spans import at_rest, half, tension_at
from adamslite.cables.statements.wheels import STICKS, arm, rolled, travel
from adamslite.cables.statements.winches import drive

# Sliding speed at which friction is full, or that at rest is no longer greater [m/s].
CREEP = 1e-3


def turned(spec: Spec, spans: list[FreeSpan], model: CableModel, found: list[Piece], i: int) -> str:
    """What the cable, or its friction, and the drive do to wheel i."""
    before, behind = (found[p] if p >= 0 else None for p in spec.beside(i))
    radius = arm(i, spec)
    if spec.slips_at(i) and before and behind:
        text = _friction(spec, spans, model, (before, behind), i)
        return text + drive(spec, i, [f"{radius}*F_{spec.marker(i)}"])
    pulls = f"+{tension_at(spec, behind, i)}" if behind else ""
    pulls += f"-({tension_at(spec, before, i)})" if before else ""
    return drive(spec, i, [f"{radius}*({pulls})"] if model.level > 1 else [])


def half_section(model: CableModel, piece: Piece, spec: Spec) -> str:
    """Free length of the half section at the root of a row of sections."""
    grows = model.level == 3 and spec.route[piece.root].feeds
    return f"H{piece.number}/2" if grows else f"L{piece.number}_0/2"


def at_wheel(spec: Spec, model: CableModel, piece: Piece, i: int) -> str:
    """Tension of a span at wheel i, with the acceleration of what lies there."""
    mass = "" if is_between(spec, piece) or not spec.slips_at(i) else _beside(spec, model, piece, i)
    if not mass:
        return tension_at(spec, piece, i)
    return f"T{piece.number}{'-' if piece.sense > 0 else '+'}{mass}*A_{spec.marker(i)}"


def _beside(spec: Spec, model: CableModel, piece: Piece, i: int) -> str:
    """Mass of a span at wheel i that moves with the cable there, "" for none."""
    if is_between(spec, piece):
        return half(piece)
    at_root = piece.root == i and spec.route[piece.tip].kind != "run"
    return f"rho*{half_section(model, piece, spec)}" if at_root else ""


def _friction(
    spec: Spec, spans: list[FreeSpan], model: CableModel, beside: tuple[Piece, Piece], i: int
) -> str:
    """Friction of the cable on the wheel, and the cable's travel over it."""
    each, n, angle = spec.route[i], spec.marker(i), wrap(spec, spans, i)
    t1, t2 = (at_rest(spec, piece, i) for piece in beside)
    m1, m2 = (_beside(spec, model, piece, i) for piece in beside)
    rim = number(spec.cable.density * each.radius * angle)
    masses = "".join(f"+{m}" for m in (m1, m2) if m)
    uneven = (m1 or "0") + (f"-{m2}" if m2 else "")
    if not masses:
        uneven = "0"
    most = each.mu * angle
    share, text = _share(spec, i)
    return (
        f"\n! Friction of the cable on the wheel of station {spec.station(i)}, mu times wrap"
        f" {most:.4g}: at most a ratio of {exp(min(most, 700)):.4g}.\n"
        f"VARIABLE/slide_{n}, FUNCTION={_sliding(spec, i)}\n{text}"
        f"VARIABLE/press_{n}, FUNCTION={t1}+{t2}-2*rho*DIF(run_{n})**2\n"
        f"VARIABLE/N_{n}, FUNCTION={at_least_nothing(spec, f'press_{n}')}\n"
        f"VARIABLE/h_{n}, FUNCTION=TANH({number(most / 2)}*{share})\n"
        f"VARIABLE/A_{n}, FUNCTION=({t2}-({t1})-h_{n}*N_{n})/({rim}{masses}+h_{n}*({uneven}))\n"
        f"VARIABLE/F_{n}, FUNCTION=h_{n}*(N_{n}+({uneven})*A_{n})\n"
        f"DIFF/paid_{n}, FUNCTION=DIF(run_{n})\n"
        f"DIFF/run_{n}, FUNCTION=VARVAL(A_{n})\n"
    )


def _sliding(spec: Spec, i: int) -> str:
    """Speed of the cable on the rim."""
    speed = travel(i, spec, 1)
    return speed if spec.route[i].held else f"{speed}-({rolled(i, spec, 1)})"


def _share(spec: Spec, i: int) -> tuple[str, str]:
    """Share of the friction that acts: an expression, and the state that it needs."""
    each, n = spec.route[i], spec.marker(i)
    if not each.grip:
        return f"STEP(slide_{n},-{CREEP:g},-1,{CREEP:g},1)", ""
    full = "1"
    if each.mu_static > each.mu > 0:
        gain = number(each.mu_static / each.mu - 1)
        full = f"(1+{gain}*EXP(-(slide_{n}/{CREEP:g})**2))"
    share = f"DIF(grip_{n})/{number(each.grip)}"
    rate = f"slide_{n}*(1-TANH(slide_{n}/{STICKS:g})*{share}/{full})"
    return share, f"DIFF/grip_{n}, FUNCTION={rate}\n"

"""Laws that integrators stumble over, with random numbers: terms of the force on a freedom.

Springs up to 1e8 N/m, contacts, friction, windows and switches of state and time, added mass,
VARIABLE chains, DIFF states.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from benchmarks.random_drafts import FAST, Draft, Freedom


def spring(draft: Draft, f: Freedom) -> str:
    """Holds a freedom near its place: 0.3 to 10 Hz."""
    stiff = f.inertia * draft.decade(0.5, 3.5)
    damp = 2.0 * np.sqrt(stiff * f.inertia) * draft.decade(-3, -0.5) * draft.chance(0.5)
    return f"-{stiff:.4g}*{f.x}-{damp:.4g}*{f.v}"


def stiff_spring(draft: Draft, f: Freedom) -> str:
    """Up to 1e8 N/m, damped so that it does not ring for ever, about a place on the way."""
    stiff = draft.decade(4, 8)
    damp = 2.0 * np.sqrt(stiff * f.inertia) * draft.between(0.05, 2.0)
    return f"-{stiff:.4g}*({f.x}-{draft.between(-0.1, 0.1) * f.reach:.4g})-{damp:.4g}*{f.v}"


def contact(draft: Draft, f: Freedom) -> str:
    """IMPACT with damping that lets the body bounce a few times."""
    stiff, power = draft.decade(3, 6), draft.between(1.05, 1.6)
    damp = 2.0 * np.sqrt(stiff * f.inertia) * draft.decade(-2, -0.3)
    edge = -draft.between(0.05, 0.4) * f.reach
    zone = draft.decade(-4, -2)
    return f"IMPACT({f.x},{f.v},{edge:.4g},{stiff},{power},{damp:.4g},{zone})"


def bistop(draft: Draft, f: Freedom) -> str:
    """Stops on both sides."""
    stiff, gap = draft.decade(3, 6), draft.between(0.1, 0.5) * f.reach
    damp = 2.0 * np.sqrt(stiff * f.inertia) * draft.decade(-1.5, -0.3)
    zone = draft.decade(-4, -2)
    return f"BISTOP({f.x},{f.v},{-gap:.4g},{gap:.4g},{stiff},1.2,{damp:.4g},{zone})"


def one_sided(draft: Draft, f: Freedom) -> str:
    """IF(x-c: spring and damper, 0, 0): a force that jumps when it begins and pulls at its end."""
    stiff = draft.decade(3, 6)
    damp = 2.0 * np.sqrt(stiff * f.inertia) * draft.decade(-2, -0.5)
    x = f"({f.x}+{draft.between(0.05, 0.4) * f.reach:.4g})"
    return f"IF({x}:-{stiff}*{x}-{damp:.4g}*{f.v},0,0)"


def dead_zone(draft: Draft, f: Freedom) -> str:
    """A spring with play."""
    stiff, play = draft.decade(2, 5), draft.between(0.02, 0.2) * f.reach
    return f"-{stiff}*MAX(ABS({f.x})-{play:.4g},0)*SIGN(1,{f.x})"


def smooth_friction(draft: Draft, f: Freedom) -> str:
    """Dry friction with a ramp through zero."""
    most = f.inertia * draft.between(0.5, 8)
    width = draft.decade(-3, -1)
    return f"STEP({f.v},{-width},{most:.4g},{width},{-most:.4g})"


def sharp_friction(draft: Draft, f: Freedom) -> str:
    """Dry friction written with SIGN: it slides, or it chatters when it comes to rest."""
    return f"-{f.inertia * draft.between(0.1, 3):.4g}*SIGN(1,{f.v})"


def window(draft: Draft, f: Freedom) -> str:
    """A force that acts only within a layer."""
    place, half = draft.between(-0.4, 0.4) * f.reach, draft.decade(-3.5, -1) * f.reach
    force = f.inertia * draft.between(-1, 1) / half * 0.5
    draft.resolve(half / (FAST * f.reach))
    return f"IF(ABS({f.x}-{place:.4g})-{half:.4g}:{force:.4g},0,0)"


def smooth_window(draft: Draft, f: Freedom) -> str:
    """The same with ramps at both sides."""
    a, w = draft.between(-0.4, 0.4) * f.reach, draft.decade(-3.5, -1) * f.reach
    force = f.inertia * draft.between(-1, 1) / w * 0.3
    draft.resolve(w / (FAST * f.reach))
    step = draft.rng.choice(["STEP", "STEP5", "HAVSIN"])
    up = f"{step}({f.x},{a:.6g},0,{a + w:.6g},1)"
    down = f"{step}({f.x},{a + 2 * w:.6g},0,{a + 3 * w:.6g},1)"
    return f"{force:.4g}*({up}-{down})"


def switch(draft: Draft, f: Freedom) -> str:
    """A force that jumps at a time."""
    at = draft.between(0.05, 0.95) * draft.end
    return f"IF(TIME-{at:.5g}:{f.inertia * draft.between(-5, 5):.4g},0,0)"


def pulse(draft: Draft, f: Freedom) -> str:
    """A short parabola of time."""
    at, width = draft.between(0.05, 0.95) * draft.end, draft.decade(-4, -1) * draft.end
    force = f.inertia * draft.between(-2, 2) / width
    draft.resolve(width)
    return f"{force:.4g}*MAX(0,1-((TIME-{at:.6g})/{width:.4g})**2)"


def bell(draft: Draft, f: Freedom) -> str:
    """A Gaussian of time."""
    at, width = draft.between(0.05, 0.95) * draft.end, draft.decade(-4, -1) * draft.end
    force = f.inertia * draft.between(-2, 2) / width
    draft.resolve(width)
    return f"{force:.4g}*EXP(-((TIME-{at:.6g})/{width:.4g})**2)"


def drive(draft: Draft, f: Freedom) -> str:
    """A harmonic force, or one that follows a saw."""
    force, rate = f.inertia * draft.between(-10, 10), draft.between(1, 60)
    if draft.chance(0.3):
        return f"{force:.4g}*(MOD({rate / 6:.4g}*TIME,1)-0.5)"
    return f"{force:.4g}*SIN({rate:.4g}*TIME)"


def ramp(draft: Draft, f: Freedom) -> str:
    """A STEP of time."""
    at = draft.between(0.05, 0.8) * draft.end
    wide = draft.decade(-3, -0.7) * draft.end
    draft.resolve(wide)
    return f"STEP(TIME,{at:.6g},0,{at + wide:.6g},{f.inertia * draft.between(-5, 5):.4g})"


def added_mass(draft: Draft, f: Freedom) -> str:
    """A force that depends on the acceleration: mass added, or up to half of it taken away."""
    return f"-{f.inertia * draft.between(-0.5, 2.0):.4g}*{f.a}"


def chain(draft: Draft, f: Freedom) -> str:
    """VARIABLEs that follow one another."""
    first = draft.new_id()
    draft.lines.append(f"VARIABLE/{first}, FUNCTION={f.x}*{draft.between(0.5, 2):.4g}")
    last = first
    for _ in range(int(draft.rng.integers(1, 4))):
        here = draft.new_id()
        how = draft.rng.choice(["SIN({0})", "{0}*(1-{0})", "ATAN({0})", "{0}+0.1*VARVAL({1})"])
        law = how.format(f"VARVAL({last})", first)
        draft.lines.append(f"VARIABLE/{here}, FUNCTION={law}")
        last = here
    return f"-{f.inertia * draft.decade(0, 2):.4g}*VARVAL({last})"


def loop(draft: Draft, f: Freedom) -> str:
    """A VARIABLE given by an equation in itself."""
    here = draft.new_id()
    law = f"0.4*COS(VARVAL({here}))+{f.x}"
    draft.lines.append(f"VARIABLE/{here}, FUNCTION={law}")
    return f"-{f.inertia * draft.decade(0, 2):.4g}*VARVAL({here})"


def filtered(draft: Draft, f: Freedom) -> str:
    """A DIFF that follows the displacement and pulls back, or a controller's integral."""
    here, pace = draft.new_id(), draft.decade(0, 3)
    draft.lines.append(f"DIFF/{here}, IC=0, FUNCTION={pace}*({f.x}-DIF({here}))")
    return f"-{f.inertia * draft.decade(0, 2):.4g}*DIF({here})"


def drag(draft: Draft, f: Freedom) -> str:
    """Resistance of the square of the speed."""
    return f"-{f.inertia * draft.decade(-2, 0):.4g}*{f.v}*ABS({f.v})"


def cubic(draft: Draft, f: Freedom) -> str:
    """A spring that stiffens."""
    return f"-{f.inertia * draft.decade(1, 3.5):.4g}*{f.x}**3"


LAWS: tuple[Callable[[Draft, Freedom], str], ...] = (
    stiff_spring, contact, bistop, one_sided, dead_zone, smooth_friction, sharp_friction, window,
    smooth_window, switch, pulse, bell, drive, ramp, added_mass, chain, loop, filtered, drag, cubic,
)  # fmt: skip

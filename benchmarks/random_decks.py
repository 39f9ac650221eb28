"""Random small decks: one to three moving bodies and the laws that integrators stumble over.

A *mechanism* offers freedoms, each with the words that measure it (x, v, a) and the statement that
loads it.  Every freedom gets a restoring force and some *laws*: springs up to 1e8 N/m, contacts,
friction, windows and switches of state and time, added mass, VARIABLE chains, DIFF states.

A deck is fixed by its number and seed; ``nudge`` moves its start a little, to learn how much the
motion itself amplifies an error.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import cos, sin

import numpy as np

#: Speed that freedoms reach, in their reach per time.
FAST = 8.0
HEAD = "UNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1"


@dataclass(frozen=True)
class Freedom:
    """How a freedom is measured and loaded.

    x, v, a : expressions of displacement, speed and acceleration
    load : a statement with {id} and {law}
    inertia : mass or moment of inertia that resists, roughly [kg], [kg m^2]
    reach : how far it goes, roughly [m], [rad]
    """

    x: str
    v: str
    a: str
    load: str
    inertia: float
    reach: float = 1.0


@dataclass
class Draft:
    """A deck in the making; ``finest``: the shortest time that a law was given, or passes in."""

    rng: np.random.Generator
    nudge: float = 0.0
    end: float = 1.0
    finest: float = 1.0
    kinds: list[str] = field(default_factory=list)
    lines: list[str] = field(default_factory=list)
    freedoms: list[Freedom] = field(default_factory=list)
    taken: int = 0

    def between(self, low: float, high: float) -> float:
        """A number between two, of four digits as somebody types it."""
        return float(f"{self.rng.uniform(low, high):.4g}")

    def decade(self, low: float, high: float) -> float:
        """A number between two powers of ten."""
        return float(f"{10.0 ** self.rng.uniform(low, high):.4g}")

    def start(self, low: float, high: float) -> str:
        """A start value; the nudge goes in here."""
        return repr(self.between(low, high) + self.nudge)

    def chance(self, share: float) -> bool:
        """True in this share of the decks."""
        return bool(self.rng.random() < share)

    def new_id(self) -> int:
        """An id for VARIABLE or DIFF."""
        self.taken += 1
        return self.taken

    def resolve(self, time: float) -> None:
        """Something happens within this time."""
        self.finest = min(self.finest, time)

    def deck(self, title: str, steps: int) -> RandomDeck:
        """The deck."""
        run = f"SIMULATE/DYNAMIC, END={self.end!r}, STEPS={steps}"
        text = "\n".join([title, HEAD, *self.lines, run, "END", ""])
        return RandomDeck(title, text, self.end, self.finest)


@dataclass(frozen=True)
class RandomDeck:
    """``text`` of a deck, its ``end`` time, and the shortest time in which something happens."""

    title: str
    text: str
    end: float
    finest: float


def deck(number: int, seed: int, nudge: float = 0.0) -> RandomDeck:
    """Deck ``number`` of a series; its title names what it is made of."""
    draft = Draft(np.random.default_rng([seed, number]), nudge)
    rng = draft.rng
    draft.end = draft.between(0.5, 3.0)
    MECHANISMS[rng.choice(len(MECHANISMS), p=SHARES)](draft)
    for k, freedom in enumerate(draft.freedoms):
        terms = [spring(draft, freedom)]
        for _ in range(rng.choice([0, 1, 2, 3], p=[0.15, 0.4, 0.3, 0.15])):
            law = LAWS[rng.integers(len(LAWS))]
            draft.kinds.append(law.__name__)
            terms.append(law(draft, freedom))
        law = "\n, ".join(f"+{term}" if i else term for i, term in enumerate(terms))
        draft.lines.append(freedom.load.format(id=k + 1, law=law))
    steps = int(rng.choice([10, 30, 100, 300]))
    return draft.deck(f"random {seed}-{number}: {' '.join(draft.kinds)}", steps)


# ---------------------------------------------------------------------------------- mechanisms


def masses(draft: Draft) -> None:
    """One to three point masses on rails of force only: free in space, pulled back sideways."""
    draft.kinds.append("masses")
    for k in range(2, 2 + int(draft.rng.integers(1, 4))):
        mass = draft.decade(-1, 1.3)
        draft.lines += [
            f"POINT_MASS/{k}, MASS={mass}, CM={k}, QG={draft.start(-0.5, 0.5)},"
            f"{draft.start(-0.5, 0.5)},{draft.start(-0.5, 0.5)}, VX={draft.start(-5, 5)}",
            f"MARKER/{k}, POINT_MASS={k}",
        ]
        side = f"{-draft.decade(0, 3) * mass:.4g}"
        load = f"VFORCE/{{id}}, I={k}, JFLOAT={10 + k}, RM=1, FX={{law}}"
        load += f"\n, FY={side}*DY({k}), FZ={side}*DZ({k})"
        draft.lines.append(f"MARKER/{10 + k}, PART=1, FLOATING")
        draft.freedoms.append(Freedom(f"DX({k})", f"VX({k})", f"ACCX({k})", load, mass))
        if k > 2 and draft.chance(0.6):
            stiff, length = draft.decade(0, 4), draft.between(0.2, 1)
            draft.lines.append(
                f"SPRINGDAMPER/{k}, TRANSLATIONAL, I={k}, J={k - 1}, K={stiff}, LENGTH={length}"
            )


def pendulum(draft: Draft) -> None:
    """A part on a revolute joint whose axis is z, loaded by a torque about it."""
    draft.kinds.append("pendulum")
    mass, arm = draft.decade(-1, 1), draft.between(0.2, 1.5)
    inertia = mass * arm * arm * draft.between(0.01, 0.4)
    draft.lines += [
        f"PART/2, MASS={mass}, CM=22, IP={inertia:.4g},{inertia:.4g},{inertia:.4g}"
        f", REULER={draft.start(-2, 2)},0,0",
        "MARKER/20, PART=2",
        f"MARKER/22, PART=2, QP=0,{-arm},0",
        f"JOINT/1, REVOLUTE, I=20, J=1, IC={draft.start(-2, 2)},{draft.start(-4, 4)}",
    ]
    load = "SFORCE/{id}, ROTATIONAL, I=20, J=1, FUNCTION={law}"
    whole = inertia + mass * arm * arm
    draft.freedoms.append(Freedom("AZ(20,1)", "WZ(20,1)", "WDTZ(20,1)", load, whole, 2.0))


def slider(draft: Draft) -> None:
    """A part on a translational joint along a leaning rail."""
    draft.kinds.append("slider")
    mass = draft.decade(-1, 1.3)
    lean = draft.between(-1.5, 1.5)
    draft.lines += [
        f"MARKER/5, PART=1, REULER=90D,90D,{lean}",
        f"PART/2, MASS={mass}, CM=20, IP={mass:.4g},{mass:.4g},{mass:.4g}",
        f"MARKER/20, PART=2, REULER=90D,90D,{lean}",
        f"JOINT/1, TRANSLATIONAL, I=20, J=5, IC={draft.start(-0.5, 0.5)},{draft.start(-5, 5)}",
    ]
    load = "SFORCE/{id}, TRANSLATIONAL, ACTIONONLY, I=20, J=5, FUNCTION={law}"
    draft.freedoms.append(Freedom("DZ(20,5,5)", "VZ(20,5,5)", "ACCZ(20,5,5)", load, mass))


def parallelogram(draft: Draft) -> None:
    """Four bars of a trapezium that stays away from its flat posture; rows are redundant."""
    draft.kinds.append("four-bar")
    crank, base = draft.between(0.1, 0.3), draft.between(0.8, 1.2)
    mass = draft.decade(-1, 1)
    angle = draft.start(1.2, 1.9)
    small = mass * crank * crank / 12
    draft.lines += [
        f"MARKER/2, PART=1, QP={base},0,0",
        f"PART/2, MASS={mass}, CM=22, IP=1E-3,{small:.4g},{small:.4g}, REULER={angle},0,0",
        "MARKER/20, PART=2",
        f"MARKER/21, PART=2, QP={crank},0,0",
        f"MARKER/22, PART=2, QP={crank / 2:.6g},0,0",
        f"PART/3, MASS={mass}, CM=32, IP=1E-3,{mass * base / 12:.4g},{mass * base / 12:.4g}"
        f", QG={crank * cos(float(angle))!r},{crank * sin(float(angle))!r},0",
        "MARKER/30, PART=3",
        f"MARKER/31, PART=3, QP={base},0,0",
        f"MARKER/32, PART=3, QP={base / 2:.6g},0,0",
        f"PART/4, MASS={mass}, CM=42, IP=1E-3,{small:.4g},{small:.4g}, QG={base},0,0"
        f", REULER={angle},0,0",
        "MARKER/40, PART=4",
        f"MARKER/41, PART=4, QP={crank},0,0",
        f"MARKER/42, PART=4, QP={crank / 2:.6g},0,0",
        f"JOINT/1, REVOLUTE, I=20, J=1, IC={angle},{draft.start(-1, 1)}",
        "JOINT/2, REVOLUTE, I=30, J=21",
        "JOINT/3, REVOLUTE, I=31, J=41",
        "JOINT/4, REVOLUTE, I=40, J=2",
    ]
    inertia = 2.0 * mass * crank * crank
    # Holds the crank between about 50 and 130 degrees.
    hold = f"-{400 * inertia:.4g}*(AZ(20,1)-PI/2)-{4000 * inertia:.4g}*(AZ(20,1)-PI/2)**3"
    load = f"SFORCE/{{id}}, ROTATIONAL, I=20, J=1, FUNCTION={hold}\n, +{{law}}"
    draft.freedoms.append(Freedom("(AZ(20,1)-PI/2)", "WZ(20,1)", "WDTZ(20,1)", load, inertia, 0.4))


def top(draft: Draft) -> None:
    """A spinning part on a ball, or free: gyroscopic torques, torque about its own axis."""
    draft.kinds.append("top")
    mass, arm = draft.decade(-1, 1), draft.between(0.05, 0.3)
    axial = mass * arm * arm * draft.between(0.3, 0.9)
    cross = axial * draft.between(0.55, 1.5)
    spin = draft.between(5, 80)
    draft.lines += [
        f"PART/2, MASS={mass}, CM=22, IP={cross:.4g},{cross * 1.02:.4g},{axial:.4g}"
        f", REULER=0,{draft.start(0.2, 1.2)},0, WZ={spin}, WX={draft.start(-2, 2)}",
        "MARKER/20, PART=2",
        f"MARKER/22, PART=2, QP=0,0,{arm}",
    ]
    if draft.chance(0.7):
        draft.lines.append("JOINT/1, SPHERICAL, I=20, J=1")
    load = "VFORCE/{id}, I=22, JFLOAT=12, RM=1, FX={law}, FY=0, FZ=0"
    draft.lines.append("MARKER/12, PART=1, FLOATING")
    draft.freedoms.append(Freedom("DX(22)", "VX(22)", "ACCX(22)", load, mass, 0.3))


def crane(draft: Draft) -> None:
    """A trolley on a rail with a rod that swings below it."""
    draft.kinds.append("trolley")
    slider(draft)
    mass, arm = draft.decade(-1, 1), draft.between(0.3, 1.2)
    moment = mass * arm * arm / 3
    draft.lines += [
        f"PART/3, MASS={mass}, CM=32, IP={moment:.4g},{moment:.4g},{moment / 10:.4g}",
        "MARKER/30, PART=3",
        f"MARKER/32, PART=3, QP=0,{-arm},0",
        "MARKER/24, PART=2",
        f"JOINT/2, REVOLUTE, I=30, J=24, IC={draft.start(-1, 1)},{draft.start(-2, 2)}",
    ]


MECHANISMS = (masses, pendulum, slider, parallelogram, top, crane)
SHARES = (0.4, 0.15, 0.15, 0.08, 0.12, 0.1)


# ---------------------------------------------------------------------------------- laws


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

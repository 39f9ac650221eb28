"""Random small decks: one to three moving bodies and the laws that integrators stumble over.

A *mechanism* offers freedoms, each with the words that measure it (x, v, a) and the statement that
loads it.  Every freedom gets a restoring force and some of the laws of :mod:`random_laws`.

A deck is fixed by its number and seed; ``nudge`` moves its start a little, to learn how much the
motion itself amplifies an error.
"""

from __future__ import annotations

from math import cos, sin

import numpy as np

from benchmarks.random_drafts import Draft, Freedom, RandomDeck
from benchmarks.random_laws import LAWS, spring


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

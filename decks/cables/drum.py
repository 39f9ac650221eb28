"""A cable laid on a drum that turns and lets a weight down; the same without a drum.

The drum's centre is at (-R, 0); the cable leaves it at the origin, downwards. Wound, node at the
length w from there: angle w/R about the centre, counted from the x axis.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from formulas import Cable, G, Winch
from payouts import hanging_deck
from pulleys import damped_section, damped_variables
from spans import Span, table

from adamslite.cables.statements.forms import head, number, point, tail

DRUM = 9021
DAMPING = 0.2


@dataclass(frozen=True)
class Drum:
    """Radius [m], length of a section [m], sections wound and hanging, weight [kg], payout."""

    cable: Cable
    radius: float
    section: float
    wound: int
    hanging: int
    weight: float
    winch: Winch
    end: float
    contact: float = 1e7

    def load(self, height: float) -> float:
        """Tension at rest at a height above the weight [N]."""
        return (self.weight + self.cable.density * height) * G

    def places(self) -> list[tuple[float, float]]:
        """Nodes at rest, from the weight (0) to the end that is fixed to the drum.

        The hanging ones upwards from the weight, whose depth follows from their lengths; on the
        drum sections are chords, and nodes sink in until the contact carries them.
        """
        free, hung = self.section, self.section * self.hanging
        below = [
            free * (1 + self.load((k + 0.5) * free) / self.cable.stiffness)
            for k in range(self.hanging)
        ]
        places = [(0.0, -depth) for depth in np.cumsum(below[::-1])[::-1]]
        angle = 0.0
        for _ in range(self.wound + 1):
            height = hung + self.radius * np.sin(angle)
            stretched = free * (1 + self.load(height) / self.cable.stiffness)
            sunk = self.load(height) * stretched / self.radius / self.contact
            r = self.radius - sunk
            places.append((r * np.cos(angle) - self.radius, r * np.sin(angle)))
            angle += 2 * np.arcsin(stretched / 2 / r)
        return places


def deck(d: Drum) -> str:
    """All of the cable as sections; node 0 is the weight, the last node is fixed to the drum."""
    n, mass = d.wound + d.hanging, d.cable.density * d.section
    text = head(
        f"A weight of {d.weight:g} kg is let down by a drum",
        f"""{d.wound} sections are laid on a drum of {d.radius:g} m (PART/{DRUM}), {d.hanging} hang
        below it with the weight (MARKER/1). Masses rest on the drum by contact, without friction;
        the end of the cable is fixed to it.""",
        f"ACCGRAV/JGRAV={number(-G)}",
        "",
        "PART/1, GROUND",
        f"MARKER/{DRUM + 1}, PART=1, QP={number(-d.radius)},0,0",
        f"MARKER/{DRUM + 2}, PART=1",
    )
    text += damped_variables(d.cable, DAMPING)
    text += f"VARIABLE/L_0, FUNCTION={number(d.section)}\n\n"
    places = d.places()
    x, y = places[n]
    text += (
        f"PART/{DRUM}, MASS=100, CM={DRUM}, IP=10,10,20, QG={number(-d.radius)},0,0\n"
        f"MARKER/{DRUM}, PART={DRUM}\n"
        f"MARKER/{n + 1}, PART={DRUM}, QP={number(x + d.radius)},{number(y)},0\n"
        f"JOINT/1, REVOLUTE, I={DRUM}, J={DRUM + 1}\n"
        f"GCON/1, FUNCTION={d.radius:g}*AZ({DRUM},{DRUM + 1})\n, +{d.winch.text}\n\n"
    )
    for k in range(n):
        text += point(k + 1, d.weight if k == 0 else mass, places[k])
    text += "\n"
    for k in range(1, n + 1):
        text += damped_section(k, k, k + 1, "L_0", DAMPING)
    text += "\n! The drum carries what lies on it.\n"
    for k in range(1, n):
        text += (
            f"SFORCE/{1000 + k}, I={k + 1}, J={DRUM}, FUNCTION=IMPACT(DM({k + 1},{DRUM})"
            f",VR({k + 1},{DRUM}),{d.radius:g},{d.contact:g},1.0,{d.contact * 1e-5:g},1.0E-5)\n"
        )
    text += (
        "\n! Tension at the weight, its depth, tension at the fixed end.\n"
        f"REQUEST/2, F2=SFORCE(1,0,1)\\ F3=-DY(1,{DRUM + 2})\\ F4=SFORCE({n},0,1)\n"
    )
    return text + tail("HHT, ERROR=1.0E-5", d.end, round(d.end / 0.005))


SETS = {
    "": Drum(Cable(5.0e6, 1.0), 0.5, 0.025, 112, 80, 200.0, Winch(1.0, 0.2, 5), 3.0),
    "-second": Drum(Cable(8.0e6, 2.0), 0.4, 0.02, 112, 60, 300.0, Winch(0.8, 0.2, 5), 3.0),
}


def drum() -> Iterator[tuple[str, str, str]]:
    """Tension at the weight M (g - s") and its depth, with the drum and without."""
    for name, d in SETS.items():
        t = np.linspace(0, d.end, 61)
        s, _, acceleration = d.winch(t)
        depth = s - d.places()[0][1]
        lines = [
            "Tension at the weight and its depth: README.md",
            "written by generate.py",
            "tolerance REQUEST/2.F2: peak 5e-3",
            "tolerance REQUEST/2.F3: abs 5e-4",
        ]
        columns = [t, d.weight * (G - acceleration), depth]
        reference = table(["time", "REQUEST/2.F2", "REQUEST/2.F3"], lines, columns)
        yield f"drum{name}", deck(d), reference
        # The drum feeds stretched cable, the element counts it unstretched.
        strain = d.load(d.section * d.hanging) / d.cable.stiffness
        winch = replace(d.winch, speed=d.winch.speed / (1 + strain))
        span = Span("ale", d.cable, 20, d.section * d.hanging, DAMPING)
        without = hanging_deck(span, winch, d.weight, d.end, round(d.end / 0.005))
        yield f"no-drum{name}", without, reference


CASES = {"drum": drum}

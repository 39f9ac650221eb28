"""Axial steps and echoes, and how the tension behind an impact grows with its speed."""

from collections.abc import Iterator

import numpy as np
from formulas import Cable, Impact
from statements import HEAVY, cable_variables, head, impedance, number, point, section, tail

LENGTH = 15.0
REFERENCE = Cable(6.0e7, 5.536, 13345.0), 10.0
SECOND = Cable(4.5e7, 4.0, 40000.0), 16.0
SETS = {"": REFERENCE, "-second": SECOND}
DAMPING = 0.2


def chain(cable: Cable, sections: int, first: int, y: float, struck, speed, damping=DAMPING) -> str:
    """A straight cable on 0 <= x <= LENGTH; its end at x = LENGTH, of mass `struck`, has `speed`.

    Nodes are MARKER/first (x = 0, left out) to MARKER/first + sections, sections are numbered alike.
    """
    free = LENGTH / sections / (1 + cable.strain)
    mass = cable.density * free
    text = "\n"
    for k in range(1, sections + 1):
        x = k * LENGTH / sections
        if k < sections:
            text += point(first + k, mass, [x, y])
        else:
            text += point(first + k, struck + mass / 2, [x, y], speed)
    for k in range(1, sections + 1):
        text += section(first + k, first + k - 1, first + k, "L_0", damping)
    return text


def start(title: str, notes: str, cable: Cable, sections: int, damping: float, *lines: str) -> str:
    """Everything before the chains."""
    free = LENGTH / sections / (1 + cable.strain)
    text = head(title, notes, "", "PART/1, GROUND", *lines)
    return text + cable_variables(cable, damping) + f"VARIABLE/L_0, FUNCTION={number(free)}\n"


def step_deck(cable: Cable, speed: float, sections: int) -> str:
    """One end is pulled, behind the other the cable goes on."""
    text = start(
        f"An axial step of {speed:g} m/s",
        f"""A cable of {sections} sections on {LENGTH:g} m; from TIME = 0 its right end is pulled away at
{speed:g} m/s (a mass that nothing slows down). At its left end it goes on for ever.""",
        cable,
        sections,
        DAMPING,
    )
    mass = cable.density * LENGTH / sections / (1 + cable.strain) / 2
    text += "\n" + point(1, mass, [0.0])
    text += chain(cable, sections, 1, 0.0, HEAVY, [speed])
    # The run pulls to the left: the marker's z axis is -x.
    text += (
        "! A long run goes on to the left: it pulls with T0 + rho c v.\n"
        "MARKER/9004, PART=1, REULER=90D,90D,0D\n"
        "SFORCE/9004, ACTIONONLY, I=1, J=9004"
        f", FUNCTION=-{number(cable.pretension)}-SQRT(EA*rho)*VX(1)\n"
    )
    middle = sections // 2
    text += f"\n! Tensions at the pulled end, half way and at the left.\nREQUEST/1, F2=SFORCE({sections + 1},0,1)\\ F3=SFORCE({middle},0,1)\\ F4=SFORCE(2,0,1)\n"
    transit = LENGTH / cable.speed
    return text + tail("VERLET, ERROR=1.0E-3", round(2.5 * transit, 5), 500)


def step() -> Iterator[tuple[str, str, str]]:
    """K6: T0 + rho c V everywhere behind the front, for ever."""
    for name, (cable, speed) in SETS.items():
        jump, transit = cable.impedance * speed, LENGTH / cable.speed
        end = round(2.5 * transit, 5)
        lines = []
        for column, passed in (("F2", 0.0), ("F3", 0.5), ("F4", 1.0)):
            t0 = round((passed + 0.1) * transit / end * 500) * end / 500
            value = number(cable.pretension + jump)
            allowed = number(1e-3 * jump)
            lines.append(
                f"# measure: mean REQUEST/1.{column} from {number(t0)} = {value} tol abs {allowed}\n"
            )
        yield (
            f"axial-step{name}",
            step_deck(cable, speed, 240),
            f"# T0 + rho c V, rho c V = {number(jump)} N: README.md\n# written by generate.py\n"
            + "".join(lines),
        )


CASES = {"axial-step": step}

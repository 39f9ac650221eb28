"""Axial steps and echoes, and how the tension behind an impact grows with its speed."""

from collections.abc import Iterator

import numpy as np
from formulas import Cable, Impact
from pulleys import HEAVY, damped_section, damped_variables, impedance

from adamslite.cables.statements.forms import head, number, point, tail

LENGTH = 15.0
REFERENCE = Cable(6.0e7, 5.536, 13345.0), 10.0
SECOND = Cable(4.5e7, 4.0, 40000.0), 16.0
SETS = {"": REFERENCE, "-second": SECOND}
DAMPING = 0.2
PACE = 2e-5


def mean(column: str, t0: float, t1: float, value: float, allowed: float) -> str:
    """One measure of REQUEST/1."""
    return (
        f"# measure: mean REQUEST/1.{column} from {number(t0)} to {number(t1)}"
        f" = {number(value)} tol abs {number(allowed)}\n"
    )


def finish(end: float) -> str:
    """Runs to a whole number of output steps."""
    steps = round(end / PACE)
    return tail("VERLET, ERROR=1.0E-3", steps * PACE, steps)


def chain(cable: Cable, sections: int, first: int, y: float, struck, speed, damping=DAMPING) -> str:
    """A straight cable on 0 <= x <= LENGTH; its end at x = LENGTH, of mass `struck`, has `speed`.

    Nodes are MARKER/first (at x = 0, left out) to MARKER/first + sections.
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
        text += damped_section(first + k, first + k - 1, first + k, "L_0", damping)
    return text


def start(title: str, notes: str, cable: Cable, sections: int, damping: float, *lines: str) -> str:
    """Everything before the chains."""
    free = LENGTH / sections / (1 + cable.strain)
    text = head(title, notes, "", "PART/1, GROUND", *lines)
    return text + damped_variables(cable, damping) + f"VARIABLE/L_0, FUNCTION={number(free)}\n"


def step_deck(cable: Cable, speed: float, sections: int) -> str:
    """One end is pulled, behind the other the cable goes on."""
    text = start(
        f"An axial step of {speed:g} m/s",
        f"""A cable of {sections} sections on {LENGTH:g} m; from TIME = 0 its right end is
        pulled away at {speed:g} m/s (a mass that nothing slows down). At its left end it
        goes on for ever.""",
        cable,
        sections,
        DAMPING,
    )
    mass = cable.density * LENGTH / sections / (1 + cable.strain) / 2
    text += "\n" + point(1, mass, [0.0])
    text += chain(cable, sections, 1, 0.0, HEAVY, [speed])
    text += impedance(9004, 1, cable, -1)
    middle = sections // 2
    text += (
        "\n! Tensions at the pulled end, half way and at the left.\n"
        f"REQUEST/1, F2=SFORCE({sections + 1},0,1)\\ F3=SFORCE({middle},0,1)\\ F4=SFORCE(2,0,1)\n"
    )
    return text + finish(1.95 * LENGTH / cable.speed)


def step() -> Iterator[tuple[str, str, str]]:
    """K6: T0 + rho c V everywhere behind the front, for ever."""
    for name, (cable, speed) in SETS.items():
        jump, transit = cable.impedance * speed, LENGTH / cable.speed
        lines = []
        for column, first, last in (("F2", 0.1, 1.9), ("F3", 0.6, 1.4), ("F4", 1.1, 1.9)):
            t0, t1 = (PACE * round(share * transit / PACE) for share in (first, last))
            lines.append(mean(column, t0, t1, cable.pretension + jump, 1e-3 * jump))
        yield (
            f"axial-step{name}",
            step_deck(cable, speed, 240),
            f"# T0 + rho c V, rho c V = {number(jump)} N: README.md\n# written by generate.py\n"
            + "".join(lines),
        )


def echo_deck(cable: Cable, speed: float, mass: float, sections: int) -> str:
    """Three cables side by side: held and free at the left, and struck by a mass at the right."""
    held, free, struck, right = 1, 1001, 2001, 2001 + sections
    text = start(
        f"Echoes of an axial step of {speed:g} m/s",
        f"""Three cables of {sections} sections on {LENGTH:g} m, 1 m apart; their right ends get
        {speed:g} m/s at TIME = 0. MARKER/{held} on: held at the left. MARKER/{free} on:
        free at the left, where a dead load keeps up T0. MARKER/{struck} on: struck by a
        mass of {mass:g} kg, with a dead load T0; the left goes on for ever.""",
        cable,
        sections,
        DAMPING,
        f"MARKER/{held}, PART=1",
    )
    half = cable.density * LENGTH / sections / (1 + cable.strain) / 2
    text += chain(cable, sections, held, 0.0, HEAVY, [speed])
    text += "\n" + point(free, half, [0.0, 1.0])
    text += chain(cable, sections, free, 1.0, HEAVY, [speed])
    text += "\n" + point(struck, half, [0.0, 2.0])
    text += chain(cable, sections, struck, 2.0, mass, [speed])
    text += impedance(9004, struck, cable, -1)
    text += (
        "! Dead loads.\n"
        f"SFORCE/9005, ACTIONONLY, I={free}, J=9004, FUNCTION=-{number(cable.pretension)}\n"
        f"SFORCE/9006, ACTIONONLY, I={right}, J=9004, FUNCTION={number(cable.pretension)}\n"
        "\n! Tension at the held end, half way to the free end, at the mass.\n"
        f"REQUEST/1, F2=SFORCE({held + 1},0,1)\\ F3=SFORCE({free + sections // 2},0,1)"
        f"\\ F4=SFORCE({right},0,1)\n"
    )
    return text + finish(2.95 * LENGTH / cable.speed)


def echo() -> Iterator[tuple[str, str, str]]:
    """A held end doubles the jump, a free end cancels it, a mass lets it fade."""
    for (name, (cable, speed)), mass in zip(SETS.items(), (1000.0, 150.0), strict=True):
        jump, transit = cable.impedance * speed, LENGTH / cable.speed
        t0, fade = cable.pretension, cable.impedance / mass

        def window(first: float, last: float, transit: float = transit) -> list[float]:
            return [PACE * round(share * transit / PACE) for share in (first, last)]

        lines = [mean("F2", *window(1.25, 2.75), t0 + 2 * jump, 1e-3 * jump)]
        lines.append(mean("F3", *window(0.75, 1.25), t0 + jump, 1e-3 * jump))
        lines.append(mean("F3", *window(1.75, 2.25), t0, 1e-3 * jump))
        for a, b in (window(0.1, 1.0), window(1.0, 1.75)):
            # The first section is half a section away from the mass: the front comes later there.
            a0, b0 = (t - transit / 240 for t in (a, b))
            share = (np.exp(-fade * a0) - np.exp(-fade * b0)) / (fade * (b - a))
            lines.append(mean("F4", a, b, t0 + jump * share, 1e-3 * jump))
        yield (
            f"axial-echo{name}",
            echo_deck(cable, speed, mass, 120),
            f"# Echoes of a jump of rho c V = {number(jump)} N: README.md\n"
            "# written by generate.py\n" + "".join(lines),
        )


def scan_deck(cable: Cable, speeds: tuple[float, float], sections: int) -> str:
    """Two impacts on cables without pretension, one 100 m beside the other."""
    text = start(
        f"Transverse impact at {speeds[0]:g} and {speeds[1]:g} m/s without pretension",
        f"""Two cables of {sections} sections on {LENGTH:g} m, slack to begin with. Their hooks,
        at the right, move across at {speeds[0]:g} and {speeds[1]:g} m/s; at the left the
        cables go on for ever.""",
        cable,
        sections,
        DAMPING,
    )
    half = cable.density * LENGTH / sections / 2
    for first, y, speed in zip((1, 1001), (0.0, 100.0), speeds, strict=True):
        text += "\n" + point(first, half, [0.0, y])
        text += chain(cable, sections, first, y, HEAVY, [0.0, speed])
        text += impedance(9003 + first, first, cable, -1)
    slow, fast = 1 + sections, 1001 + sections
    text += (
        "\n! Tension at both hooks, and the exponent of the speed by which it grows.\n"
        f"REQUEST/1, F2=SFORCE({slow},0,1)\\ F3=SFORCE({fast},0,1)\\\n"
        f", F4=LOG(MAX(SFORCE({fast},0,1),1)/MAX(SFORCE({slow},0,1),1))"
        f"/LOG({speeds[1] / speeds[0]:g})\n"
    )
    return text + finish(SCAN_END)


SCAN_END = 0.05


def scan() -> Iterator[tuple[str, str, str]]:
    """K7."""
    for name, cable, speeds in (
        ("", Cable(6.0e7, 5.536), (20.0, 40.0)),
        ("-second", Cable(4.5e7, 4.0), (25.0, 75.0)),
    ):
        slow, fast = (Impact(cable, speed).tension for speed in speeds)
        exponent = np.log(fast / slow) / np.log(speeds[1] / speeds[0])
        yield (
            f"speed-scan{name}",
            scan_deck(cable, speeds, 240),
            "# T1 at two speeds and dlnT1/dlnV: README.md\n# written by generate.py\n"
            + mean("F2", 0.02, SCAN_END, slow, 1e-3 * slow)
            + mean("F3", 0.02, SCAN_END, fast, 1e-3 * fast)
            + mean("F4", 0.02, SCAN_END, exponent, 5e-3),
        )


CASES = {"axial-step": step, "axial-echo": echo, "speed-scan": scan}

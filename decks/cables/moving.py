"""Waves in a cable that is paid out from the start on: a step of the payout, a transverse pulse.

The cable leaves the sheave (MARKER/1, the origin) along +x.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from formulas import Cable
from pulleys import HEAVY, pulley
from spans import FORMS, Span, table

from adamslite.cables.statements.forms import grown, number, point, tail


@dataclass(frozen=True)
class Pulse:
    """y = height exp(-((x - place)/width)^2), on its way to the sheave at `wave` in the cable."""

    place: float
    width: float
    height: float
    wave: float

    def __call__(self, x: float) -> tuple[float, float]:
        """y and dy/dx."""
        y = self.height * float(np.exp(-(((x - self.place) / self.width) ** 2)))
        return y, -2 * (x - self.place) / self.width**2 * y


def moving_nodes(span: Span, speed: float, tip_moves: bool, pulse: Pulse) -> str:
    """Pulley that pays out at a constant speed from the start on, nodes and sections.

    The straight cable moves at the payout speed when the tip does; without, it still stands. A node
    of the paper's element has its share of the tip's speed.
    """
    n, stretch = span.sections, 1 + span.cable.strain
    text = pulley(HEAVY, speed) + "\n"
    for k in range(1, n + 1):
        xi, x = k / n, k * stretch * span.length / n
        y, slope = pulse(x)
        # Through an ale node flows W = (1 - xi) of the payout.
        flows = (1 - xi) * speed * stretch if span.form == "ale" else 0.0
        moves = speed * stretch * (xi if span.form == "paper" else 1.0) if tip_moves else 0.0
        mass = HEAVY if k == n else span.node_mass
        text += point(k + 1, mass, [x, y], [moves - flows, (pulse.wave - flows) * slope])
        text += grown(span.form, k, n) if k < n else ""
    return text + span.sections_text()


def step() -> Iterator[tuple[str, str, str]]:
    """2.2 F: the sheave lets go at once, the far end notices after l/c."""
    for form in FORMS:
        for name, (cable, n, length, speed) in {
            "": (Cable(6.0e7, 5.536, 90000.0), 160, 20.0, 2.0),
            "-second": (Cable(4.5e7, 4.0, 150000.0), 200, 30.0, 4.0),
        }.items():
            span = Span(form, cable, n, length, 0.2)
            deck = span.text(
                f"A step of {speed:g} m/s in the payout",
                f"""From TIME = 0 the pulley feeds {speed:g} m/s into a cable whose far end
                (MARKER/{n + 1}) is held by a mass that nothing moves.""",
                "MARKER/1, PART=1                ! the sheave",
            )
            deck += moving_nodes(span, speed, False, Pulse(0.0, 1.0, 0.0, 0.0))
            deck += (
                "\n! Tension at the sheave and at the far end.\n"
                f"REQUEST/1, F2=SFORCE(1,0,2)\\ F3=SFORCE({n},0,2)\n"
            )
            end = 2.9 * length / cable.speed
            deck += tail("GSTIFF, SI2, ERROR=1.0E-6", end, 580)
            yield f"{form}{name}", deck, step_reference(span, speed, end)


def step_reference(span: Span, speed: float, end: float) -> str:
    """paper: EA (l/(l0 + U t) - 1) everywhere; ale: a wave of rho c U, doubled at the far end."""
    cable, length = span.cable, span.length
    lines = ["Tension at the sheave and at the far end: README.md", "written by generate.py"]
    jump = cable.impedance * speed * (1 + cable.strain) / (1 + speed / cable.speed)
    if span.form == "paper":
        t = np.linspace(0, end, 30)
        stretch = length * (1 + cable.strain) / (length + speed * t)
        damper = 2 * span.damping * cable.impedance * speed / span.sections
        pull = cable.stiffness * (stretch - 1) - damper * stretch
        lines.append(f"tolerance: abs {number(1e-3 * jump)}")
        return table(["time", "REQUEST/1.F2", "REQUEST/1.F3"], lines, [t, pull, pull])
    t0, pace = cable.pretension, end / 580
    for column, first, last, value in (
        ("F2", 0.2, 1.8, t0 - jump),
        ("F3", 0.0, 0.8, t0),
        ("F3", 1.2, 2.8, t0 - 2 * jump),
    ):
        a, b = (
            number(pace * round(share * length / cable.speed / pace)) for share in (first, last)
        )
        lines.append(
            f"measure: mean REQUEST/1.{column} from {a} to {b} = {number(value)}"
            f" tol abs {number(1e-3 * jump)}"
        )
    return "".join(f"# {line}\n" for line in lines)


def transverse() -> Iterator[tuple[str, str, str]]:
    """P3 (2.2 E): when a transverse pulse comes to the sheave against the payout."""
    for form in FORMS:
        for name, (cable, n, length, share) in {
            "": (Cable(6.0e7, 5.536, 55360.0), 240, 100.0, 0.1),
            "-second": (Cable(2.0e7, 4.0, 25600.0), 240, 60.0, 0.2),
        }.items():
            span, stretch = Span(form, cable, n, length, 0.2), 1 + cable.strain
            wave = cable.transverse(cable.strain)
            speed = share * wave / stretch
            pulse = Pulse(0.8 * length * stretch, 0.05 * length, 1e-4 * length, wave)
            deck = span.text(
                f"A transverse pulse against the payout of {speed:.4g} m/s",
                f"""The cable is paid out at a constant speed; its tip (MARKER/{n + 1}) goes with
                it. A pulse that starts at {pulse.place:.4g} m runs to the sheave. Node 1 passes
                y = 0 when its middle has come.""",
                "MARKER/1, PART=1                ! the sheave",
            )
            deck += moving_nodes(span, speed, True, pulse)
            deck += "\n! Slope at the sheave.\nREQUEST/1, F2=DY(2,1)/H\n"
            if form == "paper":
                come = (np.exp(share * pulse.place / (length * stretch)) - 1) * (
                    length * stretch / (share * wave)
                )
            else:
                come = pulse.place / (wave * (1 - share))
            pace = 1e-3
            deck += tail(
                "HHT, ERROR=1.0E-6", pace * round(1.05 * come / pace), round(1.05 * come / pace)
            )
            start = pace * round((come - 0.5 * pulse.width / wave) / pace)
            yield (
                f"{form}{name}",
                deck,
                "# Arrival of the pulse at the sheave: README.md\n# written by generate.py\n"
                f"# measure: arrival REQUEST/1.F2 through 0 from {number(start)} = {number(come)}"
                " tol rel 5e-3\n",
            )


CASES = {"payout-step": step, "transverse-arrival": transverse}

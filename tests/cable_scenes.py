"""Cable scenes of any form and number of sections, each with a closed form to hold it against.

A scene is drawn twice: as a user might, to be advised, and then as the advice says.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import pi, sqrt

import kinks
import moving
import numpy as np
import payouts
import waves
from formulas import Cable, G, Winch
from spans import Span

from adamslite.cables.statements.forms import cable_variables, head, number, point, section, tail
from adamslite.results.results import Results
from adamslite.verification.measures import arrival, plateau

Draw = Callable[[str, int], str]
Judge = Callable[[Results, int], float]


@dataclass(frozen=True)
class CableScene:
    """`draw(form, sections)` is its deck; `error(results, sections)` is relative, of what a user
    reads: a tension, a time, a path.
    """

    draw: Draw
    error: Judge
    drawn: tuple[str, int]


def axial_step() -> CableScene:
    """T0 + rho c V behind the front of a pull at 10 m/s, half way along the cable."""
    cable, speed = Cable(6.0e7, 5.536, 13345.0), 10.0
    transit = waves.LENGTH / cable.speed
    exact = cable.pretension + cable.impedance * speed

    def error(run: Results, _: int) -> float:
        pull = run["REQUEST/1.F3"]
        return plateau(run.time, pull, 0.6 * transit, 1.4 * transit) / exact - 1

    return CableScene(lambda _, n: waves.step_deck(cable, speed, n), error, ("fixed", 12))


def anchored_kink() -> CableScene:
    """T2 where a kink at 65 m/s meets an anchor."""
    impact, length = kinks.REFERENCE, 60.0
    transit = length / impact.cable.speed

    def error(run: Results, _: int) -> float:
        pull = run["REQUEST/1.F2"]
        return plateau(run.time, pull, 0.3 * transit, 1.9 * transit) / impact.anchored - 1

    def draw(_: str, n: int) -> str:
        return kinks.anchored_cable(impact, length, n, 0.2)

    return CableScene(draw, error, ("fixed", 20))


def free_running_kink() -> CableScene:
    """T2 where it meets a sheave that feeds from a long run."""
    impact = kinks.REFERENCE
    window = kinks.windows(impact)

    def error(run: Results, _: int) -> float:
        return (
            plateau(run.time, run["REQUEST/1.F2"], window["c"], window["d"]) / impact.free_running
            - 1
        )

    return CableScene(lambda form, n: kinks.growing(form, impact, n), error, ("paper", 30))


def lowered_weight(speed: float, drawn: str) -> CableScene:
    """(M + rho l)(g - s") at the sheave: 1000 kg on 4 kg/m, let down at `speed` [m/s]."""
    cable, winch, weight = Cable(2.0e7, 4.0), Winch(speed, 0.6, 5), 1000.0

    def draw(form: str, n: int) -> str:
        return payouts.hanging_deck(Span(form, cable, n, 20.0, 0.2), winch, weight, 12, 500)

    def error(run: Results, _: int) -> float:
        paid, _, acceleration = winch(run.time)
        exact = (weight + cable.density * (20.0 + paid)) * (G - acceleration)
        return np.max(np.abs(-run["SFORCE/1.f"] / exact - 1))

    return CableScene(draw, error, (drawn, 5))


def lowered_cable() -> CableScene:
    """rho l (g - s") at the sheave: the cable alone, let down at 10 m/s."""
    cable, winch = Cable(6.0e7, 5.536), Winch(10.0, 0.5, 5)

    def draw(form: str, n: int) -> str:
        return payouts.hanging_deck(Span(form, cable, n, 20.0, 0.2), winch, 0.0, 4, 200)

    def error(run: Results, _: int) -> float:
        paid, _, acceleration = winch(run.time)
        exact = cable.density * (20.0 + paid) * (G - acceleration)
        return np.max(np.abs(-run["SFORCE/1.f"] / exact - 1))

    return CableScene(draw, error, ("paper", 10))


def level_payout(speed: float) -> CableScene:
    """T0 + rho l s"/2 at the tip of a cable that is fed and drawn off alike."""
    cable, winch = Cable(6.0e7, 5.536, 13345.0), Winch(speed, 0.1)

    def draw(form: str, n: int) -> str:
        return payouts.level_deck(Span(form, cable, n, 20.0, 0.2), winch, 2.4, 480)

    def error(run: Results, n: int) -> float:
        paid, _, acceleration = winch(run.time)
        inertia = cable.density * (20.0 + paid) * acceleration * (1 + cable.strain)
        exact = cable.pretension + inertia / 2
        return np.max(np.abs(-run[f"SFORCE/{n}.f"] / exact - 1))

    return CableScene(draw, error, ("paper", 10))


def payout_step() -> CableScene:
    """T0 - rho c U behind the front that a sudden payout sends into a cable at rest: at the sheave
    while it runs, and half way along the cable.
    """
    cable, length, speed = Cable(6.0e7, 5.536, 90000.0), 20.0, 2.0
    transit = length / cable.speed
    jump = cable.impedance * speed * (1 + cable.strain) / (1 + speed / cable.speed)

    def draw(form: str, n: int) -> str:
        span = Span(form, cable, n, length, 0.2)
        text = span.text("A step in the payout", "", "MARKER/1, PART=1")
        text += moving.moving_nodes(span, speed, False, moving.Pulse(0.0, 1.0, 0.0, 0.0))
        text += f"REQUEST/1, F2=SFORCE(1,0,2)\\ F3=SFORCE({n // 2},0,2)\n"
        return text + tail("GSTIFF, SI2, ERROR=1.0E-6", 1.8 * transit, 360)

    def error(run: Results, _: int) -> float:
        early = plateau(run.time, run["REQUEST/1.F2"], 0.2 * transit, 0.8 * transit)
        middle = plateau(run.time, run["REQUEST/1.F3"], 0.6 * transit, 1.4 * transit)
        return max(abs(pull / (cable.pretension - jump) - 1) for pull in (early, middle))

    return CableScene(draw, error, ("paper", 20))


def transverse_pulse() -> CableScene:
    """x0/(A - U): a pulse runs to the sheave against a payout at a tenth of its speed."""
    cable, length, share = Cable(6.0e7, 5.536, 55360.0), 100.0, 0.1
    stretch, wave = 1 + cable.strain, cable.transverse(cable.strain)
    pulse = moving.Pulse(0.8 * length * stretch, 0.05 * length, 1e-4 * length, wave)
    come = pulse.place / (wave * (1 - share))

    def draw(form: str, n: int) -> str:
        span = Span(form, cable, n, length, 0.2)
        text = span.text("A transverse pulse", "", "MARKER/1, PART=1")
        text += moving.moving_nodes(span, share * wave / stretch, True, pulse)
        text += "REQUEST/1, F2=DY(2,1)/H\n"
        return text + tail("HHT, ERROR=1.0E-6", 1.05 * come, 900)

    def error(run: Results, _: int) -> float:
        # The slope at the sheave changes its sign when the middle of the pulse has come.
        slope = run["REQUEST/1.F2"]
        top = run.time[np.argmax(slope)]
        return arrival(run.time, slope, 0.0, top, run.time[-1]) / come - 1

    return CableScene(draw, error, ("paper", 160))


def taut_string() -> CableScene:
    """T_1 = 2 l/c_t, the period of the slowest transverse vibration of a taut cable."""
    cable, length = Cable(1.0e6, 0.5, 2000.0), 10.0
    period = 2 * length / sqrt(cable.pretension / cable.density * (1 + cable.strain))

    def draw(_: str, n: int) -> str:
        text = head("A taut string", "", "PART/1, GROUND", "MARKER/1, PART=1")
        text += f"MARKER/{n + 1}, PART=1, QP={length:g},0,0\n" + cable_variables(cable)
        free = length / n / (1 + cable.strain)
        text += f"VARIABLE/L_0, FUNCTION={number(free)}\n"
        for k in range(1, n):
            y = 1e-3 * np.sin(pi * k / n)
            text += point(k + 1, cable.density * free, [length * k / n, y])
        text += "".join(section(k, k, k + 1, "L_0") for k in range(1, n + 1))
        return text + tail("GSTIFF, ERROR=1.0E-6", 1.1 * period, 200)

    def error(run: Results, n: int) -> float:
        # A quarter of the period: y goes through zero.
        y = run[f"POINT_MASS/{n // 2 + 1}.y"]
        return 4 * arrival(run.time, y, 0.0, 0.0, run.time[-1]) / period - 1

    return CableScene(draw, error, ("fixed", 24))


def spinning_ring() -> CableScene:
    """T = rho w^2 R^2 in a ring that spins freely."""
    density, spin, radius = 1.384, 200.0, 0.5
    exact = density * (spin * radius) ** 2
    cable = Cable(6.0e7, density, exact)

    def draw(_: str, n: int) -> str:
        text = head("A spinning ring", "", "PART/1, GROUND") + cable_variables(cable)
        # rho is mass per unstretched length: T = rho w^2 R^2 with R the stretched radius.
        free = 2 * pi * radius / n / (1 + cable.strain)
        chord = 2 * radius * np.sin(pi / n)
        text += f"VARIABLE/L_0, FUNCTION={number(chord / (1 + cable.strain))}\n"
        for k in range(n):
            a = 2 * pi * k / n
            place, speed = [np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]
            text += point(
                k + 1, density * free * (1 + cable.strain), [radius * x for x in place],
                [spin * radius * v for v in speed],
            )  # fmt: skip
        text += "".join(section(k + 1, k + 1, (k + 1) % n + 1, "L_0") for k in range(n))
        return text + tail("GSTIFF, ERROR=1.0E-6", 0.1, 200)

    def error(run: Results, _: int) -> float:
        return plateau(run.time, -run["SFORCE/1.f"], 0.0, 0.1) / exact - 1

    return CableScene(draw, error, ("fixed", 40))


def running_out() -> CableScene:
    """(m + rho l) s" = rho l g: a cable hangs over a pulley and pulls itself out."""
    cable, inertia = Cable(6.0e7, 5.536), 30.0

    def draw(form: str, n: int) -> str:
        return payouts.running_deck(Span(form, cable, n, 10.0, 0.2), inertia, 0.5, 50)

    def error(run: Results, n: int) -> float:
        exact = payouts.running_out(Span("ale", cable, n, 10.0), inertia, run.time)[0]
        return (run["REQUEST/1.F2"][-1] - exact[-1]) / exact[-1]

    return CableScene(draw, error, ("paper", 10))


SCENES = {
    "axial step": axial_step(),
    "kink at an anchor": anchored_kink(),
    "kink at a sheave": free_running_kink(),
    "weight lowered at 2 m/s": lowered_weight(2.0, "ale"),
    "weight lowered at 20 m/s": lowered_weight(20.0, "paper"),
    "cable lowered": lowered_cable(),
    "level payout at 30 m/s": level_payout(30.0),
    "step of the payout": payout_step(),
    "transverse pulse": transverse_pulse(),
    "taut string": taut_string(),
    "spinning ring": spinning_ring(),
    "running out": running_out(),
}

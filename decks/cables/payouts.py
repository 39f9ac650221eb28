"""Payout over a sheave: level, hanging, with a weight, and running out by itself.

The cable leaves the sheave (MARKER/1, the origin) along +x or, hanging, along -y. Forms are `paper`
and `ale` of statements.py.
"""

from collections.abc import Iterator

import numpy as np
from formulas import Cable, G, Winch
from pulleys import BEARING, RADIUS, pulley
from scipy.integrate import solve_ivp
from spans import FORMS, Span, table

from adamslite.cables.statements.forms import PULLEY, grown, grown_tip, number, point, tail


def driven(winch: Winch) -> str:
    """The winch turns the pulley."""
    return (
        pulley(100.0) + f"GCON/1, FUNCTION={RADIUS:g}*AZ({PULLEY},{BEARING})\n, -{winch.text}\n\n"
    )


# ---- level payout: P1, P2 --------------------------------------------------------------------


def level_deck(span: Span, winch: Winch, end: float, steps: int) -> str:
    """The tip follows the payout and keeps the pretension."""
    n, stretch = span.sections, 1 + span.cable.strain
    text = span.text(
        f"Level payout up to {winch.speed:g} m/s",
        f"""A winch (PART/{PULLEY}) feeds cable over the sheave along +x; the tip (MARKER/{n + 1})
        goes with it, so that the cable keeps its pretension.""",
        "MARKER/1, PART=1                ! the sheave",
    )
    text += driven(winch)
    for k in range(1, n):
        text += point(k + 1, span.node_mass, [k * stretch * span.length / n])
        text += grown(span.form, k, n, "X")
    text += "\n! The tip.\n" + point(n + 1, 50.0, [stretch * span.length])
    text += f"GCON/2, FUNCTION=DX({n + 1},1)-{number(stretch)}*LT\n"
    text += span.sections_text()
    text += "\n! Pull at the tip less that at the sheave.\n"
    text += f"REQUEST/1, F2=SFORCE({n},0,2)-SFORCE(1,0,2)\n"
    return text + tail("GSTIFF, SI2, ERROR=1.0E-7", end, steps)


def level() -> Iterator[tuple[str, str, str]]:
    """P1, P2: T_tip - T_sheave.

    paper  rho/2 (l s" + s'^2) (N - 1)/N
    ale    rho l s" (N - 1)/N
    """
    sets = {
        "": (Cable(6.0e7, 5.536, 13345.0), 10, 20.0, Winch(30.0, 0.1)),
        "-second": (Cable(2.0e7, 4.0, 25000.0), 20, 30.0, Winch(20.0, 0.15)),
    }
    for form in FORMS:
        for name, (cable, n, length, winch) in sets.items():
            span = Span(form, cable, n, length, 0.2)
            last = 24 * winch.rise
            t = np.linspace(0, last, 121)
            s, rate, acceleration = winch(t)
            # The nodes are (1 + e) as fast as the payout.
            share = (n - 1) / n * (1 + cable.strain)
            inertia = cable.density * (length + s) * acceleration * share
            entering = cable.density * rate**2 * share
            pull = (inertia + entering) / 2 if form == "paper" else inertia
            steady = cable.density * winch.speed**2 * share / 2 if form == "paper" else 0.0
            allowed = "rel 5e-3" if form == "paper" else "abs 0.5"
            lines = [
                "Pull at the tip less that at the sheave, of the element: README.md",
                "written by generate.py",
                f"measure: mean REQUEST/1.F2 from {number(20 * winch.rise)}"
                f" = {number(steady)} tol {allowed}",
                "tolerance REQUEST/1.F2: peak 5e-3",
            ]
            yield (
                f"{form}{name}",
                level_deck(span, winch, last, 480),
                table(["time", "REQUEST/1.F2"], lines, [t, pull]),
            )


# ---- hanging: with and without a weight ------------------------------------------------------


def hanging_deck(span: Span, winch: Winch, weight: float, end: float, steps: int) -> str:
    """A winch lowers a weight, or the cable alone."""
    n, half = span.sections, span.node_mass / 2
    what = f"a weight of {weight:g} kg" if weight else "nothing but the cable"
    text = span.text(
        f"Lowering {what} at {winch.speed:g} m/s",
        f"""A winch (PART/{PULLEY}) pays out cable over the sheave, downwards; MARKER/{n + 1} is the
        lower end. The half section at the sheave hangs on it too: its weight, and what its
        acceleration takes away, is in REQUEST/1.F2, the load on the sheave.""",
        "MARKER/1, PART=1                ! the sheave",
        f"ACCGRAV/JGRAV={number(-G)}",
    )
    text += driven(winch)
    # Equilibrium: the tension in section k carries the weight and the nodes below it.
    carried = [weight + half + (n - k) * span.node_mass for k in range(1, n + 1)]
    places = np.cumsum([span.length / n * (1 + m * G / span.cable.stiffness) for m in carried])
    for k in range(1, n):
        text += point(k + 1, span.node_mass, [0, -places[k - 1]])
        text += grown(span.form, k, n, "Y")
    text += "\n! The lower end.\n" + point(n + 1, weight + half, [0, -places[-1]])
    text += grown_tip(span.form, n + 1, n, "Y")
    text += span.sections_text()
    felt = "JGRAV" if span.form == "paper" else "(JGRAV+SDD)"
    text += (
        "\n! Load on the sheave; payout. Tension at the lower end, its depth.\n"
        f"REQUEST/1, F2=SFORCE(1,0,1)-rho*H/2*{felt}\\ F3=S\n"
        f"REQUEST/2, F2=SFORCE({n},0,1)\\ F3=-DY({n + 1},1)\n"
    )
    return text + tail("GSTIFF, SI2, ERROR=1.0E-7", end, steps)


def hanging_load(span: Span, winch: Winch, weight: float, t: np.ndarray) -> np.ndarray:
    """Closed form of the load on the sheave [N], of the element: (nt,)."""
    s, rate, acceleration = winch(t)
    rho, length, stiffness = span.cable.density, span.length + s, span.cable.stiffness

    def stretch(time: np.ndarray) -> np.ndarray:
        paid, _, a = winch(time)
        free = span.length + paid
        return (weight * free + rho * free**2 / 2) * (G - a) / stiffness

    # The lower end also sinks as the cable, longer and longer, stretches under what it carries.
    h = 1e-2 * winch.rise
    sinking = (stretch(t + h) - 2 * stretch(t) + stretch(t - h)) / h**2
    still = (weight + rho * length) * G - weight * (acceleration + sinking)
    if span.form == "paper":
        return still - rho / 2 * (length * acceleration + rate**2)
    return still - rho * length * acceleration


def hanging_case(sets: dict) -> Iterator[tuple[str, str, str]]:
    """Decks of all sets in both forms."""
    for form in FORMS:
        for name, (cable, n, length, weight, winch) in sets.items():
            span = Span(form, cable, n, length, 0.2)
            end = 20 * winch.rise
            t = np.linspace(0, end, 101)
            load = hanging_load(span, winch, weight, t)
            last = t >= 18 * winch.rise - 1e-9
            mean = np.trapezoid(load[last], t[last]) / (2 * winch.rise)
            entering = cable.density * winch.speed**2
            lines = [
                "Load on the sheave, of the element: README.md",
                "written by generate.py",
                f"measure: mean REQUEST/1.F2 from {number(18 * winch.rise)} = {number(mean)}"
                f" tol abs {number(1e-3 * entering)} rel 1e-5",
                "tolerance REQUEST/1.F2: peak 5e-4",
            ]
            yield (
                f"{form}{name}",
                hanging_deck(span, winch, weight, end, 500),
                table(["time", "REQUEST/1.F2"], lines, [t, load]),
            )


def weight() -> Iterator[tuple[str, str, str]]:
    """A weight on a winch: the element's error is rho/2 (l s" - s'^2)."""
    cable, second = Cable(2.0e7, 4.0), Cable(5.0e7, 6.0)
    return hanging_case(
        {
            "-2": (cable, 20, 20.0, 1000.0, Winch(2.0, 0.6, 5)),
            "-20": (cable, 20, 20.0, 1000.0, Winch(20.0, 0.6, 5)),
            "-second": (second, 30, 30.0, 2500.0, Winch(12.0, 0.5, 5)),
        }
    )


def hanging() -> Iterator[tuple[str, str, str]]:
    """The cable alone."""
    return hanging_case(
        {
            "": (Cable(6.0e7, 5.536), 20, 20.0, 0.0, Winch(10.0, 0.5, 5)),
            "-second": (Cable(2.0e7, 4.0), 30, 40.0, 0.0, Winch(15.0, 0.5, 5)),
        }
    )


#: Of the cable that runs out, relative.
ERROR = 1e-10


# ---- running out by itself -------------------------------------------------------------------


def running_deck(span: Span, inertia: float, end: float, steps: int) -> str:
    """A hanging cable pulls more cable over a light pulley."""
    n = span.sections
    text = span.text(
        "A heavy cable runs out",
        f"""The cable hangs over a pulley of {inertia:g} kg (J/R**2) and pulls more of itself
        over it. The supply moves without tension. At the start nothing is stretched.""",
        "MARKER/1, PART=1                ! the sheave",
        f"ACCGRAV/JGRAV={number(-G)}",
    )
    text += "! Load on the sheave, with the half section there.\n"
    text += "VARIABLE/T, FUNCTION=EA*(DM(1,2)/H-1)-rho*H/2*(JGRAV"
    text += ")\n" if span.form == "paper" else "+SDD)\n"
    text += pulley(inertia)
    text += f"SFORCE/{PULLEY}, ROTATIONAL, ACTIONONLY, I={PULLEY}, J={BEARING}"
    text += f", FUNCTION={RADIUS:g}*T\n\n"
    for k in range(1, n + 1):
        mass = span.node_mass / (1 if k < n else 2)
        text += point(k + 1, mass, [0, -k * span.length / n])
        text += grown(span.form, k, n, "Y") if k < n else ""
    text += grown_tip(span.form, n + 1, n, "Y")
    text += span.sections_text() + "\nREQUEST/1, F2=S\\ F3=SD\n"
    return text + tail("GSTIFF, SI2, ERROR=1.0E-7", end, steps)


def running_out(span: Span, inertia: float, t: np.ndarray) -> np.ndarray:
    """Payout [m] and its speed [m/s]: (2, nt).

    ale    (m + rho l) s" = rho l g
    paper  (m + rho l/2) s" = rho l g - rho/2 s'^2,   m the inertia of the pulley
    """
    rho, share = span.cable.density, 0.5 if span.form == "paper" else 1.0

    def rates(_, y):
        hangs = rho * (span.length + y[0])
        entering = rho * y[1] ** 2 * (1 - share)
        return [y[1], (hangs * G - entering) / (inertia + share * hangs)]

    run = solve_ivp(rates, (0, t[-1]), [0.0, 0.0], t_eval=t, rtol=1e-11, atol=1e-11)
    return run.y


def running() -> Iterator[tuple[str, str, str]]:
    """Late acceleration g (ale) and 2 g/3 (paper)."""
    for form in FORMS:
        for name, (cable, n, length, inertia, end) in {
            "": (Cable(6.0e7, 5.536), 20, 10.0, 30.0, 2.0),
            "-second": (Cable(2.0e7, 4.0), 30, 15.0, 60.0, 2.0),
        }.items():
            span = Span(form, cable, n, length, 0.2)
            t = np.linspace(0, end, 101)
            lines = [
                "Payout and its speed, of the element: README.md",
                "written by generate.py",
                "tolerance: peak 2e-3",
            ]
            yield (
                f"{form}{name}",
                running_deck(span, inertia, end, 400),
                table(
                    ["time", "REQUEST/1.F2", "REQUEST/1.F3"],
                    lines,
                    [t, *running_out(span, inertia, t)],
                    ERROR,
                ),
            )


CASES = {
    "payout-level": level,
    "payout-hanging": hanging,
    "weight-lowered": weight,
    "running-out": running,
}

"""Transverse impact on a deck span: the kink wave, and what it does at the sheave.

Half of a symmetric span: the hook (HEAVY) is at x = -a and moves along y, the sheave is the origin.
"""

from collections.abc import Iterator

from formulas import Cable, Impact
from pulleys import (
    HEAVY,
    RADIUS,
    damped_section,
    damped_variables,
    impedance,
    payout_variables,
    pulley,
    through_the_sheave,
)

from adamslite.cables.statements.forms import (
    PULLEY,
    cable_variables,
    grown,
    head,
    number,
    point,
    section,
    tail,
)

HALF_SPAN = 15.0
REFERENCE = Impact(Cable(6.0e7, 5.536, 13345.0), 65.0)
SECOND = Impact(Cable(4.5e7, 5.536, 25000.0), 75.0)
SETS = {"": REFERENCE, "-second": SECOND}
# Output step [s]; the raw peak of the kink lasts about 1 ms.
PACE = 1e-4


def echo(impact: Impact) -> float:
    """Time from the sheave to the hook and back for an axial wave [s]."""
    return 2 * HALF_SPAN / impact.cable.speed


def end_time(impact: Impact) -> float:
    """Until just before the first axial echo of the kink's arrival [s]."""
    return PACE * round((HALF_SPAN / impact.kink + 0.96 * echo(impact)) / PACE)


def windows(impact: Impact) -> dict[str, float]:
    """Times between which the plateaus before and after the arrival are averaged [s]."""
    come = HALF_SPAN / impact.kink
    shares = {"a": 0.3 * come, "b": 0.9 * come}
    shares |= {"c": come + 0.35 * echo(impact), "d": come + 0.95 * echo(impact)}
    return {key: PACE * round(t / PACE) for key, t in shares.items()}


def measures(impact: Impact, tension: str, arrival: float, plateau: float) -> str:
    """K1 to K4 for a free-running sheave."""
    t1, t2 = impact.tension, impact.free_running
    w = {key: number(value) for key, value in windows(impact).items()}
    come = number(HALF_SPAN / impact.kink)
    return (
        "# T1 behind the impact, arrival of the kink, T2 and raw peak at the sheave: README.md\n"
        "# written by generate.py\n"
        f"# measure: mean {tension} from {w['a']} to {w['b']} = {number(t1)} tol rel 1e-3\n"
        f"# measure: arrival {tension} through {number((t1 + t2) / 2)} from {w['a']}"
        f" = {come} tol rel {arrival:g}\n"
        f"# measure: mean {tension} from {w['c']} to {w['d']} = {number(t2)} tol rel {plateau:g}\n"
        f"# measure: max {tension} = {number(impact.raw_peak)} tol rel 1e-2\n"
    )


def free_length(impact: Impact, sections: int) -> float:
    """That of a section [m]."""
    return HALF_SPAN / sections / (1 + impact.cable.strain)


def growing(form: str, impact: Impact, sections: int, inertia: float | None = None) -> str:
    """The deck span as a variable-length cable; the pulley answers as a long supply does.

    `inertia` is J/R^2 of the pulley [kg]; that of a section unless given.
    """
    cable, free = impact.cable, free_length(impact, sections)
    inertia = cable.density * free if inertia is None else inertia
    text = head(
        f"Transverse impact at {impact.speed:g} m/s, variable-length cable ({form})",
        f"""Half of a symmetric deck span of {sections} sections. The hook
        (MARKER/{sections + 1}) moves on at {impact.speed:g} m/s. The supply behind the
        sheave is a long straight run of the same cable: at the speed v it pulls with T0 +
        rho c v. The pulley has {inertia:.3g} kg (J/R**2).""",
        "",
        "PART/1, GROUND",
        "MARKER/1, PART=1                ! the sheave",
    )
    text += cable_variables(cable)
    text += payout_variables(cable, sections, free * sections)
    text += "! Tension at the sheave.\nVARIABLE/T, FUNCTION=EA*(DM(1,2)/H-1)\n"
    text += pulley(inertia)
    text += (
        f"SFORCE/{PULLEY}, ROTATIONAL, ACTIONONLY, I={PULLEY}, J={PULLEY + 1}\n"
        f", FUNCTION={RADIUS:g}*(T-{number(cable.pretension)}-SQRT(EA*rho)*SD*DM(1,2)/H)\n\n"
    )
    for k in range(1, sections):
        text += point(k + 1, cable.density * free, [-k * HALF_SPAN / sections])
        text += grown(form, k, sections)
    text += "\n! The hook.\n" + point(sections + 1, HEAVY, [-HALF_SPAN], [0, impact.speed]) + "\n"
    text += "".join(section(k, k, k + 1, "H") for k in range(1, sections + 1))
    text += "\n! Tension at the sheave, payout, its speed.\nREQUEST/1, F2=T\\ F3=S\\ F4=SD\n"
    end = end_time(impact)
    return text + tail("HHT, ERROR=1.0E-6", end, round(end / PACE))


def brute_force(impact: Impact, sections: int, supply: int, passing: int) -> str:
    """Sections of fixed length, `supply` of them behind the sheave, `passing` of which may pass."""
    cable, free, n = impact.cable, free_length(impact, sections), sections + supply
    text = head(
        f"Transverse impact at {impact.speed:g} m/s, brute force",
        f"""Half of a symmetric deck span of {sections} sections, and {supply} sections laid out
        behind the sheave, a point at the origin that the cable slips through. The hook is
        MARKER/2 and moves on at {impact.speed:g} m/s. The tension at the sheave is what
        MARKER/9003 carries.""",
        "",
        "PART/1, GROUND",
        "MARKER/1, PART=1                ! the sheave, seen from the deck",
        "MARKER/9003, PART=1             ! the sheave, seen from the supply",
    )
    text += cable_variables(cable) + f"VARIABLE/L_0, FUNCTION={number(free)}\n\n"
    text += point(2, HEAVY, [-HALF_SPAN], [0, impact.speed])
    for k in range(1, n + 1):
        mass = cable.density * free / (1 if k < n else 2)
        # A micrometre off, so that no mass starts in the sheave itself.
        text += point(k + 2, mass, [(k - sections) * HALF_SPAN / sections + 1e-6])
    text += "\n"
    for k in range(1, n + 1):
        near = sections - 1 <= k <= sections + passing
        text += (
            through_the_sheave(k, k + 1, k + 2, 9003) if near else section(k, k + 1, k + 2, "L_0")
        )
    text += impedance(9004, n + 2, cable)
    text += (
        "\n! Tension at the sheave and at the hook.\nREQUEST/1, F2=FX(9003)\\ F3=SFORCE(1,0,1)\n"
    )
    end = end_time(impact)
    return text + tail("VERLET, ERROR=1.0E-3", end, round(end / PACE))


def free_running() -> Iterator[tuple[str, str, str]]:
    """K1 to K4 with the ALE element, and by brute force."""
    for name, impact in SETS.items():
        reference = measures(impact, "REQUEST/1.F2", 5e-3, 3e-3)
        yield f"ale{name}", growing("ale", impact, 240), reference
        yield f"brute-force{name}", brute_force(impact, 240, 60, 40), reference


def anchored_cable(impact: Impact, length: float, sections: int, damping: float) -> str:
    """An oblique cable that moves across the deck; its lower end is arrested."""
    cable = impact.cable
    free = length / sections / (1 + impact.strain)
    cosine = (1 - impact.sine**2) ** 0.5
    text = head(
        f"An oblique cable at {impact.speed:g} m/s, its end arrested",
        f"""The cable behind a kink, straight and under T1, moves across the deck at
        {impact.speed:g} m/s. At TIME = 0 its end at the origin is stopped: the kink has
        come to an anchored sheave. {sections} sections on {length:g} m; zeta = {damping:g}
        takes the ringing of single sections away.""",
        "",
        "PART/1, GROUND",
        "MARKER/1, PART=1                ! the anchor",
    )
    text += damped_variables(cable, damping) + f"VARIABLE/L_0, FUNCTION={number(free)}\n\n"
    for k in range(1, sections + 1):
        s, mass = k * length / sections, cable.density * free if k < sections else HEAVY
        text += point(k + 1, mass, [-s * cosine, s * impact.sine], [0, impact.speed])
    rows = (damped_section(k, k, k + 1, "L_0", damping) for k in range(1, sections + 1))
    text += "\n" + "".join(rows)
    text += (
        "\n! Tension at the anchor and half way.\n"
        f"REQUEST/1, F2=SFORCE(1,0,1)\\ F3=SFORCE({sections // 2},0,1)\n"
    )
    end = PACE * int(1.98 * length / cable.speed / PACE)
    return text + tail("VERLET, ERROR=1.0E-3", end, round(end / PACE))


def anchored() -> Iterator[tuple[str, str, str]]:
    """K5."""
    length, sections = 60.0, 480
    for name, impact in SETS.items():
        transit = length / impact.cable.speed
        start, stop = (PACE * round(share * transit / PACE) for share in (0.3, 1.9))
        yield (
            f"anchored{name}",
            anchored_cable(impact, length, sections, 0.2),
            "# T2 where the kink meets an anchor: README.md\n# written by generate.py\n"
            f"# measure: mean REQUEST/1.F2 from {number(start)} to {number(stop)}"
            f" = {number(impact.anchored)} tol rel 1e-3\n",
        )


CASES = {"kink-free-running": free_running, "kink-anchored": anchored}

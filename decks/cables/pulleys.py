"""What decks of a cable on a pulley hold besides what the statements of a description have."""

from adamslite.cables.description.components import Cable
from adamslite.cables.statements.forms import (
    ONLY,
    PULLEY,
    Side,
    cable_variables,
    length_variables,
    number,
    section,
)

BEARING = PULLEY + 1
RADIUS = 0.5
# "The impact speed is constant": the hook is a mass that no cable slows down.
HEAVY = 1e9


def damped_variables(cable: Cable, damping: float) -> str:
    """Names for EA, rho and the damper of a section, a share of its critical damping."""
    damper = f"VARIABLE/damper, FUNCTION=2*{damping:g}*SQRT(EA*rho)\n" if damping else ""
    return cable_variables(cable) + damper


def damped_section(s: int, i: int, j: int, free: str, damping: float) -> str:
    """SFORCE/s as :func:`section`, with the damper beside it."""
    grows = f"-SD{free[1:]}*DM({i},{j})/LT{free[1:]}" if free[0] == "H" else ""
    damper = f"-damper*(VR({i},{j}){grows})\n" if damping else "\n"
    return section(s, i, j, free)[:-1] + damper


def impedance(s: int, i: int, cable: Cable, side: int = 1) -> str:
    """The pull of a long straight run on MARKER/i, along +x (`side` 1) or -x (-1)."""
    return (
        "! A long run goes on from here: it pulls with T0 + rho c v, v the speed away from it\n"
        "! (z of the marker is x).\n"
        f"MARKER/{s}, PART=1, REULER=90D,90D,0D\n"
        f"SFORCE/{s}, ACTIONONLY, I={i}, J={s}"
        f", FUNCTION={number(side * cable.pretension)}-SQRT(EA*rho)*VX({i})\n"
    )


def through_the_sheave(s: int, i: int, j: int, supply: int, sheave: int = 1) -> str:
    """A section that may lie over the sheave, a point: the origin, or MARKER/`sheave`, x along it.

    SFORCE/s while both ends are on one side; else SFORCE/s+10000 and s+20000 pull both towards the
    sheave with one tension. MARKER/`supply` takes the pull of the supply.
    """
    near, seen = ("", "") if sheave == 1 else (f",{sheave}", f",{sheave},{sheave}")
    over = f"IF(DX({i}{seen})*DX({j}{seen}):"
    pull = f"-EA*((DM({i}{near})+DM({j}{near}))/L_0-1)"
    return (
        f"SFORCE/{s}, I={i}, J={j}, FUNCTION={over} 0,0,-EA*(DM({i},{j})/L_0-1))\n"
        f"SFORCE/{s + 10000}, I={i}, J={sheave}, FUNCTION={over} {pull},0,0)\n"
        f"SFORCE/{s + 20000}, I={j}, J={supply}, FUNCTION={over} {pull},0,0)\n"
    )


def payout_variables(
    cable: Cable, sections: int, length: float, side: Side = ONLY, radius: float = RADIUS
) -> str:
    """Payout S and its rates from the pulley; length LT, H of a section; mass Dm of a node.

    A pulley that turns negatively when it pays out has a negative radius here.
    """
    wheel, bearing = side.pulley, side.pulley + 1
    # Rates are taken along the bearing's axis and, where that turns, as seen from there.
    seen = f",{bearing}" if side.carried else ""
    turn, spin = f"AZ({wheel},{bearing})", f"WZ({wheel},{bearing}{seen})"
    calls = turn, spin, f"WDTZ({wheel},{bearing}{seen * 2})"
    ways = [f"{radius:.11g}*{call}" for call in calls]
    return length_variables(side.name, sections, length, ways)


def pulley(inertia: float, speed: float = 0.0, at: float = 0.0, side: Side = ONLY) -> str:
    """A pulley of `inertia` = J/R^2 [kg] above the sheave at x = `at`, turning at speed/R."""
    i, spin = side.pulley, f", WZ={number(speed / RADIUS)}" if speed else ""
    axial, x = number(inertia * RADIUS**2), number(at)
    return (
        f"\nMARKER/{i + 1}, PART=1, QP={x},{number(RADIUS)},0\n"
        f"PART/{i}, MASS={number(inertia)}, CM={i}, IP={axial},{axial},{axial}"
        f", QG={x},{number(RADIUS)},0{spin}\n"
        f"MARKER/{i}, PART={i}\n"
        f"JOINT/{i}, REVOLUTE, I={i}, J={i + 1}\n"
    )

"""How much model a cable scene needs for a wanted accuracy p.

l length of a span, T its tension, c = sqrt(EA/rho), c_t = sqrt(T/rho), s payout, tau = max s'/max
s" the time scale on which it changes.

    waves matter            (l/c)/tau > p, an end starts across the cable, a speed starts at once
    the paper's element     s'/(2 c_t) < p,  rho |l s" + s'^2|/2 < p T,  (l/c)/tau < p
    sections: kinks         N >= 7 c/U, U the speed of the kink
    sections: slow motion   (pi/(2 N))**2/6 < p for the slowest wave,
                            rho l/(2 N) < p of all that is moved
"""

from dataclasses import dataclass
from math import ceil, inf, pi, sqrt

from adamslite.cables.estimate import Travel, moving_mass
from adamslite.cables.geometry import Span, dot
from adamslite.cables.messages import Faults
from adamslite.cables.spec import Cable, Spec

MOST = 900


@dataclass(frozen=True)
class Choice:
    """Level, form of level 3 and sections of a span, and the figures they rest on."""

    level: int
    form: str
    elements: int
    figures: tuple[str, ...]


def tensions(spec: Spec, spans: list[Span]) -> list[float]:
    """Of every span at rest, at its lower or free end [N]: what hangs there, or the pretension."""
    first, last = spec.route[0], spec.route[-1]
    down = -dot(spec.gravity, spans[0].along), dot(spec.gravity, spans[-1].along)
    ends = [first.mass * max(0.0, down[0]), last.mass * max(0.0, down[1])]
    carried = [ends[0], *[sum(ends) / 2] * (len(spans) - 2), ends[1]]
    if len(spans) == 1:
        carried = [max(ends)]
    return [max(each, spec.cable.pretension) for each in carried]


def kink(cable: Cable, speed: float) -> float:
    """Speed U of the kink behind an impact across the cable [m/s].

    V**2/c**2 = 2 (e - e0) sqrt(e (1 + e)) - (e - e0)**2,  U = c sqrt(e (1 + e)) - c (e - e0)
    """
    e0, c = cable.pretension / cable.stiffness, cable.speed
    low, high = e0, 1.0
    for _ in range(100):
        e = (low + high) / 2
        reached = 2 * (e - e0) * sqrt(e * (1 + e)) - (e - e0) ** 2
        low, high = (e, high) if reached < (speed / c) ** 2 else (low, e)
    return c * sqrt(e * (1 + e)) - c * (e - e0)


def choose(spec: Spec, spans: list[Span], moves: Travel, faults: Faults) -> Choice:
    """The model the description asks for, or what `accuracy` needs."""
    cable, p = spec.cable, spec.accuracy
    longest = max(span.length for span in spans)
    tension = max(min(tensions(spec, spans)), 1e-12)
    transit = longest / cable.speed
    tau = moves.speed / moves.acceleration if moves.acceleration else inf
    rushes = transit / tau
    sudden = cable.density * cable.speed * moves.jump / tension
    waves = moves.across > 0 or rushes > p or sudden > p or not moves.known
    figures = [
        f"axial waves {cable.speed:.4g} m/s, transit of the longest span {1e3 * transit:.3g} ms",
        f"transverse waves {sqrt(tension / cable.density):.4g} m/s at {tension:.4g} N",
        f"payout {moves.least:.4g} to {moves.most:.4g} m, up to {moves.speed:.4g} m/s"
        if moves.known else "the payout is not known before the run",
        f"transit/time scale {rushes:.2g}" if moves.acceleration else "nothing changes its speed",
    ]  # fmt: skip
    if moves.across:
        figures.append(f"an end starts across the cable at {moves.across:.4g} m/s")
    if moves.jump:
        figures.append(f"a speed of {moves.jump:.4g} m/s starts at once")
    level = spec.level or _level(spec, longest, tension, moves, waves)
    if level == 1 and waves:
        faults.add("rigid-has-waves", ("model", "level"), figures="; ".join(figures),
                   level=_level(spec, longest, tension, moves, True))  # fmt: skip
    form = spec.form
    bad = _paper_fails(spec, longest, tension, moves, rushes)
    if form == "auto":
        form = "ale" if bad else "paper"
    elif form == "paper" and level == 3 and bad:
        faults.add("paper-not-valid", ("model", "form"), accuracy=p, figures="; ".join(bad))
    return Choice(level, form, spec.elements or _elements(spec, longest, moves), tuple(figures))


def _level(spec: Spec, longest: float, tension: float, moves: Travel, waves: bool) -> int:
    cable, p = spec.cable, spec.accuracy
    weight = cable.density * longest / max(moving_mass(spec), 1e-12)
    stretch = tension / cable.stiffness
    holds = any(each.is_wheel for each in spec.route)
    if holds and not waves and weight < p and stretch < p:
        return 1
    return 3 if holds and moves.way > 0 or not moves.known else 2


def _paper_fails(
    spec: Spec, longest: float, tension: float, moves: Travel, rushes: float
) -> list[str]:
    """The estimates that speak against the paper's element."""
    rho, p = spec.cable.density, spec.accuracy
    figures = {
        "s'/(2 c_t)": moves.speed / (2 * sqrt(tension / rho)),
        "rho (l s\" + s'^2)/(2 T)": rho
        * ((longest + max(moves.most, 0.0)) * moves.acceleration + moves.speed**2)
        / (2 * tension),
        "(l/c)/tau": rushes,
    }
    found = [f"{name} = {value:.2g}" for name, value in figures.items() if value >= p]
    return found if moves.known else [*found, "the payout is not known before the run"]


def _elements(spec: Spec, longest: float, moves: Travel) -> int:
    p, cable = spec.accuracy, spec.cable
    share = cable.density * (longest + max(moves.most, 0.0))
    needed = [4, pi / (2 * sqrt(6 * p)), share / (share + moving_mass(spec)) / (2 * p)]
    if moves.across:
        needed.append(7 * cable.speed / kink(cable, moves.across))
    return min(ceil(max(needed)), MOST)

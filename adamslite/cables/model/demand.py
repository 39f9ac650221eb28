"""The demands on one span of cable, and the estimates of the model that they require.

l length, T tension, c = sqrt(EA/rho) axial and c_t = sqrt(T/rho) transverse wave, s payout, tau =
max s'/max s" the time in which it changes, M what the span carries or moves, H = l/N a section.

For an error p of tensions and of the times at which waves arrive:

    waves matter         (l/c)/tau > p;  a speed starts at once with rho c v > p T
    rigid, massless      no waves,  rho l < p M,  T < p EA,  sqrt((M + rho l/3) l/EA)/tau < p
    the paper's element  s'/(2 c_t) < p unless all moves along one line,
                         rho (l s" + s'^2)/2 < p T,  (l/c)/tau < p
    sections             transverse wave           (k H)^2/24 < q, k its number, at least pi/l
                         half a section at an end  rho l (g + s")/(2 N - 2) < q of T at that end
                         axial front               N > 42 (0.01/p)^0.55
                         kink                      N > 7 c/U (0.01/p)^(2/3), U its speed

q = 0.9 p, for the integrator adds its own error: up to 0.024 p was measured in the scenes of the
tests, at the ERROR of the advice. The factors 42 and 7 were measured with it.

Sources: sections from the discrete spectrum w_k = (2 c/H) sin(k pi/2N). Behind a kink that has
come the way l through sections, its jump ripples as the integral of Airy's function does,
x^(-3/4) sin(2/3 x^(3/2) + pi/4)/sqrt(pi) at x = U t/((H/2) (l/H)^(1/3)), x ~ N^(2/3): its mean
from one time to another is off by x^(-5/4)/(x2 - x1) ~ N^(-3/2). The factors are measured, see
docs/background/cables.md.
"""

from dataclasses import dataclass, field
from math import ceil, inf, pi, sqrt

from adamslite.cables.description.vocabulary import MOST_SECTIONS
from adamslite.cables.model.response import Errors, Machine, errors, worst

FEWEST = 4
# Sections of an axial front, and of a kink by c/U, for the accuracy at which they were measured.
AXIAL = 42
KINK = 7
MEASURED_AT = 0.01
# Power of the accuracy with which the sections of a front grow.
AXIAL_POWER = 0.55
# Of the accuracy: what waves may make of a tension where nobody sees them; sections whose own
# vibrations are so fast that a method which follows them takes small steps all the same.
CALM, FEW = 0.3, 12
# Of the transverse wave: a weight that starts across faster bends its cable by large angles.
SMALL_SLOPE = 0.3
# Keeps quotients finite where nothing pulls or hangs [N, kg].
NEGLIGIBLE = 1e-12
# Of the accuracy: what sections may use, the rest is the integrator's; the same of the linear
# model, which knows one length of the cable and small slopes.
SECTIONS_SHARE = 0.9
LINEAR_SHARE = 0.65


@dataclass(frozen=True)
class Demand:
    """A span and what happens to it, in coherent units.

    Parameters
    ----------
    stiffness, density : float
        EA [force] and rho [mass/length] of the unstretched cable.
    length : float
        Free length at the start.
    tension : float
        Mean over the span of what it carries; not of a moment of slackness.
    struck : float
        Tension at the end where a weight starts across it; `tension` where it is 0.
    moved : float
        Mass that hangs on the span or that it drives.
    pull : float
        Acceleration of gravity along the span.
    least, most, speed, acceleration : float
        Payout over the run and the greatest of its rates; `known` is false where only the run can
        tell.
    jump, across : float
        Speeds that start at once, along and across the cable.
    along : float
        Speed at which a weight starts along a cable that is held.
    straight : bool
        Everything lies and moves along one line.
    wave : float
        Wave number of transverse motion at the start [1/free length], 0 when not known.
    bounces : bool
        It starts out of balance with what it carries.
    tied : bool
        Constraints, turning parts, states or forces of accelerations are about: no VERLET.
    slackens : bool
        It pulls only: where it has gone slack it becomes taut with a front.
    rubs : bool
        Friction holds it on a wheel, or lets it slide.
    half_read : bool
        Tensions are read in the middle of its outer sections, half a section from its ends.
    end : float
        Time of the run, 0 when it is not given.
    results : int
        Times at which results are asked for; a run takes a step for each.
    asked : tuple of str
        What the accuracy is for: tension, position, arrival (of waves).
    machines : tuple of Machine
        The linear model of the scene, with the lengths of spans that it has at the start and after
        its largest payout; empty where there is none.
    """

    stiffness: float
    density: float
    length: float
    tension: float
    moved: float = 0.0
    struck: float = 0.0
    pull: float = 0.0
    least: float = 0.0
    most: float = 0.0
    speed: float = 0.0
    acceleration: float = 0.0
    known: bool = True
    jump: float = 0.0
    across: float = 0.0
    along: float = 0.0
    straight: bool = False
    wave: float = 0.0
    bounces: bool = False
    tied: bool = False
    slackens: bool = False
    rubs: bool = False
    half_read: bool = False
    end: float = 0.0
    results: int = 0
    asked: tuple[str, ...] = ("tension", "position")
    given: int = 0
    machines: tuple[Machine, ...] = field(default=(), compare=False)

    def left(self, p: float) -> Errors | None:
        """What models leave out by the linear model; None without one."""
        found = [errors(each, LINEAR_SHARE * p, self.asked, self.given) for each in self.machines]
        return worst(found) if found else None

    @property
    def c(self) -> float:
        """Axial wave."""
        return sqrt(self.stiffness / self.density)

    @property
    def c_t(self) -> float:
        """Transverse wave."""
        return sqrt(max(self.tension, 0.0) / self.density)

    @property
    def struck_wave(self) -> float:
        """Transverse wave where a weight starts across."""
        return sqrt((self.struck or max(self.tension, 0.0)) / self.density)

    @property
    def longest(self) -> float:
        """Length with all that is paid out."""
        return self.length + max(self.most, 0.0)

    @property
    def way(self) -> float:
        """Cable that comes and goes."""
        return self.most - self.least

    @property
    def transit(self) -> float:
        """Time of the axial wave along the span at the start."""
        return self.length / self.c

    @property
    def rushes(self) -> float:
        """(l/c)/tau."""
        return self.transit * self.acceleration / self.speed if self.speed else 0.0

    @property
    def validity(self) -> dict[str, float]:
        """Errors of the paper's element, by the name of their estimate."""
        carried = max(self.tension, NEGLIGIBLE)
        found = {
            "s'/(2 c_t)": self.speed / (2 * sqrt(carried / self.density)),
            "rho (l s\" + s'^2)/(2 T)": self.density
            * (self.longest * self.acceleration + self.speed**2)
            / (2 * carried),
            "(l/c)/tau": self.rushes,
        }
        if self.jump and self.way > 0:
            found["rho c s'(0)/T"] = self.density * self.c * self.jump / carried
        if self.straight:
            del found["s'/(2 c_t)"]
        return found


def kink_speed(stiffness: float, density: float, tension: float, across: float) -> float:
    """Speed U of the kink behind an impact across a cable under `tension`.

    V**2/c**2 = 2 (e - e0) sqrt(e (1 + e)) - (e - e0)**2,  U = c sqrt(e (1 + e)) - c (e - e0)
    """
    e, e0, c = _struck(stiffness, density, tension, across)
    return c * sqrt(e * (1 + e)) - c * (e - e0)


def _struck(
    stiffness: float, density: float, tension: float, across: float
) -> tuple[float, float, float]:
    """Strains behind and before the front of an impact across, and c."""
    e0, c = tension / stiffness, sqrt(stiffness / density)
    low, high = e0, 1.0
    for _ in range(100):
        e = (low + high) / 2
        reached = 2 * (e - e0) * sqrt(e * (1 + e)) - (e - e0) ** 2
        low, high = (e, high) if reached < (across / c) ** 2 else (low, e)
    return e, e0, c


def loaded(of: Demand) -> float:
    """Tension behind the fronts that the start sends out."""
    tension = of.tension + of.density * of.c * of.jump
    if of.across:
        tension = max(
            tension, of.stiffness * _struck(of.stiffness, of.density, of.tension, of.across)[0]
        )
    return tension


def is_lively(of: Demand, p: float) -> bool:
    """Whether waves run through the cable that make a share of `p` of its tension."""
    left = of.left(p)
    if left is None:
        return bool(fronts(of, p))
    count = elements(of, p)
    return count > 1 and left.ringing > CALM * p or count > FEW


def fronts(of: Demand, p: float) -> list[str]:
    """What sends fronts through the cable."""
    found = [f"a weight starts across it at {of.across:.4g} m/s"] if of.across > 0 else []
    if of.density * of.c * of.jump > p * of.tension:
        found.append(f"a speed of {of.jump:.4g} m/s starts at once")
    if of.density * of.c * of.along > p * of.tension:
        found.append(f"a weight starts along its held cable at {of.along:.4g} m/s")
    return found


def waves(of: Demand, p: float) -> list[str]:
    """Why the time that waves take matters."""
    found = fronts(of, p)
    if of.machines and "arrival" not in of.asked:
        return []
    if of.rushes > p:
        found.append(f"(l/c)/tau = {of.rushes:.2g}")
    return found if of.known else [*found, "the payout is not known before the run"]


def paper_fails(of: Demand, p: float) -> list[str]:
    """The estimates that speak against the paper's element."""
    found = [f"{name} = {value:.2g}" for name, value in of.validity.items() if value >= p]
    return found if of.known else [*found, "the payout is not known before the run"]


def form(of: Demand, p: float) -> str:
    """The variable-length element that is good enough."""
    return "ale" if paper_fails(of, p) else "paper"


def elastic_level(of: Demand) -> int:
    """The level of an elastic cable: 3 when some is paid out."""
    return 3 if of.way > 0 or not of.known else 2


def level(of: Demand, p: float) -> int:
    """1 rigid and massless, 2 sections of fixed length, 3 of variable length."""
    return elastic_level(of) if rigid_fails(of, p) else 1


def rigid_fails(of: Demand, p: float) -> list[str]:
    """What speaks against a rigid cable without mass."""
    left = of.left(p)
    if left is not None:
        found = waves(of, p)
        if of.tension / of.stiffness >= p:
            found.append(f"T/EA = {of.tension / of.stiffness:.2g}")
        if left.rigid == inf:
            found.append("its ends keep a rigid cable from moving")
        elif left.rigid >= LINEAR_SHARE * p:
            found += fronts(of, p)
            found.append(f"tensions or places of a rigid cable are {left.rigid:.2g} off")
        return found
    weight = of.density * of.longest
    swings = sqrt((of.moved + weight / 3) * of.longest / of.stiffness)
    figures = {
        "rho l/M": weight / max(of.moved, NEGLIGIBLE),
        "T/EA": of.tension / of.stiffness,
        "sqrt((M + rho l/3) l/EA)/tau": swings * of.acceleration / of.speed if of.speed else 0.0,
    }
    found = waves(of, p) + ["it starts out of balance"] * of.bounces
    return found + [f"{name} = {value:.2g}" for name, value in figures.items() if value >= p]


def elements(of: Demand, p: float) -> int:
    """Sections of a span."""
    return min(ceil(max(needed(of, p).values())), MOST_SECTIONS)


def needed(of: Demand, p: float) -> dict[str, float]:
    """Sections of a span that each rule requires."""
    q = SECTIONS_SHARE * p
    left = of.left(p)
    if left is not None:
        found = {"for tensions and places": left.sections(LINEAR_SHARE * p)}
        if of.slackens and left.lowest < 0:
            found["for fronts where it becomes taut"] = AXIAL * (MEASURED_AT / p) ** AXIAL_POWER
        if "arrival" in of.asked:
            found |= _arrivals(of, p)
        return found | (_halves(of, q) if of.half_read else {})
    found = {"at least": FEWEST, **_halves(of, q)}
    if not of.straight:
        found["for transverse waves"] = max(pi, of.wave * of.length) / sqrt(24 * q)
    return found | _arrivals(of, p)


def _halves(of: Demand, q: float) -> dict[str, float]:
    """Sections half of which weighs, at an end, less than a share of the tension there."""
    load = of.density * of.longest * (of.pull + of.acceleration)
    top = of.tension + load - of.density * of.length * of.pull / 2
    return {"for half a section at an end": load / max(top, load, NEGLIGIBLE) / (2 * q) + 1}


def _arrivals(of: Demand, p: float) -> dict[str, float]:
    """Sections in which fronts arrive when they should."""
    finer, found = MEASURED_AT / p, {}
    if of.jump or of.along or not of.known:
        found["for axial fronts"] = AXIAL * finer**AXIAL_POWER
    if of.across:
        kink = kink_speed(of.stiffness, of.density, of.struck or of.tension, of.across)
        found["for a kink, 7 c/U"] = KINK * of.c / kink * finer ** (2 / 3)
    return found

"""The model a description asks for, or what its wanted accuracy needs by the estimates of
:mod:`adamslite.cables.demand`.
"""

from dataclasses import dataclass

from adamslite.cables import demand
from adamslite.cables.demand import Demand
from adamslite.cables.estimate import Travel, moving_mass
from adamslite.cables.geometry import Span, dot
from adamslite.cables.messages import Faults
from adamslite.cables.spec import Spec


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


def choose(spec: Spec, spans: list[Span], moves: Travel, faults: Faults) -> Choice:
    """The model the description asks for, or what `accuracy` needs."""
    p, of = spec.accuracy, _demand(spec, spans, moves)
    figures = _figures(of)
    level = spec.level or demand.level(of, p)
    if level == 1 and demand.has_waves(of, p):
        faults.add("rigid-has-waves", ("model", "level"), figures="; ".join(figures),
                   level=demand.elastic_level(of))  # fmt: skip
    form = demand.form(of, p) if spec.form == "auto" else spec.form
    bad = demand.paper_fails(of, p)
    if spec.form == "paper" and level == 3 and bad:
        faults.add("paper-not-valid", ("model", "form"), accuracy=p, figures="; ".join(bad))
    return Choice(level, form, spec.elements or demand.elements(of, p), tuple(figures))


def _demand(spec: Spec, spans: list[Span], moves: Travel) -> Demand:
    """What the longest span is asked for; it lies on its line unless something strikes it."""
    cable = spec.cable
    longest = max(spans, key=lambda span: span.length)
    weight = max(abs(dot(spec.gravity, span.along)) for span in spans)
    return Demand(
        stiffness=cable.stiffness, density=cable.density, length=longest.length,
        tension=min(tensions(spec, spans)) + cable.density * longest.length * weight / 2,
        moved=moving_mass(spec), pull=weight, least=moves.least, most=moves.most,
        speed=moves.speed, acceleration=moves.acceleration, known=moves.known, jump=moves.jump,
        across=moves.across, straight=not moves.across, end=spec.end,
        tied=any(each.is_wheel or each.kind == "body" for each in spec.route),
    )  # fmt: skip


def _figures(of: Demand) -> list[str]:
    figures = [
        f"axial waves {of.c:.4g} m/s, transit of the longest span {1e3 * of.transit:.3g} ms",
        f"transverse waves {of.c_t:.4g} m/s at {of.tension:.4g} N",
        f"payout {of.least:.4g} to {of.most:.4g} m, up to {of.speed:.4g} m/s"
        if of.known else "the payout is not known before the run",
        f"transit/time scale {of.rushes:.2g}" if of.acceleration else "nothing changes its speed",
    ]  # fmt: skip
    if of.across:
        figures.append(f"an end starts across the cable at {of.across:.4g} m/s")
    if of.jump:
        figures.append(f"a speed of {of.jump:.4g} m/s starts at once")
    return figures

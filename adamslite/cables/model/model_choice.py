"""The choice of the model of a description: level, form, sections, integrator, and the reasons.

The estimates are those of :mod:`adamslite.cables.model.demand`.

Sections that run over a rim of radius R need (h/R)**2/24 < p/50 besides: the payout of a drum with
h = R/10, R/14, R/20 and R/28 swings by 1.5, 0.9, 0.25 and 0.12 % of the tension.
"""

from dataclasses import dataclass, replace
from math import ceil, sqrt

from adamslite.cables.description.components import Cable
from adamslite.cables.description.messages import Faults
from adamslite.cables.description.vocabulary import MOST_SECTIONS, Spec
from adamslite.cables.layout.brute_force_layout import stretches
from adamslite.cables.layout.geometry import FreeSpan, reaches, wrap
from adamslite.cables.model import bending_advice, demand
from adamslite.cables.model.advice import error_bound, integrator
from adamslite.cables.model.demand import Demand
from adamslite.cables.model.estimate import Laws, Moves, moving_mass
from adamslite.cables.model.machine import machine
from adamslite.cables.model.response import Errors, Machine, is_usable
from adamslite.cables.vectors import AXES, ZERO, add, dot, part_across, unit

# Of the cosine of two directions that are one.
ROUND_OFF = 1e-9
# Sections shorten an arc by (h/R)^2/24 of it: at most this share of the accuracy.
RIM_SHARE = 0.02
# A node sinks h^2/(SUNK R) into a rim: a tenth of the height of the arc over a section.
SUNK = 80
# ERROR of a rigid cable, as a share of its length.
RIGID_ERROR = 1e-7
# Of the length of a span: changes by less make no difference; it keeps so much at least.
GROWN, SHORTEST = 0.1, 0.05
# Of the least load: tensions that fall below zero by less need not.
SLACK = 0.1
# An arc that is long enough to have to be round [rad].
LIES = 0.1


@dataclass(frozen=True)
class Reasons:
    """Why this level, form, number of sections, method and ERROR; `more` is anything else."""

    level: tuple[str, ...]
    form: tuple[str, ...]
    elements: tuple[str, ...]
    method: str
    error: str
    more: tuple[str, ...] = ()

    @property
    def sentences(self) -> tuple[str, ...]:
        """All of them in the order in which they are reported."""
        followed = f"{self.method}; ERROR {self.error}"
        return (*self.level, *self.form, *self.elements, followed, *self.more)


@dataclass(frozen=True)
class CableModel:
    """Level, form of level 3, sections of the longest span, method and ERROR; the figures and
    reasons they rest on.

    `slackens` is the tension below zero that the linear model foresees [N].
    """

    level: int
    form: str
    elements: int
    method: str
    error: float
    figures: tuple[str, ...]
    reasons: Reasons
    slackens: float = 0.0

    @property
    def integrator(self) -> str:
        """The INTEGRATOR statement after its keyword."""
        return f"{self.method}, ERROR={self.error:.1E}"


def tensions(spec: Spec, spans: list[FreeSpan]) -> list[float]:
    """Of every span at rest, at its lower or free end [N]: what hangs there, or the pretension."""
    first, last = spec.route[0], spec.route[-1]
    if spec.closed:
        return [max(spec.cable.pretension, spec.cable.running(spec.speed))] * len(spans)
    down = -dot(spec.gravity, spans[0].along), dot(spec.gravity, spans[-1].along)
    ends = [first.mass * max(0.0, down[0]), last.mass * max(0.0, down[1])]
    # Free wheels pass a tension on; an end without weight takes what the other, or a block, needs.
    blocks = [_block(spec, spans, i) for i, each in enumerate(spec.route)
              if each.is_carried or each.slides]  # fmt: skip
    ends[0] = ends[0] or ends[1] or max(blocks, default=0.0)
    ends[1] = ends[1] or ends[0]
    carried = [ends[0], *[sum(ends) / 2] * (len(spans) - 2), ends[1]]
    if len(spans) == 1:
        carried = [max(ends)]
    return [max(each, spec.cable.pretension) for each in carried]


def _block(spec: Spec, spans: list[FreeSpan], i: int) -> float:
    """Tension that holds the wheel or weight of station i, which is free to move, against gravity,
    with half of the cable beside a weight [N]."""
    pull, mass = ZERO, 0.0
    for j in spec.on_block(i):
        before, behind = (spans[p] for p in spec.beside(j))
        pull, each = add(pull, add(behind.along, before.along, -1)), spec.route[j]
        # What the mass of a carriage adds to.
        mass += each.mass + (each.inertia / each.radius**2 if each.is_wheel else 0.0)
    size = dot(pull, pull)
    if spec.route[i].slides:
        mass += spec.cable.density * (before.length + behind.length) / 2
    if spec.route[i].haul:
        along = unit(add(behind.finish, before.start, -1))
        pull = part_across(pull, along)
        size = dot(pull, pull)
    return max(0.0, -mass * dot(spec.gravity, pull) / size) if size else 0.0


def needs_brute(spec: Spec, spans: list[FreeSpan]) -> list[str]:
    """What only sections that run over the rims can show."""
    if not any(each.is_wheel for each in spec.route):
        return []
    found = ["the route is closed"] if spec.closed else []
    found += ["nothing holds its bends"] if spec.bends else []
    for i, each in enumerate(spec.route):
        if each.teeth:
            found.append(f"the wheel of station {i + 1} has teeth")
        if each.is_wheel and not spec.is_end(i) and each.gives_way:
            if not spec.closed and not _stays_tangent(spec, spans, i):
                found.append(f"the wheel of station {i + 1} moves across its cable")
    return found


def _stays_tangent(spec: Spec, spans: list[FreeSpan], i: int) -> bool:
    """Whether wheel i moves along both its spans, so that they touch it where they did, or on
    links that follow."""
    each = spec.route[i]
    near = [spec.route[j] for p in spec.beside(i) for j in spec.pairs[p]]
    if all(other.leans or not other.is_wheel for other in near):
        return True
    if each.mount:
        return False
    ways = [each.slide] if each.is_carried else []
    ways += [axis for axis, law in zip(AXES, each.motion, strict=True) if law]
    return all(
        any(v) and abs(dot(unit(v), spans[p].along)) > 1 - ROUND_OFF
        for v in ways for p in spec.beside(i)
    )  # fmt: skip


def choose_model(
    spec: Spec, spans: list[FreeSpan], moves: Moves, of: Demand, faults: Faults
) -> CableModel:
    """The model that the description requests, or what `accuracy` needs."""
    p = spec.accuracy
    figures = [*_figures(of, moves), *_damping(spec.cable)]
    level, why = _level(spec, spans, of, moves)
    form, why_form = _form(spec, spans, of, level, moves)
    count, why_count = _elements(spec, spans, of, form)
    if spec.level == 1 and demand.fronts(of, p) + (["rushes"] * (of.rushes > p)):
        text = "; ".join((*demand.rigid_fails(of, p), *figures))
        faults.add("rigid-has-waves", ("model", "level"), figures=text,
                   level=demand.elastic_level(of))  # fmt: skip
    bad = demand.paper_fails(of, p)
    if spec.form == "paper" and level == 3 and bad:
        text = "; ".join(_with_unknowns(bad, moves))
        faults.add("paper-not-valid", ("model", "form"), accuracy=p, figures=text)
    if level == 3 and form != "brute" and 0.0 < of.tension and of.speed > of.c_t:
        faults.add("faster-than-waves", ("model", "level"), speed=of.speed, wave=of.c_t,
                   tension=of.tension)  # fmt: skip
    _tell_pretension(spec, spans, level, faults)
    method, error, why_method, why_error = _integrator(spec, of, level, form, count)
    counted = (why_count,) if level > 1 else ()
    reasons = Reasons(tuple(why), tuple(why_form), counted, why_method, why_error)
    slackens = _slackens(of.left(p), spec)
    return CableModel(level, form, count, method, error, tuple(figures), reasons, slackens)


def _slackens(left: Errors | None, spec: Spec) -> float:
    """Least tension of a cable that goes slack, else 0 [N]."""
    if left is None or left.lowest > -SLACK * left.load * spec.cable.stiffness:
        return 0.0
    return left.lowest


def _tell_pretension(spec: Spec, spans: list[FreeSpan], level: int, faults: Faults) -> None:
    """Say that the cable starts with another tension than what hangs on it gives."""
    loose = replace(spec, cable=replace(spec.cable, pretension=0.0))
    hung = 0.0 if spec.closed else max(tensions(loose, spans))
    if level > 1 and 0.0 < hung < (1 - spec.accuracy) * spec.cable.pretension:
        faults.add("pretension", ("cable", "pretension"), hung=hung,
                   pretension=spec.cable.pretension)  # fmt: skip


def damped(spec: Spec, spans: list[FreeSpan], moves: Moves, prescribed: Laws) -> Spec:
    """With the time of its damping from the share of the critical one of a section: of those that
    the accuracy asks for without damping in a cable that also pushes, whatever there are."""
    cable = spec.cable
    if not cable.damping or cable.damping_time:
        return spec
    free = replace(spec, elements=0, cable=replace(cable, pulls_only=False))
    of = demand_of(free, spans, moves, prescribed)
    section = of.length / demand.elements(of, spec.accuracy)
    time = 2 * cable.damping * section / cable.speed
    return replace(spec, cable=replace(cable, damping_time=time))


def _is_linear(spec: Spec, spans: list[FreeSpan]) -> bool:
    """Whether it may have a linear model."""
    brute = spec.form == "brute" or needs_brute(spec, spans)
    return not (brute or spec.water or spec.bed or spec.cable.length)


def _machines(
    spec: Spec, spans: list[FreeSpan], moves: Moves, prescribed: Laws
) -> tuple[Machine, ...]:
    """The linear model as it starts and, where payout changes its lengths, at their extremes."""
    rests = [e * spec.cable.stiffness for e in spec.strains] or tensions(spec, spans)
    shapes = [spans]
    for extreme in ("least", "most"):
        grown = list(spans)
        for i, paid in moves.paid.items():
            if spec.is_end(i):
                fed = stretches(spec)[0][-1] if i == 0 else stretches(spec)[-1][0]
                length = spans[fed].length + getattr(paid, extreme)
                grown[fed] = replace(spans[fed], length=max(length, SHORTEST * spans[fed].length))
        if any(
            abs(a.length - b.length) > GROWN * b.length for a, b in zip(grown, spans, strict=True)
        ):
            shapes.append(grown)
    found = [machine(spec, each, rests, prescribed) for each in shapes]
    return tuple(each for each in found if each and is_usable(each))


def demand_of(spec: Spec, spans: list[FreeSpan], moves: Moves, prescribed: Laws) -> Demand:
    """The demand of a description, with its linear model where there is one."""
    of = demand_on_longest(spec, spans, moves)
    if not _is_linear(spec, spans):
        return of
    if of.across >= demand.SMALL_SLOPE * of.struck_wave:
        return of
    return replace(of, machines=_machines(spec, spans, moves, prescribed))


def demand_on_longest(spec: Spec, spans: list[FreeSpan], moves: Moves) -> Demand:
    """The demand on the longest span; it lies on its line unless something strikes it."""
    cable = spec.cable
    longest = max(reaches(spec, spans))
    weight = max(abs(dot(spec.gravity, span.along)) for span in spans)
    tied = any(each.feeds or each.is_moved or each.kind == "body" for each in spec.route)
    tied = tied or spec.is_surrounded
    rubs = any(spec.slips_at(i) for i in range(len(spec.route)))
    return Demand(
        stiffness=cable.stiffness, density=cable.density, length=longest,
        tension=min(tensions(spec, spans)) + cable.density * longest * weight / 2,
        struck=min(tensions(spec, spans)),
        moved=moving_mass(spec), pull=weight, least=moves.least, most=moves.most,
        speed=moves.speed, acceleration=moves.acceleration, known=moves.known, jump=moves.jump,
        across=moves.across, along=moves.along, straight=not (moves.across or spec.bends),
        end=spec.end, tied=tied,
        rubs=rubs, slackens=cable.pulls_only, results=spec.steps, asked=spec.quantities,
        given=spec.elements,
    )  # fmt: skip


def _with_unknowns(found: list[str], moves: Moves) -> list[str]:
    """The same, with what is not known before the run by its name."""
    known = [moves.unknown if moves.unknown and "not known" in text else text for text in found]
    return list(dict.fromkeys(known))


def _level(spec: Spec, spans: list[FreeSpan], of: Demand, moves: Moves) -> tuple[int, list[str]]:
    """The level, and why."""
    if spec.level:
        return spec.level, [f"level {spec.level} as asked"]
    if spec.form == "brute" or needs_brute(spec, spans):
        return 3, []
    against = demand.rigid_fails(of, spec.accuracy)
    if not spec.bends and not any(each.is_wheel or each.is_free for each in spec.route):
        against.append("nothing moves in a rigid cable between fixed ends")
    against += ["more than its tension acts on the cable"] * spec.is_surrounded
    against += ["a long run feeds the cable"] * any(each.kind == "run" for each in spec.route)
    against += ["the cable may slip on its wheels"] * any(
        spec.slips_at(i) for i in range(len(spec.route))
    )
    if not against:
        return 1, ["level 1: no estimate speaks against a rigid cable without mass"]
    level = demand.elastic_level(of)
    goes = moves.unknown or "cable goes over wheels"
    why = goes if level == 3 else "no cable goes over a wheel"
    return level, [
        f"not level 1: {', '.join(_with_unknowns(against, moves))}",
        f"level {level}: {why}",
    ]


def _form(
    spec: Spec, spans: list[FreeSpan], of: Demand, level: int, moves: Moves
) -> tuple[str, list[str]]:
    """The form, and why."""
    if spec.form != "auto":
        return spec.form, [f"form {spec.form} as asked"] if level > 1 else []
    across = needs_brute(spec, spans)
    if across and level > 1:
        return "brute", [f"form brute: {'; '.join(across)}"]
    if level < 3:
        return "paper", []
    bad = _with_unknowns(demand.paper_fails(of, spec.accuracy), moves)
    if bad:
        return "ale", [f"form ale: the paper's misses {spec.accuracy:g} by {', '.join(bad)}"]
    return "paper", [f"form paper: its estimates are all below {spec.accuracy:g}"]


def _elements(spec: Spec, spans: list[FreeSpan], of: Demand, form: str) -> tuple[int, str]:
    """Sections of the longest span, and the rule that requires them."""
    if spec.pitch:
        return max(round(of.length / spec.pitch), 1), "a section for every link"
    if spec.elements:
        return spec.elements, f"{spec.elements} sections as asked"
    found = demand.needed(of, spec.accuracy)
    found |= bending_advice.sections(spec, spans, min(tensions(spec, spans)))
    radii = [each.radius for i, each in enumerate(spec.route) if _lies_on(spec, spans, i)]
    if form == "brute" and radii:
        found["for (h/R)^2/24 on a rim"] = (
            of.length / min(radii) / sqrt(24 * RIM_SHARE * spec.accuracy)
        )
    bends = [spec.route[i].radius for i in spec.bends]
    if bends:
        found["for one on a radius of a bend"] = of.length / min(bends)
    why = max(found, key=lambda name: found[name])
    count = min(ceil(found[why]), MOST_SECTIONS)
    return count, f"{count} section{'s' * (count > 1)} {why}"


def _lies_on(spec: Spec, spans: list[FreeSpan], i: int) -> bool:
    """Whether cable lies on a good part of wheel i."""
    each = spec.route[i]
    return each.is_wheel and (spec.is_end(i) or wrap(spec, spans, i) > LIES)


def _integrator(
    spec: Spec, of: Demand, level: int, form: str, count: int
) -> tuple[str, float, str, str]:
    """The method, its ERROR, and why each."""
    p = spec.accuracy
    error, says = error_bound(of, p, count), "p T H/(3 EA)"
    if level == 1:
        method, why = integrator(of, p, level)
        error, says = RIGID_ERROR * of.longest, "1e-7 l"
    elif form == "brute":
        method, why = "HHT", "contacts, and sections that vibrate fast"
        radius = min((each.radius for each in spec.route if each.is_wheel), default=1.0)
        error = (of.length / count) ** 2 / (10 * SUNK * radius)
        says = "a tenth of what a node sinks in"
    elif spec.bends and not of.tied:
        method, why = "VERLET", "masses that nothing ties together and nothing keeps in place"
    elif spec.bed:
        method, why = "HHT", "contacts with the bed"
    elif spec.has_run:
        method, why = "HHT", "waves are followed with many small steps"
    else:
        method, why = integrator(of, p, level)
    if form != "brute" and (spec.grips or any(each.brake for each in spec.route)):
        method, why = "RADAU", "friction that holds and slips, and vibrations that die away"
    method = "GSTIFF, SI2" if method == "GSTIFF" else method
    error, says = (spec.error, "as asked") if spec.error else (error, says)
    name = method.split(",")[0]
    return method, error, f"{name}: {why}", says


def _damping(cable: Cable) -> list[str]:
    """What a share of critical damping comes to."""
    found = f"damping {cable.damping:g} is damping_time = {cable.damping_time:.3g} s"
    return [found] if cable.damping else []


def _figures(of: Demand, moves: Moves) -> list[str]:
    return [
        f"axial waves {of.c:.4g} m/s, transit of the longest span {1e3 * of.transit:.3g} ms",
        f"transverse waves {of.c_t:.4g} m/s at {of.tension:.4g} N",
        f"travel {of.least:.4g} to {of.most:.4g} m, up to {of.speed:.4g} m/s"
        if of.known else moves.unknown,
    ]  # fmt: skip

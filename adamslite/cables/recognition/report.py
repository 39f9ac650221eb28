"""The report of `adamslite check` on cables: their figures, and the model that they need."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from math import pi
from textwrap import wrap
from typing import TYPE_CHECKING, NamedTuple

from adamslite.cables.description.head_comments import is_described
from adamslite.cables.description.payout_law import Unknown
from adamslite.cables.model.advice import Advice, advise
from adamslite.cables.model.demand import Demand
from adamslite.cables.recognition.chain_demand import ChainDemand, demand_on
from adamslite.cables.recognition.chain_finder import Chain, all_rows, chains, is_cable
from adamslite.cables.recognition.chain_payout import drivers, form_of
from adamslite.cables.recognition.posture import Body, Posture
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.elements.simulate import Simulate, output_steps
from adamslite.elements.units import Units
from adamslite.language import units

if TYPE_CHECKING:
    from adamslite.cables.deck.described import Described
    from adamslite.cables.model.model_choice import CableModel
    from adamslite.cables.recognition.chain_routes import Route
    from adamslite.cables.recognition.recovery import Recovered

# Of a line of reasons.
WIDTH = 92
# Figures below it are shown as 0.
ROUND_OFF = 1e-9
ACCURACIES = (0.01, 0.001)
# Cables that differ are reported one by one; of more than this many the rest is only counted, and
# none has its linear model solved.
MOST = 6
#: No figure of a cable is larger, whatever its units: squares and products stay numbers.
LARGEST = 1e60


def about_cables(deck: Deck, commands: Iterable[Command] = ()) -> list[str]:
    """Lines about every cable; none for a deck without."""
    known = by_description(deck, commands)
    return _described(known, *_run(deck, commands)) if known else _listed(_found(deck, commands))


def advice_on(deck: Deck, p: float, commands: Iterable[Command] = ()) -> Advice | None:
    """For the accuracy `p` of the longest cable of a deck; None without one."""
    known = by_description(deck, commands)
    if known:
        choices = known.choices([p], *_run(deck, commands))
        return next(_chosen(*each) for each in choices if each.accuracy == p)
    found = _found(deck, commands)
    longest = max(found, key=lambda each: each.figures.demand.length, default=None)
    return longest.advised(p)[0] if longest else None


def by_description(deck: Deck, commands: Iterable[Command] = ()) -> Described | None:
    """A deck by the description that it carries; None where its statements are not those of it."""
    if not is_described(deck.source.text):
        return None
    from adamslite.cables.deck.described import PASSIVE, described

    settings = {*PASSIVE, "SIMULATE"}
    if any(getattr(c, "keyword", "") not in settings or _rests(c) for c in commands):
        return None
    return described(deck.source.text, deck.title)


def _rests(command: Command) -> bool:
    """Whether it changes where the dynamics begin."""
    return isinstance(command, Simulate) and command.kind == "STATICS"


def cables(deck: Deck, commands: Iterable[Command] = ()) -> list[ChainDemand]:
    """The cables of a deck in its run, in SI units when the deck names its units."""
    posture = Posture(deck)
    rows = chains(deck, posture)
    end, results = _run(deck, commands) if rows else (0.0, 0)
    found = (_demand(chain, posture, end, results, len(rows) <= MOST) for chain in rows)
    return [each for each in found if each]


def _demand(
    chain: Chain, posture: Posture, end: float, results: int, linear: bool
) -> ChainDemand | None:
    try:
        found = demand_on(chain, posture, end, results, linear)
    except Unknown:
        return None
    demand = _in_si(found.demand, posture.deck)
    return replace(found, demand=demand) if _is_of_this_world(demand) else None


def _is_of_this_world(demand: Demand) -> bool:
    """Whether products of its figures stay within the range of numbers."""
    figures = demand.stiffness, demand.density, demand.length, demand.tension, demand.moved
    return all(abs(figure) < LARGEST for figure in figures)


def _found(deck: Deck, commands: Iterable[Command]) -> list[_Cable]:
    """Cables by the description that their statements amount to, or one by one."""
    posture = Posture(deck)
    rows = all_rows(deck, posture)
    some = [row for row in rows if is_cable(row) or (len(rows) <= MOST and _is_fed(row, posture))]
    if not some:
        return []
    if len(some) > MOST:
        return [_by_itself(each) for each in cables(deck, commands)]
    from adamslite.cables.recognition.chain_routes import routes
    from adamslite.cables.recognition.recovery import recovered

    end, results = _run(deck, commands)
    found: list[_Cable | None] = []
    for route in routes(some, posture):
        whole = recovered(route, posture, end, results)
        if whole:
            found.append(_recovered(route, whole, posture))
        else:
            each = (_demand(chain, posture, end, results, linear=True)
                    for chain, _ in route.chains if is_cable(chain))  # fmt: skip
            found += [_by_itself(one) for one in each if one]
    return [each for each in found if each]


def _is_fed(row: Chain, posture: Posture) -> bool:
    """Whether the rotation of a wheel feeds a row, however few its springs are."""
    return any(call.name == "AZ" for link in row.links for call in drivers(link, posture))


def _by_itself(of: ChainDemand) -> _Cable:
    """A chain, of which only the demand is known."""

    def advised(p: float) -> tuple[Advice, list[str]]:
        return advise(of.demand, p), []

    figures = _Figures(of.demand, len(of.chain.links), of.form, of.gained, of.loaded)
    return _Cable(_ends(of.chain), figures, advised)


def _recovered(route: Route, of: Recovered, posture: Posture) -> _Cable:
    """A route with its description."""
    demand = _in_si(of.demand, posture.deck)

    def advised(p: float) -> tuple[Advice, list[str]]:
        model = of._replace(demand=demand).chosen(p)
        choice = p, model, model.reasons.sentences, demand
        return _chosen(*choice), _why(model.reasons.sentences)

    chain = max(route.chains, key=lambda each: sum(link.free for link in each[0].links))[0]
    gained = (demand.least / demand.length, demand.most / demand.length)
    form = form_of(chain, posture)
    figures = _Figures(demand, len(chain.links), form, gained)
    return _Cable(_stations(route), figures, advised)


def _stations(route: Route) -> str:
    """Where a route begins, goes and ends."""
    (first, forwards), (last, onwards) = route.chains[0], route.chains[-1]
    ends = first.nodes[0 if forwards else -1], last.nodes[-1 if onwards else 0]
    between = [_name(("PART", key) if word == "wheel" else (word, key))
               for word, key in route.stations[1:-1]]  # fmt: skip
    by = f" by {', '.join(between)}" if between else ""
    return f"from {_name(ends[0])}{by} to {_name(ends[1])}"


def _run(deck: Deck, commands: Iterable[Command]) -> tuple[float, int]:
    """When the dynamics end, 0 when nothing says so; the number of results that are asked for."""
    runs = [c for c in commands if isinstance(c, Simulate)] or deck.of(Simulate)
    time = reached = 0.0
    for run in runs:
        if run.at_once:
            continue
        time = run.until(time)
        reached = time if run.kind in ("DYNAMICS", "TRANSIENT") else reached
    last = [run for run in runs if not run.at_once][-1:]
    return reached, sum(round(output_steps(reached, run.steps, run.dtout)) for run in last)


def _in_si(of: Demand, deck: Deck) -> Demand:
    names = deck.single(Units).names
    if not names:
        return of
    force, length, time = units.FORCE[names[0]], units.LENGTH[names[2]], units.TIME[names[3]]
    mass = force * time**2 / length
    powers = {
        "stiffness": force, "density": mass / length, "length": length, "tension": force,
        "moved": mass, "pull": length / time**2, "least": length, "most": length,
        "speed": length / time, "acceleration": length / time**2, "jump": length / time,
        "across": length / time, "along": length / time, "struck": force, "wave": 1 / length,
        "end": time,
    }  # fmt: skip
    return replace(of, **{name: getattr(of, name) * factor for name, factor in powers.items()})


# ---- the text --------------------------------------------------------------------------------


class _Figures(NamedTuple):
    """What the lines about a cable show of it, besides its demand."""

    demand: Demand
    sections: int
    form: str
    gained: tuple[float, float]
    loaded: bool = False


class _Cable(NamedTuple):
    """What it is called, what is shown of it, and the advice for an accuracy, with reasons."""

    name: str
    figures: _Figures
    advised: Callable[[float], tuple[Advice, list[str]]]


def _described(known: Described, end: float, results: int) -> list[str]:
    """A cable whose description is known, with reasons."""
    choices = [*known.choices(ACCURACIES, end, results)]
    of, model = choices[0].demand, known.model
    form = "rigid" if model.level == 1 else model.form if model.level == 3 else "fixed"
    shown = _Figures(of, model.elements, form, (of.least / of.length, of.most / of.length))
    lines = _about(shown)
    for each in choices:
        lines += [_advised(_chosen(*each)), *_why(each.reasons)]
    count = len(known.drawn.pieces)
    name = f"the longest of {count} spans" if count > 1 else "as described"
    return [f"  cable {name}", *(f"    {line}" for line in lines)]


def _chosen(p: float, model: CableModel, reasons: Sequence[str], demand: Demand) -> Advice:
    """As advice, with the cost where that is known."""
    name, sections = model.method.split(",")[0], model.elements * (model.level > 1)
    same = advise(demand, p)
    alike = (same.level, same.elements, same.integrator) == (model.level, sections, name)
    form = model.form if model.level == 3 else ""
    return Advice(p, model.level, form, sections, name, model.error, same.cost if alike else 0.0)


def _why(reasons: Sequence[str]) -> list[str]:
    """The reasons of a choice."""
    text = f"because {'; '.join(reasons)}"
    return wrap(text, WIDTH, initial_indent=" " * 11, subsequent_indent=" " * 11)


def _listed(found: list[_Cable]) -> list[str]:
    """Equal cables share their lines."""
    groups: dict[tuple[str, ...], list[str]] = {}
    for each in found:
        lines = _about(each.figures)
        for advice, why in map(each.advised, ACCURACIES):
            lines += [_advised(advice), *why]
        groups.setdefault(tuple(lines), []).append(each.name)
    listed = []
    for figures, same in list(groups.items())[:MOST]:
        more = f" and {len(same) - 3} more" if len(same) > 3 else ""
        listed += [f"  cable {', '.join(same[:3])}{more}", *(f"    {line}" for line in figures)]
    left = len(groups) - MOST
    return [*listed, *([f"  {left} more cables"] if left > 0 else [])]


def _ends(chain: Chain) -> str:
    if chain.is_ring:
        return f"round through {_name(chain.nodes[0])}"
    return f"from {_name(chain.nodes[0])} to {_name(chain.nodes[-1])}"


def _name(node: Body) -> str:
    return f"{node[0]}/{node[1]}"


def _about(each: _Figures) -> list[str]:
    of, sections = each.demand, each.sections
    many = f"{sections} section{'s' * (sections > 1)}"
    vibrate = f"sections   vibrate with up to {_frequency(of, sections)}"
    return [
        f"cable      {many} of {of.length / sections:.4g} m, EA = {of.stiffness:.4g} N"
        f", rho = {of.density:.4g} kg/m, {_made(each)}",
        f"waves      axial {of.c:.4g} m/s, {_time(of.transit)} along it; {_transverse(of)}"
        + (f"; the run lasts {_time(of.end)}" if of.end else ""),
        *([] if each.form == "rigid" else [vibrate]),
        *_payout(each),
        *(["forces     on its nodes, which the advice leaves out"] if each.loaded else []),
    ]


def _made(each: _Figures) -> str:
    if each.form == "rigid":
        return "rigid and without mass"
    if each.form == "fixed":
        return "of fixed length"
    if each.form == "brute":
        return "run over the rims"
    least, most = each.gained
    if not each.demand.known:
        return f"{each.form} form, Dm/m0 = {_short(least)} at the start"
    return f"{each.form} form, Dm/m0 from {_short(least)} to {_short(most)}"


def _transverse(of: Demand) -> str:
    if not of.c_t:
        return "slack"
    return f"transverse {of.c_t:.4g} m/s at {of.tension:.4g} N, {_time(of.length / of.c_t)}"


def _frequency(of: Demand, sections: int) -> str:
    found = of.c * sections / of.length / pi
    return f"{found:.3g} Hz, c/(pi H)"


def _payout(each: _Figures) -> list[str]:
    of = each.demand
    if not of.known:
        rate = f"; it starts with {_short(of.speed)} m/s" if of.speed else ""
        return [f"payout     is known after the run only{rate}"]
    if not of.way:
        return []
    shares = f"{_short(of.speed / of.c_t)} of the transverse and " if of.c_t else ""
    estimates = ", ".join(f"{name} = {_short(value)}" for name, value in of.validity.items())
    bad = [name for name, value in of.validity.items() if value >= ACCURACIES[0]]
    held = "its errors are below 1 %" if not bad else "not good for 1 %"
    return [
        f"payout     {_short(of.least)} to {of.most:.3g} m, up to {_short(of.speed)} m/s: "
        f"{shares}{_short(of.speed / of.c)} of the axial wave",
        f"paper form {estimates}: {held}",
    ]


def _advised(advice: Advice) -> str:
    label = f"for {100 * advice.accuracy:g} %"
    if advice.level == 1:
        model = "level 1, rigid and without mass"
    else:
        kinds = {"": "fixed sections", "brute": "sections over the rims"}
        kind = f", {kinds.get(advice.form, f'{advice.form} form')}"
        model = f"level {advice.level}{kind}, {advice.elements} of them"
    error = "" if advice.integrator == "VERLET" else f" ERROR={advice.error:.0E}"
    cost = f"; about {advice.cost:.1g} s of CPU" if advice.cost else ""
    return f"{label:<10} {model}; {advice.integrator}{error}{cost}"


def _time(value: float) -> str:
    return f"{value:.3g} s" if value >= 1 else f"{1e3 * value:.3g} ms"


def _short(value: float) -> str:
    return f"{value:.2g}" if abs(value) > ROUND_OFF else "0"

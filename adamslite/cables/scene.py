"""From the text of a description to the text of a deck."""

from dataclasses import dataclass, replace

from adamslite.cables import bending_advice
from adamslite.cables.brute_force_layout import Overstretched, length, stretches, way
from adamslite.cables.catenary import start
from adamslite.cables.deck_writer import write
from adamslite.cables.demand import MOST, Demand
from adamslite.cables.description import Model, comments
from adamslite.cables.estimate import Laws, Moves, estimate_moves, laws
from adamslite.cables.geometry import FreeSpan, reaches, spans, turned
from adamslite.cables.lumps import stored
from adamslite.cables.messages import Faults
from adamslite.cables.model_choice import (
    CableModel,
    Reasons,
    choose_model,
    demand_of,
    needs_brute,
    tensions,
)
from adamslite.cables.sliders import is_straight, is_wire
from adamslite.cables.spec import read
from adamslite.cables.surroundings_rules import check_nodes, check_surroundings
from adamslite.cables.toml_places import Path
from adamslite.cables.vectors import dot
from adamslite.cables.vocabulary import Spec
from adamslite.cables.wheels import in_plane, slipping
from adamslite.language.diagnostics import DeckError, Diagnostic, sort_by_place

# Pitches that differ by less than this share are one.
SAME_PITCH = 1e-4
# What a loop may lack of a whole number of links, as a share of one on half of a wheel.
LINK_SHARE = 0.02
# Shares by which payout may outrun a load before it is reported.
FASTER = 0.01


@dataclass(frozen=True)
class Drawn:
    """A description that is ready to be written by one model or another.

    `text` is it as it was given, `given` what it says, `spec` that without what no model of it
    needs.
    """

    text: str
    given: Spec
    spec: Spec
    pieces: list[FreeSpan]
    moves: Moves
    prescribed: Laws
    faults: Faults

    def asking(self, accuracy: float, end: float, steps: int) -> "Drawn":
        """The same without a word about the model but its accuracy, and in another run."""
        free = replace(self.given, level=0, form="auto", elements=0, error=0.0,
                       accuracy=accuracy, end=end, steps=steps)  # fmt: skip
        return _drawn(self.text, free, Faults(self.faults.places))

    def pulling(self) -> "Drawn":
        """With sections that carry nothing where they are slack."""
        given, spec = (
            replace(each, cable=replace(each.cable, pulls_only=True))
            for each in (self.given, self.spec)
        )
        return replace(self, given=given, spec=spec)

    def strained(self, strains: list[float]) -> "Drawn":
        """With strains of its spans as drawn, which are not those of its tensions at rest."""
        given, spec = (replace(each, strains=tuple(strains)) for each in (self.given, self.spec))
        return replace(self, given=given, spec=spec)

    def demanding(self, demand: Demand | None = None) -> "Setting":
        """With its linear model, or the demand that is known already."""
        of = demand or demand_of(self.spec, self.pieces, self.moves, self.prescribed)
        return Setting(**{**vars(self), "demand": of})


@dataclass(frozen=True)
class Setting(Drawn):
    """The same, with its linear model."""

    demand: Demand

    def telling(self, code: str, path: Path, **words: object) -> "Setting":
        """With one message more."""
        faults = self.faults.copy()
        faults.add(code, path, **words)
        return replace(self, faults=faults)

    def only_pulling(self) -> "Setting":
        """With sections that carry nothing where they are slack."""
        return self.pulling().demanding(replace(self.demand, slackens=True))


@dataclass(frozen=True)
class Written:
    """The text of a deck, what there is to say about it, and its model."""

    text: str
    messages: list[Diagnostic]
    model: CableModel


def deck(text: str, file: str = "<text>") -> tuple[str, list[Diagnostic]]:
    """The deck of a description by its linear model, and the warnings about it.

    Raises
    ------
    DeckError
        With everything that is wrong with the description.
    """
    found = written(setting(text, file))
    return found.text, found.messages


def setting(text: str, file: str = "<text>") -> Setting:
    """What a description says, and its linear model.

    Raises
    ------
    DeckError
        With everything that is wrong with it before a model is chosen.
    """
    return drawn(text, file).demanding()


def drawn(text: str, file: str = "<text>") -> Drawn:
    """What a description says; raises as :func:`setting`."""
    spec, faults = read(text, file)
    spec = turned(spec)
    check_surroundings(spec, faults)
    _stop(faults, faults.errors and bool(spec.cable.length))
    return _drawn(text, _tensioned(spec), faults)


def _drawn(text: str, given: Spec, faults: Faults) -> Drawn:
    pieces = spans(given, faults)
    prescribed = laws(given, faults)
    _stop(faults, faults.errors)
    spec = _essential(given, pieces)
    moves = estimate_moves(spec, pieces, prescribed)
    return Drawn(text, given, spec, pieces, moves, prescribed, faults)


def chosen(of: Setting, faults: Faults, why: Reasons | None = None) -> CableModel:
    """The model that is asked for, or what the linear model chooses; `why` that one where runs have
    shown it."""
    model = choose_model(of.spec, of.pieces, of.moves, of.demand, faults)
    told = bending_advice.told(of.given, of.pieces, min(tensions(of.given, of.pieces)))
    return replace(model, reasons=replace(why or model.reasons, more=tuple(told)))


def written(of: Setting, why: Reasons | None = None) -> Written:
    """The deck by the model that is asked for, or by what the linear model chooses; `why` that one
    where runs have shown it.

    Raises
    ------
    DeckError
        With everything that is wrong with the description, or with that model of it.
    """
    spec, pieces, moves, faults = of.spec, of.pieces, of.moves, of.faults.copy()
    model = chosen(of, faults, why)
    _check_form(spec, pieces, model, faults)
    _check_chain(spec, pieces, faults)
    _check_shape(spec, pieces, model, faults)
    _check(spec, pieces, moves, model, faults)
    _stop(faults, faults.errors)
    try:
        text = write(spec, pieces, moves, model, comments(of.text, _shown(spec, model, why)))
    except Overstretched:
        faults.add("overstretched", ("cable", "EA"), stiffness=spec.cable.stiffness)
        raise DeckError(sort_by_place(faults.found)) from None
    return Written(text, sort_by_place(faults.found), model)


def _shown(spec: Spec, model: CableModel, why: Reasons | None) -> Model:
    """What the comments of a deck say about its model."""
    tried = [*model.reasons.told] if why else []
    return Model(
        model.level, model.form, model.elements, model.method, float(f"{model.error:.1E}"),
        spec.cable.pulls_only, tried,
    )  # fmt: skip


def _tensioned(spec: Spec) -> Spec:
    """With the tension that a cable of given length has, on which the choice of a model rests."""
    if not spec.cable.length:
        return spec
    return replace(spec, cable=replace(spec.cable, pretension=start(spec, 1).tension))


def _essential(spec: Spec, pieces: list[FreeSpan]) -> Spec:
    """Without bending where the level is not given and less than the accuracy is lost."""
    if not spec.cable.bending or spec.level:
        return spec
    needed = bending_advice.needs_bending(spec, pieces, min(tensions(spec, pieces)))
    return spec if needed else bending_advice.without(spec)


def _stop(faults: Faults, wrong: bool) -> None:
    if wrong:
        raise DeckError(sort_by_place(faults.found))


def _check_form(spec: Spec, pieces: list[FreeSpan], model: CableModel, faults: Faults) -> None:
    """Whether the level and the form can show what the description has."""
    brute = model.form == "brute"
    if model.level < 3 and spec.form not in ("auto", "brute"):
        faults.add("form-has-level", ("model", "form"), form=spec.form)
    why = needs_brute(spec, pieces)
    if why and not brute:
        key = "form" if spec.form != "auto" else "level"
        faults.add("needs-brute", ("model", key), why="; ".join(why))
    if brute or spec.bends:
        _check_brute(spec, faults)
    shows_sliding = model.level == 1 or model.level == 3 and model.form == "ale"
    for i, each in enumerate(spec.route):
        if each.slides and not shows_sliding:
            faults.add("slider-form", ("route", i, "slides"))
        if each.floor and not any(spec.gravity):
            faults.add("floor-where", ("route", i, "floor"))
    check_nodes(spec, model, faults)
    if model.level == 1:
        _check_rigid(spec, faults)


def _check_rigid(spec: Spec, faults: Faults) -> None:
    """Whether a rigid cable without mass can do what the description has."""
    for i in spec.bends:
        faults.add("rigid-cannot", ("route", i, "kind"), what="nothing keeps its bends")
    if not spec.bends and not any(each.is_wheel or each.is_free for each in spec.route):
        faults.add("rigid-cannot", ("model", "level"), what="nothing moves between fixed ends")
    for i, each in enumerate(spec.route):
        if each.kind == "run":
            faults.add("rigid-cannot", ("route", i, "kind"), what="a long run has waves")
        if each.slides and is_straight(spec, i) and not is_wire(spec, i):
            faults.add("rigid-cannot", ("route", i, "slides"), what="its straight length is fixed")
        if slipping(i, spec):
            faults.add("rigid-cannot", ("route", i, "mu"), what="its cable cannot slip")


def _check_brute(spec: Spec, faults: Faults) -> None:
    """Whether sections can be laid round the wheels and bends, and run over the rims."""
    if not any(each.is_round for each in spec.route):
        faults.add("brute-no-wheel", ("model", "form"))
    elif not in_plane(spec):
        faults.add("brute-plane", ("model", "form"))
    for i, each in enumerate(spec.route):
        for word in ("reel", "wander", "held", "grip"):
            if getattr(each, word):
                faults.add("brute-cannot", ("route", i, word), word=word)


def _check_chain(spec: Spec, pieces: list[FreeSpan], faults: Faults) -> None:
    """Whether all sprockets have one pitch, and a loop a whole number of links."""
    toothed = [i for i, each in enumerate(spec.route) if each.teeth]
    for i in toothed[1:]:
        each = spec.route[i]
        if abs(each.pitch - spec.pitch) > SAME_PITCH * spec.pitch:
            faults.add("pitches", ("route", i, "radius"), i=toothed[0] + 1, j=i + 1,
                       first=spec.pitch, second=each.pitch,
                       radius=each.radius * spec.pitch / each.pitch)  # fmt: skip
    if not (toothed and spec.closed) or faults.errors:
        return
    parts = way(spec, pieces, list(range(len(pieces))), {})
    links = length(parts, spec.pitch) / spec.pitch
    most = max(spec.route[i].teeth for i in toothed)
    # Spread over all links, less than LINK_SHARE of a link on half of the largest wheel.
    if abs(links - round(links)) > LINK_SHARE * 2 * links / most:
        faults.add("loop-of-links", ("route", toothed[-1], "at"), links=links,
                   off=(round(links) - links) * spec.pitch / 2)  # fmt: skip


def _check_shape(spec: Spec, pieces: list[FreeSpan], model: CableModel, faults: Faults) -> None:
    """Whether the sections fit round the bends, and only a loop runs along itself."""
    section = max(reaches(spec, pieces)) / model.elements
    for i in spec.bends:
        radius = spec.route[i].radius
        if section > 2 * radius:
            faults.add("bend-too-tight", ("route", i, "radius"), section=section, radius=radius)
    if spec.speed and not spec.closed:
        faults.add("speed-on-a-route", ("speed",))


def _check(
    spec: Spec, pieces: list[FreeSpan], moves: Moves, model: CableModel, faults: Faults
) -> None:
    """What only the model and the travel show."""
    longest = max(reaches(spec, pieces))
    count = model.elements
    held = stored(spec, moves) if model.form == "brute" else {}
    if model.form == "brute":
        total = sum(piece.length for piece in pieces) + sum(held.values())
        count = round(count * total / longest / len(stretches(spec)))
    if count > MOST:
        faults.add("too-many", ("model", "elements"), word="elements", count=count, most=MOST)
    for i, paid in moves.paid.items():
        if not spec.is_end(i):
            continue
        each = spec.route[i]
        if each.reel and paid.most > each.reel.holds(each.radius):
            faults.add("stored-too-little", ("route", i, "reel"), value=paid.most,
                       held=each.reel.holds(each.radius))  # fmt: skip
        length = _supply(spec, pieces, i)
        key = ("route", i, "payout")
        if length + paid.least <= 0:
            faults.add("payout-too-far-in", key, time=paid.least_at, value=paid.least,
                       length=length)  # fmt: skip
        if i in held and paid.most > held[i]:
            faults.add("stored-too-little", ("route", i, "stored"), value=paid.most, held=held[i])
    _check_slack(spec, pieces, moves, model, faults)
    section = longest / model.elements
    _check_fixed(spec, model, moves, section, faults)
    most = max(tensions(spec, pieces))
    if 0 < spec.cable.breaking < most:
        faults.add("breaking", ("cable", "breaking_load"), tension=most, limit=spec.cable.breaking)


def _supply(spec: Spec, pieces: list[FreeSpan], i: int) -> float:
    """Cable that the winch at an end can wind in [m].

    Over wheels cable comes on: the span at the weight runs out; what is held stretches as a whole.
    """
    group = stretches(spec)[0 if i == 0 else -1]
    last = group[-1] if i == 0 else group[0]
    if any(spec.route[j].is_free for j in spec.pairs[last]):
        return pieces[last].length
    return sum(pieces[p].length for p in group)


def _check_slack(
    spec: Spec, pieces: list[FreeSpan], moves: Moves, model: CableModel, faults: Faults
) -> None:
    """Whether a winch pays out faster than a load at the other end comes after by itself."""
    if spec.cable.pulls_only and model.level > 1:
        return
    pushed = _is_pushed(spec, pieces, moves, faults)
    if model.slackens and model.level > 1 and not pushed:
        faults.add("slackens", ("cable",), least=model.slackens)


def _is_pushed(spec: Spec, pieces: list[FreeSpan], moves: Moves, faults: Faults) -> bool:
    """Whether a winch does so; says so."""
    last, before = len(spec.route) - 1, len(faults.found)
    for i, paid in moves.paid.items():
        load, span, sense = (
            (spec.route[last], pieces[-1], 1) if i == 0 else (spec.route[0], pieces[0], -1)
        )
        if i not in (0, last) or load.kind not in ("mass", "free"):
            continue
        fall, own = (sense * dot(way, span.along) for way in (spec.gravity, load.velocity))
        path = ("route", i, "payout")
        if paid.start > own + FASTER * paid.speed:
            faults.add("pushed-at-once", path, speed=paid.start, own=own)
        elif paid.gain > max(fall, 0.0) + FASTER * max(abs(fall), paid.gain):
            faults.add("pushed", path, gain=paid.gain, time=paid.gain_at, fall=max(fall, 0.0))
    return len(faults.found) > before


def _check_fixed(
    spec: Spec, model: CableModel, moves: Moves, section: float, faults: Faults
) -> None:
    """Whether a section of fixed length can take the cable that comes over a wheel."""
    route = spec.route
    # Between two wheels there is one spring, which cable may run through.
    sections = any(not (route[i].is_wheel and route[j].is_wheel) for i, j in spec.pairs)
    if model.level != 2 or model.form == "brute" or not sections or faults.errors:
        return
    if moves.way > section / 2:
        faults.add("level-2-pays-out", ("model", "level"), section=section, travel=moves.way)
    elif moves.unknown:
        faults.add("level-2-unknown", ("model", "level"), section=section, why=moves.unknown)

"""From the text of a description to the text of a deck."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from adamslite.cables.deck.deck_writer import Modelled, write
from adamslite.cables.deck.form_rules import (
    check_chain,
    check_collisions,
    check_form,
    check_shape,
    tell_overstretched,
)
from adamslite.cables.description.components import Load
from adamslite.cables.description.head_comments import Model, comments
from adamslite.cables.description.messages import Faults
from adamslite.cables.description.spec import Description, read, read_scene
from adamslite.cables.description.surroundings_rules import check_surroundings
from adamslite.cables.description.toml_places import Path
from adamslite.cables.description.vocabulary import MOST_SECTIONS, Spec
from adamslite.cables.layout.brute_force_layout import Overstretched, stretches, supply
from adamslite.cables.layout.catenary import start
from adamslite.cables.layout.geometry import FreeSpan, reaches, spans, turned
from adamslite.cables.model import bending_advice
from adamslite.cables.model.demand import Demand
from adamslite.cables.model.estimate import Laws, Moves, estimate_moves, laws
from adamslite.cables.model.loads import Rope, are_determined, as_borne, on_loads, shared
from adamslite.cables.model.model_choice import (
    CableModel,
    Reasons,
    choose_model,
    damped,
    demand_of,
    needs_brute,
    tensions,
)
from adamslite.cables.statements.lumps import stored
from adamslite.cables.vectors import dot
from adamslite.language.diagnostics import DeckError, Diagnostic, sort_by_place

# Shares by which payout may outrun a load before it is reported.
FASTER = 0.01
MOVED = "the loads it hangs on are moved by another cable"
SHARES = ("not level 1: how cables share a load depends on their stiffness",)


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
        of = demand or demand_of(as_borne(self.spec), self.pieces, self.moves, self.prescribed)
        return Setting(**{**vars(self), "demand": of})


@dataclass(frozen=True)
class Setting(Drawn):
    """The same, with its linear model, and the method where runs have shown it."""

    demand: Demand
    method: str = ""

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
    given = read_scene(text, file)
    found = several(given) if given.is_several else written(setting(text, file))
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
    return _drawn(text, _settled(spec, faults), faults)


def _settled(spec: Spec, faults: Faults) -> Spec:
    """With the turn of its wheels, and the tension that its length gives it."""
    spec = turned(spec)
    check_surroundings(spec, faults)
    _stop(faults, faults.errors and bool(spec.cable.length))
    return _tensioned(spec)


def _drawn(text: str, given: Spec, faults: Faults) -> Drawn:
    rope = Rope(given, spans(given, faults), faults, laws(given, faults))
    _stop(faults, faults.errors)
    return _ready(text, rope)


def _ready(text: str, rope: Rope) -> Drawn:
    """Ready to be written."""
    moves = estimate_moves(as_borne(rope.spec), rope.spans, rope.laws)
    cable = damped(as_borne(rope.spec), rope.spans, moves, rope.laws).cable
    given = replace(rope.spec, cable=cable)
    return Drawn(
        text, given, _essential(given, rope.spans), rope.spans, moves, rope.laws, rope.faults
    )


def chosen(of: Setting, faults: Faults, why: Reasons | None = None) -> CableModel:
    """The model that is asked for, or what the linear model chooses; `why` that one where runs have
    shown it."""
    model = choose_model(as_borne(of.spec), of.pieces, of.moves, of.demand, faults)
    bending = bending_advice.sentences(of.given, of.pieces, min(tensions(of.given, of.pieces)))
    reasons, method = replace(why or model.reasons, more=tuple(bending)), model.method
    if of.method not in ("", method):
        reasons = replace(reasons, method=f"{of.method}: {method} did not come to an end")
    return replace(model, method=of.method or method, reasons=reasons)


def written(of: Setting, why: Reasons | None = None) -> Written:
    """The deck by the model that is asked for, or by what the linear model chooses; `why` that one
    where runs have shown it.

    Raises
    ------
    DeckError
        With everything that is wrong with the description, or with that model of it.
    """
    faults = of.faults.copy()
    model = _modelled(of, faults, why)
    _stop(faults, faults.errors)
    shown = comments(of.text, _shown(of.spec, model.model, why))
    text = _whole(lambda: write([model], comments=shown), of.spec, faults)
    return Written(text, sort_by_place(faults.found), model.model)


def _modelled(of: Setting, faults: Faults, why: Reasons | None = None) -> Modelled:
    """A cable with its model, and what is wrong with that."""
    spec, pieces, moves = of.spec, of.pieces, of.moves
    model = chosen(of, faults, why)
    check_form(spec, pieces, model, faults)
    check_chain(spec, pieces, faults)
    check_shape(spec, pieces, model, faults)
    check_collisions(spec, pieces, moves, faults)
    _check(spec, pieces, moves, model, faults)
    return Modelled(spec, pieces, moves, model)


def several(given: Description) -> Written:
    """The deck of several cables, and of loads on them.

    Raises
    ------
    DeckError
        With everything that is wrong with the description.
    """
    faults = given.faults
    specs, loads = on_loads(given.cables, given.loads, faults)
    _stop(faults, faults.errors)
    ropes = []
    for spec, (_, own) in zip(specs, given.cables, strict=True):
        spec = _settled(spec, own)
        ropes.append(Rope(spec, spans(spec, own), own, laws(spec, own)))
    _stop(faults, faults.errors)
    if loads:
        specs = shared(ropes, loads, faults)
        ropes = [replace(rope, spec=spec) for rope, spec in zip(ropes, specs, strict=True)]
    _check_forms(ropes)
    _stop(faults, faults.errors)
    found = [_sharing(*each, ropes, loads) for each in zip(ropes, _moved(ropes), strict=True)]
    _check_shares(found, ropes, loads)
    _stop(faults, faults.errors)
    text = _whole(lambda: write(found, loads), found[0].spec, faults)
    return Written(text, sort_by_place(faults.found), found[0].model)


def _whole(write_it: Callable[[], str], spec: Spec, faults: Faults) -> str:
    """A deck whose cables can be as long as they are drawn."""
    try:
        return write_it()
    except Overstretched as fault:
        tell_overstretched(spec, *fault.args, faults=faults)
        raise DeckError(sort_by_place(faults.found)) from None


def _moved(ropes: list[Rope]) -> list[Drawn]:
    """Cables, and what is known of their motion: nothing on loads that others move."""
    found = [_ready("", rope) for rope in ropes]
    rests = [each.moves.known and each.moves.most <= each.moves.least for each in found]
    loads = [{station.on for station in each.spec.route if station.on} for each in found]
    moving = set().union(*(on for on, still in zip(loads, rests, strict=True) if not still))
    return [
        replace(each, moves=replace(each.moves, unknown=MOVED)) if still and on & moving else each
        for each, on, still in zip(found, loads, rests, strict=True)
    ]


def _sharing(rope: Rope, ready: Drawn, ropes: list[Rope], loads: tuple[Load, ...]) -> Modelled:
    """A cable with its model: not a rigid one where cables share a load by their stiffness, and
    the level is not given."""
    of = ready.demanding()
    shares = loads and any(each.on for each in rope.spec.route)
    free = not rope.spec.level and shares and not are_determined(ropes, loads)
    if not free or chosen(of, of.faults.copy()).level > 1:
        return _modelled(of, rope.faults)
    feeds = any(each.feeds for each in rope.spec.route)
    elastic = replace(rope, spec=replace(rope.spec, level=3 if feeds else 2))
    ready = replace(_ready("", elastic), moves=ready.moves)
    found = _modelled(ready.demanding(), rope.faults)
    reasons = replace(found.model.reasons, level=SHARES)
    return replace(found, model=replace(found.model, reasons=reasons))


def _check_forms(ropes: list[Rope]) -> None:
    """Whether no cable of several, or with loads, needs sections that run over rims."""
    if ropes[0].spec.form == "brute":
        ropes[0].faults.add("several-brute", ("model", "form"), why="form = brute is given",
                            hint="leave form out")  # fmt: skip
        return
    for rope in ropes:
        why = needs_brute(rope.spec, rope.spans)
        why += ["nothing holds its bends"] if rope.spec.bends and not why else []
        if why:
            needs = "; ".join(why) + ": only form brute represents that"
            rope.faults.add("several-brute", ("cable",), why=needs)


def _check_shares(found: list[Modelled], ropes: list[Rope], loads: tuple[Load, ...]) -> None:
    """Whether no cable is rigid whose share of a load depends on its stiffness."""
    sharing = [each for each in found if any(station.on for station in each.spec.route)]
    if any(each.model.level == 1 for each in sharing) and not are_determined(ropes, loads):
        ropes[0].faults.add("not-shared", ("model", "level"), cables=len(sharing))


def _shown(spec: Spec, model: CableModel, why: Reasons | None) -> Model:
    """What the comments of a deck say about its model."""
    tried = [*model.reasons.sentences] if why else []
    return Model(
        model.level, model.form, model.elements, model.method, float(f"{model.error:.1E}"),
        spec.cable.pulls_only, tried,
    )  # fmt: skip


def _tensioned(spec: Spec) -> Spec:
    """With the tension that a cable of given length has, on which the choice of a model rests."""
    if not spec.cable.length or any(each.on for each in spec.route):
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


def _check(
    spec: Spec, pieces: list[FreeSpan], moves: Moves, model: CableModel, faults: Faults
) -> None:
    """What only the model and the travel show."""
    longest, count = max(reaches(spec, pieces)), model.elements
    held = stored(spec, moves) if model.form == "brute" else {}
    if model.form == "brute":
        total = sum(piece.length for piece in pieces) + sum(held.values())
        count = round(count * total / longest / len(stretches(spec)))
    if count > MOST_SECTIONS:
        faults.add("too-many", ("model", "elements"), word="elements", count=count,
                   most=MOST_SECTIONS)  # fmt: skip
    for i, paid in moves.paid.items():
        if not spec.is_end(i):
            continue
        each = spec.route[i]
        if each.reel and paid.most > each.reel.holds(each.radius):
            faults.add("stored-too-little", ("route", i, "reel"), value=paid.most,
                       held=each.reel.holds(each.radius))  # fmt: skip
        length = supply(spec, pieces, i)
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
        if i not in (0, last) or load.kind not in ("mass", "free", "hook"):
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
    """Whether a section of fixed length can take the cable that comes over a wheel; it may run
    through those between two."""
    sections = any(not all(spec.route[i].is_wheel for i in pair) for pair in spec.pairs)
    if model.level != 2 or model.form == "brute" or not sections or faults.errors:
        return
    if moves.way > section / 2:
        faults.add("level-2-pays-out", ("model", "level"), section=section, travel=moves.way)
    elif moves.unknown:
        faults.add("level-2-unknown", ("model", "level"), section=section, why=moves.unknown)

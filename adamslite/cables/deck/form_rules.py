"""Whether a level and form can show what a description has, and whether its sections fit."""

from adamslite.cables.description.messages import Faults
from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.brute_force_layout import length, way
from adamslite.cables.layout.geometry import FreeSpan, reaches
from adamslite.cables.model.estimate import Moves
from adamslite.cables.model.model_choice import CableModel, needs_brute
from adamslite.cables.statements.sliders import is_straight, is_wire
from adamslite.cables.vectors import add, cross, dot

# Pitches that differ by less than this share are one.
SAME_PITCH = 1e-4
# What a loop may lack of a whole number of links, as a share of one on half of a wheel.
LINK_SHARE = 0.02
# Of the sine of the angle between axes that are parallel.
ROUND_OFF = 1e-9


def check_form(spec: Spec, pieces: list[FreeSpan], model: CableModel, faults: Faults) -> None:
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
    if spec.cable.parts and (model.level == 1 or brute or spec.bends):
        faults.add("parts-form", ("cable", "parts"))
    for i, each in enumerate(spec.route):
        if each.slides and not shows_sliding:
            faults.add("slider-form", ("route", i, "slides"))
        if each.floor and not any(spec.gravity):
            faults.add("floor-where", ("route", i, "floor"))
    _check_nodes(spec, model, faults)
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
        if spec.slips_at(i):
            faults.add("rigid-cannot", ("route", i, "mu"), what="its cable cannot slip")


def _check_brute(spec: Spec, faults: Faults) -> None:
    """Whether sections can be laid round the wheels and bends, and run over the rims."""
    if not any(each.is_round for each in spec.route):
        faults.add("brute-no-wheel", ("model", "form"))
    elif not _in_plane(spec):
        faults.add("brute-plane", ("model", "form"))
    for i, each in enumerate(spec.route):
        for word in ("reel", "wander", "held", "grip"):
            if getattr(each, word):
                faults.add("brute-cannot", ("route", i, word), word=word)


def _check_nodes(spec: Spec, model: CableModel, faults: Faults) -> None:
    """Whether there are nodes for what acts on them."""
    given = {"water": spec.water, "bed": spec.bed, "bending": spec.cable.bending}
    word = next((word for word, value in given.items() if value), "")
    if not word:
        return
    path = ("cable", "bending") if word == "bending" else (word,)
    where = ""
    if model.level == 1:
        where = "a rigid cable has none"
    elif model.form == "brute" or spec.bends:
        where = "sections that run over rims or hang in bends are written without it"
    elif model.elements == 1:
        where = "one section has none between its ends"
    for p, pair in enumerate(spec.pairs):
        kinds = [spec.route[i] for i in pair]
        if all(each.is_wheel for each in kinds) or any(each.kind == "run" for each in kinds):
            where = where or f"the cable of span {p + 1} is one spring or a long run"
    if where:
        faults.add("no-nodes", path, word=word, where=where)


def _in_plane(spec: Spec) -> bool:
    """Whether all wheels and bends have one axis, and everything lies and moves across it."""
    axes = [each.axis for each in spec.route if each.is_round]
    if not axes:
        return True
    axis, origin = axes[0], spec.route[0].at
    across = [dot(cross(axis, each), cross(axis, each)) for each in axes]
    vectors = [spec.gravity, *(each.velocity for each in spec.route)]
    vectors += [add(each.at, origin, -1) for each in spec.route]
    return max(across) < ROUND_OFF**2 and all(
        abs(dot(axis, v)) <= ROUND_OFF * dot(v, v) ** 0.5 for v in vectors
    )


def check_chain(spec: Spec, pieces: list[FreeSpan], faults: Faults) -> None:
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


def check_shape(spec: Spec, pieces: list[FreeSpan], model: CableModel, faults: Faults) -> None:
    """Whether the sections fit round the bends, and only a loop runs along itself."""
    section = max(reaches(spec, pieces)) / model.elements
    for i in spec.bends:
        radius = spec.route[i].radius
        if section > 2 * radius:
            faults.add("bend-too-tight", ("route", i, "radius"), section=section, radius=radius)
    if spec.speed and not spec.closed:
        faults.add("speed-on-a-route", ("speed",))


def runs_in(spec: Spec, weight: int, wheel: int, time: float) -> str:
    """Names a weight that runs into a wheel, and when."""
    names = f"the weight of {spec.label(weight)} runs into the wheel of {spec.label(wheel)}"
    return f"{names} at TIME = {time:.4g}: the span between them has no length left"


def check_collisions(spec: Spec, pieces: list[FreeSpan], moves: Moves, faults: Faults) -> None:
    """Whether no weight at an end runs into a wheel, where it is known how the cable moves."""
    inside, n = spec.route[1:-1], len(spec.route)
    unknown = not moves.known or any(map(spec.is_end, spec.winches)) or len(moves.ways) != 1
    if unknown or any(x.gives_way or x.friction and not moves.paid for x in inside):
        return
    ways = moves.ways[0].ways
    for i, j, span, sense in (0, 1, pieces[0], 1), (n - 1, n - 2, pieces[-1], -1):
        k = next((k for k, way in enumerate(ways) if sense * way >= span.length), 0)
        if k and spec.route[i].kind in ("mass", "body"):
            what = runs_in(spec, i, j, spec.end * k / (len(ways) - 1))
            faults.add("runs-into-wheel", ("route", i, "at"), what=what)


def tell_overstretched(spec: Spec, section: float = 0.0, *, faults: Faults) -> None:
    """Why a cable cannot be laid: sections of this length are too long for a wheel, or weak."""
    round_ = [(each.radius, i) for i, each in enumerate(spec.route) if each.is_round]
    radius, i = min(round_, default=(0.0, 0))
    if section > radius > 0.0:
        faults.add("bend-too-tight", ("route", i, "radius"), section=section, radius=radius)
    else:
        faults.add("overstretched", ("cable", "EA"), stiffness=spec.cable.stiffness)

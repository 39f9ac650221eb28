"""Keys of a description about water, a sea bed and bending, and rules about them."""

from math import inf

from adamslite.cables.description.keys import NestedTable, Rules
from adamslite.cables.description.messages import Faults
from adamslite.cables.description.payout_law import parse
from adamslite.cables.description.surroundings import Bed, Drag, Water, height
from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.vectors import ZERO, add, norm

# Of its length: how far a cable can be stretched at the start.
MOST_STRETCHED = 1.5
DRAG = NestedTable(
    Drag,
    {"normal": ("number", "negative", None), "tangential": ("number", "negative", 0.0)},
)
WATER = NestedTable(
    Water,
    {
        "density": ("number", "not-positive", None),
        "level": ("number", "", inf),
        "current": ("laws", "", ("", "", "")),
        "drag": (DRAG, "", None),
        "added_mass": ("number", "negative", 0.0),
        "buoyancy": ("yes or no", "", True),
    },
)
BED = NestedTable(
    Bed,
    {
        "level": ("number", "", None),
        "stiffness": ("number", "not-positive", None),
        "damping": ("number", "negative", 0.0),
        "friction": ("number", "negative", 0.0),
        "creep": ("number", "not-positive", 1e-3),
    },
)
TOP: Rules = {
    "statics": ("yes or no", "", False),
    "water": (WATER, "", None),
    "bed": (BED, "", None),
}
CABLE: Rules = {
    "diameter": ("number", "not-positive", 0.0),
    "length": ("number", "not-positive", 0.0),
    "bending": ("number", "negative", 0.0),
    "bending_damping": ("number", "negative", 0.0),
}
FIXED: Rules = {"clamped": ("vector", "", ZERO)}


def check_surroundings(spec: Spec, faults: Faults) -> None:
    """Say which keys about water, bed and bending do not go together."""
    for word in ("water", "bed"):
        if getattr(spec, word) and not spec.cable.diameter:
            faults.add("no-diameter", (word,), word=word)
    _check_heights(spec, faults)
    if spec.cable.parts and not spec.cable.breaking:
        faults.add("parts-where", ("cable", "parts"))
    for law in filter(None, spec.water.current if spec.water else ()):
        parse(law, ("water", "current"), faults)
    _check_damping(spec, faults)
    if not spec.cable.bending:
        for i, each in enumerate(spec.route):
            if any(each.clamped):
                faults.add("no-bending", ("route", i, "clamped"), word="clamped")
    if spec.cable.length:
        _check_length(spec, faults)


def _check_damping(spec: Spec, faults: Faults) -> None:
    """The damping of the material is given once, and that of bending where there is any."""
    cable = spec.cable
    if cable.damping and cable.damping_time:
        faults.add("damped-twice", ("cable", "damping"))
    if cable.bending_damping and not cable.bending:
        faults.add("no-bending", ("cable", "bending_damping"), word="bending_damping")


def _check_heights(spec: Spec, faults: Faults) -> None:
    """There is an upwards, and what the cable goes to is not in the bed by more than its
    diameter."""
    levels = {"water": spec.water.level if spec.water else inf}
    levels["bed"] = spec.bed.level if spec.bed else inf
    for word, level in levels.items():
        if level < inf and not any(spec.gravity):
            faults.add("no-depth", (word, "level"), word=word)
    for i, each in enumerate(spec.route):
        if spec.bed and any(spec.gravity):
            depth = spec.bed.level - height(spec.gravity, each.at)
            if depth > spec.cable.diameter > 0:
                faults.add("below-bed", ("route", i, "at"), i=i + 1, depth=depth)


def _check_length(spec: Spec, faults: Faults) -> None:
    """A length is given for a cable between two points, without tension."""
    path, cable = ("cable", "length"), spec.cable
    if any(each.on for each in spec.route):  # it has a tension by its length as drawn
        if cable.pretension:
            faults.add("length-and-tension", ("cable", "pretension"))
        return
    if len(spec.route) != 2 or {each.kind for each in spec.route} != {"fixed"}:
        faults.add("length-of-what", path)
        return
    if cable.pretension:
        faults.add("length-and-tension", ("cable", "pretension"))
    spacing = norm(add(spec.route[1].at, spec.route[0].at, -1))
    if spacing > MOST_STRETCHED * cable.length:
        faults.add("length-too-short", path, length=cable.length, spacing=spacing)
    if cable.length > spacing and not any(spec.gravity):
        faults.add("no-depth", path, word="length")

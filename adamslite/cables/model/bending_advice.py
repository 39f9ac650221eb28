"""When the bending stiffness of a cable matters, and the sections that water, a bed and bending
need.

With the bending length b = sqrt(EI/T), of a taut cable without bending

    sag of a span between hinges    8 (b/l)^2 (1 - 1/cosh(l/(2 b))) too large
    the same between clamps         4 b/l: a clamp shortens the span by b
    tension beyond a wheel          EI/(2 T R^2) too large: T + EI k^2/2 is the same on both sides

H. M. Irvine, Cable Structures, 1981, section 2.7 (flexural rigidity); for wheels the integral of
the elastica.
"""

from dataclasses import replace
from math import cosh, hypot, sqrt

from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import FreeSpan, wrap
from adamslite.cables.vectors import ZERO, norm

# Above it 1/cosh is nothing.
LONG = 50.0
# A solid rod has EI = EA D^2/16.
ROD = 16
# Sections that bend; n of them sag by LUMPED/n^2 too much.
FEWEST, LUMPED = 4, 0.8
# More sections where a cable comes to lie on a bed: it does so within a section.
TOUCH_DOWN = 1.5


def losses(spec: Spec, spans: list[FreeSpan], tension: float, bending: float) -> dict[str, float]:
    """What a cable that does not resist bending gets wrong, each relative, by its name."""
    length = max(span.length for span in spans)
    if tension <= 0 or bending / tension > length**2:
        return {"its shape": 1.0}
    b = sqrt(bending / tension)
    half = length / b / 2
    found = {"its sag": 8 * (b / length) ** 2 * (1 - (1 / cosh(half) if half < LONG else 0.0))}
    if any(any(each.clamped) for each in spec.route):
        found["its sag beside a clamp"] = min(4 * b / length, 1.0)
    wheels = [each.radius for i, each in enumerate(spec.route)
              if each.is_wheel and (spec.is_end(i) or wrap(spec, spans, i))]  # fmt: skip
    if wheels:
        found["tension over wheels"] = (b / min(wheels)) ** 2 / 2
    return found


def sentences(spec: Spec, spans: list[FreeSpan], tension: float) -> list[str]:
    """Sentences about bending in the head of the deck."""
    cable = spec.cable
    bending = cable.bending or cable.stiffness * cable.diameter**2 / ROD
    if not bending:
        return []
    found = losses(spec, spans, tension, bending)
    worst = max(found, key=lambda name: found[name])
    size = f"{worst} is {found[worst]:.2g} off"
    length = f"sqrt(EI/T) = {sqrt(bending / tension):.3g} m" if tension > 0 else "no tension"
    if cable.bending:
        kept = spec.level or found[worst] >= spec.accuracy
        return [f"bending {'kept' if kept else 'left out'}: {length}, without it {size}"]
    if found[worst] < spec.accuracy:
        return []
    return [f"bending may matter: as a solid rod {length}, without it {size}: give bending = EI"]


def needs_bending(spec: Spec, spans: list[FreeSpan], tension: float) -> bool:
    """Whether what is lost without bending is more than the accuracy."""
    found = losses(spec, spans, tension, spec.cable.bending)
    return max(found.values()) >= spec.accuracy


def without(spec: Spec) -> Spec:
    """The same cable, which does not resist bending."""
    route = tuple(replace(each, clamped=ZERO) for each in spec.route)
    return replace(spec, cable=replace(spec.cable, bending=0.0, bending_damping=0.0), route=route)


def sections(spec: Spec, spans: list[FreeSpan], tension: float) -> dict[str, float]:
    """Sections of the longest span that each rule requires.

    A cable that its tension T carries with an angle w h/T from section to section has tensions that
    are (w h/T)^2/2 off; a clamp needs (h/b)^2/24.
    """
    length = spec.cable.length or max(span.length for span in spans)
    found = {}
    if spec.water or spec.bed or spec.cable.length:
        weight = abs(spec.lightness(spec.route[-1].at)) * spec.cable.density * norm(spec.gravity)
        least = tension if spec.cable.length else hypot(tension, weight * length / 2)
        turns = weight * length / least if least else 0.0
        finer = TOUCH_DOWN if spec.bed else 1.0
        found["for the curve of the cable"] = finer * turns / sqrt(2 * spec.accuracy)
    if spec.cable.bending:
        lost = max(losses(spec, spans, tension, spec.cable.bending).values())
        found["for bending"] = max(FEWEST, sqrt(LUMPED * lost / spec.accuracy))
    if any(any(each.clamped) for each in spec.route) and tension > 0:
        b = sqrt(spec.cable.bending / tension)
        found["for the bending length at a clamp"] = length / b / sqrt(24 * spec.accuracy)
    return found

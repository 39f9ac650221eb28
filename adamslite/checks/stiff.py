"""Notes about springs and bushings that are nearly joints.

    frequency   least of sqrt(eig(K W)) / (2 pi),  W = B (N^T M N)^-1 B^T
    gives way   P (1/k + L^2/kt)

W: the mobility of I against J; P: loads (:mod:`adamslite.assembly.load_scale`), L: size.

Told is what stands for very many periods in the run and gives way by very little.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any

from adamslite.checks.lints import run_end
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose
from adamslite.elements.bushing import Bushing
from adamslite.elements.part import Part
from adamslite.elements.point_mass import PointMass
from adamslite.elements.sforce import Sforce
from adamslite.elements.springdamper import Springdamper
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import GROUND_FRAME, Call, Node, Num, Op, Ref, operate

if TYPE_CHECKING:
    import numpy as np

    from adamslite.assembly.mobility import Mobility
    from adamslite.language.statement import Statement

# Periods within the run; what gives way, of the size of the model, and how many times as much as
# under the loads that are known.
PERIODS, SMALL, SWING = 10.0, 1e-3, 10.0


@dataclass(frozen=True)
class Stiff:
    """Something elastic, what it is nearly, and its stiffness along the rows of that."""

    element: Statement
    joint: str
    k: tuple[float, ...]
    kt: tuple[float, ...] = ()
    length: float = 0.0


def stiff_elements(deck: Deck) -> Iterator[Diagnostic]:
    """Bushings, springs and line forces that are nearly joints."""
    kinds = ("BUSHING", "SFORCE", "SPRINGDAMPER")
    found = looked_at(deck) if any(map(deck.of, kinds)) else ()
    elastic = _unmeasured(deck) if found else []
    if not elastic:
        return
    size, until = size_of(found[0]), run_end(deck)
    near = [each for each in elastic if _frequency(found[0], each) * until >= PERIODS]
    if not near or not size > 0.0:
        return
    from adamslite.assembly.load_scale import load_scale

    left_out = [each.element for each in near]
    load = load_scale(found[0].model, found[0].posture, size, until, left_out)
    for each in near if load else ():
        bent = 1.0 / min(each.k) + (size * size / min(each.kt) if each.kt else 0.0)
        deflection = SWING * (load or 0.0) * bent
        if deflection <= SMALL * size and _rests(found[0], each, deflection):
            yield _note(each, _frequency(found[0], each), until, deflection)


def _note(each: Stiff, frequency: float, until: float, deflection: float) -> Diagnostic:
    return diagnose(
        each.element, "stiff-bushing" if each.element.keyword == "BUSHING" else "stiff-spring",
        frequency=f"{frequency:.3g}", count=f"{frequency * until:.2g}", joint=each.joint,
        deflection=f"{deflection:.2g}",
    )  # fmt: skip


def _elastic(deck: Deck) -> Iterator[Stiff]:
    for bushing in filter(deck.is_active, deck.of(Bushing)):
        kind = _kind(bushing)
        if kind and not any((*bushing.force, *bushing.torque)):
            turning = bushing.kt if kind == "FIXED" else ()
            yield Stiff(bushing, f"JOINT/..., {kind}", bushing.k, turning)
    for spring in filter(deck.is_active, deck.of(Springdamper)):
        if spring.kind == "TRANSLATIONAL" and spring.k > 0.0:
            yield _distance(spring, spring.k, spring.length + spring.force / spring.k)
    for force in filter(deck.is_active, deck.of(Sforce)):
        law = _line(force)
        if law and not force.actiononly:
            yield _distance(force, *law)


def _distance(element: Any, k: float, length: float) -> Stiff:
    joint = f"GCON/..., FUNCTION=DM({element.i},{element.j})-{length!r}"
    return Stiff(element, joint, (k,), (), length)


def _kind(bushing: Bushing) -> str:
    """The joint that a bushing is nearly."""
    if not all(value > 0 for value in bushing.k):
        return ""
    if not any((*bushing.kt, *bushing.ct)):
        return "SPHERICAL"
    return "FIXED" if all(value > 0 for value in bushing.kt) else ""


def _line(force: Sforce) -> tuple[float, float] | None:
    """Stiffness and free length of an SFORCE that is a spring along its line, with any damping."""
    if force.kind != "TRANSLATIONAL":
        return None
    values = [_at(force.function, force, d, 0.0) for d in (0.0, 1.0, 2.0)]
    a, b, c = values
    if a is None or b is None or c is None:
        return None
    k = a - b
    straight = abs(a - 2.0 * b + c) <= 1e-9 * abs(k)
    return (k, a / k) if straight and k > 0.0 and a > 0.0 else None


def _at(node: Node, force: Sforce, distance: float, rate: float) -> float | None:
    """The value of a function of the distance of the markers and of its rate; None of any other."""
    match node:
        case Num(value):
            return value
        case Op(op, args):
            values = [_at(arg, force, distance, rate) for arg in args]
            known = [value for value in values if value is not None]
            return operate(op, known) if len(known) == len(values) else None
        case Call(("DM" | "VR") as name, (Ref(_, i), Ref(_, j), *frame)) if {i, j} == {
            force.i,
            force.j,
        } and frame in ([], [GROUND_FRAME]):
            return distance if name == "DM" else rate
    return None


def _unmeasured(deck: Deck) -> list[Stiff]:
    """Those elastic elements that nothing refers to."""
    from adamslite.model.mergeable import referred

    found = list(_elastic(deck))
    named = (
        {each for statement in deck.statements for each in referred(statement)} if found else set()
    )
    return [each for each in found if (each.element.keyword, each.element.key) not in named]


def _rows(mobility: Mobility, each: Stiff) -> np.ndarray:
    """B (r, f): the motions of I against J along the axes of J, or along the line between them."""
    import numpy as np

    from adamslite.elements.bases.joint_coordinates import pose

    i, j = each.element.i, each.element.j  # type: ignore[attr-defined]
    (at, _), (place, axes) = pose(mobility.model, i), pose(mobility.model, j)
    ends = [mobility.model.marker(key) for key in (i, j)]
    if each.element.keyword == "BUSHING":
        apart = mobility.carried(ends[0].body, place) - mobility.carried(ends[1].body, place)
        return np.concatenate([axes.T @ apart[:3], axes.T @ apart[3:]])[: len(each.k + each.kt)]
    line = at - place
    line = line / max(float(np.linalg.norm(line)), 1e-300)
    apart = mobility.carried(ends[0].body, at) - mobility.carried(ends[1].body, place)
    return (line @ apart[:3])[None]


def _frequency(mobility: Mobility, each: Stiff) -> float:
    """The lowest frequency with which it gives way, 0 where nothing may."""
    import numpy as np

    model, N, B = mobility.model, mobility.motions, _rows(mobility, each)
    M = N.T @ mobility.mass(range(len(model.bodies))) @ N
    K = np.sqrt(np.array(each.k + each.kt))
    try:
        W = B @ np.linalg.solve(M, B.T)
    except np.linalg.LinAlgError:
        return 0.0
    squares = np.linalg.eigvalsh(K[:, None] * W * K)
    moving = squares[squares > 1e-9 * squares.max(initial=0.0)]
    return float(moving.min(initial=np.inf) ** 0.5 / (2 * pi)) if moving.size else 0.0


def _rests(mobility: Mobility, each: Stiff, deflection: float) -> bool:
    """Whether it is drawn no farther from rest than it gives way."""
    import numpy as np

    from adamslite.elements.bases.joint_coordinates import pose

    i, j = each.element.i, each.element.j  # type: ignore[attr-defined]
    (at, turned), (place, axes) = pose(mobility.model, i), pose(mobility.model, j)
    apart = float(np.linalg.norm(at - place))
    if each.element.keyword == "BUSHING":
        twist = axes.T @ turned
        open_ = float(np.abs(twist - np.eye(3)).max()) if each.kt else 0.0
        return apart <= deflection and open_ * size_of(mobility) <= deflection
    return each.length > 0.0 and abs(apart - each.length) <= deflection


KEYWORDS = ("BUSHING", "JOINT", "SFORCE", "SPRINGDAMPER")


def looked_at(deck: Deck) -> tuple[Mobility, ...]:
    """What the constraints allow, of decks that run."""
    if not run_end(deck) or len(deck.of(Part)) < 2 or deck.user.called:
        return ()
    if not any(map(deck.of, KEYWORDS)) or deck.of(PointMass):
        return ()
    import numpy as np

    from adamslite.assembly.mobility import MOST_BODIES, mobilities

    if sum(not part.ground for part in deck.of(Part)) > MOST_BODIES:
        return ()

    with np.errstate(all="ignore"):
        found = mobilities(deck)
    return found if all(np.isfinite(each.motions).all() for each in found) else ()


def places_of(mobility: Mobility) -> list[np.ndarray]:
    """Mass centres, and markers of elements, in ground."""
    from adamslite.elements.bases.joint_coordinates import pose

    model = mobility.model
    used = [each for keyword in KEYWORDS for each in model.deck.of(keyword)]
    ends = {key for each in used for key in (each.i, each.j)}
    return [*mobility.posture.x, *(pose(model, key)[0] for key in sorted(ends, key=str))]


def size_of(mobility: Mobility) -> float:
    """The extent of these places; 0 where all are one."""
    import numpy as np

    return float(np.ptp(np.array(places_of(mobility)), axis=0).max())

"""Which parts may be one body: those that FIXED holds together, and nothing speaks against it.

Left apart are parts

    that are drawn or start apart          a run closes the joint first and changes speeds
    in a loop, or joined in another way    what each joint carries is not determined
    whose joint is measured or changed     by a force, a sensor, a REQUEST: it is an unknown there
    of which two have loads that cannot    gears, curves, frictions, general constraints; where it
    be measured                            is one, that part leads
    that touch others                      the law of a CONTACT may know the mass of a part
    on which very many elements act        their sum is one expression
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.bases.joint_coordinates import pose
from adamslite.elements.joint import Joint
from adamslite.elements.marker import Marker
from adamslite.language.expression import Call, Ref, walk
from adamslite.language.statement import expressions
from adamslite.model.net_force import ends

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Statement
    from adamslite.model.model import Body, Model

PartKey = tuple[str, "Key"]
GROUND: PartKey = ("PART", "GROUND")
# Of the size of the model, and of speeds: what is smaller is round-off of the deck's numbers.
APART = 1e-11
#: Elements of which each end is measured by itself, about its own marker.
MEASURED = frozenset({
    "BEAM", "BUSHING", "FIELD", "GFORCE", "JOINT", "JPRIM", "MOTION", "SFORCE", "SPRINGDAMPER",
    "VFORCE", "VTORQUE",
})  # fmt: skip
#: Elements on parts that are one body: what a joint carries is the sum of their expressions.
MOST = 40
STARTS = {"JOINT": ("ic", "ictran", "icrot"), "MOTION": ("icdisp", "icvel"), "PTCV": ("velocity",)}


@dataclass(frozen=True)
class Group:
    """Parts that are one body, the joints that hold them, and the part that leads them."""

    parts: frozenset[PartKey]
    joints: tuple[Joint, ...]
    leader: PartKey


def found_groups(model: Model) -> list[Group]:
    """The groups of parts that may be one body."""
    deck = model.deck
    fixed = [j for j in deck.of(Joint) if j.kind == "FIXED" and model.acts(j)]
    if not fixed or deck.user.called or any(map(_starts_with_conditions, deck.statements)):
        return []
    measured = _measured_joints(deck, fixed)
    acting = [_acting_on(deck, s) for s in deck.statements if _exerts(s) and model.acts(s)]
    found = []
    for joints in _connected(deck, fixed):
        parts = frozenset(_end(deck, m) for j in joints for m in (j.i, j.j))
        free = not measured.intersection(joints) and len(parts) == len(joints) + 1
        if free and _is_one_posture(model, parts, joints):
            leader = _leader(model, parts, joints, acting)
            found += [Group(parts, joints, leader)] if leader else []
    return found


def owner_of(deck: Deck, marker: Key) -> PartKey:
    """Keyword and id of the body of a marker; ground for 0."""
    owner = deck.get(Marker, marker).owner if marker else GROUND
    assert owner is not None  # a rule asks for it
    return owner


def is_ground(deck: Deck, part: PartKey) -> bool:
    """Whether a body is the ground."""
    return part == GROUND or bool(getattr(deck.find(*part), "ground", False))


def _end(deck: Deck, marker: Key) -> PartKey:
    owner = owner_of(deck, marker)
    return GROUND if is_ground(deck, owner) else owner


def _starts_with_conditions(statement: Statement) -> bool:
    fields = STARTS.get(statement.keyword, ())
    if statement.keyword == "MOTION" and getattr(statement, "level", "") == "ACCELERATION":
        return True
    return any(getattr(statement, field) is not None for field in fields)


def _connected(deck: Deck, fixed: list[Joint]) -> Iterator[tuple[Joint, ...]]:
    """Joints of the same group of parts; ground does not connect."""
    of: dict[PartKey, int] = {}
    joints: list[list[Joint]] = []
    for joint in fixed:
        own = [part for part in (_end(deck, joint.i), _end(deck, joint.j)) if part != GROUND]
        known = sorted({of[part] for part in own if part in of})
        at = known[0] if known else len(joints)
        if not known:
            joints.append([])
        joints[at].append(joint)
        for other in known[1:]:
            joints[at] += joints[other]
            joints[other] = []
        for part in of:
            of[part] = at if of[part] in known else of[part]
        of |= dict.fromkeys(own, at)
    yield from (tuple(each) for each in joints if each)


# ---- what is asked of a joint ------------------------------------------------------------------


def _measured_joints(deck: Deck, fixed: list[Joint]) -> set[Joint]:
    """Joints whose force or whose statement something else takes."""
    from adamslite.functions.forces import NET

    by_key = {joint.key: joint for joint in fixed}
    at = {marker: joint for joint in fixed for marker in (joint.i, joint.j)}
    found: set[Joint] = set()
    for statement in deck.statements:
        for keyword, key in referred(statement):
            if keyword == "JOINT" and key in by_key:
                found.add(by_key[key])
        if statement.keyword in ("REQUEST", "MREQUEST") and statement.given("kind"):
            keys = {key for keyword, key in referred(statement) if keyword == "MARKER"}
            if statement.kind == "FORCE":  # type: ignore[attr-defined]
                found |= {at[key] for key in keys & at.keys()}
        for call in (each for node in expressions(statement) for each in walk(node)):
            if isinstance(call, Call) and call.name in NET:
                refs = {ref.id for ref in call.args if isinstance(ref, Ref)}
                found |= {at[key] for key in refs & at.keys()}
    return found


def referred(statement: Statement) -> Iterator[tuple[str, Key]]:
    """Keyword and id of all that a statement names."""
    for field, argument in statement.arguments.items():
        value = getattr(statement, field)
        if value is None or value == 0:
            continue
        if argument.kind == "expression":
            yield from ((r.kind, r.id) for r in walk(value) if isinstance(r, Ref) and r.id)
        elif argument.to:
            keys = value if argument.kind == "references" else (value,)
            yield from ((argument.to, key) for key in keys if key)


# ---- what acts on the parts --------------------------------------------------------------------


@dataclass(frozen=True)
class Acting:
    """An element that exerts loads: on which bodies, and those on which it cannot be measured."""

    element: Statement
    bodies: frozenset[PartKey]
    unmeasured: frozenset[PartKey]


def _exerts(statement: Statement) -> bool:
    found = hasattr(statement, "loads") or isinstance(statement, Constraint)
    return found or statement.keyword == "CONTACT"  # which has its points do it


def _acting_on(deck: Deck, element: Statement) -> Acting:
    if element.keyword not in MEASURED:
        reached = frozenset(_reached(deck, element, set()))
        return Acting(element, reached, reached)
    keys = ends(deck, element)
    bodies = [_end(deck, key) for key in keys if key is not None]
    beside = []
    if getattr(element, "j_part", None) is not None:
        beside.append(("PART", element.j_part))  # type: ignore[attr-defined]
    if getattr(element, "jfloat", None) is not None:
        beside.append(bodies[-1])
    beside = [GROUND if is_ground(deck, part) else part for part in beside]
    return Acting(element, frozenset([*bodies, *beside]), frozenset(beside))


def _reached(deck: Deck, statement: Statement, seen: set[PartKey]) -> Iterator[PartKey]:
    """The bodies of all markers that a statement names, itself or through others."""
    for keyword, key in referred(statement):
        if (keyword, key) in seen:
            continue
        seen.add((keyword, key))
        if keyword == "MARKER":
            yield _end(deck, key)
        elif keyword in ("PART", "POINT_MASS"):
            yield GROUND if is_ground(deck, (keyword, key)) else (keyword, key)
        elif (other := deck.find(keyword, key)) is not None:
            yield from _reached(deck, other, seen)


def _leader(
    model: Model, parts: frozenset[PartKey], joints: tuple[Statement, ...], acting: list[Acting]
) -> PartKey | None:
    """The part whose loads need not be known: ground, else the one on which acts what cannot be
    measured, else the heaviest; None where there is no such part.
    """
    leaders = set(parts & {GROUND})
    others = [each for each in acting if each.element not in joints and each.bodies & parts]
    if len(others) > MOST:
        return None
    for each in others:
        if isinstance(each.element, Constraint) and len(each.bodies & parts) > 1:
            return None
        if each.element.keyword == "CONTACT" and each.bodies & parts - {GROUND}:
            return None  # its law may depend on the masses of the parts
        leaders |= each.unmeasured & parts
    if len(leaders) > 1:
        return None
    masses = {part: model.bodies[model.body_index[part]].mass for part in parts - {GROUND}}
    if not sum(masses.values()) > 0.0:
        return None
    return leaders.pop() if leaders else max(masses, key=lambda part: masses[part])


# ---- posture and speeds ------------------------------------------------------------------------


def _is_one_posture(model: Model, parts: Iterable[PartKey], joints: Iterable[Joint]) -> bool:
    """Whether the parts are drawn, and start, as one rigid body."""
    bodies = [model.bodies[model.body_index[part]] for part in parts if part != GROUND]
    if any(b.statement.keyword != "PART" or b.statement.exact for b in bodies):  # type: ignore[union-attr]
        return False
    size = max(float(np.abs([b.x for b in model.bodies]).max()), _spread(bodies))
    for joint in joints:
        (x, a), (y, b) = (pose(model, marker) for marker in (joint.i, joint.j))
        turned = a.T @ b
        open_ = np.abs(turned - np.diag(np.round(np.diag(turned)))).max()
        if not (np.abs(x - y).max() <= APART * size and open_ <= APART):
            return False
    first = bodies[0]
    still = GROUND in parts
    fastest = max(float(np.abs([*b.v, *(b.w * size)]).max()) for b in bodies)
    for each in bodies:
        w = np.zeros(3) if still else first.w
        v = np.zeros(3) if still else first.v + np.cross(w, each.x - first.x)
        if np.abs([*(each.v - v), *((each.w - w) * size)]).max() > APART * fastest:
            return False
    return True


def _spread(bodies: list[Body]) -> float:
    return max(float(np.abs(b.x - bodies[0].x).max()) for b in bodies)

"""Which parts may be one body: those that FIXED holds together, and nothing speaks against it.

Left apart are parts

    that are drawn or start apart          a run closes the joint first and changes speeds
    in a loop, or joined in another way    what each joint carries is not determined
    whose joint's reaction acts            on a force, a motion, a state: it is an unknown there.
                                           One that is only watched (REQUEST, SENSOR) is written out
    of which two have loads that cannot    curves, frictions; where it is one, that part leads
    be measured
    that bounce off others                 a CONTACT with POISSON knows the masses of the parts
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
#: Constraints measured at every marker that they name, themselves or through others.
AT_MARKERS = frozenset({"COUPLER", "GCON", "GEAR"})
#: What acts on nothing, of which VARIABLEs are another kind.
WATCHING = frozenset({"GRAPHICS", "MREQUEST", "REQUEST", "SENSOR"})
#: Elements on parts that are one body, and parts behind a joint that is watched: what a joint
#: carries is the sum of their expressions.
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
    acted_on, watched = _measured_joints(model, fixed)
    acting = [_acting_on(deck, s) for s in deck.statements if _exerts(s) and model.acts(s)]
    found = []
    for joints in _connected(deck, fixed):
        parts = frozenset(_end(deck, m) for j in joints for m in (j.i, j.j))
        free = not acted_on.intersection(joints) and len(parts) == len(joints) + 1
        free &= len(parts) <= MOST or not watched.intersection(joints)
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


def _measured_joints(model: Model, fixed: list[Joint]) -> tuple[set[Joint], set[Joint]]:
    """Joints whose reaction or whose statement something takes that acts on the model itself, and
    those of which it is only looked at.
    """
    deck = model.deck
    by_key = {joint.key: joint for joint in fixed}
    at = {marker: joint for joint in fixed for marker in (joint.i, joint.j)}
    acted_on: set[Joint] = set()
    watched: set[Joint] = set()
    for statement in deck.statements:
        found = set(_joints_of(statement, by_key, at))
        if found:
            (watched if _only_watches(model, statement) else acted_on).update(found)
    return acted_on, watched


def _joints_of(
    statement: Statement, by_key: dict[Key, Joint], at: dict[Key, Joint]
) -> Iterator[Joint]:
    """The joints that a statement names, and those whose reaction is part of the net force at a
    marker.
    """
    from adamslite.functions.forces import NET

    named = list(referred(statement))
    yield from (by_key[key] for keyword, key in named if keyword == "JOINT" and key in by_key)
    if statement.keyword in ("REQUEST", "MREQUEST") and getattr(statement, "kind", "") == "FORCE":
        yield from (at[key] for keyword, key in named if keyword == "MARKER" and key in at)
    for call in (each for node in expressions(statement) for each in walk(node)):
        if isinstance(call, Call) and call.name in NET:
            refs = {ref.id for ref in call.args if isinstance(ref, Ref)}
            yield from (at[key] for key in refs & at.keys())


def _only_watches(model: Model, statement: Statement) -> bool:
    """Whether nothing of the model depends on a statement, through VARIABLEs neither."""
    if statement.keyword in WATCHING:
        return True
    if statement.keyword != "VARIABLE" or model.variable_kind(statement.key) != "inline":
        return False
    own = ("VARIABLE", statement.key)
    users = [each for each in model.deck.statements if own in set(referred(each))]
    return all(_only_watches(model, each) for each in users)


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
    if element.keyword in AT_MARKERS and not _names_parts(deck, element):
        owners = frozenset(_end(deck, key) for key in markers_of(deck, element))
        return Acting(element, owners, frozenset())
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
    for keyword, key in _named(deck, statement, seen):
        if keyword == "MARKER":
            yield _end(deck, key)
        elif keyword in ("PART", "POINT_MASS"):
            yield GROUND if is_ground(deck, (keyword, key)) else (keyword, key)


def _named(deck: Deck, statement: Statement, seen: set[PartKey]) -> Iterator[PartKey]:
    """Keyword and id of all that a statement names, itself or through others but markers."""
    for each in referred(statement):
        if each in seen:
            continue
        seen.add(each)
        yield each
        other = None if each[0] in ("MARKER", "PART", "POINT_MASS") else deck.find(*each)
        if other is not None:
            yield from _named(deck, other, seen)


def markers_of(deck: Deck, constraint: Statement) -> list[Key]:
    """The markers that a constraint names, itself or through others, in the order of the deck."""
    return [key for keyword, key in _named(deck, constraint, set()) if keyword == "MARKER"]


def _names_parts(deck: Deck, constraint: Statement) -> bool:
    names = _named(deck, constraint, set())
    return any(keyword in ("PART", "POINT_MASS") for keyword, _ in names)


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
        if isinstance(each.element, Constraint) and _holds_inside(each, parts):
            return None
        if getattr(each.element, "law", "") == "POISSON" and each.bodies & parts - {GROUND}:
            return None  # it depends on the masses of the parts
        leaders |= each.unmeasured & parts
    if len(leaders) > 1:
        return None
    masses = {part: model.bodies[model.body_index[part]].mass for part in parts - {GROUND}}
    if GROUND not in parts and not sum(masses.values()) > 0.0:
        return None
    return leaders.pop() if leaders else max(masses, key=lambda part: masses[part])


def _holds_inside(acting: Acting, parts: frozenset[PartKey]) -> bool:
    """Whether a constraint holds parts of one body, or ties it in a way that cannot be measured."""
    if acting.element.keyword in AT_MARKERS:
        return acting.bodies <= parts
    return len(acting.bodies & parts) > 1


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

"""Parts that JOINT/FIXED holds together move as one body.

A body B of parts p has, about its mass centre and along the axes of the part that leads it,

    m = sum m_p        m x = sum m_p x_p        J = sum (J_p + m_p (|d|^2 1 - d d^T)),  d = x_p - x

Parts FIXED to ground are no bodies.  What a joint inside a body carries is no unknown any more; it
follows from the equations of the parts S that hang on it (d'Alembert), about the origin of I:

    on S    force  = sum m_p (a_p - g) - sum F,    torque = sum (dL_p/dt + r m_p (a_p - g)) - sum T

F and T are the loads of all elements between S and the rest.  Here these are written out as
expressions; :mod:`adamslite.equations.merged_columns` adds the inertia to what the joint itself
writes.  Where a REQUEST or a SENSOR takes the reaction, the inertia is written out with it
(:mod:`adamslite.functions.held`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from adamslite.elements.joint import Joint
from adamslite.functions.held import AT, HELD
from adamslite.language.expression import COMPONENTS, GROUND_FRAME, Call, Num, Op, Ref, measure
from adamslite.model.geometry import IDENTITY, Place, frame_axes
from adamslite.model.mergeable import (
    AT_MARKERS,
    GROUND,
    Group,
    found_groups,
    is_ground,
    markers_of,
    owner_of,
)
from adamslite.model.model import Body, Model
from adamslite.model.net_force import component_of, ends, total
from adamslite.model.reduction import MERGED

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.elements.part import Part
    from adamslite.elements.point_mass import PointMass
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Statement
    from adamslite.model.model import MassCentre

PartKey = tuple[str, "Key"]
#: Numbers of the first components of a force and of a torque.
FX, TX = COMPONENTS[0], COMPONENTS[3]


@dataclass(frozen=True)
class Member:
    """A part of a body: ``p`` (3,) its frame from the mass centre of the body, ``axes`` (3, 3) its
    own; both in the axes of the body, or in ground for a part that ground holds.
    """

    body: int
    p: np.ndarray
    axes: np.ndarray


@dataclass(frozen=True)
class Cut:
    """A joint inside a body.

    ``child``, ``parent``: the part that it carries, and the one towards the leader; ``parts``: all
    that hang on it; ``sign``: 1 where I is on them, -1 where J is.
    """

    child: PartKey
    parent: PartKey
    parts: frozenset[PartKey]
    sign: int


class MergedModel(Model):
    """A model in which parts that are held together are one body.

    Attributes
    ----------
    members : dict
        The parts of such bodies, by keyword and id.
    cuts : dict
        Their joints, the outermost first.
    alone : dict
        Every part with its own mass, inertia and posture, as if nothing held it.
    """

    merges_parts = True

    def __init__(self, drawn: Model, groups: list[Group]) -> None:
        super().__init__(drawn.deck, drawn.without)
        self.members: dict[PartKey, Member] = {}
        self.cuts: dict[PartKey, Cut] = {}
        self.alone = {(b.statement.keyword, b.statement.key): b for b in drawn.bodies}
        self.places.clear()
        of_part = {part: group for group in groups for part in group.parts if part != GROUND}
        self.bodies, self.body_index = [], {}
        for part, body in self.alone.items():
            group = of_part.get(part)
            if group is None:
                self.body_index[part] = len(self.bodies)
                self.bodies.append(body)
            elif group.leader == part:
                self._merge(group)
        for group in groups:
            if group.leader == GROUND:
                self._hold(group)
            self.cuts.update(_cuts(self.deck, group))
        self.constraints = [c for c in self.constraints if ("JOINT", c.key) not in self.cuts
                            or c.keyword != "JOINT"]  # fmt: skip
        self.held = {(s.keyword, s.key) for s in self.constraints}

    def _merge(self, group: Group) -> None:
        number, made = len(self.bodies), united([self.alone[part] for part in group.parts],
                                                self.alone[group.leader])  # fmt: skip
        self.bodies.append(made)
        for part in group.parts:
            self.body_index[part] = number
            origin, axes = self._frame(part)
            p = made.attitude.T @ (origin - made.x)
            turned = IDENTITY if part == group.leader else made.attitude.T @ axes
            self.members[part] = Member(number, p, turned)

    def _hold(self, group: Group) -> None:
        for part in group.parts - {GROUND}:
            self.members[part] = Member(-1, *self._frame(part))

    def _frame(self, part: PartKey) -> tuple[np.ndarray, np.ndarray]:
        statement = self.deck.find(*part)
        origin = np.asarray(statement.qg, dtype=float)
        return origin, frame_axes(statement, origin)

    def _place(self, marker_id: Key | MassCentre) -> Place | None:
        part = marker_id if isinstance(marker_id, tuple) else owner_of(self.deck, marker_id)
        member = self.members.get(part)
        if member is None or (member.body < 0 and not isinstance(marker_id, tuple)):
            return super()._place(marker_id)
        at = self.mass_centre_in_part(part) if isinstance(marker_id, tuple) else None
        origin, axes = at or self.marker_in_body(marker_id)  # type: ignore[arg-type]
        if member.body < 0:
            return Place("ground", -1, member.p + member.axes @ origin, member.axes @ axes)
        return Place("part", member.body, member.p + member.axes @ origin, member.axes @ axes)

    def mass_centre_in_part(self, part: PartKey) -> tuple[np.ndarray, np.ndarray]:
        """Its place in the frame of the part, and the axes of that frame."""
        return self.marker_in_body(self.alone[part].statement.cm)[0], IDENTITY

    def merges(self, statement: Statement) -> bool:
        """Whether a constraint is one that holds parts of one body together."""
        return (statement.keyword, statement.key) in self.cuts

    def outputs_of(self, statement: Statement) -> list[Node]:
        """What a statement writes; of a joint inside a body the loads on the parts behind it."""
        if not self.merges(statement):
            return super().outputs_of(statement)
        joint = self.deck.get(Joint, statement.key)
        return [self._load_on(self.cuts["JOINT", joint.key].parts, joint.i, component, GROUND_FRAME)
                for component in COMPONENTS]  # fmt: skip

    def written_out(self, call: Call) -> Node | None:
        """The net force at a marker, and the reaction of a joint inside a body."""
        joint = call.args[0] if call.name == "JOINT" else None
        if isinstance(joint, Ref) and ("JOINT", joint.id) in self.cuts:
            return self._reaction(call)
        return super().written_out(call)

    def _reaction(self, call: Call) -> Node:
        """JOINT(id, jflag, comp, rm) from the parts behind a joint."""
        own, jflag, number, axes = call.args
        assert isinstance(own, Ref) and isinstance(jflag, Num) and isinstance(number, Num)
        assert isinstance(axes, Ref)
        joint, cut = self.deck.get(Joint, own.id), self.cuts["JOINT", own.id]
        turned = cut.sign * (-1 if jflag.value else 1) < 0

        def along(component: int) -> Node:
            terms = [self._held(part, joint.i, component, axes) for part in sorted(cut.parts)]
            load = self._load_on(cut.parts, joint.i, component, axes)
            return Op("-", (load, total(terms)) if turned else (total(terms), load))

        return component_of(int(number.value), along)

    def _held(self, part: PartKey, about: Key, component: int, axes: Ref) -> Node:
        """What a part needs in order to move as it does."""
        body = self.alone[part]
        numbers = (body.mass, *body.inertia[np.triu_indices(3)], *self.deck.gravity, component)
        frames = (Ref("MARKER", part), Ref("MARKER", about))  # type: ignore[arg-type]
        return Call(HELD, (*frames, *(Num(float(each)) for each in numbers), axes))

    def _load_on(self, parts: frozenset[PartKey], about: Key, component: int, axes: Ref) -> Node:
        """A component, along some axes, of the loads of elements between parts and the rest: of
        their force, or of their torque about a marker.
        """
        terms: list[Node] = []
        for element, ends_of in self._acting:
            on = [end for end in ends_of if end.owner in parts]
            if len(on) == len(ends_of):
                continue
            for end in on:
                own = Ref(element.keyword, element.key)
                terms += _carried_to(about, end.marker, component, axes, end.loads(own, axes))
        return total(terms)

    @cached_property
    def _acting(self) -> list[tuple[Statement, list[End]]]:
        """Elements that act, with their ends."""
        from adamslite.functions.forces import MEASURES

        found = (each for each in self.deck.statements if each.keyword in MEASURES)
        return [
            (each, list(_ends(self.deck, each)))
            for each in found
            if self.acts(each) and not self.merges(each)
        ]

    @property
    def moving(self) -> list[Part | PointMass]:
        """Every part, those of one body one by one."""
        return [body.statement for body in self.alone.values()]


def united(bodies: list[Body], leader: Body) -> Body:
    """Bodies that move as one, along the axes of the leader."""
    mass = sum(each.mass for each in bodies)
    x = np.sum([each.mass * (each.x - leader.x) for each in bodies], axis=0) / mass + leader.x
    inertia = np.zeros((3, 3))
    for each in bodies:
        turned, d = leader.attitude.T @ each.attitude, leader.attitude.T @ (each.x - x)
        own = each.inertia if each is leader else turned @ each.inertia @ turned.T
        inertia += own + each.mass * (d @ d * IDENTITY - np.outer(d, d))
    v = leader.v + np.cross(leader.w, x - leader.x)
    return replace(leader, mass=mass, inertia=inertia, x=x, v=v)


def _cuts(deck: Deck, group: Group) -> Iterator[tuple[PartKey, Cut]]:
    """The joints of a body, the outermost first."""
    at: dict[PartKey, list[Joint]] = {part: [] for part in group.parts}
    for joint in group.joints:
        for marker in (joint.i, joint.j):
            at[_node(deck, marker)].append(joint)
    outwards: list[tuple[Joint, PartKey, PartKey]] = []
    front, known = [group.leader], {group.leader}
    while front:
        part = front.pop()
        for joint in at[part]:
            (child,) = {_node(deck, joint.i), _node(deck, joint.j)} - {part}
            if child not in known:
                known.add(child)
                front.append(child)
                outwards.append((joint, child, part))
    behind = {part: {part} for part in group.parts}
    for joint, child, part in reversed(outwards):
        behind[part] |= behind[child]
        sign = 1 if _node(deck, joint.i) == child else -1
        yield ("JOINT", joint.key), Cut(child, part, frozenset(behind[child]), sign)


def _node(deck: Deck, marker: Key) -> PartKey:
    owner = owner_of(deck, marker)
    return GROUND if is_ground(deck, owner) else owner


@dataclass(frozen=True)
class End:
    """A marker at which an element is measured, None for one that is no marker, and its body.

    ``jflag``: 0 or 1 of elements between two markers, None of those that have any number.
    """

    element: Statement
    marker: Key | None
    owner: PartKey | None
    jflag: int | None

    def loads(self, own: Ref, axes: Ref) -> Callable[[int], Node]:
        """The components of the load there."""
        from adamslite.functions.forces import MEASURES

        if self.jflag is None:
            at = Ref("MARKER", self.marker or 0)
            return lambda n: Call(AT, (own, at, Num(n), axes))
        flag, name = self.jflag, MEASURES[self.element.keyword]
        return lambda n: measure(name, own, n, axes, flag)


def _ends(deck: Deck, element: Statement) -> Iterator[End]:
    if element.keyword in AT_MARKERS:
        for key in markers_of(deck, element):
            yield End(element, key, owner_of(deck, key), None)
        return
    for jflag, marker in enumerate(ends(deck, element)):
        owner = None if marker is None else owner_of(deck, marker)
        yield End(element, marker, owner, jflag)


def _carried_to(
    about: Key, at: Key | None, component: int, axes: Ref, load: Callable[[int], Node]
) -> list[Node]:
    """A component of a load, of its torque about another marker."""
    assert at is not None
    if component <= FX + 2:
        return [load(component)]
    n = component - TX
    a, b = (n + 1) % 3, (n + 2) % 3
    arm: list[Node] = [Call(f"D{axis}", (Ref("MARKER", at), Ref("MARKER", about), axes))
                       for axis in "XYZ"]  # fmt: skip
    moment = Op("-", (Op("*", (arm[a], load(FX + b))), Op("*", (arm[b], load(FX + a)))))
    return [load(component), moment]


def merged(model: Model) -> Model:
    """A model with the parts that FIXED holds together as one body, where results stay the same."""
    groups = [] if MERGED in model.without else found_groups(model)
    held = sum(len(g.parts) - 1 for g in groups)
    return MergedModel(model, groups) if groups and held < len(model.bodies) else model

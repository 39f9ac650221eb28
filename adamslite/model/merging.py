"""Parts that JOINT/FIXED holds together move as one body.

A body B of parts p has, about its mass centre and along the axes of the part that leads it,

    m = sum m_p        m x = sum m_p x_p        J = sum (J_p + m_p (|d|^2 1 - d d^T)),  d = x_p - x

Parts FIXED to ground are no bodies.  What a joint inside a body carries is no unknown any more; it
follows from the equations of the parts S that hang on it (d'Alembert), about the origin of I:

    on S    force  = sum m_p (a_p - g) - sum F,    torque = sum (dL_p/dt + r m_p (a_p - g)) - sum T

F and T are the loads of all elements between S and the rest.  Here these are written out as
expressions; :mod:`adamslite.equations.merged_columns` adds the inertia.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from adamslite.elements.joint import Joint
from adamslite.language.expression import COMPONENTS, GROUND_FRAME, Call, Op, Ref, measure
from adamslite.model.geometry import IDENTITY, Place, frame_axes
from adamslite.model.mergeable import GROUND, Group, found_groups, is_ground, owner_of
from adamslite.model.model import Body, Model
from adamslite.model.net_force import ends, total
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
        if member is None or member.body < 0:
            return super()._place(marker_id)
        at = self.mass_centre_in_part(part) if isinstance(marker_id, tuple) else None
        origin, axes = at or self.marker_in_body(marker_id)  # type: ignore[arg-type]
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
        return _loads_on(self.deck, self._acting, self.cuts["JOINT", joint.key].parts, joint.i)

    @cached_property
    def _acting(self) -> list[tuple[Statement, list[PartKey | None]]]:
        """Elements that act, with the bodies of their markers."""
        from adamslite.functions.forces import MEASURES

        found = (each for each in self.deck.statements if each.keyword in MEASURES)
        return [
            (
                each,
                [
                    None if key is None else owner_of(self.deck, key)
                    for key in ends(self.deck, each)
                ],
            )
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


def _loads_on(
    deck: Deck,
    acting: Iterable[tuple[Statement, list[PartKey | None]]],
    parts: frozenset[PartKey],
    about: Key,
) -> list[Node]:
    """Force and torque about a marker, along ground axes, of the elements between parts and the
    rest.
    """
    from adamslite.functions.forces import MEASURES

    forces: list[list[Node]] = [[] for _ in COMPONENTS]
    for element, owners in acting:
        on = [owner in parts for owner in owners]
        if on[0] == on[1]:
            continue
        jflag = on.index(True)
        at = ends(deck, element)[jflag]
        assert at is not None
        name, own = MEASURES[element.keyword], Ref(element.keyword, element.key)
        load: list[Node] = [measure(name, own, n, GROUND_FRAME, jflag) for n in COMPONENTS]
        arm = [Call(f"D{axis}", (Ref("MARKER", at), Ref("MARKER", about), GROUND_FRAME))
               for axis in "XYZ"]  # fmt: skip
        for n in range(3):
            a, b = (n + 1) % 3, (n + 2) % 3
            moment = Op("-", (Op("*", (arm[a], load[b])), Op("*", (arm[b], load[a]))))
            forces[n].append(load[n])
            forces[n + 3].append(Op("+", (load[n + 3], moment)))
    return [total(terms) for terms in forces]


def merged(model: Model) -> Model:
    """A model with the parts that FIXED holds together as one body, where results stay the same."""
    groups = [] if MERGED in model.without else found_groups(model)
    held = sum(len(g.parts) - 1 for g in groups)
    return MergedModel(model, groups) if groups and held < len(model.bodies) else model

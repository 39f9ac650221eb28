"""Values of expressions in the posture of the deck, without compiling anything.

Everything is at rest in the posture of the deck: rates and accelerations are zero. What a run would
have to find (reactions, forces that are measured) is :class:`Unknown`; what a constraint prescribes
as a function of time is computed from that constraint.
"""

from collections import ChainMap
from collections.abc import Callable, Iterator
from functools import partial
from math import atan2, isnan, nan

from adamslite.cables.description.payout_law import Unknown, evaluate
from adamslite.cables.vectors import AXES, ZERO, Vector, add, dot, norm
from adamslite.deck.deck import Deck
from adamslite.elements.diff import Diff
from adamslite.elements.gcon import Gcon
from adamslite.elements.joint import Joint
from adamslite.elements.marker import Marker
from adamslite.elements.motion import Motion
from adamslite.elements.part import Part
from adamslite.elements.point_mass import PointMass
from adamslite.elements.variable import Variable
from adamslite.language.expression import Call, Node, Ref, Time, calls, walk
from adamslite.language.interfaces import Key
from adamslite.model.cycles import behind_others

Body = tuple[str, Key]
"""Keyword and id."""
Axes = tuple[Vector, Vector, Vector]
Law = Callable[[], float]

GROUND: Body = ("PART", "ground")
STILL = frozenset("VM VX VY VZ VR WM WX WY WZ ACCM ACCX ACCY ACCZ WDTM WDTX WDTY WDTZ DIF1".split())
PLACES = ("DM", "DX", "DY", "DZ")
RATES = ("VR", "VX", "VY", "VZ")
# What gives axes of their own.
TURNING = frozenset(("reuler", "zp", "xp", "zg", "xg"))
# Measures that a joint's motion or a GCON may prescribe.
DRIVEN = (*PLACES, "AX", "AY", "AZ", "DIF")
FREEDOMS = {"ROTATION": "AZ", "TRANSLATION": "DZ"}


class Posture:
    """Places of markers and values of expressions.

    Attributes
    ----------
    given : dict of Call to float
        Measures that are to have another value than the one the deck places them at.
    shift : dict of body to Vector
        Displacements of bodies from where the deck places them.
    """

    def __init__(self, deck: Deck) -> None:
        self.deck = deck
        self.time = 0.0
        self.given: dict[Call, float] = {}
        self.shift: dict[Body, Vector] = {}
        self._bodies: dict[Key, Body] = {}
        self._places: dict[Key, Vector] = {}
        self._laws: dict[Call, Law] = {}
        self._variables: dict[Key, float] = {}
        self._constants: dict[Key, float] = {}

    def at(self, time: float) -> None:
        """Go to another time: what is prescribed takes the value it has then, where it has one."""
        self.time, self._variables = time, {}
        for call, law in self._laws.items():
            try:
                self.given[call] = law()
            except Unknown:
                self.given[call], self._variables = nan, {}

    def forget(self) -> None:
        """After changing `given` or `shift`."""
        self._variables = {}

    # places

    def body(self, marker: Key) -> Body:
        """The body a marker is on; all of the ground is one."""
        if marker not in self._bodies:
            found = self.deck.find(Marker, marker) if marker != 0 else None
            owner = found.owner if found else None
            part = self.deck.find(*owner) if owner else None
            if owner and part and not getattr(part, "ground", False):
                self._bodies[marker] = owner[0], part.key
            else:
                self._bodies[marker] = GROUND
        return self._bodies[marker]

    def place(self, marker: Key) -> Vector:
        """Where a marker is, in ground."""
        if marker not in self._places:
            self._places[marker] = self._placed(marker)
        moved = self.shift.get(self.body(marker)) if self.shift else None
        return add(self._places[marker], moved) if moved else self._places[marker]

    def _placed(self, marker: Key) -> Vector:
        if marker == 0:
            return 0.0, 0.0, 0.0
        found = self.deck.get(Marker, marker)
        part = self.deck.find(*found.owner) if found.owner else None
        if found.floating or part is None or found.rm is not None:
            raise Unknown
        x, y, z = axes = _axes(part)
        if axes is AXES:
            px, py, pz = found.qp
            return add(part.qg, (px, py, pz))
        place = part.qg
        for axis, share in zip((x, y, z), found.qp, strict=True):
            place = add(place, axis, share)
        return place

    def axes(self, marker: Key) -> Axes:
        """Axes of a marker, in ground."""
        if marker == 0:
            return AXES
        found = self.deck.get(Marker, marker)
        part = self.deck.find(*found.owner) if found.owner else None
        if part is None or found.rm is not None:
            raise Unknown
        outer, own = _axes(part), _axes(found)
        if own is AXES:
            return outer
        x, y, z = (add(add(add(ZERO, outer[0], a), outer[1], b), outer[2], c) for a, b, c in own)
        return x, y, z

    def velocity(self, body: Body) -> Vector:
        """Of the origin of a body at the start."""
        found = self.deck.find(*body) if body is not GROUND else None
        if getattr(found, "vm", None) is not None:
            raise Unknown
        return (found.vx, found.vy, found.vz) if found else ZERO

    # values

    def value(self, node: Node) -> float:
        """Of an expression; raises :class:`Unknown`."""
        return evaluate(node, self._look)

    def _look(self, node: Node) -> float:
        if isinstance(node, Time):
            return self.time
        if not isinstance(node, Call):
            raise Unknown
        if node in self.given:
            return _known(self.given[node])
        if node.name in STILL:
            return 0.0
        ids = [arg.id for arg in node.args if isinstance(arg, Ref)]
        if node.name == "VARVAL":
            return self._variable(ids[0])
        if node.name == "DIF":
            return self.deck.get(Diff, ids[0]).ic[0]
        if node.name in PLACES:
            return self._distance(node.name, ids)
        if node.name == "AZ":
            return self._turn(ids)
        raise Unknown

    def _variable(self, key: Key) -> float:
        """Of a VARIABLE; those that it takes are known before, so that nothing calls itself for
        each link of a chain.
        """
        known = ChainMap(self._constants, self._variables)
        for each in behind_others([key], self._taken, known):
            self._settle(each)
        return _known(known[key])

    def _settle(self, key: Key) -> None:
        self._variables[key] = nan  # one that depends on itself is not known
        function = self.deck.get(Variable, key).function
        self._variables[key] = self.value(function)
        if self._is_constant(function):
            self._constants[key] = self._variables[key]

    def _taken(self, key: Key) -> list[Key]:
        """The VARIABLEs whose values a VARIABLE takes."""
        function = self.deck.get(Variable, key).function
        return [ref.id for call in calls(function, "VARVAL") for ref in call.args
                if isinstance(ref, Ref)]  # fmt: skip

    def _distance(self, name: str, ids: list[Key]) -> float:
        d = self.place(ids[0])
        if len(ids) > 1 and ids[1] != 0:
            d = add(d, self.place(ids[1]), -1.0)
        if name == "DM":
            return norm(d)
        axis = "XYZ".index(name[1])
        return d[axis] if len(ids) < 3 or ids[2] == 0 else dot(d, self.axes(ids[2])[axis])

    def _turn(self, ids: list[Key]) -> float:
        x = self.axes(ids[0])[0]
        along, aside, _ = self.axes(ids[1]) if len(ids) > 1 else AXES
        return atan2(dot(x, aside), dot(x, along))

    # what is prescribed

    def measures(self, node: Node) -> set[Call]:
        """Displacements and states that a value depends on, through variables too."""
        return {n for n in self._all(node) if isinstance(n, Call) and n.name in DRIVEN}

    def rates(self, node: Node) -> set[Call]:
        """Velocities that a value depends on, through variables too."""
        return {n for n in self._all(node) if isinstance(n, Call) and n.name in RATES}

    def _is_constant(self, node: Node) -> bool:
        """Whether nothing in it changes; the VARIABLEs that it takes are known."""
        return all(
            each.id in self._constants
            if isinstance(each, Ref)
            else not (isinstance(each, Time) or (isinstance(each, Call) and each.name != "VARVAL"))
            for each in walk(node)
        )

    def depends_on_time(self, node: Node) -> bool:
        """Whether TIME stands in it or in its variables."""
        return any(isinstance(each, Time) for each in self._all(node))

    def _all(self, node: Node) -> Iterator[Node]:
        """Everything in an expression and in its variables."""
        pending, seen = [node], set()
        while pending:
            for each in walk(pending.pop()):
                yield each
                if isinstance(each, Ref) and each.kind == "VARIABLE" and each.id not in seen:
                    seen.add(each.id)
                    pending.append(self.deck.get(Variable, each.id).function)

    def follow(self, call: Call) -> bool:
        """Let a measure follow what prescribes it, or continue as it starts; whether it is
        prescribed.
        """
        law = self._motion(call) or self._constraint(call)
        if law is None:
            start, rate = self.value(call), self._rate(call)
            self._laws[call] = lambda: start + rate * self.time
            return False
        self._laws[call] = law
        return True

    def _rate(self, call: Call) -> float:
        """Of a turn about the axis of a marker, at the start; zero for anything else."""
        ids = [arg.id for arg in call.args if isinstance(arg, Ref)]
        if call.name != "AZ":
            return 0.0
        axis = self.axes(ids[1])[2] if len(ids) > 1 else AXES[2]
        spins = [self._spin(each) for each in ids[:2]]
        return dot(spins[0], axis) - (dot(spins[1], axis) if len(spins) > 1 else 0.0)

    def _spin(self, marker: Key) -> Vector:
        """Angular velocity of a marker's body at the start, in ground."""
        body = self.body(marker)
        found = self.deck.find(*body) if body is not GROUND else None
        if found is None or not hasattr(found, "wz"):
            return 0.0, 0.0, 0.0
        if found.wm is not None:
            raise Unknown
        x, y, z = self.axes(found.cm)
        return add(add(add(ZERO, x, found.wx), y, found.wy), z, found.wz)

    def _motion(self, call: Call) -> Law | None:
        ids = [arg.id for arg in call.args if isinstance(arg, Ref)][:2]
        for motion in self.deck.of(Motion):
            joint = self.deck.get(Joint, motion.joint) if motion.joint is not None else None
            driven = (
                joint and [joint.i, joint.j] == ids and FREEDOMS.get(motion.axis or "") == call.name
            )
            if driven and motion.level == "DISPLACEMENT":
                return partial(self.value, motion.function)
        return None

    def _constraint(self, call: Call) -> Law | None:
        """From a GCON that is linear in the measure and depends on nothing else but time."""
        for gcon in self.deck.of(Gcon):
            if self.measures(gcon.function) == {call}:
                return partial(self._root, gcon.function, call)
        return None

    def _root(self, node: Node, call: Call) -> float:
        ends = []
        for self.given[call] in (0.0, 1.0):
            self.forget()
            ends.append(self.value(node))
        self.forget()
        if ends[0] == ends[1]:
            raise Unknown
        return ends[0] / (ends[0] - ends[1])


def _known(value: float) -> float:
    if isnan(value):
        raise Unknown
    return value


def _axes(statement: Part | PointMass | Marker) -> Axes:
    """Axes of a part or marker in what it is placed in; numpy only where they are turned."""
    if TURNING.isdisjoint(statement.spans):
        return AXES
    import numpy as np

    from adamslite.model.geometry import frame_axes

    origin = statement.qp if isinstance(statement, Marker) else statement.qg
    x, y, z = frame_axes(statement, np.asarray(origin)).T.tolist()
    return tuple(x), tuple(y), tuple(z)

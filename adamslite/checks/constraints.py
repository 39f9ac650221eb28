"""Rules about constraints: what they may hold, couple and drive."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator
from math import dist
from operator import ne

from adamslite.checks.bodies_and_elements import body_of
from adamslite.checks.rule import Rule, needs
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose, diagnose_inside
from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.bases.traced_curve import POINTS
from adamslite.elements.coupler import Coupler
from adamslite.elements.curve import Curve
from adamslite.elements.cvcv import Cvcv
from adamslite.elements.gcon import Gcon
from adamslite.elements.gear import Gear
from adamslite.elements.joint import Joint
from adamslite.elements.jprim import Jprim
from adamslite.elements.matrix import Matrix
from adamslite.elements.motion import Motion
from adamslite.elements.ptcv import Ptcv
from adamslite.elements.variable import Variable
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Call, Mode, Node, Num, Ref, calls, walk
from adamslite.language.function import FUNCTIONS
from adamslite.language.interfaces import Key
from adamslite.language.statement import STATEMENTS, Statement, expressions
from adamslite.model.cycles import in_loops, of_each_other

POINT = "POINT_MASS"
TURNING = ("ORIENTATION", "PARALLEL_AXES", "PERPENDICULAR")
# The order of a curve, and the share of its size that a closed one may be open by.
CUBIC, SEAM = 4, 1e-6
SIZES = {"SCREW": "pitch", "RACKPIN": "pd"}
# Freedoms of marker I seen from J that a joint already holds.
HELD = {
    "REVOLUTE": ("X", "Y", "Z"), "SPHERICAL": ("X", "Y", "Z"), "HOOKE": ("X", "Y", "Z"),
    "UNIVERSAL": ("X", "Y", "Z"), "CONVEL": ("X", "Y", "Z"), "PLANAR": ("Z", "B1", "B2"),
    "CYLINDRICAL": ("X", "Y", "B1", "B2"), "TRANSLATIONAL": ("X", "Y", "B1", "B2", "B3"),
    "FIXED": ("X", "Y", "Z", "B1", "B2", "B3"),
}  # fmt: skip


def _turns(deck: Deck, owner: tuple[str, Key] | None) -> bool:
    """Whether a body can rotate; an unknown body counts as one that can."""
    if owner is None:
        return True
    body = deck.find(*owner)
    return owner[0] != POINT and not getattr(body, "ground", False)


def pairs(deck: Deck) -> Iterator[Diagnostic]:
    found: list[Jprim | Motion | Ptcv | Cvcv]
    found = [*deck.of(Jprim), *deck.of(Motion), *deck.of(Ptcv), *deck.of(Cvcv)]
    for each in found:
        here, there = body_of(deck, each.i), body_of(deck, each.j)
        if here and here == there:
            yield diagnose(each, "same-body", "j", owner=f"{here[0]}/{here[1]}")
            continue
        points = [o for o in (here, there) if o and o[0] == POINT]
        if _holds_turns(each) and points and not (_turns(deck, here) or _turns(deck, there)):
            yield diagnose(each, "torque-on-point", owner=f"{points[0][0]}/{points[0][1]}")


def _holds_turns(element: Jprim | Motion | Ptcv | Cvcv) -> bool:
    """Whether its rows hold rotations: one of its markers has to be on a body that turns."""
    if isinstance(element, Jprim):
        return element.kind in TURNING
    if isinstance(element, Cvcv):
        return True
    return isinstance(element, Motion) and (element.axis or "")[:1] == "B"


def joint_sizes(deck: Deck) -> Iterator[Diagnostic]:
    for joint in deck.of(Joint):
        for kind, field in SIZES.items():
            value = getattr(joint, field)
            if joint.kind == kind and not value:
                word = "without " + field.upper() if value is None else f"with {field.upper()}=0"
                yield diagnose(joint, "joint-size", field, kind=kind, word=word)
            elif joint.kind != kind and value is not None:
                reason = f"only the joint {kind} has one"
                yield diagnose(joint, "no-effect", field, word=field.upper(), reason=reason)
        free = len(joint.coordinates)
        for field, wanted in (("ic", 1), ("ictran", 2), ("icrot", 2)):
            if joint.given(field) and free != wanted:
                reason = "IC is for joints with one freedom, ICTRAN and ICROT for CYLINDRICAL"
                yield diagnose(joint, "no-effect", field, word=field.upper(), reason=reason)


def couplers(deck: Deck) -> Iterator[Diagnostic]:
    for coupler in deck.of(Coupler):
        joints = [deck.find(Joint, key) for key in coupler.joints]
        count = len(joints)
        if count not in (2, 3):
            yield diagnose(coupler, "coupled-count", "joints", count=count, expected="two or three")
            continue
        if coupler.function is not None:
            if coupler.given("scales"):
                reason = "FUNCTION gives the relation"
                yield diagnose(coupler, "no-effect", "scales", word="SCALES", reason=reason)
            continue
        if not coupler.scales:
            yield diagnose(coupler, "missing-argument", word="SCALES")
            continue
        if len(coupler.scales) not in (count - 1, count):
            yield diagnose(
                coupler, "scale-count", "scales", count=len(coupler.scales), joints=count
            )
        if coupler.type and len(coupler.type) != count:
            yield diagnose(coupler, "type-count", "type", count=len(coupler.type), joints=count)
            continue
        for number, joint in enumerate(joints):
            if joint is not None:
                yield from _coupled(coupler, number, joint)


def _coupled(coupler: Coupler, number: int, joint: Joint) -> Iterator[Diagnostic]:
    if coupler.uses(number, joint.coordinates) is not None:
        return
    if joint.kind == "CYLINDRICAL":
        yield diagnose(
            coupler, "freedom-unclear", "joints", joint=joint.label, hint="give TYPE=T or R"
        )
    else:
        field = "type" if coupler.type and joint.coordinates else "joints"
        yield diagnose(coupler, "no-such-freedom", field, joint=joint.label, kind=joint.kind)


def gears(deck: Deck) -> Iterator[Diagnostic]:
    for gear in deck.of(Gear):
        if len(gear.joints) != 2:
            count = len(gear.joints)
            yield diagnose(gear, "coupled-count", "joints", count=count, expected="two")
            continue
        carrier = body_of(deck, gear.cv)
        for key in gear.joints:
            joint = deck.find(Joint, key)
            if joint and not joint.coordinates:
                yield diagnose(
                    gear, "no-such-freedom", "joints", joint=joint.label, kind=joint.kind
                )
            elif joint and carrier and body_of(deck, joint.j) not in (carrier, None):
                owner = f"{carrier[0]}/{carrier[1]}"
                yield diagnose(gear, "not-on-carrier", "cv", joint=joint.label, owner=owner)


def driven_freedoms(deck: Deck) -> Iterator[Diagnostic]:
    taken: dict[tuple[Key | None, ...], Statement] = {}
    for motion in deck.of(Motion):
        found = list(_form(deck, motion))
        yield from found
        if found:
            continue
        joint = deck.find(Joint, motion.joint) if motion.joint is not None else None
        freedom = motion.driven(joint)
        place = (motion.i, motion.j) if joint is None else (joint.i, joint.j)
        word = {"TRANSLATION": "Z", "ROTATION": "B3"}.get(freedom or "", freedom)
        other = taken.setdefault((*place, word), motion)
        if other is not motion:
            yield diagnose(motion, "motion-twice", other=other.label, freedom=freedom)
        for holder in deck.of(Joint) if joint is None else ():
            held = HELD.get(holder.kind, ())
            if (holder.i, holder.j) == place and freedom in held:
                yield diagnose(motion, "freedom-held", "axis", joint=holder.label, freedom=freedom)


def _form(deck: Deck, motion: Motion) -> Iterator[Diagnostic]:
    """What is wrong with the way a motion names its freedom."""
    markers = [f for f in ("i", "j") if motion.given(f)]
    if motion.joint is None:
        if len(markers) < 2:
            yield diagnose(motion, "motion-nowhere")
        elif motion.driven(None) is None:
            yield diagnose(motion, "motion-no-axis", "axis")
        return
    if markers:
        yield diagnose(motion, "motion-two-ways", markers[0])
    joint = deck.find(Joint, motion.joint)
    if joint is None or motion.driven(joint) is not None:
        return
    if joint.kind == "CYLINDRICAL" and motion.axis is None:
        hint = "give TRANSLATION or ROTATION"
        yield diagnose(motion, "freedom-unclear", "joint", joint=joint.label, hint=hint)
    else:
        field = "axis" if motion.axis and joint.coordinates else "joint"
        yield diagnose(motion, "no-such-freedom", field, joint=joint.label, kind=joint.kind)


@needs("VARIABLE")
def functions_of_time(deck: Deck) -> Iterator[Diagnostic]:
    motions = deck.of(Motion)
    varying = variables_not_of_time(deck) if motions else ()
    for motion in motions:
        culprit = not_of_time(deck, motion.function, varying)
        if culprit:
            yield diagnose_inside(motion, culprit, "motion-not-of-time", "function", word=culprit)


def variables_not_of_time(deck: Deck) -> set[Key]:
    """VARIABLEs that depend on more than TIME, or on themselves."""
    variables = {each.key: each for each in deck.of(Variable)}
    uses = {
        key: {ref.id for ref in _measured(each.function) if ref.kind == "VARIABLE"}
        & variables.keys()
        for key, each in variables.items()
    }
    without = in_loops(uses) | {
        key for key, each in variables.items() if not_of_time(deck, each.function, set())
    }
    return set(uses) - of_each_other({key: uses[key] for key in uses.keys() - without})


def not_of_time(deck: Deck, node: Node, varying: Container[Key]) -> str | None:
    """What in an expression depends on more than TIME, itself or through ``varying`` VARIABLEs."""
    for each in walk(node):
        if isinstance(each, Mode):
            return "MODE"
        if not isinstance(each, Call):
            continue
        for ref in each.args:
            if not isinstance(ref, Ref) or STATEMENTS[ref.kind].data or ref.kind == "SENSOR":
                continue  # SENVAL does not change within an analysis
            if ref.kind != "VARIABLE":
                return each.name
            if ref.id in varying and (variable := deck.find(Variable, ref.id)):
                return variable.label
    return None


def _measured(node: Node) -> Iterator[Ref]:
    """What an expression refers to."""
    return (each for each in walk(node) if isinstance(each, Ref))


def motion_starts(deck: Deck) -> Iterator[Diagnostic]:
    used = {"DISPLACEMENT": (), "VELOCITY": ("icdisp",), "ACCELERATION": ("icdisp", "icvel")}
    for motion in deck.of(Motion):
        for field in ("icdisp", "icvel"):
            if motion.given(field) and field not in used[motion.level]:
                reason = f"FUNCTION gives the {motion.level.lower()}"
                yield diagnose(motion, "no-effect", field, word=field.upper(), reason=reason)


def delayed_constraints(deck: Deck) -> Iterator[Diagnostic]:
    """A delayed value may jump, which a constraint cannot follow."""
    for each in deck.statements if deck.delays else ():
        if isinstance(each, Motion | Constraint):
            found = next(_past(deck, expressions(each)), None)
            if found is not None:
                yield diagnose_inside(
                    each, found.name, "delayed-constraint", "function", word=found.name
                )


def _past(deck: Deck, nodes: Iterable[Node]) -> Iterator[Call]:
    """Calls that take past values, also in the variables of expressions."""
    pending, seen = list(nodes), set[Key]()
    while pending:
        for call in calls(pending.pop()):
            if FUNCTIONS[call.name].takes_past:
                yield call
            elif call.name == "VARVAL" and isinstance(call.args[0], Ref):
                variable = deck.find(Variable, call.args[0].id)
                if variable is not None and variable.key not in seen:
                    seen.add(variable.key)
                    pending.append(variable.function)


def curves(deck: Deck) -> Iterator[Diagnostic]:
    for curve in deck.of(Curve):
        if curve.order != CUBIC:
            yield diagnose(curve, "curve-order", "order", order=curve.order)
        if curve.function is not None:
            continue
        if curve.matrix is None:
            yield diagnose(curve, "missing-argument", word="MATRIX")
            continue
        matrix = deck.find(Matrix, curve.matrix)
        if matrix and matrix.complete:
            yield from _points(curve, matrix)


def _points(curve: Curve, matrix: Matrix) -> Iterator[Diagnostic]:
    """Whether the points are enough, and whether a closed curve ends where it begins."""
    closed = curve.form == "CLOSED"
    points, least = matrix.table, 4 if closed or curve.points == "CONTROL_POINTS" else 2
    different = 1 + sum(map(ne, points, points[1:]))
    if matrix.columns != 3 or different < least:
        yield diagnose(curve, "curve-points", "matrix", matrix=matrix.label, least=least)
    elif closed:
        gap = dist(points[0], points[-1])
        if gap > SEAM * max(dist(points[0], point) for point in points):
            yield diagnose(curve, "curve-open", "matrix", matrix=matrix.label, gap=f"{gap:.3g}")


def floating_markers(deck: Deck) -> Iterator[Diagnostic]:
    for on_curve in deck.of(Ptcv):
        yield from _floats(deck, on_curve, "jfloat", on_curve.j)
    for rolling in deck.of(Cvcv):
        yield from _floats(deck, rolling, "ifloat", rolling.i)
        yield from _floats(deck, rolling, "jfloat", rolling.j)


def _floats(deck: Deck, each: Statement, field: str, base: Key) -> Iterator[Diagnostic]:
    """Whether a floating marker is on the part of the marker that a curve is fixed to."""
    key = getattr(each, field)
    floats, lies = body_of(deck, key), body_of(deck, base)
    if floats and lies and floats != lies:
        owner = f"{floats[0]}/{floats[1]}"
        yield diagnose(each, "foreign-marker", field, word=field.upper(), key=key, owner=owner)


def plane_curves(deck: Deck) -> Iterator[Diagnostic]:
    """A CVCV rolls plane curves on each other."""
    for each in deck.of(Cvcv):
        for field in ("icurve", "jcurve"):
            curve = deck.find(Curve, getattr(each, field))
            if curve is not None and any(_heights(deck, curve)):
                yield diagnose(each, "curve-not-plane", field, curve=curve.label)


def _heights(deck: Deck, curve: Curve) -> Iterator[float]:
    """z of the points of a curve, as far as they are known."""
    if isinstance(curve.function, Call) and curve.function.name == POINTS:
        yield from (each.value for each in curve.function.args[2::3] if isinstance(each, Num))
    matrix = deck.find(Matrix, curve.matrix) if curve.matrix is not None else None
    if matrix and matrix.complete:
        yield from (row[2] for row in matrix.table if len(row) > 2)


@needs("VARIABLE")
def measured_markers(deck: Deck) -> Iterator[Diagnostic]:
    """Reactions of a GCON are known where its FUNCTION measures."""

    def function_of(id: Key) -> Node:
        """Of a value of an ARRAY that no system has another rule speaks."""
        found = deck.find(Variable, id)
        return Num(0.0) if found is None else found.function

    for gcon in deck.of(Gcon):
        measured = gcon.measured(function_of)
        known = dict.fromkeys(key for pair in measured for key in pair)
        for field in ("i", "j"):
            key = getattr(gcon, field)
            if key is not None and key not in known:
                listed = ", ".join(f"MARKER/{each}" for each in known) or "none"
                yield diagnose(gcon, "gcon-marker", field, key=key, listed=listed)


CONSTRAINT_RULES: list[Rule] = [
    measured_markers,
    curves,
    floating_markers,
    plane_curves,
    pairs,
    joint_sizes,
    couplers,
    gears,
    driven_freedoms,
    functions_of_time,
    delayed_constraints,
    motion_starts,
]

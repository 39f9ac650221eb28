"""Notes about parts, joints and freedoms that a scene can do without, with what is lost.

They are about a run: decks without a SIMULATE that takes time are passed over.  What only the run
can show is not claimed: whether bodies touch, or how large a force grows.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

from adamslite.checks.reach import out_of_reach
from adamslite.checks.rule import Rule
from adamslite.checks.stiff import looked_at, places_of, size_of, stiff_elements
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose, diagnose_all
from adamslite.elements.joint import Joint
from adamslite.elements.jprim import Jprim
from adamslite.elements.motion import Motion
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import Num

if TYPE_CHECKING:
    from adamslite.assembly.mobility import Mobility
    from adamslite.language.interfaces import Key

# Of the inertia of a motion; of a size.
LIGHT, NOTHING = 1e-3, 1e-9
#: Joints at whose markers the parts stay together.
HINGES = ("CONVEL", "HOOKE", "REVOLUTE", "SPHERICAL", "UNIVERSAL")
STILL = 1e-7
PLANES = ("y-z", "x-z", "x-y")


def one_body(deck: Deck) -> Iterator[Diagnostic]:
    """Parts that never move against each other and are not one body in a run anyway."""
    found = looked_at(deck)
    if not found or not deck.of(Joint):
        return
    from adamslite.assembly.mobility import is_rigid
    from adamslite.model.merging import merged

    model = found[0].model
    run = merged(model)
    together = getattr(run, "members", {})
    groups: list[list[int]] = []
    for b in range(-1, len(model.bodies)):
        for group in groups:
            if not any(each.moves_against(group[0], b) for each in found):
                group.append(b)
                break
        else:
            groups.append([b])
    for group in groups:
        parts = [model.bodies[b].statement for b in group if b >= 0]
        apart = [p for p in parts if (p.keyword, p.key) not in together]
        if len(group) < 2 or not apart:
            continue
        owners = {(p.keyword, p.key) for p in parts}
        inside = [
            j
            for j in model.constraints
            if isinstance(j, (Joint, Jprim, Motion)) and _joins(deck, j, owners)
        ]
        if not is_rigid(found[0], inside, group):
            continue
        labels = [p.label for p in parts] + (["ground"] if -1 in group else [])
        yield diagnose_all(
            parts,
            "one-body",
            listed=_listed(labels),
            fewer=6 * (len(group) - 1),
            joints=_listed([j.label for j in inside]),
        )


def _joins(deck: Deck, joint: Joint | Jprim | Motion, owners: set[tuple[str, Key]]) -> bool:
    from adamslite.model.net_force import ends

    if isinstance(joint, Motion) and not isinstance(joint.function, Num):
        return False
    found = [deck.find("MARKER", key or 0).owner for key in ends(deck, joint)]
    ground = [bool(getattr(deck.find(*owner), "ground", False)) for owner in found]
    return all(g or owner in owners for g, owner in zip(ground, found, strict=True))


def _listed(labels: list[str]) -> str:
    shown = labels if len(labels) <= 6 else [*labels[:6], f"{len(labels) - 6} more"]
    return " and ".join(filter(None, (", ".join(shown[:-1]), *shown[-1:])))


def planar_motion(deck: Deck) -> Iterator[Diagnostic]:
    """Mechanisms whose joints allow motions in a plane alone."""
    found = looked_at(deck)
    if not found or not found[0].motions.shape[1]:
        return
    import numpy as np

    model = found[0].model
    for normal, plane in enumerate(PLANES):
        out = [normal, *(3 + k for k in range(3) if k != normal)]
        columns = [6 * b + k for b in range(len(model.bodies)) for k in out]
        away = max(
            float(np.abs((m.motions * m.weights[:, None])[columns]).max()) for m in found
        )  # fmt: skip
        if away <= 1e-9:
            parts = [body.statement for body in model.bodies]
            yield diagnose(
                parts[0], "planar-motion", plane=plane, needless=len(columns),
                unknowns=6 * len(parts), lost=_lost_across(found[0], normal),
            )  # fmt: skip
            return


def _lost_across(mobility: Mobility, normal: int) -> str:
    """What joints carry across the plane, in words: weight, and torques of forces that do not act
    in one plane or turn bodies about other axes than their principal ones.
    """
    import numpy as np

    model, posture = mobility.model, mobility.posture
    mass, size = sum(body.mass for body in model.bodies), size_of(mobility)
    weight = mass * abs(model.deck.gravity[normal])
    skew = 0.0
    for R, body in zip(posture.attitude, model.bodies, strict=True):
        row = np.delete((R @ body.inertia @ R.T)[normal], normal)
        skew = max(skew, float(np.abs(row).max()) / (mass * size) if mass * size > 0.0 else 0.0)
    arm = float(np.ptp(np.array(places_of(mobility))[:, normal])) + skew
    lost = []
    if weight > NOTHING * mass * float(np.linalg.norm(model.deck.gravity)):
        lost.append(f"{weight:.3g} of weight")
    if arm > NOTHING * size:
        lost.append(f"torques of about {arm:.2g} times the forces")
    if not lost:
        return (
            "and nothing is lost without them; a run leaves them out where forces act in the "
            "plane, too"
        )
    carried = " and ".join(lost)
    return f"and the motion stays without them; lost is what joints carry across: {carried}"


# ---- light links -------------------------------------------------------------------------------


def light_links(deck: Deck) -> Iterator[Diagnostic]:
    """Parts between two hinges that have next to no inertia, and hold only a distance."""
    found = looked_at(deck) if len(deck.of(Joint)) > 1 else ()
    if not found:
        return
    from adamslite.assembly.mobility import farther
    from adamslite.elements.bases.joint_coordinates import pose

    model, more = found[0].model, cache(lambda: farther(found[0]))
    for b, body in enumerate(model.bodies):
        ends = _only_ends(deck, body.statement)
        light = ends and all(_share(each, b) <= LIGHT for each in found)
        if not ends or not light or not all(_holds_a_distance(each, b, ends) for each in found):
            continue
        share = max(_share(each, b) for each in more())
        if not share <= LIGHT:
            continue
        (x, _), (y, _) = (pose(model, marker) for marker in ends)
        total = sum(each.mass for each in model.bodies)
        yield diagnose(
            body.statement, "light-link", share=f"{share:.2g}", i=ends[0], j=ends[1],
            length=repr(float(((x - y) @ (x - y)) ** 0.5)), weight=f"{body.mass / total:.2g}",
        )  # fmt: skip


def _only_ends(deck: Deck, part: Any) -> tuple[Key, Key] | None:
    """The markers of the neighbours, where two hinges are all that refers to a part."""
    from adamslite.model.mergeable import referred

    own = {m.key for m in deck.of("MARKER") if m.owner == (part.keyword, part.key)}
    joints = []
    for each in deck.statements:
        if each is part or each.keyword == "MARKER":
            continue
        names = set(referred(each))
        if names & {("MARKER", key) for key in own} or (part.keyword, part.key) in names:
            if not (isinstance(each, Joint) and each.kind in HINGES and deck.is_active(each)):
                return None
            joints.append(each)
    asked = {key for each in deck.statements for keyword, key in referred(each)
             if keyword == "JOINT"}  # fmt: skip
    if len(joints) != 2 or any(j.key in asked or {j.i, j.j} <= own for j in joints):
        return None
    first, second = (j.j if j.i in own else j.i for j in joints)
    return first, second


def _holds_a_distance(mobility: Mobility, b: int, ends: tuple[Key, Key]) -> bool:
    """Whether the other bodies move as they may when only the distance of two markers is kept."""
    import numpy as np

    from adamslite.assembly.mobility import motions_without
    from adamslite.elements.bases.joint_coordinates import pose

    model, N = mobility.model, mobility.motions
    others = [6 * k + c for k in range(len(model.bodies)) for c in range(6) if k != b]
    now = np.linalg.matrix_rank((N * mobility.weights[:, None])[others], STILL)
    free = motions_without(mobility, b)
    alone = replace(mobility, motions=free)
    (x, _), (y, _) = (pose(model, marker) for marker in ends)
    at = [model.marker(marker).body for marker in ends]
    row = (x - y) @ (alone.carried(at[0], x) - alone.carried(at[1], y))[:3]
    size = float(np.linalg.norm(x - y)) * float(np.abs(free).max(initial=0.0))
    return bool(free.shape[1] - (np.abs(row).max(initial=0.0) > STILL * size) == now)


def _share(mobility: Mobility, b: int) -> float:
    """The largest share of a body in the kinetic energy of a motion, with its spin between two
    ball joints as it likes.

        max c^T A' c / c^T R c,   A' = A++ - A+0 A00^-1 A0+,   R = N^T M_rest N

    0: the motions that move nothing else, + all others.
    """
    import numpy as np

    model, N = mobility.model, mobility.motions
    others = [k for k in range(len(model.bodies)) if k != b]
    A, R = (N.T @ mobility.mass(each) @ N for each in ([b], others))
    sizes, axes = np.linalg.eigh(R)
    idle = sizes <= 1e-9 * sizes.max(initial=0.0)
    if idle.sum() > 1 or idle.all():
        return float("inf")
    A = axes.T @ A @ axes
    own = A[np.ix_(~idle, ~idle)]
    if idle.any():
        a00 = float(A[idle][:, idle][0, 0])
        if a00 > 0.0:
            across = A[np.ix_(~idle, idle)]
            own = own - across @ across.T / a00
    scale = 1.0 / np.sqrt(sizes[~idle])
    return float(np.linalg.eigvalsh(scale[:, None] * own * scale).max())


NEEDLESS_RULES: list[Rule] = [one_body, planar_motion, light_links, stiff_elements, out_of_reach]

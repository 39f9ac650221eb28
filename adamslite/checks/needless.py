"""Notes about parts, joints and freedoms that a scene can do without, with what is lost.

They are about a run: decks without a SIMULATE that takes time are passed over.  What only the run
can show is not claimed: whether bodies touch, or how large a force grows.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import pi
from typing import TYPE_CHECKING, Any

from adamslite.checks.lints import run_end
from adamslite.checks.rule import Rule
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose, diagnose_all
from adamslite.elements.bushing import Bushing
from adamslite.elements.joint import Joint
from adamslite.elements.jprim import Jprim
from adamslite.elements.part import Part
from adamslite.language.diagnostics import Diagnostic

if TYPE_CHECKING:
    from adamslite.assembly.mobility import Mobility
    from adamslite.language.interfaces import Key

# Of the inertia of a motion; vibrations within a run; what gives way, of the size of the model.
LIGHT, VIBRATIONS, SMALL = 1e-3, 1e3, 1e-3
PLANES = ("y-z", "x-z", "x-y")


def _looked_at(deck: Deck) -> tuple[Mobility, ...]:
    """What the constraints allow, of decks that run."""
    if not run_end(deck) or len(deck.of(Part)) < 2 or deck.user.called:
        return ()
    if not any(map(deck.of, ("JOINT", "BUSHING"))):
        return ()
    import numpy as np

    from adamslite.assembly.mobility import mobilities

    with np.errstate(all="ignore"):
        found = mobilities(deck)
    return found if all(np.isfinite(each.motions).all() for each in found) else ()


def one_body(deck: Deck) -> Iterator[Diagnostic]:
    """Parts that never move against each other and are not one body in a run anyway."""
    found = _looked_at(deck)
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
            if isinstance(j, (Joint, Jprim)) and _joins(deck, j, owners)
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


def _joins(deck: Deck, joint: Joint | Jprim, owners: set[tuple[str, Key]]) -> bool:
    found = [deck.find("MARKER", key).owner for key in (joint.i, joint.j)]
    ground = [bool(getattr(deck.find(*owner), "ground", False)) for owner in found]
    return all(g or owner in owners for g, owner in zip(ground, found, strict=True))


def _listed(labels: list[str]) -> str:
    shown = labels if len(labels) <= 6 else [*labels[:6], f"{len(labels) - 6} more"]
    return " and ".join(filter(None, (", ".join(shown[:-1]), *shown[-1:])))


def planar_motion(deck: Deck) -> Iterator[Diagnostic]:
    """Mechanisms whose joints allow motions in a plane alone."""
    found = _looked_at(deck)
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
                unknowns=6 * len(parts),
            )  # fmt: skip
            return


# ---- light links -------------------------------------------------------------------------------


def light_links(deck: Deck) -> Iterator[Diagnostic]:
    """Parts between two ball joints that have next to no inertia."""
    found = _looked_at(deck) if len(deck.of(Joint)) > 1 else ()
    for b, body in enumerate(found[0].model.bodies if found else ()):
        ends = _only_ends(deck, body.statement) if body.mass else None
        if ends is None:
            continue
        share = max(_share(each, b) for each in found)
        if not share <= LIGHT:
            continue
        from adamslite.elements.bases.joint_coordinates import pose

        (x, _), (y, _) = (pose(found[0].model, marker) for marker in ends)
        total = sum(each.mass for each in found[0].model.bodies)
        yield diagnose(
            body.statement, "light-link", share=f"{share:.2g}", i=ends[0], j=ends[1],
            length=repr(float(((x - y) @ (x - y)) ** 0.5)), weight=f"{body.mass / total:.2g}",
        )  # fmt: skip


def _only_ends(deck: Deck, part: Any) -> tuple[Key, Key] | None:
    """The markers of the neighbours, where two ball joints are all that refers to a part."""
    from adamslite.model.mergeable import referred

    own = {m.key for m in deck.of("MARKER") if m.owner == (part.keyword, part.key)}
    joints = []
    for each in deck.statements:
        if each is part or each.keyword == "MARKER":
            continue
        names = set(referred(each))
        if names & {("MARKER", key) for key in own} or (part.keyword, part.key) in names:
            if not (isinstance(each, Joint) and each.kind == "SPHERICAL" and deck.is_active(each)):
                return None
            joints.append(each)
    asked = {key for each in deck.statements for keyword, key in referred(each)
             if keyword == "JOINT"}  # fmt: skip
    if len(joints) != 2 or any(j.key in asked or {j.i, j.j} <= own for j in joints):
        return None
    first, second = (j.j if j.i in own else j.i for j in joints)
    return first, second


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


# ---- stiff bushings ----------------------------------------------------------------------------


def stiff_bushings(deck: Deck) -> Iterator[Diagnostic]:
    """Bushings that vibrate very often within the run, and give way by very little."""
    found = _looked_at(deck) if deck.of(Bushing) else ()
    for bushing in deck.of(Bushing) if found else ():
        kind = _kind(bushing)
        if not kind or not deck.is_active(bushing) or any((*bushing.force, *bushing.torque)):
            continue
        frequency = _frequency(found[0], bushing, 3 if kind == "SPHERICAL" else 6)
        model, count = found[0].model, frequency * run_end(deck)
        weight = sum(b.mass for b in model.bodies) * sum(g * g for g in deck.gravity) ** 0.5
        deflection = weight / min(bushing.k)  # some ten times that where it swings
        size = max(float(abs(found[0].posture.x).max()), 1e-30)
        small = 0.0 < 10.0 * deflection <= SMALL * size
        if count >= VIBRATIONS and small and not _measured(deck, bushing):
            yield diagnose(
                bushing, "stiff-bushing", frequency=f"{frequency:.3g}", count=f"{count:.2g}",
                kind=kind, deflection=f"{deflection:.2g}",
            )  # fmt: skip


def _kind(bushing: Bushing) -> str:
    """The joint that a bushing is nearly."""
    if not all(value > 0 for value in bushing.k):
        return ""
    if not any((*bushing.kt, *bushing.ct)):
        return "SPHERICAL"
    return "FIXED" if all(value > 0 for value in bushing.kt) else ""


def _measured(deck: Deck, bushing: Bushing) -> bool:
    from adamslite.model.mergeable import referred

    own = ("BUSHING", bushing.key)
    return any(own in set(referred(each)) for each in deck.statements)


def _frequency(mobility: Mobility, bushing: Bushing, rows: int) -> float:
    """The lowest of sqrt(eig(K W))/(2 pi) [1/time], W = B (N^T M N)^-1 B^T the mobility of I
    against J along the axes of J.
    """
    import numpy as np

    from adamslite.elements.bases.joint_coordinates import pose

    model, N = mobility.model, mobility.motions
    ends = [model.marker(key) for key in (bushing.i, bushing.j)]
    place, axes = pose(model, bushing.j)
    apart = mobility.carried(ends[0].body, place) - mobility.carried(ends[1].body, place)
    B = np.concatenate([axes.T @ apart[:3], axes.T @ apart[3:]])[:rows]
    M = N.T @ mobility.mass(range(len(model.bodies))) @ N
    K = np.sqrt(np.array((*bushing.k, *bushing.kt))[:rows])
    try:
        W = B @ np.linalg.solve(M, B.T)
    except np.linalg.LinAlgError:
        return 0.0
    squares = np.linalg.eigvalsh(K[:, None] * W * K)
    moving = squares[squares > 1e-9 * squares.max(initial=0.0)]
    return float(moving.min(initial=np.inf) ** 0.5 / (2 * pi)) if moving.size else 0.0


NEEDLESS_RULES: list[Rule] = [one_body, planar_motion, light_links, stiff_bushings]

"""Forces and constraints that act on the bodies of a cable besides its springs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from adamslite.cables.description.payout_law import Unknown
from adamslite.cables.recognition.chain_finder import Chain
from adamslite.cables.recognition.posture import GROUND, Body, Posture
from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.gcon import Gcon
from adamslite.elements.joint import Joint
from adamslite.elements.motion import Motion
from adamslite.elements.vforce import Vforce
from adamslite.language.expression import Node, Ref, calls, walk
from adamslite.language.statement import Statement


def acting(chains: Iterable[Chain], posture: Posture) -> dict[Body, list[Statement]]:
    """What acts on bodies besides the springs of some chains and what payout does to their nodes;
    raises :class:`Unknown` where that is more on the nodes themselves."""
    chains = [*chains]
    own = {id(link.statement) for chain in chains for link in chain.links}
    inner = {node for chain in chains for node in chain.inner}
    found: dict[Body, list[Statement]] = {}
    for each in posture.deck.statements:
        if id(each) in own or not (hasattr(each, "loads") or isinstance(each, Constraint | Motion)):
            continue
        if isinstance(each, Vforce) and _grows(each):
            continue
        for body in {posture.body(key) for key in _markers(each, posture)} - {GROUND}:
            if body in inner:
                raise Unknown
            found.setdefault(body, []).append(each)
    return found


def _grows(force: Vforce) -> bool:
    """Whether a force is what the payout does to a node."""
    nodes = force.fx, force.fy, force.fz
    return any(call.name.startswith("ACC") for node in nodes for call in calls(node))


def _markers(each: Statement, posture: Posture) -> Iterator[Any]:
    """Markers that a force or constraint names."""
    if isinstance(each, Motion) and each.joint is not None:
        each = posture.deck.get(Joint, each.joint)
    if isinstance(each, Gcon):
        refs: Iterable[Node] = walk(each.function)
        yield from (n.id for n in refs if isinstance(n, Ref) and n.kind == "MARKER" and n.id != 0)
        return
    for name, argument in each.arguments.items():
        value = getattr(each, name)
        if argument.kind == "reference" and argument.to == "MARKER" and value is not None:
            yield value

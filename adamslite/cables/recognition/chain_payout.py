"""What feeds a chain: its payout over a run, and the mass that its nodes gain by it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeGuard

import numpy as np

from adamslite.cables.description.payout_law import Unknown
from adamslite.cables.model.estimate import Travel, from_ways
from adamslite.cables.recognition.chain_finder import Chain, Link, free_length, law_of
from adamslite.cables.recognition.posture import Body, Posture
from adamslite.elements.vforce import Vforce
from adamslite.language.expression import Call, Node, Ref, calls

INSTANTS = 100
# A small part of a time or a length, to form rates with.
SHORT = 1e-6
# Of what feeds the whole cable a section gets at least this share.
FED = 1e-5


def travel_of(
    chain: Chain, posture: Posture, end: float, count: int
) -> tuple[Travel, tuple[float, float], np.ndarray | None]:
    """Payout over the run, the range of dm/m0, and the payout at equal instants if it is known."""
    laws: dict[tuple[Node, ...] | float, list[Link]] = {}
    for link in chain.links:
        laws.setdefault(law_of(link), []).append(link)
    fed = [(same[0], len(same)) for same in laws.values()]
    fed = [(link, count) for link, count in fed if _is_fed(link, posture)]
    known = all([posture.follow(call) for link, _ in fed for call in drivers(link, posture)])

    def payout(time: float) -> float:
        posture.at(time)
        return sum(count * free_length(link, posture) for link, count in fed)

    try:
        if not fed or not end > 0:
            return Travel(known=not fed), (0.0, 0.0), None
        if not known:
            speed = abs(payout(end * SHORT) - payout(0.0)) / (end * SHORT)
            speed = speed if speed * end > SHORT * payout(0.0) else 0.0
            gained = _gained(chain, posture)
            return Travel(speed=speed, jump=speed, known=False), (gained, gained), None
        times = [end * i / INSTANTS for i in range(INSTANTS + 1)]
        ways = [payout(time) for time in times]
        posture.at(times[ways.index(min(ways))])
        least = _gained(chain, posture)
        posture.at(times[ways.index(max(ways))])
        gains = least, _gained(chain, posture)
        law = np.array([payout(end * i / count) for i in range(count + 1)])
        travel = from_ways([way - ways[0] for way in ways], end / INSTANTS, 0.0)
        return travel, gains, law - law[0]
    except Unknown:
        return Travel(known=False), (0.0, 0.0), None
    finally:
        posture.at(0.0)


def drivers(link: Link, posture: Posture) -> set[Call]:
    """What its force depends on besides the distance of its own ends."""
    own = {link.i, link.j}
    return {
        call
        for node in link.components
        for call in posture.measures(node)
        if not own & {arg.id for arg in call.args if _is_marker(arg)}
    }


def _is_fed(link: Link, posture: Posture) -> bool:
    """Whether its free length may change in the run."""
    if any(posture.depends_on_time(node) for node in link.components):
        return True
    before = free_length(link, posture)
    for call in drivers(link, posture):
        posture.given[call] = posture.value(call) + SHORT * link.free
        posture.forget()
        after = free_length(link, posture)
        del posture.given[call]
        posture.forget()
        if abs(after - before) > FED * SHORT * link.free:
            return True
    return False


def _gained(chain: Chain, posture: Posture) -> float:
    """dm/m0 of the node in the middle."""
    node = chain.inner[len(chain.inner) // 2]
    ucf = posture.deck.ucf
    return gained_mass(node, posture) * ucf / posture.deck.find(*node).mass


def gained_mass(node: Body, posture: Posture) -> float:
    """dm of a body: minus the slope of its VFORCE by its acceleration."""
    total = 0.0
    for force in _grows(posture, node):
        for component in (force.fx, force.fy, force.fz):
            for call in set(calls(component, "ACCX", "ACCY", "ACCZ")):
                if _is_marker(call.args[0]) and posture.body(call.args[0].id) == node:
                    total = max(total, _slope(component, call, posture))
    return total


def _slope(component: Node, call: Call, posture: Posture) -> float:
    values = []
    for posture.given[call] in (0.0, 1.0):
        values.append(posture.value(component))
    del posture.given[call]
    return values[0] - values[1]


def _grows(posture: Posture, node: Body) -> Iterator[Vforce]:
    """VFORCEs on a body."""
    return (f for f in posture.deck.of(Vforce) if posture.body(f.i) == node)


def form_of(chain: Chain, posture: Posture) -> str:
    """What feeds mass into the nodes: nothing, the paper's term, or the flow through them."""
    nodes = chain.inner or [node for node in chain.nodes if node[0] != "MARKER"]
    node = nodes[len(nodes) // 2]
    near = {posture.body(k.i) for k in chain.links} | {posture.body(k.j) for k in chain.links}
    forms = set()
    for force in _grows(posture, node):
        found = [c for n in (force.fx, force.fy, force.fz) for c in calls(n)]
        if any(c.name.startswith("ACC") for c in found):
            seen = {posture.body(a.id) for c in found for a in c.args if _is_marker(a)}
            forms.add("ale" if len(seen & near) > 1 else "paper")
    return forms.pop() if len(forms) == 1 else "fixed"


def _is_marker(node: Node) -> TypeGuard[Ref]:
    return isinstance(node, Ref) and node.kind == "MARKER" and node.id != 0

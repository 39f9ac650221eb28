"""Chains of a deck that are one cable: they meet at weights, or where a wheel feeds both."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from adamslite.cables.recognition.chain_finder import Chain
from adamslite.cables.recognition.chain_payout import drivers
from adamslite.cables.recognition.posture import GROUND, Body, Posture
from adamslite.language.expression import Call, Ref

WHEEL = "wheel"


@dataclass(frozen=True)
class Route:
    """Chains in a row, each in the sense of the route or against it, and what stands between them:
    bodies, or (WHEEL, key of its part)."""

    chains: tuple[tuple[Chain, bool], ...]
    stations: tuple[Body, ...]


def routes(found: Sequence[Chain], posture: Posture) -> list[Route]:
    """Chains by what they meet at; alone where they do not, or where ways branch or close."""
    ends = [_ends(chain, posture) for chain in found]
    joined: dict[Body, list[int]] = {}
    for k, pair in enumerate(ends):
        for end in pair:
            joined.setdefault(end, []).append(k)
    left, made = set(range(len(found))), []
    for k in range(len(found)):
        if k in left:
            way = _way(k, ends, joined)
            left -= {n for n, _ in way}
            first = ends[way[0][0]][0 if way[0][1] else 1]
            stations = [first, *(ends[n][1 if forwards else 0] for n, forwards in way)]
            made.append(Route(tuple((found[n], f) for n, f in way), tuple(stations)))
    return made


def _way(
    k: int, ends: list[tuple[Body, Body]], joined: dict[Body, list[int]]
) -> list[tuple[int, bool]]:
    """Chains before and behind chain k, with whether they lie in the sense of the route."""
    way = [(k, True)]
    for side in (0, 1):
        while True:
            n, forwards = way[0] if side == 0 else way[-1]
            end = ends[n][side if forwards else 1 - side]
            others = [m for m in joined[end] if m != n]
            if end[0] == "MARKER" or len(others) != 1 or others[0] in dict(way):
                break
            m = others[0]
            ahead = ends[m][1 - side] == end
            way = [(m, ahead), *way] if side == 0 else [*way, (m, ahead)]
    return way


def _ends(chain: Chain, posture: Posture) -> tuple[Body, Body]:
    """The stations of a chain: a wheel for a point in the ground where cable comes in."""
    first, last = chain.nodes[0], chain.nodes[-1]
    wheels = {wheel_of(call, posture) for link in chain.links for call in drivers(link, posture)}
    if len(wheels) == 1 and (first[0] == "MARKER") != (last[0] == "MARKER"):
        wheel = WHEEL, next(iter(wheels))[1]
        return (wheel, last) if first[0] == "MARKER" else (first, wheel)
    return first, last


def wheel_of(call: Call, posture: Posture) -> Body:
    """The body whose rotation an AZ is."""
    bodies = {posture.body(arg.id) for arg in call.args if isinstance(arg, Ref)} - {GROUND}
    return bodies.pop() if call.name == "AZ" and len(bodies) == 1 else GROUND

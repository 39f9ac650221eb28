"""How a chain lies and moves at the start: its line, its jumps of speed, its waves."""

from __future__ import annotations

from math import sqrt

from adamslite.cables.recognition.chain_finder import Chain
from adamslite.cables.recognition.posture import Posture
from adamslite.cables.vectors import ZERO, Vector, add, dot, norm, part_across, unit

# Directions that differ by less are the same.
ASIDE = 1e-6


class ChainShape:
    """How a chain lies and moves at the start."""

    def __init__(self, chain: Chain, posture: Posture) -> None:
        self.places = [_place(chain, posture, k) for k in range(len(chain.nodes))]
        self.speeds = [
            ZERO if node[0] == "MARKER" else posture.velocity(node) for node in chain.nodes
        ]
        steps = [add(b, a, -1.0) for a, b in zip(self.places, self.places[1:], strict=False)]
        self.along = [unit(step) for step in steps]
        across_ends = add(self.places[-1], self.places[0], -1.0)
        self.line = unit(across_ends)
        self.pull = dot(posture.deck.gravity, self.line)
        self.gravity = posture.deck.gravity

    @property
    def straight(self) -> bool:
        """Whether gravity and all places and speeds are along one line."""
        fastest = max(map(norm, self.speeds))
        return (
            norm(self.line) > 0
            and all(norm(part_across(a, self.line)) < ASIDE for a in self.along)
            and all(norm(part_across(v, self.line)) <= ASIDE * fastest for v in self.speeds)
            and norm(part_across(self.gravity, self.line)) <= ASIDE * norm(self.gravity)
        )

    def jumps(self) -> tuple[float, float]:
        """Differences of speed along and across that stand between two neighbours, not spread over
        the chain.
        """
        steps = [add(b, a, -1.0) for a, b in zip(self.speeds, self.speeds[1:], strict=False)]
        along = [abs(dot(d, t)) for d, t in zip(steps, self.along, strict=True)]
        across = [norm(part_across(d, t)) for d, t in zip(steps, self.along, strict=True)]
        return _standing(along), _standing(across)

    def leaves(self, chain: Chain) -> float:
        """Speed at which the far end moves away along the cable; cable comes in at the other."""
        if chain.nodes[0][0] == "MARKER" or chain.nodes[-1][0] != "MARKER":
            return dot(self.speeds[-1], self.along[-1])
        return -dot(self.speeds[0], self.along[0])

    def wave(self, across: float, free: float) -> float:
        """Wave number of the drawn shape and speeds, by the free length: sqrt of sum y"^2 over sum
        y'^2, across the line.
        """
        if across or self.straight:
            return 0.0
        h = free / len(self.along)
        numbers = [_wave_number(values, h, self.line) for values in (self.places, self.speeds)]
        return max(numbers)


def _wave_number(values: list[Vector], h: float, line: Vector) -> float:
    ys = [part_across(v, line) for v in values]
    slopes = [add(b, a, -1.0) for a, b in zip(ys, ys[1:], strict=False)]
    bends = [add(b, a, -1.0) for a, b in zip(slopes, slopes[1:], strict=False)]
    first = sum(dot(s, s) for s in slopes)
    if first <= (ASIDE * max(map(norm, values))) ** 2:
        return 0.0
    return sqrt(sum(dot(b, b) for b in bends) / first) / h


def _place(chain: Chain, posture: Posture, k: int) -> Vector:
    """Of node k: its marker in the link before or after it."""
    link = chain.links[min(k, len(chain.links) - 1)]
    i_first = link.ends[0] == chain.nodes[min(k, len(chain.links) - 1)]
    first, second = (link.i, link.j) if i_first else (link.j, link.i)
    return posture.place(first if k < len(chain.links) else second)


def _standing(steps: list[float]) -> float:
    """The largest of some differences if it stands between two neighbours, else 0."""
    return max(steps) if max(steps) > 0.5 * sum(steps) else 0.0

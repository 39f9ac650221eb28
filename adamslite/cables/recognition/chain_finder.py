"""Cables in a deck: masses in a row, joined by springs along the lines between them.

A spring is any SFORCE, VFORCE or SPRINGDAMPER that pulls two bodies together by a force which grows
when one of them is moved away along the line. Its stiffness k and free length H come from moving
it; EA = k H. A row ends at the ground, at a body that is joined to one or to more than two others,
and at a body much heavier or lighter than the masses in between.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from statistics import median

from adamslite.cables.description.payout_law import Unknown
from adamslite.cables.recognition.posture import GROUND, STILL, Body, Posture
from adamslite.cables.vectors import ZERO, Vector, add, dot, norm, unit
from adamslite.deck.deck import Deck
from adamslite.elements.sforce import Sforce
from adamslite.elements.springdamper import Springdamper
from adamslite.elements.vforce import Vforce
from adamslite.language.expression import Call, Node, Num, Op, Ref, rebuild
from adamslite.language.interfaces import Key

Spring = Sforce | Vforce | Springdamper
# Fewer springs in a row are springs, not a cable.
FEWEST = 3
# Masses and stiffnesses of one cable differ by less than this factor.
ALIKE = 4.0
# Lengths of a spring, in parts of the drawn one, at which its pull is evaluated: a slack one pulls
# when it is long enough, a contact never.
STRETCHES = (0.0, 1e-2, 0.1)
DIFFERENCE = 1e-5
# The same where a free length is looked for that may have grown.
LONGER = (0.0, 1e-2, 0.1, 1.0, 10.0, 100.0)


@dataclass(frozen=True)
class Link:
    """A spring between two bodies; `components` are its force on I, along the line or in ground.

    `pull` [force] is its tension as drawn, `stiffness` [force/length], `free` its free length.
    """

    statement: Spring
    i: Key
    j: Key
    ends: tuple[Body, Body]
    components: tuple[Node, ...]
    pull: float = 0.0
    stiffness: float = 0.0
    free: float = 0.0


@dataclass(frozen=True)
class Chain:
    """Springs in a row; node k is between link k - 1 and link k, the first and last are ends.

    ``is_ring``: whether it closes on itself without an end; both ends may be on one body or hook.
    """

    links: tuple[Link, ...]
    nodes: tuple[Body, ...]
    is_ring: bool = False

    @property
    def inner(self) -> tuple[Body, ...]:
        """The masses between the ends."""
        return self.nodes[1:] if self.is_ring else self.nodes[1:-1]


def chains(deck: Deck, posture: Posture) -> list[Chain]:
    """All cables of a deck, in the order of their first springs."""
    return [chain for chain in all_rows(deck, posture) if is_cable(chain)]


def all_rows(deck: Deck, posture: Posture) -> list[Chain]:
    """Springs in rows, among them single ones and others too few to be a cable."""
    return rows(deck, _links(deck, posture))


def rows(deck: Deck, links: Iterable[Link], alike: float = ALIKE) -> list[Chain]:
    """Links in rows: each as long as it goes through masses that nothing else joins and that
    differ from the median of all by less than a factor.
    """
    joined: dict[Body, dict[Body, Link]] = {}
    for link in links:
        a, b = link.ends
        joined.setdefault(a, {})[b] = link
        joined.setdefault(b, {})[a] = link
    masses = {node: _mass(deck, node) for node in joined}
    two = [m for node, m in masses.items() if m and len(joined[node]) == 2]
    middle = median(two) if two else 0.0

    def inside(node: Body) -> bool:
        m = masses[node]
        return bool(m) and len(joined[node]) == 2 and middle / alike < m < middle * alike

    return list(_rows(joined, inside))


def _links(deck: Deck, posture: Posture) -> Iterator[Link]:
    for drawn in along_lines(deck, posture):
        try:
            found = _sprung(drawn, posture)
        except Unknown:
            found = None
        if found:
            yield found


def along_lines(deck: Deck, posture: Posture) -> Iterator[Link]:
    """Forces along a line between two bodies, whatever their law."""
    for force in deck.of(Sforce):
        if force.kind == "TRANSLATIONAL" and not force.actiononly and deck.is_active(force):
            yield from _between(posture, force, force.j, (force.function,))
    for spring in deck.of(Springdamper):
        if spring.kind == "TRANSLATIONAL" and deck.is_active(spring):
            yield from _between(posture, spring, spring.j, ())
    for vector in deck.of(Vforce):
        if vector.rm == 0 and deck.is_active(vector):
            components = (vector.fx, vector.fy, vector.fz)
            for j in _other_ends(posture, vector.i, components):
                yield from _between(posture, vector, j, components)


def _between(posture: Posture, force: Spring, j: Key, components: Sequence[Node]) -> Iterator[Link]:
    here, there = _end(posture, force.i), _end(posture, j)
    if here != there and (here[0] != "MARKER" or there[0] != "MARKER"):
        yield Link(force, force.i, j, (here, there), tuple(components))


def _end(posture: Posture, marker: Key) -> Body:
    """The body of a marker; the marker itself where it is on the ground."""
    body = posture.body(marker)
    return body if body is not GROUND else ("MARKER", marker)


def _other_ends(posture: Posture, i: Key, components: Sequence[Node]) -> set[Key]:
    """The marker that a force on I depends on, when it is one: the other end of a spring."""
    own = posture.body(i)
    found = {
        arg.id
        for node in components
        for call in posture.measures(node)
        for arg in call.args
        if isinstance(arg, Ref) and arg.kind == "MARKER" and arg.id != 0
        and posture.body(arg.id) != own
    }  # fmt: skip
    return found if len(found) == 1 else set()


def _sprung(link: Link, posture: Posture) -> Link | None:
    """The link with its stiffness and free length; None when it is no spring that pulls."""
    line = add(posture.place(link.i), posture.place(link.j), -1.0)
    drawn = norm(line)
    spring = link.statement
    if isinstance(spring, Springdamper):
        free = spring.length + spring.force / spring.k if spring.k > 0 else 0.0
        return _made(link, spring.k * (drawn - free), spring.k, free) if free > 0 else None
    if not drawn > 0:
        return None
    law = (
        None
        if posture.given or len(link.components) > 1
        else _line(link.components[0], (link.i, link.j))
    )
    if law is not None:
        at_zero, slope = law
        free = -at_zero / slope if slope < 0 else 0.0
        pulls = 0 < free < (1 + STRETCHES[-1]) * drawn
        return _made(link, -at_zero - slope * drawn, -slope, free) if pulls else None
    if not _pull(link, posture, STRETCHES[-1]) > 0:
        return None
    found = _stiff(link, posture, STRETCHES)
    if found is None or not found[1] > 0:
        return None
    taut = found[0] * (drawn - found[1])
    return _made(link, taut if taut > 0 else _pull(link, posture, 0.0), *found)


def _line(node: Node, ends: tuple[Key, Key]) -> tuple[float, float] | None:
    """The values a, b of an expression a + b DM(I, J) while everything is still; None where it is
    no such line.
    """
    if type(node) is Num:
        return node.value, 0.0
    if type(node) is Call:
        if node.name == "DM" and len(node.args) == 2 and _joins(node.args, ends):
            return 0.0, 1.0
        return (0.0, 0.0) if node.name in STILL else None
    if type(node) is not Op:
        return None
    first = _line(node.args[0], ends)
    if first is None or len(node.args) == 1:
        return first and (-first[0], -first[1])
    other = _line(node.args[1], ends)
    return other and _joined(node.op, *first, *other)


def _joins(args: Sequence[Node], ends: tuple[Key, Key]) -> bool:
    """Whether a distance is that between two markers."""
    i, j = (arg.id if type(arg) is Ref else None for arg in args)
    return (i, j) == ends or (j, i) == ends


def _joined(op: str, a: float, b: float, c: float, d: float) -> tuple[float, float] | None:
    """What an operation makes of a + b x and c + d x, where it is a line again."""
    if op == "+":
        return a + c, b + d
    if op == "-":
        return a - c, b - d
    if op == "*" and not (b and d):
        return a * c, a * d + b * c
    if op == "/" and not d and c:
        return a / c, b / c
    return None


def _stiff(link: Link, posture: Posture, stretches: Sequence[float]) -> tuple[float, float] | None:
    """Stiffness and free length at the first stretch at which it is stiff."""
    drawn = norm(add(posture.place(link.i), posture.place(link.j), -1.0))
    for stretch in stretches:
        pull = _pull(link, posture, stretch)
        more = _pull(link, posture, stretch + DIFFERENCE)
        stiffness = (more - pull) / (DIFFERENCE * drawn)
        if stiffness > 0:
            return stiffness, (1 + stretch) * drawn - pull / stiffness
    return None


def _made(link: Link, pull: float, stiffness: float, free: float) -> Link:
    return Link(
        link.statement, link.i, link.j, link.ends, link.components, pull, stiffness, free
    )  # fmt: skip


def _pull(link: Link, posture: Posture, stretch: float) -> float:
    """Its tension when it is drawn longer by a share of its length."""
    line = add(posture.place(link.i), posture.place(link.j), -1.0)
    body, sense = posture.body(link.i), 1.0
    if body is GROUND:
        body, sense = posture.body(link.j), -1.0
    posture.shift[body] = add(ZERO, line, sense * stretch)
    posture.forget()
    try:
        values = [posture.value(node) for node in link.components]
    finally:
        posture.shift.clear()
        posture.forget()
    if len(values) == 1:
        return -values[0]
    return -dot(_three(values), line) / norm(line)


def free_length(link: Link, posture: Posture) -> float:
    """Of a link in the posture as it is now: raises :class:`Unknown`."""
    found = _stiff(link, posture, LONGER) if link.components else (0.0, link.free)
    if found is None:
        raise Unknown
    return found[1]


def damper(link: Link, posture: Posture) -> float:
    """Force of a link by the rate of its length [force time/length]."""
    if isinstance(link.statement, Springdamper):
        return link.statement.c
    ends = link.i, link.j
    line = add(posture.place(link.i), posture.place(link.j), -1.0)
    e = unit(line)
    rates = {
        call: 1.0 if call.name == "VR" else e["XYZ".index(call.name[1])] * (1 if own else -1)
        for node in link.components for call in posture.rates(node)
        if len(call.args) > 1 and _joins(call.args[:2], ends)
        for own in [getattr(call.args[0], "id", None) == link.i]
    }  # fmt: skip
    pulls = []
    try:
        for rate in (0.0, 1.0):
            posture.given.update({call: rate * share for call, share in rates.items()})
            posture.forget()
            values = [posture.value(node) for node in link.components]
            pulls.append(-values[0] if len(values) == 1 else -dot(_three(values), e))
    finally:
        for call in rates:
            del posture.given[call]
        posture.forget()
    return max(pulls[1] - pulls[0], 0.0)


def _three(values: list[float]) -> Vector:
    x, y, z = values
    return x, y, z


def law_of(link: Link) -> tuple[Node, ...] | float:
    """What all links that are one law between different markers have in common."""
    own = {link.i: "I", link.j: "J"}

    def rename(node: Node) -> Node:
        if isinstance(node, Ref) and node.kind == "MARKER":
            return Ref("MARKER", own.get(node.id, node.id))
        return node

    if link.components:
        return tuple(rebuild(node, rename) for node in link.components)
    return link.free


def _mass(deck: Deck, node: Body) -> float:
    found = deck.find(*node) if node[0] != "MARKER" else None
    return (found.mass or 0.0) if found else 0.0


def _rows(joined: dict[Body, dict[Body, Link]], inside: Callable[[Body], bool]) -> Iterator[Chain]:
    used: set[int] = set()
    ends = [node for node in joined if not inside(node)]
    for start in [*ends, *joined]:
        for after, link in joined[start].items():
            if id(link.statement) in used:
                continue
            nodes, links = [start, after], [link]
            used.add(id(link.statement))
            while inside(nodes[-1]) and nodes[-1] != start:
                node, last = nodes[-1], links[-1]
                after, link = next((n, k) for n, k in joined[node].items() if k is not last)
                nodes.append(after)
                links.append(link)
                used.add(id(link.statement))
            closed = nodes[-1] == start and inside(start)
            yield Chain(tuple(links), tuple(nodes), closed)


def is_cable(chain: Chain) -> bool:
    """Whether springs in a row are many enough, and alike."""
    if len(chain.links) < FEWEST:
        return False
    rigidities = [link.stiffness * link.free for link in chain.links]
    return max(rigidities) < ALIKE * min(rigidities)

"""Random trees and loops of rigid bodies, as a deck and as the equations of newton_euler.

Every body is posed at random and every marker is made to fit the posture, so that the deck starts
assembled; velocities are the part of random ones that all constraints allow.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from frame_constraints import (
    GEARS,
    JOINTS,
    PRIMITIVES,
    about,
    any_rotation,
    body_123,
    displaced,
    euler_313,
    separation,
    turn,
)
from newton_euler import Assembly, Axes, Body, Frame, Jet, State, Tie, given

Array = np.ndarray
#: words of UNITS, then metre, kilogram and ucf of them.
POUND, INCH, GRAVITY = 0.45359237, 0.0254, 9.80665
SYSTEMS = (
    ("SYSTEM=MKS", 1.0, 1.0, 1.0),
    ("FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND", 1e-3, 1.0, 1e3),
    ("SYSTEM=CGS", 1e-2, 1e-3, 1.0),
    ("FORCE=POUND_FORCE, MASS=POUND_MASS, LENGTH=INCH, TIME=SECOND", INCH, POUND, GRAVITY / INCH),
    ("UCF=7.5", 0.5, 2.0, 7.5),
)
#: The least singular value of the rows, each of length 1 in metres: far from singular postures.
REGULAR = 0.15


@dataclass
class Mechanism:
    """A random model in units of its deck, and the statements that describe it.

    poses : origin and axes of every body frame in ground;  centres : axes of the marker at the
    centre of mass in the body frame
    """

    rng: np.random.Generator
    system: tuple[str, float, float, float]
    bodies: list[Body] = field(default_factory=list)
    poses: list[tuple[Array, Array]] = field(default_factory=list)
    centres: list[Array] = field(default_factory=list)
    frames: list[Frame] = field(default_factory=list)
    ties: list[Tie] = field(default_factory=list)
    lines: list[str] = field(default_factory=list)
    start: State | None = None

    @property
    def length(self) -> float:
        """Deck units in a metre."""
        return 1.0 / self.system[1]

    @property
    def assembly(self) -> Assembly:
        """The equations, in units of the deck."""
        gravity = np.array([0.3, -9.81, 1.7]) * self.length
        return Assembly(self.bodies, gravity, self.system[3], self.ties)

    def vector(self, values: Array) -> str:
        """Numbers of a statement."""
        return ",".join(repr(float(v)) for v in values)


def make(seed: int) -> Mechanism:
    """A tree of one to four bodies, perhaps with loops, motions and start values of joints."""
    rng = np.random.default_rng(seed)
    made = Mechanism(rng, SYSTEMS[rng.integers(len(SYSTEMS))])
    for _ in range(rng.integers(1, 5)):
        _add_body(made)
    for child in range(len(made.bodies)):
        parent = int(rng.integers(-1, child)) if child else -1
        _tie(made, child, parent, JOINTS if rng.random() < 0.7 else PRIMITIVES)
    for _ in range(rng.integers(0, 3)):
        pair = rng.permutation(np.arange(-1, len(made.bodies)))[:2]
        _tie(made, int(pair[0]), int(pair[1]), JOINTS if rng.random() < 0.3 else PRIMITIVES)
    if rng.random() < 0.4:
        _gear(made)
    for _ in range(rng.integers(0, 3)):
        _move(made)
    _start(made)
    return made


def _add_body(made: Mechanism) -> None:
    rng, L = made.rng, made.length
    mass = rng.uniform(0.5, 5) / made.system[2]
    shape = rng.normal(size=(3, 3)) * 0.3
    inner = mass * L * L * (shape @ shape.T + 0.02 * np.eye(3))
    inertia = np.trace(inner) * np.eye(3) - inner
    made.bodies.append(Body(mass, inertia, rng.uniform(-0.3, 0.3, 3) * L))
    made.centres.append(any_rotation(rng))
    made.poses.append((rng.uniform(-1, 1, 3) * L, any_rotation(rng)))


def _place(made: Mechanism, body: int, origin: Array, axes: Array) -> Frame:
    """A marker of a body at a place in ground."""
    if body < 0:
        frame = Frame(-1, origin, axes)
    else:
        at, rotation = made.poses[body]
        frame = Frame(body, rotation.T @ (origin - at), rotation.T @ axes)
    made.frames.append(frame)
    return frame


def _state(made: Mechanism) -> State:
    r = np.array([at + turned @ body.centre
                  for (at, turned), body in zip(made.poses, made.bodies, strict=True)])  # fmt: skip
    still = np.zeros_like(r)
    return State(r, np.array([turned for _, turned in made.poses]), still, still)


def _regular(made: Mechanism, tie: Tie) -> bool:
    """Whether a tie may be added: rows independent, and something still moves."""
    assembly = made.assembly
    n = len(made.bodies)
    jets = assembly.rows(_state(made), 0.0, [*made.ties, tie])
    if len(jets) >= 6 * n:
        return False
    G = np.array([jet.gradient for jet in jets]) * np.tile([1, 1, 1, *[made.system[1]] * 3], n)
    G /= np.linalg.norm(G, axis=1)[:, None]
    return bool(np.linalg.svd(G, compute_uv=False).min() > REGULAR)


def _tie(made: Mechanism, i: int, j: int, table: dict) -> None:
    """A joint or primitive of any kind between two bodies, where it fits."""
    kind = list(table)[made.rng.integers(len(table))]
    word = "JOINT" if table is JOINTS else "JPRIM"
    _add_tie(made, i, j, f"{word}, {kind}", *table[kind])


def _gear(made: Mechanism) -> None:
    """A SCREW or RACKPIN between two bodies."""
    rng = made.rng
    kind = list(GEARS)[rng.integers(len(GEARS))]
    row, freedoms, word = GEARS[kind]
    size = float(rng.uniform(0.3, 1.5) * made.length)
    pair = rng.permutation(np.arange(-1, len(made.bodies)))[:2]
    said = f"JOINT, {kind}, {word}={size!r}"
    _add_tie(made, int(pair[0]), int(pair[1]), said, lambda i, j, t: [row(i, j, size)], freedoms)


def _add_tie(made: Mechanism, i: int, j: int, said: str, rows: Callable, freedoms: str) -> None:
    """A constraint between two bodies in a posture of its freedoms, where it fits."""
    rng, L = made.rng, made.length
    word, _, arguments = said.partition(", ")
    origin, axes = rng.uniform(-1, 1, 3) * L, any_rotation(rng)
    d, turned = displaced(rng, freedoms)
    count = len(made.frames)
    jm = _place(made, j, origin, axes)
    im = _place(made, i, origin + axes @ d * L, axes @ turned)
    tie = Tie(f"{word}/{len(made.ties) + 1}", im, jm, rows)
    if not _regular(made, tie):
        del made.frames[count:]
        return
    made.ties.append(tie)
    made.lines.append(f"{tie.name}, {arguments}, I={count + 2}, J={count + 1}")


def _move(made: Mechanism) -> None:
    """A MOTION of a joint, or between its markers, from where it stands."""
    rng, L = made.rng, made.length
    joints = [tie for tie in made.ties if not tie.name.startswith("MOTION")]
    if not joints:
        return
    joint = joints[rng.integers(len(joints))]
    line = next(line for line in made.lines if line.startswith(joint.name + ","))
    ids = line.split("I=")[1].split(", J=")
    ways = {"REVOLUTE": ["turn"], "TRANSLATIONAL": ["Z"], "CYLINDRICAL": ["turn", "Z"],
            "PLANAR": ["X", "Y"], "SPHERICAL": ["B1", "B2", "B3"], "INPLANE": ["X", "Y"],
            "INLINE": ["Z"], "ATPOINT": ["B1", "B2", "B3"]}  # fmt: skip
    kind = line.split(", ")[1]
    if kind not in ways:
        return
    way = ways[kind][rng.integers(len(ways[kind]))]
    size = 1.0 if way[0] in "tB" else 0.4 * L
    a, b, c = size * rng.uniform(-0.6, 0.6), rng.uniform(1, 6), rng.uniform(-3, 3)
    level = str(rng.choice(["DISPLACEMENT", "VELOCITY"]))
    offset = 0.0

    def measured(i: Axes, j: Axes) -> Jet:
        if way == "turn":
            return turn(i, j)
        return (
            body_123(i, j, way) if way[0] == "B" else separation(i, j).dot(getattr(j, way.lower()))
        )

    def rows(i: Axes, j: Axes, t: float) -> list[Jet]:
        n = len(made.bodies)
        s, o = a * np.sin(b * t + c), a * b * np.cos(b * t + c)
        if level == "DISPLACEMENT":
            return [measured(i, j) - given(offset + s, o, -b * b * s, n)]
        # its rate is s: only the rate and the second rate count
        return [measured(i, j) - given(0.0, s, o, n)]

    tie = Tie(f"MOTION/{len(made.ties) + 1}", joint.i, joint.j, rows, level == "VELOCITY")
    if not _regular(made, tie):
        return
    assembly = made.assembly
    state = _state(made)
    now = measured(assembly.marker(joint.i, state), assembly.marker(joint.j, state))
    offset = float(now.value) - a * np.sin(c)
    shift = f"{offset:.17g}+" if level == "DISPLACEMENT" else ""
    if way == "turn" or (kind in ("TRANSLATIONAL", "CYLINDRICAL") and way == "Z"):
        named = "ROTATION" if way == "turn" else "TRANSLATION"
        target = f"JOINT={joint.name.split('/')[1]}, {named}"
    else:
        target = f"I={ids[0]}, J={ids[1]}, {way}"
    made.ties.append(tie)
    made.lines.append(
        f"{tie.name}, {target}, {level}, FUNCTION={shift}{a:.17g}*SIN({b:.17g}*TIME+{c:.17g})"
    )


def _start(made: Mechanism) -> None:
    """Velocities that all constraints allow."""
    rng, L, n = made.rng, made.length, len(made.bodies)
    state, assembly = _state(made), made.assembly
    drawn = rng.normal(size=(n, 6)) * [L, L, L, 1.5, 1.5, 1.5]
    scale = np.tile([L, L, L, 1, 1, 1], n)
    jets = assembly.rows(state, 0.0, made.ties)
    if jets:
        G = np.array([jet.gradient for jet in jets]) * scale
        rate = np.array([float(jet.rate) for jet in jets])  # at rest: of time alone
        free = drawn.ravel() / scale
        free -= np.linalg.lstsq(G, G @ free + rate, rcond=None)[0]
        drawn = (free * scale).reshape(n, 6)
    made.start = State(state.r, state.rotation, drawn[:, :3], drawn[:, 3:])


def leaves(made: Mechanism) -> list[tuple[int, int]]:
    """(body, line) of bodies that nothing but one joint with one freedom holds, to the ground."""
    found = []
    for b in range(len(made.bodies)):
        own = [k for k, tie in enumerate(made.ties) if b in (tie.i.body, tie.j.body)]
        if not own or made.ties[own[0]].j.body != -1 or len(own) > 1:
            continue
        if made.lines[own[0]].split(", ")[1] in ("REVOLUTE", "TRANSLATIONAL"):
            found.append((b, own[0]))
    return found


def drawn_elsewhere(made: Mechanism) -> dict[int, tuple[Array, Array]]:
    """Gives each leaf the start values of its joint, and returns where the deck may draw it
    instead: turned or shifted along the joint, from where assembly has to bring it back.
    """
    found, assembly, state = {}, made.assembly, made.start
    for b, line in leaves(made):
        tie = made.ties[line]
        i, j = assembly.marker(tie.i, state), assembly.marker(tie.j, state)
        turns = "REVOLUTE" in made.lines[line]
        freedom = turn(i, j) if turns else separation(i, j).dot(j.z)
        made.lines[line] += f", IC={float(freedom.value)!r},{float(freedom.rate)!r}"
        (at, axes), frame = made.poses[b], tie.j
        if turns:
            way = frame.axes @ about(2, 0.3) @ frame.axes.T
            found[b] = (frame.origin + way @ (at - frame.origin), way @ axes)
        else:
            found[b] = (at + 0.2 * made.length * frame.axes[:, 2], axes)
    return found


def text(made: Mechanism, end: float, steps: int, integrator: str) -> str:
    """The deck; markers 1, 2, ... are the frames, 101, ... the centres of mass."""
    system, length = made.system[0], made.length
    gravity = made.assembly.gravity.tolist()
    lines = ["A random mechanism", f"UNITS/{system}",
             f"ACCGRAV/IGRAV={gravity[0]!r}, JGRAV={gravity[1]!r}, KGRAV={gravity[2]!r}",
             "PART/1, GROUND"]  # fmt: skip
    elsewhere = drawn_elsewhere(made)
    for b, pose in enumerate(made.poses):
        lines += _part(made, b, elsewhere.get(b, pose), b in elsewhere)
    for k, frame in enumerate(made.frames):
        pose = _pose(made.rng, frame.origin, frame.axes, length, "ZP", "XP", made.vector)
        lines.append(
            f"MARKER/{k + 1}, PART={frame.body + 2}, QP={made.vector(frame.origin)}, {pose}"
        )
    run = [f"INTEGRATOR/{integrator}", f"SIMULATE/DYNAMIC, END={end!r}, STEPS={steps}", "END", ""]
    return "\n".join([*lines, *made.lines, *run])


def _part(made: Mechanism, b: int, drawn: tuple[Array, Array], at_rest: bool) -> list[str]:
    body, (at, turned), length = made.bodies[b], drawn, made.length
    cm = made.centres[b]
    inertia = cm.T @ body.inertia @ cm
    six = [*np.diag(inertia), -inertia[0, 1], -inertia[0, 2], -inertia[1, 2]]
    state = made.start
    spin = cm.T @ turned.T @ state.w[b]
    v = state.v[b]
    if at_rest:
        v, spin = 0.0 * v, 0.0 * spin
    pose = _pose(made.rng, at, turned, length, "ZG", "XG", made.vector)
    noise = np.repeat([1e-11 * length, 1e-11], 3)  # of a mechanism that has nowhere to go
    moving = np.concatenate([v, spin])
    moving = np.where(np.abs(moving) > noise, moving, 0.0)
    speeds = ", ".join(
        f"{name}={float(v)!r}"
        for name, v in zip(("VX", "VY", "VZ", "WX", "WY", "WZ"), moving, strict=True)
    )
    return [
        f"PART/{b + 2}, MASS={body.mass:.17g}, CM={101 + b}, IP={made.vector(six)}",
        f", QG={made.vector(at)}, {pose}",
        f", {speeds}",
        f"MARKER/{101 + b}, PART={b + 2}, QP={made.vector(body.centre)}"
        f", REULER={made.vector(euler_313(cm))}",
    ]


def _pose(
    rng: np.random.Generator, origin: Array, axes: Array, length: float, z: str, x: str,
    vector: Callable,
) -> str:  # fmt: skip
    """One of the ways in which a deck says a direction."""
    how = rng.integers(3 if z == "ZP" else 2)
    a, b, c = rng.uniform(0.2, 2, 3) * length
    side = rng.uniform(-1, 1) * length
    if how == 0:
        return f"REULER={vector(euler_313(axes))}"
    if how == 1:
        return (f"{z}={vector(origin + a * axes[:, 2])}"
                f", {x}={vector(origin + b * axes[:, 0] + side * axes[:, 2])}")  # fmt: skip
    return (f"USEXP, {x}={vector(origin + a * axes[:, 0])}"
            f", {z}={vector(origin + c * axes[:, 2] + side * axes[:, 0])}")  # fmt: skip

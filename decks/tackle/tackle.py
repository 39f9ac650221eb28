"""Decks of block-and-tackle stages, pulley by pulley.

A stage is a block that hangs on two strands of its rope: the becket on the left, and on the right
the strand that goes up to the hook of the next stage. Each strand is a Level 1 pulley side: a
tangency link on the pulley, a turret on the link, a rigid cable in the turret, RACKPIN as feed.
"""

from dataclasses import dataclass, field

import numpy as np

RADIUS, HOOK = 0.1, 0.2
HEIGHTS = (0.0, 1.2, 2.4)
#: Weight on the hook of stage 1 [N]; heights of the beckets [m].
LOAD, FALL = 800.0, (1.5, 2.6, 3.6)
BLOCK, PULLEY, INERTIA, LINK, TURRET, CABLE = 1.0, 0.5, 0.004, 0.1, 0.05, 0.2
STATIC = """
EQUILIBRIUM/ERROR=1.0E-10, IMBALANCE=1.0E-10, MAXIT=100
SIMULATE/STATICS
"""
DYNAMIC = """
INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-8
SIMULATE/DYNAMIC, END=1, STEPS={steps}
"""
UP, LEFT, RIGHT, DOWN = "0,-90D,0", "-90D,90D,0", "90D,90D,0", "0,90D,0"


def centre(stage: int) -> float:
    """Place of the axle of stage 1, 2, ... along x: the strands hang plumb."""
    return RADIUS * (stage - 1)


@dataclass
class Deck:
    """Lines of a deck; `sloppy` metres and degrees of misplacement, drawn from `seed`."""

    title: str
    notes: str
    gravity: str = ""
    sloppy: tuple[float, float] = (0.0, 0.0)
    seed: int = 1
    lines: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        notes = "\n".join(f"! {line}" for line in self.notes.strip().splitlines())
        head = [self.title, notes, "", "UNITS/SYSTEM=MKS"]
        self.lines = [*head, *([self.gravity] if self.gravity else []), ""]
        self.random = np.random.default_rng(self.seed)

    def add(self, *lines: str) -> None:
        """Append lines."""
        self.lines += lines

    def ground(self, *anchors: tuple[int, float, float, str]) -> None:
        """The ground with its markers (id, x, y, comment)."""
        self.add("PART/1, GROUND")
        self.add(*(f"MARKER/{n}, PART=1, QP={x:g},{y:g},0  ! {what}" for n, x, y, what in anchors))
        self.add("")

    def part(self, number: int, mass: float, ip: tuple[float, ...], cm: int, at, what: str) -> None:
        """A part at (x, y), misplaced and turned by up to `sloppy`."""
        shift, turn = self.sloppy
        off = np.round(self.random.uniform(-shift, shift, 3), 4)
        x, y, z = np.array([*at, 0.0]) + off
        a, b, c = np.round(self.random.uniform(-turn, turn, 3), 2)
        turned = f", REULER={a:g}D,{b:g}D,{c:g}D" if turn else ""
        inertia = ",".join(f"{value:g}" for value in ip)
        self.add(f"PART/{number}, MASS={mass:g}, CM={cm}, IP={inertia}")
        self.add(f", QG={x:g},{y:g},{z:g}{turned}  ! {what}")

    def side(
        self,
        first: int,
        pulley: int,
        at,
        left: bool,
        length: float,
        what: str,
        up: bool = True,
        cable: int = 0,
        end_mass: float = CABLE,
        joint: int = 0,
    ) -> None:
        """Link, turret, cable `first`, +10, +20 of a side; with `cable`, one that is there."""
        link, turret = first, first + 10
        radial, sign = (LEFT, -1) if left else (RIGHT, 1)
        x, y = at[0] + sign * RADIUS, at[1]
        along = UP if up else DOWN
        self.part(link, LINK, (1e-4, 1e-4, 1e-4), link, at, f"tangency link, {what}")
        self.add(f"MARKER/{link}, PART={link}")
        self.add(f"MARKER/{link + 1}, PART={link}, QP={sign * RADIUS:g},0,0, REULER={radial}")
        self.part(turret, TURRET, (1e-4, 1e-4, 1e-4), turret + 2, (x, y), f"turret, {what}")
        self.add(f"MARKER/{turret}, PART={turret}, REULER={radial}")
        self.add(f"MARKER/{turret + 1}, PART={turret}, REULER={along}")
        self.add(f"MARKER/{turret + 2}, PART={turret}, QP={-sign * RADIUS:g},0,0")
        slide = "CYLINDRICAL" if cable else "TRANSLATIONAL"
        rope = cable or first + 20
        if not cable:
            ends = (x, y + length if up else y - length)
            self.part(rope, end_mass, (1e-3, 1e-3, 1e-3), rope, ends, f"cable, {what}")
            self.add(
                f"MARKER/{rope}, PART={rope}", f"MARKER/{rope + 1}, PART={rope}, REULER={along}"
            )
        along_rope = rope + (1 if up or not cable else 2)
        # Counterclockwise side: right and up, or left and down.
        sense = 1 if left != up else -1
        self.add(f"JOINT/{joint}, REVOLUTE, I={link}, J={pulley}")
        self.add(f"JOINT/{joint + 1}, REVOLUTE, I={turret}, J={link + 1}")
        self.add(f"JOINT/{joint + 2}, {slide}, I={along_rope}, J={turret + 1}")
        self.add(
            f"JOINT/{joint + 3}, RACKPIN, I={pulley}, J={along_rope}, PD={2 * sense * RADIUS:g}"
        )
        self.add("")

    def stage(self, stage: int, becket: float, strand: float) -> None:
        """Block, pulley and both strands of a stage; lengths of becket side and strand."""
        b = 100 * stage
        at = (centre(stage), HEIGHTS[stage - 1])
        self.add(f"! Stage {stage}")
        self.part(b, BLOCK, (2e-3, 2e-3, 2e-3), b, at, "block")
        self.add(
            f"MARKER/{b}, PART={b}  ! axle", f"MARKER/{b + 1}, PART={b}, QP=0,-{HOOK:g},0  ! hook"
        )
        self.part(b + 10, PULLEY, (INERTIA / 2, INERTIA / 2, INERTIA), b + 10, at, "pulley")
        self.add(
            f"MARKER/{b + 10}, PART={b + 10}", f"JOINT/{b + 1}, REVOLUTE, I={b + 10}, J={b}", ""
        )
        self.side(b + 20, b + 10, at, True, becket, "becket side", joint=b + 2)
        self.side(b + 50, b + 10, at, False, strand, "strand", joint=b + 6)

    def text(self, commands: str) -> str:
        """The deck with these last statements."""
        return "\n".join([*self.lines, commands.strip(), "END", ""])


def strand_length(stage: int, stages: int, fall: float) -> float:
    """From the contact to the hook of the next stage, or to the anchor of the fall."""
    top = HEIGHTS[stage] - HOOK if stage < stages else fall
    return top - HEIGHTS[stage - 1]

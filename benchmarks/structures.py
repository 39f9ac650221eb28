"""Decks of structures in two dimensions and of long chains of bodies, written as ADAMS text."""

from __future__ import annotations

NET = "net"
REVOLUTES = "revolutes"
#: What they are, and their sizes in the benchmarks.
SIZES = {NET: (30, 100), REVOLUTES: (50, 200)}


def structure(name: str, size: int) -> str:
    """The deck of one of them."""
    return net(size) if name == NET else revolutes(size)


def net(size: int) -> str:
    """A hanging net of size x size point masses on springs, its first row held, for 0.1 s.

    Springs of 0.9 m span gaps of 1 m; K = 500 N/m, C = 0.2 N s/m, 0.1 kg at each knot.
    """
    lines = ["A net on springs", "UNITS/SYSTEM=MKS", "ACCGRAV/KGRAV=-9.81", "PART/1, GROUND"]
    springs = 0
    for row in range(size):
        for column in range(size):
            knot = 2 + row * size + column
            at = f"{row},{column},0"
            if row:
                lines.append(f"POINT_MASS/{knot}, MASS=0.1, CM={knot}, QG={at}")
                lines.append(f"MARKER/{knot}, POINT_MASS={knot}")
            else:
                lines.append(f"MARKER/{knot}, PART=1, QP={at}")
            for other in (knot - size, knot - 1) if row and column else (knot - size,) * bool(row):
                springs += 1
                lines.append(
                    f"SPRINGDAMPER/{springs}, TRANSLATIONAL, I={knot}, J={other}, K=500, C=0.2,"
                    " LENGTH=0.9"
                )
    return "\n".join([*lines, "SIMULATE/DYNAMIC, END=0.1, STEPS=10", "END", ""])


def revolutes(count: int) -> str:
    """A chain of ``count`` rods on revolute joints, released from the horizontal, for 0.5 s.

    Rods of 0.1 m and 0.1 kg turn about z; each joint is at the end of the rod before.
    """
    lines = ["A chain on revolutes", "UNITS/SYSTEM=MKS", "ACCGRAV/JGRAV=-9.81", "PART/1, GROUND"]
    lines.append("MARKER/1, PART=1")
    for k in range(count):
        part, start, end = k + 2, 10001 + 2 * k, 10002 + 2 * k
        lines += [
            f"PART/{part}, MASS=0.1, CM={part}, QG={0.1 * k + 0.05:.10g},0,0",
            ", IP=8.4E-5,8.4E-5,8.4E-5",
            f"MARKER/{part}, PART={part}",
            f"MARKER/{start}, PART={part}, QP=-0.05,0,0",
            f"MARKER/{end}, PART={part}, QP=0.05,0,0",
            f"JOINT/{part}, REVOLUTE, I={start}, J={end - 2 if k else 1}",
        ]
    return "\n".join([*lines, "SIMULATE/DYNAMIC, END=0.5, STEPS=10", "END", ""])

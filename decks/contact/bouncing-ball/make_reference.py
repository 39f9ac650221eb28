"""Free fall and harmonic motion, joined where the ball touches, turns round and leaves."""

from __future__ import annotations

from math import acos, atan2, cos, hypot, pi, sin, sqrt
from pathlib import Path

G, HEIGHT, PENALTY, E = 9.81, 1.0, 1e8, 0.8
END, STEPS = 3.0, 150
Span = tuple[float, float, float, float]
"""A start, the height and speed there, and the stiffness per mass (0: free) until the next."""


def spans() -> list[Span]:
    """The motion: fall, sink in by PENALTY, come out by E^2 PENALTY, fall ..."""
    t, y, v, found = 0.0, HEIGHT, 0.0, []
    while t < END:
        found.append((t, y, v, 0.0))
        speed = sqrt(v * v + 2 * G * y)
        t += (v + speed) / G
        found.append((t, 0.0, -speed, PENALTY))
        w = sqrt(PENALTY)
        # y + g/w^2 = (g/w^2) cos(w s) - (speed/w) sin(w s) is lowest where its phase is pi.
        y = -G / w**2 - hypot(G / w**2, speed / w)
        t += (pi - atan2(speed / w, G / w**2)) / w
        found.append((t, y, 0.0, E**2 * PENALTY))
        # y + g/w^2 = (y0 + g/w^2) cos(w s) comes to g/w^2 again.
        w *= E
        angle = acos(G / w**2 / (y + G / w**2))
        v = -(y + G / w**2) * w * sin(angle)
        t, y = t + angle / w, 0.0
    return found


def height(t: float, found: list[Span]) -> float:
    start, y, v, k = max(span for span in found if span[0] <= t)
    s = t - start
    if k == 0.0:
        return y + v * s - G * s * s / 2
    w = sqrt(k)
    return -G / k + (y + G / k) * cos(w * s) + v / w * sin(w * s)


HEAD = """\
# Free fall and harmonic motion, joined exactly: see README.md
# written by make_reference.py
# tolerance: abs 1e-4
"""


def main() -> None:
    found = spans()
    times = [k * END / STEPS for k in range(STEPS + 1)]
    rows = [f"{t:.12g},{height(t, found):.9g}" for t in times]
    text = HEAD + "time,REQUEST/1.F2\n" + "\n".join(rows) + "\n"
    Path(__file__).with_name("reference.csv").write_text(text)


if __name__ == "__main__":
    main()

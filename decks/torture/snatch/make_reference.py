"""Write the references of a mass that falls into a rope, again and again, without loss.

Free fall through H from rest, speed V; then on the spring k about the static stretch d = M g/k:

    e(t) = d + A sin(w (t - t_1) - phi),  sin(phi) = d/A,  A^2 = d^2 + (V/w)^2,  w^2 = k/M

until e = 0 again after (pi + 2 phi)/w.  Largest tension k (d + A).  The smooth law

    T = k (e + delta)^2/(4 delta)  for |e| <= delta,   k e above

stores k delta^2/6 more at the same stretch; its motion is integrated, its largest tension follows
from the energy.
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

M, K, H, G, ROPE, DELTA, BOUNCES = 100.0, 1.0e6, 0.5, 9.81, 1.0, 1.0e-4, 10
SAG, W = M * G / K, np.sqrt(K / M)
LINES = """
Snatch of a falling mass, {kind}: see README.md
tolerance: abs {late:.3g}
measure: max VARIABLE/tension = {peak:.12g} tol rel 1e-3
measure: min VARIABLE/tension = 0 tol abs 1e-9
measure: range VARIABLE/energy = 0 tol abs {energy:g}
"""


def bounce():
    """Fall time, duration of the contact, amplitude and phase on the spring."""
    speed = np.sqrt(2 * G * H)
    amplitude = np.hypot(SAG, speed / W)
    phase = np.arcsin(SAG / amplitude)
    return speed / G, (np.pi + 2 * phase) / W, amplitude, phase


def place(t):
    """Height of the mass below the anchor, sharp law."""
    fall, contact, amplitude, phase = bounce()
    t = t % (2 * fall + contact)
    late = 2 * fall + contact - t
    air = -ROPE + H - G * np.minimum(t, late) ** 2 / 2
    rope = -ROPE - SAG - amplitude * np.sin(W * (t - fall) - phase)
    return np.where((t > fall) & (late > fall), rope, air)


def smooth(t):
    """Height of the mass and largest tension, smooth law, integrated."""

    def rhs(_, y):
        e = -y[0] - ROPE
        rounded = K * (e + DELTA) ** 2 / (4 * DELTA)
        tension = 0.0 if e <= -DELTA else rounded if e < DELTA else K * e
        return np.array([y[1], tension / M - G])

    heights = solve(rhs, [-ROPE + H, 0.0], t)[:, 0]
    assert np.allclose(solve(rhs, [-ROPE + H, 0.0], t, 1e-10)[:, 0], heights, rtol=0, atol=1e-6)
    # (k/2) e^2 + k delta^2/6 = M g (H + e)
    stretch = SAG + np.sqrt(SAG**2 + 2 * M * G * H / K - DELTA**2 / 3)
    return heights, K * stretch


def main():
    fall, contact, amplitude, _ = bounce()
    period, peak = 2 * fall + contact, K * (SAG + amplitude)
    assert np.allclose([peak, contact, period], [32317.28, 32.0421e-3, 0.67059300], rtol=2e-6)
    # Energy off by 1e-3 of M g H shifts a fall by 5e-4 of its time, at the end of the last bounce
    # by BOUNCES times that, and the mass passes by with its greatest speed.
    late = 5e-4 * 2 * fall * BOUNCES * np.sqrt(2 * G * H)
    t = np.linspace(0, BOUNCES * period, BOUNCES * 1000 + 1)
    seldom = t[::50]
    rounded, rounded_peak = smooth(seldom)
    assert np.abs(rounded - place(seldom)).max() < late
    for name, height, top in (
        ("sharp", place(seldom), peak),
        ("impact", place(seldom), peak),
        ("smooth", rounded, rounded_peak),
    ):
        lines = LINES.format(kind=f"{name} law", late=late, peak=top, energy=1e-3 * M * G * H)
        write(HERE / f"{name}.reference.csv", lines, ["POINT_MASS/2.y"], [seldom, height])
        assert f"END={t[-1]:.12g}," in (HERE / f"{name}.adm").read_text()


if __name__ == "__main__":
    main()

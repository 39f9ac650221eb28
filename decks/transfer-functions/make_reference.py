"""Write the references of transfer functions and state equations: closed forms by residues."""

import sys
from pathlib import Path

import numpy as np
from scipy.signal import residue

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

HEAD = "Linear systems under a step and a ramp, closed form: see README.md\ntolerance: peak 1e-6"
STEP, RAMP = (1.0, 0.0), (1.0, 0.0, 0.0)


def response(numerator, denominator, of_input, t):
    """Inverse Laplace transform of numerator/(denominator of_input); powers ascend but in of_input.

    A pole p of order k with residue r adds r t^(k-1)/(k-1)! exp(p t).
    """
    below = np.polymul(denominator[::-1], of_input)
    residues, poles, _ = residue(numerator[::-1], below)
    total, order = 0, 1
    for n, (r, p) in enumerate(zip(residues, poles, strict=True)):
        order = order + 1 if n and abs(p - poles[n - 1]) < 1e-6 * abs(poles).max() else 1
        total = total + r * t ** (order - 1) * np.exp(p * t)
    return np.real(total)


def lag(gain, time, height, start, t):
    """Of gain/(1 + time p) to a step, from an initial value."""
    return gain * height + (start - gain * height) * np.exp(-t / time)


def filters(step, ramp, first, second, both, third, rate, t):
    """Outputs of the seven transfer functions."""
    gain, time, start = first
    a, b = second
    columns = {
        "VARIABLE/y1": lag(gain, time, step, start, t),
        "VARIABLE/y2": gain * ramp * (t - time + time * np.exp(-t / time)),
        "VARIABLE/y3": step * response(a, b, STEP, t),
        "VARIABLE/y3R": step * response((0, *a), b, STEP, t),
        "VARIABLE/y4": step * response(both, b, STEP, t),
        "VARIABLE/y5": step * response(*third, STEP, t),
        "VARIABLE/y6": ramp * response(*third, RAMP, t),
        "VARIABLE/y7": rate[0] * ramp * (1 - np.exp(-t / rate[1])),
    }
    assert np.allclose(lag(gain, time, step, 0, t), step * response((gain,), (1, time), STEP, t))
    assert np.allclose(columns["VARIABLE/y2"], ramp * response((gain,), (1, time), RAMP, t))
    (c, d), (e, f) = third
    by_hand = c / e * step + step * (d / f - c / e) * np.exp(-t * e / f)
    assert np.allclose(columns["VARIABLE/y5"], by_hand)
    return columns


def oscillator(t, inputs=(0, 0), start=(0, 0)):
    """x1 and x2 of x1' = x2, x2' = -25 x1 - 2 x2 + 50 step + 4 ramp.

    The inputs move the state of rest along  x1 = p + q t;  about it there is the damped vibration.
    """
    height, slope = inputs
    q = 4 * slope / 25
    p = (50 * height - 2 * q) / 25
    a, w = start[0] - p, np.sqrt(24)
    b = (start[1] - q + a) / w
    decay, c, s = np.exp(-t), np.cos(w * t), np.sin(w * t)
    x = p + q * t + decay * (a * c + b * s)
    return x, q + decay * ((w * b - a) * c - (w * a + b) * s)


def main():
    t = np.linspace(0, 3, 61)
    shown = filters(
        2, 3, (4, 0.5, -1), ((50,), (25, 2, 1)), (50, 8), ((1, 2), (1, 0.2)), (1, 0.2), t
    )
    x1, x2 = oscillator(t, (2, 3))
    assert np.allclose(oscillator(t, (2, 0))[0], shown["VARIABLE/y3"])
    free, speed = oscillator(t, start=(0.7, -6))
    states = {
        "VARIABLE/y1": x1 - 6, "VARIABLE/y2": 2 * x1 - 0.5 * x2 + 3 * t, "VARIABLE/free": free,
        "VARIABLE/speed": speed, "VARIABLE/gain1": 0 * t - 6, "VARIABLE/gain2": 3 * t,
    }  # fmt: skip
    late = np.linspace(0, 200, 81)
    in_ms = filters(
        -0.4, -0.02, (-7, 30, 5), ((-6,), (2, 50, 200)), (-6, 90), ((3, -5), (-2, -25)),
        (-10, 8), late,
    )  # fmt: skip
    for name, times, columns in (
        ("transfer-functions", t, shown),
        ("transfer-functions-ms", late, in_ms),
        ("state-equations", t, states),
    ):
        write(HERE / f"{name}.reference.csv", HEAD, list(columns), [times, *columns.values()])


if __name__ == "__main__":
    main()

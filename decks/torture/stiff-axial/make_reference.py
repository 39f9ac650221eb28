"""Write the decks and references of a taut cable of ten springs in one of its first modes.

With ends fixed, mode 1 of n equal masses m between n + 1 equal springs of length h, tension T and
stiffness k, is sin(pi j/N), j = 1..n, N = n + 1; its circular frequencies are

    axial       2 sqrt(k/m) sin(pi/(2 N)) = (2 c/h) sin(pi/(2 N)),     c = sqrt(EA/rho)
    transverse  2 sqrt(T/(h m)) sin(pi/(2 N)) = (2 c_t/h) sin(pi/(2 N)),  c_t = sqrt(T/rho)
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

EA, RHO, TENSION, SPAN, N = 6.0e7, 5.536, 13345.0, 15.0, 10
H = SPAN / N
AMPLITUDE = {"transverse": 2e-4, "axial": 1e-4}
PERIODS = 5
TEXT = {
    "transverse": """A taut cable in its first transverse mode
! The axial modes, 67 times as fast, are there and not excited: they must not be felt.
! Ten springs of EA/1.5 m, pulled to 13345 N; the nodes start on a half sine of 0.2 mm.""",
    "axial": """A taut cable in its first axial mode
! Ten springs of EA/1.5 m, pulled to 13345 N; the nodes start on a half sine of 0.1 mm along it.""",
}
LINES = """
First {kind} mode of ten springs, {rate:.9g} rad/s, closed form: see README.md
tolerance: abs {band:.3g}
tolerance POINT_MASS/6.{across}: abs 1e-12
"""


def frequency(kind):
    """Circular frequency [rad/s] of the first mode."""
    speed = np.sqrt((TENSION if kind == "transverse" else EA) / RHO)
    return 2 * speed / H * np.sin(np.pi / (2 * N))


def deck(kind):
    """The text of a deck."""
    lines = [TEXT[kind], "! Written by make_reference.py", "", "UNITS/SYSTEM=MKS", ""]
    lines += ["PART/1, GROUND", "MARKER/1, PART=1", f"MARKER/{N + 1}, PART=1, QP={SPAN:g},0,0"]
    for j in range(1, N):
        s = AMPLITUDE[kind] * np.sin(np.pi * j / N)
        place = f"{j * H + s:.16g},0,0" if kind == "axial" else f"{j * H:g},{s:.16g},0"
        lines.append(f"POINT_MASS/{j + 1}, MASS={RHO * H:.10g}, CM={j + 1}, QG={place}")
        lines.append(f"MARKER/{j + 1}, POINT_MASS={j + 1}")
    for j in range(1, N + 1):
        lines.append(f"SPRINGDAMPER/{j}, TRANSLATIONAL, I={j + 1}, J={j}, K={EA / H:.10g}")
        lines.append(f", LENGTH={H:g}, FORCE={-TENSION:g}")
    end = PERIODS * 2 * np.pi / frequency(kind)
    lines += ["", "INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-8"]
    lines += [f"SIMULATE/DYNAMIC, END={end:.15g}, STEPS={40 * PERIODS}", "END", ""]
    return "\n".join(lines)


def reference(kind):
    """Node 6, in the middle, and node 3, at three tenths of the span."""
    rate = frequency(kind)
    t = np.linspace(0, PERIODS * 2 * np.pi / rate, 40 * PERIODS + 1)
    along, across = ("x", "y") if kind == "axial" else ("y", "x")
    wave = AMPLITUDE[kind] * np.cos(rate * t)
    still = {"x": 1.0, "y": 0.0}
    columns = {
        f"POINT_MASS/6.{along}": still[along] * 5 * H + wave,
        f"POINT_MASS/3.{along}": still[along] * 2 * H + np.sin(np.pi * 2 / N) * wave,
    }
    band = 1e-4 * 2 * np.pi * PERIODS * AMPLITUDE[kind]
    lines = LINES.format(kind=kind, rate=rate, band=band, across=across)
    if kind == "axial":
        columns["POINT_MASS/6.y"] = 0.0
    else:
        lines = lines[: lines.rindex("tolerance")]
    write(HERE / f"{kind}.reference.csv", lines, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    assert np.isclose(frequency("axial"), 686.671, rtol=1e-6)
    assert np.isclose(frequency("transverse"), 10.24077, rtol=1e-6)
    for name in TEXT:
        (HERE / f"{name}.adm").write_text(deck(name))
        reference(name)

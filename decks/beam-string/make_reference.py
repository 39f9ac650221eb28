"""Write the reference of the loaded cantilevers: the bending line of a column under end load."""

from pathlib import Path

import numpy as np

E, IZZ, L, LATERAL = 2.0e7, 1.5e-6, 1.0, 1.0e-2
TENSION, PUSH = 120.0, 30.0
HEAD = """# Cantilevers of four STRING beams under tension and under pressure: see README.md
# written by make_reference.py"""


def pulled(force):
    """Tip and slope of E I v'' = force (v - v_tip) + LATERAL (L - x), clamped at x = 0."""
    k = np.sqrt(force / (E * IZZ))
    tip = LATERAL / (force * k) * (k * L - np.tanh(k * L))
    return tip, LATERAL / force * (1 - 1 / np.cosh(k * L))


def pushed(force):
    """The same for a force that presses."""
    k = np.sqrt(force / (E * IZZ))
    tip = LATERAL / (force * k) * (np.tan(k * L) - k * L)
    return tip, LATERAL / force * (1 / np.cos(k * L) - 1)


def main():
    values = {}
    for name, found in (("pulled", pulled(TENSION)), ("pushed", pushed(PUSH))):
        values[f"{name}_y"], values[f"{name}_slope"] = found
    lines = [f"# measure: last VARIABLE/{n} = {v:.12g} tol rel 6e-5" for n, v in values.items()]
    Path(__file__).with_name("reference.csv").write_text("\n".join([HEAD, *lines]) + "\n")


if __name__ == "__main__":
    main()

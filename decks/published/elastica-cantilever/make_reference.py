"""Write a cantilever with a force across at its end, and the elastica.

With s from the wall, slope a, EI a'' = -P cos a, a(0) = 0, a'(L) = 0; with a0 = a(L)

    L sqrt(P/EI) = K(k) - F(k, f),  k^2 = (1 + sin a0)/2,  k sin f = sqrt(1/2)
    y/L = 1 - 2 (E(k) - E(k, f))/(L sqrt(P/EI)),   x/L = sqrt(2 sin a0)/(L sqrt(P/EI))

K, E, F complete and incomplete elliptic integrals. n beams whose law is that of small bending are
(P L^2/(EI n))^2/50 off or less.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (they lie beside the folders of the cases)
import elastica  # noqa: E402

LENGTH, EI, EA, BEAMS = 1.0, 1.0, 1e7, 80
LINE = catenary.Cable(0.0, 1.0, EA, LENGTH)
END = """
VARIABLE/across, FUNCTION=DY({last},1)
VARIABLE/along, FUNCTION=DX({last},1)

EQUILIBRIUM/ERROR=1.0E-12, IMBALANCE=1.0E-9, MAXIT=200
SIMULATE/STATICS
END
"""


def tip(load: float) -> tuple[float, float]:
    """Place of the end, across and along, for `load` = P L^2/EI and L = 1."""

    def parts(slope: float) -> tuple[float, float]:
        m = (1 + np.sin(slope)) / 2
        return m, np.arcsin(np.sqrt(0.5 / m))

    def miss(slope: float) -> float:
        m, f = parts(slope)
        return ellipk(m) - ellipkinc(f, m) - np.sqrt(load)

    slope = brentq(miss, 1e-9, np.pi / 2 - 1e-12, xtol=1e-15)
    m, f = parts(slope)
    across = 1 - 2 * (ellipe(m) - ellipeinc(f, m)) / np.sqrt(load)
    return across, np.sqrt(2 * np.sin(slope) / load)


def shape(load: float) -> np.ndarray:
    """x, y, slope at BEAMS + 1 places, from which statics starts."""

    def run(moment: float) -> np.ndarray:
        def slopes(s: float, y: np.ndarray) -> list[float]:
            return [np.cos(y[2]), np.sin(y[2]), y[3], -load * np.cos(y[2])]

        s = np.linspace(0, 1, BEAMS + 1)
        return solve_ivp(slopes, (0, 1), [0, 0, 0, moment], t_eval=s, rtol=1e-9).y

    moment = brentq(lambda x: run(x)[3, -1], load * 0.05, load)
    return run(moment)[:3].T


def deck(load: float) -> str:
    h = LENGTH / BEAMS
    text = catenary.head(f"A cantilever with P L^2/EI = {load:g}", f"{BEAMS} beams.", gravity=0)
    text += "MARKER/1000, PART=1\n"
    for k, (x, y, slope) in enumerate(shape(load)[1:], 1):
        text += elastica.part(1000 + k, h, np.array([x, y]), slope)
        text += elastica.beam(1000 + k, LINE, EI, h)
    last = 1000 + BEAMS
    text += f"MARKER/3000, PART=1, FLOATING\nVFORCE/1, I={last}, JFLOAT=3000, RM=1000"
    return text + f", FX=0\\ FY={load * EI:g}\\ FZ=0\n" + END.format(last=last)


def main() -> None:
    for load in (1, 2, 5, 10):
        across, along = tip(load)
        lines = ["# End of the elastica: see README.md", "# written by make_reference.py"]
        near = max((load / BEAMS) ** 2 / 50, 3e-5)
        lines += [f"# measure: last VARIABLE/across = {across:.9f} tol abs {near:.2g}"]
        lines += [f"# measure: last VARIABLE/along = {along:.9f} tol abs {near:.2g}"]
        (HERE / f"load-{load}.reference.csv").write_text("\n".join(lines) + "\n")
        (HERE / f"load-{load}.adm").write_text(deck(load))


if __name__ == "__main__":
    main()

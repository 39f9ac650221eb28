"""Write the references of Andrews' squeezer: one freedom, from loop closures in complex numbers.

Every point is c0 + sum_i c_i exp(1j phi_i) with the turns phi_i of the parts since the start. The
closures G phi' = 0 give all turns as functions of the first: phi' = n w, phi" = n w' + m, and

    (n.M n) w' = n.(Q - M m)     M phi' from the velocities of the centres of mass
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

POINTS = {
    "O": 0,
    "A": -0.06934 - 0.00227j,
    "B": -0.03635 + 0.03273j,
    "C": 0.014 + 0.072j,
    "D": -0.0104723938888146 + 0.0253577885302753j,
    "E": -0.0209600223463543 + 0.00129516919370669j,
    "F": 0.00698667411545145 - 0.000431723064568895j,
    "G": -0.03399720388584 + 0.0164619716749977j,
    "H": -0.0316331345074089 - 0.0156188686683045j,
}
# Pins, mass, inertia about the centre of mass, centre of mass.
PARTS = (
    ("OF", 0.04325, 2.194e-6, 0.000918248598030761 - 5.67407456290548e-5j),
    ("FE", 0.00365, 4.410e-7, -0.00449143335993307 + 0.00027753625579429j),
    ("BDE", 0.02373, 5.255e-6, -0.0187421866703155 + 0.0204851067890739j),
    ("EG", 0.00706, 5.667e-7, -0.0302229398301589 + 0.0120711823566639j),
    ("AG", 0.07050, 1.169e-5, -0.0532368281557041 + 0.0166318479666163j),
    ("EH", 0.00706, 5.667e-7, -0.0285432685367836 - 0.0107222547072523j),
    ("AH", 0.05498, 1.912e-5, -0.0592624028017917 - 0.0106006983327128j),
)
# Pins by part (0 the ground) and the part on whose first pin each chain hangs.
PINS = ((1, 0, "O"), (2, 1, "F"), (3, 2, "E"), (3, 0, "B"), (4, 3, "E"), (5, 4, "G"), (5, 0, "A"),
        (6, 3, "E"), (7, 6, "H"), (7, 0, "A"))  # fmt: skip
HOLDER = {1: None, 2: (1, "F"), 3: None, 4: (3, "E"), 5: None, 6: (3, "E"), 7: None}
LOOPS = ((2, 3, "E"), (4, 5, "G"), (6, 7, "H"))
TORQUE, STIFFNESS, LENGTH, END = 0.033, 4530.0, 0.07785, 0.03
LINES = """
Andrews' squeezer, one freedom, DOP853 at rtol 1e-12: see README.md
solve: --error {error:g}
tolerance VARIABLE/*: abs {angle:g}
tolerance PART/*.wz: abs {rate:g}
"""

# Steps far below what ERROR asks for: how long [s], the angle and rate allowed.
TINY = {"micro": (1e-6, 1e-7, 1e-4), "nano": (1e-8, 1e-11, 1e-5)}
TINY_LINES = """
Andrews' squeezer, a thousand steps of {step:g} s on index 3: see README.md
solve: --formulation I3 --hmax {step:g} --end {end:g} --steps 10
tolerance VARIABLE/*: abs {angle:g}
tolerance PART/*.wz: abs {rate:g}
measure: value JOINT/3.fx at 0 = 98.5668704 tol abs 1e-6
measure: value JOINT/3.fy at 0 = -6.12268834 tol abs 1e-6
"""


def chain(part, place):
    """The constant and the (7,) complex arms of a point of `part` that starts at `place`."""
    arms = np.zeros(7, complex)
    holder = HOLDER[part]
    first = POINTS[PARTS[part - 1][0][0]]
    arms[part - 1] = place - first
    if holder is None:
        return first, arms
    base, more = chain(holder[0], POINTS[holder[1]])
    return base, arms + more


CENTRES = [chain(k, part[3]) for k, part in enumerate(PARTS, 1)]
CLOSURES = [chain(a, POINTS[p])[1] - chain(b, POINTS[p])[1] for a, b, p in LOOPS]
SPRING = chain(3, POINTS["D"])
MASS = np.array([part[1] for part in PARTS])
INERTIA = np.array([part[2] for part in PARTS])


def stacked(rows):
    """Real and imaginary parts of complex rows."""
    rows = np.array(rows)
    return np.concatenate([rows.real, rows.imag])


def acceleration(phi, w):
    """phi" (7,) at the turns phi and the rates w."""
    e = np.exp(1j * phi)
    slope = stacked([1j * c * e for c in CLOSURES])
    bias = -stacked([(-c * e * w**2).sum() for c in CLOSURES])
    n = np.concatenate([[1.0], np.linalg.solve(slope[:, 1:], -slope[:, 0])])
    m = np.concatenate([[0.0], np.linalg.solve(slope[:, 1:], bias)])
    arms = np.array([1j * c * e for _, c in CENTRES])
    drift = np.array([(-c * e * w**2).sum() for _, c in CENTRES])
    mass = (arms.conj().T * MASS @ arms).real + np.diag(INERTIA)
    load = -(arms.conj().T * MASS @ drift).real
    base, c = SPRING
    way = base + (c * e).sum() - POINTS["C"]
    pull = -STIFFNESS * (abs(way) - LENGTH) * way / abs(way)
    load += ((1j * c * e).conj() * pull).real
    load[0] += TORQUE
    return n * (n @ (load - mass @ m)) / (n @ mass @ n) + m


def rhs(_, y):
    return np.concatenate([y[7:], acceleration(y[:7], y[7:])])


def check(y, tight):
    """Against the published solution, the closures and the energy."""
    assert np.allclose(tight, y, rtol=1e-8, atol=1e-9)
    assert np.isclose(acceleration(np.zeros(7), np.zeros(7))[0], 14222.4439, rtol=1e-8)
    first = [-0.0617138900142764, 0, 0.4552798191630704, 0.2226683901658859,
             0.4873649795438426, -0.2226683901658859, 1.2305474445498212]  # fmt: skip
    last = [15.81077119629904, -15.75637105984298, 0.04082224013073101, -0.5347301163226948,
            0.5244099658805304, 0.5347301163226948, 1.048080741042263]  # fmt: skip
    rates = [1139.920302151208, -1424.379294994111, 11.03291221937134, 19.29337464421385,
             0.5735699284790808, -19.29337464421385, 0.3231791658026955]  # fmt: skip
    turns = absolute(np.array(last) - first)
    assert np.allclose(y[-1, :7], turns, rtol=0, atol=5e-9), y[-1, :7] - turns
    assert np.allclose(y[-1, 7:], absolute(np.array(rates)), rtol=0, atol=5e-6)
    gaps = [[(c * np.exp(1j * s[:7])).sum() - c.sum() for c in CLOSURES] for s in y]
    assert np.abs(gaps).max() < 1e-12


def absolute(q):
    """Turns of the parts from beta, theta, gamma, phi, delta, Omega, eps."""
    b, t, g, f, d, o, e = q
    return np.array([b, b + t, g, f + d, d, o + e, e])


def main():
    t = np.linspace(0, END, 121)
    start = np.zeros(14)
    y = solve(rhs, start, t)
    check(y, solve(rhs, start, t, 1e-11))
    columns = {f"VARIABLE/{k}": y[:, k - 1] for k in range(1, 8)}
    columns |= {f"PART/{k + 1}.wz": y[:, 6 + k] for k in range(1, 8)}
    bands = (("", 1e-6, 3e-4, 3e-1), ("-tight", 1e-8, 3e-6, 3e-3))
    for tag, error, angle, rate in bands:
        lines = LINES.format(error=error, angle=angle, rate=rate)
        write(HERE / f"reference{tag}.csv", lines, list(columns), [t, *columns.values()])
    for tag, (step, angle, rate) in TINY.items():
        end = 1000 * step
        t = np.linspace(0, end, 11)
        y = solve(rhs, start, t)
        lines = TINY_LINES.format(step=step, end=end, angle=angle, rate=rate)
        if tag == "nano":
            lines += "".join(
                f"measure: last JOINT/3.{a} = {v} tol abs 1e-4\n"
                for a, v in (("fx", 98.5668704), ("fy", -6.12268834))
            )
        write(HERE / f"reference-{tag}.csv", lines, list(columns), [t, *y[:, :7].T, *y[:, 7:].T])
    (HERE / "andrews.adm").write_text(deck())


def deck():
    """The deck: all part frames lie on the ground frame, so QP are the places at the start."""
    lines = [
        "Andrews' squeezing mechanism",
        "! Seven bodies in a plane, driven by a torque on the first; full revolutes: 9 of",
        "! 50 rows are redundant. Part frames start on the ground frame: QP is the first place.",
        "! Written by make_reference.py",
        "",
        "UNITS/SYSTEM=MKS",
        "",
        "PART/1, GROUND",
    ]
    lines += [marker(100 + k, 1, POINTS[p], p) for k, p in enumerate("OABC")]
    for k, (pins, mass, inertia, centre) in enumerate(PARTS, 1):
        n = k + 1
        ip = f"{inertia:g},{inertia:g},{inertia:g}"
        lines += ["", f"PART/{n}, MASS={mass:g}, CM={10 * n}, IP={ip}  ! {pins}"]
        lines += [marker(10 * n, n, centre, "centre of mass")]
        lines += [marker(10 * n + i, n, POINTS[p], p) for i, p in enumerate(pins, 1)]
    lines += [""]
    for k, (a, b, p) in enumerate(PINS, 1):
        i, j = (on(part, p) for part in (a, b))
        lines.append(f"JOINT/{k}, REVOLUTE, I={i}, J={j}  ! {p}")
    lines += ["", f"SFORCE/1, TRANSLATIONAL, I={on(3, 'D')}, J={on(0, 'C')}"]
    lines += [f", FUNCTION=-{STIFFNESS:g}*(DM({on(3, 'D')},{on(0, 'C')})-{LENGTH:g})"]
    lines += [f"SFORCE/2, ROTATIONAL, ACTIONONLY, I=20, J=100, FUNCTION={TORQUE:g}", ""]
    lines += [f"VARIABLE/{k}, FUNCTION=AZ({10 * (k + 1)})" for k in range(1, 8)]
    lines += [
        "",
        "INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-6",
        f"SIMULATE/DYNAMIC, END={END:g}, STEPS=120",
    ]
    return "\n".join([*lines, "END", ""])


def marker(number, part, place, what):
    return f"MARKER/{number}, PART={part}, QP={place.real:.15g},{place.imag:.15g},0  ! {what}"


def on(part, pin):
    """Marker of a pin on a part (0: ground)."""
    if part == 0:
        return 100 + "OABC".index(pin)
    return 10 * (part + 1) + 1 + PARTS[part - 1][0].index(pin)


if __name__ == "__main__":
    main()

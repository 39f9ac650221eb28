"""Write the references of a winch under a PID controller: closed form of its linear response."""

import sys
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

HEAD = "A load lifted under a PID controller, closed form: see README.md\ntolerance: peak 1e-6"


class Winch:
    """States s = (e, v, I, f, T): error, its rate, integral, filtered error, torque.

    ``ratio``: height per angle.  ``sign``: of the error, sign (wanted - z).  Torque T in force
    times length of the deck, ``ucf`` in force * ucf = mass * acceleration.
    """

    def __init__(self, mass, inertia, ratio, sign, gains, tf, lag, gravity, speed, ucf):
        self.ratio, self.sign, self.gravity, self.speed = ratio, sign, gravity, speed
        self.kp, self.ki, self.kd = gains
        self.tf = tf
        whole = (mass + inertia / ratio**2) / ucf
        self.weight = mass * gravity / ucf
        self.matrix = np.zeros((5, 5))
        self.matrix[0, 1] = 1
        self.matrix[1, 4] = -sign / (ratio * whole)
        self.matrix[2, 0] = 1
        self.matrix[3, 0], self.matrix[3, 3] = 1 / tf, -1 / tf
        kick = self.kp + self.kd / tf
        self.matrix[4] = np.array([kick, 0, self.ki, -self.kd / tf, -1]) / lag
        torque = self.weight * ratio
        self.rest = np.array([0, 0, torque / self.ki, 0, torque])

    def states(self, t):
        """s(t) = s_rest + sum c_k x_k exp(p_k t) with poles p_k and modes x_k, (nt, 5)."""
        poles, modes = np.linalg.eig(self.matrix)
        start = np.array([0, self.sign * self.speed, 0, 0, 0])
        shares = np.linalg.solve(modes, start)
        free = (modes * shares) @ np.exp(np.outer(poles, t))
        assert np.all(poles.real < 0) and np.abs(free.imag).max() < 1e-9 * np.abs(free).max()
        free = free.real.T
        return self.rest + np.where(np.abs(free) < 1e-13 * np.abs(free).max(axis=0), 0.0, free)

    def columns(self, t):
        """What both decks write; error, integral and filtered error."""
        e, v, integral, f, torque = self.states(t).T
        z = self.speed * t - self.sign * e
        slope = (e - f) / self.tf
        return {
            "PART/3.z": z,
            "PART/3.vz": self.speed - self.sign * v,
            "VARIABLE/error": e,
            "VARIABLE/demand": self.ki * integral + self.kp * e + self.kd * slope,
            "SFORCE/1.f": torque,
        }, (e, integral, f)


def check(winch, end):
    """The closed form against an integration of the loop with the plant written out."""

    def rhs(t, s):
        return winch.matrix @ (s - winch.rest)

    start = winch.rest + np.array([0, winch.sign * winch.speed, 0, 0, 0])
    run = solve_ivp(rhs, (0, end), start, "DOP853", [0.3 * end, end], rtol=1e-12, atol=1e-12)
    found = winch.states(np.array([0.3 * end, end]))
    scale = np.abs(found).max(axis=0)
    assert np.all(np.abs(run.y.T - found) < 1e-9 * scale)


def main():
    lifting = Winch(200, 5, 0.25, 1, (1120, 700, 448), 0.02, 0.05, 9.81, 0.4, 1)
    lowering = Winch(60, 2e5, -150, -1, (600, 300, 200), 0.04, 0.08, 9806.65, -120, 1000)
    for name, winch, end in (("pid-winch", lifting, 5.0), ("pid-winch-mm", lowering, 4.0)):
        check(winch, end)
        t = np.linspace(0, end, 101)
        columns, (e, integral, f) = winch.columns(t)
        if name == "pid-winch":
            columns |= {"DIFF/ARRAY_2_1": integral, "DIFF/ARRAY_2_2": f}
        else:
            # x1 = y - q0 e and x2 = dx1/dt - q1 e of y/e = q0 + q1/p + ...
            kick, rate = winch.kp + winch.kd / winch.tf, winch.kd / winch.tf**2
            columns["DIFF/ARRAY_2_1"] = winch.ki * integral - winch.kd / winch.tf * f
            columns["DIFF/ARRAY_2_2"] = rate * f
            assert np.allclose(columns["VARIABLE/demand"], columns["DIFF/ARRAY_2_1"] + kick * e)
        columns["DIFF/ARRAY_12_1"] = columns["SFORCE/1.f"]
        write(HERE / f"{name}.reference.csv", HEAD, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()

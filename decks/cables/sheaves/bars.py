"""A rope over bars that are held, pulled slowly: equations of its displacements.

Span p between bars has the free length L_p + u_p - u_(p+1), u_i the displacement of the rope at bar
i towards the winch, of which friction has worked up the share k_i of its greatest:

    T_p = EA (l_p/(L_p + u_p - u_(p+1)) - 1),      T_i = T_(i-1) exp(mu b_i k_i)

While u_i grows or falls steadily from u0, k0 (Dahl's law without rates),

    k = s - (s - k0) exp(-|u - u0|/grip),          s = sign(u - u0)

With k = 1 this is Euler's and Eytelwein's product over all bars.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Bars:
    """Free lengths and lengths of the spans (n + 1,), wraps of the bars (n,) [m, N, rad]."""

    ea: float
    pretension: float
    lengths: np.ndarray
    wraps: np.ndarray
    mu: float
    grip: float

    @property
    def free(self):
        """Unstretched lengths at the start."""
        return self.lengths / (1 + self.pretension / self.ea)

    def tensions(self, u, payout):
        """Of the spans, with displacements u of the rope at the bars (n,)."""
        moved = np.concatenate([[0], u, [-payout]])
        return self.ea * (self.lengths / (self.free - np.diff(moved)) - 1)

    def shares(self, u, phase):
        """Of the friction, in a phase that began with (u0, k0) and goes to the side s."""
        u0, k0, s = phase
        return s - (s - k0) * np.exp(-s * (u - u0) / self.grip)

    def at_rest(self, u, payout, phase):
        """Displacements with which every bar is in balance: Newton's method from a guess u."""
        for _ in range(2000):
            moved = np.concatenate([[0], u, [-payout]])
            length = self.free - np.diff(moved)
            t = self.ea * (self.lengths / length - 1)
            slope = self.ea * self.lengths / length**2 / t  # of ln T_p over u_(p+1)
            u0, k0, s = phase
            gain = (1 - s * k0) * np.exp(-s * (u - u0) / self.grip) / self.grip
            off = np.diff(np.log(t)) - self.mu * self.wraps * self.shares(u, phase)
            matrix = np.diag(-slope[1:] - slope[:-1] - self.mu * self.wraps * gain)
            matrix += np.diag(slope[1:-1], 1) + np.diag(slope[1:-1], -1)
            step = np.linalg.solve(matrix, off)
            u = u - step * min(1, 2 * self.grip / max(np.abs(step).max(), self.grip))
            if np.abs(step).max() < 1e-13:
                return u
        raise AssertionError(f"no balance at a payout of {payout}")

    def motion(self, payouts):
        """Displacements and tensions at payouts that fall and then rise, every bar following."""
        n, turn = len(self.wraps), int(np.argmin(payouts))
        u, k, rows = np.zeros(n), np.zeros(n), []
        phase = (u, k, 1.0)
        for row, payout in enumerate(payouts):
            if row == turn + 1:
                phase = (u, self.shares(u, phase), -1.0)
            u = self.at_rest(u, payout, phase)
            rows.append(np.concatenate([u, self.tensions(u, payout)]))
        rows = np.array(rows)
        steps = np.diff(rows[:, :n], axis=0)
        assert (steps[:turn] > -1e-12).all() and (steps[turn:] < 1e-12).all()
        return rows[:, :n], rows[:, n:]

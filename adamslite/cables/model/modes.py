"""Vibrations of a network in its modes, exact for forces that are linear between instants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

# A mode at rest, in periods within the run: drifts like one without stiffness.
SLOW = 1e-4
# Of critical damping: beyond it a mode creeps, as it does here.
CREEPS = 0.99
# Radians in the time of a wave along the cable from which a mode is one of waves.
WAVE = 1.2
# Radians in a step from which a mode is too fast for the instants.
FAST = 0.8
# Of a step in a mode's own time: series are as good as what they stand for.
SHORT = 1e-3
ROUND_OFF = 1e-9


@dataclass(frozen=True)
class Times:
    """Of a run, of a step between its instants, of a wave along the longest span."""

    end: float
    step: float
    transit: float


class Modes:
    """Modes by their rates: `shapes` in columns, of unit modal mass; `held` F times which is what
    keeps all of them at rest."""

    def __init__(
        self, times: Times, shapes: np.ndarray, mass: np.ndarray, rates: np.ndarray
    ) -> None:
        self.times, self.shapes, self.mass = times, shapes, mass
        self.rates = np.maximum(rates, SLOW / times.end)
        self.damping = np.zeros(len(rates))
        self.held = np.zeros((len(shapes), 0))

    def run(
        self, forces: np.ndarray, speeds: np.ndarray, window: float
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Ways and accelerations from rest, with `speeds` at the start, and the amplitudes of modes
        that are too fast for the instants: their ways and accelerations are those at rest.
        """
        w, z = self.rates, self.damping
        pole = -z * w + 1j * w * np.sqrt(1 - z**2)
        p = forces @ self.shapes
        rest = p / w**2
        grown = np.exp(pole * self.times.step)
        steady, ramp = _gains(pole * self.times.step)
        gains = self.times.step * (p[:-1] * steady + (p[1:] - p[:-1]) * ramp)
        state = np.empty((len(p), len(w)), dtype=complex)
        state[0] = self.shapes.T @ self.mass @ speeds
        for i in range(len(p) - 1):
            state[i + 1] = grown * state[i] + gains[i]
        q = state.imag / pole.imag
        v = state.real - z * w * q
        seen = np.sinc(w * window / (2 * np.pi))
        # What is slow is seen as it is, what vibrates through the window. What is too fast for the
        # instants keeps the swing of its start: forces are smooth against it.
        swing = q - rest
        fast = w * self.times.step > FAST
        times = self.times.step * np.arange(len(p))[:, None]
        began = np.hypot(rest[0], v[0] / w) * np.exp(-times * (z * w))
        self.swings = np.where(fast, began, np.hypot(swing, v / w))
        self.largest = np.where(w * self.times.transit > WAVE, self.swings.max(axis=0), 0.0)
        amplitudes = np.where(fast, np.abs(seen) * began, 0.0)
        seen = np.where(fast, 0.0, seen)
        q = np.where(w * window < ROUND_OFF, q, rest + seen * swing)
        rates = -(w**2) * seen * swing - 2 * z * w * seen * v
        return q @ self.shapes.T, rates @ self.shapes.T, amplitudes


def _gains(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(e^x - 1)/x and (e^x - 1 - x)/x^2: of a force, and of one that grows over a step."""
    first = np.expm1(x) / x
    series = 0.5 + x / 6 + x**2 / 24
    return first, np.where(np.abs(x) < SHORT, series, (first - 1) / x)

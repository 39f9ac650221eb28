"""Coefficients of an explicit formula of order 4 with four stages for point masses.

    k_i = a(t + c_i h, q + c_i h u + h^2 sum B_ij k_j, u + h sum A_ij k_j)
    q+ = q + h u + h^2 sum b_i (1 - c_i) k_i,    u+ = u + h sum b_i k_i

A, b and c are those of the 3/8 rule of Runge and Kutta.  Rows of B have the sum c_i^2/2, and with
sum b_i B_ij c_j = 1/24 the formula has order 4 for accelerations of any kind; the rest of B was
chosen so that vibrations are stable as far as w h = 4.99 (4.46 with 5 % of the critical damping,
2.8 with 30 %), 1.25 for each evaluation; the 3/8 rule itself has 0.7, the pair of order 8 has 0.5.
The rates of the new state k_5, the first of the next step, serve an error estimate of order 3::

    h/1.6 (-k_1 + 3 k_2 - 3 k_3 - 3 k_4 + 4 k_5) in u,    h^2/3.2 (-k_1 + 2 k_2 - k_3) in q

References: Nystrom, Acta Soc. Sci. Fennicae 50 (1925) nr. 13; Hairer, Norsett, Wanner, Solving
ODE I, 1993, section II.14 (conditions of order).  Divisors ten times as large would leave the
estimates above the errors of a vibration up to w h = 4; with these, runs at a loose ERROR are as
accurate as by the pair of order 8, whose errors are far below its estimate there.
"""

from __future__ import annotations

NODES = (0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0)
#: Stages 1 to 3 and the result: {stage: (weight in u, weight in q)}.
STAGES = (
    {0: (1.0 / 3.0, 1.0 / 18.0)},
    {0: (-1.0 / 3.0, 17.0 / 225.0), 1: (1.0, 11.0 / 75.0)},
    {0: (1.0, 0.075), 1: (-1.0, 0.29), 2: (1.0, 0.135)},
    {0: (0.125, 0.125), 1: (0.375, 0.25), 2: (0.375, 0.125), 3: (0.125, 0.0)},
)
#: The divisors of the error estimates.
U_SCALE, Q_SCALE = 1.6, 3.2

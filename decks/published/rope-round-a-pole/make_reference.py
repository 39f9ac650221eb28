"""Write description and deck of a load that is let down round a pole, and the holding force.

F = M g exp(-mu alpha), alpha = 3/2 pi
"""

from pathlib import Path

import numpy as np

from adamslite.cables.deck.scene import deck

HERE = Path(__file__).resolve().parent
SCENE = """\
# Written by make_reference.py.
title = "A load let down round a pole"
end = 16
steps = 1600
error = 1e-6

[cable]
EA = 1e6
rho = 1e-3
damping_time = 6.26e-05

[[route]]
kind = "mass"
at = [0.1, -3, 0]
mass = 100

# A pole does not turn; the rope slides round three quarters of it.
[[route]]
kind = "pulley"
at = [0, 0, 0]
radius = 0.1
held = true
mu = 0.2
turn = 1

# The hand, which lets out 0.1 m/s from 4 s on.
[[route]]
kind = "winch"
at = [3, 0, 0]
radius = 0.1
inertia = 0.1
payout = "0.1*IF(TIME-4:4*(2.5*(TIME/4)**4-3*(TIME/4)**5+(TIME/4)**6),2,2+TIME-4)"

[model]
level = 3
form = "ale"
elements = 3
"""

(HERE / "rope-round-a-pole.toml").write_text(SCENE)
(HERE / "rope-round-a-pole.adm").write_text(deck(SCENE)[0])
FORCE = 100 * 9.81 * np.exp(-0.2 * 1.5 * np.pi)
LINES = [
    "# The force that holds the load as it sinks: see README.md",
    "# written by make_reference.py",
    f"# measure: mean REQUEST/30.F6 from 6 = {FORCE:.6f} tol rel 1e-4",
]
(HERE / "rope-round-a-pole.reference.csv").write_text("\n".join(LINES) + "\n")

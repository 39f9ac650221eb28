"""Write descriptions and decks of a belt that runs over a drum which is held, and its tensions.

(T1 - rho v^2)/(T2 - rho v^2) = exp(mu pi)
"""

from pathlib import Path

import numpy as np

from adamslite.cables.deck.scene import deck

HERE = Path(__file__).resolve().parent
SLACK, RHO, MU = 1000.0, 1.0, 0.2
LAW = (
    "-IF(TIME-8:{way:g}*(2.5*(TIME/8)**4-3*(TIME/8)**5+(TIME/8)**6)"
    ",{half:g},{half:g}+{speed:g}*(TIME-8))"
)
SCENE = """\
# Written by make_reference.py.
title = "A belt that slips on a drum at {speed:g} m/s"
end = 12
steps = 240
error = 1e-6
gravity = [0, 0, 0]

[cable]
EA = 1e6
rho = {rho:g}
pretension = {slack:g}
damping_time = 0.396

# It draws the belt in: up to speed within 8 s, steadily behind that.
[[route]]
kind = "winch"
at = [-200, -0.4, 0]
radius = 0.1
inertia = 1e-3
payout = "{law}"

[[route]]
kind = "pulley"
at = [0, 0, 0]
radius = 0.5
held = true
mu = {mu:g}

# It holds the slack side back.
[[route]]
kind = "winch"
at = [-200, 0.4, 0]
radius = 0.1
inertia = 1e-3
force = "{slack:g}"

[model]
level = 3
form = "ale"
elements = 1
"""

for name, speed in (("slow", 1.0), ("fast", 20.0)):
    given = {"rho": RHO, "slack": SLACK, "mu": MU, "way": 8 * speed, "half": 4 * speed}
    text = SCENE.format(speed=speed, law=LAW.format(speed=speed, **given), **given)
    (HERE / f"{name}.toml").write_text(text)
    (HERE / f"{name}.adm").write_text(deck(text)[0])
    hoop = RHO * speed**2
    tight = hoop + (SLACK - hoop) * np.exp(MU * np.pi)
    lines = [
        "# Tension of the tight side at the drum: see README.md",
        "# written by make_reference.py",
        f"# measure: mean REQUEST/1.F3 from 11 = {tight:.4f} tol rel 1e-4",
        f"# measure: mean REQUEST/2.F2 from 11 = {SLACK:.4f} tol rel 1e-4",
    ]
    (HERE / f"{name}.reference.csv").write_text("\n".join(lines) + "\n")

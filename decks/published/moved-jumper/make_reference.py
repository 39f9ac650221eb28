"""Write descriptions and decks of a jumper whose upper end moves, and what was printed of its pull.

The values are read from the curves of the paper, at steps of 0.032 kN, after a first period in
which the motion grows; there is no closed form.
"""

from pathlib import Path

from adamslite.cables.deck.scene import deck

HERE = Path(__file__).resolve().parent
SCENE = """\
# Written by make_reference.py.
title = "A jumper in water, its upper end moves along {axis}"
end = 81
steps = 810
statics = true
error = 1e-5
gravity = [0, -9.807, 0]

[cable]
EA = 5e8
rho = 165
diameter = 0.396
length = 170
bending = 120.8e3
damping_time = 0.000945

[water]
density = 1000
level = 0
drag = {{ normal = 1, tangential = 0 }}
added_mass = 1

[[route]]
kind = "fixed"
at = [-100, -55, 0]

# 10 m to both sides every 27 s, up to which it grows.
[[route]]
kind = "fixed"
at = [0, -5, 0]
motion = [{motion}]

[model]
level = 2
elements = 68
"""
LAW = "10*SIN(2*PI*TIME/27)*STEP5(TIME,0,0,27,1)"
#: Extremes [N] of the pull at the top within windows [s], and a shoulder.
READ = {
    "surge": (
        ("max", "from 54", 52239.46), ("min", "from 54", 41580.80),
        ("max", "from 66 to 69", 47022.83), ("min", "from 69.5 to 72", 46314.40),
    ),
    "sway": (("max", "from 54", 49115.93), ("min", "from 54", 44382.32)),
    "heave": (("max", "from 54", 57778.10), ("value", "at 34", 43770.49)),
}  # fmt: skip
#: Ways of surge, sway and heave.
AXES = {"surge": "x", "sway": "z", "heave": "y"}

for name, values in READ.items():
    axis = AXES[name]
    motion = ", ".join(f'"{LAW if way == axis else 0}"' for way in "xyz")
    text = SCENE.format(axis=axis, motion=motion)
    (HERE / f"{name}.toml").write_text(text)
    (HERE / f"{name}.adm").write_text(deck(text)[0])
    lines = ["# Extremes of the pull at the top: see README.md", "# written by make_reference.py"]
    for kind, window, value in values:
        near = 4e-3 if kind == "value" else 2.5e-3
        lines.append(f"# measure: {kind} REQUEST/1.F3 {window} = {value:.2f} tol rel {near:g}")
    (HERE / f"{name}.reference.csv").write_text("\n".join(lines) + "\n")

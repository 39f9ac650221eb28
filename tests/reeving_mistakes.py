"""Mistakes in the order of stations and in the friction on wheels: code, description, what is
replaced, by what, the line and column of the caret."""

from descriptions import ATWOOD, HOIST

PULLEY = "radius = 0.2"
MASS = 'kind = "mass"\nat = [0, -5, 0]'
#: The same with names, and the order of its stations as a text.
NAMED = (
    ATWOOD.replace("end = 0.5", 'end = 0.5\nfall = "m1 p1 p2 m2"')
    .replace("mass = 5", 'mass = 5\nname = "m1"')
    .replace("inertia = 0.04", 'inertia = 0.04\nname = "p1"', 1)
    .replace("inertia = 0.04\n[[", 'inertia = 0.04\nname = "p2"\n[[', 1)
    .replace("mass = 3", 'mass = 3\nname = "m2"')
)
#: A load on two ropes.
SHARED = """\
end = 1
[[cable]]
EA = 1e6
rho = 0.1
fall = "a1 h1"
[[cable]]
EA = 2e6
rho = 0.1
fall = "a2 h2"
[[load]]
at = [0, -5, 0]
mass = 50
[[route]]
kind = "fixed"
name = "a1"
at = [0, 0, 0]
[[route]]
kind = "hook"
name = "h1"
at = [0, -5, 0]
[[route]]
kind = "fixed"
name = "a2"
at = [0, 0, 0]
[[route]]
kind = "hook"
name = "h2"
at = [0, -5, 0]
"""
#: The second one goes round a sheave on the load.
ROUND = SHARED.replace("a2 h2", "a2 s2 b2").replace("mass = 50", "mass = 50\ninertia = 5").replace(
    'kind = "hook"\nname = "h2"\nat = [0, -5, 0]',
    'kind = "pulley"\nload = "box"\nname = "s2"\nat = [0.1, -5, 0]\nradius = 0.1\ninertia = 0.1\n'
    '[[route]]\nkind = "fixed"\nname = "b2"\nat = [0.2, 0, 0]',
).replace("[[load]]", '[[load]]\nname = "box"')  # fmt: skip
#: Its load has a name.
BOXED = SHARED.replace("[[load]]", '[[load]]\nname = "box"').replace(
    'kind = "hook"', 'kind = "hook"\nload = "box"'
)
SECOND = "[[load]]\nat = [0, -5, 0]\nmass = 5"
MISTAKES = {
    "parts-where": (SHARED, "rho = 0.1", "rho = 0.1\nparts = true", (5, 1)),
    "parts-form": (
        ATWOOD, "rho = 0.01", "rho = 0.01\nbreaking_load = 4e3\nparts = true", (6, 1)
    ),
    "in-two-falls": (
        SHARED.replace('[[route]]\nkind = "fixed"\nname = "a2"\nat = [0, 0, 0]\n', ""),
        '"a2 h2"', '"a1 h2"', (9, 9),
    ),
    "several-closed": (SHARED, "end = 1", "end = 1\nclosed = true", (2, 1)),
    "several-falls": (SHARED, "end = 1", 'end = 1\nfall = "a1 h1"', (2, 1)),
    "several-brute": (SHARED, "[[load]]", '[model]\nform = "brute"\n[[load]]', (11, 1)),
    "no-such-load": (SHARED, 'name = "h1"', 'name = "h1"\nload = "box"', (20, 1)),
    "no-load": (
        HOIST, 'kind = "mass"\nat = [0, -20, 0]\nmass = 1000',
        'kind = "hook"\nat = [0, -20, 0]', (12, 1),
    ),
    "which-load": (
        BOXED.replace('load = "box"\nname = "h2"', 'name = "h2"'),
        "mass = 50", f"mass = 50\n{SECOND}\ninertia = 3\npivot = {{ at = [0, 0, 0] }}", (32, 1),
    ),
    "same-load": (BOXED, "mass = 50", f'mass = 50\n{SECOND}\nname = "box"', (14, 1)),
    "no-hook": (BOXED, "mass = 50", f"mass = 50\n{SECOND}", (14, 1)),
    "load-point": (
        SHARED, 'name = "h1"\nat = [0, -5, 0]', 'name = "h1"\nat = [0, -5, 0.5]', (20, 1)
    ),
    "load-alone": (ROUND, "radius = 0.1", "radius = 0.1\nmass = 3", (33, 1)),
    "not-shared": (SHARED, "[[load]]", "[model]\nlevel = 1\n[[load]]", (11, 1)),
    "unbalanced": (
        SHARED, "at = [0, -5, 0]\nmass = 50", "at = [1, -6, 0]\nmass = 50\ninertia = 5", (10, 1)
    ),
    "length-too-long": (SHARED, "rho = 0.1", "rho = 0.1\nlength = 8", (5, 1)),
    "no-such-station": (NAMED, '"m1 p1 p2 m2"', '"m1 p1 p2 m2 p3"', (2, 21)),
    "twice-in-fall": (NAMED, '"m1 p1 p2 m2"', '"m1 p1 p2 p1 m2"', (2, 18)),
    "not-in-fall": (NAMED, '"m1 p1 p2 m2"', '"m1 p1 m2"', (17, 1)),
    "same-name": (NAMED.replace("m1 p1 p2 m2", "m1 p1 m2"), 'name = "p2"', 'name = "p1"', (22, 1)),
    "no-pitch": (ATWOOD, PULLEY, f"{PULLEY}\ncount = 3", (13, 1)),
    "too-many-stations": (ATWOOD, PULLEY, f"{PULLEY}\ncount = 1000000\npitch = [1, 0, 0]", (13, 1)),
    "held-grips": (ATWOOD, PULLEY, f"{PULLEY}\nheld = true", (13, 1)),
    "held-turns": (ATWOOD, PULLEY, f"{PULLEY}\nheld = true\nmu = 0.2\nfriction = 3", (15, 1)),
    "without-mu": (ATWOOD, PULLEY, f"{PULLEY}\ngrip = 1e-4", (13, 1)),
    "static-grip": (ATWOOD, PULLEY, f"{PULLEY}\nmu = 0.2\nmu_static = 0.3", (14, 1)),
    "static-below": (ATWOOD, PULLEY, f"{PULLEY}\nmu = 0.2\ngrip = 1e-4\nmu_static = 0.1", (15, 1)),
}  # fmt: skip

HOIST_DRIVE = 'payout = "0.5*TIME**2"'
CURVE = "curve = [[0, 900], [5, 0]]"
SPEED = 'speed = "TIME"'
MISTAKES |= {
    "law-drives": (HOIST, HOIST_DRIVE, f"{HOIST_DRIVE}\nlimit = [-1, 3]", (12, 1)),
    "motor-force": (HOIST, HOIST_DRIVE, f'force = "9"\nmotor = {{ {CURVE} }}', (12, 1)),
    "no-gain": (HOIST, HOIST_DRIVE, f"{SPEED}\nmotor = {{ {CURVE} }}", (12, 1)),
    "needless-gain": (
        HOIST, HOIST_DRIVE, f'torque = "9"\nmotor = {{ {CURVE}, gain = 5 }}', (12, 1)
    ),
    "block-ways": (
        ATWOOD.replace(PULLEY, f'{PULLEY}\nmass = 2\nslide = [0, 1, 0]\nblock = "b"'),
        "slide = [0, 1, 0]", "slide = [1, 0, 0]", (23, 1),
    ),
    "limit-start": (HOIST, HOIST_DRIVE, 'torque = "9"\nlimit = [1, 3]', (12, 1)),
    "floor-where": (
        ATWOOD.replace("end = 0.5", "end = 0.5\ngravity = [0, 0, 0]"),
        "mass = 5", "mass = 5\nfloor = { depth = 1, stiffness = 1e6 }", (10, 1),
    ),
}  # fmt: skip

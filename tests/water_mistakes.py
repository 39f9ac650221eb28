"""Mistakes about water, a sea bed, bending and the length of a cable: code, description, what is
replaced, by what, the line and column of the caret."""

from descriptions import ATWOOD

#: A cable of given length hangs in water above a bed.
MOORED = """\
end = 1
statics = true
[cable]
EA = 1e8
rho = 20
diameter = 0.1
length = 120
[water]
density = 1000
[bed]
level = -60
stiffness = 1e5
[[route]]
kind = "fixed"
at = [0, 0, 0]
[[route]]
kind = "fixed"
at = [100, 0, 0]
[model]
elements = 10
"""
WEIGHTLESS = MOORED.replace("[cable]", "gravity = [0, 0, 0]\n[cable]").replace("= 120", "= 90")
MISTAKES = {
    "no-diameter": (MOORED.replace("[bed]\nlevel = -60\nstiffness = 1e5\n", ""),
                    "diameter = 0.1\n", "", (7, 1)),
    "no-depth": (WEIGHTLESS.replace("[bed]\nlevel = -60\nstiffness = 1e5\n", ""),
                 "density = 1000", "density = 1000\nlevel = 5", (11, 1)),
    "no-bending": (MOORED, "length = 120", "length = 120\nbending_damping = 0.1", (8, 1)),
    "length-of-what": (MOORED, 'kind = "fixed"\nat = [0', 'kind = "free"\nat = [0', (7, 1)),
    "length-and-tension": (MOORED, "length = 120", "length = 120\npretension = 5", (8, 1)),
    "length-too-short": (MOORED, "length = 120", "length = 20", (7, 1)),
    "no-nodes": (ATWOOD, "rho = 0.01", "rho = 0.01\nbending = 3", (5, 1)),
    "below-bed": (MOORED, "at = [100, 0, 0]", "at = [100, -61, 0]", (18, 1)),
}  # fmt: skip

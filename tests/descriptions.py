"""Cable scenes as a user describes them to `adamslite cable`, and the run of such a scene."""

import adamslite
from adamslite.cables.deck.scene import deck

G = 9.81
#: Two weights on a rigid cable over two pulleys.
ATWOOD = """\
end = 0.5
[cable]
EA = 1e7
rho = 0.01
[[route]]
kind = "mass"
at = [0, -5, 0]
mass = 5
[[route]]
kind = "pulley"
at = [0.2, 0, 0]
radius = 0.2
inertia = 0.04
[[route]]
kind = "pulley"
at = [1.8, 0, 0]
radius = 0.2
inertia = 0.04
[[route]]
kind = "mass"
at = [2, -5, 0]
mass = 3
[model]
level = 1
"""
#: The line with the law of HOIST.
PAYOUT = 'payout = "0.5*TIME**2"'


def hoist(end: float, cable: str, radius: float, inertia: float, law: str, mass: float) -> str:
    """A winch and a weight that hangs 20 m below it; `cable` are the lines of its table."""
    return f"""\
end = {end}
[cable]
{cable}
[[route]]
kind = "winch"
at = [{-radius}, 0, 0]
radius = {radius}
inertia = {inertia}
turn = -1
payout = "{law}"
[[route]]
kind = "mass"
at = [0, -20, 0]
mass = {mass}
"""


def hung(end: float, cable: str, at: tuple[float, float], mass: float) -> str:
    """A weight on a cable from the origin; `cable` are the lines of its table."""
    return f"""\
end = {end}
[cable]
{cable}
[[route]]
kind = "fixed"
at = [0, 0, 0]
[[route]]
kind = "mass"
at = [{at[0]}, {at[1]}, 0]
mass = {mass}
"""


#: A winch lets a weight down.
HOIST = hoist(2, "EA = 2e7\nrho = 4", radius=0.5, inertia=25, law="0.5*TIME**2", mass=1000)
#: A closed belt that a winch drives.
BELT = """\
end = 0.1
closed = true
gravity = [0, 0, 0]
[cable]
EA = 2e4
rho = 0.2
pretension = 600
[[route]]
kind = "winch"
at = [0, 0, 0]
radius = 0.1
inertia = 0.1
payout = "2*TIME"
[[route]]
kind = "pulley"
at = [0.3, 0, 0]
radius = 0.1
inertia = 0.1
"""
#: A weight, or a body, on a straight wire.
WIRE = """\
end = 1
steps = 20
error = 1e-8
[cable]
EA = 1e7
rho = 0.1
[[route]]
kind = "fixed"
at = [0, 0, 0]
[[route]]
kind = {kind}
at = [1.6, 1.2, 0]
mass = 20
velocity = [0.8, 0.6, 0]
slides = true
{haul}
[[route]]
kind = "fixed"
at = [8, 6, 0]
[model]
level = 1
"""

# A block of 50 kg and a wheel of J/R^2 = 2 kg on a vertical slide, and the first of its two legs.
BLOCK = """\
[[route]]
kind = "fixed"
at = [-0.1, 0, 0]
[[route]]
kind = "pulley"
at = [0, -2, 0]
radius = 0.1
inertia = 0.02
mass = 50
slide = [0, 1, 0]
"""


def folded(depth: float, radius: float, other: str, end: float) -> str:
    """A chain of 51 sections that hangs in a fold; its second end is `other`: fixed or free."""
    return f"""\
end = {end}
steps = {round(1000 * end)}
[cable]
EA = 1e5
rho = 1
damping = 0.1
[[route]]
kind = "fixed"
at = [0, 0, 0]
[[route]]
kind = "bend"
at = [{radius}, {-depth}, 0]
radius = {radius}
[[route]]
kind = "{other}"
at = [{2 * radius}, 0, 0]
[model]
elements = 51
"""


def solve(spec: str, warns: bool = False) -> adamslite.Results:
    """The run of the deck that is written, with or without warnings, for a description."""
    text, warnings = deck(spec)
    assert bool(warnings) is warns
    results = adamslite.simulate(adamslite.read(text))
    assert results.outcome.name == "DONE"
    return results

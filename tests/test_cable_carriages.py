"""The half section beside a wheel whose axle moves, as `adamslite cable` writes it."""

import numpy as np
import pytest

import adamslite
from adamslite.cables.deck.scene import deck

G = 9.81
#: A block of M = 82 kg (J/R^2 = 2 kg of it) hangs in a rope of 3 kg/m, 5 m of it on either side.
HANGS = """\
end = 4
error = 1e-7
[cable]
EA = 1e7
rho = 3
damping = 0.5
[[route]]
kind = "fixed"
at = [-0.2, 0, 0]
[[route]]
kind = "pulley"
at = [0, -5, 0]
radius = 0.2
inertia = 0.08
mass = 80
{slide}
[[route]]
kind = "fixed"
at = [0.2, 0, 0]
[model]
level = {level}
elements = {elements}
"""


@pytest.mark.parametrize("elements", [1, 3])
@pytest.mark.parametrize("level", [2, 3])
def test_a_block_carries_the_half_sections_beside_it(level: int, elements: int) -> None:
    """At rest T = M g/2 at the block for any number of sections, and rho g l more above."""
    spec = HANGS.format(slide="slide = [0, 1, 0]", level=level, elements=elements)
    found = adamslite.simulate(adamslite.read(deck(spec)[0]))
    late = found.time > 3
    for channel, exact in (("F2", 41 * G), ("F3", (41 + 3 * 5) * G)):
        for span in (1, 2):
            mean = np.mean(found[f"REQUEST/{span}.{channel}"][late])
            assert mean == pytest.approx(exact, rel=3e-4)

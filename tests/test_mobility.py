"""What the constraints of a model let its bodies do."""

import numpy as np
import pytest

import adamslite
from adamslite.assembly.mobility import mobilities

#: A part on a joint half a metre from its mass centre, turned by 90 degrees about x: its y lies
#: along z.
TURNED = """a part that is turned
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=2, IP=1,3,5, QG=-0.5,0,0, REULER=0,90D,0
MARKER/2, PART=2
MARKER/3, PART=2, QP=0.5,0,0
JOINT/1, {kind}, I=3, J=1
END
"""


def test_inertia_is_that_in_ground_axes() -> None:
    found = mobilities(adamslite.read(TURNED.format(kind="SPHERICAL")))[0]
    np.testing.assert_allclose(found.mass([0]), np.diag([2, 2, 2, 1, 5, 3]), atol=1e-12)
    assert found.motions.shape == (6, 3)


@pytest.mark.parametrize(("kind", "free"), [("SPHERICAL", 3), ("REVOLUTE", 1), ("FIXED", 0)])
def test_a_joint_leaves_as_many_motions_as_it_has_freedoms(kind: str, free: int) -> None:
    """At the joint nothing is displaced: the mass centre goes round it."""
    found = mobilities(adamslite.read(TURNED.format(kind=kind)))[0]
    assert found.motions.shape == (6, free)
    np.testing.assert_allclose(found.carried(0, np.zeros(3))[:3], 0, atol=1e-12)
    assert found.moves_against(0, -1) == (free > 0)

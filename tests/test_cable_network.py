"""The linear model of a cable scene against closed forms."""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest

from adamslite.cables.deck.scene import setting
from adamslite.cables.model.network import Bar, Network, respond

EA, RHO, L, M, V = 2e6, 0.5, 12.0, 60.0, 0.7
HUNG = Bar((), ((0, 1.0),), L, (EA, EA), points=(False, True))


def hung(end: float, **more: object) -> Network:
    """A weight at the end of a held cable."""
    return Network((M,), (HUNG,), RHO, end, 600, more.pop("speeds", (V,)), **more)  # type: ignore[arg-type]


def test_one_section_is_a_spring_with_half_the_mass() -> None:
    """u = V/w sin w t, w^2 = EA/(L (M + rho L/2)); tensions with the half sections at the ends."""
    motion = respond(hung(1.0), 1)
    t = np.linspace(0, 1, 601)
    w = sqrt(EA / L / (M + RHO * L / 2))
    np.testing.assert_allclose(motion.ways[:, 0], V / w * np.sin(w * t), atol=1e-9 * V / w)
    np.testing.assert_allclose(motion.tensions[:, 0], EA / L * V / w * np.sin(w * t), atol=1e-6)
    np.testing.assert_allclose(motion.tensions[:, 1], M * w * V * np.sin(w * t), rtol=1e-9)


def test_many_sections_have_the_first_frequency_of_a_rod() -> None:
    """rho L/M = b tan b with b = w L/c."""
    c = sqrt(EA / RHO)
    low, high = 1e-3, pi / 2 - 1e-6
    for _ in range(200):
        b = (low + high) / 2
        low, high = (b, high) if b * sin(b) / cos(b) < RHO * L / M else (low, b)
    motion = respond(hung(2 * pi * L / (b * c)), 60)
    # After one period of the first mode the weight is back where it was, but for the others.
    assert abs(motion.ways[-1, 0]) < 5e-3 * np.abs(motion.ways).max()


def test_a_payout_carries_the_weight_along() -> None:
    """a t^2/2 at the root: the weight follows, and one section carries M a/(1 + rho L/(2 M)) in
    the mean."""
    t = np.linspace(0, 5, 601)
    network = Network(
        (1.0, M), (Bar(((0, 1.0),), ((1, 1.0),), L, (EA, EA), points=(False, True)),), RHO, 5.0,
        600, (0.0, 0.0), damping_time=1.8 * L * sqrt(RHO / EA), ways={0: 0.3 * t**2 / 2},
    )  # fmt: skip
    motion = respond(network, 1)
    stretch = (M + RHO * L / 2) * 0.3 * L / EA
    assert motion.ways[-1, 1] == pytest.approx(0.3 * 25 / 2 - stretch, abs=1e-6)
    assert motion.tensions[-1, 1] == pytest.approx(-M * 0.3, rel=1e-4)


@pytest.mark.parametrize("inertia", [1e3, 2.5e6])
def test_what_only_drifts_is_not_drowned_by_the_rates_of_sections(inertia: float) -> None:
    """A weight on a wheel that nothing else holds: F t^2/2 over all masses. Where sections swing
    at 1e6 rad/s, round-off of w^2 is 1e-4 1/s^2: 6 % of this drift with modes from w^2."""
    t = np.linspace(0, 1, 601)
    bar = Bar(((0, 1.0),), ((1, 1.0),), 3.0, (1e7, 1e7), points=(False, True))
    network = Network(
        (inertia, 30.0),
        (bar,),
        0.002,
        1.0,
        600,
        (0.0, 0.0),
        damping_time=2e-7,
        forces={0: 22 * 9.81},
    )
    motion = respond(network, 128)
    drift = 22 * 9.81 * t**2 / 2 / (inertia + 30.0 + 0.006)
    np.testing.assert_allclose(motion.ways[:, 0], drift, atol=2e-5 * drift[-1])


def test_a_rigid_cable_has_the_tension_that_keeps_its_length() -> None:
    """-M a in a cable without mass, and no speed along one that is held."""
    t = np.linspace(0, 1, 601)
    bar = Bar(((0, 1.0),), ((1, 1.0),), L, (EA, EA), points=(False, True))
    network = Network((1.0, M), (bar,), RHO, 1.0, 600, (0.0, V), ways={0: t**2})
    motion = respond(network, 0, rigid=True)
    np.testing.assert_allclose(motion.tensions, -2 * M, rtol=1e-6)
    np.testing.assert_allclose(motion.ways[:, 1], t**2, atol=1e-12)


def test_what_cannot_be_rigid_is_told() -> None:
    """Two ends that laws move apart."""
    t = np.linspace(0, 1, 601)
    bar = Bar(((0, 1.0),), ((1, 1.0),), L, (EA, EA))
    network = Network((1.0, 1.0), (bar,), RHO, 1.0, 600, (0.0, 0.0), ways={0: t, 1: 2 * t})
    with pytest.raises(np.linalg.LinAlgError):
        respond(network, 0, rigid=True)


#: A load that hangs over a block which a force holds; the rope has all but no weight.
BLOCK = """\
end = 1
[cable]
EA = 1e7
rho = 1e-6
[[route]]
kind = "fixed"
at = [-0.4, -3, 0]
[[route]]
kind = "pulley"
at = [0, 0, 0]
radius = 0.4
inertia = 6
mass = 60
slide = [0, 1, 0]
pull = "PULL"
[[route]]
kind = "mass"
at = [0.4, -9, 0]
mass = 40
"""


def test_what_pulls_a_block_takes_part_in_its_balance() -> None:
    """It carries 2 m g of the rope and (M + J/R^2) g of its own; 100 N more lift it."""
    held = (2 * 40 + 60 + 6 / 0.4**2) * 9.81
    of = setting(BLOCK.replace("PULL", f"{held + 100}+0*TIME"))
    (block,) = [f for f in of.demand.machines[0].network.forces.values() if np.ndim(f)]
    np.testing.assert_allclose(block, 100, rtol=1e-3)

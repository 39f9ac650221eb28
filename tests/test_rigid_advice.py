"""Advice on parts, joints and springs, followed on random mechanisms in several units: what is told
to be lost is not exceeded; a fixed sample of what `python -m benchmarks.rigid_advice` tries.
"""

from __future__ import annotations

import re

import numpy as np
import pytest
from tiers import every

import adamslite
from adamslite.checks.rules import needless
from benchmarks.rigid_advice import tried
from benchmarks.rigid_scenes import KINDS, SYSTEMS, Drawn, bushing, link, lump, spring

TOLD = {bushing: (8, 16, 24, 40, 52), spring: (2, 5, 9, 13, 17), link: (2, 6, 10, 18, 26),
        lump: (3, 7, 11, 15, 19)}  # fmt: skip


@pytest.mark.parametrize(
    ("kind", "seed"), every(5, [(kind, seed) for kind, seeds in TOLD.items() for seed in seeds])
)
def test_what_is_told_to_be_lost_is_not_exceeded(kind: object, seed: int) -> None:
    assert kind in KINDS
    found = tried(kind(seed))  # type: ignore[operator]
    assert found is not None
    assert found.verdict in ("true", "needed", "kept without need")


CLEAR = {bushing: (0, 4, 8), spring: (3, 4, 5), link: (0, 1, 5), lump: (3, 7, 11)}


@pytest.mark.parametrize(
    ("kind", "seed"), every(4, [(kind, seed) for kind, seeds in CLEAR.items() for seed in seeds])
)
def test_advice_is_given_where_next_to_nothing_is_lost(kind: object, seed: int) -> None:
    """In each of three systems of units."""
    found = tried(kind(seed))  # type: ignore[operator]
    assert found is not None
    assert found.told is not None
    assert found.verdict == "true"


def arms(seed: int, tilt: float, apart: float) -> tuple[Drawn, str]:
    """Two arms on parallel hinges along z; the second ``apart`` along z, gravity tilted to z."""
    d = Drawn(seed)
    inner = d.part(2, 2.0, (0.5, 0, 0), 0.3) + d.marker(21, 2, (-0.5, 0, 0))
    outer = d.part(3, 3.0, (1.2, 0, apart), 0.3) + d.marker(31, 3, (-0.2, 0, -apart))
    hinges = "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22\n"
    body = inner + d.marker(22, 2, (0.5, 0, 0)) + outer + hinges
    text = d.head("Arms", (0.0, tilt)) + body + d.run(0.4)
    return d, text


@pytest.mark.parametrize("seed", range(len(SYSTEMS)))
@pytest.mark.parametrize(("tilt", "apart"), [(0.0, 0.0), (0.3, 0.0), (0.0, 0.2), (-0.1, 0.05)])
def test_what_a_plane_loses_is_told(seed: int, tilt: float, apart: float) -> None:
    """The motion stays when all is put into the plane.  Lost are, in the hinge on ground, the
    weight across, and torques across it of the size of the arm times the forces.
    """
    d, text = arms(seed, tilt, apart)
    (note,) = [n for n in needless(adamslite.read(text)) if n.code == "planar-motion"]
    one, other = (
        adamslite.simulate(adamslite.read(each), error=1e-9 * d.length, integrator="RADAU")
        for each in (text, arms(seed, 0.0, 0.0)[1])
    )
    for name in ("PART/2.x", "PART/3.x", "PART/3.y"):
        np.testing.assert_allclose(one[name], other[name], rtol=0, atol=1e-7 * d.length)
    weight = re.search(r"(\S+) of weight", note.hint or "")
    arm = re.search(r"about (\S+) times", note.hint or "")
    assert ("nothing is lost" in (note.hint or "")) == (tilt == apart == 0.0)
    assert (weight is not None, arm is not None) == (tilt != 0.0, apart != 0.0)
    force = max(float(np.abs(one[f"JOINT/1.f{axis}"]).max()) for axis in "xy")
    if weight:
        lost = float(np.abs(one["JOINT/1.fz"]).max())
        assert lost == pytest.approx(5 * 9.80665 * abs(tilt) * d.force, rel=1e-6)
        assert float(weight[1]) == pytest.approx(lost, rel=1e-2)
    elif arm:
        lost = max(float(np.abs(one[f"JOINT/1.t{axis}"]).max()) for axis in "xy")
        assert 0.1 * float(arm[1]) * force < lost < 2.0 * float(arm[1]) * force

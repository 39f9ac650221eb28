"""NFORCE: balance, measures, and switching it off."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import GROUND, done

import adamslite as al
from adamslite.reading.read import read, read_commands

COMPONENTS = (2, 3, 4, 6, 7, 8)
# Every direction acts on another one, in each of the four blocks.
COUPLED = np.tile(np.roll(np.eye(6), 2, axis=1), (2, 2))
STIFFNESS = COUPLED * np.random.default_rng(5).uniform(2, 9, (12, 12))
WRITTEN = ",".join(map(str, STIFFNESS.ravel()))
SCENE = (
    GROUND
    + """PART/2, MASS=2, CM=2, IP=1,2,3, QG=1,0.2,0, VX=0.3
MARKER/2, PART=2, QP=0,0.1,0
PART/3, MASS=3, CM=3, IP=2,2,3, QG=0,1,0.3, WY=0.2
MARKER/3, PART=3, QP=0.1,0,0
PART/4, MASS=4, CM=4, IP=3,4,4, REULER=20D,10D,5D
MARKER/4, PART=4, QP=0,0,-0.2
"""
    + f"MATRIX/1, FULL=RORDER, ROWS=12, COLUMNS=12, VALUES={WRITTEN}\n"
    + "MATRIX/2, SPARSE, ROWS=12, COLUMNS=1, VALUES=1,1,0.7, 8,1,-0.4\n"
    + "NFORCE/5, IMARKERS=2,3, J=4, KMATRIX=1, FORCE=2\n"
)


PLACES = "".join(
    f"VARIABLE/{axis.lower()}{marker}, FUNCTION=D{axis}({marker})\n"
    for axis in "XYZ"
    for marker in (2, 3, 4)
)


def measured(marker: int) -> str:
    """VARIABLEs of all components of the load on a marker, along the ground axes."""
    return "".join(
        f"VARIABLE/f{marker}_{n}, FUNCTION=NFORCE(5,{marker},{n},0)\n" for n in COMPONENTS
    )


def test_measures_of_all_markers_balance() -> None:
    """Force on J against those on the I markers, torques about the origin of ground."""
    found = done(SCENE + "".join(map(measured, (2, 3, 4))) + PLACES + "END\n", end=0.2)
    force, moment = np.zeros((2, len(found.time), 3))
    for marker in (2, 3, 4):
        load = np.array([found[f"VARIABLE/f{marker}_{n}"] for n in COMPONENTS]).T
        place = np.array([found[f"VARIABLE/{axis}{marker}"] for axis in "xyz"]).T
        force += load[:, :3]
        moment += load[:, 3:] + np.cross(place, load[:, :3])
        assert np.abs(load).min(axis=0).max() > 0.1
    assert np.abs(force).max() < 1e-12 * np.abs(load).max()
    assert np.abs(moment).max() < 1e-12 * np.abs(load).max()


def test_the_net_force_at_a_marker_has_it() -> None:
    text = "VARIABLE/1, FUNCTION=FX(2,4,3)-NFORCE(5,2,2,3)\nVARIABLE/2, FUNCTION=NFORCE(5,2,1,0)\n"
    found = done(f"{SCENE}{text}VARIABLE/3, FUNCTION=FM(2)\nEND\n", end=0.1)
    assert np.abs(found["VARIABLE/1"]).max() < 1e-12
    assert found["VARIABLE/2"] == pytest.approx(found["VARIABLE/3"], rel=1e-12)
    assert np.abs(found["VARIABLE/2"]).min() > 0.1


def test_switched_off_it_does_nothing() -> None:
    commands = "DEACTIVATE/NFORCE, ID=5\nSIMULATE/DYNAMICS, END=0.5, STEPS=5\n"
    commands += "ACTIVATE/NFORCE, ID=5\nSIMULATE/DYNAMICS, END=1, STEPS=5\n"
    deck = read(SCENE + measured(2) + "END\n")
    found = al.simulate(deck, commands=read_commands(commands, deck))
    first = found.time <= 0.5
    assert found["PART/2.vx"][first] == pytest.approx(0.3, rel=1e-12)
    assert not found["VARIABLE/f2_2"][first][:-1].any()
    assert np.abs(found["VARIABLE/f2_2"][~first]).min() > 0.01

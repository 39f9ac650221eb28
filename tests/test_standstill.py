"""Joints that stood still while others moved are named after a run; FIXED in their place does the
same.
"""

from __future__ import annotations

import re

import numpy as np
import pytest

import adamslite
from benchmarks.rigid_scenes import SYSTEMS, Drawn


def arm(seed: int, torque: float = 0.0, extra: str = "", g: float = 1.0) -> tuple[Drawn, str]:
    """An arm that swings from level, and a rotor about the line of the arm: nothing turns it there
    but a torque, of so many times the weight of the rotor by its radius of gyration.
    """
    d = Drawn(seed)
    turned = ", REULER=90D,90D,0\n"
    text = (
        (d.head("A rotor on an arm") if g else re.sub("ACC.*\n", "", d.head("At rest")))
        + d.part(2, 5.0, (0.5, 0, 0), 0.3) + d.marker(21, 2, (-0.5, 0, 0))
        + d.marker(22, 2, (0.4, 0, 0)).rstrip() + turned
        + d.part(3, 1.0, (0.9, 0, 0), 0.1) + d.marker(31, 3, (0, 0, 0)).rstrip() + turned
        + "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=22\n" + extra
    )  # fmt: skip
    if torque:
        size = torque * 0.1 * 9.80665 * d.force * d.length
        text += f"SFORCE/1, ROTATIONAL, I=31, J=22, FUNCTION={size!r}*SIN(TIME)\n"
    return d, text + d.run(0.4)


def run(text: str) -> adamslite.Results:
    return adamslite.simulate(adamslite.read(text), error=1e-7)


@pytest.mark.parametrize("seed", range(len(SYSTEMS)))
def test_a_joint_that_nothing_moves_is_named(seed: int) -> None:
    d, text = arm(seed)
    one, other = run(text), run(text.replace("JOINT/2, REVOLUTE", "JOINT/2, FIXED"))
    note = one.meta["not moved"]
    told = re.match(r"JOINT/2 moved by at most (\S+) and (\S+) rad at the output times", note)
    assert told is not None
    for axis in "xyz":
        lost = float(np.abs(one[f"PART/3.{axis}"] - other[f"PART/3.{axis}"]).max())
        assert lost <= 2.0 * float(told[1]) + 1e-6 * d.length


@pytest.mark.parametrize("torque", [1e-3, 1.0])
def test_a_joint_that_turns_is_not_named(torque: float) -> None:
    assert "not moved" not in run(arm(0, torque)[1]).meta


@pytest.mark.parametrize(
    "extra",
    ["MOTION/1, JOINT=2, FUNCTION=0\n", "COUPLER/1, JOINTS=1,2, SCALES=0,1, TYPE=R:R\n"],
)
def test_a_joint_that_something_else_needs_is_not_named(extra: str) -> None:
    assert "not moved" not in run(arm(0, extra=extra)[1]).meta


def test_a_machine_at_rest_is_not_named() -> None:
    assert "not moved" not in run(arm(0, g=0.0)[1]).meta

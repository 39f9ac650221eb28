"""Markers placed in the frame of another marker, and velocities along the axes of one."""

from __future__ import annotations

import numpy as np
from decklets import deck_with

from adamslite.elements.bases.joint_coordinates import pose
from adamslite.model.geometry import rotation_313
from adamslite.model.model import Model

A, B, C = (0.3, 0.7, -0.2), (1.1, 0.4, 0.6), (-0.5, 0.9, 0.1)
"""3-1-3 angles of a part and of two of its markers."""


def written(numbers: tuple[float, ...]) -> str:
    return ",".join(map(str, numbers))


PART = f"""PART/5, MASS=2, CM=5, IP=1,1,1, QG=1,2,3, REULER={written(A)}{{more}}
MARKER/5, PART=5, QP=0.5,0,0, REULER={written(B)}
"""


def test_a_marker_is_placed_in_the_frame_of_another_one() -> None:
    deck = deck_with(
        PART.format(more="")
        + f"MARKER/6, PART=5, RM=5, QP=1,2,-1, REULER={written(C)}\n"
        + "MARKER/7, PART=5, RM=6, QP=0,0,2, ZP=0,1,2, XP=1,0,2\n"
        + f"MARKER/8, PART=1, QP=0,1,0, REULER={written(C)}\nMARKER/9, PART=1, RM=8, QP=1,1,1"
    )
    model = Model(deck)
    body, own, inner = map(rotation_313, (A, B, C))
    origin = np.array([1, 2, 3]) + body @ ([0.5, 0, 0] + own @ [1, 2, -1])
    found, axes = pose(model, 6)
    np.testing.assert_allclose(found, origin, atol=1e-15)
    np.testing.assert_allclose(axes, body @ own @ inner, atol=1e-15)
    found, axes = pose(model, 7)
    np.testing.assert_allclose(found, origin + body @ own @ inner @ [0, 0, 2], atol=1e-15)
    by_points = np.column_stack([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    np.testing.assert_allclose(axes, body @ own @ inner @ by_points, atol=1e-15)
    np.testing.assert_allclose(pose(model, 9)[0], [0, 1, 0] + inner @ [1, 1, 1], atol=1e-15)


def test_velocities_are_along_the_axes_of_a_marker_of_any_body() -> None:
    text = PART.format(more=", VX=1, VY=2, VZ=3, WX=4, WY=5, WZ=6, VM={vm}, WM={wm}")
    other = f"PART/6, MASS=1, CM=6, IP=1,1,1, REULER={written(C)}\nMARKER/6, PART=6\n"
    turned = {5: rotation_313(A) @ rotation_313(B), 6: rotation_313(C), 1: np.eye(3)}
    for vm, wm in ((5, 6), (6, 1), (1, 5)):
        model = Model(deck_with(text.format(vm=vm, wm=wm) + other))
        body = model.bodies[model.body_index["PART", 5]]
        np.testing.assert_allclose(body.v, turned[vm] @ [1, 2, 3], atol=1e-15)
        np.testing.assert_allclose(body.w, turned[wm] @ [4, 5, 6], atol=1e-15)

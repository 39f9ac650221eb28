"""Vector functions against plain numpy on random postures, and forces given by vectors."""

from __future__ import annotations

import numpy as np
import pytest
from decklets import codes, function
from oracle import Flight, reported, seen
from scenes import GROUND, done
from test_oracle_functions import DRIVE, Moving
from test_oracle_functions import GROUND as REST

from adamslite.functions.vectors import VECTORS


def vectors_of(m: Moving, n: list[int]) -> dict[str, np.ndarray]:
    """Vector expression -> its components, for markers i, j, k, l."""
    i, j, k, frame = (m.flight[number] for number in n)
    a, b, c, d = n
    turned = i.w - j.w
    apart = i.r - j.r
    return {
        f"DXYZ({a},{b},{c})": seen(i, j, k),
        f"DXYZ({a})": i.r,
        f"VXYZ({a},{b},{c},{d})": k.A.T @ (i.v - j.v - np.cross(frame.w, apart)),
        f"VXYZ({a},{b})": i.v - j.v,
        f"ACCXYZ({a},{b},{c},{d})": m.acceleration(i, j, k, frame),
        f"ACCXYZ({a},{b})": m.acceleration(i, j, REST, REST),
        f"WXYZ({a},{b},{c})": k.A.T @ turned,
        f"WDTXYZ({a},{b},{c},{d})": m.spin_up(i, j, k, frame),
        f"UVX({a})": i.A[:, 0],
        f"UVY({a})": i.A[:, 1],
        f"UVZ({a},{c})": k.A.T @ i.A[:, 2],
        f"TRANS(DXYZ({a},{b}),{c})": seen(i, j, k),
        f"TRANS(DXYZ({a},{b},{c}),{d},{c})": seen(i, j, frame),
        f"UV(DXYZ({a},{b}))": apart / np.linalg.norm(apart),
        f"-2*DXYZ({a},{b})/4+UVX({c})*3": 3 * k.A[:, 0] - apart / 2,
        f"UVX({a})-DX({a},{b})*UVY({c})": i.A[:, 0] - apart[0] * k.A[:, 1],
    }


@pytest.mark.parametrize("seed", [0, 3])
def test_vectors_between_markers(seed: int) -> None:
    """Each component is the product with an axis of ground; MAG and * of two vectors."""
    m = Moving(seed)
    mark = "MARKER/90, PART=1"
    expected: dict[str, float] = {}
    for n in (m.flight.pick(4), m.flight.pick(4)):
        found = vectors_of(m, n)
        for text, value in found.items():
            for axis in range(3):
                expected[f"({text})*UV{'XYZ'[axis]}(90)"] = value[axis]
            expected[f"MAG({text})"] = float(np.linalg.norm(value))
        (one, v), (other, w) = list(found.items())[1], list(found.items())[9]
        expected[f"{one}*{other}+1"] = float(v @ w) + 1
    lines = [f"VARIABLE/{k}, FUNCTION={e}" for k, e in enumerate(expected, 1)]
    results = m.flight.run(DRIVE, mark, *lines)
    assert reported(results) == pytest.approx(m.rates, rel=1e-9, abs=1e-9 * np.abs(m.rates).max())
    for k, (text, value) in enumerate(expected.items(), 1):
        got = results[f"VARIABLE/{k}"][0]
        assert got == pytest.approx(value, rel=1e-9, abs=1e-9), text


def test_every_vector_function_is_measured() -> None:
    m = Moving(0)
    text = " ".join(vectors_of(m, m.flight.pick(4)))
    of_forces = {"FXYZ", "TXYZ", "MAG"}  # measured by the tests above and below
    assert all(f"{name}(" in text for name in VECTORS.keys() - of_forces)


@pytest.mark.parametrize(("sign", "rm"), [(1.0, 0), (-0.6, 3)])
def test_a_force_given_by_vectors_is_that_by_components(sign: float, rm: int) -> None:
    """GFORCE, VFORCE and VTORQUE, along ground or a marker that turns, and what measures them."""
    f = Flight(1)
    i, j, k = (f.on(body)[0] for body in range(3))
    axes = f", RM={k}" if rm else ""
    force = f"{sign}*DXYZ({i},{j},{k})*TIME+{sign}*UV(VXYZ({i}))"
    torque = f"{sign}*WXYZ({i},{j})-0.3*UVZ({k})"
    by_vectors = [
        f"GFORCE/1, I={i}, J_PART=1{axes}, FXYZ={force}\\TXYZ={torque}",
        f"VFORCE/1, I={j}, J_PART=1{axes}, FXYZ={torque}",
        f"VTORQUE/1, I={k}, J_PART=1{axes}, TXYZ={force}\\",
        f"REQUEST/1, F1=FXYZ({i})*UVX(0)\\F2=MAG(FXYZ({i},0,{k}))\\F3=TXYZ({i})*UVY(0)",
    ]

    def parts(word: str, law: str) -> str:
        return "\\".join(f"{word}{a}=({law})*UV{a}(0)" for a in "XYZ")

    by_components = [
        f"GFORCE/1, I={i}, J_PART=1{axes}, {parts('F', force)}\\{parts('T', torque)}",
        f"VFORCE/1, I={j}, J_PART=1{axes}, {parts('F', torque)}",
        f"VTORQUE/1, I={k}, J_PART=1{axes}, {parts('T', force)}",
        f"REQUEST/1, F1=FX({i})\\F2=FM({i})\\F3=TY({i})",
    ]
    one, other = (f.run(*lines, end=0.1, steps=4) for lines in (by_vectors, by_components))
    assert reported(one) == pytest.approx(reported(other), rel=1e-9, abs=1e-9)
    for name in ("REQUEST/1.F1", "REQUEST/1.F2", "REQUEST/1.F3"):
        assert one[name] == pytest.approx(other[name], rel=1e-7, abs=1e-7), name
        assert abs(one[name]).max() > 0.1


@pytest.mark.parametrize("stiffness", [4.0, 25.0])
def test_a_spring_in_space(stiffness: float) -> None:
    """F = -k d on 1 kg that starts at (1, 2, -1) at rest: r = r0 cos(sqrt(k) t)."""
    deck = GROUND + "POINT_MASS/2, MASS=1, CM=2, QG=1,2,-1\nMARKER/2, POINT_MASS=2\n"
    deck += f"VFORCE/1, I=2, J_PART=1, FXYZ=-{stiffness}*DXYZ(2,1)\nEND\n"
    results = done(deck, 2.0, 20, integrator="RADAU", error=1e-9)
    swing = np.cos(np.sqrt(stiffness) * results.time)
    for axis, start in zip("xyz", (1.0, 2.0, -1.0), strict=True):
        assert results[f"POINT_MASS/2.{axis}"] == pytest.approx(start * swing, abs=1e-6)


def test_numbers_need_no_vectors() -> None:
    assert function("2*(DX(2)+1)") == function("(2)*(DX(2)+1)")


def test_mistakes_are_told_once() -> None:
    assert codes("VARIABLE/1, FUNCTION=DXYZ(2)+1") == ["vector-operation"]
    assert codes("VARIABLE/1, FUNCTION=DXYZ(2)+WORD") == ["unknown-name"]
    assert codes("VARIABLE/1, FUNCTION=MAG(WORD)") == ["unknown-name"]
    force = "VFORCE/1, I=2, J_PART=1, "
    assert codes(force + "FXYZ=DXYZ(2)\\FX=1") == ["duplicate-argument"]
    assert codes(force + "FZ=1\\FXYZ=DXYZ(2)") == ["duplicate-argument"]
    assert codes(force + "FXYZ=1") == ["number-here"]
    assert codes(force + "FX=DXYZ(2)") == ["vector-here"]

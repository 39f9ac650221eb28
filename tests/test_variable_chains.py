"""VARIABLEs that are made of VARIABLEs: each is evaluated once, however often it is used.

    v_1 = 1.3 + 0.2 x        v_i = v_(i-1) sin v_(i-1)

As a tree v_n has 2^n leaves.  Values and rates are compared with the recursion in numpy, rates by a
complex step.
"""

from __future__ import annotations

import re

import numpy as np
import pytest
from scenes import compiled, run

import adamslite as al
from adamslite.cables.recognition.posture import Posture
from adamslite.elements.variable import Variable
from adamslite.language.expression import Call, Ref
from adamslite.model import chains
from adamslite.model.cycles import in_loops

DECK = """Chain of variables
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=1,0,0, VX=0.5
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=10, C=0.1, LENGTH=0.5
{chain}
VFORCE/1, I=2, J_PART=1, FY=VARVAL({n})
REQUEST/1, F2=VARVAL({n}), F3=VARVAL(d({n})/dt)
INTEGRATOR/GSTIFF, ERROR=1E-6
END
"""
OF_STATE, OF_TIME, CONSTANT = "1.3+0.2*DX(2,1)", "1.3+0.2*TIME", "1.3"


def deck(n: int, first: str, backwards: bool = False) -> str:
    """A chain of n variables."""
    rule = "VARIABLE/{i}, FUNCTION=VARVAL({j})*SIN(VARVAL({j}))"
    chain = [f"VARIABLE/1, FUNCTION={first}"]
    chain += [rule.format(i=i, j=i - 1) for i in range(2, n + 1)]
    return DECK.format(chain="\n".join(chain[::-1] if backwards else chain), n=n)


def last_of(n: int, first: np.ndarray) -> np.ndarray:
    """v_n from v_1."""
    v = first
    for _ in range(n - 1):
        v = v * np.sin(v)
    return v


@pytest.mark.parametrize("backwards", [False, True])
@pytest.mark.parametrize("n", [2, 14, 100])
@pytest.mark.parametrize("first", [OF_STATE, OF_TIME])
def test_value_and_rate_of_the_last_of_a_chain(n: int, first: str, backwards: bool) -> None:
    found = run(deck(n, first, backwards), 0.5, 10)
    step = 1e-30
    x, v = found["POINT_MASS/2.x"], found["POINT_MASS/2.vx"]
    of = (x, v) if first == OF_STATE else (found.time, np.ones(len(x)))
    along = last_of(n, 1.3 + 0.2 * (of[0] + 1j * step * of[1]))
    np.testing.assert_allclose(found["REQUEST/1.F2"], along.real, rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(found["REQUEST/1.F3"], along.imag / step, rtol=1e-8, atol=1e-14)


def test_a_chain_of_constants_is_a_number() -> None:
    found = run(deck(100, CONSTANT), 0.1, 1)
    np.testing.assert_allclose(found["REQUEST/1.F2"], last_of(100, np.array(1.3)), rtol=1e-12)


@pytest.mark.parametrize("first", [OF_STATE, OF_TIME])
def test_native_code_grows_as_the_chain(first: str) -> None:
    """The force of twice as many variables is no more than twice the code and a little."""
    size = {}
    for n in (20, 40):
        groups = compiled(deck(n, first)).groups
        size[n] = max(len(group.code) for group in groups if group.face == "loads")
    assert size[40] < 2.2 * size[20]


def test_a_variable_of_a_measured_force_that_takes_a_variable() -> None:
    """A VARIABLE of the force of a VFORCE whose VARIABLE is made of another one: F = 3 a^2."""
    chain = (
        "VARIABLE/1, FUNCTION=1+TIME\nVARIABLE/2, FUNCTION=VARVAL(1)**2\n"
        "VFORCE/2, I=2, J_PART=1, FZ=3*VARVAL(2)\nVARIABLE/3, FUNCTION=VFORCE(2,0,4,1)"
    )
    text = DECK.format(chain=chain, n=3)
    found = run(text, 0.5, 5)
    np.testing.assert_allclose(found["REQUEST/1.F2"], 3.0 * (1.0 + found.time) ** 2, rtol=1e-12)
    np.testing.assert_allclose(found["VFORCE/1.fy"], found["REQUEST/1.F2"], rtol=1e-12)


def test_signals_are_evaluated_behind_those_that_they_take() -> None:
    """Shapes in turn: squares (1, 3) and sines (2, 4), each of the one before.  VARIABLE/3 has the
    shape of 1, and is evaluated behind 2.
    """
    chain = (
        "VARIABLE/4, FUNCTION=SIN(VARVAL(3))\nVARIABLE/3, FUNCTION=VARVAL(2)**2\n"
        "VARIABLE/2, FUNCTION=SIN(VARVAL(1))\nVARIABLE/1, FUNCTION=VARVAL(9)**2\n"
        "VARIABLE/9, FUNCTION=0.3+TIME"
    )
    found = run(DECK.format(chain=chain, n=4), 0.5, 5)
    step = 1e-30
    value = np.sin(np.sin((0.3 + found.time + 1j * step) ** 2) ** 2)
    np.testing.assert_allclose(found["REQUEST/1.F2"], value.real, rtol=1e-12)
    np.testing.assert_allclose(found["REQUEST/1.F3"], value.imag / step, rtol=1e-12)


def test_a_jump_in_a_chain_is_a_stop() -> None:
    """v_1 = IF(t - 0.3), v_2 = 2 v_1 + 1, v_3 = v_2 + v_1 v_2: 1 before, 28 from 0.3 on."""
    chain = (
        "VARIABLE/1, FUNCTION=IF(TIME-0.3: 0, 3, 3)\nVARIABLE/2, FUNCTION=2*VARVAL(1)+1\n"
        "VARIABLE/3, FUNCTION=VARVAL(2)+VARVAL(1)*VARVAL(2)\nDIFF/1, IC=0, FUNCTION=VARVAL(3)"
    )
    found = run(DECK.format(chain=chain, n=3), 1.0, 4)
    assert found["REQUEST/1.F2"] == pytest.approx([1, 1, 28, 28, 28])
    late = np.maximum(found.time - 0.3, 0.0)
    np.testing.assert_allclose(found["DIFF/1"], found.time + 27.0 * late, atol=1e-5)


def test_a_variable_may_take_a_force_and_what_that_is_made_of() -> None:
    """a = 1 + t, F = 3 a is measured as b, c = a + b, d = b + a: both are 4 a."""
    chain = (
        "VARIABLE/1, FUNCTION=1+TIME+0*DX(2,1)\nVFORCE/2, I=2, J_PART=1, FZ=3*VARVAL(1)\n"
        "VARIABLE/2, FUNCTION=VFORCE(2,0,4,1)\nVARIABLE/3, FUNCTION=VARVAL(1)+VARVAL(2)\n"
        "VARIABLE/4, FUNCTION=VARVAL(2)+VARVAL(1)\nVARIABLE/5, FUNCTION=VARVAL(3)-VARVAL(4)"
    )
    found = run(DECK.format(chain=chain, n=3), 0.5, 5)
    for n in (3, 4):
        np.testing.assert_allclose(found[f"VARIABLE/{n}"], 4.0 * (1.0 + found.time), rtol=1e-12)
    np.testing.assert_allclose(found["VARIABLE/5"], 0.0, atol=1e-12)


# ---- results of chains -----------------------------------------------------------------------

SINES = "VARIABLE/{i}, FUNCTION=SIN(VARVAL({j}))+{c}"


def all_results(n: int, backwards: bool = False) -> str:
    """A chain v_i = sin v_(i-1) + c_i, every tenth of which a REQUEST takes with its rate."""
    chain = [f"VARIABLE/1, FUNCTION={OF_STATE}"]
    chain += [SINES.format(i=i, j=i - 1, c=1.0 + i / 1024) for i in range(2, n + 1)]
    requests = [
        f"REQUEST/{i}0, F2=2*VARVAL({i})\\F3=VARVAL(d({i})/dt)" for i in range(1, n + 1, 10)
    ]
    lines = chain + requests
    return DECK.format(chain="\n".join(lines[::-1] if backwards else lines), n=1)


def output_groups(text: str) -> list[int]:
    """Characters of the code of each group that writes results."""
    return [len(each.code) for each in compiled(text).groups if each.face == "output"]


@pytest.mark.parametrize("backwards", [False, True])
def test_every_link_of_a_chain_is_a_result(backwards: bool) -> None:
    found = run(all_results(41, backwards), 0.5, 5)
    step = 1e-30
    value = 1.3 + 0.2 * (found["POINT_MASS/2.x"] + 1j * step * found["POINT_MASS/2.vx"])
    for i in range(1, 42):
        value = np.sin(value) + (1.0 + i / 1024) if i > 1 else value
        np.testing.assert_allclose(found[f"VARIABLE/{i}"], value.real, rtol=1e-13)
        if i % 10 == 1:
            np.testing.assert_allclose(found[f"REQUEST/{i}0.F2"], 2.0 * value.real, rtol=1e-13)
            rate = value.imag / step
            np.testing.assert_allclose(found[f"REQUEST/{i}0.F3"], rate, rtol=1e-10, atol=1e-300)


def test_results_of_a_chain_share_it() -> None:
    """Twice as many links are as many kernels, and twice the code."""
    few, many = (output_groups(all_results(n)) for n in (60, 120))
    assert len(few) == len(many) < 20
    assert sum(many) < 2.2 * sum(few)


def test_chains_that_share_a_short_begin_only_share_their_kernels() -> None:
    """Three chains of eleven links from one VARIABLE: the last ones are instances of one shape."""
    chains = [f"VARIABLE/1, FUNCTION={OF_STATE}"]
    for k in (100, 200, 300):
        links = range(k + 1, k + 11)
        chains.append(SINES.format(i=k, j=1, c=1.5))
        chains += [SINES.format(i=i, j=i - 1, c=1.5) for i in links]
    groups = compiled(DECK.format(chain="\n".join(chains), n=1)).groups
    (together,) = (each for each in groups if each.instances.bundles)
    members = [[each.key for each in bundle.members] for bundle in together.instances.bundles]
    assert members == [[k + n for n in range(7, 11)] for k in (100, 200, 300)]


def test_results_that_are_written_together_take_other_numbers() -> None:
    kernels = compiled(all_results(30))
    values = {"VARIABLE/20.FUNCTION": 2.5, "POINT_MASS/2.QG[0]": 0.9}
    again, fresh = (
        al.simulate(each, end=0.1, steps=2)
        for each in (
            kernels.with_values(values),
            compiled(all_results(30).replace("VARVAL(19))+1.01953125", "VARVAL(19))+2.5")
                     .replace("QG=1,", "QG=0.9,")),
        )
    )  # fmt: skip
    for name in fresh.names:
        np.testing.assert_array_equal(again[name], fresh[name])


def test_what_has_no_rate_is_reported_of_its_own_statement() -> None:
    text = all_results(30).replace("+0.2*DX(2,1)", "+0.2*ACCX(2,1)")
    with pytest.raises(al.DeckError) as fault:
        compiled(text)
    assert "no-rate" in {each.code for each in fault.value.errors}
    assert all(each.message.startswith("REQUEST/") for each in fault.value.errors)


@pytest.mark.parametrize("first", [OF_STATE, OF_TIME, CONSTANT])
def test_a_chain_may_be_as_long_as_the_limit_of_its_size(first: str) -> None:
    """No part of the program calls itself for each link; v_n = n - 1 + v_1."""
    n = 1500
    chain = [f"VARIABLE/1, FUNCTION={first}"]
    chain += [f"VARIABLE/{i}, FUNCTION=VARVAL({i - 1})+1" for i in range(2, n + 1)]
    found = run(DECK.format(chain="\n".join(chain), n=n), 0.1, 1)
    np.testing.assert_allclose(found[f"VARIABLE/{n}"], n - 1 + found["VARIABLE/1"], rtol=1e-12)


def test_bounds_of_products_are_found_once() -> None:
    """v_n = (v_(n-1) + 1)(v_(n-1) + 2) / 10 in a condition: as a tree it has 2^n leaves."""
    chain = [f"VARIABLE/1, FUNCTION={OF_STATE}"]
    for i in range(2, 60):
        chain.append(f"VARIABLE/{i}, FUNCTION=0.1*(VARVAL({i - 1})+1)*(VARVAL({i - 1})+2)")
    chain.append("VARIABLE/60, FUNCTION=IF(VARVAL(59): 1, 2, 3)")
    assert run(DECK.format(chain="\n".join(chain), n=1), 0.1, 1)["VARIABLE/60"][0] == 3.0


@pytest.mark.parametrize("seed", range(20))
def test_members_of_cycles_are_those_that_reach_themselves(seed: int) -> None:
    draw = np.random.default_rng(seed)
    uses = {k: set(draw.integers(0, 14, draw.integers(0, 3)).tolist()) for k in range(12)}
    reach = {key: set(direct) for key, direct in uses.items()}
    for _ in uses:
        for direct in reach.values():
            direct |= set().union(*(reach.get(each, set()) for each in direct))
    assert in_loops(uses) == {key for key, found in reach.items() if key in found}


# ---- chains that many forces take ------------------------------------------------------------

BUSY = "VARIABLE/{i}, FUNCTION=SIN(VARVAL({j}))+{i}"


def crowd(n: int, link: str = BUSY) -> str:
    """A chain v_k = sin v_(k-1) + k, each link part of the tension of a line between a mass and the
    one before.
    """
    lines = [f"VARIABLE/1, FUNCTION={OF_STATE}"]
    lines += [link.format(i=i, j=i - 1) for i in range(2, n + 1)]
    for i in range(1, n + 1):
        lines += [f"POINT_MASS/{i + 2}, MASS=1, CM={i + 2}, QG={i + 1},{i / 10},0"]
        lines += [f"MARKER/{i + 2}, POINT_MASS={i + 2}"]
        law = f"-0.01*VARVAL({i})-0.1*DX({i + 2},{i + 1})"
        lines += [f"SFORCE/{i}, TRANSLATIONAL, I={i + 2}, J={i + 1}, FUNCTION={law}"]
    return DECK.format(chain="\n".join(lines), n=1)


def solved_for(text: str) -> set[int]:
    """VARIABLEs that are solved for."""
    model = al.assemble(al.read(text))
    return {v.key for v in model.deck.of(Variable) if model.variable_kind(v.key) == "loop"}


def test_code_of_forces_that_each_take_a_link_does_not_grow_with_the_chain() -> None:
    """Written out, 1000 links would be 3 million operations."""
    few, many = (compiled(crowd(n)).groups for n in (150, 1000))
    assert sum(len(group.code) for group in few) == sum(len(group.code) for group in many)
    assert solved_for(crowd(150)) == set(range(9, 150))  # the last link is taken once


@pytest.mark.parametrize("method", ["GSTIFF", "HHT", "RADAU", "ABAM"])
def test_a_crowded_chain_moves_as_one_that_is_written_out(
    method: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Links have the values of their FUNCTION in the posture."""
    text = crowd(30)
    assert not solved_for(text)
    whole = al.simulate(text, end=0.5, steps=5, integrator=method, error=1e-8)
    monkeypatch.setattr(chains, "MOST_WRITTEN", 100)
    assert solved_for(text) == set(range(9, 30))
    found = al.simulate(text, end=0.5, steps=5, integrator=method, error=1e-8)
    assert whole.outcome.name == found.outcome.name == "DONE"
    sizes = np.maximum(np.abs(whole.values).max(axis=0), 1.0)
    assert (np.abs(found.values - whole.values) < 1e-7 * sizes).all()
    value = 1.3 + 0.2 * found["POINT_MASS/2.x"]
    for i in range(2, 31):
        value = np.sin(value) + i
    np.testing.assert_allclose(found["VARIABLE/30"], value, rtol=1e-9)


def test_a_crowded_chain_starts_at_its_values_and_follows_a_jump() -> None:
    """v_1 jumps by 1 at 0.3 s, and with it all 150 links; force 150 takes what they come to."""
    text = crowd(150).replace(OF_STATE, "1.3+0.2*DX(2,1)+IF(TIME-0.3: 0, 0, 1)")
    found = al.simulate(text, end=0.5, steps=5, integrator="GSTIFF", error=1e-6)
    assert found.outcome.name == "DONE"
    value = 1.3 + 0.2 * found["POINT_MASS/2.x"] + (found.time > 0.3 + 1e-9)
    for i in range(1, 151):
        value = np.sin(value) + i if i > 1 else value
        beside = [0, 1, 2, 4, 5]  # at 0.3 s there are two values
        np.testing.assert_allclose(found[f"VARIABLE/{i}"][beside], value[beside], rtol=1e-6)


def test_what_of_chains_is_written_out() -> None:
    """A chain that one force takes; one whose forces are of one shape; constants; and signals."""
    alone = crowd(200).replace("-0.01*VARVAL(", "-0.01*(").replace("*(200)", "*VARVAL(200)")
    assert not solved_for(alone)
    ends = [f"VARIABLE/{k}, FUNCTION={k}*VARVAL(20)" for k in range(1000, 4000)]
    forces = [f"VFORCE/{k}, I=2, J_PART=1, FZ=VARVAL({k})" for k in (19, 20, *range(1000, 4000))]
    links = [f"VARIABLE/1, FUNCTION={OF_STATE}"]
    links += [BUSY.format(i=i, j=i - 1) for i in range(2, 21)]
    assert not solved_for(DECK.format(chain="\n".join([*links, *ends, *forces]), n=1))
    assert not solved_for(
        crowd(200, link="VARIABLE/{i}, FUNCTION=2+VARVAL({j})").replace(OF_STATE, CONSTANT)
    )
    assert not solved_for(crowd(200).replace(OF_STATE, OF_TIME))


def test_links_that_each_measure_another_body_are_crowded_sooner() -> None:
    """Each force has derivatives by all that is measured: 60 links took 43 s to compile."""
    measuring = "VARIABLE/{i}, FUNCTION=0.5*VARVAL({j})+0.1*DM({i},{j})"
    assert not solved_for(crowd(25, measuring)) and not solved_for(crowd(60))
    assert solved_for(crowd(40, measuring)) == set(range(9, 40))


def test_a_long_chain_of_one_force_is_written_out_beside_others() -> None:
    """Forces 10 and 200 take the values of links; the others take none."""
    measuring = "VARIABLE/{i}, FUNCTION=0.5*VARVAL({j})+0.1*DM({i},{j})"
    two = re.sub(r"-0.01\*VARVAL\((?!10\)|200\))\d+\)", "-0.01", crowd(200, measuring))
    assert two.count("-0.01*VARVAL") == 2 and not solved_for(two)


def test_a_crowded_chain_stays_solved_for_when_some_forces_are_switched_off() -> None:
    """The links go on from where they were."""
    off = "".join(f"DEACTIVATE/SFORCE, ID={i}\n" for i in (1, 75, 149))
    commands = (
        f"SIMULATE/DYNAMIC, END=0.2, STEPS=2\n{off}SIMULATE/DYNAMIC, END=0.4, STEPS=2\nSTOP\n"
    )
    found = al.simulate(crowd(150), commands=commands)
    assert found.outcome.name == "DONE" and found.time[-1] == pytest.approx(0.4)
    value = 1.3 + 0.2 * found["POINT_MASS/2.x"]
    for i in range(2, 151):
        value = np.sin(value) + i
    np.testing.assert_allclose(found["VARIABLE/150"], value, rtol=1e-9)


def test_a_posture_values_a_long_chain_link_by_link() -> None:
    """Rows of cable sections are looked for behind every run, in the posture of the deck."""
    posture = Posture(al.read(crowd(400)))
    value = 1.3 + 0.2 * 1.0
    for i in range(2, 401):
        value = np.sin(value) + i
    assert posture.value(Call("VARVAL", (Ref("VARIABLE", 400),))) == pytest.approx(value)

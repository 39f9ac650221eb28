"""LSE and TFSISO against closed forms: their equations, statics, small motions, all methods."""

from __future__ import annotations

import numpy as np
import pytest
import user_functions
from decklets import codes, deck_with, function
from scenes import GROUND, done

import adamslite as al
from adamslite.elements.lse import Lse
from adamslite.elements.tfsiso import Tfsiso
from adamslite.errors import UsageError
from adamslite.kernels.compile import compile_model
from adamslite.language.expression import Call, Ref
from adamslite.language.method import methods
from adamslite.model.model import assemble
from adamslite.reading.read import read_commands
from adamslite.resources import find

# x1' = x2, x2' = -25 x1 - 2 x2 + 50 u;  y = 3 x1 - u/2
OSCILLATOR = """VARIABLE/1, FUNCTION={u}
ARRAY/1, U, VARIABLES=1
ARRAY/2, X, SIZE=2
ARRAY/3, Y
ARRAY/4, IC, NUMBERS={x1},{x2}
MATRIX/1, ROWS=2, COLUMNS=2, VALUES=0,1,-25,-2
MATRIX/2, ROWS=2, COLUMNS=1, VALUES=0,50
MATRIX/3, ROWS=1, COLUMNS=2, VALUES=3,0
MATRIX/4, ROWS=1, COLUMNS=1, VALUES=-0.5
LSE/1, X=2, U=1, Y=3, IC=4, A=1, B=2, C=3, D=4{hold}
"""
STATICS = "SIMULATE/STATICS\nEND\n"


def oscillator(u: object = 0, x1: float = 0, x2: float = 0, hold: str = "") -> str:
    """Statements of that system."""
    return OSCILLATOR.format(u=u, x1=x1, x2=x2, hold=hold)


def test_values_are_states_and_outputs() -> None:
    assert function("ARYVAL(2,2)", oscillator()) == Call("DIF", (Ref("DIFF", "ARRAY_2_2"),))
    assert function("ARYVAL(3,1)", oscillator()) == Call("VARVAL", (Ref("VARIABLE", "ARRAY_3_1"),))


@pytest.mark.parametrize("method", sorted(set(methods()) - {"VERLET"}))
def test_every_method_integrates_the_states(method: str) -> None:
    """Let go at x1 = 0.7: x1 = 0.7 e^-t (cos w t + sin(w t)/w), w^2 = 24."""
    text = GROUND + oscillator(x1=0.7) + f"INTEGRATOR/{method}, ERROR=1E-6\nEND\n"
    results = done(text, 1.0, 10)
    t, w = results.time, np.sqrt(24)
    expected = 0.7 * np.exp(-t) * (np.cos(w * t) + np.sin(w * t) / w)
    # At most ERROR in each step, of x2, too, which is five times as large; they add up.
    allowed = 5e-6 * results.summary["steps"]
    np.testing.assert_allclose(results["DIFF/ARRAY_2_1"], expected, rtol=0, atol=allowed)
    output = results["VARIABLE/ARRAY_3_1"] / 3
    np.testing.assert_allclose(output, expected, rtol=0, atol=allowed)


def test_verlet_cannot() -> None:
    with pytest.raises(UsageError, match="DIFF/ARRAY_2_1 is a state"):
        done(GROUND + oscillator() + "INTEGRATOR/VERLET, HINIT=1E-3\nEND\n", 1.0)


@pytest.mark.parametrize("seed", range(6))
def test_a_transfer_function_is_that_of_its_states(seed: int) -> None:
    """C (s - A)^-1 B + D = N(s)/D(s) for random polynomials."""
    rng = np.random.default_rng(seed)
    n = seed % 5 + 1
    den, num = rng.uniform(-3, 3, n + 1), rng.uniform(-3, 3, rng.integers(1, n + 2))
    lines = "VARIABLE/1, FUNCTION=1\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y\n"
    written = [", ".join(map(str, each)) for each in (num, den)]
    deck = deck_with(lines + f"TFSISO/1, X=2, U=1, Y=3, NUM={written[0]}, DEN={written[1]}")
    a, b, c, d = map(np.array, deck.get(Tfsiso, 1).matrices(deck))
    for s in (0.3j, 1 + 2j, -4.0):
        whole = c @ np.linalg.solve(s * np.eye(n) - a, b.astype(complex)) + d
        wanted = np.polyval(num[::-1], s) / np.polyval(den[::-1], s)
        assert whole[0, 0] == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize(("u", "sign"), [(2, 1), (-3, -1)])
def test_statics_bring_the_rates_to_zero(u: float, sign: int) -> None:
    """25 x1 = 50 u, x2 = 0."""
    results = al.simulate(al.read(GROUND + oscillator(u, sign, 7) + STATICS))
    assert results["DIFF/ARRAY_2_1"][-1] == pytest.approx(2 * u, rel=1e-12)
    assert results["DIFF/ARRAY_2_2"][-1] == pytest.approx(0, abs=1e-12)
    assert results["VARIABLE/ARRAY_3_1"][-1] == pytest.approx(5.5 * u, rel=1e-12)


def test_statics_keep_held_states_and_dynamics_move_them() -> None:
    """x = (1, 7) stays at rest; a DIFF beside it settles; then both move from there."""
    text = GROUND + oscillator(2, 1, 7, ", STATIC_HOLD") + "DIFF/9, FUNCTION=6-2*DIF(9)\n"
    text += "SIMULATE/STATICS\nSIMULATE/DYNAMIC, END=1E-3, STEPS=1\nEND\n"
    results = al.simulate(al.read(text))
    states = results["DIFF/ARRAY_2_1"], results["DIFF/ARRAY_2_2"]
    assert [each[0] for each in states] == [1, 7]
    assert results["DIFF/9"] == pytest.approx([3, 3], rel=1e-9)
    # x2' = -25 - 14 + 100 = 61, for a thousandth
    assert states[0][1] == pytest.approx(1.00703, abs=1e-6)
    assert states[1][1] == pytest.approx(7.0608, abs=2e-4)


def test_a_held_state_is_a_force_at_rest() -> None:
    """A spring of 10 N/m holds a mass that a held DIFF of 5 pulls: x = 0.5; an unheld one falls
    to its own rest at 2 and pulls with that.
    """
    text = GROUND + "POINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\n"
    text += "DIFF/1, IC=5, STATIC_HOLD, FUNCTION=2-DIF(1)\nDIFF/2, IC=5, FUNCTION=8-DIF(2)**3\n"
    text += "VFORCE/1, I=2, J_PART=1, FX=DIF(1)-10*DX(2)\\FY=DIF(2)-10*DY(2)\\FZ=-DZ(2)\n"
    results = al.simulate(al.read(text + STATICS))
    assert results["POINT_MASS/2.x"][-1] == pytest.approx(0.5, rel=1e-8)
    assert results["DIFF/2"][-1] == pytest.approx(2.0, rel=1e-8)
    assert results["POINT_MASS/2.y"][-1] == pytest.approx(0.2, rel=1e-8)


def test_statics_solve_states_that_move_nothing() -> None:
    """y^3 = 8 takes several iterations, though no body moves."""
    results = al.simulate(al.read(GROUND + "DIFF/1, IC=1, FUNCTION=8-DIF(1)**3\n" + STATICS))
    assert results["DIFF/1"][-1] == pytest.approx(2.0, rel=1e-8)


def test_a_chain_of_integrators_is_found_by_pivoting() -> None:
    """1/(2 + p^2): no state has a rate of its own on the diagonal; 2 y = 3."""
    text = GROUND + "VARIABLE/1, FUNCTION=3\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\nARRAY/3, Y\n"
    text += "TFSISO/1, X=2, U=1, Y=3, NUM=1, DEN=2,0,1\n" + STATICS
    results = al.simulate(al.read(text))
    assert results.outcome is al.Outcome.DONE
    assert results["VARIABLE/ARRAY_3_1"][-1] == pytest.approx(1.5, rel=1e-12)
    assert results.summary["newton"] < 500


def test_a_loop_through_direct_feedthrough_is_solved() -> None:
    """u = 1 - y with y = x + 4 u and x' = -x + u: u = (1 - x)/5, x settles at 1/6."""
    text = GROUND + "VARIABLE/1, FUNCTION=1-ARYVAL(3,1)\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\n"
    text += "ARRAY/3, Y\nTFSISO/1, X=2, U=1, Y=3, NUM=5,4, DEN=1,1\nEND\n"
    results = done(text, 20.0, 10, error=1e-6)
    x = results["DIFF/ARRAY_2_1"]
    np.testing.assert_allclose(results["VARIABLE/1"], (1 - x) / 5, atol=1e-9)
    assert x[-1] == pytest.approx(1 / 6, abs=1e-5)


def test_a_command_changes_a_matrix() -> None:
    """x' = -x from 1 for a second, then x' = +x for another."""
    text = GROUND + "ARRAY/1, X\nARRAY/2, IC, NUMBERS=1\nMATRIX/1, ROWS=1, COLUMNS=1, VALUES=-1\n"
    deck = al.read(text + "LSE/1, X=1, A=1, IC=2\nINTEGRATOR/ERROR=1E-7\nEND\n")
    lines = "SIM/DYN, END=1, STEPS=1", "MATRIX/1, VALUES=1", "SIM/DYN, END=2, STEPS=1"
    results = al.simulate(deck, commands=read_commands("\n".join(lines) + "\n", deck))
    assert results["DIFF/ARRAY_1_1"] == pytest.approx([1, np.exp(-1), 1], abs=1e-5)


def test_matrices_in_either_order_and_names_of_arrays() -> None:
    text = "ARRAY/states, X\nMATRIX/1, FULL=CORDER, ROWS=2, COLUMNS=2, VALUES=0,-25,1,-2\n"
    deck = deck_with(text + "LSE/1, X=states, A=1\nVARIABLE/1, FUNCTION=ARYVAL(States,2)")
    assert deck.get(Lse, 1).matrices(deck).a == [(0, 1), (-25, -2)]
    assert deck.find("DIFF", "ARRAY_STATES_2") is not None


def winch(name: str, commands: str):
    """What LINEAR finds of a winch at rest."""
    deck = al.read(find("decks") / "pid-winch" / f"{name}.adm")
    run = read_commands("SIMULATE/STATICS\n" + commands, deck)
    return al.simulate(deck, commands=run).linearizations[0].model


LOOPS = [
    ("pid-winch", 0.25 * (200 + 5 / 0.25**2), (1120, 700, 448), 0.02, 0.05),
    ("pid-winch-mm", 150 * (60 + 2e5 / 150**2) / 1000, (600, 300, 200), 0.04, 0.08),
]


@pytest.mark.parametrize(("name", "inertia", "gains", "tf", "lag"), LOOPS)
def test_poles_of_a_winch(name: str, inertia: float, gains, tf: float, lag: float) -> None:
    """M R p^2 (1 + Tl p) + Kp + Ki/p + Kd p/(1 + Tf p) = 0, times p (1 + Tf p)."""
    kp, ki, kd = gains
    plant = np.polymul([lag, 1], [inertia, 0, 0])
    poles = np.roots(np.polyadd(np.polymul(plant, [tf, 1, 0]), [kp * tf + kd, kp + ki * tf, ki]))
    found_poles = winch(name, "LINEAR/EIGENSOL\n").eigenvalues
    assert np.sort_complex(found_poles) == pytest.approx(np.sort_complex(poles), rel=1e-6)


@pytest.mark.parametrize(("name", "inertia", "gains", "tf", "lag"), LOOPS)
@pytest.mark.parametrize("s", [0.5j, 6j, 2 + 1j])
def test_response_of_a_winch(
    name: str, inertia: float, gains, tf: float, lag: float, s: complex
) -> None:
    """demand/wanted = +-C/(1 + C P), P = 1/(M R s^2 (1 + Tl s)); there is a direct part."""
    model = winch(name, "LINEAR/STATEMAT, PINPUT=1, POUTPUT=1\n")
    kp, ki, kd = gains
    control = kp + ki / s + kd * s / (1 + tf * s)
    wanted = control / (1 + control / (inertia * s * s * (1 + lag * s)))
    a, b, c, d = (
        model.state_matrix, model.input_matrix, model.output_matrix, model.feedthrough,
    )  # fmt: skip
    answer = c @ np.linalg.solve(s * np.eye(len(a)) - a, b.astype(complex)) + d
    sign = 1 if name == "pid-winch" else -1
    assert len(a) == 5
    assert d[0, 0] == pytest.approx(sign * (kp + kd / tf), rel=1e-9)
    assert answer[0, 0] == pytest.approx(sign * wanted, rel=1e-6)


def test_rows_that_differ_in_numbers_share_a_kernel() -> None:
    """Twenty states, each driven by all: one kernel for their equations."""
    n = 20
    rows = [[-30.0 if i == j else 0.1 * (i - j) for j in range(n)] for i in range(n)]
    values = "\n, ".join(", ".join(map(str, row)) for row in rows)
    text = GROUND + f"ARRAY/1, X\nMATRIX/1, ROWS={n}, COLUMNS={n}, VALUES={values}\n"
    deck = al.read(text + "LSE/1, X=1, A=1\nEND\n")
    groups = compile_model(assemble(deck)).groups
    assert [len(group.instances) for group in groups if group.face == "equation"] == [n]


@pytest.mark.parametrize("change", ["ARRAY/4, NUMBERS=3,3", "LSE/1, IC=5"])
def test_start_values_of_a_system_that_has_moved_have_no_effect(change: str) -> None:
    deck = al.read(GROUND + oscillator(x1=1) + "ARRAY/5, IC, NUMBERS=3,3\nEND\n")
    first, run = f"{change}\n", "SIM/DYN, END=1, STEPS=1\n"
    assert [each.code for each in read_commands(run + first, deck).warnings] == ["no-effect"]
    commands = read_commands(first + run, deck)
    assert not commands.warnings
    assert al.simulate(deck, commands=commands)["DIFF/ARRAY_2_1"][0] == 3


GSE = """VARIABLE/1, FUNCTION={u}
ARRAY/1, U, VARIABLES=1
ARRAY/2, X, SIZE=2
ARRAY/3, Y
ARRAY/4, IC, NUMBERS=0.7,0
GSE/1, NS=2, NO=1, X=2, U=1, Y=3, IC=4, FUNCTION=USER(25,1)
INTEGRATOR/{method}ERROR=1E-7
"""


@pytest.mark.parametrize("method", ["", "RADAU, ", "ABAM, ", "HHT, "])
def test_a_routine_of_state_equations(method: str) -> None:
    """Let go at x1 = 0.7: x1 = 0.7 e^-t (cos w t + sin(w t)/w), w^2 = 24."""
    text = GROUND + GSE.format(u=0, method=method) + "END\n"
    deck = al.read(text, user={"GSESUB": user_functions.oscillator})
    results = al.simulate(deck, end=1.0, steps=10)
    t, w = results.time, np.sqrt(24)
    expected = 0.7 * np.exp(-t) * (np.cos(w * t) + np.sin(w * t) / w)
    allowed = 5e-7 * results.summary["steps"] + 1e-8
    np.testing.assert_allclose(results["DIFF/ARRAY_2_1"], expected, rtol=0, atol=allowed)
    output = results["VARIABLE/ARRAY_3_1"] / 3
    np.testing.assert_allclose(output, expected, rtol=0, atol=allowed)


def test_statics_of_a_routine_of_state_equations() -> None:
    """25 x1 = u = -50, and y = 3 x1 - u/2."""
    text = GROUND + GSE.format(u=-50, method="") + STATICS
    results = al.simulate(al.read(text, user={"GSE/1": user_functions.oscillator}))
    assert results["DIFF/ARRAY_2_1"][-1] == pytest.approx(-2.0, rel=1e-9)
    assert results["VARIABLE/ARRAY_3_1"][-1] == pytest.approx(19.0, rel=1e-9)


def test_numbers_in_place_of_state_equations() -> None:
    """x' = (2, -3), y = 5; discrete states stay at their ICD, in statics too."""
    text = GROUND + GSE.format(u=0, method="").replace("IC=4,", "IC=4, ND=1, XD=5, ICD=6,")
    text = text.replace("FUNCTION=USER", "SAMPLE_PERIOD=0.1\\, INTERFACE=lib::rates, FUNCTION=USER")
    text += "ARRAY/5, X, SIZE=1\nARRAY/6, IC, NUMBERS=8\nVARIABLE/2, FUNCTION=ARYVAL(5,1)\nEND\n"
    results = al.simulate(al.read(text, user={"lib::rates": (2, -3, 5)}), end=1.0, steps=2)
    assert results["DIFF/ARRAY_2_1"] == pytest.approx([0.7, 1.7, 2.7], abs=1e-9)
    assert results["DIFF/ARRAY_2_2"] == pytest.approx([0.0, -1.5, -3.0], abs=1e-9)
    assert results["VARIABLE/ARRAY_3_1"].tolist() == [5.0] * 3
    assert results["VARIABLE/2"].tolist() == [8.0] * 3


def test_a_routine_that_is_missing_is_named() -> None:
    with pytest.raises(al.DeckError) as failed:
        al.read(GROUND + GSE.format(u=0, method="") + "END\n")
    (found,) = failed.value.diagnostics
    assert found.code == "missing-routine" and "GSESUB" in found.message
    assert "'GSE/1': number" in found.hint


@pytest.mark.parametrize("method", sorted(set(methods()) - {"VERLET"}))
def test_every_method_lifts_the_load(method: str) -> None:
    """The winch of decks/pid-winch with its controller in the loop: ERROR in each step adds up."""
    folder = find("decks") / "pid-winch"
    reference = al.Results.load(folder / "pid-winch.reference.csv")
    results = al.simulate(al.read(folder / "pid-winch.adm"), integrator=method, error=1e-6)
    assert results.outcome is al.Outcome.DONE
    rows = np.searchsorted(results.time, reference.time - 1e-9)
    for name in ("PART/3.z", "VARIABLE/demand"):
        allowed = 1e-6 * results.summary["steps"] * np.abs(reference[name]).max()
        np.testing.assert_allclose(results[name][rows], reference[name], rtol=0, atol=allowed)


@pytest.mark.parametrize("size", ["1E30", "-1", "0"])
def test_an_array_of_any_size_is_read(size: str) -> None:
    found = codes(f"ARRAY/1, X, SIZE={size}\nVARIABLE/1, FUNCTION=ARYVAL(1,1)")
    assert found in (["system-value"], ["no-such-value"])


@pytest.mark.parametrize("form", ["FUNCTION=6-2*DIF(1)", "IMPLICIT, FUNCTION=DIF1(1)-6+2*DIF(1)"])
@pytest.mark.parametrize("method", ["GSTIFF", "ABAM"])
def test_dynamic_hold_lets_statics_alone_move_a_state(form: str, method: str) -> None:
    """y = 1 at the start, 3 at rest; in between nothing moves it."""
    text = GROUND + f"DIFF/1, IC=1, DYNAMIC_HOLD, {form}\nINTEGRATOR/{method}\n"
    run = "SIM/DYN, END={}, STEPS=1\n"
    deck = al.read(text + "END\n")
    commands = read_commands(run.format(1) + "SIM/STATICS\n" + run.format(2), deck)
    results = al.simulate(deck, commands=commands)
    assert results["DIFF/1"] == pytest.approx([1, 1, 3, 3], rel=1e-9)


@pytest.mark.parametrize(
    "broken",
    [
        "MATRIX/1, ROWS=1, COL]UMNS=1, VALUES=1\nARRAY/1, X, SIZE=1\nLSE/1, X=1, A=1\n",
        "LSE/1, U=\n",
    ],
)
def test_a_matrix_that_is_not_read_has_no_rank(broken: str) -> None:
    """Its COLUMNS are misspelled, or the LSE is half read; the statics look at no matrix."""
    with pytest.raises(al.DeckError) as caught:
        al.read(f"t\nPART/1, GROUND\n{broken}SIMULATE/STATICS\nEND\n")
    assert {each.span.line for each in caught.value.errors} == {3}

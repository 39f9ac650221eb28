"""Reductions of a model change what it costs, not what comes out."""

from pathlib import Path

import numpy as np
import pytest
import scenes
from newton_matrix import Newton
from tiers import every

import adamslite
from adamslite.analyses.dynamics import planar_reduction
from adamslite.analyses.session.session import Session
from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.model.reduction import RULES
from adamslite.scene import load_scene

DECKS = Path(__file__).parent.parent / "decks"

#: Deck, end of the run, and the rules that apply to it. The ends keep steps of 1e-12 affordable.
SCENES = {
    "four-bar/four-bar": (0.05, ("plane",)),
    "slider-crank/slider-crank": (0.02, ("plane",)),
    "andrews/andrews": (0.01, ("plane",)),
    "pulley-drive/pulley-drive": (0.2, ("plane", "variables")),
    "cable-level3-n10/cable-level3-n10": (0.02, ("variables",)),
    "atwood/atwood-coupler": (0.1, ("plane",)),
    "car-axis/car-axis": (0.1, ("points",)),
    "swinging-cable-n10/swinging-cable-n10": (0.05, ("points",)),
    "hanging-mass/hanging-mass": (0.5, ("points",)),
}

#: Deck -> the largest square of a frequency, 4 (EA/h)/m of a row of masses m on springs EA/h
#: [1/s^2], where the last digit of a place shows in an acceleration.
STIFF = {"cable-level3-n10/cable-level3-n10": 4 * (6.0e7 / 2.0) / 11.072}

#: Deck -> HMAX [s], below the steps that ERROR allows where these are chosen from round-off, so
#: that the runs have the same ones.
LONGEST = {"cable-level3-n10/cable-level3-n10": 2.5e-5}


def run(deck: str, end: float, *rules: str) -> adamslite.Results:
    scene = load_scene(DECKS / f"{deck}.adm")
    return adamslite.simulate(
        scene.deck, commands=scene.commands, end=end, steps=5, integrator="RADAU", error=1e-11,
        hmax=LONGEST.get(deck), no_reduction=rules,
    )  # fmt: skip


def folded(deck: str) -> int:
    """How many unknowns and equations are left out because the model stays in a plane."""
    scene = load_scene(DECKS / f"{deck}.adm")
    session = Session(scene.deck, None, {})
    session.prepare()
    planar_reduction.reduce_to_plane(session.system)
    return session.system.elimination.held.size


def sizes(results: adamslite.Results) -> np.ndarray:
    """Of every column the largest value of its kind (ax with ay and az), or 1: (nc,)."""
    kinds = [name.partition(".")[2].rstrip("xyz") for name in results.names]
    largest = np.abs(results.values).max(axis=0)
    return np.array([max(largest[[k == kind for k in kinds]].max(), 1.0) for kind in kinds])


def last_digits(deck: str, results: adamslite.Results) -> np.ndarray:
    """What the last digit of places makes of every column, in its unit: (nc,)."""
    places = [n for n in results.names if n.startswith("POINT_MASS/") and n[-2:] in (".x", ".y")]
    digit = max((np.spacing(np.abs(results[name]).max()) for name in places), default=0.0)
    return np.array([STIFF.get(deck, 0.0) * digit * (".a" in name) for name in results.names])


@pytest.mark.parametrize(
    ("deck", "rule"),
    every(2, [(deck, rule) for deck, (_, rules) in SCENES.items() for rule in rules]),
)
def test_results_are_the_same_with_and_without(deck: str, rule: str) -> None:
    """To 1e-9 of the largest value of its kind; ERROR = 1e-11 of a method of order 5 leaves less
    than that.

    And to the digits that places have. A place is kept to one unit u of its last digit; two runs
    that round otherwise differ by u, in all of the accelerations

        m a_k = (EA/h) (x_(k+1) - 2 x_k + x_(k-1))   by up to   4 (EA/h)/m u

    The cable lies at 20 m, u = 3.6e-15 m, EA/h = 30 MN/m, m = 11 kg: 3.8e-8 m/s^2 of 4.9 m/s^2. A
    digit of one place alone makes 1e-8 m/s^2, and a force of (EA/h) u = 1e-7 N of 14 kN.
    """
    end = SCENES[deck][0]
    assert rule != "plane" or folded(deck)
    reduced, whole = run(deck, end), run(deck, end, rule)
    assert reduced.outcome.name == whole.outcome.name == "DONE"
    assert reduced.names == whole.names
    allowed = 1e-9 * sizes(whole) + last_digits(deck, whole)
    assert (np.abs(reduced.values - whole.values).max(axis=0) < allowed).all()


@pytest.mark.slow
def test_a_planar_mechanism_is_folded_and_others_are_not() -> None:
    """Three parts of a four-bar: 3 coordinates each out of the plane, and of the 20 rows 12 that
    hold them, 3 of which are redundant and left out before; stabilised every row counts twice.
    """
    assert folded("four-bar/four-bar") == 3 * 3 + 2 * (12 - 3)
    assert folded("heavy-top/heavy-top") == 0
    assert folded("bricard/bricard") == 0
    assert folded("swinging-cable-n10/swinging-cable-n10") == 0


def test_a_plane_leaves_products_out_of_the_newton_matrix() -> None:
    """Two hinged rods: what is left of the matrix is as in space, from a third of the products."""
    space, flat = (scenes.system(scenes.links(2)) for _ in range(2))
    assert all(planar_reduction.reduce_to_plane(each) for each in (space, flat))
    space.elimination.unfold()
    left = np.ix_(*(2 * [flat.elimination.unknowns()]))
    matrices = [Newton(each).exact()[left] for each in (space, flat)]
    np.testing.assert_allclose(*matrices, rtol=1e-14, atol=1e-14)
    assert np.abs(matrices[0]).max() > 1.0
    products = [each.elimination.mixed.reshape(-1, 8) for each in (space, flat)]
    whole, rest = (int((each[:, 2] * each[:, 4]).sum()) for each in products)
    assert 0 < 3 * rest < whole


KICKED = """A pendulum in a plane, on a ball joint, until something pushes it aside
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=2, IP=0.1,0.1,0.1, QG=1,0,0
MARKER/2, PART=2
MARKER/3, PART=2, QP=-1,0,0
JOINT/1, SPHERICAL, I=3, J=1
VFORCE/1, I=2, J_PART=1, FZ=STEP(TIME,0.2,0,0.3,{push})
SIMULATE/DYNAMIC, END=0.5, STEPS=10
END
"""


def test_a_model_that_leaves_its_plane_is_solved_in_space() -> None:
    """A force of 5 N across from t = 0.2 on: as if the plane had never been thought of."""
    deck = adamslite.read(KICKED.format(push=5))
    tried = adamslite.simulate(deck, error=1e-10)
    whole = adamslite.simulate(deck, error=1e-10, no_reduction=["plane"])
    assert tried.outcome.name == "DONE"
    assert np.abs(tried["PART/2.z"]).max() > 0.05
    np.testing.assert_array_equal(tried.values, whole.values)
    flat = adamslite.simulate(adamslite.read(KICKED.format(push=0)), error=1e-10)
    assert np.abs(flat["PART/2.z"]).max() == 0.0


@pytest.mark.parametrize("spin", [30, -50])
def test_angles_count_their_turns_again_after_a_plane_was_left(spin: float) -> None:
    """Whirled round its pivot against a torsion spring; on leaving the plane at t = 0.2, one or two
    turns on, the run begins again in space with the spring as it was at the start.
    """
    deck = KICKED.format(push=5).replace("QG=1,0,0", f"QG=1,0,0, WZ={spin}, VY={spin}")
    spring = "SFORCE/1, ROTATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=-20*AZ(2,1)\n"
    deck = adamslite.read(deck.replace("SIMULATE", f"{spring}SIMULATE"))
    tried = adamslite.simulate(deck, error=1e-8)
    whole = adamslite.simulate(deck, error=1e-8, no_reduction=["plane"])
    assert np.abs(tried["PART/2.z"]).max() > 1e-3
    np.testing.assert_array_equal(tried.values, whole.values)


def test_the_flag_of_solve(tmp_path, capsys) -> None:
    deck = str(DECKS / "four-bar" / "four-bar.adm")
    common = ["solve", deck, "--end", "0.01", "--steps", "1", "-o", str(tmp_path / "out.csv")]
    assert main([*common, "--no-reduction", "plane", "--no-reduction", "points"]) == 0
    assert main([*common, "--no-reduction", "flat"]) == 2
    assert "There is no reduction flat. There are fixed, plane, points, variables." in (
        capsys.readouterr().err
    )
    with pytest.raises(UsageError):
        adamslite.simulate(adamslite.read(KICKED.format(push=0)), no_reduction=["all"])


def test_every_rule_is_told_in_the_manual() -> None:
    told = (DECKS.parent / "docs" / "reference" / "runs.md").read_text(encoding="utf-8")
    assert all(f"`{rule}`" in told for rule in RULES)

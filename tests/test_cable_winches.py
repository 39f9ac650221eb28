"""Winches of `adamslite cable` with motors, brakes and limit switches, and what they lower."""

import numpy as np
import pytest
from descriptions import HOIST, PAYOUT

import adamslite
from adamslite.cables.deck.scene import deck
from adamslite.cables.description.head_comments import below

G = 9.81
#: Lowers 1000 kg from a drum of 0.5 m and J = 25 kg m^2.
RIGID = HOIST + "[model]\nlevel = 1\n"


def run(spec: str) -> adamslite.Results:
    found = adamslite.simulate(adamslite.read(deck(spec)[0]))
    assert found.outcome.name == "DONE"
    return found


@pytest.mark.parametrize("most", [500.0, 4000.0])
def test_a_motor_has_the_torque_of_its_characteristic(most: float) -> None:
    """It is asked for 6000 N m, has `most` up to 1e3 rad/s, and the load falls faster."""
    drive = f'torque = "6000"\nmotor = {{ curve = [[0, {most}], [1000, {most}]] }}'
    found = run(RIGID.replace(PAYOUT, drive))
    a = (1000 * G - most / 0.5) / (1000 + 25 / 0.5**2)
    assert found["VARIABLE/S_10"] == pytest.approx(a * found.time**2 / 2, rel=1e-5, abs=1e-6)


def test_a_motor_loses_torque_with_its_speed() -> None:
    """Two points of a characteristic, M0 (1 - w/w0), are a straight line: with v = w R

    m v' = M g - M0/R (1 - v/(R w0)),  v = (M g - M0/R)/(m k) (exp(k t) - 1),  k = M0/(m R^2 w0)
    """
    full, fastest = 4500.0, 200.0
    drive = f'torque = "6000"\nmotor = {{ curve = [[0, {full}], [{fastest}, 0]] }}'
    found = run(RIGID.replace(PAYOUT, drive))
    m, t = 1000 + 25 / 0.5**2, found.time
    k = full / (m * 0.5**2 * fastest)
    v = (1000 * G - full / 0.5) / (m * k) * np.expm1(k * t)
    assert found["VARIABLE/SD_10"] == pytest.approx(v, rel=1e-5, abs=1e-6)


def test_a_brake_holds_without_creeping() -> None:
    """Twice the torque of the load: displaced by half a tenth of a millimetre, and still."""
    drive = f'torque = "0"\nbrake = {{ torque = {2 * 1000 * G * 0.5}, applied = "1" }}'
    found = run(RIGID.replace(PAYOUT, drive).replace("end = 2", "end = 20"))
    late = found["VARIABLE/S_10"][found.time > 5]
    assert late[0] < 1e-3 and np.ptp(late) < 1e-6


def test_a_limit_switch_takes_the_motor_away_for_the_rest_of_the_run() -> None:
    """The load is lifted with constant acceleration to 0.5 m; then it falls freely with the drum,
    past the place where the switch acted."""
    drive = 'torque = "7000"\nlimit = [-0.5, 2]'
    found = run(RIGID.replace(PAYOUT, drive))
    masses = 1000 + 25 / 0.5**2
    up, down = (7000 / 0.5 - 1000 * G) / masses, -1000 * G / masses
    t0 = np.sqrt(2 * 0.5 / up)
    t = found.time
    rises = up * t**2 / 2
    falls = 0.5 + up * t0 * (t - t0) + down * (t - t0) ** 2 / 2
    assert -found["VARIABLE/S_10"] == pytest.approx(np.where(t < t0, rises, falls), abs=3e-5)


def test_a_speed_without_motor_is_kept() -> None:
    found = run(RIGID.replace(PAYOUT, 'speed = "1.5*SIN(3*TIME)"'))
    assert found["REQUEST/10.F2"] == pytest.approx((1 - np.cos(3 * found.time)) / 2, abs=1e-5)


def test_a_speed_may_depend_on_the_payout() -> None:
    """s' = 1 - s."""
    found = run(RIGID.replace(PAYOUT, 'speed = "1-S"'))
    assert found["REQUEST/10.F2"] == pytest.approx(1 - np.exp(-found.time), abs=1e-5)


@pytest.mark.parametrize(
    ("words", "codes"),
    [
        ('torque = "5"\nlimit = 3', ["wrong-value"]),
        ('torque = "5"\nlimit = [3, -3]', ["wrong-value"]),
        ('torque = "5"\nmotor = { curve = [[0, 1], [0, 2]] }', ["wrong-value"]),
        ('torque = "5"\nmotor = { curve = [[0, 1], [2, -2]] }', ["wrong-value"]),
        ('torque = "5"\nbrake = {}', ["missing-key"]),
        ('torque = "5"\nbrake = { torque = 5, applied = "FOO(3)" }', ["expression"]),
        ('speed = "SQRT(-1-TIME)"', ["law-no-value"]),
        ('speed = "1e60"', ["law-no-value"]),
        ('speed = "2"\nforce = "3"', ["drive"]),
    ],
)
def test_a_drive_that_cannot_be_is_named(words: str, codes: list[str]) -> None:
    with pytest.raises(adamslite.DeckError) as fault:
        deck(RIGID.replace(PAYOUT, words))
    assert [each.code for each in fault.value.diagnostics] == codes


def test_stations_follow_the_fall_and_not_the_file() -> None:
    """The same deck, from tables in another order."""
    head, winch, weight = RIGID.replace("[model]", "[[route]]\n[model]", 1).split("[[route]]\n")[:3]
    weight, model = weight.split("[model]")[0], "[model]\nlevel = 1\n"
    named = (winch + 'name = "drum"\n', weight + 'name = "load"\n')
    turned = f'fall = "drum load"\n{head}' + "".join(
        f"[[route]]\n{table}" for table in reversed(named)
    )
    straight = "[[route]]\n".join((head, *named)) + model
    assert below(deck(turned + model)[0]) == below(deck(straight)[0])


TACKLE = """\
end = 1
fall = "{fall}"
[cable]
EA = 1e8
rho = 1e-3
[[route]]
kind = "winch"
name = "drum"
at = [-0.6, 4, 0]
radius = 0.2
inertia = 3
turn = -1
force = "{pull}"
[[route]]
kind = "pulley"
name = "s1"
at = [-0.2, 0, 0]
radius = 0.2
inertia = 0.04
{block}
{others}
[model]
level = 1
"""
BECKET = """\
[[load]]
name = "block"
at = [0, -0.5, 0]
mass = 300
inertia = 20
[[route]]
kind = "pulley"
name = "crown"
at = [0.2, 4, 0]
radius = 0.2
inertia = 0.04
[[route]]
kind = "hook"
name = "becket"
load = "block"
at = [0.4, 0, 0]
"""


@pytest.mark.parametrize("pull", [600.0, 1500.0])
def test_three_falls_end_at_a_becket_on_the_block(pull: float) -> None:
    """The block sinks by s/3; 2/3 of s go over its sheave, 1/3 over the crown sheave. Sheaves have
    J/R^2 = 1 kg, the drum 75 kg: s" (75 + M/9 + 4/9 + 1/9) = M g/3 - Q."""
    spec = TACKLE.format(
        fall="drum s1 crown becket", pull=pull, block='load = "block"', others=BECKET
    )
    found = run(spec)
    a = (301 * G / 3 - pull) / (75 + 301 / 9 + 5 / 9)
    assert found["REQUEST/10.F2"][-1] == pytest.approx(a / 2, rel=1e-4)
    assert found["PART/50.y"][-1] == pytest.approx(-0.5 - a / 6, abs=1e-4)


SECOND_DRUM = """\
[[route]]
kind = "winch"
name = "second"
at = [0.2, 3, 0]
radius = 0.2
inertia = 6
turn = -1
force = "{pull}"
"""


@pytest.mark.parametrize("pulls", [(900.0, 900.0), (700.0, 500.0)])
def test_a_block_hangs_between_two_drums(pulls: tuple[float, float]) -> None:
    """By Lagrange's equations for what both pay out: the block sinks by (s1 + s2)/2, and its sheave
    turns by (s1 - s2)/(2 R)."""
    block = "mass = 150\nslide = [0, 1, 0]"
    others = SECOND_DRUM.format(pull=pulls[1])
    found = run(TACKLE.format(fall="drum s1 second", pull=pulls[0], block=block, others=others))
    drums, block_mass, sheave = np.diag([75.0, 150.0]), 151.0, 1.0
    both, aside = np.ones((2, 2)) / 4, np.array([[1, -1], [-1, 1]]) / 4
    rates = np.linalg.solve(
        drums + block_mass * both + sheave * aside, block_mass * G / 2 - np.array(pulls)
    )
    assert found["REQUEST/10.F2"][-1] == pytest.approx(rates[0] / 2, rel=1e-4)
    # The route goes to the second drum: what it pays out runs against it.
    assert -found["REQUEST/30.F2"][-1] == pytest.approx(rates[1] / 2, rel=1e-4)


@pytest.mark.parametrize("drive", ['payout = "0.5*TIME**2"', 'speed = "TIME"'])
def test_a_winch_that_a_law_turns_needs_no_inertia(drive: str) -> None:
    """Its tensions are those with any inertia, to the accuracy of the runs."""
    spec = "error = 1e-9\n" + HOIST.replace(PAYOUT, drive) + "[model]\nlevel = 3\nelements = 2\n"
    bare = adamslite.simulate(adamslite.read(deck(spec.replace("inertia = 25\n", ""))[0]))
    full = adamslite.simulate(adamslite.read(deck(spec)[0]))
    for name in ("REQUEST/1.F2", "REQUEST/1.F3"):
        assert bare[name] == pytest.approx(full[name], rel=1e-6)


@pytest.mark.parametrize(
    ("drive", "more"),
    [
        ('force = "9810"', ""),
        ('speed = "TIME"', "motor = { curve = [[0, 1e4], [9, 0]], gain = 1e4 }"),
        (PAYOUT, "mount = { foot = [0, 1, 0], mass = 50, stiffness = 1e6 }"),
        (PAYOUT, "mass = 30"),
        (PAYOUT, 'load = "box"'),
    ],
)
def test_a_winch_whose_inertia_counts_needs_it(drive: str, more: str) -> None:
    """Forces turn it, or move its bearing with the mass that goes with the inertia."""
    spec = HOIST.replace(PAYOUT, f"{drive}\n{more}").replace("inertia = 25\n", "")
    with pytest.raises(adamslite.DeckError, match="station 1 needs inertia"):
        deck(spec)

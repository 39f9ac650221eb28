"""Models of a description are tried: what is taken, what is reported, and what it costs."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from descriptions import ATWOOD, hoist, hung

import adamslite as al
from adamslite.api.trials import described, solver
from adamslite.cables.deck.scene import deck, setting
from adamslite.cables.description.head_comments import below
from adamslite.cables.model.advice import notched
from adamslite.cables.trials.readings import Readings, Series, collision, doubts_of
from adamslite.cables.trials.trial import Found, tried
from adamslite.cables.trials.trial_runs import TOO_LONG, Solution
from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.progress import Progress

HUNG = hung(end=1, cable="EA = 1e6\nrho = 1", at=(0, -20), mass=100) + "velocity = [0, 0.1, 0]\n"
HOIST = hoist(
    end=3,
    cable="EA = 1e7\nrho = 0.5",
    radius=0.3,
    inertia=5,
    law="STEP5(TIME,0,0,2,-4)",
    mass=500,
)
WINCHES = Path(al.__file__).parent.parent / "decks" / "cables" / "winches"
Error = Callable[[int, float], float]


def made_up(error: Error, steps: int = 500, rigid: float = 0.5, slack: float = 0.0) -> Callable:
    """A solver whose greatest tension, 1000 N, is off by `error` of sections and ERROR; its steps
    grow with the sections."""

    def solve(text: str, columns: tuple[str, ...], most: float) -> Solution:
        sections = len(re.findall(r"^SFORCE/", text, re.M))
        found = re.search(r"ERROR=(\S+)", text)
        assert found
        taken = steps * max(sections, 1)
        if taken > most:
            return Solution(Series(np.empty(0), {}), taken, 1.0, "too long")
        off = error(sections, float(found[1])) if sections else rigid
        pull = np.linspace(500.0 if "MAX(0" in text else 500.0 - slack, 1000.0 * (1 + off), 50)
        names = ("REQUEST/1.F2", "REQUEST/1.F3") if sections else ("GCON/1.f",)
        sign = 1 if sections else -1
        found_columns = {name: sign * pull for name in names}
        return Solution(Series(np.linspace(0, 1, 50), found_columns), taken, 0.1)

    return solve


def with_trial(solve: Callable, text: str = HUNG, allowance: float = 10.0) -> Found:
    return tried(setting(text + '[model]\nquantities = ["tension"]\n'), solve, allowance)


def codes(found: Found) -> list[str]:
    return [each.code for each in found.deck.messages]


@pytest.mark.parametrize(
    ("share", "power", "fewest"), [(0.1, 1, 11), (0.1, 2, 4), (1.0, 2, 11), (0.001, 1, 1)]
)
def test_the_fewest_sections_that_do_are_taken(share: float, power: int, fewest: int) -> None:
    """An error of share/n^power, n doubled and halved: no half of what is taken would do."""
    found = with_trial(made_up(lambda n, error: share / n**power))
    n = found.deck.model.elements
    assert fewest <= n <= 1.5 * fewest
    assert share / n**power < 0.01
    assert n == 1 or share / ((n + 1) // 2) ** power > 0.007
    assert found.off == pytest.approx(share / n**power, abs=0.002)


def test_a_loose_error_is_taken_where_it_is_cheaper_and_does() -> None:
    """ERROR 10, 100 times that of the linear model leaves 0.2 and 2 %, and halves the steps."""
    first = setting(HUNG)
    base = deck(HUNG)[0]
    error = float(re.search(r"ERROR=(\S+)", base)[1])  # type: ignore[index]

    def solve(text: str, columns: tuple[str, ...], most: float) -> Solution:
        loose = float(re.search(r"ERROR=(\S+)", text)[1]) / error  # type: ignore[index]
        steps = int(1000 / max(loose, 0.1) ** 0.5)
        return made_up(lambda n, e: 0.0002 * max(loose, 0.0), steps)(text, columns, most)

    found = tried(first, solve, 10.0)
    assert found.deck.model.error == pytest.approx(10 * error)


@pytest.mark.parametrize("plateau", [1e-8, 2e-8, 5e-8])
def test_an_error_that_stays_as_error_falls_is_seen(plateau: float) -> None:
    """2 % that ERROR leaves until it is small, about which 22, 44 and 88 sections agree."""

    def error(n: int, bound: float) -> float:
        return 0.02 * min(1.0, bound / plateau) + 0.05 / n**2

    chosen = with_trial(made_up(error, steps=2000)).deck.model
    assert error(chosen.elements, chosen.error) < 0.01


def test_where_nothing_settles_but_differences_fall_the_finest_is_taken() -> None:
    """An error of 0.5/n^0.3: 7 % are left with the most sections that a cable may have."""
    found = with_trial(made_up(lambda n, error: 0.5 / n**0.3))
    assert codes(found) == ["unsettled"]
    assert found.finest and found.deck.model.elements == found.finest.elements > 450


@pytest.mark.parametrize(
    ("means", "off"),
    [
        ((0.0, 4.0, 6.0), 2.5),
        ((0.0, 4.0, 5.0), 1.25 / 3),
        ((0.0, 2.0, 6.0), 5 / 0.37),
        ((0.0, -4.0, -6.0), 2.5),
        ((0.0, 4.0, 2.0), 2.5),
        ((0.0, 4.0, 3.0), 1.25),
        ((0.0, 4.0, -2.0), 7.5),
    ],
)
def test_what_the_finest_run_is_off(means: tuple[float, ...], off: float) -> None:
    """1.25 d f/(1 - f) with f = 1/2, 1/4; as of a front, 1/0.37, where differences grow; 1.25
    of the last difference where they change their sign."""
    key = ("tension", 1, 0)
    runs = [Readings({key: (np.full(3, mean), 1.0)}) for mean in means]
    assert doubts_of(runs, ("tension",))[key] == pytest.approx(np.full(3, off), rel=1e-12)


def test_level_1_is_taken_where_it_does() -> None:
    """And the warning that its waves matter, which runs refute, is not reported."""
    for off, level in ((0.004, 1), (0.02, 3)):
        found = with_trial(made_up(lambda n, error: 0.0, rigid=off), HOIST)
        assert (found.deck.model.level, codes(found)) == (level, [])


def test_runs_are_counted_and_what_is_not_shown_is_told() -> None:
    """An error that falls too slowly: the finest model, what it reached, and how to allow more."""
    found = with_trial(made_up(lambda n, error: 1 / n**0.1, steps=20000))
    assert codes(found) == ["unsettled"]
    (told,) = found.deck.messages
    assert "the greatest tension of span 1 differs by" in told.message
    assert "--trial 100" in told.hint
    (told,) = with_trial(made_up(lambda n, error: 1 / n**0.1)).deck.messages
    assert "a cable may have 900 sections" in told.hint
    slow = with_trial(made_up(lambda n, error: 0.0, steps=10**9), allowance=1.0)
    assert codes(slow) == ["unsettled"]
    assert slow.deck.text == deck(HUNG + '[model]\nquantities = ["tension"]\n')[0]


def test_a_first_run_that_takes_too_long_is_followed_by_a_coarser_one() -> None:
    """More than five sections take too long; one in a thousand of a section is left."""

    def solve(text: str, columns: tuple[str, ...], most: float) -> Solution:
        if len(re.findall(r"^SFORCE/", text, re.M)) > 5:
            return Solution(Series(np.empty(0), {}), most, 1.0, TOO_LONG)
        return made_up(lambda n, error: 0.001 / n)(text, columns, most)

    assert with_trial(made_up(lambda n, error: 0.0), HUNG, 0.0).deck.model.elements > 5
    assert codes(with_trial(solve, HUNG, 40.0)) == ["unsettled"]
    finest = with_trial(solve, HUNG, 40.0).finest
    assert finest and finest.elements <= 5


@pytest.mark.parametrize("name", ["hoist", "reel-hoist"])
def test_a_winch_with_states_is_tried_too(name: str) -> None:
    """RADAU integrates it; whatever runs show, there is a deck."""
    text = (WINCHES / f"{name}.toml").read_text(encoding="utf-8")
    text = re.sub(r"(?m)^(level|elements|form|error) = .*\n", "", text)
    found = described(text, name, 0.5, Progress())
    assert "INTEGRATOR/RADAU" in found.deck.text


def test_a_run_that_fails_spoils_only_its_model() -> None:
    """Every second rung ends early: the others decide; when all do, the linear model does."""
    fine = made_up(lambda n, error: 0.05 / n**2)

    def solve(text: str, columns: tuple[str, ...], most: float) -> Solution:
        if len(re.findall(r"^SFORCE/", text, re.M)) % 8:
            return Solution(Series(np.empty(0), {}), 10, 1.0, "The corrector did not converge")
        return fine(text, columns, most)

    assert codes(with_trial(solve)) in ([], ["unsettled"])

    def never(text: str, columns: tuple[str, ...], most: float) -> Solution:
        return Solution(Series(np.empty(0), {}), 10, 1.0, "The corrector did not converge")

    found = with_trial(never)
    assert codes(found) == ["unsettled"]
    assert "The corrector did not converge" in found.deck.messages[0].message


def test_a_cable_that_goes_slack_only_pulls() -> None:
    found = with_trial(made_up(lambda n, error: 0.0, slack=600.0))
    assert codes(found) == ["goes-slack"]
    assert "MAX(0," in found.deck.text
    assert "-100 N" in found.deck.messages[0].message


def test_what_is_asked_for_stays() -> None:
    """Sections, or ERROR, or a level, by name."""
    solve = made_up(lambda n, error: 0.1 / n)
    assert with_trial(solve, HUNG).deck.model.level == 2
    whole = setting(HUNG + "[model]\nelements = 3\n")
    assert tried(whole, solve, 10.0).deck.model.elements == 3
    error = setting("error = 3e-7\n" + HUNG)
    assert tried(error, solve, 10.0).deck.model.error == 3e-7


@pytest.mark.parametrize("steps", range(-7, 8))
def test_sizes_of_error_are_1_2_5(steps: int) -> None:
    sizes = [10.0**k * m for k in range(-9, 3) for m in (1, 2, 5)]
    at = sizes.index(0.02) if 0.02 in sizes else 22
    assert notched(0.02, steps) == pytest.approx(sizes[at + steps])


def test_the_command_tries_and_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A deck by trial; without it the one of the linear model; Python gives the same."""
    path = tmp_path / "hoist.toml"
    path.write_text(HOIST, encoding="utf-8")
    assert main(["cable", str(path)]) == 0
    out, err = capsys.readouterr()
    head = " ".join(out[: out.index("! Written")].replace("\n! ", " ").split())
    assert re.search(r"1 section in form paper, ERROR=\S+ by trial: 0\.\d+ % off in the", head)
    assert re.search(r"level 3, 1 section: 0\.\d+ % off by trial; a run takes about \S+ s", err)
    assert al.cable(HOIST) == out
    assert main(["cable", "--no-trial", str(path)]) == 0
    out, err = capsys.readouterr()
    assert (out, err) == (deck(HOIST)[0], "")
    assert al.cable(HOIST, trial=0) == out
    assert below(al.cable(HOIST + "[model]\ntrial = 0\n")) == below(out)
    with pytest.raises(UsageError):
        al.cable(HOIST, trial=-1)


def test_what_was_promised_holds() -> None:
    """The hoist as it is written, against 20 sections of form ale and a hundredth of its ERROR."""
    text = al.cable(HOIST)
    fine = deck("error = 1e-7\n" + HOIST + '[model]\nform = "ale"\nlevel = 3\nelements = 20\n')[0]
    one, truth = (al.simulate(al.read(each)) for each in (text, fine))
    for name in ("REQUEST/1.F2", "REQUEST/1.F3", "POINT_MASS/20.y"):
        for word in ("max", "min", "mean"):
            values = [getattr(run[name] - (run[name][0] if "y" in name else 0), word)()
                      for run in (one, truth)]  # fmt: skip
            assert values[0] == pytest.approx(values[1], abs=0.01 * np.abs(truth[name]).max())


def test_a_run_ends_at_its_last_step() -> None:
    """A run of more steps than it may take is none."""
    text, _ = deck("steps = 3000\n" + HUNG)
    ended = solver(Progress())(text, ("REQUEST/1.F2",), 100)
    assert ended.ended and not ended.run.columns
    done = solver(Progress())(text, ("REQUEST/1.F2", "GCON/1.f"), 1e6)
    assert not done.ended and list(done.run.columns) == ["REQUEST/1.F2"]


def test_a_deck_that_cannot_be_assembled_is_no_fault_of_the_command() -> None:
    broken = "T\nPART/1, GROUND\nnonsense\nEND\n"
    assert solver(Progress())(broken, (), 1e6).ended


def test_the_same_deck_twice() -> None:
    """Nothing of the clock is in it."""
    decks = {described(HOIST, "<text>", None, Progress()).deck.text for _ in range(2)}
    assert len(decks) == 1


HAULED = """
end = 20
[cable]
EA = 2e7
rho = 3
[[route]]
kind = "fixed"
at = [0, 20, 0]
[[route]]
kind = "mass"
at = [10, 17, 0]
mass = 300
slides = true
haul = "STEP5(TIME,1,0,18,80)"
[[route]]
kind = "fixed"
at = [100, 20, 0]
[model]
elements = 8
"""


def test_a_method_that_does_not_come_to_the_end_is_not_written() -> None:
    """HHT stopped at 1.2 s of 20; GSTIFF ends."""
    found = described(HAULED, "<text>", 10.0, Progress())
    assert not found.deck.messages and found.deck.model.method == "GSTIFF, SI2"
    assert "HHT did not come to an end" in found.deck.text.replace("\n! ", " ")
    assert al.simulate(al.read(found.deck.text)).success


def test_a_model_whose_run_does_not_end_is_told() -> None:
    """With elements, which leave nothing to be tried."""

    def fails(text: str, columns: tuple[str, ...], most: float) -> Solution:
        return Solution(Series(np.empty(0), {}), 1.0, 1.0, "it stops at t = 1")

    found = tried(setting(HUNG + "[model]\nelements = 3\n"), fails, 10.0)
    assert codes(found) == ["does-not-end"]
    assert not codes(tried(setting(HUNG + "[model]\nelements = 3\n"), fails, 0.0))


@pytest.mark.slow
@pytest.mark.parametrize("model", ["", "[model]\nelements = 1\n"])
@pytest.mark.parametrize("friction", ["", "friction = 1.0\n"])
def test_a_weight_that_runs_into_its_wheel_is_named(model: str, friction: str) -> None:
    """5 kg and 3 kg go (2 g - M/R)/m t^2/2 = 5 m, m = 10.1 kg with the wheels and 11.6 m of cable:
    2.27 s without friction M of one wheel, known before the run, and more with it, by trial."""
    named = ATWOOD[: ATWOOD.index("[model]")].replace("end = 0.5", "end = 3")
    named = named.replace("mass = 3", 'mass = 3\nname = "cage"')
    spec = named.replace("inertia = 0.04\n", f"inertia = 0.04\n{friction}", 1) + model
    found = described(spec, "<text>", 10.0, Progress()).deck.messages
    assert [each.code for each in found] == ["does-not-end" if friction else "runs-into-wheel"]
    what = "weight of station 4 (cage) runs into the wheel of station 3 at TIME = "
    _, said, rest = found[0].message.partition(what)
    wanted = (10 * 10.116 / (2 * 9.81 - bool(friction) / 0.2)) ** 0.5
    assert said and float(rest.split(":")[0]) == pytest.approx(wanted, rel=1e-2)
    early = described(spec.replace("end = 3", "end = 2"), "<text>", 10.0, Progress())
    assert not any("runs into" in each.message for each in early.deck.messages)


@pytest.mark.parametrize("sense", [1, -1])
def test_a_winch_between_two_weights_pulls_one_into_it(sense: int) -> None:
    """5 m of payout along the route, or against it, from weights 4 m and 6 m below."""
    spec = ATWOOD.replace("end = 0.5", "end = 1").replace("[2, -5, 0]", "[0.4, -4, 0]")
    first = spec.index("[[route]]", spec.index("radius"))
    spec = spec[:first] + spec[spec.index("[[route]]", first + 1) :]
    spec = spec.replace("[0, -5, 0]", "[0, -6, 0]").replace(
        'kind = "pulley"', f'kind = "winch"\npayout = "{-5 * sense}*TIME"'
    )
    found = [each.message for each in deck(spec)[1] if each.code == "runs-into-wheel"]
    assert [each.split(":")[0] for each in found] == (
        ["the weight of station 3 runs into the wheel of station 2 at TIME = 0.8"]
        if sense > 0 else []
    )  # fmt: skip


def test_a_collision_is_seen_though_the_last_row_has_passed_it() -> None:
    """The span of station 4 loses 60 mm a row; behind the wheel its place is any."""
    spec = setting(ATWOOD).spec
    weight, wheel = (np.array(spec.route[i].at) for i in (3, 2))
    spans = np.array([0.15, 0.09, 0.03])
    tall = np.append(-np.hypot(spans, spec.route[2].radius), 240.0)
    names = [f"POINT_MASS/{spec.marker(3)}.{axis}" for axis in "xyz"]
    places = np.array([np.full(4, wheel[0]), wheel[1] + tall, np.full(4, weight[2])])
    run = Series(np.array([0.0, 0.1, 0.2, 0.3]), dict(zip(names, places, strict=True)))
    assert "station 4 runs into the wheel of station 3 at TIME = 0.25" in collision(spec, run)
    still = {**run.columns, names[1]: np.full(4, wheel[1] - 1.0)}
    assert not collision(spec, Series(run.time, still))

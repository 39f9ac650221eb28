"""Derivatives of runs by numbers of their decks, against closed forms.

Values are off by what the run itself is off by; ERROR is small where digits are asked for.
"""

from __future__ import annotations

import numpy as np
import pytest
from unfinished_scenes import pendulum

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.sensitivity import study
from adamslite.sensitivity.recipes import Known
from adamslite.sensitivity.study import Study

SPRING = """m x'' = -k (x - 1) - c x', let go at x = 2 at rest
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=2,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=8, C=0.4, LENGTH=1
VARIABLE/unused, FUNCTION=3
REQUEST/1, F2=DX(2,1)**2
END
"""
MASS, STIFFNESS, DAMPING = 2.0, 8.0, 0.4
RUN = {"end": 3.0, "steps": 60, "error": 1e-10}


def motion(t: np.ndarray, m: float, k: float, c: float, x0: float = 2.0) -> np.ndarray:
    """x(t) of the deck above."""
    decay, w = c / (2 * m), np.sqrt(k / m - (c / (2 * m)) ** 2)
    return 1 + (x0 - 1) * np.exp(-decay * t) * (np.cos(w * t) + decay / w * np.sin(w * t))


def by_complex_step(function, *numbers: complex, at: int) -> np.ndarray:
    """The derivative of an analytic function by one of its numbers."""
    given = [complex(each) for each in numbers]
    given[at] += 1e-30j
    return function(*given).imag / 1e-30


def spring_slopes(t: np.ndarray) -> dict[str, np.ndarray]:
    """dx/dp of the deck above."""
    numbers = (MASS, STIFFNESS, DAMPING, 2.0)
    names = ("POINT_MASS/2.MASS", "SPRINGDAMPER/1.K", "SPRINGDAMPER/1.C", "POINT_MASS/2.QG[0]")
    return {
        name: by_complex_step(lambda *p: motion(t, *p), *numbers, at=k)
        for k, name in enumerate(names)
    }


@pytest.mark.parametrize("form", ["I3", "SI2"])
def test_a_mass_on_a_spring_and_a_damper(form):
    found = al.sensitivities(SPRING, spring_slopes(np.zeros(1)), formulation=form, **RUN)
    for name, slopes in spring_slopes(found.time).items():
        gap = np.abs(found.curve("POINT_MASS/2.x", name) - slopes).max()
        assert gap <= 1e-6 * np.abs(slopes).max(), name


def test_measures_are_those_of_histories():
    """F2 = x^2, so that d max F2 = 2 x dx where x is largest."""
    names = ["SPRINGDAMPER/1.K", "POINT_MASS/2.QG[0]"]
    measures = ["min REQUEST/1.F2", "POINT_MASS/2.x@end", "mean POINT_MASS/2.x"]
    found = al.sensitivities(SPRING, names, measures, **RUN)
    x = motion(found.time, MASS, STIFFNESS, DAMPING)
    for name in names:
        slopes = spring_slopes(found.time)[name]
        least = (x**2).argmin()
        expected = [
            2 * x[least] * slopes[least],
            slopes[-1],
            np.trapezoid(slopes, found.time) / found.time[-1],
        ]
        assert [found[measure, name] for measure in measures] == pytest.approx(expected, rel=1e-6)


def test_a_number_that_nothing_uses_has_zeros_and_a_word():
    found = al.sensitivities(SPRING, ["unused"], ["POINT_MASS/2.x@end"], **RUN)
    assert found.gradient == [[0.0]]
    assert "no equation" in found.notes["VARIABLE/unused.FUNCTION"]


@pytest.mark.parametrize(
    ("by", "of", "options", "words"),
    [
        ("SPRINGDAMPER/1.KT", "POINT_MASS/2.x@end", {}, "there is no number"),
        ("SPRINGDAMPER/1.K", "POINT_MASS/2.q@end", {}, "did you mean"),
        ("SPRINGDAMPER/1.K", "most POINT_MASS/2.x", {}, "a measure is a word"),
        ("SPRINGDAMPER/1.K", "maxtime POINT_MASS/2.x", {}, "has no derivative"),
        ("SPRINGDAMPER/1.K", "POINT_MASS/2.x@soon", {}, "behind @"),
        ("SPRINGDAMPER/1.K", "POINT_MASS/2.x@9", {}, "from 0 to 3"),
        ("REQUEST/1.F2", "POINT_MASS/2.x@end", {}, "decides a form"),
        ("SPRINGDAMPER/1.K", "POINT_MASS/2.x@end", {"integrator": "ABAM"}, "ABAM"),
    ],
)
def test_mistakes_are_told(by, of, options, words):
    with pytest.raises(UsageError, match=words):
        al.sensitivities(SPRING, [by], [of], **RUN, **options)


HHT = SPRING.replace("END\n", "INTEGRATOR/HHT\nEND\n")


def test_a_deck_whose_method_has_no_derivatives_runs_by_another_and_says_so(capsys, tmp_path):
    """What `cable` writes asks for HHT."""
    of, by = ["POINT_MASS/2.x@end"], ["SPRINGDAMPER/1.K"]
    expected = al.sensitivities(SPRING, by, of, integrator="GSTIFF", **RUN)
    for found in (al.sensitivities(HHT, by, of, **RUN), al.gradient(HHT, of, by, **RUN)):
        assert found.gradient == pytest.approx(expected.gradient, rel=1e-6)
        assert found.notes == {
            "integrator": "HHT, which the deck asks for, has no derivatives: values and "
            "derivatives are those of a run by GSTIFF"
        }
    assert al.sensitivities(HHT, by, of, integrator="RADAU", **RUN).notes == {}
    with pytest.raises(UsageError, match="GSTIFF and RADAU; HHT is none of them: ask for one"):
        al.sensitivities(HHT, by, of, integrator="HHT", **RUN)
    (tmp_path / "hht.adm").write_text(HHT)
    words = ["sens", str(tmp_path / "hht.adm"), "--by", *by, "--of", *of, "--end", "3"]
    assert main([*words, "--steps", "30"]) == 0
    assert "integrator: HHT, which the deck asks for" in capsys.readouterr().err


ROPE = """ten masses on a stiff rope, of which one starts a little off
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
MARKER/2, POINT_MASS=2
POINT_MASS/3, MASS=1, CM=3, QG=2,0,0
MARKER/3, POINT_MASS=3
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=1E6, LENGTH=1
SPRINGDAMPER/2, TRANSLATIONAL, I=3, J=2, K=1E6, LENGTH=1
VFORCE/1, I=3, JFLOAT=4, RM=1, FX=0\\FY=SIN(TIME)\\FZ=0
MARKER/4, PART=1, FLOATING
END
"""


def test_a_vibration_that_the_steps_of_the_run_do_not_resolve_is_told():
    """A length sets the rope off; the run itself is quiet, and its steps are long."""
    asked = ["SPRINGDAMPER/1.LENGTH"], ["POINT_MASS/3.x"]
    coarse = al.sensitivities(ROPE, *asked, end=1.0, steps=10, error=1e-4)
    assert coarse.errors[0] > study.DOUBTFUL
    assert "coarse" in coarse.notes["SPRINGDAMPER/1.LENGTH"]
    fine = al.sensitivities(SPRING, ["SPRINGDAMPER/1.K"], ["POINT_MASS/2.x"], **RUN)
    assert fine.errors[0] < 1e-7
    assert not fine.notes


@pytest.mark.parametrize("method", ["GSTIFF", "RADAU"])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8])
def test_estimates_are_what_derivatives_are_off_by(method, tolerance):
    """By the stiffness and the damping of a vibration: not less, and not beyond all measure."""
    by, run = ["SPRINGDAMPER/1.K", "SPRINGDAMPER/1.C"], {**RUN, "end": 20.0, "error": tolerance}
    found = al.sensitivities(SPRING, by, ["POINT_MASS/2.x"], integrator=method, **run)
    expected = spring_slopes(found.time)
    for estimate, name in zip(found.errors, by, strict=True):
        gap = np.abs(found.curve("POINT_MASS/2.x", name) - expected[name]).max()
        actual = gap / np.abs(expected[name]).max()
        assert actual <= estimate <= 400.0 * actual + 100.0 * tolerance


@pytest.mark.parametrize("method", ["GSTIFF", "RADAU"])
def test_what_moves_nothing_is_not_called_coarse(method):
    """Of a mass that a motion moves only reactions hang on it: places have derivatives of
    round-off.
    """
    deck = """a mass that is moved
PART/1, GROUND
MARKER/1, PART=1, REULER=0,90D,0
PART/2, MASS=2, CM=2, IP=1,1,1
MARKER/2, PART=2, REULER=0,90D,0
JOINT/1, TRANSLATIONAL, I=2, J=1
MOTION/1, JOINT=1, FUNCTION=SIN(3*TIME)
END
"""
    found = al.sensitivities(deck, ["PART/2.MASS"], end=2.0, steps=20, integrator=method)
    assert found.errors[0] < study.DOUBTFUL
    assert not found.notes


def test_a_number_of_a_table_is_told():
    deck = """a spring by a table
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=2,0,0
MARKER/2, POINT_MASS=2
SPLINE/1, X=0,1,2,3, Y=3,1,-1,-4
VFORCE/1, I=2, JFLOAT=4, RM=1, FX=AKISPL(DX(2,1),0,1)\\FY=0\\FZ=0
MARKER/4, PART=1, FLOATING
END
"""
    with pytest.raises(UsageError, match="number of a table"):
        al.sensitivities(deck, ["SPLINE/1.Y[1]"], ["POINT_MASS/2.x"], end=1.0, steps=10)


def test_angles_of_parts_and_other_values_of_a_deck_that_was_varied():
    """A part turns about z at 2 rad/s: psi = 2 t, and of a deck with other numbers alike."""
    deck = al.read(
        "a part that turns\nPART/1, GROUND\nMARKER/1, PART=1\n"
        "PART/2, MASS=1, CM=2, IP=1,1,1, WZ=2\nMARKER/2, PART=2\n"
        "JOINT/1, REVOLUTE, I=2, J=1\nEND\n"
    )
    for speed in (2.0, 5.0):
        varied = deck.with_values({"PART/2.WZ": speed})
        found = al.sensitivities(varied, ["PART/2.WZ"], ["PART/2.psi"], end=1.0, steps=4)
        assert found.at == [speed]
        assert found.curve("PART/2.psi", "PART/2.WZ") == pytest.approx(found.time, abs=1e-9)


#: Two parts turn about z at 2 and 1 rad/s, and one number pushes both, the first one by a share.
PUSHED = """two parts that one number turns
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1, WZ=2
MARKER/2, PART=2
SFORCE/2, ROTATION, I=2, J=1, ACTIONONLY, FUNCTION={share}*VARVAL(1)
PART/3, MASS=1, CM=3, IP=1,1,1, WZ=1, QG=5,0,0
MARKER/3, PART=3
SFORCE/3, ROTATION, I=3, J=1, ACTIONONLY, FUNCTION=VARVAL(1)
VARIABLE/1, FUNCTION=1
END
"""


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("share", ["1", "1E-9", "1E-13", "1E-313"])
def test_angles_of_a_part_that_hardly_turns_beside_one_that_does(share):
    """psi'' is the push: d psi is the share of t^2/2, of whatever size, subnormal numbers too."""
    found = al.sensitivities(
        PUSHED.format(share=share), ["VARIABLE/1.FUNCTION"], ["PART/2.psi", "PART/3.psi"],
        end=1.0, steps=4, error=1e-8,
    )  # fmt: skip
    first, second = (found.curve(f"PART/{k}.psi", "VARIABLE/1.FUNCTION") for k in (2, 3))
    assert second == pytest.approx(found.time**2 / 2, rel=1e-6)
    assert first == pytest.approx(float(share) * found.time**2 / 2, rel=1e-4, abs=0.0)


@pytest.mark.filterwarnings("error")
def test_angles_of_parts_that_a_push_reaches_later():
    """What a shaft of soft springs hands on becomes the least number there is, and then none."""
    parts = "".join(
        f"PART/{k}, MASS=1, CM={k}, IP=1,1,1, QG={k},0,0, REULER=0.5,0,0\nMARKER/{k}, PART={k}\n"
        for k in range(2, 42)
    )
    springs = "".join(
        f"SFORCE/{k}, ROTATION, I={k}, J={k - 1}, FUNCTION=-1E-6*AZ({k},{k - 1})\n"
        for k in range(3, 42)
    )
    text = (
        f"a shaft\nPART/1, GROUND\nMARKER/1, PART=1\n{parts}{springs}"
        "SFORCE/2, ROTATION, I=2, J=1, ACTIONONLY, FUNCTION=VARVAL(1)\n"
        "VARIABLE/1, FUNCTION=1\nEND\n"
    )
    names = [f"PART/{k}.psi" for k in range(2, 42)]
    found = al.sensitivities(text, ["VARIABLE/1.FUNCTION"], names, end=1.0, steps=20)
    ends = np.array([found.curve(name, "VARIABLE/1.FUNCTION")[-1] for name in names])
    assert ends[0] == pytest.approx(0.5, rel=1e-3)
    reached = np.count_nonzero(ends)
    assert (np.diff(ends[:reached]) < 0.0).all() and (ends[:reached] > 0.0).all()
    assert 0.0 < ends[reached - 1] < np.finfo(float).tiny


def test_the_command_prints_a_table_and_writes_histories(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "spring.adm").write_text(SPRING)
    words = ["sens", "spring.adm", "--end", "3", "--steps", "60", "--error", "1e-8"]
    words += ["--by", "SPRINGDAMPER/1.K", "unused", "-o", "x.csv"]
    assert main([*words, "--of", "POINT_MASS/2.x@end"]) == 0
    printed = capsys.readouterr()
    found = al.sensitivities(SPRING, ["SPRINGDAMPER/1.K"], ["POINT_MASS/2.x@end"], **RUN)
    assert f"{found.gradient[0, 0]:.10f}"[:8] in printed.out
    assert "no equation" in printed.err
    written = al.Results.load("x.csv")["POINT_MASS/2.x by SPRINGDAMPER/1.K"]
    slopes = found.curve("POINT_MASS/2.x", "SPRINGDAMPER/1.K")
    assert np.abs(written - slopes).max() <= 1e-6
    assert main([*words, "--of", "POINT_MASS/2.q"]) == 2
    assert "did you mean" in capsys.readouterr().err


def test_a_number_that_is_known_has_the_same_derivatives_without_setting_up(monkeypatch):
    """Recipes give what a number does as setting up does: of a quotient, a product, a difference,
    of a mass and of a parameter of an element.
    """
    text = SPRING.replace("VARIABLE/unused, FUNCTION=3\n", "").replace(
        "REQUEST/1, F2=DX(2,1)**2\n",
        "VFORCE/1, I=2, JFLOAT=3, RM=1, FX=3/4*DX(2,1)-(2*5-7)*VX(2,1)\\FY=0\\FZ=0\n"
        "MARKER/3, PART=1, FLOATING\n",
    )
    names = ["SPRINGDAMPER/1.K", "POINT_MASS/2.MASS", *(f"VFORCE/1.FX[{k}]" for k in range(5))]
    deck = al.read(text)
    with monkeypatch.context() as patch:
        patch.setattr(Known, "is_known", lambda *_: False)
        slowly = al.sensitivities(deck, names, ["POINT_MASS/2.x@end"], **RUN)
    quickly = al.sensitivities(deck, names, ["POINT_MASS/2.x@end"], **RUN)
    assert np.abs(slowly.gradient).min() > 0.0
    assert quickly.gradient == pytest.approx(slowly.gradient, rel=1e-9)
    monkeypatch.setattr(Study, "snapshot", lambda *_: pytest.fail("the model is set up again"))
    again = al.sensitivities(deck, names, ["POINT_MASS/2.x@end"], **RUN)
    assert np.array_equal(again.gradient, quickly.gradient)


def test_a_run_with_derivatives_reports_how_far_it_is() -> None:
    times: list[float] = []
    al.sensitivities(
        al.read(pendulum(400, 4000)), ["PART/2.MASS"], ["final PART/2.x"], integrator="GSTIFF",
        error=1e-7, progress=lambda time, end: times.append(time),
    )  # fmt: skip
    assert times and times == sorted(times) and 0.0 < times[0] < 400.0

"""`.res` in XML as it is written: names and words of ADAMS, parts by their origin."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from adams_decks import FREE, MACHINE

import adamslite
from adamslite.errors import UsageError
from adamslite.outputs.xrf import rounded
from adamslite.results.results import Results
from adamslite.results.run_texts import CLOCKED

SPIN, SPEED = 2.0, 3.0
NAMESPACE = "{http://www.mscsoftware.com/:xrf10}"


def numbers(path: Path) -> dict[str, np.ndarray]:
    """Histories by entity and component of an XML file, taken apart independently."""
    root = ElementTree.parse(path).getroot()
    found = {
        int(component.get("id")): f"{entity.get('name')}.{component.get('name')}"
        for entity in root.iter(f"{NAMESPACE}Entity")
        for component in entity
    }
    rows = [[float(x) for x in step.text.split()] for step in root.iter(f"{NAMESPACE}Step")]
    return {found[k]: np.array(rows)[:, n] for n, k in enumerate(sorted(found))}


def attitude(psi: float, theta: float, phi: float) -> np.ndarray:
    def about_z(a: float) -> np.ndarray:
        return np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])

    about_x = np.array(
        [[1, 0, 0], [0, np.cos(theta), -np.sin(theta)], [0, np.sin(theta), np.cos(theta)]]
    )
    return about_z(psi) @ about_x @ about_z(phi)


def test_parts_are_written_by_their_origin_and_axes(tmp_path: Path) -> None:
    """A ball (equal moments) turns at w about z and moves at v along x:

        R = Rz(w t) R_0,  x_cm = x_0 + R_0 r + v t,  x = x_cm - R r,
        vel = v - w x R r,  acc = w^2 (R r, without z)

    to the 1e-7 that ERROR=1E-9 leaves.
    """
    adamslite.simulate(adamslite.read(FREE)).save(tmp_path / "a.res")
    found, start, r = numbers(tmp_path / "a.res"), attitude(0.3, 0.8, -0.4), [0.5, -0.2, 0.1]
    for n, t in enumerate(found["time.TIME"]):
        turned = attitude(SPIN * t, 0, 0) @ start
        arm, v = turned @ r, np.array([SPEED, 0, 0])
        place = np.array([1, 2, 3]) + start @ r + v * t - arm
        speed = v - np.cross([0, 0, SPIN], arm)
        acceleration = SPIN**2 * arm * [1, 1, 0]
        for words, expected in (("X Y Z", place), ("VX VY VZ", speed),
                                ("ACCX ACCY ACCZ", acceleration), ("WX WY WZ", [0, 0, SPIN]),
                                ("WDX WDY WDZ", [0, 0, 0])):  # fmt: skip
            got = [found[f"the ball_XFORM.{word}"][n] for word in words.split()]
            assert got == pytest.approx(expected, abs=1e-6), (words, t)
        angles = [found[f"the ball_XFORM.{word}"][n] for word in ("PSI", "THETA", "PHI")]
        assert attitude(*angles) == pytest.approx(turned, abs=1e-7)


def test_a_deck_without_units(tmp_path: Path) -> None:
    """Its file names none: "as in the deck", which a table says, are no units."""
    deck = FREE.replace("UNITS", "!UNITS")
    assert deck != FREE
    whole = adamslite.simulate(adamslite.read(deck))
    whole.save(tmp_path / "a.res")
    root = ElementTree.parse(tmp_path / "a.res").getroot()
    units = root.find(f".//{NAMESPACE}Units").attrib
    assert {units[kind] for kind in ("length", "mass", "time")} == {""}
    named = {each.get("unitsValue") for each in root.iter(f"{NAMESPACE}Component")}
    assert named == {None, "rad"}
    read = Results.load(tmp_path / "a.res")
    np.testing.assert_allclose(read.values, whole.values, atol=1e-9)
    assert read.unit_symbols == {} and read.names == whole.names


def test_what_is_written_is_read_back_in_terms_of_the_results(tmp_path: Path) -> None:
    """Forces along a line, about z and action-only, names with quotes, a name left out by CNAMES;
    to the round-off of the way there and back."""
    run = adamslite.simulate(adamslite.read(MACHINE))
    run.save(tmp_path / "a.res")
    again = Results.load(tmp_path / "a.res")
    assert again.names == run.names and again.source == run.source
    counters = {name: each for name, each in run.summary.items() if name not in CLOCKED}
    assert again.meta == run.meta and again.summary == counters
    assert again.values == pytest.approx(run.values, abs=1e-11)
    assert again.time.tolist() == run.time.tolist()
    assert again.channel("PART/2.vx").unit == "m/s"


def test_control_characters_of_a_title_harm_no_file(tmp_path: Path) -> None:
    deck = adamslite.read(MACHINE.replace("ä & <b>", "\x0c\x01 Größe\x85 ]]>"))
    run = adamslite.simulate(deck)
    for suffix in (".res", ".req"):
        run.save(tmp_path / f"a{suffix}")
        assert Results.load(tmp_path / f"a{suffix}").time.size == 5
    assert "Größe" in Results.load(tmp_path / "a.req").meta["deck"]
    assert Results.load(tmp_path / "a.res").source == run.source


def test_a_part_that_is_almost_aligned_comes_back(tmp_path: Path) -> None:
    """A thousand lengths from the origin to the centre of mass show a turn of 1e-8."""
    deck = FREE.replace("REULER=0.3,0.8,-0.4", "REULER=0.3,1E-8,-0.4").replace(", WM=1, WZ=2", "")
    deck = deck.replace("QP=0.5,-0.2,0.1, REULER=0.4,0.5,0.6", "QP=1000,0,0")
    run = adamslite.simulate(adamslite.read(deck))
    run.save(tmp_path / "a.res")
    again = Results.load(tmp_path / "a.res")
    for name in ("PART/2.x", "PART/2.y", "PART/2.z"):
        assert again[name] == pytest.approx(run[name], abs=1e-11)


def test_entities_have_the_names_and_words_of_adams(tmp_path: Path) -> None:
    adamslite.simulate(adamslite.read(MACHINE)).save(tmp_path / "a.res")
    root = ElementTree.parse(tmp_path / "a.res").getroot()
    entities = {e.get("name"): e for e in root.iter(f"{NAMESPACE}Entity")}
    assert list(entities)[:3] == ["time", 'arm "A"_XFORM', "POINT_MASS_4_XFORM"]
    assert entities["JOINT_1"].attrib == {
        "name": "JOINT_1", "entity": "JOINT_1", "entType": "Joint", "objectId": "1",
    }  # fmt: skip
    kinds = {name: each.get("entType") for name, each in entities.items()}
    assert kinds["SFORCE_1"] == "Single_Component_Force" and kinds["VARIABLE_9"] == "ADAMS_Variable"
    assert [c.get("name") for c in entities["clock"]] == ["zeit", "doppelt"]
    units = {c.get("name"): c.get("unitsValue") for c in entities["JOINT_1"]}
    assert units["FX"] == "newton" and units["TX"] == "newton-meter"
    units = {c.get("name"): c.get("unitsValue") for c in entities['arm "A"_XFORM']}
    assert units["ACCX"] == "meter/sec**2" and units["WX"] == "rad/sec"
    title = next(root.iter(f"{NAMESPACE}ModelInfo")).get("title")
    assert title == "everything that is written: ä & <b>"
    kinds = [data.get("name") for data in root.iter(f"{NAMESPACE}Data")]
    assert kinds == ["initialConditions_001", "dynamic_001"]


def test_single_component_forces_are_vectors_on_i(tmp_path: Path) -> None:
    """SFORCE/1 pulls the point mass to the marker at (0, 0, 0.2) by 20 per length."""
    run = adamslite.simulate(adamslite.read(MACHINE))
    run.save(tmp_path / "a.res")
    found = numbers(tmp_path / "a.res")
    for axis, at in (("x", 0.0), ("y", 0.0), ("z", 0.2)):
        expected = -20.0 * (run[f"POINT_MASS/4.{axis}"] - at)
        assert found[f"SFORCE_1.F{axis.upper()}"] == pytest.approx(expected, abs=1e-12)
    assert not found["SFORCE_1.TZ"].any() and not found["SFORCE_2.FX"].any()
    assert found["SFORCE_2.TZ"] == pytest.approx(run["SFORCE/2.f"])


@pytest.mark.parametrize(
    ("words", "gone"),
    [
        ("NODISPLACEMENTS", ("ball_XFORM.X", "ball_XFORM.PHI")),
        ("NOVEL", ("ball_XFORM.VX", "ball_XFORM.WZ")),
        ("NOACCELERATIONS", ("ball_XFORM.ACCX", "ball_XFORM.WDZ")),
        ("NOREQUESTS", ("REQUST_1.mag",)),
        ("NOSYSTEMELEMENTS", ("VARIABLE_1.Q",)),
        ("NOAPPLIEDFORCES", ("SFORCE_1.FX",)),
    ],
)
def test_words_of_results_leave_groups_out(words: str, gone: tuple[str], tmp_path: Path) -> None:
    more = (
        "REQUEST/1, DISPLACEMENT, I=2\nVARIABLE/1, FUNCTION=TIME\nSFORCE/1, I=2, J=1, FUNCTION=1\n"
    )
    for name, extra in (("a", more), ("b", f"{more}RESULTS/XRF, {words}\n")):
        deck = adamslite.read(FREE.replace("INTEGRATOR", f"{extra}INTEGRATOR"))
        adamslite.simulate(deck, end=0.1, steps=1).save(tmp_path / f"{name}.res")
    whole, less = numbers(tmp_path / "a.res"), numbers(tmp_path / "b.res")
    left_out = set(whole) - set(less)
    assert all(any(name.endswith(each) for name in left_out) for each in gone)
    assert len({name.partition(".")[0] for name in left_out}) == 1
    assert Results.load(tmp_path / "b.res").time.size == 2


def test_decimalplaces_rounds_as_adams_does(tmp_path: Path) -> None:
    """Digits after the point; of numbers below 1e-4 after that of the mantissa."""
    numbers_ = np.array([1.23456789, -386.0885827, 0.00123456, 4.3456789e-6, 0.0, 1e30])
    assert rounded(numbers_, 3).tolist() == [1.235, -386.089, 0.001, 4.346e-6, 0.0, 1e30]
    assert rounded(numbers_, 17) is numbers_
    deck = FREE.replace("INTEGRATOR", "RESULTS/XRF, DECIMALPLACES=4\nINTEGRATOR")
    adamslite.simulate(adamslite.read(deck)).save(tmp_path / "a.res")
    text = (
        (tmp_path / "a.res").read_text(encoding="utf-8").partition("<Data")[2].partition("<Term")[0]
    )
    assert "3.0 " in text and not any(
        len(w.partition(".")[2]) > 4 for w in text.split() if "e" not in w
    )


def test_a_res_needs_the_deck(tmp_path: Path) -> None:
    table = Results(time=np.zeros(1), names=("PART/2.x",), values=np.ones((1, 1)))
    for suffix in (".res", ".req"):
        with pytest.raises(UsageError, match="results that know their deck"):
            table.save(tmp_path / f"a{suffix}")
        assert not (tmp_path / f"a{suffix}").exists()


def test_limited_columns_leave_a_part_out_and_say_so(tmp_path: Path) -> None:
    some = adamslite.simulate(
        adamslite.read(MACHINE), outputs=["PART/2.x", "VARIABLE/9", "SFORCE/1"]
    )
    some.save(tmp_path / "a.res")
    assert set(numbers(tmp_path / "a.res")) == {"time.TIME", "VARIABLE_9.Q"}
    assert "left out, as the results are limited to a few columns: PART/2, SFORCE/1" in (
        tmp_path / "a.res"
    ).read_text(encoding="utf-8")


def test_a_res_without_anything_in_it_is_not_written(tmp_path: Path) -> None:
    some = adamslite.simulate(MACHINE, outputs=["PART/2.x"])
    with pytest.raises(UsageError, match="would be empty: PART/2 need more columns"):
        some.save(tmp_path / "a.res")
    assert not (tmp_path / "a.res").exists()

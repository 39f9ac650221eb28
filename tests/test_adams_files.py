"""Files of ADAMS: `.res` in XML and in text, `.req`; written, read and compared."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import adamslite
from adamslite.cli.main import main
from adamslite.errors import FormatError, UsageError
from adamslite.outputs.xrf import rounded
from adamslite.results.common_terms import in_common_terms
from adamslite.results.comparison import Tolerance, compare
from adamslite.results.results import Results

SPIN, SPEED = 2.0, 3.0
MACHINE = """\
everything that is written: ä & <b>
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1, QP=0,0,0.2
! adams_view_name='arm "A"'
PART/2, MASS=2, CM=2, IP=0.1,0.2,0.3, QG=0.5,0,0.2, REULER=0.3,0.2,0.1
MARKER/2, PART=2, QP=0.1,0.2,0.3, REULER=0.1,0.7,0.2
MARKER/3, PART=2, QP=-0.5,0,0
MARKER/30, PART=1, QP=0.5,0,0.2
JOINT/1, SPHERICAL, I=32, J=33
MARKER/32, PART=2
MARKER/33, PART=1, QP=0.5,0,0.2
POINT_MASS/4, MASS=1, CM=4, QG=1,1,0
MARKER/4, POINT_MASS=4
SFORCE/1, TRANSLATION, I=4, J=1, FUNCTION=-20*DM(4,1)
SFORCE/2, ROTATION, I=2, J=1, FUNCTION=-WZ(2,1)
SFORCE/3, TRANSLATION, ACTIONONLY, I=2, J=3, FUNCTION=0.3*TIME
SPRINGDAMPER/7, TRANSLATIONAL, I=4, J=3, K=10, C=1, LENGTH=1
VARIABLE/9, FUNCTION=DM(4,1)
REQUEST/1, DISPLACEMENT, I=2, J=1, COMMENT=the arm
REQUEST/2, F2=TIME\\ F3=2*TIME, CNAMES="","zeit","doppelt", RESULTS_NAME=clock
REQUEST/3, F1=TIME\\ F6=TIME
SIMULATE/DYNAMIC, END=0.4, STEPS=4
END
"""
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


# ---- parts by their origin -----------------------------------------------------------------------

FREE = """\
a ball that spins freely about z of ground, off its origin
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
! adams_view_name='the ball'
PART/2, MASS=2, CM=2, IP=1,1,1, QG=1,2,3, REULER=0.3,0.8,-0.4, VX=3, WM=1, WZ=2
MARKER/2, PART=2, QP=0.5,-0.2,0.1, REULER=0.4,0.5,0.6
INTEGRATOR/GSTIFF, ERROR=1E-9
SIMULATE/DYNAMIC, END=1, STEPS=4
END
"""


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


def test_what_is_written_is_read_back_in_terms_of_the_results(tmp_path: Path) -> None:
    """Forces along a line, about z and action-only, names with quotes, a name left out by CNAMES;
    to the round-off of the way there and back."""
    run = adamslite.simulate(adamslite.read(MACHINE))
    run.save(tmp_path / "a.res")
    again = Results.load(tmp_path / "a.res")
    assert again.names == run.names and again.source == run.source
    assert again.meta == run.meta and again.summary == run.summary
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


# ---- what ADAMS writes ---------------------------------------------------------------------------

OF_ADAMS = """\
<?xml version="1.0" encoding="UTF-8"?>
<Results xmlns="http://www.mscsoftware.com/:xrf10">
<Analysis name="A1" executionDate="2020-01-01 00:00:00" Solver="Adams 2017  Adams Solver (C++)">
<ModelInfo title="a falling part" creationDate="-unknown-" checksum="-unknown-" />
<Units angle="deg" length="mm" mass="kg" time="sec" />
<StepMap name="map_001">
<Entity name="time">
<Component name="TIME" unitsValue="sec" id="1" />
</Entity>
<Entity name="LOAD" entity="LOAD" entType="ADAMS_Variable" objectId="7">
<Component name="Q" id="56" />
</Entity>
<Entity name="stone_XFORM" entity="stone" entType="Part" objectId="2">
<Component name="X" unitsValue="mm" id="2" />
<Component name="Y" unitsValue="mm" id="3" />
<Component name="Z" unitsValue="mm" id="4" />
<Component name="PSI" unitsValue="deg" id="5" />
<Component name="THETA" unitsValue="deg" id="6" />
<Component name="PHI" unitsValue="deg" id="7" />
<Component name="VX" unitsValue="mm/sec" id="14" />
<Component name="VY" unitsValue="mm/sec" id="15" />
<Component name="VZ" unitsValue="mm/sec" id="16" />
<Component name="WX" unitsValue="deg/sec" id="17" />
<Component name="WY" unitsValue="deg/sec" id="18" />
<Component name="WZ" unitsValue="deg/sec" id="19" />
</Entity>
<Entity name="ctrl_poutput" entity="ctrl" entType="Plant_Output" objectId="1">
<Component name="OUT1" id="57" />
</Entity>
</StepMap>
<Data name="modelInput_001" id="1">
<Step type="input">
0
9 9 9 9 9 9
9 9 9 9 9 9
9 9 9 9 9 9 9
</Step>
</Data>
<Data name="initialConditions_001" id="2">
<Step type="initialConditions">
0
7 7 7 7 7 7
7 7 7 7 7 7 7 7
</Step>
<Step type="initialConditions">
0
{0}
</Step>
</Data>
<Data name="dynamic_001" id="3">
<Step type="dynamic">
0.25
{1}
</Step>
<Step type="dynamic">
0.5
{2}
</Step>
</Data>
<TerminationStatus runTermObject="" runStatus="Successful" />
</Analysis>
</Results>
"""
STONE = """\
a falling part
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1, REULER=90D,0,0, WM=1, WZ=2
MARKER/2, PART=2, QP=0.3,0,0
VARIABLE/7, FUNCTION=2*TIME
INTEGRATOR/GSTIFF, ERROR=1E-9
SIMULATE/DYNAMIC, END=0.5, STEPS=2
END
"""


def falling(t: float) -> str:
    """What ADAMS gives of the stone in mm and degrees: its centre of mass is 300 mm from the origin
    along x of the part, which points at 90 degrees + w t; it falls, the origin circles it.
    """
    angle, arm = np.pi / 2 + 2 * t, 300.0
    x, y = -arm * np.cos(angle), arm - 5000 * t**2 - arm * np.sin(angle)
    vx, vy = arm * 2 * np.sin(angle), -10000 * t - arm * 2 * np.cos(angle)
    psi = (np.degrees(angle) + 180) % 360 - 180
    state = (x, y, 0, psi, 0, 0, vx, vy, 0, 0, 0, np.degrees(2.0), 2 * t, 1)
    return "\n".join(f"{each:.17g}" for each in state)


def stone_res(folder: Path) -> Path:
    path = folder / "adams.res"
    text = OF_ADAMS.replace("{0}", falling(0.0)).replace("{1}", falling(0.25))
    path.write_text(text.replace("{2}", falling(0.5)))
    return path


@pytest.fixture
def folder(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("stone.adm").write_text(STONE)
    stone_res(tmp_path)
    return tmp_path


def test_a_file_of_adams_is_read(folder: Path) -> None:
    """Ids that skip and are in no order in the map, degrees, the raw input and the first of two
    initial steps left aside.
    """
    found = Results.load("adams.res")
    assert found.time.tolist() == [0.0, 0.25, 0.5]
    assert found.names[0] == "VARIABLE/7" and found.names[1:7] == tuple(
        f"PART/2.bcs_{name}" for name in ("x", "y", "z", "psi", "theta", "phi")
    )
    assert found["PART/2.bcs_psi"][0] == pytest.approx(np.pi / 2)
    assert found["PART/2.wz"] == pytest.approx([2.0] * 3)
    assert found["VARIABLE/7"].tolist() == [0.0, 0.5, 1.0]
    assert found["POUTPUT/1.out1"].tolist() == [1.0] * 3
    assert found.channel("PART/2.bcs_vx").unit == "mm/s"
    assert found.channel("PART/2.wz").unit == "rad/s"
    assert found.meta == {
        "deck": "a falling part", "written by": "Adams 2017 Adams Solver (C++)",
    }  # fmt: skip


@pytest.mark.parametrize("suffix", [".nc", ".res", ".mat"])
def test_a_run_is_compared_with_what_adams_wrote(folder: Path, suffix: str, capsys) -> None:
    """Origin and centre of mass, degrees and radians, millimetres and metres: to 1e-6."""
    assert main(["solve", "stone.adm", "--quiet", "-o", f"a{suffix}"]) == 0
    assert main(["diff", f"a{suffix}", "adams.res", "--all"]) == 0
    said = capsys.readouterr()
    compared = [line.split()[0] for line in said.out.splitlines()[1:-1]]
    assert {"PART/2.x", "PART/2.psi", "PART/2.vy", "PART/2.wz", "VARIABLE/7"} <= set(compared)
    assert "POUTPUT/1.out1: in the reference alone, not compared" in said.err
    assert "converted to the units of the deck: mm to m, mm/s to m/s" in said.err


def test_steps_of_another_kind_are_left_aside(folder: Path) -> None:
    """Eigenvalues have a map of their own; a step of the motion has to have what the map names."""
    text = Path("adams.res").read_text()
    eigen = '<Data name="eigen_001"><Step type="eigen">1 2 3</Step></Data><TerminationStatus'
    Path("adams.res").write_text(text.replace("<TerminationStatus", eigen))
    assert Results.load("adams.res").time.tolist() == [0.0, 0.25, 0.5]


@pytest.mark.parametrize("name", ["stone", ".hill.stone"])
def test_parts_without_ids_are_found_by_their_names(folder: Path, name: str, capsys) -> None:
    text = Path("adams.res").read_text()
    text = text.replace(' entType="Part" objectId="2"', ' entType="Part"')
    Path("adams.res").write_text(text.replace('entity="stone"', f'entity="{name}"'))
    deck = STONE.replace("PART/2, MASS", "! adams_view_name='stone'\nPART/2, MASS")
    Path("stone.adm").write_text(deck)
    assert main(["solve", "stone.adm", "--quiet", "-o", "a.nc"]) == 0
    assert main(["diff", "a.nc", "adams.res", "--all"]) == 0
    assert "PART/2.x" in capsys.readouterr().out


def test_a_wrong_run_differs_from_what_adams_wrote(folder: Path, capsys) -> None:
    """A centre of mass that is a millimetre elsewhere."""
    Path("stone.adm").write_text(STONE.replace("QP=0.3", "QP=0.301"))
    assert main(["solve", "stone.adm", "--quiet", "-o", "a.nc"]) == 0
    assert main(["diff", "a.nc", "adams.res"]) == 1
    assert "PART/2.vx" in capsys.readouterr().out


def test_the_deck_of_a_table_is_named(folder: Path, capsys) -> None:
    """A .csv does not hold its deck: parts are left out with a word, unless --deck names it."""
    assert main(["solve", "stone.adm", "--quiet"]) == 0
    assert main(["diff", "stone.csv", "adams.res"]) == 0
    said = capsys.readouterr()
    assert "PART/2.bcs_x, PART/2.bcs_y" in said.err and "give the deck by --deck" in said.err
    assert "PART/2.x" not in said.out and "PART/2.wz" in said.out
    assert main(["diff", "stone.csv", "adams.res", "--deck", "stone.adm"]) == 0
    said = capsys.readouterr()
    assert "PART/2.x" in said.out and "bcs" not in said.err
    assert main(["diff", "adams.res", "stone.csv", "--deck", "stone.adm"]) == 0


def test_another_deck_than_that_of_the_file_is_named(folder: Path, capsys) -> None:
    Path("other.adm").write_text(MACHINE.replace("PART/2", "PART/22").replace("PART=2", "PART=22"))
    assert main(["solve", "stone.adm", "--quiet"]) == 0
    assert main(["diff", "stone.csv", "adams.res", "--deck", "other.adm"]) == 0
    said = capsys.readouterr()
    assert "the deck has no such part" in said.err and "PART/2.x" not in said.out


def test_two_files_of_adams_are_compared_as_they_are(folder: Path, capsys) -> None:
    assert main(["diff", "adams.res", "adams.res", "--deck", "stone.adm"]) == 0
    assert "compared, all within" in capsys.readouterr().out


def test_nothing_in_common_is_no_agreement(folder: Path, capsys) -> None:
    Path("b.csv").write_text("time,REQUEST/5.F2\n0,1\n0.25,1\n0.5,1\n")
    assert main(["diff", "b.csv", "adams.res"]) == 1
    assert "no channel in common" in capsys.readouterr().out


def test_rounded_digits_are_no_difference() -> None:
    """A file with four decimals is met by everything that rounds to it, and by nothing else."""
    from adamslite.results.printed import Printed

    exact = np.array([[1.23456], [2.0e-6]])
    names, time = ("VARIABLE/1",), np.array([0.0, 1.0])
    run = Results(time=time, names=names, values=exact)
    printed = Printed(decimals=4)
    written = Results(time=time, names=names, values=rounded(exact, 4), printed=printed)
    assert compare(run, written, Tolerance()).inside
    off = Results(time=time, names=names, values=exact + [[1e-4], [0]])
    assert not compare(off, written, Tolerance()).inside
    small = Results(time=time, names=names, values=exact + [[0], [1e-9]])
    assert not compare(small, written, Tolerance()).inside


def test_whole_turns_and_the_split_of_aligned_angles_are_no_difference() -> None:
    """theta = 0: ADAMS may split a turn of 0.3 as 0.1 + 0.2, or as 0.3 + 2 pi."""
    names = ("PART/2.psi", "PART/2.theta", "PART/2.phi")
    ours = Results(time=np.zeros(1), names=names, values=np.array([[0.3, 0.0, 0.0]]))
    for values in ([0.1, 0.0, 0.2], [0.3 + 2 * np.pi, 1e-9, 0.0], [-0.7, 0.0, 1.0]):
        meta = {"written by": "ADAMS"}
        theirs = Results(time=np.zeros(1), names=names, values=np.array([values]), meta=meta)
        common = in_common_terms(ours, theirs)
        assert compare(common.results, common.reference, Tolerance(abs=1e-8)).inside, values


def test_units_are_converted_between_any_two_results(tmp_path, monkeypatch, capsys) -> None:
    """The same pendulum in metres and in millimetres; a number of unknown unit is named."""
    monkeypatch.chdir(tmp_path)
    mks = FREE.replace("INTEGRATOR", "VARIABLE/5, FUNCTION=2*TIME\nINTEGRATOR")
    mm = mks.replace("SYSTEM=MKS", "FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND")
    mm = mm.replace("QG=1,2,3", "QG=1000,2000,3000").replace("VX=3", "VX=3000")
    mm = mm.replace("QP=0.5,-0.2,0.1", "QP=500,-200,100").replace("IP=1,1,1", "IP=1E6,1E6,1E6")
    Path("a.adm").write_text(mks)
    Path("b.adm").write_text(mm)
    for name in "ab":
        assert main(["solve", f"{name}.adm", "--quiet"]) == 0
    assert main(["diff", "a.csv", "b.csv"]) == 0
    said = capsys.readouterr()
    assert "all within" in said.out and "m to mm" in said.err
    assert "VARIABLE/5: of unknown unit, compared as they are" in said.err


# ---- bad and other forms -------------------------------------------------------------------------

BAD = {
    "binary": (b"\x00\x01ADAMS" + bytes(100), "binary form .* RESULTS/FORMATTED, XRF"),
    "a text": (b"time,x\n0,1\n", "no results file of ADAMS"),
    "nothing": (b"", "no results file of ADAMS"),
    "other XML": (b"<html><body/></html>", "names no TIME"),
    "no namespace": (b"<Results><Analysis/></Results>", "not in the namespace"),
    "a bomb": (b"<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>", "declares a document type"),
}


@pytest.mark.parametrize("content", BAD)
def test_what_is_no_results_file_is_one_sentence(content: str, tmp_path: Path, capsys) -> None:
    data, sentence = BAD[content]
    path = tmp_path / "a.res"
    path.write_bytes(data)
    with pytest.raises(FormatError, match=sentence):
        Results.load(path)
    assert main(["diff", str(path), str(path)]) == 5
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize("share", [0.05, 0.3, 0.6, 0.9, 0.98])
def test_xml_that_is_cut_off_is_named(folder: Path, share: float) -> None:
    data = Path("adams.res").read_bytes()
    Path("adams.res").write_bytes(data[: int(share * len(data))])
    with pytest.raises(FormatError, match="adams.res is damaged or cut off"):
        Results.load("adams.res")


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("7 7 7 7 7 7\n7", "7 7 7 7 7\n7", "a step of it has 14 numbers where 15 are named"),
        ("7 7 7 7 7 7\n7", "7 7 x 7 7 7\n7", "damaged"),
        ('id="56"', 'id="-"', "a component of 'LOAD' has no number"),
        ('objectId="7"', 'objectId="7" x', "damaged or cut off"),
        ('name="VY"', 'name="VX"', "'PART/2.bcs_vx' is there twice"),
    ],
)
def test_damage_is_named(folder: Path, old: str, new: str, sentence: str) -> None:
    text = Path("adams.res").read_text()
    Path("adams.res").write_text(text.replace(old, new, 1))
    with pytest.raises(FormatError, match=sentence):
        Results.load("adams.res")


def block(title: str, *lines: str) -> str:
    return "\n".join([f"{title:40}{len(lines) + 1:8}", *lines, "!", ""])


def text_form(times: list[float]) -> str:
    """The older form: a part at (t, 0, 1) that is turned about z by 60 degrees, moving at 1."""
    turned = (np.cos(np.pi / 6), 0.0, 0.0, np.sin(np.pi / 6))
    text = block("FILE TYPE AND SOURCE", "ADAMS RESULTS FILE", "A.RE7")
    text += block("DATA SET TITLE", "a sledge", "")
    text += block("RIGID PARTS MAP", "       1YESYESNO ", f"{5:20}{5:8}{6:8}{6:8}")
    text += block("JOINTS MAP", "       0NO")
    for n, t in enumerate(times):
        place = "".join(f"{each:12.5E}" for each in (t, 0.0, -1.0, *turned))
        speed = "".join(f"{each:12.5E}" for each in (1.0, 0.0, 0.0, 0.0, 0.0, -2.0))
        head = f"{n + 1:8}DYNAMIC"
        text += block("ANALYSIS OUTPUT BLOCK", head, f"{t:12.5E}", "", "", place, speed)
    return text


def test_the_older_text_form_is_read(tmp_path: Path) -> None:
    (tmp_path / "a.res").write_text(text_form([0.0, 0.5]))
    found = Results.load(tmp_path / "a.res")
    assert found.time.tolist() == [0.0, 0.5] and found.meta["deck"] == "a sledge"
    assert found["PART/5.bcs_x"].tolist() == [0.0, 0.5]
    assert found["PART/5.bcs_z"].tolist() == [-1.0, -1.0]
    assert found["PART/5.bcs_psi"] == pytest.approx([np.pi / 3] * 2, abs=1e-5)
    assert found["PART/5.wz"].tolist() == [-2.0, -2.0] and found.printed.digits == 6


@pytest.mark.parametrize("cut", [30, 100, 200, 420])
def test_a_text_form_that_is_cut_off_is_named(tmp_path: Path, cut: int) -> None:
    (tmp_path / "a.res").write_text(text_form([0.0, 0.5])[:-cut])
    with pytest.raises(FormatError, match="damaged or cut off"):
        Results.load(tmp_path / "a.res")


# ---- requests ------------------------------------------------------------------------------------


def test_the_bytes_of_a_request_file(tmp_path: Path) -> None:
    deck = adamslite.read(
        "two requests\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n"
        "PART/1, GROUND\nMARKER/1, PART=1\nPART/2, MASS=1, CM=2, IP=1,1,1, VX=5\nMARKER/2, PART=2\n"
        "REQUEST/7, DISPLACEMENT, I=2, J=1, RM=1\nREQUEST/8, F3=-TIME\n"
        "SIMULATE/DYNAMIC, END=0.5, STEPS=1\nEND\n"
    )
    adamslite.simulate(deck).save(tmp_path / "a.req")
    assert (tmp_path / "a.req").read_bytes().decode() == (
        " A.R3    2000-01-01 00:00:00               0         0  3D\n"
        f"{'two requests':80}\n"
        "    2     MMKGS_N_RACA 1.000000000000000E+03\n"
        "       7       1       2       1       1\n"
        "       8       5       0       0       0\n"
        "   0.00000E+00\n"
        "   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00\n"
        "   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00\n"
        "   5.00000E-01\n"
        "   2.50000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00\n"
        "   0.00000E+00  -5.00000E-01   0.00000E+00   0.00000E+00   0.00000E+00   0.00000E+00\n"
    )


def test_a_request_file_of_adams_without_requests(tmp_path: Path) -> None:
    """As ADAMS 2017 writes it, with the first time twice."""
    (tmp_path / "a.req").write_text(
        " A.R3    2017-12-20 16:18:45               0         0  3D\ntitle\n"
        "    0     MMKGS_N_RACA 1.000000000000000E+03\n   0.00000E+00\n   0.00000E+00\n"
        "   5.00000E-03\n"
    )
    found = Results.load(tmp_path / "a.req")
    assert found.names == () and found.time.tolist() == [0.0, 0.005]


@pytest.mark.parametrize("named", [False, True])
def test_a_name_may_follow_the_entry_of_a_request(tmp_path: Path, named: bool) -> None:
    """RecurDyn writes an entry as one line, MotionSolve as two."""
    names = [" the tip  of it\n", " 5 wheels\n"] if named else ["", ""]
    (tmp_path / "a.req").write_text(
        " A.R3    2017-12-20\ntitle\n 2 MMKGS_N_RACA 1\n"
        f" 5 1 20 30 0\n{names[0]} 9 5 0 0 0\n{names[1]}"
        " 0.5\n 1 2 3 4 5 6\n 7 8 9 10 11 12\n"
    )
    found = Results.load(tmp_path / "a.req")
    assert found.time.tolist() == [0.5]
    assert found["REQUEST/5.F2"].tolist() == [1.0] and found["REQUEST/5.F8"].tolist() == [6.0]
    assert found["REQUEST/9.F6"].tolist() == [10.0]


def test_a_run_is_compared_with_a_request_file(tmp_path, monkeypatch, capsys) -> None:
    """Six digits of numbers and of times (thirds) are no difference; a seventh is not compared."""
    monkeypatch.chdir(tmp_path)
    Path("a.adm").write_text(MACHINE.replace("STEPS=4", "STEPS=3"))
    assert main(["solve", "a.adm", "--quiet", "-o", "a.req"]) == 0
    assert main(["solve", "a.adm", "--quiet", "-o", "a.nc"]) == 0
    assert main(["diff", "a.nc", "a.req", "--tol", "0", "--all"]) == 0
    said = capsys.readouterr()
    assert "REQUEST/1.F6" in said.out and "REQUEST/2.F4" in said.err
    text = Path("a.req").read_text()
    Path("b.req").write_text(text.replace("   8.00000E-01", "   8.00010E-01"))
    assert main(["diff", "a.nc", "b.req", "--tol", "0"]) == 1
    assert "REQUEST/2.F3" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "does not begin with A.R3"),
        ("x\ny\nz\n", "does not begin with A.R3"),
        (" A.R3\ntitle", "does not begin with A.R3"),
        (" A.R3\ntitle\n", "cut off"),
        (" A.R3\ntitle\n 1 M\n", "cut off"),
        (" A.R3\ntitle\n 1 M\n 5 1 2 3 0\n 0.0\n 1 2 3\n", "no multiple of the 7"),
        (" A.R3\ntitle\n 1 M\n 5 1 2 3 0\n 0.0\n 1 2 3 4 5 x\n", "cut off"),
        (" A.R3\ntitle\n 2 M\n 5 1 2 3 0\n 0.0\n 1 2 3 4 5 6\n", "is not that of a REQUEST"),
        (" A.R3\ntitle\n 2 M\n 5 1 2 3 0\n 5 1 2 3 0\n 0.0\n", "have one number"),
        ("\0\0 A.R3", "not a request file in text"),
    ],
)
def test_bad_request_files_are_named(text: str, sentence: str, tmp_path: Path, capsys) -> None:
    (tmp_path / "a.req").write_text(text)
    with pytest.raises(FormatError, match=sentence):
        Results.load(tmp_path / "a.req")
    assert main(["diff", str(tmp_path / "a.req"), str(tmp_path / "a.req")]) == 5
    assert capsys.readouterr().err.count("\n") == 1


# ---- what a deck requests ------------------------------------------------------------------------

ASKING = MACHINE.replace("SIMULATE", "OUTPUT/REQSAVE, GRSAVE\nRESULTS/FORMATTED, XRF\nSIMULATE")


@pytest.fixture
def asking(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("a.adm").write_text(ASKING)
    return tmp_path


def files(folder: Path) -> list[str]:
    return sorted(each.name for each in folder.iterdir() if each.suffix not in (".adm", ".acf"))


def test_output_and_results_of_a_deck_write_their_files(asking: Path, capsys) -> None:
    assert main(["solve", "a.adm"]) == 0
    assert files(asking) == ["a.csv", "a.req", "a.res"]
    said = capsys.readouterr().err
    assert "req of ADAMS         a.req" in said and "res of ADAMS         a.res" in said
    assert "passed over, as it does not change the motion: OUTPUT GRSAVE" in said
    assert main(["diff", "a.csv", "a.res"]) == 0


def test_they_have_the_name_of_the_results(asking: Path) -> None:
    Path("a.acf").write_text("a\nrun7\nSIMULATE/DYNAMIC, END=0.1, STEPS=1\nSTOP\n")
    assert main(["solve", "a.adm", "--quiet"]) == 0
    assert files(asking) == ["run7.csv", "run7.req", "run7.res"]
    assert main(["solve", "a.adm", "--quiet", "-o", "x.nc"]) == 0
    assert main(["solve", "a.adm", "--quiet", "-o", "y.res"]) == 0
    assert {"x.nc", "x.req", "x.res", "y.req", "y.res"} <= set(files(asking))


def test_limited_columns_leave_a_file_out_with_a_word(asking: Path, capsys) -> None:
    assert main(["solve", "a.adm", "--quiet", "--outputs", "PART/2.x"]) == 0
    assert files(asking) == ["a.csv", "a.req"]
    assert "a.res would be empty" in capsys.readouterr().err


def test_commands_request_them_too(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.adm").write_text(MACHINE)
    Path("a.acf").write_text("a\n\nOUTPUT/REQSAVE\nSIMULATE/DYNAMIC, END=0.1, STEPS=1\nSTOP\n")
    assert main(["solve", "a.adm", "--quiet"]) == 0
    assert files(tmp_path) == ["a.csv", "a.req"]


def test_nothing_is_written_beside_standard_output(asking: Path, capsys) -> None:
    assert main(["solve", "a.adm", "--quiet", "-o", "-"]) == 0
    assert files(asking) == [] and capsys.readouterr().out.startswith("# adamslite")


def test_a_file_of_that_name_is_checked_before_the_run(asking: Path, capsys) -> None:
    Path("a.res").mkdir()
    assert main(["solve", "a.adm"]) == 5
    assert "a.res" in capsys.readouterr().err and files(asking) == ["a.res"]


def test_a_file_that_a_command_names_is_not_theirs(asking: Path, capsys) -> None:
    Path("a.acf").write_text(
        "a\n\nSIMULATE/DYNAMIC, END=0.1, STEPS=1\nLINEAR/STATEMAT, FILE=a.res\nSTOP\n"
    )
    assert main(["solve", "a.adm"]) == 3
    assert "a.res" in capsys.readouterr().err and files(asking) == []


# ---- plots, pages, Python ------------------------------------------------------------------------


def test_python_compares_like_the_command(folder: Path) -> None:
    """Units that are converted and channels that cannot be compared are warnings."""
    run = adamslite.simulate("stone.adm")
    with pytest.warns(adamslite.DeckWarning) as said:
        assert adamslite.compare(run, "adams.res").inside
    assert any("mm to m" in str(each.message) for each in said)
    run.save("a.csv")
    with pytest.warns(adamslite.DeckWarning):
        found = adamslite.compare("a.csv", "adams.res", deck="stone.adm")
    assert found.inside and "PART/2.x" in {each.name for each in found}
    with pytest.warns(adamslite.DeckWarning, match="give the deck"):
        found = adamslite.compare("a.csv", "adams.res")
    assert "PART/2.x" not in {each.name for each in found}


def test_what_adams_wrote_is_plotted(folder: Path, capsys) -> None:
    """In the terms of the deck that is named: the centre of mass, in metres."""
    assert main(["plot", "adams.res", "PART/2.y", "--deck", "stone.adm", "-o", "a.svg"]) == 0
    assert "mm to m" in capsys.readouterr().err and Path("a.svg").stat().st_size > 1000
    assert main(["plot", "stone.adm", "PART/2.y", "--against", "adams.res", "-o", "b.svg"]) == 0


def test_a_page_of_what_adams_wrote(folder: Path, capsys) -> None:
    assert main(["view", "adams.res", "--deck", "stone.adm", "-o", "a.html", "--no-open"]) == 0
    page = Path("a.html").read_text(encoding="utf-8")
    assert "PART/2" in page

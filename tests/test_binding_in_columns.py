"""Statements are bound many at once: groups, instances and their order are as if each were bound by
itself.

::

    A row of masses, with forces of several shapes in between
    SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-40*(DM(2,1)-1)      on ground
    SFORCE/2, TRANSLATIONAL, I=3, J=2, FUNCTION=-40*(DM(3,2)-1)      between masses
    SFORCE/3, TRANSLATIONAL, I=4, J=3, FUNCTION=0*(DM(4,3)-1)        a zero is part of the shape
    ...
"""

from pathlib import Path

import pytest

import adamslite as al
from adamslite.kernels import collecting as compiling

DECKS = Path(__file__).parents[1] / "decks"
SOME = [
    "tackle/hoisting.adm", "gear-pair/gear-pair.adm", "friction/friction.adm", "shafts/hooke.adm",
    "cables/crane/free-trolley.adm", "pid-winch/pid-winch.adm", "splines/driven-wheel.adm",
    "delayed-brake/delayed-brake.adm", "slider-crank/driven.adm",
    "transfer-functions/transfer-functions.adm", "bushing/bushing.adm", "andrews/andrews.adm",
]  # fmt: skip


def row(n: int, law: str = "-40*(DM({a},{b})-1)", further: str = "") -> str:
    """A row of masses, each with a force from the one before it."""
    lines = ["A row of masses", "PART/1, GROUND", "MARKER/1, PART=1"]
    for a in range(2, n + 2):
        lines += [f"POINT_MASS/{a}, MASS=1, CM={a}, QG={a - 1},0,0", f"MARKER/{a}, POINT_MASS={a}"]
        function = law.format(a=a, b=a - 1, n=a)
        lines.append(f"SFORCE/{a - 1}, TRANSLATIONAL, I={a}, J={a - 1}, FUNCTION={function}")
    return "\n".join([*lines, further, "END\n"])


def measured_row(n: int) -> str:
    """Forces by VARIABLEs that take the values of others, measured one by one."""
    lines = []
    for k in range(1, n + 1):
        lines += [
            f"VARIABLE/{k}, FUNCTION=VARVAL({k + n})*VARVAL({k + n})-VARVAL({3 * n + 1})",
            f"VARIABLE/{k + n}, FUNCTION={k}.5*DX({k + 1})",
            f"DIFF/{k}, IC=0, FUNCTION=VARVAL({k})*DIF({k})",
            f"REQUEST/{k}, F2=SFORCE({k},0,2,0)\\F3=SFORCE({k},0,3,0)+DIF({k})+DIF1({k})",
        ]
    lines.append(f"VARIABLE/{3 * n + 1}, FUNCTION=TIME")
    return row(n, "VARVAL({b})+VARVAL({b})*TIME", "\n".join(lines))


def compiled(deck):
    return al.compile_model(al.assemble(al.read(deck)))


def one_by_one(deck, monkeypatch):
    together = compiling.add

    def each_by_itself(groups, model, face, statements):
        for each in statements:
            together(groups, model, face, [each])

    with monkeypatch.context() as change:
        change.setattr(compiling, "add", each_by_itself)
        return compiled(deck)


def described(kernels):
    """Groups with what their instances are made of; tables by what is in them."""
    return [
        (
            group.face, group.name,
            [
                (each.label, *(list(map(_plain, slots)) for slots in binding.fields()))
                for each, binding in group.instances
            ],
        )
        for group in kernels.groups
    ]  # fmt: skip


def _plain(value):
    if isinstance(value, tuple):
        return tuple(getattr(each, "label", each) for each in value)
    data = getattr(value, "data", None)
    return value if data is None else data.tobytes()


@pytest.mark.parametrize("name", SOME)
def test_bound_together_or_one_by_one(name, monkeypatch):
    path = DECKS / name
    if not path.is_file():
        pytest.fail(f"{name} is no deck")
    assert described(compiled(path)) == described(one_by_one(path, monkeypatch))


MIXED = [
    "{n}*(DM({a},{b})-1)", "IF({n}-4: 0, 1, 2)*DM({a},{b})", "DM({a},{b})**2", "DM({a},1)",
    "IMPACT(DM({a},{b}),VR({a},{b}),1,{n},2,0,0.1)", "VARVAL(1)*DX({a})", "TIME*DX({b},{a},{a})",
]  # fmt: skip


@pytest.mark.parametrize("law", MIXED)
def test_forces_of_several_shapes(law, monkeypatch):
    """Zeros, constants, exponents, the ground and equal markers decide which belong together."""
    deck = row(9, law, "VARIABLE/1, FUNCTION=2+TIME")
    deck = deck.replace("FUNCTION=4*", "FUNCTION=0*").replace("FUNCTION=5*", "FUNCTION=0*")
    deck = deck.replace(",5,2,0,0.1", ",5,2.2,0,0.1").replace("DM(7,6)**2", "DM(7,6)**3")
    deck = deck.replace("POINT_MASS/6, MASS=1, CM=6, QG", "PART/6, MASS=1, IP=1,1,1, CM=6, QG")
    deck = deck.replace("MARKER/6, POINT_MASS=6", "MARKER/6, PART=6, QP=0,0.5,0")
    found = described(compiled(deck))
    assert found == described(one_by_one(deck, monkeypatch))
    assert len([face for face, *_ in found if face == "loads"]) > 1


def test_a_thousand_forces_are_bound_in_as_many_steps_as_ten(monkeypatch):
    made = []
    init = compiling.Binder.__init__

    def counted(self, *args):
        made.append(args)
        init(self, *args)

    monkeypatch.setattr(compiling.Binder, "__init__", counted)
    counts = []
    for text in (row(10), row(1000), measured_row(10), measured_row(50)):
        made.clear()
        compiled(text)
        counts.append(len(made))
    assert counts[0] == counts[1] < 12 and counts[2] == counts[3] < 25


def test_variables_and_elements_that_are_written_out(monkeypatch):
    deck = measured_row(12)
    deck = deck.replace("FUNCTION=3.5*DX(4)", "FUNCTION=3.5*DX(4)+VARVAL(14)")
    deck = deck.replace("REQUEST/7, F2=SFORCE(7,", "REQUEST/7, F2=SFORCE(8,")
    assert described(compiled(deck)) == described(one_by_one(deck, monkeypatch))


def test_of_forces_that_depend_on_themselves_the_first_is_named():
    deck = row(6, "DM({a},{b})+SFORCE(3,0,1,0)")
    with pytest.raises(al.DeckError, match="SFORCE/1 needs the force of SFORCE/3") as fault:
        compiled(deck)
    assert len(fault.value.diagnostics) == 1

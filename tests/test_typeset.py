"""Statements that are pasted from the LaTeX source of a paper."""

from __future__ import annotations

import pytest
from decklets import codes, function, last, told

from adamslite.editing.document import Document
from adamslite.editing.rename import rename
from adamslite.errors import UsageError
from adamslite.language.messages import START
from adamslite.syntax.typeset import Plain

NAMES = "VARIABLE/EA, FUNCTION=50\nVARIABLE/L_0, FUNCTION=1\nVARIABLE/\\Delta L, FUNCTION=TIME\n"
SECTION = "SFORCE/0102, I=1, J=2, FUNCTION= -EA/(L_0+\\Delta L)*[DM(1,2)-(L_0+\\Delta L)]"
GATHERED = """VFORCE/02, I_marker=(2), J_part=(1)
, FX= VARVAL(EA) /Gc * (ACCX(2,0,0)-IGRAV)
,      + VARVAL(d(EA)/dt) /Gc * VX(2,0,0) \\
, FY= VARVAL(EA) /Gc * (ACCY(2,0,0)-JGRAV)
, FZ= VARVAL(EA)/Gc * (ACCZ(2,0,0)-KGRAV)"""


@pytest.mark.parametrize(
    "written",
    [
        "$$\\text{SFORCE/0102, I=1, J=2, FUNCTION= "
        "-EA/(L\\_0+\\Delta L)*[DM(1,2)-(L\\_0+\\Delta L)]}$$",
        "$\\text{SFORCE/0102, I=1, J=2, FUNCTION}= "
        "-EA/(L_{0}+\\Delta L)*[DM(1,2)-(L_0+\\Delta L)]$",
        "\\[\\text{SFORCE/0102, I=1,\n J=2, FUNCTION} = -EA/(L\\_0+\\Delta L) \\\\\n"
        "&\\times \\left[\\mathrm{DM}(1,2)-\\left(L\\_0+\\Delta L\\right)\\right]\\]",
        "$$\n\\begin{align*}\n\\text{SFORCE/0102, I=1, J=2, FUNCTION=} \\\\\n"
        "-EA/(L\\_0+\\Delta L) \\cdot [DM(1{,}2)-(L\\_0+\\Delta L)]\n\\end{align*}\n$$",
        "\\text{SFORCE/0102, I=1, J=2, FUNCTION=} -EA/\\left(L\\_0+\\Delta L\\right)"
        "*\\left[DM(1,2)-(L\\_0+\\Delta L)\\right]",
        "SFORCE/0102, I=1, J=2, FUNCTION= $-EA/(L\\_0+\\Delta L)*[DM(1,2)-(L\\_0+\\Delta L)]$",
    ],
)
def test_the_section_of_a_cable(written: str) -> None:
    assert last(NAMES + written).function == last(NAMES + SECTION).function


@pytest.mark.parametrize("end", [" \\\\", " \\qquad", "\\,"])
def test_a_statement_of_many_lines(end: str) -> None:
    typeset = GATHERED.replace("EA", "E\\_A").replace("\n", f"{end}\n")
    names = "VARIABLE/E\\_A, FUNCTION=TIME\n"
    got = last(f"{names}$$\\text{{{typeset}}}$$")
    expected = last(f"VARIABLE/E_A, FUNCTION=TIME\n{GATHERED.replace('EA', 'E_A')}")
    assert (got.fx, got.fy, got.fz) == (expected.fx, expected.fy, expected.fz)


@pytest.mark.parametrize(
    ("typeset", "plain"),
    [
        ("$\\frac{1}{2} TIME$", None),
        ("$\\frac{1}{2}*TIME$", "((1)/(2))*TIME"),
        ("$2/\\frac{TIME}{3+\\frac{1}{TIME}}$", "2/(TIME/(3+1/TIME))"),
        ("$-\\frac{TIME}{2}^{3}$", "-(TIME/2)**3"),
        ("$TIME^2$", "TIME**2"),
        ("$\\sqrt{2 \\cdot TIME}$", "SQRT(2*TIME)"),
        ("$\\sin\\left(\\omega\\right)$", "SIN(omega)"),
        ("$2\\,*\\;3 \\quad + 1$", "2*3+1"),
        ("2 + 3 ! in $ and \\text{others}", "2+3"),
    ],
)
def test_expressions(typeset: str, plain: str | None) -> None:
    names = "VARIABLE/omega, FUNCTION=3"
    if plain is None:
        assert codes(f"VARIABLE/9, FUNCTION={typeset}") != []
    else:
        assert function(typeset, names) == function(plain, names)


def test_two_statements_in_one_display() -> None:
    written = "$$\\text{VARIABLE/8, FUNCTION=} 2 \\\\\n\\text{VARIABLE/9, FUNCTION=VARVAL(8)}$$"
    assert last(written).function == function("VARVAL(8)", "VARIABLE/8, FUNCTION=2")


def test_what_follows_a_display_is_a_statement() -> None:
    assert codes("$$\\text{VARIABLE/8, FUNCTION=2}$$\nVARIABLE/9, FUNCTION=8\n$TIME") == [
        "not-a-statement"
    ]


@pytest.mark.parametrize(
    ("wrong", "code", "quoted"),
    [
        ("$$\\text{VARIABLE/9, FUNCTION}=\\left((L\\_0+1\\right)$$", "unclosed-bracket", "("),
        ("$$\\text{VARIABLE/9, FUNCTION}=L\\_1 + 1$$", "unknown-name", "L\\_1"),
        ("VARIABLE/9, FUNCTION=$5", "stray-character", "$"),
    ],
)
def test_mistakes_are_quoted_as_pasted(wrong: str, code: str, quoted: str) -> None:
    """The offsets count in the text that was pasted."""
    text = START + NAMES + wrong + "\n"
    (only,) = told(text)
    assert only.code == code
    line, first, last = only.span.line, only.span.column - 1, only.span.end_column - 1
    assert text.splitlines()[line - 1][first:last] == quoted


def test_dollar_signs_in_quotes_and_comments_mean_nothing() -> None:
    commented = "VARIABLE/9, FUNCTION=1 ! $a \\text{\nVARIABLE/10, FUNCTION=VARVAL(9)"
    assert function("VARVAL(10) ! $b", commented) == function("VARVAL(10)", commented)


def test_names_in_latex_are_not_replaced() -> None:
    """A name is not found by its letters where it is written L\\_0."""
    text = START + NAMES + "$\\text{VARIABLE/9, FUNCTION}=L\\_0$\nEND\n"
    content = Document("a.adm", "deck").update(text)
    with pytest.raises(UsageError, match="LaTeX"):
        rename([content], content, text.index("L_0"), "L_1")


@pytest.mark.parametrize(
    ("sign", "left"),
    [
        ("\\[\n", "\\["),
        ("$\n$", "$;"),
        ("$$ x\n", "x;"),
        ("\\text{", ""),
        ("\\frac{", "(("),
        ("}{", "}{"),
    ],
)
def test_a_long_text_of_signs(sign: str, left: str) -> None:
    """What has no end stays, and 20 000 of a kind are read as fast as one is."""
    plain = Plain(sign * 20_000).text
    assert set("".join(plain.split())) == set(left)

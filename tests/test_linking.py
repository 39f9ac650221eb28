"""Object code linked into the process: by our own linker, by LLVM's, and when neither need load."""

from __future__ import annotations

import ctypes
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from adamslite.native import compiler, elf_linker

HERE = pytest.mark.skipif(sys.platform != "linux", reason="links object code of Linux only")

# A constant, a table of the compiler's making, a call within, two of the C library.
TEXT = """
declare double @atan2(double, double)
declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)

define internal double @third(double %x) noinline {{
  %y = fmul double %x, 0x3FD5555555555555
  ret double %y
}}

define double @{name}(double %x, i64 %n, ptr %cleared) {{
entry:
  call void @llvm.memset.p0.i64(ptr %cleared, i8 0, i64 800, i1 false)
  switch i64 %n, label %rest [
    i64 0, label %a
    i64 1, label %b
    i64 2, label %c
    i64 3, label %d
    i64 4, label %e
  ]
a:
  ret double 3.0
b:
  %angle = call double @atan2(double %x, double 2.0)
  ret double %angle
c:
  %part = call double @third(double %x)
  ret double %part
d:
  %square = fmul double %x, %x
  ret double %square
e:
  %more = fadd double %x, 0.1
  ret double %more
rest:
  ret double -1.0
}}
"""
X = 0.7
EXPECTED = [3.0, math.atan2(X, 2.0), X * (1 / 3), X * X, X + 0.1, -1.0]


def values(address: int) -> list[float]:
    """What the function gives for each of its branches; all of its array must be cleared."""
    function = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double, ctypes.c_int64, ctypes.c_void_p)
    found = []
    for n in range(len(EXPECTED)):
        array = np.ones(101)
        found.append(function(address)(X, n, array.ctypes.data))
        assert not array[:100].any() and array[100] == 1.0
    return found


@HERE
def test_links_constants_tables_and_calls() -> None:
    """No tolerance: each branch is one operation, or the same function of the C library."""
    places = elf_linker.link([compiler.object_code(TEXT.format(name="ours"))], {})
    assert list(places) == ["ours"]
    assert values(places["ours"]) == EXPECTED


def test_llvm_links_what_is_foreign(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(codes: list[bytes], linked: dict[str, int]) -> None:
        raise elf_linker.Foreign

    monkeypatch.setattr(elf_linker, "link", refuse)
    code = compiler.object_code(TEXT.format(name="theirs"))
    assert values(compiler.addresses([(code, ["theirs"])])["theirs"]) == EXPECTED


CALLED = """define double @{0}.half(double %x) nounwind {{
  %y = fmul double %x, 5.0e-1
  ret double %y
}}
"""
CALLER = """declare double @{0}.half(double) nounwind
define double @{0}.quarter(double %x) nounwind {{
  %y = call double @{0}.half(double %x)
  %z = call double @{0}.half(double %y)
  ret double %z
}}
"""


@pytest.mark.parametrize("by", [pytest.param("us", marks=HERE), "llvm"])
def test_code_calls_what_was_linked_before(by: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """What integrators share is one object, each integrator another."""

    def refuse(codes: list[bytes], linked: dict[str, int]) -> None:
        raise elf_linker.Foreign

    if by == "llvm":
        monkeypatch.setattr(elf_linker, "link", refuse)
    for text, name in ((CALLED, f"by_{by}.half"), (CALLER, f"by_{by}.quarter")):
        code = compiler.object_code(text.format(f"by_{by}"))
        address = compiler.addresses([(code, [name])])[name]
    assert ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)(address)(6.0) == 1.5


def spoiled(code: bytes, what: str) -> bytes:
    """Object code with one thing that is not linked here."""
    sections = elf_linker.sections_of(code)
    changed = bytearray(code)
    if what == "machine":
        changed[elf_linker.HEADER.fields["machine"][1]] += 1
    elif what == "relocation":
        first = int(sections["offset"][sections["type"] == elf_linker.RELA][0])
        changed[first + elf_linker.RELOCATION.fields["type"][1]] = 2  # R_X86_64_PC32
    elif what == "function":
        at = code.index(b"\0atan2\0")
        changed[at + 1 : at + 6] = b"atanx"
    return bytes(changed)


@HERE
@pytest.mark.parametrize(
    "what, why",
    [
        ("machine", "not ELF for x86-64"),
        ("relocation", "relocations other than whole words"),
        ("function", "calls atanx"),
    ],
)
def test_refuses_what_it_does_not_link(what: str, why: str) -> None:
    code = spoiled(compiler.object_code(TEXT.format(name="spoiled")), what)
    with pytest.raises(elf_linker.Foreign, match=why):
        elf_linker.link([code], {})


@HERE
def test_variables_are_refused() -> None:
    text = "@count = global double 1.0\ndefine ptr @where() {\n  ret ptr @count\n}\n"
    with pytest.raises(elf_linker.Foreign, match="has variables"):
        elf_linker.link([compiler.object_code(text)], {})


def test_no_elf_at_all_is_refused() -> None:
    with pytest.raises(elf_linker.Foreign):
        elf_linker.link([b"MZ" + bytes(200)], {})


DECK = """Falls
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2
MARKER/2, POINT_MASS=2
SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-VR(2,1)
SIMULATE/DYNAMICS, END=0.1, STEPS=1
END
"""


@HERE
def test_a_second_run_loads_no_compiler(tmp_path: Path) -> None:
    deck = tmp_path / "falls.adm"
    deck.write_text(DECK)
    program = (
        "import sys\nfrom adamslite import read, simulate\n"
        f"simulate(read({str(deck)!r}))\n"
        "print({'llvmlite.binding', 'sympy'} & set(sys.modules))"
    )
    told = [
        subprocess.run(
            [sys.executable, "-c", program], env=os.environ, capture_output=True, text=True,
            check=True,
        ).stdout.strip()
        for _ in range(2)
    ]  # fmt: skip
    assert told[1] == "set()"

"""Systems that no test runs on: LLVM's linker in place of this program's own, and object code.

Anything but Linux on x86-64 links by LLVM, so ten decks are run with it and must have the same
bytes.  For other systems the same native code is compiled, and looked at for functions that it
calls: those of the program itself, and of the library of C of that system.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from object_files import foreign
from writing_commands import environment

import adamslite
from adamslite.equations import engine
from adamslite.native import compiler, elf_linker, processor
from adamslite.resources import find

LINUX = pytest.mark.skipif(sys.platform != "linux", reason="links object code of Linux only")
#: One for each kind of method, of force, of event; ropes; analyses of other kinds.
DECKS = (
    "hanging-mass/hanging-mass", "four-bar/four-bar", "atwood/atwood-coupler", "car-axis/car-axis",
    "spring-pendulum/spring-pendulum", "conical-pendulum/conical-pendulum", "bushing/bushing",
    "pid-winch/pid-winch", "sliding-mass/sliding-mass", "swinging-cable-n10/swinging-cable-n10",
)  # fmt: skip

BY_LLVM = """\
from adamslite.native import compiler, elf_linker
linked = []
def refuse(codes, known):
    linked.append(1)
    raise elf_linker.Foreign("for another system")
"""
RUNS = """\
import sys
from adamslite.cli.main import main
for k, deck in enumerate(sys.argv[2:]):
    assert main(["solve", deck, "-o", f"{sys.argv[1]}{k}.csv", "--quiet"]) in (0, 4), deck
"""


@LINUX
@pytest.mark.slow
def test_ten_decks_have_the_same_bytes_by_the_linker_of_llvm(tmp_path: Path) -> None:
    decks = [str(find("decks") / f"{name}.adm") for name in DECKS]
    ends = {"ours": RUNS, "llvm": f"{BY_LLVM}elf_linker.link = refuse\n{RUNS}assert linked\n"}
    for who, program in ends.items():
        done = subprocess.run(
            [sys.executable, "-c", program, who, *decks], cwd=tmp_path, env=environment(),
            capture_output=True, text=True,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
    for k, name in enumerate(DECKS):
        ours, theirs = ((tmp_path / f"{who}{k}.csv").read_bytes() for who in ends)
        assert ours == theirs and ours.count(b"\n") > 10, name


# ---- object code for other systems ------------------------------------------------------------

#: What all libraries of C have of what is called.
EVERYWHERE = {
    "acos", "asin", "atan", "atan2", "ceil", "cos", "cosh", "exp", "exp2", "floor", "fmod", "log",
    "log10", "memcpy", "memmove", "memset", "pow", "round", "sin", "sinh", "tan", "tanh", "trunc",
    "rint", "nearbyint", "log2", "fma", "cbrt", "expm1", "log1p", "hypot", "ldexp",
}  # fmt: skip
#: Targets of LLVM, and what their systems have beyond that: two functions at once of glibc and of
#: macOS, and how macOS clears and fills, under a name for each of its processors. `_fltused` is no
#: function: it says that there are floating numbers, for the linker of Microsoft, and nothing
#: refers to it.
SYSTEMS = {
    "x86_64-unknown-linux-gnu": {"sincos"},
    "aarch64-unknown-linux-gnu": {"sincos"},
    "arm64-apple-macosx11.0.0": {"__sincos_stret", "bzero", "memset_pattern16"},
    "x86_64-apple-macosx11.0.0": {"__sincos_stret", "__bzero", "memset_pattern16"},
    "x86_64-pc-windows-msvc": {"_fltused"},
}


@cache
def native_texts() -> list[tuple[str, int, Callable[[Any], Any]]]:
    """All that is compiled for three decks: bodies in a plane, a rope, and other methods."""
    texts: list[tuple[str, int, Callable[[Any], Any]]] = []
    emitted = compiler._emitted

    def heard(*words: Any) -> bytes:
        texts.append(words)
        return emitted(*words)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(compiler, "_emitted", heard)
        for kept in (compiler, "_linked"), (engine, "_functions"), (engine, "_built"):
            patch.setattr(*kept, {})  # what other tests have compiled
        for method in ("GSTIFF", "HHT", "ABAM"):
            adamslite.simulate(find("decks") / "hanging-mass/hanging-mass.adm", integrator=method)
        adamslite.simulate(find("decks") / "swinging-cable-n10/swinging-cable-n10.adm", end=0.01)
    return texts


def machine(triple: str, level: int) -> Any:
    """The code generator for another system, as :func:`processor.make_machine` makes that of this
    one.
    """
    llvm = processor.library()
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    return llvm.Target.from_triple(triple).create_target_machine(
        opt=level, reloc="static", codemodel="jitdefault"
    )


@pytest.mark.slow
@pytest.mark.parametrize("triple", SYSTEMS)
def test_object_code_calls_what_its_system_has(triple: str, cache: Path, monkeypatch) -> None:
    texts = native_texts()
    assert len(texts) > 10
    monkeypatch.setattr(processor, "target_machine", lambda: machine(triple, 3))
    monkeypatch.setattr(processor, "quick_machine", lambda: machine(triple, 0))
    called = {name for text in texts for name in foreign(compiler._emitted(*text))}
    own = {name for name in called if "." in name}  # as all that the program names itself
    assert "memcpy" in called or "memset" in called
    assert called - own <= EVERYWHERE | SYSTEMS[triple]


def test_the_symbols_of_an_object_are_read(monkeypatch) -> None:
    """A function that is here, one that is not, and one of the library of C; of every format."""
    text = (
        "declare double @atan2(double, double)\n"
        "declare double @elsewhere_with_a_long_name(double)\n"
        "define double @here(double %x) {\n"
        "  %y = call double @atan2(double %x, double 2.0)\n"
        "  %z = call double @elsewhere_with_a_long_name(double %y)\n"
        "  ret double %z\n}\n"
    )
    for triple in SYSTEMS:
        made = machine(triple, 0)
        monkeypatch.setattr(processor, "quick_machine", lambda made=made: made)
        found = foreign(compiler.quick_code(text)) - {"_fltused"}
        assert found == {"atan2", "elsewhere_with_a_long_name"}, triple


def test_code_of_other_systems_is_not_linked_here(monkeypatch) -> None:
    text = "define double @alone(double %x) {\n  ret double %x\n}\n"
    for triple in [*SYSTEMS][1:]:
        made = machine(triple, 0)
        monkeypatch.setattr(processor, "quick_machine", lambda made=made: made)
        with pytest.raises(elf_linker.Foreign):
            elf_linker.link([compiler.quick_code(text)], {})

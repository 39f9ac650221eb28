"""The target processor of native code: this one, or a common level of x86-64.

``ADAMSLITE_CPU`` is ``host`` (default: all that this processor can) or a level of the x86-64 psABI
(section 3.1.1, "Micro-Architecture Levels"), so that a run can be repeated as an older processor
would round it.  Native code rounds otherwise from level to level: v3 brings FMA, and each brings
wider vectors, whose sums are ordered otherwise.
"""

from __future__ import annotations

import functools
import os
import sys
from pathlib import Path
from typing import Any

from adamslite.errors import RunFailed, UsageError

CPUINFO = Path("/proc/cpuinfo")
HOST = "host"

# What each level adds to the one before, in LLVM's words.
LEVELS = {
    "x86-64": "cmov cx8 fxsr mmx sse sse2",
    "x86-64-v2": "cx16 popcnt sahf sse3 sse4.1 sse4.2 ssse3",
    "x86-64-v3": "avx avx2 bmi bmi2 f16c fma lzcnt movbe xsave",
    "x86-64-v4": "avx512bw avx512cd avx512dq avx512f avx512vl",
}


def target() -> str:
    """The name that ``ADAMSLITE_CPU`` gives."""
    name = os.environ.get("ADAMSLITE_CPU") or HOST
    if name != HOST and name not in LEVELS:
        known = ", ".join((HOST, *LEVELS))
        raise UsageError(f"ADAMSLITE_CPU is '{name}', but must be one of {known}")
    return name


def identity() -> str:
    """What decides whether object code made earlier may run here."""
    return f"{target()} {_this_one()}"


def name() -> str:
    """What names this processor without asking LLVM, which takes a while to load: for what holds
    no code.
    """
    return f"{target()} {_told_by_system() or _told_by_python()}"


@functools.cache
def _this_one() -> str:
    import llvmlite

    return f"{llvmlite.__version__} {_told_by_system() or _told_by_llvm()}"


@functools.cache
def _told_by_system() -> str:
    """Model and features of the first processor as reported by Linux; empty elsewhere."""
    facts = ("vendor_id", "cpu family", "model", "stepping", "flags")
    try:
        first, _, _ = CPUINFO.read_text(encoding="utf-8", errors="replace").partition("\n\n")
    except OSError:
        return ""
    pairs = (line.partition(":") for line in first.splitlines())
    values = {name.strip(): value.strip() for name, _, value in pairs}
    if not all(values.get(fact) for fact in facts):
        return ""
    return " ".join([os.uname().machine, str(sys.maxsize), *(values[fact] for fact in facts)])


def _told_by_python() -> str:
    system = os.uname() if hasattr(os, "uname") else ()
    return " ".join([*system, os.environ.get("PROCESSOR_IDENTIFIER", "")])


def _told_by_llvm() -> str:
    llvm = library()

    features = llvm.get_host_cpu_features().flatten()
    return f"{llvm.get_process_triple()} {llvm.get_host_cpu_name()} {features}"


def library() -> Any:
    """LLVM, which is loaded when it is first needed.

    Raises
    ------
    RunFailed
        When it cannot be loaded.
    """
    try:
        import llvmlite.binding as llvm
    except OSError as fault:
        raise RunFailed(f"LLVM cannot be loaded: {fault.__context__ or fault}") from None
    return llvm


def target_machine() -> Any:
    """The optimising code generator for the target."""
    return make_machine(target())


def quick_machine() -> Any:
    """The code generator for the target that does not optimise."""
    return make_machine(target(), 0)


@functools.cache
def make_machine(name: str, level: int = 3) -> Any:
    """The code generator for one of the targets; the level 0 does not optimise."""
    llvm = library()
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    host = llvm.get_host_cpu_features()
    if name == HOST:
        cpu, features = llvm.get_host_cpu_name(), host.flatten()
    else:
        cpu, features = name, ""
        if missing := lacks(name, host):
            raise UsageError(f"ADAMSLITE_CPU is '{name}', but this processor has no {missing}")
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=cpu, features=features, opt=level, reloc="static", codemodel="jitdefault"
    )


def lacks(name: str, host: dict[str, bool]) -> str:
    """The first feature of a level that ``host`` (LLVM's features) is without; or nothing."""
    levels = list(LEVELS)
    needed = " ".join(LEVELS[level] for level in levels[: levels.index(name) + 1]).split()
    return next((feature for feature in needed if not host.get(feature)), "")

"""Native code: LLVM text in, object code and callable addresses out.

LLVM compiles; what has been compiled is linked by :mod:`adamslite.native.elf_linker` where that can
be, so that its library, 40 MB of memory, is loaded for new code only.

Object code is kept (:mod:`adamslite.caching`) under a hash of what it is made from, the compiler
version and the processor (:mod:`adamslite.native.processor`), so a deck seen before, or one whose
expressions have the same shape, compiles nothing.
"""

from __future__ import annotations

import functools
import hashlib
import os
from collections.abc import Callable, Iterable, Sequence
from threading import Lock
from typing import Any

from adamslite.native import processor


def digest(*parts: str) -> str:
    """Content hash of texts, compiler and processor."""
    text = "\0".join((*parts, processor.identity()))
    return hashlib.sha256(text.encode()).hexdigest()[:32]


# LLVM takes functions in up to this size. Its own 250 makes the integrators a third longer to
# compile, and no faster.
INLINED = 100
# Memory of LLVM [byte], and for each letter of a text: measured 30 MB, and 30 for each letter. It
# ends the process where it gets none.
OF_LLVM, PER_LETTER = 40_000_000, 60
# Characters of a text that LLVM, which cannot be interrupted, compiles in less than 0.1 s.
SHORT = 30_000


def object_code(text: str) -> bytes:
    """Compile LLVM assembly to object code, with all that LLVM can do for functions and loops."""
    return _compiled(text, 3, lambda passes: passes.getModulePassManager())


def plain_code(text: str) -> bytes:
    """The same in half of the time, for what is called seldom: sums are simplified, no more."""
    return _compiled(text, 1, _simplified)


def quick_code(text: str) -> bytes:
    """The same in an eighth of the time, for what no step waits for: it takes twice as long."""
    return _compiled(text, 0, _simplified)


def _simplified(_: Any) -> Any:
    llvm = processor.library()

    manager = llvm.create_new_module_pass_manager()
    manager.add_sroa_pass()
    manager.add_instruction_combine_pass()
    manager.add_simplify_cfg_pass()
    return manager


def straight_code(text: str) -> bytes:
    """The same for long bodies without branches, whose equal parts are numbered already.

    Sums and products are rearranged, no more, unless native functions stand beside the bodies.
    Vectors made of scalars (SLP) take two thirds of LLVM's time on such bodies, which run slower
    for them.
    """
    llvm = processor.library()

    def passes_of(passes: Any) -> Any:
        if "define internal" in text:
            return passes.getModulePassManager()
        manager = llvm.create_new_module_pass_manager()
        manager.add_instruction_combine_pass()
        manager.add_reassociate_pass()
        return manager

    return _compiled(text, 1, passes_of)


def _compiled(text: str, level: int, passes_of: Callable[[Any], Any]) -> bytes:
    """Object code by the passes that ``passes_of`` takes from a builder of passes."""
    from adamslite.machine import require_memory
    from adamslite.native.fatal import explained

    require_memory(OF_LLVM + PER_LETTER * len(text))

    def compiled() -> bytes:
        with _compiling, explained():
            return _emitted(text, level, passes_of)

    if len(text) < SHORT:
        return compiled()
    from adamslite.native.worker import interruptible  # which takes threads along

    return interruptible(compiled)


def _emitted(text: str, level: int, passes_of: Callable[[Any], Any]) -> bytes:
    llvm = processor.library()

    machine = processor.target_machine() if level else processor.quick_machine()
    module = llvm.parse_assembly(text)
    module.triple = machine.triple
    module.data_layout = str(machine.target_data)
    tuning = llvm.create_pipeline_tuning_options(speed_level=level)
    tuning.loop_vectorization = tuning.slp_vectorization = level > 2
    tuning.inlining_threshold = INLINED
    passes = llvm.create_pass_builder(machine, tuning)
    passes_of(passes).run(module, passes)
    return machine.emit_object(module)


def addresses(parts: Iterable[tuple[bytes | tuple[bytes, ...], list[str]]]) -> dict[str, int]:
    """Addresses of the names in each object code, or in several that call each other; one linked
    earlier is not linked again.
    """
    found: dict[str, int] = {}
    for code, names in parts:
        if names[0] not in _linked:
            with _linking:
                _linked.update(_link((code,) if isinstance(code, bytes) else code, names))
        found.update((name, _linked[name]) for name in names)
    return found


_linked: dict[str, int] = {}
_compiling, _linking = Lock(), Lock()
"""LLVM takes one call at a time.  A fork waits for it: a child has one thread, and what the others
had locked, here and inside LLVM, would be locked in it for ever.
"""


def _before_fork() -> None:
    _compiling.acquire()
    _linking.acquire()


def _after_fork() -> None:
    _linking.release()
    _compiling.release()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(
        before=_before_fork, after_in_parent=_after_fork, after_in_child=_after_fork
    )


def _link(codes: Sequence[bytes], names: list[str]) -> dict[str, int]:
    from adamslite.native import (
        elf_linker,  # which imports numpy, and the syntax is cached here, too
    )

    try:
        return elf_linker.link(codes, _linked)
    except elf_linker.Foreign:
        return _link_by_llvm(codes, names)


def _link_by_llvm(codes: Sequence[bytes], names: list[str]) -> dict[str, int]:
    """Addresses from LLVM's linker, which knows every system and machine."""
    llvm = processor.library()

    from adamslite.native.fatal import explained

    with explained():
        engine = _llvm_linker()
        for code in codes:
            # It reads code and object later without owning them.
            _kept.append((code, llvm.ObjectFileRef.from_data(code)))
            engine.add_object_file(_kept[-1][1])
        engine.finalize_object()
        return {name: engine.get_function_address(name) for name in names}


@functools.cache
def _llvm_linker() -> Any:
    """The one linker of LLVM; code added to it lives as long as the process."""
    llvm = processor.library()

    return llvm.create_mcjit_compiler(llvm.parse_assembly(""), processor.target_machine())


_kept: list[tuple[bytes, Any]] = []

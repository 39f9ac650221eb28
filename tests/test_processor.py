"""Native code for a chosen processor: what it may use, where it is kept, which names there are."""

from __future__ import annotations

import pytest

from adamslite.cli.commands.codes import USAGE
from adamslite.cli.main import main
from adamslite.native import compiler, processor
from adamslite.resources import find

# Four sums at once where there is AVX, a product and a sum in one operation where there is FMA.
TEXT = """
define void @add(ptr %p) {
  %v = load <4 x double>, ptr %p, align 8
  %w = fmul contract <4 x double> %v, %v
  %s = fadd contract <4 x double> %w, %v
  store <4 x double> %s, ptr %p, align 8
  ret void
}
"""


def assembly() -> str:
    import llvmlite.binding as llvm

    return processor.target_machine().emit_assembly(llvm.parse_assembly(TEXT))


def runs(level: str) -> bool:
    import llvmlite.binding as llvm

    return not processor.lacks(level, llvm.get_host_cpu_features())


@pytest.mark.parametrize(
    "level, wide, fused",
    [
        ("x86-64", False, False),
        ("x86-64-v2", False, False),
        ("x86-64-v3", True, True),
        ("x86-64-v4", True, True),
    ],
)
def test_a_level_uses_what_it_brings(
    level: str, wide: bool, fused: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not runs(level):
        pytest.skip(f"this processor is not {level}")
    monkeypatch.setenv("ADAMSLITE_CPU", level)
    assert ("ymm" in assembly()) is wide
    assert ("vfmadd" in assembly()) is fused


def test_each_target_keeps_its_own_code(monkeypatch: pytest.MonkeyPatch) -> None:
    keys = set()
    for name in (processor.HOST, *processor.LEVELS):
        monkeypatch.setenv("ADAMSLITE_CPU", name)
        keys.add(compiler.digest(TEXT))
    assert len(keys) == 1 + len(processor.LEVELS)
    monkeypatch.delenv("ADAMSLITE_CPU")
    assert compiler.digest(TEXT) in keys


def test_features_add_up() -> None:
    every = {feature: True for words in processor.LEVELS.values() for feature in words.split()}
    assert not processor.lacks("x86-64-v4", every)
    assert processor.lacks("x86-64-v3", every | {"sse3": False}) == "sse3"
    assert not processor.lacks("x86-64-v2", every | {"fma": False})


def test_a_target_that_is_none_is_told(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ADAMSLITE_CPU", "pentium")
    assert (
        main(["solve", str(find("decks") / "hanging-mass" / "hanging-mass.adm"), "-o", "-"])
        == USAGE
    )
    told = capsys.readouterr()
    assert not told.out
    assert told.err.splitlines()[-1] == (
        "adamslite: ADAMSLITE_CPU is 'pentium', but must be one of host, x86-64, x86-64-v2, "
        "x86-64-v3, x86-64-v4"
    )


def test_a_target_beyond_this_processor_is_told(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(processor.LEVELS, "x86-64-v4", "wings")
    monkeypatch.setenv("ADAMSLITE_CPU", "x86-64-v4")
    processor.make_machine.cache_clear()
    assert (
        main(["solve", str(find("decks") / "hanging-mass" / "hanging-mass.adm"), "-o", "-"])
        == USAGE
    )
    assert (
        "ADAMSLITE_CPU is 'x86-64-v4', but this processor has no wings" in capsys.readouterr().err
    )

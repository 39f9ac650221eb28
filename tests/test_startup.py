"""What a run loads: nothing that only a first run needs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from scenes import SPRING

LOADED = """\
import sys
import adamslite as al
al.simulate(al.read(sys.argv[1]), end=0.1, steps=2, integrator=sys.argv[2])
print(*sorted(name.removeprefix("adamslite.") for name in sys.modules if "adamslite." in name))
"""


@pytest.mark.slow  # it may have to compile the method
@pytest.mark.parametrize("method", ["GSTIFF", "HHT", "RADAU", "ABAM"])
def test_a_run_whose_code_is_compiled_loads_no_translator(tmp_path: Path, method: str) -> None:
    deck = tmp_path / "spring.adm"
    deck.write_text(SPRING)
    for _ in range(2):
        run = subprocess.run(
            [sys.executable, "-c", LOADED, str(deck), method],
            capture_output=True, text=True, check=True,
        )  # fmt: skip
    loaded = run.stdout.split()
    assert "equations.system" in loaded
    assert "native.translate.statements" not in loaded
    assert not [name for name in loaded if name.endswith(".method") and "integrators" in name]
    assert not {"integrators.motion_equations", "integrators.linalg.blocks"} & set(loaded)

"""The matrices of LINEAR/MKB as a file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.outputs.whole_files import whole_file
from adamslite.results.linearization import SecondOrder

if TYPE_CHECKING:
    from adamslite.results.results import Linearized


def save_second_order(made: Linearized, path: Path) -> list[Path]:
    """M, B, K, F and the basis as JSON; matrices are lists of rows."""
    found = made.model.second_order
    assert found is not None  # the command reports a model without
    names = {"coordinates": list(made.model.coordinates), "inputs": list(made.model.inputs)}
    matrices = {name: getattr(found, name).tolist() for name in SecondOrder._fields}
    with whole_file(path) as stream:
        stream.write(json.dumps(names | matrices | {"note": made.model.note}, indent=1) + "\n")
    return [path]

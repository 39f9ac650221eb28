"""INFO: a REQUEST that is evaluated once, in the present state."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.session.saved_state import State
from adamslite.elements.request import MEASURES, Request
from adamslite.equations.result_columns import columns
from adamslite.equations.system import System
from adamslite.integrators import contract
from adamslite.integrators.contract import ACCELERATIONS, RECORD
from adamslite.kernels.compile import compile_model
from adamslite.model.model import assemble

if TYPE_CHECKING:
    from adamslite.elements.info import Info

# A name that no deck can give to a REQUEST.
ONCE = "info "


def info(system: System, command: Info, time: float) -> str:
    """What is printed: the values by their names, or that the state does not determine them.

    ``system`` stays as it is.
    """
    model = system.model
    measured = Request(id=ONCE, kind=command.kind, i=command.i, j=command.j, rm=command.rm)
    kernels = compile_model(assemble(model.deck.with_more([measured]), model.without))
    copy = System(kernels, bool(system.sizes.si2), system.elimination.pivoting)
    State.of(system, time, at_rest=False).put_into(copy)
    copy.start_record(np.array([time]))
    if copy.run(ACCELERATIONS) != contract.DONE:
        return f"t = {time:.9g}: {command.kind} of {command.i} is not determined"
    copy.run(RECORD, 0)
    record = copy.record[: copy.nw + copy.sizes.n_out]
    names, values = columns(copy, record.reshape(1, -1))
    row = dict(zip(names, values[0].tolist(), strict=True))
    found = (f"{name} {row[f'{measured.label}.F{n}']:.9g}"
             for n, name in enumerate(MEASURES[command.kind], 1) if name)  # fmt: skip
    return f"t = {time:.9g}: {_asked(command)}: {', '.join(found)}"


def _asked(command: Info) -> str:
    """The command in short."""
    frames = (("J", command.j), ("RM", command.rm))
    given = "".join(f", {word}={key}" for word, key in frames if key)
    return f"{command.kind} I={command.i}{given}"

"""`chart` as users of Python call it: what accuracy costs with each integrator."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from adamslite.analyses.setup.run_options import checked
from adamslite.analyses.setup.subject import Subject
from adamslite.analyses.simulation import simulate
from adamslite.api.inputs import CommandSource, User, inputs
from adamslite.deck.deck import Deck
from adamslite.errors import UsageError
from adamslite.kernels.compile import compile_model
from adamslite.model.model import Model, assemble
from adamslite.progress import Progress, progress_of
from adamslite.verification.variants import chosen, patient
from adamslite.verification.work_precision import ERRORS, Chart, measure


def chart(
    scene: Subject | str | os.PathLike[str],
    end: float | None = None,
    steps: int | None = None,
    hmax: float | None = None,
    integrator: str | Sequence[str] = (),
    error: float | Sequence[float] = (),
    channel: str | Sequence[str] = (),
    repeats: int = 3,
    patience: float = 20.0,
    commands: CommandSource = None,
    user: User = None,
    progress: Progress | Callable[[float, float], Any] | bool | None = None,
) -> Chart:
    """Run a deck with every integrator at several values of ERROR, and measure, as
    `adamslite chart` does.

    Parameters
    ----------
    scene, end, steps, hmax, commands, user, progress
        As for :func:`adamslite.simulate`.
    integrator, error : str, float, or sequences of them
        Only these; by default all, and 1e-2 to 1e-8.
    channel : str or sequence of str
        The channels whose error counts, names or patterns; the motion of everything when empty.
    repeats : int
        How often each run is timed.
    patience : float
        CPU that a run may take [s].

    Returns
    -------
    Chart
        Its points; ``recommended(digits)`` is the cheapest one with so many digits.
    """
    numbers = checked({"end": end, "steps": steps, "hmax": hmax})
    errors = [error] if isinstance(error, int | float) else list(error) or ERRORS
    for each in errors:
        checked({"error": each})
    if repeats < 1 or not patience > 0.0:
        raise UsageError("repeats= is at least 1, patience= a positive time in seconds")
    given = inputs(scene, commands, user)
    tried = chosen([integrator] if isinstance(integrator, str) else integrator)
    channels = [channel] if isinstance(channel, str) else channel
    shown = progress_of(progress)
    try:
        subject = given.subject
        model = assemble(subject) if isinstance(subject, Deck) else subject
        kernels = compile_model(model, shown) if isinstance(model, Model) else model
        solve = partial(simulate, kernels, commands=given.commands, **numbers)
        run = patient(solve, patience, shown)
        return measure(run, tried, sorted(errors, reverse=True), repeats, channels)
    finally:
        shown.close()

"""
text --parse--> syntax tree --read--> Deck (typed statements) --check--> diagnostics
     --assemble--> Model (bodies, markers, elements, index map)
     --compile_model--> Kernels (native residual, Jacobian, outputs)
     --simulate--> Results --save / compare-->

Each arrow is one function, and the result of every stage can be inspected:

    import adamslite as al

    deck = al.read("cable.adm")
    results = al.simulate(deck, end=2.0, steps=200)
    results["PART/2.x"]             # (nt,) array
    results.save("cable.csv")

Nothing is imported before it is used: a name below is imported at its first use,
so that `adamslite --help` does not wait for numpy.
"""

import importlib
import time

TYPE_CHECKING = False
if TYPE_CHECKING:  # Ctrl-C would meet modules being imported before the command can answer it
    from typing import Any

__version__ = "0.1.0"

STARTED = time.time()
"""When this process imported the package: a source file changed later may not be what it runs."""

_HOME = {
    "DeckError": "language.diagnostics",
    "DeckWarning": "errors",
    "Outcome": "results.outcomes",
    "Results": "results.results",
    "RunFailed": "errors",
    "RunWarning": "errors",
    "allow_path": "api.tools",
    "assemble": "model.model",
    "cable": "api.tools",
    "cache": "api.tools",
    "chart": "api.charts",
    "check": "api.checks",
    "compare": "api.tools",
    "compile_model": "kernels.compile",
    "fit": "api.fits",
    "fmt": "api.tools",
    "gradient": "api.sensitivities",
    "help": "api.tools",
    "html": "notebooks.html",
    "indices": "api.sweeps",
    "linearize": "api.runs",
    "load_sweep": "api.sweeps",
    "names": "api.numbers",
    "plot": "api.figures",
    "read": "reading.read",
    "read_commands": "reading.read",
    "reads": "deck.python_routine",
    "sensitivities": "api.sensitivities",
    "simulate": "api.runs",
    "sweep": "api.sweeps",
    "verify": "api.tools",
    "view": "api.figures",
    "with_values": "api.numbers",
}

__all__ = ["__version__", *_HOME]


def __getattr__(name: str) -> "Any":
    if name not in _HOME:
        raise AttributeError(f"module 'adamslite' has no attribute '{name}'")
    value = getattr(importlib.import_module(f"adamslite.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOME})

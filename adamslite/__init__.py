"""
text --parse--> syntax tree --read--> Deck (typed statements) --check--> diagnostics
     --assemble--> Model (bodies, markers, elements, index map)
     --compile_model--> Kernels (native residual, Jacobian, outputs)
     --simulate--> Results --save / compare-->

Each arrow is one function, and every stage can be looked at:

    import adamslite as al

    deck = al.read("cable.adm")
    results = al.simulate(deck, end=2.0, steps=200)
    results["PART/2.x"]             # (nt,) array
    results.save("cable.csv")

Nothing is imported before it is used: a name below is fetched the first time somebody asks for it,
so that `adamslite --help` does not wait for numpy.
"""

import importlib
import sys
import time
import types

__version__ = "0.1.0"

STARTED = time.time()
"""When this process imported the package: a source file changed later may not be what it runs."""

_HOME = {
    "DeckError": "diagnostics",
    "Outcome": "outcomes",
    "Results": "results",
    "assemble": "model",
    "check": "check",
    "compare": "compare",
    "compile_model": "compiled",
    "linearize": "simulate",
    "read": "deck",
    "simulate": "simulate",
}

__all__ = ["__version__", *_HOME]


class _Package(types.ModuleType):
    """The package, whose verbs stay functions.

    Importing the module `adamslite.check` makes Python bind it as attribute `check` of the package,
    which would hide the function of that name; modules named like a verb are therefore not bound.
    """

    def __setattr__(self, name: str, value: object) -> None:
        if not (name in _HOME and isinstance(value, types.ModuleType)):
            super().__setattr__(name, value)

    def __getattr__(self, name: str) -> object:
        if name not in _HOME:
            raise AttributeError(f"module 'adamslite' has no attribute '{name}'")
        value = getattr(importlib.import_module(f"adamslite.{_HOME[name]}"), name)
        setattr(self, name, value)
        return value

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *_HOME})


sys.modules[__name__].__class__ = _Package

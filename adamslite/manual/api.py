"""Pages of the names of the Python package, from their docstrings."""

from __future__ import annotations

import inspect
from typing import Any

import adamslite
from adamslite.manual.markdown import HEAD, heading

INTRO = """# Python

The names of `import adamslite as al`; [README.md](../../README.md#python) shows them at work, and
[a notebook](../tutorials/notebook.ipynb) goes through them. `simulate` is the command `solve`,
`compare` is `diff`, `linearize` is `linear`; the functions of other commands have their names.
"""
#: Names of the package that are described.
NAMES = tuple(name for name in adamslite.__all__ if not name.startswith("_"))
#: Classes of what the functions return.
RETURNED = (
    "deck.deck.Deck",
    "api.checks.Check",
    "language.diagnostics.Diagnostic",
    "results.comparison.Comparison",
    "results.linearization.Linearization",
    "verification.verification.Verdict",
    "sweeps.record.Sweep",
    "sensitivity.record.Sensitivities",
    "sweeps.saltelli.SobolIndices",
    "fitting.record.Fit",
    "verification.work_precision.Chart",
    "api.tools.Kept",
)
RETURNED_INTRO = """## Returned objects

What these functions return; the classes are not made by users.
"""


def python_names() -> str:
    """The page of all names, for the site only: docs/reference/api.md."""
    functions_first = sorted(NAMES, key=lambda name: inspect.isclass(getattr(adamslite, name)))
    named = (_directive(name) for name in functions_first)
    returned = (_autodoc("class", name) for name in RETURNED)
    return "\n".join([HEAD, INTRO, *named, RETURNED_INTRO, *returned])


def _directive(name: str) -> str:
    kind = "class" if inspect.isclass(getattr(adamslite, name)) else "function"
    return f"## {name}\n\n{_autodoc(kind, name)}"


def _autodoc(kind: str, name: str) -> str:
    """What makes Sphinx print signature and docstring."""
    return f"```{{eval-rst}}\n.. auto{kind}:: adamslite.{name}\n```\n"


def python_name(name: str) -> str:
    """One name: how it is called, its docstring, the methods of a class."""
    value = getattr(adamslite, name)
    parts = [f"## adamslite.{name}\n", f"    {name}{_parameters(value)}\n", _doc(value)]
    if inspect.isclass(value):
        parts += [f"    {each}\n        {heading(inspect.getdoc(getattr(value, each)))}"
                  for each in _methods(value)]  # fmt: skip
        parts += [""]
    return "\n".join(parts)


def _doc(value: Any) -> str:
    return (inspect.getdoc(value) or "") + "\n"


def _parameters(value: Any) -> str:
    """The parameters by name and default; their types are in the docstring."""
    try:
        parameters = inspect.signature(value).parameters.values()
    except ValueError:  # a class that has those of a class of Python itself
        return "(...)"
    bare = [each.replace(annotation=inspect.Parameter.empty) for each in parameters]
    return str(inspect.Signature(bare))


def _methods(cls: type) -> list[str]:
    """Public methods and properties that have a docstring."""
    found = inspect.getmembers(cls, lambda each: callable(each) or isinstance(each, property))
    own = (name for name, each in found if not name.startswith("_") and inspect.getdoc(each))
    return [name for name in own if not hasattr(BaseException, name)]

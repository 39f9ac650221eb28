"""The integrators, each declared in a module; importing this package registers them all.

Declarations are short, because every command that reads a deck needs the names; the formulas are
imported when they are compiled.
"""

from importlib import import_module
from pkgutil import iter_modules

for _module in iter_modules(__path__):
    import_module(f"{__name__}.{_module.name}")

"""Native code that carries weights of rows back to what the rows depend on, one for each shape."""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.caching.entries import recall
from adamslite.caching.sources import version_of
from adamslite.kernels.compile import writer_of
from adamslite.native import compiler

if TYPE_CHECKING:
    from adamslite.kernels.groups import Kernels, ShapeGroup


def pullback(kernels: Kernels, group: ShapeGroup) -> tuple[int, int]:
    """Addresses of ``f(count, ints, reals, W, weights, G, R)`` of what a group writes and of its
    guards (0: none); made when they are first asked for.

    G (nw,) is added to as :mod:`adamslite.kernels.code.pullback_writer` says, R as the reals of the
    instances stand, one behind the other.
    """
    name, guards = f"{group.name}_pullback", group.meta["guards"]
    names = [name] + [f"{name}_guards"] * bool(guards["clock"] or guards["watch"])
    if name not in kernels.addresses:

        def compiled() -> bytes:
            text = writer_of(kernels, group).pullback(group.name, group.meta["n_ints"])
            return compiler.straight_code(text)

        version = compiler.digest(version_of("kernels.pullback"))
        code = recall(f"{name}{version}.o", compiled)
        kernels.addresses.update(compiler.addresses([(code, names)]))
    return kernels.addresses[name], kernels.addresses.get(f"{name}_guards", 0)

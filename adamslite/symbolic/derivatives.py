"""Partial derivatives of expressions whose parts occur many times.

    (a + b)' = a' + b'      (a b)' = a' b + a b'      (b^e)' = b^e (e' log b + b' e/b)
    f(a, b)' = f_a a' + f_b b'

They are the trees that ``sympy.diff`` gives.  It forms for every part of an expression again its
symbols and for unevaluated derivatives, at every level: the effort grows with the size of the tree
times its depth, and the trees of kernels share most of their parts.  Here each part is visited
once, and differentiated once by each symbol.
"""

from __future__ import annotations

from adamslite.symbolic.sympy_nodes import sp
from adamslite.symbolic.types import Expr, Symbol


class Derivatives:
    """Differentiates expressions that share parts; remembers what it has found."""

    def __init__(self) -> None:
        self._symbols: dict[Expr, frozenset[Symbol]] = {}
        self._found: dict[tuple[Expr, Symbol], Expr] = {}

    def symbols(self, expr: Expr) -> frozenset[Symbol]:
        """The symbols in an expression."""
        found = self._symbols.get(expr)
        if found is None:
            parts = map(self.symbols, expr.args)
            found = frozenset((expr,)) if expr.is_Symbol else frozenset().union(*parts)
            self._symbols[expr] = found
        return found

    def __call__(self, expr: Expr, symbol: Symbol) -> Expr:
        """d(expr)/d(symbol)."""
        if expr == symbol:
            return sp.S.One
        if symbol not in self.symbols(expr):
            return sp.S.Zero
        key = expr, symbol
        if key not in self._found:
            self._found[key] = self._derivative(expr, symbol)
        return self._found[key]

    def _derivative(self, expr: Expr, symbol: Symbol) -> Expr:
        if expr.is_Add:
            return expr.func(*[self(term, symbol) for term in expr.args])
        if expr.is_Mul:
            return self._of_product(expr.args, symbol)
        if expr.is_Pow:
            base, exponent = expr.args
            by_base = self(base, symbol) * exponent / base
            slope = self(exponent, symbol)
            # sympy asks a lot about the logarithm before it lets zero times it be zero.
            return expr * (slope * sp.log(base) + by_base if slope != 0 else by_base)
        if type(expr).__name__ == "Piecewise":
            return expr.func(*[(self(each.expr, symbol), each.cond) for each in expr.args])
        if type(expr)._eval_derivative is sp.Function._eval_derivative:
            slopes = [self(argument, symbol) for argument in expr.args]
            parts = [expr.fdiff(n) * slope for n, slope in enumerate(slopes, 1) if slope != 0]
            return sp.Add(*parts)
        return sp.diff(expr, symbol)

    def _of_product(self, factors: tuple[Expr, ...], symbol: Symbol) -> Expr:
        terms = []
        for n, factor in enumerate(factors):
            slope = self(factor, symbol)
            if slope != 0:
                terms.append(sp.Mul(*factors[:n], slope, *factors[n + 1 :]))
        return sp.Add(*terms)

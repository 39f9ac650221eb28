"""Expressions in sympy: the scope of elements, nodes of the language, guards."""

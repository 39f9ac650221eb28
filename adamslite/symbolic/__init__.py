"""Expressions in sympy: the scope that elements see, nodes of the language, guards."""

"""Expressions as graphs: the scope of elements, derivatives, guards."""

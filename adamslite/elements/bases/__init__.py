"""Bases of families of statements: constraints, wrenches, joint coordinates, curves."""

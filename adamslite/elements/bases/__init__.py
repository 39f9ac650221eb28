"""Bases of families of statements, and arguments that several statements share."""

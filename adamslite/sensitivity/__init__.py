"""Derivatives of a run by numbers of its deck."""

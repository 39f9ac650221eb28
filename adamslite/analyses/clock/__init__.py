"""Expressions of time alone: their values, their jumps, and limits of the step size."""

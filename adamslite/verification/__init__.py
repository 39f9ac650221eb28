"""Comparison of runs with references: reference files, measures, verdicts, work and precision."""

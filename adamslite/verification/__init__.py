"""Runs held against references: reference files, measures, verdicts, work against precision."""

"""The results of a run: time histories, outcomes, and comparison."""

"""Models of a description are solved, and the cheapest of those that are good enough is taken.

Read trial first: it decides by the figures of readings, which trial_runs gets from runs.
"""

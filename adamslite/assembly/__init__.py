"""The posture in which a deck starts, in numbers.

What its constraints are off by, the nearest posture in which they hold, and rows that are redundant
there.
"""

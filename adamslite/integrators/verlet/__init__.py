"""VERLET: the explicit leapfrog formula for free point masses."""

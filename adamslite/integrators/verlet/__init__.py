"""VERLET: the explicit leapfrog formula for point masses without constraints."""

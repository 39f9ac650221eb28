"""The deck functions, one Python function each, grouped by family; an import registers them."""

from adamslite.functions import (
    angles,
    branches,
    forces,
    intrinsics,
    motion,
    series,
    states,
    steps,
)

__all__ = ["angles", "branches", "forces", "intrinsics", "motion", "series", "states", "steps"]

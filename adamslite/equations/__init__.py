"""The numbered equations of a model: unknowns, elimination order, arrays, native operations."""

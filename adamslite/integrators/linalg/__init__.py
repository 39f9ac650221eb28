"""Linear algebra of the Newton matrix: blocks eliminated in an order fixed once per model."""

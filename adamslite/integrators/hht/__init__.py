"""HHT and NEWMARK: second-order implicit formulas on accelerations."""

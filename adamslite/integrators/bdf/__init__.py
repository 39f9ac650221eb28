"""GSTIFF and CONSTANT_BDF: backward differentiation formulas."""

"""RADAU: the three-stage Radau IIA formula of order 5."""

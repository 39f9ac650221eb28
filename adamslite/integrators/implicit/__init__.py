"""The part that implicit methods share: control numbers, step sizes, failures."""

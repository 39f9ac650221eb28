"""What is simulated, how and with what limits, and whether there is room for its results."""

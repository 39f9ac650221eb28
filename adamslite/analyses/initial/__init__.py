"""Initial conditions: assembled positions and velocities, and constraints that are redundant."""

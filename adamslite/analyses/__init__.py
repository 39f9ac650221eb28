"""What can be asked of a model: initial conditions, a dynamic run."""

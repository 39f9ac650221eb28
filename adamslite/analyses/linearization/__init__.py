"""Small motions about a state: eigenvalues, modes and state matrices."""

"""The model: bodies, markers, and what expressions may take as known."""

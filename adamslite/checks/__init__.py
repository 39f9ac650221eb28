"""Rules about what the statements of a deck mean together; each yields diagnostics."""

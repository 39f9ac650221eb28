"""Rules about several statements of a deck together; each yields diagnostics."""

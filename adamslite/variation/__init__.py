"""Decks and kernels with other numbers, made without reading, binding or compiling again."""

"""Animated models in binary glTF 2.0, for other programs."""

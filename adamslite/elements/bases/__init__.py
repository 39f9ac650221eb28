"""What families of statements share: constraints, wrenches, joint coordinates, curves."""

"""What is drawn of a deck and its results: bodies that move, shapes, joints, lines, channels."""

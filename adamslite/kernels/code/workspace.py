"""The workspace of kernels: what stands where, of a run and of each body."""

# Where a body's quantities stand, counted from its first entry.
POSITION, VELOCITY, ACCELERATION, OMEGA, ALPHA, ATTITUDE = 0, 3, 6, 9, 12, 15
POINT_SIZE, PART_SIZE = 9, 24
# The head of the workspace.
TIME, MODE, RUN, HEAD = 0, 1, 2, 6

"""The analyses of a model: initial conditions, dynamics, statics, kinematics, small motions.

Read simulation first: `simulate` takes a deck, a model or kernels to results.  The rooms that it
goes through:

setup           what is simulated, how, and with what limits; whether there is room for it
session         the commands in turn, the state that they leave; SAVE, RELOAD, INFO
initial         assembled positions and velocities, redundant constraints
clock           expressions of time alone: values, jumps, limits of the step size
dynamics        the choice of a method, the plane, the past, the integration, its records
statics         equilibrium, and kinematics
linearization   small motions about a state
findings        how good a run was, what is odd about it, why it ended early
"""

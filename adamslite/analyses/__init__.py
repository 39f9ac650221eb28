"""The analyses of a model: initial conditions, dynamics, statics, kinematics, small motions."""

"""Static equilibrium, and kinematics: what loads or motions alone determine."""

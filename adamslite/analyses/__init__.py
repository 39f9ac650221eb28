"""The analyses of a model: initial conditions, dynamics, statics, kinematics, small motions.

Read simulation first: `simulate` takes a deck, a model or kernels to results. What it goes through:

subject, run_options           what is simulated, how, and with what limits
output_times, run_size         what is carried out, and whether there is room for it
session, session_state         the commands in turn, and the state that they leave
dynamic, static, kinematic     the analyses; method_choice, planar_reduction, delays prepare them
saves, saved_state, info       SAVE, RELOAD, INFO
accuracy_notes, confirmation   how good a run was; apart, buckling, slack, standstill: what is odd
failure_report                 why it ended early; held_steps: what kept its steps short
clock                          expressions of time alone: values, jumps, limits of the step size
initial                        assembled positions and velocities, redundant constraints
linearization                  small motions about a state
"""

"""Native code that advances a model in time.

contract           the data that a model and a method share, and the rules of a method
motion_equations   residual, Jacobian; accelerations, projection, newton, records stand beside it
linalg             block elimination, dense and complex
events             jumps and zones: search, stops, guards
audit              balance of energy on accepted steps
stepping           what all methods share, and the order of the functions of a step: read it first
implicit           what implicit methods share
bdf radau hht explicit verlet   one package for each family of methods
methods            their declarations: names, arguments, abilities
"""

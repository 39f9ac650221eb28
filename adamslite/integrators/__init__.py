"""Native code that advances a model in time.

contract           the data that a model and a method share, and the rules of a method
linalg             block elimination, dense and complex
motion_equations   residual, Jacobian, accelerations, projection, Newton, records
audit              balance of energy on accepted steps
events             jumps and zones: search, stops, guards
bdf radau hht explicit verlet   one package for each family of methods
"""

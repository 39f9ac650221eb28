"""From statements to native kernels: shapes, their bindings, and compilation.

Read compile first: binding finds the shape and the numbers of each statement, collecting groups
them, face_writer has the code of each shape written, which is in the room code.
"""

"""From statements to native kernels: shapes, their bindings, and compilation."""

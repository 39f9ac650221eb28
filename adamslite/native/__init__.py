"""Native code: a typed part of Python or LLVM text in, callable addresses out."""

"""Native code: from a typed part of Python or LLVM text to callable addresses."""

"""Native code: from a typed part of Python or LLVM text to callable addresses.

Read compiler first. The room translate takes Python, llvm_builder writes text, elf_linker places
what was compiled before without LLVM.
"""

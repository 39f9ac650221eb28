"""The definition of the language: statements, arguments, functions, messages."""

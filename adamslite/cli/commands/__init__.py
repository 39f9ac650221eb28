"""One module per sub-command: its docstring is the help text, `add_arguments` and `run` the rest.

They are all imported to build the command line, so each imports what it needs inside `run`.
"""

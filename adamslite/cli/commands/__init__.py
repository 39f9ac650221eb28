"""One module per sub-command: its docstring is the help text, `add_arguments` and `run` the rest.

The one that is called is imported to build its command line, so it imports what else it needs
inside `run`.
"""

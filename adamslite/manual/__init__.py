"""The manual, written by the registers that it describes.

They hold statements, functions, messages, outcomes, integrators, formats of result files, commands
and names of the Python package. A page is Markdown that reads as well in a terminal. `adamslite
help NAME` prints one; the files in docs/reference are all of them together.
"""

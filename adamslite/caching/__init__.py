"""The cache between runs: its folder, the seal of an entry, and the source of its name.

sources   a digest of every file that shapes an entry: part of the entry's name
program   a digest of the whole program: part of the name of what is kept of a deck
objects   objects of Python as entries
folder    where entries lie; nobody else may write there
entries   an entry is verified before it is used, and rebuilt when it fails
"""

"""From a short description of a cable scene to a deck of plain statements.

text --read--> Spec --estimate_moves--> Moves --choose_model--> CableModel --write--> deck
"""

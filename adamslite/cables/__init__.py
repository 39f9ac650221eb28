"""From a short description of a cable scene to a deck of plain statements.

text --read--> Spec --estimate--> Travel --choose--> CableModel --write--> deck
"""

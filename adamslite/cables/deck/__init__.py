"""From the text of a description to that of a deck, and whether a deck is what it describes.

Read scene first: it goes through all steps from reading to writing.
"""

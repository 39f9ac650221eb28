"""Numbers of a deck fitted to measurements, and what the measurements say about them.

Read fit first: from a deck and a measurement to a record.

measured                       columns of a file in the units of the deck, and their bands
parameters                     numbers as coordinates in which steps are alike
curves, derivatives            runs as a function of the numbers, and their derivatives
least_squares                  the numbers with which curves come closest
certainty, described, record   standard errors, what is not identifiable, and all of it as a table
deck_text                      the deck with the fitted numbers
"""

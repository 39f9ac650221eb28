"""From a short description of a cable scene to a deck of plain statements, and back.

text --read--> Spec --estimate_moves--> Moves --choose_model--> CableModel --write--> deck

The rooms, each of which imports from those above it only:

vectors       vectors of space, as tuples
description   what a description may say, and how it is read: a Spec
layout        where the cable lies at the start: spans, arcs, sag
model         what the cable will do, by a linear model, and the model that this needs
statements    what each wheel, span and weight becomes in a deck
deck          from the text of a description to that of a deck, and whether a deck is still it
trials        models of a description are solved, and the cheapest good one is taken
recognition   cables in a deck without a description, and the report of `adamslite check`

`adamslite cable` begins in deck/scene.py, its trials in trials/trial.py, `adamslite check` in
recognition/report.py.
"""

"""Rules about several statements of a deck together; each yields diagnostics.

Read rules first: it names all of them, in order. A module has those about one subject: constraints,
contacts, runs, ...; needless, reach and stiff are notes about what a scene can do without.
"""

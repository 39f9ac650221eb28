"""Cables that are found in a deck by its springs and masses, and what `adamslite check` says.

Read chain_finder first: masses in a row, joined by springs. Then report puts the advice together.
"""

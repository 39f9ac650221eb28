"""Numbers of a deck fitted to measurements, and what the measurements say about them."""

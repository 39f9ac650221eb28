"""Figures: time histories of results and charts of cost against accuracy, drawn by matplotlib."""

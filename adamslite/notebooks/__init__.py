"""What notebooks show of decks, results, linearised models and charts: HTML."""

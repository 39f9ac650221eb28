"""What Python users call: the commands of the command line, for paths, texts and decks."""

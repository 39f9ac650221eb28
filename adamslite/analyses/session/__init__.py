"""A session: commands in turn, the state that they leave, SAVE, RELOAD and INFO."""

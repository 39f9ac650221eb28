"""What is found of a run: how accurate it was, what was odd, why it ended early."""

"""The balance of energy of a run, on its accepted steps."""

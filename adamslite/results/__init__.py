"""What a run gives back: time histories, outcomes, and how two of them differ."""

"""What of a model depends on time alone: its values, its jumps, and where steps must be short."""

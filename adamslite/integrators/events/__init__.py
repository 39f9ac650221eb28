"""Events: where an expression changes its branch, and how a step ends there."""

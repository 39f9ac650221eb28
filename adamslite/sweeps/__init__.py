"""Many runs of one model with other numbers: what to vary, the runs, one file of them all."""

"""Reading results files of ADAMS, and the words they have."""

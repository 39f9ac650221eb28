"""Speed against accuracy: adamslite beside other programs, on the same scenes in the same run."""

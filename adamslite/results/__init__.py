"""The results of a run: time histories, outcomes, and comparison.

Read results first. Around it: channels (units and titles), selection (patterns), outcomes, summary;
comparison and run_error hold two results against each other; formats finds the writer of a file;
adams_terms and common_terms are for files of ADAMS.
"""

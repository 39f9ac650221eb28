"""Many runs of one model with other numbers: what to vary, the runs, one file of them all.

Read sweep first: from a deck and ranges to a file, which a later sweep goes on with.

ranges, saltelli               the values that numbers take; Sobol indices of what came of them
job, measures                  one run, and what is kept of it
workers, cluster, progress     runs by processes, threads or a Dask cluster, and how far they are
record, netcdf, origin         all runs, their file, and the texts that they were made from
motions, recognition           the page of a sweep; whether a file holds one
"""

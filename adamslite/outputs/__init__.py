"""One module per result format, each with `write(results, path)` and, if any, `read(path)`."""

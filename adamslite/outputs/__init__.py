"""One module per result format, each with `write(results, path)` and, where it can be read, `read(path)`."""

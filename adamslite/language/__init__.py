"""The words of the language: what a statement, an argument, a function and a message are."""

"""The command `adamslite`: main has its line, commands a module for each sub-command."""

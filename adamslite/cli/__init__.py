"""The command `adamslite`: one module for each sub-command."""

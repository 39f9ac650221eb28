"""What an editor needs: the canonical layout, places of names, completion, the language server."""

"""From text to syntax trees: tokens, statements and the forms of the grammar."""

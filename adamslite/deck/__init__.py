"""A deck as typed statements: names, lookup, redefinition and switching."""

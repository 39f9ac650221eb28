"""From syntax trees to typed statements: names, arguments and expressions are resolved."""

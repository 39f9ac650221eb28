"""Dynamic runs: method, plane, past, sensors, integration and what it wrote."""

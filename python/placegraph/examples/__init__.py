"""Examples: `python -m placegraph.examples.first_drive`."""

"""What a run records: rows on a grid, at steps, between them and at events."""

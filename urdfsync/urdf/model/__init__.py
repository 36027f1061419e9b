"""Robot to template data."""

"""Lines for people and values for programs that several commands share."""
